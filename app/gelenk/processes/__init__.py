"""Processes of ours: copies of one that has loaded everything, there within milliseconds, gone with whom they are for.

- `copies`: starts a process, and ends it so that nothing of it is left.
- `original`: what runs in the process that is copied.
- `pages`: gives back memory that only loading has needed.
- `turns`: whose turn it is, where clients share processes or other places.
"""
