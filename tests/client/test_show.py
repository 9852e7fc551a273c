"""A robot in a notebook: the address of its picture, and the frame around it."""

from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest

import gelenk
from gelenk.client.show import MARKS
from gelenk.errors import InvalidField


def test_the_address_says_what_is_shown() -> None:
    picture = gelenk.show(
        "panda", (0.1, -0.2), tip_frame="tool & co", marks=("frames", "dh"), server="https://lab.example.org/g/docs"
    )
    address = urlsplit(picture.url)
    assert f"{address.scheme}://{address.netloc}{address.path}" == "https://lab.example.org/g/embed"
    assert parse_qs(address.fragment) == {
        "robot": ["panda"],
        "tip": ["tool & co"],
        "q": ["0.1,-0.2"],
        "show": ["frames,dh"],
    }


def test_a_notebook_gets_a_frame_and_a_link() -> None:
    found = gelenk.show('a"b<c', height=300)._repr_html_()
    assert found.startswith('<iframe src="http://127.0.0.1:8000/embed#robot=a%22b%3Cc" title="a&quot;b&lt;c"')
    assert 'height="300"' in found


@pytest.mark.parametrize(
    ("given", "refusal"),
    [
        ({"joint_positions": [0.0, float("nan")]}, "number 2 is not finite"),
        ({"marks": ["shadow"]}, f"'shadow' is none of {', '.join(MARKS)}"),
        ({"server": "lab"}, "'lab' is not the address of a service"),
    ],
)
def test_what_cannot_be_shown_is_refused(given: dict[str, Any], refusal: str) -> None:
    with pytest.raises(InvalidField, match=refusal):
        gelenk.show("panda", **given)
