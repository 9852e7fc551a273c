"""The worked solution of a DH table, as a lecturer writes it: symbols first, numbers to every one of them after.

- `algebra`: polynomials in sines and cosines of sums of joint angles; nothing is simplified by search.
- `table`: a table in exact terms: which angles are multiples of π/2, which parameters are symbols.
- `transforms`: A_i and T_0_i, parallel axes taken together, so that their angles appear as sums.
- `jacobian`: the columns z × p, and the square block that has a determinant.
- `factors`: a determinant as the product that a textbook prints.
- `singular`: the configurations at which a factor vanishes.
- `lagrangian`: the equations of motion of a planar arm.
- `typeset`: LaTeX and plain text.
- `legend`: what the symbols stand for.
- `texts`: what goes into the symbolic part and comes out of it, as plain data.
- `symbolic`: all of it for one table, as text and as values at samples; it knows neither NumPy nor Pinocchio.
- `numeric`: the same quantities at given configurations, from the table's own product of transforms.
- `check`: formulas against numbers.
- `steps`: the solution in the order of the lecture.
- `worked`: all of it together.
"""
