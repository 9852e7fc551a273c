"""Paths of a tool that may turn about an axis of its own.

- `sequence`: the cheapest choice of turns and branches along the poses; `candidates`: the configurations to choose
  from, by closed forms, clear of each `singularity`; `smoothing`: the turns between those that were tried;
  `blocked`: why a sequence goes no further.
- `placing`: ordinary segments with the turn that was chosen.
"""
