"""Access to the service: which requests are allowed, the headers of every answer, and the logs.

- `exchange`: a request and its answer so far. `door`: passes each through the checks, in order.
- `scopes`: which operation needs which scope. `directory`: which operation a path is.
- `hosts`, `origins`, `keys`: the checks; `keyring` holds the keys.
- `headers`: what every answer carries. `journal`: the log of requests, and the audit log of writes.
- `metrics`: counts for Prometheus. `tracing`: OpenTelemetry, on request.
"""
