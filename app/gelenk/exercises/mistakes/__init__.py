"""What each code of a mistake means, in a sentence for who made it.

- `catalogue`: all of them. `general`: those of any answer, and of answers of the wrong form.
- The other modules, one for each lecture, hold what its exercises add, as `MISTAKES`; any exercise may use any code.

A code names a wrong model, whose answer is computed, and not a wrong number.
"""
