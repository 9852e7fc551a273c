"""What a process that answers requests has at hand, and what that is set up from."""

from dataclasses import dataclass, field
from pathlib import Path

from gelenk.operations.outcome import Limits
from gelenk.store.library import Library, Quota


@dataclass(frozen=True, slots=True)
class Context:
    """What a process that answers requests has at hand.

    Attributes:
        library: All robots.
        limits: What an answer may take.
    """

    library: Library
    limits: Limits


@dataclass(frozen=True, slots=True)
class ContextSetup:
    """What answers depend on beside the request; it is sent along with each task.

    Attributes:
        catalogue: Folder of the robots that come with the project.
        uploads: Folder of all others.
        limits: What an answer may take.
        quota: What one client may keep.
    """

    catalogue: Path
    uploads: Path
    limits: Limits
    quota: Quota = field(default_factory=Quota)

    def library(self) -> Library:
        """All robots."""
        return Library(self.catalogue, self.uploads, self.quota)

    def context(self) -> Context:
        """What a process needs to answer with."""
        return Context(self.library(), self.limits)
