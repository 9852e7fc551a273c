"""What a call gives is written into the page; what is not so, or not current, ends the build.

The handbook itself is compared and built by `./dev handbook`, a step of its own in `.ci/run`.
"""

import base64
import hashlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from docs.handbook.committed import SHOWN, renew
from docs.handbook.papers import print_papers
from docs.handbook.session import service
from gelenk.http.pages import HANDBOOK_POLICY

pytestmark = pytest.mark.slow

GOOD = """# Good

<!-- run digits=3 -->
```python
answer = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]])
print("x:", answer.poses[0].position[0])
answer.joint_names
```

It is 2<!-- 2 = len(answer.joint_names) --> joints, $\\dot q = -J^{-1}$, and

$$\\tau = J^{\\top}\\gamma$$

<!-- picture pictures/arm.svg -->
```python
gelenk.picture("v1/robots/planar_2r/manipulability", "svg", {"joint_positions": [[0.3, 0.8]]})
```

![An arm.](pictures/arm.svg)

<!-- picture pictures/curve.svg -->
```python
figure, axes = plt.subplots()
axes.plot(answer.poses[0].position)
figure
```

<!-- formula: [r"\\alpha", r"\\beta"] -->
<!-- end -->

<!-- run refused=unknown-robot -->
```python
gelenk.robot("nobody")
```

````markdown
<!-- run -->
```python
not_run()
```
````
"""

BAD = """# Bad

<!-- run -->
```python
gelenk.robot("nobody")
```

<!-- run refused=unknown-robot -->
```python
gelenk.robot("ur5").name
```

<!-- run -->
```python
1 / 0
```

<!-- run -->
```python
row = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
gelenk.add_robot(name="forgotten", dh={"convention": "standard", "joints": [row]}).name
```

Stated is 3<!-- 3 = 1 + 1 -->, and 1<!-- 1 = unheard --> and<!-- 17 = 17 -->
and <!-- 1 = gelenk.fk("ur5", joint_positions=[[0.0]]) -->.

<!-- picture no.svg -->
```python
b"text"
```
"""
FAULTS = (
    "line 3: the service refuses it, unknown-robot",
    "the service refuses it, wrong-joint-count",
    "it is answered where unknown-robot should refuse it",
    "ZeroDivisionError",
    "stated is '3', and the call gives 2",
    "NameError: name 'unheard' is not defined",
    "17 does not stand in the section above",
    "it gives no picture",
    "it leaves robots behind: forgotten",
)
UNSOUND = """# Unsound

A formula: $$\\begin{pmatrix} 1$$
"""


def test_a_page_gets_what_its_calls_give_and_then_it_is_current(tmp_path: Path) -> None:
    page = tmp_path / "good.md"
    page.write_text(GOOD)
    assert [fault.partition(" is not")[0] for fault in renew([page], write=False)] == [
        str(page),
        str(tmp_path / "pictures" / "arm.svg"),
        str(tmp_path / "pictures" / "curve.svg"),
    ]
    assert page.read_text() == GOOD
    assert list(renew([page], write=True)) == []
    text = page.read_text()
    assert "```\n\n```text\nx: 1.27\n[joint_1, joint_2]\n```\n" in text
    assert "```text\nUnknownRobot: " in text
    assert "$$\n\\alpha\n$$\n\n$$\n\\beta\n$$" in text
    assert text.endswith(GOOD[GOOD.index("````markdown") :])
    assert list(renew([page], write=False)) == []
    assert "curl" not in text
    assert SHOWN[page.resolve()].count('<div class="tabs">') == 3
    assert "curl -s http://127.0.0.1:8000/v1/robots/nobody\n" in SHOWN[page.resolve()]

    page.write_text(text.replace("x: 1.27", "x: 1.28"))
    assert list(renew([page], write=False)) == [f"{page} is not current: ./dev handbook --write"]
    page.write_text(text.replace("x: 1.27", "x: 1.2700001"))
    assert list(renew([page], write=False)) == []


def test_what_is_not_so_is_named(tmp_path: Path) -> None:
    page = tmp_path / "bad.md"
    page.write_text(BAD)
    try:
        found = "\n".join(renew([page], write=False))
    finally:
        service().remove_robot("forgotten")
    assert [fault for fault in FAULTS if fault not in found] == []


def built(tmp_path: Path, **pages: str) -> tuple[int, str, Path]:
    """The exit code of a build of some pages, what it complains of, and where its output is."""
    sources, output = tmp_path / "docs", tmp_path / "output"
    sources.mkdir()
    for name, page in pages.items():
        (sources / f"{name}.md").write_text(page)
    # Sphinx keeps to itself what the process has set up; so each build has one of its own.
    code = (
        "import sys, pathlib; from docs.handbook import __main__ as handbook, committed; "
        "sources, output = map(pathlib.Path, sys.argv[1:]); "
        "committed.SHOWN[sources / 'other.md'] = '# Other, as it is shown'; sys.exit(handbook.build(sources, output))"
    )
    run = subprocess.run([sys.executable, "-c", code, sources, output], capture_output=True, text=True, check=False)
    return run.returncode, run.stderr, output


def test_a_page_is_built_and_in_the_navigation_by_the_list_of_the_first(tmp_path: Path) -> None:
    index = "# First\n\n## Part\n\n- [Other](other.md)\n\n$J^{\\top}\\gamma$ and $J^{\\top}\\tau$"
    code, complaints, output = built(tmp_path, index=index, other="# Other")
    assert (code, complaints) == (0, "")
    assert "Other, as it is shown" in (output / "other.html").read_text()
    text = (output / "index.html").read_text()
    assert '<span class="caption-text">Part</span>' in text
    glyphs = re.findall(r'<symbol id="([^"]+)"', text)
    assert len(glyphs) == len(set(glyphs)) > 2
    for page in output.rglob("*.html"):
        for script in re.findall(r"<script>(.*?)</script>", page.read_text(), re.DOTALL):
            digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
            assert f"'sha256-{digest}'" in HANDBOOK_POLICY, f"the service's policy would keep {script} from running"


def test_what_is_unsound_ends_the_build(tmp_path: Path) -> None:
    code, complaints, _ = built(tmp_path, index=UNSOUND, hidden="# Hidden")
    assert code != 0
    faults = ("cannot be set", "isn't included in any toctree")
    assert [fault for fault in faults if fault not in complaints] == []


@pytest.mark.skipif(shutil.which("chromium") is None, reason="there is no Chromium: apt-get install chromium")
def test_the_formula_sheet_fills_two_pages(tmp_path: Path) -> None:
    sheet = Path("docs/course/formula-sheet.md").read_text(encoding="utf-8").replace("(corrections.md)", "(index.md)")
    code, complaints, output = built(tmp_path, index="# First\n\n## Part\n\n- [Sheet](sheet.md)", sheet=sheet)
    assert (code, complaints) == (0, "")
    assert list(print_papers(output)) == []
    assert 'href="sheet.pdf"' in (output / "sheet.html").read_text()
    assert len(re.findall(rb"/Type /Page\b", (output / "sheet.pdf").read_bytes())) == 2
