"""Run the service: `gelenk serve`, in a checkout `./dev serve`."""

import argparse
import asyncio
import contextlib
import errno
import fcntl
import ipaddress
import os
import resource
import shutil
import socket
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import cast

import uvicorn

from gelenk.connections import BoundedProtocol, ConnectionLimits, Gate
from gelenk.http.access.keyring import InvalidKeys, Keyring
from gelenk.logs import configuration
from gelenk.reload import serve_again
from gelenk.settings import InvalidSetting, Settings
from gelenk.store.folders import why_not
from gelenk.supervisor import Supervisor

SHUTDOWN_SECONDS = 3
"""How long requests in progress may go on after Ctrl-C or SIGTERM, [s]; a process is gone within 5 s in all."""

_OWN_FILES, _FILES_A_PROCESS, _FEWEST_CONNECTIONS = 32, 4, 16
"""Files open besides connections, in a process and for each of its workers; and the fewest connections worth having."""
_METRICS, _LOCK = "gelenk-metrics-", "lock"

OPEN_TO_ALL = (
    "at {host} others than this machine could use everything without a key: create keys with `{keys}` and name their "
    "file in GELENK_API_KEYS, or say with --open (or GELENK_OPEN_ACCESS=yes) that this is meant"
)


def main() -> None:
    """Parse the arguments, and serve until stopped."""
    program = sys.argv[0] if sys.argv[0] == "gelenk serve" else "./dev serve"
    parser = argparse.ArgumentParser(prog=program, description="Run the service.", allow_abbrev=False)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine only)")
    parser.add_argument("--port", default=8000, type=int, choices=range(1, 65536), metavar="PORT")
    parser.add_argument("--workers", default=1, type=int, choices=range(1, 129), metavar="N", help="processes")
    parser.add_argument("--open", action="store_true", help="accept other machines without keys")
    parser.add_argument("--root-path", metavar="/PREFIX", help="path prefix of a proxy (or GELENK_ROOT_PATH)")
    parser.add_argument("--reload", action="store_true", help="start again when a source file changes")
    arguments = parser.parse_args()
    if arguments.reload:
        serve_again([argument for argument in sys.argv[1:] if argument != "--reload"])
        return
    if arguments.root_path is not None:
        os.environ["GELENK_ROOT_PATH"] = arguments.root_path  # where the worker processes read it
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
            "GELENK_OTLP_ENDPOINT needs `gelenk[tracing]`: install that, or requirements-tracing.lock, as ./dev does"
        )
    if settings.ray_address and find_spec("ray") is None:
        sys.exit("GELENK_RAY_ADDRESS needs `gelenk[ray]`: install that, or requirements-ray.lock, as ./dev does")
    if not (settings.api_keys or settings.open_access or arguments.open or is_loopback(arguments.host)):
        sys.exit(OPEN_TO_ALL.format(host=arguments.host, keys=program.replace("serve", "keys")))
    room = _room_for_connections(settings.crew_processes + settings.job_processes)
    sockets = listeners(arguments.host, arguments.port, arguments.workers)
    where = f"Gelenk at http://{arguments.host}:{arguments.port}{settings.root_path}/"
    print(f"{where}, robots of your own in {settings.data_dir}", flush=True)
    if (reason := why_not(settings.data_dir)) is not None:
        sentence = f"nothing can be kept in {settings.data_dir}: {reason}; GELENK_DATA_DIR names another folder"
        print(sentence, file=sys.stderr)
    bounds = ConnectionLimits(connections=min(settings.connections, room), waiting=settings.requests_waiting)
    config = uvicorn.Config(
        "gelenk.main:from_environment",
        factory=True,
        host=arguments.host,
        port=arguments.port,
        loop="uvloop",
        http=cast(type[asyncio.Protocol], partial(BoundedProtocol, gate=Gate(bounds))),
        ws="none",
        access_log=False,
        log_config=configuration(settings.log_level),
        server_header=False,
        proxy_headers=bool(settings.trusted_proxies),
        forwarded_allow_ips=list(settings.trusted_proxies),
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
    )
    with metrics_folder(arguments.workers):
        Supervisor(config, sockets).run()


def listeners(host: str, port: int, count: int) -> list[socket.socket]:
    """Return a listening socket for each worker process; the system spreads connections evenly among them.

    Of two services started at once, one fails now and not when it serves: the first socket listens alone before it
    allows others at its address. Raises SystemExit if listening is impossible.
    """
    family, both = (socket.AF_INET6, socket.has_dualstack_ipv6()) if ":" in host else (socket.AF_INET, False)
    create = partial(socket.create_server, family=family, dualstack_ipv6=both)
    try:
        first = create((host, port))
        if count == 1 or sys.platform != "linux":  # elsewhere one socket would get all connections
            return [first] * count
        first.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        return [first, *(create(first.getsockname(), reuse_port=True) for _ in range(count - 1))]
    except OSError as error:
        reason = "another program has it" if error.errno == errno.EADDRINUSE else error.strerror or str(error)
        is_port = error.errno in {errno.EADDRINUSE, errno.EACCES}
        advice = f"--port names another one than {port}" if is_port else "--host takes an address of this machine"
        sys.exit(f"cannot listen at {host}:{port}: {reason}; {advice}")


@contextlib.contextmanager
def metrics_folder(workers: int) -> Iterator[None]:
    """Provide a folder for the counts of several worker processes, as long as the service runs.

    Folders left by killed services are removed first: their locks are free.
    """
    if workers == 1:
        yield
        return
    for left in Path(tempfile.gettempdir()).glob(f"{_METRICS}*"):
        with contextlib.suppress(OSError), (left / _LOCK).open() as lock:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(left)
    with tempfile.TemporaryDirectory(prefix=_METRICS) as folder, Path(folder, _LOCK).open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        os.environ["PROMETHEUS_MULTIPROC_DIR"] = folder
        try:
            yield
        finally:
            os.environ.pop("PROMETHEUS_MULTIPROC_DIR", None)


def is_loopback(host: str) -> bool:
    """Check whether an address leads only to this machine; of names, only `localhost` does so for sure."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _room_for_connections(processes: int) -> int:
    """Return how many connections, files to the system, each process may have open, beside its own `processes`."""
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))  # the usual limit is for programs that use `select`
    own = _OWN_FILES + _FILES_A_PROCESS * processes
    if 0 <= hard < own + _FEWEST_CONNECTIONS:
        sys.exit(f"only {hard} files may be open (`ulimit -n`): the service needs {own + _FEWEST_CONNECTIONS} or more")
    return sys.maxsize if hard == resource.RLIM_INFINITY else hard - own


if __name__ == "__main__":
    main()
