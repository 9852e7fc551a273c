"""Inputs with their verdict, as plain data: what a strict reader must refuse, may wonder at, must accept.

`urdf` holds robot descriptions, `dh` DH tables and whole request bodies, `npy` arrays, `zips` archives; `bodies` makes
bad requests out of a good one, `fields` and `calls` hold those of single operations. All are written from the formats
and from what has broken other readers, never from the reader under test: they are its judge. `judging` says what every
refusal must be.
"""
