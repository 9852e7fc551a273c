"""All operations on a robot, and what a process of the crew sets its desk up from."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gelenk.api.dynamics import dynamics_operation
from gelenk.api.errand import Desk
from gelenk.api.inverse import inverse_operation
from gelenk.api.kinematics import kinematics_operations
from gelenk.api.manipulability import manipulability_operation
from gelenk.api.routes import Operation
from gelenk.api.singularity import singularity_operation
from gelenk.api.statics import statics_operation
from gelenk.api.trajectory import trajectory_operation
from gelenk.api.velocity import velocity_operation
from gelenk.jobs.shelf import Limits
from gelenk.store.library import Library, Quota


@dataclass(frozen=True, slots=True)
class Setup:
    """What answers depend on beside the request.

    Attributes:
        catalogue: Folder of the robots that come with the project.
        uploads: Folder of all others.
        max_answer_numbers: Most numbers in one answer.
        seconds: How long a request may take; what has a time limit of its own is to end before.
        quota: What one client may keep.
        job_bytes: What the parts of a job may take.
    """

    catalogue: Path
    uploads: Path
    max_answer_numbers: int
    seconds: float
    quota: Quota = field(default_factory=Quota)
    job_bytes: int = Limits().job_bytes

    def operations(self) -> list[Operation]:
        """All operations on a robot."""
        most = self.max_answer_numbers
        return [
            *kinematics_operations(most),
            inverse_operation(most, self.seconds, self.job_bytes),
            statics_operation(most),
            dynamics_operation(most),
            manipulability_operation(most),
            velocity_operation(most),
            singularity_operation(most),
            trajectory_operation(most),
        ]

    def library(self) -> Library:
        """All robots."""
        return Library(self.catalogue, self.uploads, self.quota)

    def desk(self) -> Desk:
        """What a process needs to answer with."""
        computations: dict[str, Any] = {operation.name: operation.computation for operation in self.operations()}
        return Desk(self.library(), computations)
