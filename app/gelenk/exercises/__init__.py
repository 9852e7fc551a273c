"""Exercises that grade themselves: drawn from a seed, solved by the core, wrong models computed as well.

- `lectures`: the exercises of each lecture. `exercise`: what one is, its variants, and all of them.
- `draw`: random numbers that stay the same. `fields`: when two answers are the same; `answer_field`: their base;
  `table_field`: a DH table.
- `arms`: the arms that exercises are about; `sketches`: their pictures.
- `grading`: points, and the names of mistakes. `mistakes`: what these mean.

To add an exercise, declare an `Exercise` in `lectures/<lecture>.py`, or in a folder of that name. Its functions take
the numbers of a variant, most simply a `NamedTuple` whose annotations say how `drawn` draws each of them; the text
shows each in full. `solve` calls the core; `wrong` has, by its code, what each mistake would answer, computed from the
same numbers. Codes that are new get a sentence in `mistakes/<lecture>.py`. Nothing has to be said about mistakes that
any student makes, such as degrees for radians, nor about answers that a wrong model shares with the right one: for
such numbers the model is not offered. In `tests/oracles/exercises/<lecture>.py` goes a second solution that does not
use the core, and a digest of the numbers, which stay the same until `version` is raised.
"""
