"""Manipulability: how fast and how strong a tip is in each direction.

- `two_links`: the measure of the planar arm, its ellipses and transmission ratios.
- `ellipses`: arms that are nearly singular or whose ellipse is a circle, and an exam.
"""
