"""Parts of jobs on a Ray cluster; the only place that knows Ray, which is loaded where a cluster is named.

Ray lives in a process of its own at the other end of a pipe: it ends the process that it is in when it loses its
cluster, and that must not be the service. Where that happens, what is under way fails, and the next part starts
another one.
"""

import contextlib
import hashlib
import itertools
import os
import pickle
import socket
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from functools import cache, partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeAlias

from app.jobs.workers import Cancelled, Order
from app.processes.copies import Copy, ended, started

_RETRIES = 4
"""How often a part is computed anew whose process or machine is lost."""
_ANSWER_SECONDS, _CONNECT_SECONDS = 5.0, 60.0
"""How long the cluster's head may take to answer at all, and until this machine is connected, [s]."""
_MESSAGES = pickle.HIGHEST_PROTOCOL

_QUIET = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_DISABLE_IMPORT_WARNING": "1",
    "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",
}
"""Nothing is reported to anyone, and nothing is looked for."""

_SIZE, _SIZE_SECONDS = -1, 10.0
"""In the place of a part's number: how many processors the cluster has by now; and how often that is looked at, [s]."""

_Task: TypeAlias = tuple[Callable[[Any], Any], Any]


class Cluster:
    """Computes parts on a Ray cluster; safe to use from many threads.

    Args:
        address: Of the cluster's head, `host:port`; this machine is one of the cluster's.
    """

    def __init__(self, address: str) -> None:
        self.address = address
        self.failure: str | None = f"the Ray cluster at {address} has not answered yet"
        self._lock = threading.Lock()
        self._process: Copy | None = None
        self._connection: Connection | None = None
        self._futures: dict[int, Future[Any]] = {}
        self._numbers = itertools.count()
        self._count = 1
        self._closed = False

    @property
    def count(self) -> int:
        """Processors of the cluster, as far as is known."""
        return self._count

    def prepare(self) -> None:
        """Find the cluster, unless it is found; `failure` says where it is not."""
        with contextlib.suppress(ChildProcessError, Cancelled), self._lock:
            self._connected()

    def submit(self, function: Callable[[Any], Any], argument: Any, order: Order) -> "Future[Any]":
        """Have a part done; see `Workers.submit`. A cancelled future's part is ended on the cluster too.

        Raises:
            ChildProcessError: The cluster cannot be reached.
            Cancelled: The service is shutting down.
        """
        if order.cancelled.is_set():
            raise Cancelled
        with self._lock:
            connection, number, future = self._connected(), next(self._numbers), _Part(self)
            future.number = number
            self._futures[number] = future
            try:
                connection.send_bytes(pickle.dumps((number, (function, argument)), _MESSAGES))
            except OSError as error:
                raise ChildProcessError(self._lost()) from error
        return future

    def drop(self, number: int) -> None:
        """End a part that is no longer wanted."""
        with self._lock:
            if self._futures.pop(number, None) is not None and self._connection is not None:
                try:
                    self._connection.send_bytes(pickle.dumps((number, None), _MESSAGES))
                except OSError:
                    self._lost()

    def close(self) -> None:
        """End all that is under way; later parts are refused."""
        with self._lock:
            self._closed = True
            self._end()
            futures, self._futures = list(self._futures.values()), {}
        _fail(futures, Cancelled())

    def _connected(self) -> Connection:
        if self._closed:
            raise Cancelled
        if self._connection is not None:
            return self._connection
        try:
            # One that is not there would be waited for for minutes.
            host, _, port = self.address.rpartition(":")
            socket.create_connection((host.strip("[]"), int(port)), _ANSWER_SECONDS).close()
            self._process, connection = started(_Driver(self.address), "ray")
            if not connection.poll(_CONNECT_SECONDS):
                raise TimeoutError
            found = connection.recv()
        except (OSError, EOFError) as error:
            self._end()
            reason = error.strerror if isinstance(error, OSError) and error.strerror else "it does not answer"
            self.failure = f"the Ray cluster at {self.address} cannot be reached: {reason}"
            raise ChildProcessError(self.failure) from error
        if isinstance(found, str):
            self._end()
            self.failure = found
            raise ChildProcessError(found)
        self._count, self._connection, self.failure = max(1, found), connection, None
        threading.Thread(target=self._listen, args=(connection,), name="ray", daemon=True).start()
        return connection

    def _listen(self, connection: Connection) -> None:
        """Pass on what comes back, until nothing does any more."""
        while True:
            try:
                number, succeeded, result = connection.recv()
            except (OSError, EOFError):
                break
            if number == _SIZE:
                self._count = max(1, result)
                continue
            with self._lock:
                future = self._futures.pop(number, None)
            # One that was cancelled in this moment takes no result.
            with contextlib.suppress(InvalidStateError):
                if future is not None and succeeded:
                    future.set_result(result)
                elif future is not None:
                    future.set_exception(result)
        with self._lock:
            if self._connection is not connection:
                return
            reason = self._lost()
            futures, self._futures = list(self._futures.values()), {}
        _fail(futures, ChildProcessError(reason))

    def _lost(self) -> str:
        self._end()
        self.failure = f"the connection to the Ray cluster at {self.address} was lost"
        return self.failure

    def _end(self) -> None:
        ended(self._process, self._connection)
        self._process, self._connection = None, None


class _Part(Future[Any]):
    """A part under way, which cancelling ends on the cluster too."""

    def __init__(self, cluster: Cluster) -> None:
        super().__init__()
        self.number = -1
        self._cluster = cluster

    def cancel(self) -> bool:
        """End it."""
        self._cluster.drop(self.number)
        return super().cancel()


def _fail(futures: list[Future[Any]], error: BaseException) -> None:
    for future in futures:
        with contextlib.suppress(InvalidStateError):
            future.set_exception(error)


class _Driver:
    """What the process that holds the connection to the cluster runs."""

    def __init__(self, address: str) -> None:
        self._address = address

    def __call__(self, connection: Connection) -> None:
        _be_quiet()
        try:
            import ray  # noqa: PLC0415 - an extra, and half a second

            ray.init(self._address, configure_logging=False, log_to_driver=False, namespace="gelenk")
            compute = ray.remote(max_retries=_RETRIES, num_cpus=1)(_computed)
            count = _processors(ray)
        except Exception as error:
            reason = (str(error).strip() or type(error).__name__).splitlines()[0]
            connection.send(f"the Ray cluster at {self._address} cannot be reached: {reason}")
            return
        lock, references, code = threading.Lock(), dict[int, Any](), code_digest()

        def tell(number: int, future: "Future[Any]") -> None:
            error = future.exception()
            if references.pop(number, None) is None:
                return
            with lock:
                connection.send((number, error is None, future.result() if error is None else _told(error, ray)))

        def tell_size() -> None:
            while True:
                time.sleep(_SIZE_SECONDS)
                with contextlib.suppress(OSError), lock:
                    connection.send((_SIZE, True, _processors(ray)))

        connection.send(count)
        threading.Thread(target=tell_size, name="size", daemon=True).start()
        while True:
            try:
                number, task = pickle.loads(connection.recv_bytes())  # noqa: S301 - from the service
            except (OSError, EOFError):
                return
            if task is None:
                if (reference := references.pop(number, None)) is not None:
                    ray.cancel(reference, force=True)
            else:
                references[number] = reference = compute.remote(code, *task)
                reference.future().add_done_callback(partial(tell, number))


def _processors(ray: Any) -> int:
    """Of all machines that are there now."""
    return int(ray.cluster_resources().get("CPU", 0))


def _be_quiet() -> None:
    """Ray reports nothing to anyone, and its own lines do not go into the log, which is one of JSON."""
    os.environ.update(_QUIET)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)


def _told(error: BaseException, ray: Any) -> BaseException:
    """What went wrong with a part, as it would have on this machine."""
    if isinstance(error, ray.exceptions.RayTaskError):
        return error.cause if isinstance(error.cause, Exception) else ChildProcessError(str(error.cause))
    if isinstance(error, ray.exceptions.RayError):
        return ChildProcessError("a process of the Ray cluster that computed a part of it has died")
    return error


def _computed(code: str, function: Callable[[Any], Any], argument: Any) -> Any:
    """A part, on some machine of the cluster.

    Raises:
        RuntimeError: Another release is installed there, which might compute something else.
    """
    if code != code_digest():
        raise ChildProcessError("a machine of the Ray cluster has another release of the service")
    return function(argument)


@cache
def code_digest() -> str:
    """What tells one release's code from another's."""
    digest, root = hashlib.blake2b(digest_size=16), Path(__file__).resolve().parent.parent
    for path in sorted(root.rglob("*.py")):
        digest.update(f"{path.relative_to(root)}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()
