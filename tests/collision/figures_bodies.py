"""Times the bodies of the catalogue's robots, first found and then from disk.

`python -m tests.collision.figures_bodies`; names of robots may follow, otherwise it takes all of them.
The excess is that of the loosest piece over its part of a mesh, and the covers' that of all spheres over the hulls.
"""

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.cover_excess import volume_of, volume_of_union
from gelenk.operations.robot_bodies import stored_or_found
from gelenk.settings import Settings
from gelenk.store.library import Library


def main(names: list[str]) -> None:
    """Print a line a robot: links, pieces, times, vertices, loosest excess, pairs looked at."""
    with TemporaryDirectory() as folder:
        library = Library(Settings().catalogue_dir, Path(folder))
        for name in names or library.catalogue_names:
            loaded = library.get(name)
            times = []
            for _ in range(2):
                started, busy = time.perf_counter(), time.process_time()
                found = stored_or_found(loaded)
                times.append((time.perf_counter() - started, time.process_time() - busy))
            links = len(loaded.robot.description.links)
            known = [body.excess for body in found.bodies if body.excess == body.excess]
            print(
                f"{name:28} {links:4} links {len(found.bodies):4} pieces {times[0][0]:7.2f} s",
                f"({times[0][1]:5.2f} s of a core), then {times[1][0] * 1e3:6.1f} ms ({times[1][1] * 1e3:5.1f});",
                f"{sum(len(body.points) for body in found.bodies):6} vertices, excess ≤ {max(known, default=0.0):7.2f}",
                f"covers' {excess_of_covers(found.bodies):5.2f}; {sum(pair.active for pair in found.pairs):5} pairs",
                flush=True,
            )


def excess_of_covers(bodies: Sequence[Body]) -> float:
    """Return the volume of the spheres of all hulls over that of the hulls, less one; 0 without hulls."""
    hulls = [body for body in bodies if body.kind == "convex"]
    inside = sum(volume_of(body) for body in hulls)
    return sum(volume_of_union(body.spheres) for body in hulls) / inside - 1.0 if hulls else 0.0


if __name__ == "__main__":
    main(sys.argv[1:])
