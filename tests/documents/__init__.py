"""The README and the pages: what stands in them is run, and compared with what comes out.

The pages of the handbook that hold calls as `{run}` are run when it is built (`./dev handbook`).
"""
