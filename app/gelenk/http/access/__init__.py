"""Access control: which requests are allowed, the headers of every response, and the logs.

- `request_context`: a request and its response so far.
- `middleware`: passes requests through the checks, in order; adds the headers that all responses share, and
  optional OpenTelemetry.
- `route_table`: finds the operation for a path.
- `origins`, `keys`: the checks; `keyring` holds the keys, and is loaded before what computes.
- `audit_log`: the request log, and the audit log of writes.
- `metrics`: counts for Prometheus.
"""
