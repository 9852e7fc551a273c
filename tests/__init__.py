"""Tests, laid out as `gelenk` is.

- `oracles`: independent ways to the same numbers; they share no code with `gelenk`.
- `corpus`: inputs with their verdict, as plain data.
- `robots`: the catalogue's robots as the core sees them.
- `architecture`: who may know whom, and what may stand in a file.
"""
