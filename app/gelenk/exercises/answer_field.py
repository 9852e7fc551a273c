"""What all fields of an answer have in common.

The distance of an answer from another is measured in tolerances, so that 1 is the limit of what counts as equal.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeAlias

from gelenk.exercises.mistakes.catalogue import Mistake, mistake

FieldKind: TypeAlias = Literal["number", "vector", "matrix", "choice", "set", "dh_table", "basis"]


class Unreadable(Exception):
    """An answer of the wrong form."""

    def __init__(self, code: str, **places: Any) -> None:
        super().__init__(code)
        self.mistake: Mistake = mistake(code, **places)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnswerField(ABC):
    """A field of an answer.

    Attributes:
        name: Its name in the answers.
        label: What it asks for, for people.
        unit: Of its numbers; "" without one.
        tolerance: How far an answer may be from the right one; 0 for whole numbers.
        is_relative: Whether the tolerance is a share of the right answer's size.
        points: What it is worth.
    """

    kind: ClassVar[FieldKind]
    name: str
    label: str
    unit: str = ""
    tolerance: float = 0.0
    is_relative: bool = False
    points: float = 1.0

    @abstractmethod
    def read(self, given: Any) -> Any:
        """Return an answer as the core computes with it; raises Unreadable."""

    @abstractmethod
    def distance(self, answer: Any, reference: Any) -> float:
        """Return how far an answer is from another, in tolerances of the latter."""

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:  # noqa: ARG002
        """Yield what general mistakes make of the right answer, each with its code."""
        yield from ()

    def share(self, answer: Any, right: Any) -> float:
        """Return the share of the points that an answer earns."""
        return 1.0 if self.distance(answer, right) <= 1.0 else 0.0

    def choices(self) -> Mapping[str, str]:
        """Return the words to choose from, each with what it means; none if anything can be written."""
        return {}

    def shape(self) -> tuple[int, ...]:
        """Return the shape of an array; () for anything else."""
        return ()
