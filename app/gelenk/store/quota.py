"""What one client may store of one kind."""

from collections.abc import Sequence
from dataclasses import dataclass

from gelenk.errors import QuotaExceeded


@dataclass(frozen=True, slots=True)
class Quota:
    """Storage limits of one client: the number of its robots, or scenes, and the size of all their files, [bytes]."""

    kind: str
    count: int
    size: int

    def check(self, owner: str, stored: Sequence[int], new: int, replaced: int | None) -> None:
        """Check that there is room for one more.

        Args:
            owner: The client.
            stored: Sizes of all that it stores, [bytes].
            new: Size of what it adds.
            replaced: Size of what that takes the place of, one of `stored`; None if there is no such.

        Raises:
            QuotaExceeded: There would be too many, or too many bytes, and more than before.
        """
        many = f"{self.kind}s"
        for what, used, more, allowed in (
            (many, len(stored), 1 if replaced is None else 0, self.count),
            (f"bytes of {many}", sum(stored), new - (replaced or 0), self.size),
        ):
            if more > 0 and used + more > allowed:
                raise QuotaExceeded(owner, what, used, more, allowed, self.kind)


ROBOTS = Quota("robot", 20_000, 10 * 1024**3)
"""Of robots, unless the operator sets another one."""
SCENES = Quota("scene", 2_000, 2 * 1024**3)
"""Of scenes, likewise."""
