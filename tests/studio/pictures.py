"""The README's pictures of the studio, taken anew: `python -m tests.studio.pictures` after the page has changed.

They are looked at by eye before they are committed: software draws them, and no test compares pixels.
"""

import json
import tempfile
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.studio.browser import ARGUMENTS, Pages, Studio, chromium
from tests.test_serve import service

FOLDER = Path(__file__).parents[2] / "app" / "studio" / "pictures"
SIZE = (1280, 800)

UR5_TARGET = {"position": [-0.4, 0.15, 0.45], "rpy": [3.0, 0.2, 0.4]}
PANDA = "0.3,0.35,-0.2,-1.9,0.2,2.1,0.9,0.02"


def inverse(studio: Studio) -> None:
    """All branches of a target, as ghosts."""
    options = json.dumps({"solutions": "all"})
    studio.open("ik", robot="ur5", target=json.dumps(UR5_TARGET), ik=options, q="0,-1.2,1.4,-0.7,0.5,0.3")
    studio.until("document.querySelectorAll('.solution').length > 1")


def jacobian(studio: Studio) -> None:
    """Ellipsoids at the tip, and the matrix."""
    studio.open("jacobian", robot="panda", q=PANDA)
    studio.until("document.querySelectorAll('.jacobian td').length > 40")


def trajectory(studio: Studio) -> None:
    """A motion of joints and lines, with its profiles."""
    studio.open("trajectory", robot="panda", q="0,-0.785,0,-2.356,0,1.571,0.785,0.02")
    for moved, segment in (
        ({"panda_joint1": 0.6, "panda_joint2": -0.4, "panda_joint4": -2.2}, "Joint target"),
        ({"panda_joint1": 0.1, "panda_joint2": 0.0, "panda_joint4": -2.0}, "Line"),
    ):
        studio.run("(moved) => studio.store.set({positions: {...studio.store.value.positions, ...moved}})", moved)
        studio.button(segment).click()
    studio.button("Plan").click()
    studio.until("studio.store.value.plan")


def worked(studio: Studio) -> None:
    """The Jacobian of the anthropomorphic arm, symbols beside numbers."""
    studio.open("worked", robot="anthropomorphic", worked="jacobian", q="0.3,0.6,-0.8", show="dh")
    studio.until("document.querySelector('.sheet .katex')")


PICTURES: dict[str, tuple[Callable[[Studio], None], str]] = {
    "inverse": (inverse, "light"),
    "jacobian": (jacobian, "dark"),
    "trajectory": (trajectory, "light"),
    "worked": (worked, "light"),
}


def main() -> None:
    """Take all of them."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as data, service(Path(data)) as (_, url), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        pages = Pages(browser)
        for name, (prepare, scheme) in PICTURES.items():
            studio = Studio(pages.take(), url)
            studio.begin(*SIZE, scheme)
            prepare(studio)
            studio.page.wait_for_timeout(2000)  # what is still on its way is drawn
            studio.page.screenshot(path=FOLDER / f"{name}.png")
            pages.give_back(studio.page)
        browser.close()


if __name__ == "__main__":
    main()
