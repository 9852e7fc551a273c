"""Contacts of a motion with the robot itself and its scene, also between samples.

- `search`: the smallest clearance, by bounds of the `travel` of all bodies.
"""
