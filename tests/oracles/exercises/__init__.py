"""Independent solutions of the exercises, by lecture: nothing here imports `gelenk`.

`SOLUTIONS` has a function of the numbers for each exercise, and `DIGESTS`, by exercise and version, what the numbers of
seed 1 are: they stay the same for ever.
"""
