"""Paths of the tip by arc length, without time.

- `paths`: lines, circles and blended corners; `spline_paths`: splines; both built from `curves`.
- `orientation_paths`, `zyz_paths`, `rotation_splines`: orientations along them.
- `segment_paths`: the paths of a request's segments. `path_geometry`: their derivatives where joints follow them.
"""
