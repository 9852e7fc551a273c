"""The calls of the service as data: what `app.client` sends.

- `operations`: what the service can be asked, described once for both clients; `arrays`: the same of large batches.
- `call`: a call, and how a description becomes a method.
- `refusals`: a problem on the wire, turned back into the core's own exception.
"""
