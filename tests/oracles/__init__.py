"""Independent ways to the same numbers: nothing here imports `app`.

- `catalogue`: the robots of the catalogue as texts and tables.
- `urdf_product`: poses by a product of transforms read from the XML itself.
- `dh_columns`: poses and Jacobian columns of a Denavit-Hartenberg table.
- `differences`: derivatives of poses by differences on the manifold.
- `many_starts`: all solutions of a Denavit-Hartenberg arm by Levenberg-Marquardt from many starts.
"""
