"""The command `gelenk`: the service in a shell, on a server or without one.

- `main`: the commands and exit codes; `session`: the options that commands share.
- `robots`, `arms`, `motions`, `jobs`, `tables`, `bench`, `ask`: the commands themselves.
- `inputs`, `rows`: robots, tables and numbers from arguments, files and standard input; `xacro`: expands xacro here.
- `completion`: completion in a shell; `examples`: the examples of `--help`.
- `batches`: splits a large batch into several calls.
- `outputs`: answers as tables, JSON, CSV and npy.
- `local`: the application without a network.
"""
