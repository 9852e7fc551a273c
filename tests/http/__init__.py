"""The service over HTTP, in process."""
