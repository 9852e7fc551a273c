"""Mobility of linkages.

- `pairs`: the constraints of each kind of kinematic pair, in the plane and in space.
- `topology`: links and pairs as a graph: loops, bridges, open and closed chains.
- `mechanism`: links and pairs from a description, joints of more than two links split; idle freedoms.
- `mobility`: the formula, a second way to it by loops, and its warnings; `steps`: the count on the board, joint
  space against task spaces, branches against redundancy.
- `screws`: the mobility of a linkage in its configuration, from where its axes lie.
"""
