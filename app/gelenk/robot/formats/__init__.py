"""Other formats than URDF. From untrusted files: each becomes a URDF, which is then read like any other.

- `reading`: finds out the format by the root element. `sources`: the files of an upload, within bounds.
- `mjcf`: MuJoCo's format, read and written.
- `xacro`: expands a xacro; `scope`: its properties, macros and arguments; `expressions`: evaluates without `eval`;
  `functions`: what it may call; `values`: the bounds.
"""
