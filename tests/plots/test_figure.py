"""What all pictures share."""

import subprocess
import sys
import threading
from pathlib import Path

import pytest

from gelenk.plots.figure import TEXT, as_bytes, font, metric_axes, new_figure, plain, write

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("panda_link0", "panda_link0"),
        ("a$b$\\frac", "a$b$\\frac"),
        ("机器人", "???"),
        ("a\nb\x00", "a?b?"),
        ("x" * 100, "x" * 47 + "…"),
        ("größe", "größe"),
    ],
)
def test_names_are_what_the_typeface_has(name: str, shown: str) -> None:
    assert plain(name) == shown


def test_text_is_never_mathematics() -> None:
    figure = new_figure(2.0, 1.0)
    write(figure, 0.1, 0.9, ["$\\notamacro{$ $x^2$"])
    assert as_bytes(figure, "svg").startswith(b"<?xml")


def test_a_pdf_holds_its_typeface_and_no_moment() -> None:
    """So it is the same file each time; its text can be searched, and looks the same elsewhere."""

    def drawn() -> bytes:
        figure = new_figure(2.0, 1.0)
        write(figure, 0.1, 0.9, ["φ = 30°"])
        return as_bytes(figure, "pdf")

    found = drawn()
    assert found.startswith(b"%PDF-1.")
    assert found == drawn()
    assert b"/FontDescriptor" in found and b"DejaVuSans" in found
    assert b"CreationDate" not in found


def test_threads_draw_the_same_bytes_as_one_alone() -> None:
    def draw(scale: float) -> bytes:
        figure = new_figure(3.0, 3.0)
        axes = figure.add_axes((0.2, 0.2, 0.7, 0.7))
        metric_axes(axes, "x / m", "y / m")
        axes.plot([0.0, scale], [0.0, 1.0])
        return as_bytes(figure, "svg")

    expected = [draw(float(scale)) for scale in range(1, 5)]
    found: dict[int, bytes] = {}
    threads = [threading.Thread(target=lambda i=i: found.update({i: draw(float(i + 1))})) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [found[i] for i in range(4)] == expected


@pytest.mark.slow
def test_pyplot_is_never_loaded_and_the_service_starts_without_matplotlib() -> None:
    code = "import sys, {}; print('matplotlib' in sys.modules, 'matplotlib.pyplot' in sys.modules)"
    for module, expected in (("gelenk.main", "False False"), ("gelenk.plots.ellipsoids", "True False")):
        answer = subprocess.run(
            [sys.executable, "-c", code.format(module)], cwd=ROOT, capture_output=True, text=True, check=True
        )
        assert answer.stdout.strip() == expected


def test_one_type_scale() -> None:
    assert font().get_size_in_points() == TEXT
