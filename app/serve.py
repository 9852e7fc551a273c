"""Run the service: `python -m app.serve`, or `./dev serve`."""

import argparse
import os
import sys

import uvicorn

from app.settings import InvalidSetting, Settings

SHUTDOWN_SECONDS = 7
"""How long requests in flight may go on after Ctrl-C or SIGTERM; with its own end a process is gone within 8."""


def main() -> None:
    """Parse the arguments and serve until told to stop."""
    parser = argparse.ArgumentParser(prog="./dev serve", description=__doc__)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine alone)")
    parser.add_argument("--port", default=8000, type=int, choices=range(1, 65536), metavar="PORT")
    parser.add_argument("--workers", default=1, type=int, choices=range(1, 129), metavar="N", help="processes")
    arguments = parser.parse_args()
    try:
        settings = Settings.from_environment(os.environ)
    except InvalidSetting as error:
        sys.exit(str(error))
    print(f"Gelenk at http://{arguments.host}:{arguments.port}/, robots of your own in {settings.data_dir}")
    uvicorn.run(
        "app.main:from_environment",
        factory=True,
        host=arguments.host,
        port=arguments.port,
        workers=arguments.workers,
        loop="uvloop",
        http="httptools",
        access_log=False,
        log_level="warning",
        server_header=False,
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
        timeout_worker_healthcheck=60,
    )


if __name__ == "__main__":
    main()
