"""Run the service: `python -m app.serve`, or `./dev serve`."""

import argparse
import asyncio
import contextlib
import ipaddress
import os
import resource
import socket
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from importlib.util import find_spec
from typing import Any, cast

import uvicorn
from uvicorn.config import STARTUP_FAILURE
from uvicorn.supervisors import Multiprocess

from app.api.access.keyring import InvalidKeys, Keyring
from app.connections import BoundedProtocol, Bounds, Gate
from app.logs import configuration
from app.settings import InvalidSetting, Settings

SHUTDOWN_SECONDS = 6
"""How long requests in flight may go on after Ctrl-C or SIGTERM; with its own end a process is gone within 8."""

LISTENERS = 8
"""Connections that are let in in one turn of an event loop, each in less than a tenth of a millisecond."""

OPEN_TO_ALL = (
    "at {host} others than this machine could do everything without a key: make keys with `./dev keys` and name their "
    "file in GELENK_API_KEYS, or say with --open (or GELENK_OPEN_ACCESS=yes) that this is meant"
)


def main() -> None:
    """Parse the arguments and serve until told to stop."""
    parser = argparse.ArgumentParser(prog="./dev serve", description=__doc__)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine alone)")
    parser.add_argument("--port", default=8000, type=int, choices=range(1, 65536), metavar="PORT")
    parser.add_argument("--workers", default=1, type=int, choices=range(1, 129), metavar="N", help="processes")
    parser.add_argument("--open", action="store_true", help="listen beyond this machine without keys")
    arguments = parser.parse_args()
    try:
        settings = Settings.from_environment(os.environ)
        if settings.api_keys:
            Keyring(settings.api_keys)
    except InvalidSetting as error:
        sys.exit(str(error))
    except InvalidKeys as error:
        sys.exit(f"GELENK_API_KEYS: {error}")
    if settings.otlp_endpoint and find_spec("opentelemetry.sdk") is None:
        sys.exit(
            "GELENK_OTLP_ENDPOINT needs the extra `tracing`: install requirements-tracing.lock, as ./dev serve does"
        )
    if not (settings.api_keys or settings.open_access or arguments.open or is_loopback(arguments.host)):
        sys.exit(OPEN_TO_ALL.format(host=arguments.host))
    _open_as_many_files_as_allowed()
    print(f"Gelenk at http://{arguments.host}:{arguments.port}/, robots of your own in {settings.data_dir}")
    bounds = Bounds(connections=settings.connections, waiting=settings.requests_waiting)
    with metrics_folder(arguments.workers), contextlib.suppress(KeyboardInterrupt):
        run(
            host=arguments.host,
            port=arguments.port,
            workers=arguments.workers,
            loop="uvloop",
            http=cast(type[asyncio.Protocol], partial(BoundedProtocol, gate=Gate(bounds))),
            ws="none",
            access_log=False,
            log_config=configuration(settings.log_level),
            server_header=False,
            proxy_headers=bool(settings.trusted_proxies),
            forwarded_allow_ips=list(settings.trusted_proxies),
            timeout_graceful_shutdown=SHUTDOWN_SECONDS,
            timeout_worker_healthcheck=60,
        )


def run(**options: Any) -> None:
    """Serve until told to stop.

    Args:
        options: Of `uvicorn.Config`.
    """
    config = uvicorn.Config("app.main:from_environment", factory=True, **options)
    listeners = several(config.bind_socket())
    if config.workers > 1:
        Multiprocess(config, sockets=listeners).run()
        return
    server = uvicorn.Server(config)
    server.run(listeners)
    if not server.started:
        sys.exit(STARTUP_FAILURE)


def several(listener: socket.socket) -> list[socket.socket]:
    """One listening socket as several, all on one queue of connections.

    The event loop takes one connection a turn from each. From a single one it would take a thousand turns until the
    last of a thousand that have come at once is let in, and in each turn those before it are being answered.
    """
    return [listener, *(listener.dup() for _ in range(LISTENERS - 1))]


@contextlib.contextmanager
def metrics_folder(workers: int) -> Iterator[None]:
    """Where several worker processes keep what each has counted, as long as the service runs."""
    if workers == 1:
        yield
        return
    with tempfile.TemporaryDirectory(prefix="gelenk-metrics-") as folder:
        os.environ["PROMETHEUS_MULTIPROC_DIR"] = folder
        yield


def is_loopback(host: str) -> bool:
    """Whether an address leads to this machine alone; of names only `localhost` is known to."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _open_as_many_files_as_allowed() -> None:
    """Each connection is one; the usual limit is for programs that count them otherwise."""
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))


if __name__ == "__main__":
    main()
