"""What is there at once, without loading what computes.

- `group`: the list of commands, each loaded when it is called; options anywhere on the line.
- `programs`: the commands that start another program. `quick`: calls that need no application.
"""
