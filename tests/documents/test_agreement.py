"""What is compared with a page is compared in earnest."""

import pytest

from tests.documents.agreement import agree


@pytest.mark.parametrize(
    ("printed", "said"),
    [
        ('{"a": 1.0}', '{"a": 1.0000000000000002}'),
        ('{"id": "0123456789abcdef0123456789abcdef"}', '{"id": "fedcba9876543210fedcba9876543210"}'),
        ("0  solved  0.217090  1.68831e-16", "0  solved  0.217091  2.1e-16"),
        ("201", "201"),
        ("array([[1.7       , 0.        ]])", "array([[1.7, 0.]])".replace("[1.7, 0.]", "[1.7 , 0. ]")),
    ],
)
def test_the_same(printed: str, said: str) -> None:
    assert agree(printed, said)


@pytest.mark.parametrize(
    ("printed", "said"),
    [
        ('{"a": 1.0}', '{"a": 1.0001}'),
        ('{"a": 1.0}', '{"a": 1.0, "b": 2}'),
        ('{"a": [1.0]}', '{"a": []}'),
        ('{"a": true}', '{"a": 1}'),
        ('{"a": "0123456789abcdef0123456789abcdef"}', '{"a": "nobody"}'),
        ("0  solved  0.217090", "0  solved  0.217190"),
        ("0  solved  0.217090", "0  singular  0.217090"),
        ("0  solved  0.217090", "0  solved"),
        ("201", "200"),
        ("panda_link8", "panda_link7"),
    ],
)
def test_another(printed: str, said: str) -> None:
    assert not agree(printed, said)
