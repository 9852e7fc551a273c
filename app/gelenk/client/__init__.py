"""The service in Python: `Client` waits for its answers, `AsyncClient` awaits them.

- `client`: both clients. `operations`: the operations as their methods; `stored`: those on stored robots and jobs.
- `arrays`: operations on large batches as arrays; `jobs`: operations as jobs.
- `call`: a call, and how a description becomes a method; `exchange`: its JSON and its arrays.
- `responses`: turns a response into an answer or an exception, or says when to send the call again.
- `show`: a robot in a notebook.
- `refusals`: turns a problem from the service back into the core's own exception.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gelenk.client.client import AsyncClient as AsyncClient, Client as Client


def __getattr__(name: str) -> Any:
    """`Client` and `AsyncClient`, loaded when they are first used: help and completion of the shell need neither."""
    if name in {"Client", "AsyncClient"}:
        from gelenk.client import client  # noqa: PLC0415

        return getattr(client, name)
    raise AttributeError(f"module 'gelenk.client' has no attribute {name!r}")
