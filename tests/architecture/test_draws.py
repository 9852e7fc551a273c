"""What Hypothesis draws for the tests."""

from importlib import import_module
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st


def drawn() -> list[int]:
    values = []

    @settings(max_examples=200, deadline=None, database=None, derandomize=True)
    @given(st.integers(0, 2**40))
    def note(value: int) -> None:
        values.append(value)

    note()
    return values


def test_draws_are_the_same_whatever_has_been_imported_by_then(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = drawn()
    (tmp_path / "another_module.py").write_text(f"NUMBERS = {list(range(10**9, 10**9 + 1000))}")
    monkeypatch.syspath_prepend(tmp_path)
    import_module("another_module")
    assert drawn() == before
