"""Manipulability: how fast and how strong a tip is in each direction.

- `two_links`: the measure of the planar arm, its ellipses and transmission ratios. `isotropic`: the arm whose ellipse
  is a circle. `stretched`: one that is nearly singular. `three_links`: an exam.
"""
