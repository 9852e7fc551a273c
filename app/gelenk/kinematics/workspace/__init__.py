"""The positions that a tip reaches, from up to a million samples.

- `workspace`: the survey of a robot. `sampling`: configurations; `tip_motion`: how far the tip moves between them;
  `voxels`: grids; `survey`: volumes with their bounds; `dexterity`: orientations reached in a voxel.
"""
