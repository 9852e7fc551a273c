"""Access to the service: which requests are allowed, the headers of every answer, and the logs.

- `request_context`: a request and its answer so far. `middleware`: passes each through the rules, in order.
- `scopes`: which operation needs which scope. `route_table`: which operation a path is.
- `hosts`, `origins`, `keys`: the rules; `keyring` holds the keys.
- `headers`: what every answer carries. `audit_log`: the log of requests, and the audit log of writes.
- `metrics`: counts for Prometheus. `tracing`: OpenTelemetry, on request.
"""
