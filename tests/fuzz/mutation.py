"""Mutations of inputs, the same ones for the same seed."""

import random
import re
import warnings
import zipfile
from collections.abc import Callable, Iterator
from io import BytesIO

from tests.fuzz.seeds import NUMBERS, Seeds

_NUMBER = re.compile(rb"-?\d+(\.\d+)?([eE][+-]?\d+)?")
_LONGEST = 20_000
_LONGEST_NAME = 400


class Mutator:
    """Makes inputs out of others.

    Args:
        seeds: Where they start from.
        words: What means something to the reader, besides numbers.
        number: Seed of the choice.
    """

    def __init__(self, seeds: Seeds, words: tuple[bytes, ...], number: int) -> None:
        self._seeds, self._words = seeds, words
        self._random = random.Random(number)
        self._kinds: tuple[Callable[[bytes], bytes], ...] = (
            self._with_bit, self._with_byte, self._with_word, self._with_word, self._with_number, self._with_number,
            self._without_piece, self._with_piece_twice, self._with_pieces_swapped, self._cut, self._crossed,
        )  # fmt: skip

    def inputs(self) -> Iterator[bytes]:
        """Without end: each a seed with a few mutations."""
        while True:
            yield self.mutated(self._seed())

    def _seed(self) -> bytes:
        """Mostly a good one: what is refused already gets no further with most mutations."""
        return self._random.choice(self._seeds.good if self._random.random() < 0.75 else self._seeds.bad)

    def mutated(self, data: bytes) -> bytes:
        """An input with a few mutations; mostly one, so that much of it stays good."""
        for _ in range(min(8, 1 + int(self._random.expovariate(0.8)))):
            data = self._random.choice(self._kinds)(data)
        return data[:_LONGEST]

    def _place(self, data: bytes) -> int:
        return self._random.randint(0, len(data))

    def _piece(self, data: bytes) -> tuple[int, int]:
        start = self._place(data)
        return start, min(len(data), start + self._random.choice((1, 2, 8, 32, 128)))

    def _with_bit(self, data: bytes) -> bytes:
        if not data:
            return data
        place, changed = self._random.randrange(len(data)), bytearray(data)
        changed[place] ^= 1 << self._random.randrange(8)
        return bytes(changed)

    def _with_byte(self, data: bytes) -> bytes:
        place = self._place(data)
        return data[:place] + self._random.randbytes(1) + data[place:]

    def _with_word(self, data: bytes) -> bytes:
        start, end = self._piece(data)
        kept = data[start:] if self._random.random() < 0.5 else data[end:]
        return data[:start] + self._random.choice(self._words) + kept

    def _with_number(self, data: bytes) -> bytes:
        found = list(_NUMBER.finditer(data))
        if not found:
            return data
        number = self._random.choice(found)
        value = self._random.choice(NUMBERS) if self._random.random() < 0.5 else b"%r" % self._random.gauss(0, 3)
        return data[: number.start()] + value + data[number.end() :]

    def _without_piece(self, data: bytes) -> bytes:
        start, end = self._piece(data)
        return data[:start] + data[end:]

    def _with_piece_twice(self, data: bytes) -> bytes:
        start, end = self._piece(data)
        return data[:end] + data[start:]

    def _with_pieces_swapped(self, data: bytes) -> bytes:
        places = sorted(self._place(data) for _ in range(3))
        return data[: places[0]] + data[places[1] : places[2]] + data[places[0] : places[1]] + data[places[2] :]

    def _cut(self, data: bytes) -> bytes:
        return data[: self._place(data)]

    def _crossed(self, data: bytes) -> bytes:
        other = self._seed()
        return data[: self._place(data)] + other[self._place(other) :]


class ArchiveMutator(Mutator):
    """Mutates every second archive from within: its checksums would give away any other change of a name or a file."""

    def mutated(self, data: bytes) -> bytes:
        """An archive with a few mutations, or with a few in one of its names or files."""
        return self._repacked(data) if self._random.random() < 0.5 else super().mutated(data)

    def _repacked(self, data: bytes) -> bytes:
        try:
            with zipfile.ZipFile(BytesIO(data)) as archive:
                files = {entry.filename: archive.read(entry) for entry in archive.infolist()}
        except Exception:  # a dozen kinds, those of each way to pack among them
            return super().mutated(data)
        name = self._random.choice(sorted(files)) if files else ""
        content = files.pop(name, b"")
        if self._random.random() < 0.5:
            name = super().mutated(name.encode("utf-8", "surrogateescape")).decode("latin-1")
        else:
            content = super().mutated(content)
        buffer = BytesIO()
        method = self._random.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
        with zipfile.ZipFile(buffer, "w") as archive, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a name that is there twice
            for path, text in {**files, name[:_LONGEST_NAME]: content}.items():
                archive.writestr(zipfile.ZipInfo(path), text, method)
        return buffer.getvalue()
