"""Small handbooks are built: what a call gives is in the page, and what is not so ends the build.

The handbook itself is built and looked through by `./dev handbook`, a step of its own in `.ci/run`.
"""

import re
import subprocess
import sys
from html import unescape
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

GOOD = """# Good

```{run}
:digits: 3
answer = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]])
print("x:", answer.poses[0].position[0])
answer.joint_names
```

It is {is}`2 = len(answer.joint_names)` joints, $\\dot q = -J^{-1}$, and

$$\\tau = J^{\\top}\\gamma$$

```{picture}
:alt: An arm & its ellipses.
gelenk.picture("v1/robots/planar_2r/manipulability", "svg", {"joint_positions": [[0.3, 0.8]]})
```

```{picture}
:alt: A curve from 0.3 over {is}`2 = len(answer.joint_names)` joints.
:caption: At {is}`1.27 = answer.poses[0].position[0]` m.
start = 0.3
figure, axes = plt.subplots()
axes.plot(answer.poses[0].position)
figure
```

```{run}
:refused: unknown-robot
gelenk.robot("nobody")
```

::::{exercise} Twice
:::{answer} 2.55
:is: twice
:unit: m
```{run}
twice = 2.0 * answer.poses[0].position[0]
```
:::
::::
"""

BAD = """# Bad

```{run}
gelenk.robot("nobody")
```

```{run}
:refused: unknown-robot
gelenk.robot("ur5").name
```

```{run}
1 / 0
```

```{run}
row = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
gelenk.add_robot(name="forgotten", dh={"convention": "standard", "joints": [row]}).name
```

Stated is {is}`3 = 1 + 1`, and {is}`nothing`, and {is}`1 = unheard`,
and {is}`1 = gelenk.fk("ur5", joint_positions=[[0.0]])`, and a [dead link](nowhere.md).

```{picture}
:alt: No picture.
b"text"
```

```{picture}
:alt: A current of {is}`18 = 19.0` A.
plt.figure()
```

```{picture}
:alt: A curve.
:caption: It ends at 42.
plt.figure()
```

:::{answer} 5
:is: 2 + 2
:::

$$\\begin{pmatrix} 1$$
"""
FAULTS = (
    "the service refuses it, unknown-robot",
    "the service refuses it, wrong-joint-count",
    "it is answered where unknown-robot should refuse it",
    "ZeroDivisionError",
    "stated is '3', and the call gives 2",
    "'nothing' should be a value, =, and an expression",
    "NameError: name 'unheard' is not defined",
    "nowhere.md",
    "it gives no picture",
    "stated is '18', and the call gives 19",
    "42 in the picture's text should be {is}`value = expression`",
    "stated is '5', and the call gives 4",
    "it leaves robots behind: forgotten",
    "cannot be set",
    "isn't included in any toctree",
)


def built(tmp_path: Path, **pages: str) -> tuple[int, str, Path]:
    """The exit code of a build of some pages, what it complains of, and where its output is."""
    sources, output = tmp_path / "docs", tmp_path / "output"
    sources.mkdir()
    for name, page in pages.items():
        (sources / f"{name}.md").write_text(page)
    # Sphinx keeps to itself what the process has set up; so each build has one of its own.
    code = "import sys, pathlib, docs.handbook.__main__ as h; sys.exit(h.build(*map(pathlib.Path, sys.argv[1:])))"
    run = subprocess.run([sys.executable, "-c", code, sources, output], capture_output=True, text=True, check=False)
    return run.returncode, run.stderr, output


def test_a_page_has_what_its_calls_give(tmp_path: Path) -> None:
    code, complaints, output = built(tmp_path, index=GOOD)
    assert (code, complaints) == (0, "")
    text = (output / "index.html").read_text()
    words = unescape(re.sub(r"<[^>]+>", "", text))
    assert "x: 1.27" in words
    assert "[joint_1, joint_2]" in words
    assert "UnknownRobot: " in words
    assert "It is 2 joints" in words
    assert "2.55 m" in words
    assert "curl -s http://127.0.0.1:8000/v1/robots/planar_2r/fk -H 'Content-Type: application/json'" in words
    assert 'alt="An arm &amp; its ellipses."' in text
    assert 'alt="A curve from 0.3 over 2 joints."' in text
    assert "At 1.27 m." in words
    pictures = re.findall(r'src="(_pictures/[^"]+)"', text)
    assert len(pictures) == 2
    assert all((output / picture).read_bytes().startswith(b"<?xml") for picture in pictures)
    glyphs = re.findall(r'<symbol id="([^"]+)"', text)
    assert len(glyphs) == len(set(glyphs)) > 5


def test_what_is_not_so_ends_the_build(tmp_path: Path) -> None:
    code, complaints, _ = built(tmp_path, index=BAD, hidden="# Hidden")
    assert code != 0
    assert [fault for fault in FAULTS if fault not in complaints] == []
