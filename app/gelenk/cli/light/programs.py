"""The commands that start another program of the package, and pass all their options on to it."""

import runpy
import sys

import typer

SETTINGS = {"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []}
"""How their lines are read."""


def serve(context: typer.Context) -> None:
    """Run the service: --host, --port, --workers; --help says more."""
    sys.argv = ["gelenk serve", *context.args]
    runpy.run_module("gelenk.serve", run_name="__main__")


def keys(context: typer.Context) -> None:
    """Create an API key: NAME, --scopes, --file; --help says more."""
    sys.argv = ["gelenk keys", *context.args]
    runpy.run_module("gelenk.keys", run_name="__main__")
