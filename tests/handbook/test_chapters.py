"""Each chapter of the course has what a lecture needs."""

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
NO_CHAPTERS = {DOCS / "course" / name for name in ("corrections.md", "exam.md", "contents.md", "formula-sheet.md")}
CHAPTERS = sorted(set((DOCS / "course").glob("*.md")) - NO_CHAPTERS)
CORRECTIONS = (DOCS / "course" / "corrections.md").read_text(encoding="utf-8")


def test_there_are_the_lectures() -> None:
    assert len(CHAPTERS) == 11


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda chapter: chapter.stem)
def test_a_chapter_has_idea_formula_call_picture_and_exercises(chapter: Path) -> None:
    text = chapter.read_text(encoding="utf-8")
    assert re.search(r"^# .+\n\n## The idea\n", text)
    assert text.count("$$") >= 2
    assert text.count("<!-- run") >= 2
    assert "<!-- picture" in text
    exercises = text.partition("\n## Exercises\n")[2].split("\n### Exercise ")[1:]
    assert len(exercises) >= 3
    assert all(exercise.count("<summary>Answer</summary>") == 1 and " = " in exercise for exercise in exercises)


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda chapter: chapter.stem)
def test_a_chapter_begins_with_an_example_by_hand_whose_numbers_are_compared(chapter: Path) -> None:
    before_any_code = chapter.read_text(encoding="utf-8").partition("\n```")[0]
    example = before_any_code.partition("\n## By hand\n")[2].partition("\n## ")[0]
    assert example.count("$$") >= 2
    assert len(re.findall(r"^<!-- [^=\n]+ = .*gelenk\.", example, re.MULTILINE)) >= 1
    assert len(re.findall(r"^<!-- [^=\n]+ = ", example, re.MULTILINE)) >= 4


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda chapter: chapter.stem)
def test_where_the_notes_err_is_in_the_list_too(chapter: Path) -> None:
    if "Where the notes err" in chapter.read_text(encoding="utf-8"):
        assert f"({chapter.name}" in CORRECTIONS


def test_the_exam_adds_up_and_its_solutions_are_compared_with_calls() -> None:
    text = (DOCS / "course" / "exam.md").read_text(encoding="utf-8")
    heads, parts = re.findall(r"^## .*\((\d+) points\)$", text, re.MULTILINE), text.split("\n## ")[1:]
    assert f"minutes, {sum(map(int, heads))} points" in text
    assert len(parts) == len(heads)
    for part in parts:
        assert part.count("<summary>Solution</summary>") == part.count("<!-- run") == 1
        assert re.search(r"^<!-- [^=\n]+ = ", part, re.MULTILINE)


def test_every_notebook_is_named_in_a_chapter() -> None:
    text = "".join(chapter.read_text(encoding="utf-8") for chapter in CHAPTERS)
    notebooks = sorted(path.name for path in (DOCS / "notebooks").glob("*.ipynb"))
    assert [name for name in notebooks if f"(../notebooks/{name})" not in text] == []
