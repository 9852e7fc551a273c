"""Checks of a motion, with code that shares nothing with the planners.

- `audit`: the verdict. `joints`: extremes and jumps of the joints' `pieces`; `tip`: the tip; `torques`: torques; both
  also between samples, by `peaks`.
- `contact`: clearance of the whole robot, at all times.
- `examine`: most figures of a motion, in one compiled call; `worst`: those of the joints that count. `kernels`: rates
  of the tip and singular values, eight samples at a time.
- `demands`: the requirements. `result`, and the names in `words`: what a motion's answer contains.
"""
