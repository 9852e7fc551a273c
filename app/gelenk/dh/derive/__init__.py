"""The symbolic solution of a DH table, as a lecturer writes it; `numeric` gives its numbers, `check` compares both.

- `algebra`: polynomials in sines and cosines of sums of joint angles; it does not search for simplifications.
- `table`: a table in exact terms: which angles are multiples of π/2, which parameters are symbols.
- `transforms`: A_i and T_0_i; angles about parallel axes appear as sums.
- `jacobian`: the columns z × p, and the square block that has a determinant.
- `factors`: a determinant as the product that a textbook prints.
- `singular`: the configurations at which a factor vanishes.
- `typeset`: LaTeX and plain text.
- `texts`: input and output of the symbolic part, as plain data; the rows of a table in LaTeX.
- `symbolic`: all of it for one table, as text and as values at samples; it loads neither NumPy nor Pinocchio.
- `numeric`: the same quantities at given configurations, from the table's own product of transforms.
- `check`: compares formulas with numbers.
- `steps`: the solution in the order of the lecture.
"""
