"""The HTTP layer: parse requests, call the core, build responses.

- `dispatch`: routes and responses of all operations, built from the table of endpoints.
- `messages`: bodies, answers, errors and the OpenAPI document. `access`: checks of every request.
- `workers`: requests that a worker process answers. `jobs`: long work. `robots`: the robots as resources.
- `pictures`: those of the course. `scenes`: the scenes as resources. `sheets`: homework.
- `service`: health and readiness. `pages`: the studio and the documentation.
"""
