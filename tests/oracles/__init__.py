"""Independent ways to the same numbers: nothing here imports `gelenk`.

- `catalogue`: the robots of the catalogue as texts and tables.
- `urdf_product`: poses by a product of transforms read from the XML itself.
- `dh_columns`: poses and Jacobian columns of a Denavit-Hartenberg table.
- `differences`: derivatives of poses by differences on the manifold.
- `descents`: how near to a pose an arm comes, by Levenberg-Marquardt from many starts.
- `line_way`: joints along a straight line of the tip, as a series, and what a time law makes of them.
- `many_starts`: all solutions of a Denavit-Hartenberg arm by Levenberg-Marquardt from many starts.
- `tip_rates`: how fast the tip moves and turns, by differences of poses.
"""
