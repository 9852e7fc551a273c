"""Orientations and frames.

- `rotations`: about an axis or a coordinate; how far a matrix is from one. Frames composed about moving or fixed axes,
  inverted, and applied to points.
- `orientation`: an orientation in every notation, both branches, and what degenerates.
- `orientation_steps`: the worked solution, also with products of elementary rotations in symbols.
"""
