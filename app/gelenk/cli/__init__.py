"""`gelenk`: the service in a shell, on a server or without one.

- `main`: the commands, and how they end; `session`: what they share.
- `robots`, `arms`, `motions`, `jobs`, `tables`, `bench`, `ask`: what they do.
- `inputs`: robots, tables and configurations from arguments, files and standard input; `xacro`: expanded here.
- `completion`: what a shell completes; `examples`: what `--help` shows.
- `batches`: a large batch in several calls.
- `outputs`: answers as tables, JSON, CSV and npy.
- `local`: the application without a network.
"""
