"""Kinds and bounds of a homework, which its requests state."""

from typing import Literal, TypeAlias

Content: TypeAlias = Literal["sheets", "solutions"]

MAX_VARIANTS = 300
"""Most participants times exercises: what a worker writes within a minute, if each has a picture of its own."""
MAX_GRADED = 1000
"""Most participants times exercises of a table of answers."""
MAX_LABEL = 80
"""Longest name of a participant."""
MAX_ROWS = 20_000
"""Most rows of a table of answers."""
