"""Compiled search for exact configurations along a path, with their rates.

- `nearest` decomposes J, for one configuration. `elimination` solves with JJᵀ, for eight side by side; `walk` goes with
  it from sample to sample.
"""
