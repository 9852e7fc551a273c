"""What the command line reads and writes.

- `inputs`: robots, tables and configurations from arguments, files and standard input; xacro is expanded here.
- `outputs`: answers as tables, JSON, CSV and npy, by `rows`.
"""
