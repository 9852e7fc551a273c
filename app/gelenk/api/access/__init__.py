"""The door of the service: who may come in, what every answer carries, and what is kept of it.

- `exchange`: a request and its answer, as far as they have got. `door`: passes each through the checks, in order.
- `scopes`: which operation needs which scope. `directory`: which operation a path is.
- `hosts`, `origins`, `keys`: the checks; `keyring` holds the keys.
- `headers`: what every answer carries. `journal`: the log of requests, and the audit log of writes.
- `metrics`: what is counted, for Prometheus. `tracing`: OpenTelemetry, where it is asked for.
"""
