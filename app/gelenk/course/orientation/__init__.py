"""Orientations and frames.

- `rotations`: about an axis or a coordinate; how far a matrix is from one.
- `orientation`: an orientation in every notation, both branches, and what degenerates.
- `composition`: frames composed about moving or fixed axes, inverted, and applied to points.
- `orientation_steps`: the worked solution; `symbols`: products of elementary rotations in symbols.
"""
