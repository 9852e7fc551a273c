"""The four subspaces against the definition: what J does to them."""

import numpy as np
import pytest

from gelenk.kinematics.velocity.subspaces import subspaces


@pytest.mark.parametrize(("m", "n", "rank"), [(6, 7, 6), (6, 7, 4), (6, 3, 3), (2, 2, 1), (3, 3, 0), (6, 0, 0)])
def test_subspaces_split_both_spaces_at_the_rank(m: int, n: int, rank: int) -> None:
    rng = np.random.default_rng(m + 10 * n + 100 * rank)
    J = rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))
    found = subspaces(J, 1e-10)
    assert found.rank == rank
    assert [part.shape[1] for part in (found.range, found.left_kernel)] == [rank, m - rank]
    assert [part.shape[1] for part in (found.row_space, found.kernel)] == [rank, n - rank]
    for first, second in ((found.range, found.left_kernel), (found.row_space, found.kernel)):
        both = np.column_stack((first, second))
        np.testing.assert_allclose(both.T @ both, np.eye(len(both)), atol=1e-14)
    np.testing.assert_allclose(J @ found.kernel, 0.0, atol=1e-13)
    np.testing.assert_allclose(J.T @ found.left_kernel, 0.0, atol=1e-13)
    np.testing.assert_allclose(found.range @ (found.range.T @ J), J, atol=1e-13)
