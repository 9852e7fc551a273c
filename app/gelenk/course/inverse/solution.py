"""What a solution by hand consists of."""

from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step
from gelenk.robot.arrays import Array


@dataclass(frozen=True, slots=True)
class HandSolution:
    """One branch: the table's variables, NaN where a joint is free.

    Attributes:
        values: ϑ or d of each row; shape (n,), [rad or m].
        pair: Two joints, a sign s, and the value of ϑ_i + s ϑ_j, [rad], which is all that is known of the two.
    """

    values: Array
    pair: tuple[int, int, int, float] | None = None

    def filled(self, guess: Array) -> Array:
        """Return the variables with the free ones taken from a guess (n,), so that the pair's sum is right."""
        values = np.where(np.isnan(self.values), guess, self.values)
        if self.pair is not None:
            i, j, sign, total = self.pair
            values[j] = sign * (total - values[i])
        return np.asarray(values)


@dataclass(frozen=True, slots=True)
class ByHand:
    """The steps, and all branches that they lead to; none if the target is out of reach.

    Attributes:
        is_family: Whether there are infinitely many, of which these are some.
    """

    steps: list[Step]
    solutions: list[HandSolution]
    is_family: bool = False


@dataclass(frozen=True, slots=True)
class HandTarget:
    """A target in the frames of the table: T_0_n of shape (4, 4), which directions count, and values for free joints.

    Attributes:
        guess: Variables of a solution that was sent, else zeros; shape (n,), [rad or m].
    """

    pose: Array
    directions: frozenset[str]
    guess: Array
