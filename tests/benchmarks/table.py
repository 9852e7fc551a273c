"""The table of results."""

from typing import NamedTuple


class Row(NamedTuple):
    """One result."""

    what: str
    measured: str
    peer: str = ""
    ratio: float | None = None
    wanted: str = ""


def show(rows: list[Row]) -> None:
    """Print rows as a Markdown table."""
    print("| what | measured | against | ratio | wanted |")
    print("|---|---|---|---|---|")
    for row in rows:
        ratio = "" if row.ratio is None else f"{row.ratio:.2f}"
        print(f"| {row.what} | {row.measured} | {row.peer} | {ratio} | {row.wanted} |")
