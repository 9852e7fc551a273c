"""Finished parts on disk: whole or not there, and no more of them than there may be."""

from pathlib import Path

import numpy as np
import pytest

from gelenk.errors import StorageFailed, TooLarge, UnknownJob
from gelenk.jobs.parts import Parts, computed, packed, unpacked

DIGEST, OTHER = "ab" * 32, "cd" * 32


def test_a_part_is_read_as_it_was_written(tmp_path: Path) -> None:
    parts = Parts(tmp_path, DIGEST, 1000)
    assert parts.read("all-0") is None
    parts.write("all-0", b"some bytes")
    parts.write("all-1", b"")
    assert (parts.read("all-0"), parts.read("all-1"), parts.read("all-10")) == (b"some bytes", b"", None)
    assert Parts(tmp_path, DIGEST, 1000).read("all-0") == b"some bytes"
    parts.clear()
    assert list(tmp_path.iterdir()) == []


def test_no_part_that_is_not_whole_is_read(tmp_path: Path) -> None:
    parts = Parts(tmp_path, DIGEST, 1000)
    parts.write("all-0", b"some bytes")
    (path,) = tmp_path.iterdir()
    whole = path.read_bytes()
    for broken in (*(whole[:end] for end in range(len(whole))), bytes(len(whole)), whole[:-1] + b"x", whole + b"x"):
        path.write_bytes(broken)
        assert parts.read("all-0") is None, broken


def test_they_take_no_more_than_they_may(tmp_path: Path) -> None:
    Parts(tmp_path, DIGEST, 200).write("all-0", bytes(100))
    parts = Parts(tmp_path, DIGEST, 200)
    with pytest.raises(TooLarge) as refused:
        parts.write("all-1", bytes(100))
    assert refused.value.allowed == 200
    assert parts.read("all-1") is None
    parts.clear()
    parts.write("all-1", bytes(100))


def test_what_others_have_written_counts_too(tmp_path: Path) -> None:
    parts = Parts(tmp_path, DIGEST, 200)
    parts.bytes += computed((bytes, 100, parts, "all-0"))
    assert parts.read("all-0") == bytes(100)
    with pytest.raises(TooLarge):
        parts.write("all-1", bytes(100))


def test_what_is_left_of_another_request_is_none_of_this_one(tmp_path: Path) -> None:
    Parts(tmp_path, OTHER, 1000).write("all-0", b"of a job that was removed")
    parts = Parts(tmp_path, DIGEST, 1000)
    assert parts.read("all-0") is None
    with pytest.raises(FileNotFoundError):
        list(parts.of("all", 1))
    parts.write("all-0", b"its own")
    assert list(parts.of("all", 1)) == [b"its own"]
    parts.clear()
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_kept_says_so(tmp_path: Path) -> None:
    folder = tmp_path / "job"
    folder.mkdir()
    parts = Parts(folder, DIGEST, 1000)
    part = folder / f"part-2-{DIGEST[:16]}-all-0"
    part.mkdir()
    with pytest.raises(StorageFailed):
        parts.write("all-0", b"x")
    assert [path.name for path in folder.iterdir()] == [part.name]
    part.rmdir()
    folder.rmdir()
    with pytest.raises(UnknownJob):
        parts.write("all-0", b"x")


def test_arrays_come_back_to_the_last_bit() -> None:
    values = np.array([[0.1, -0.0], [np.inf, np.nan], [5e-324, 1.0]])
    named = {"bytes": np.frombuffer(b"odd", np.uint8), "none": np.empty((0, 3)), "flipped": values.T, "number": 7}
    found = unpacked(packed(values=values, numbers=(1, 2**62), nothing=None, **named))
    assert set(found) == {"values", "numbers", *named}
    assert found["values"].tobytes() == values.tobytes()
    assert found["flipped"].tobytes() == values.T.tobytes()
    assert found["numbers"].tolist() == [1, 2**62]
    assert (found["bytes"].tobytes(), found["none"].shape, int(found["number"])) == (b"odd", (0, 3), 7)
    assert all(array.flags.aligned and array.flags.writeable for array in found.values())
    two = unpacked(packed(values=values, **named), "flipped", "number", "nothing")
    assert list(two) == ["flipped", "number"]
    assert two["flipped"].tobytes() == values.T.tobytes()
    with pytest.raises(ValueError, match="only numbers"):
        packed(values=np.array([object()]))
