"""The command line, on the core and on a server."""
