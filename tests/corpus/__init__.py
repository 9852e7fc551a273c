"""Inputs with their verdict, as plain data: what a strict reader must refuse, may wonder at, must accept.

`urdf` holds robot descriptions, `dh` holds DH tables and whole request bodies. Both are written from the
formats and from what has broken other readers, never from the reader under test: they are its judge.
"""
