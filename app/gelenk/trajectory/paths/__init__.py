"""Paths of the tip by arc length, without time.

- `paths`: lines and circles, built from `curves`; `corners`: blends of these; `spline_paths`: splines.
- `orientation_paths`, `zyz_paths`, `rotation_splines`: orientations along them.
- `tracks`, `sampling`, `arc_length`: compiled samples of these.
- `turned_path`: a path on which the tip turns about an axis of its own besides.
- `segment_paths`: the paths of a request's segments. `path_geometry`: their derivatives where joints follow them.
"""
