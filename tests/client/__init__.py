"""The Python client, against a running service."""
