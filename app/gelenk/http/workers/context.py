"""Robots and limits that a process needs to answer requests, and the settings they come from."""

from dataclasses import dataclass, field
from pathlib import Path

from gelenk.operations.outcome import Limits
from gelenk.store.library import Library, Quota


@dataclass(frozen=True, slots=True)
class Context:
    """Robots and limits that a process needs to answer requests.

    Attributes:
        library: All robots.
        limits: Limits on the work for an answer.
    """

    library: Library
    limits: Limits


@dataclass(frozen=True, slots=True)
class ContextSetup:
    """Settings that answers depend on besides the request; sent along with each task.

    Attributes:
        catalogue: Folder of the robots that come with the project.
        uploads: Folder of the uploaded robots.
        limits: Limits on the work for an answer.
        quota: Limits on what one client may store.
    """

    catalogue: Path
    uploads: Path
    limits: Limits
    quota: Quota = field(default_factory=Quota)

    def library(self) -> Library:
        """Open the library of all robots."""
        return Library(self.catalogue, self.uploads, self.quota)

    def context(self) -> Context:
        """Open the library and return it with the limits."""
        return Context(self.library(), self.limits)
