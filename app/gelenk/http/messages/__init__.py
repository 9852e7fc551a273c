"""What every route shares: bodies, answers, errors and the OpenAPI document.

- `problems`: every error as RFC 9457 problem details, with the one table from error class to status.
- `payloads`, `npy`: read requests strictly and within bounds, and write responses, as JSON and as NumPy's npy.
- `routes`: a route that FastAPI documents but that runs without FastAPI's overhead.
- `openapi`: the OpenAPI document.
"""
