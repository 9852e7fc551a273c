"""How many bytes of request bodies a process holds at a time."""

from gelenk.model.errors import NoRoomForBody

SMALL = 64 * 1024
"""A smaller body is not counted: connections are, and the server holds as much of each anyway."""


class Bodies:
    """The large bodies that have arrived or are arriving, until their requests are answered.

    Received bytes count, not announced ones: a client that announces much and sends nothing takes no room from others.

    Args:
        allowed: Bytes of all of them.

    Attributes:
        held: Bytes that are held now.
    """

    def __init__(self, allowed: int) -> None:
        self._allowed, self.held = allowed, 0

    def check_room(self, count: int) -> None:
        """See whether there is room for so many bytes more.

        Raises:
            NoRoomForBody: There is none.
        """
        if self.held + count > self._allowed:
            raise NoRoomForBody(self._allowed)
