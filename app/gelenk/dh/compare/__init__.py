"""Does a DH table describe a chain, and if not, what is wrong with it?

- `compare`: the comparison with its verdict. `of_chain`: a chain's own table, nearly parallel axes made parallel.
- `screws`: chains by their axes, and least squares on them; `invariants`: what no choice of frames changes.
- `alignment`: which axis corresponds to which, as a first guess; `placement`: base, tool, zeros and signs, with the
  errors that Pinocchio measures.
- `mistakes`: common mistakes, tried one after the other by `trials`; `repairs` mend them. `numbers`: entries that must
  be others; `trials` has them beside another mistake. `words`: the names of all.
"""
