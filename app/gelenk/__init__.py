"""Gelenk: robot kinematics over HTTP, every answer recomputed before it is sent.

- `main`: builds the application from its parts; `serve` runs it; `settings` is read once, there. `keys`: creates keys.
- `reload`: restarts it when a source file changes. `supervisor`: starts the worker processes, and replaces them.
- `connections`: HTTP connections with bounds on time, size and number. `answering`: each request at once.
- `preload`: loads what all processes share; `processes`: processes forked from the one that has loaded it.
- `engine`: the core as a library, `gelenk.Robot`. `client`: the service as a library; `gelenk.show`.
- `logs`: the log, as lines of JSON.
- `prune`: removes from a container image what the service never opens.
- `http`: the HTTP layer. `contract`: the operations and their payloads. `store`: robots on disk.
- `jobs`: long work in processes of its own.
- `operations`: the computation of each operation. `pool`: processes for long requests and parts of jobs.
- `sheets`: homework and its grades. `exercises`: exercises that grade themselves. `plots`: pictures. `trajectory`:
  motions in time. `course`: the course's calculators, which need no robot.
- `ik`: from poses to configurations. `dh`: tables ↔ descriptions. `kinematics`: what a robot does. `robot`: what it is.
  These know neither HTTP nor settings. `errors`: every error, as data. `language`: of texts for people.
  `package_data`: where the package's files are.

Imports lead only downwards; `./dev lint` checks it.
"""

TYPE_CHECKING = False  # checkers know the name; `typing` loads slower than all else before `cli.start`

if TYPE_CHECKING:
    from typing import Any

    from gelenk.client.show import show as show
    from gelenk.engine import Robot as Robot


def __getattr__(name: str) -> "Any":
    """Return `gelenk.__version__`, `gelenk.show` or `gelenk.Robot`, loaded on first use."""
    if name == "__version__":
        from importlib.metadata import version  # noqa: PLC0415  (half of what an import of this package would take)

        return version("gelenk")
    if name == "show":
        from gelenk.client.show import show  # noqa: PLC0415

        return show
    if name == "Robot":
        try:
            from gelenk.engine import Robot  # noqa: PLC0415  (takes a second, which a client need not wait for)
        except ModuleNotFoundError as error:
            how = "install gelenk[engine] (in a checkout: pip install '.[engine]')"
            raise ImportError(f"gelenk.Robot needs {error.name}: {how}") from error
        return Robot
    raise AttributeError(f"module 'gelenk' has no attribute {name!r}")
