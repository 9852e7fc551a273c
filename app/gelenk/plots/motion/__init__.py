"""Pictures of motions along a line.

- `line`: its time law. `pipeline`: a planar arm at the samples of one. `postures`: an arm along any motion.
"""
