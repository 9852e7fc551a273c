"""Limit on the bytes of request bodies that a process holds at a time."""

from gelenk.errors import NoRoomForBody

SMALL = 64 * 1024
"""Smaller bodies are not counted: connections are limited, and the server buffers as much for each anyway."""


class Bodies:
    """Counts the bytes of large bodies, from their arrival until their requests are answered.

    Received bytes count, not announced ones: a client that announces many and sends none takes no room from others.

    Args:
        allowed: Maximum number of bytes over all bodies.

    Attributes:
        held: Bytes held now.
    """

    def __init__(self, allowed: int) -> None:
        self._allowed, self.held = allowed, 0

    def check_room(self, count: int) -> None:
        """Check that there is room for `count` more bytes.

        Raises:
            NoRoomForBody: There is not enough room.
        """
        if self.held + count > self._allowed:
            raise NoRoomForBody(self._allowed)
