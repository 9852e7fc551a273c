"""The command `gelenk`: the service in a shell, on a server or without one.

- `start`: Ctrl-C; `main`: the options of all commands, and exit codes; `light`: the list of commands, and quick calls.
- `session`: the options that commands share, and the examples of `--help`.
- `robots`, `arms`, `motions`, `jobs`, `tables`, `homework`, `bench`, `ask`: the commands themselves.
- `files`: robots, tables and configurations as input, answers as output.
- `completion`: completion in a shell.
- `batches`: splits a large batch into several calls.
- `local`: the application without a network.
"""
