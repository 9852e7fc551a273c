"""Triangles from three of their six sides and angles, by the laws of cosines and sines.

- `triangle`: all triangles that fit, checked by the coordinates of their corners.
- `triangle_steps`: the worked solution.
"""
