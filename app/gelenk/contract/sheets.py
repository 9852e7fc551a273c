"""Homework: the sheets of a class, and the grades of its answers."""

from typing import Annotated

from pydantic import Field

from gelenk.contract.options import InLanguage
from gelenk.sheets.bounds import MAX_LABEL, MAX_VARIANTS, Content

MAX_EXERCISES = 50
MAX_CSV = 4 * 1024 * 1024

_Secret = Annotated[
    str | None,
    Field(
        min_length=16,
        max_length=256,
        description="Decides everybody's numbers; the service's own if left out. Grading needs the same.",
    ),
]


class SheetsRequest(InLanguage):
    """Describes a homework."""

    exercises: list[Annotated[str, Field(max_length=64)]] = Field(
        min_length=1, max_length=MAX_EXERCISES, description="Ids, in the order of the sheet."
    )
    participants: (
        Annotated[int, Field(ge=1, le=MAX_VARIANTS)]
        | Annotated[
            list[Annotated[str, Field(min_length=1, max_length=MAX_LABEL)]],
            Field(min_length=1, max_length=MAX_VARIANTS),
        ]
    ) = Field(
        description="Names or numbers of the participants, printed on the sheets and never stored; or how many there "
        f"are, whose names are then 1, 2, …. Times the exercises at most {MAX_VARIANTS}."
    )
    title: str = Field(default="", max_length=120, description="Printed on every sheet.")
    content: Content = Field(
        default="sheets",
        description="What the page or the PDF has: the sheets, or the booklet of the tasks with answers and worked "
        "solutions. The other forms have what they need of both.",
    )
    secret: _Secret = None

    @property
    def labels(self) -> list[str]:
        """The participants' names."""
        given = self.participants
        return [str(i) for i in range(1, given + 1)] if isinstance(given, int) else given


class SheetsGradeRequest(InLanguage):
    """Brings the answers of a class."""

    csv: str = Field(
        max_length=MAX_CSV,
        description="A table with the columns `participant`, `exercise`, `field` and `answer`. Numbers of a vector "
        "are separated by spaces, rows and solutions by semicolons.",
    )
    secret: _Secret = None
