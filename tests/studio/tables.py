"""A table typed into the studio, cell by cell."""

from collections.abc import Sequence

from tests.studio.browser import Studio

ANTHROPOMORPHIC = [("0", "pi/2", "0", "0"), ("0.5", "0", "0", "0"), ("0.4", "0", "0", "0")]
"""a, α, d, θ of the anthropomorphic arm, as the lecture writes them."""


def open_editor(studio: Studio) -> None:
    """The Robot panel with the editor, starting from one row."""
    studio.open("robot", robot="planar_2r")
    studio.button("DH table").click()
    studio.field("Start from a table of the course").select_option(label="One row")
    studio.wait_for_robot(None)


def type_table(studio: Studio, rows: Sequence[tuple[str, str, str, str]]) -> None:
    """Type the rows of a table, and wait until the arm is on the screen."""
    open_editor(studio)
    for number, row in enumerate(rows, start=1):
        if number > 1:
            studio.button("Add a row").click()
        for sign, text in zip(("a", "α", "d", "θ"), row, strict=True):
            studio.type(f"Row {number}, {sign}", text)
    studio.until(f"studio.store.value.draft.joints.length === {len(rows)} && !studio.store.value.loading")
    studio.until(f"studio.store.value.model.joints.length === {len(rows)}")


def keep(studio: Studio, name: str) -> None:
    """Add the typed table to the robots of the service."""
    studio.field("Name at the service").fill(name)
    studio.button("Add to the robots").click()
    studio.wait_for_robot(name)
