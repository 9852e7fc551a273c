"""Bounds of a homework, which its requests state."""

MAX_VARIANTS = 1000
"""Most participants times exercises: what a worker writes within a minute, pictures included."""
MAX_LABEL = 80
"""Longest name of a participant."""
MAX_ROWS = 20_000
"""Most rows of a table of answers."""
