"""The page at each size in both themes, a sheet a panel: `python -m tests.studio.contact_sheet FOLDER [PANEL …]`.

The sheets are looked at by eye before a change of looks is called good; they are not kept.
"""

import io
import json
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from tests.studio.browser import ARGUMENTS, Pages, Studio, chromium
from tests.studio.pictures import PICTURES
from tests.test_serve import service

SIZES = [(390, 844), (720, 450), (1024, 768), (1440, 900), (1920, 1080)]
"""A telephone, a laptop at 200 %, a tablet, a laptop and a projector."""
WIDTH = 2000  # of a sheet
SCALE = 0.6
GAP = 8

WRIST = {"robot": "anthropomorphic_wrist", "q": "0.4,0.9,-1.2,0.3,0.7,0.2"}
TABLE = {"type": "box", "size": [0.8, 0.8, 0.04]}
OBJECTS = [
    {"name": "table", "shape": TABLE, "pose": {"position": [0.7, 0.0, 0.0], "rpy": [0, 0, 0]}},
    {
        "name": "post",
        "shape": {"type": "cylinder", "radius": 0.05, "length": 0.7},
        "pose": {"position": [0.45, 0.3, 0.35], "rpy": [0, 0, 0]},
    },
]


def start(studio: Studio) -> None:
    """The choice of robots, as a first visitor sees it."""
    studio.go("")
    studio.until("document.querySelectorAll('.door').length > 5")


def joints(studio: Studio) -> None:
    """An arm with the frames and the dimensions of its table."""
    studio.open("pose", **WRIST, show="dh,dimensions")


def robot(studio: Studio) -> None:
    """The catalogue, and an arm with meshes."""
    studio.open("robot", robot="ur5e", q="0.6,-1.3,1.5,-1.8,-1.57,0")


def table(studio: Studio) -> None:
    """The DH table as fields."""
    studio.open("robot", **WRIST, show="dh")
    studio.button("DH table").click()
    studio.until("studio.store.value.table")


def construction(studio: Studio) -> None:
    """How the frames come about, in both conventions."""
    table(studio)
    studio.button("Construction").click()
    studio.page.locator(".construction-build").nth(1).wait_for()


def cell(studio: Studio) -> None:
    """Objects around an arm, one of which it touches."""
    studio.open("cell", robot="panda", q="0.5,-0.4,0,-2.2,0,1.9,0.785,0.02", objects=json.dumps(OBJECTS))
    studio.until("studio.store.value.contacts")


def compare(studio: Studio) -> None:
    """The two conventions of an arm beside each other."""
    studio.open("compare", **WRIST)
    studio.until("document.querySelectorAll('.compare [data-tone]').length === 2")


def workspace(studio: Studio) -> None:
    """What an arm reaches."""
    studio.open("workspace", robot="scara", q="0.5,0.9,0.08,0")


def course(studio: Studio) -> None:
    """A calculator with its picture."""
    studio.open("course", robot="planar_2r", **{"course.task": "orientation"})
    studio.page.locator(".course-facts dd").first.wait_for()


def exercises(studio: Studio) -> None:
    """The list of exercises."""
    studio.open("exercises", robot="planar_2r")
    studio.page.locator(".exercise").first.wait_for()


def present(studio: Studio) -> None:
    """Large type for a room."""
    joints(studio)
    studio.button("Present").click()


def embedded(studio: Studio) -> None:
    """The picture alone, for another page."""
    studio.go("embed#robot=panda&q=0.4,-0.3,0,-2,0,1.9,0.8,0.02&show=frames")
    studio.wait_for_robot("panda")


PANELS: dict[str, Callable[[Studio], None]] = {
    **{made.__name__: made for made in (start, robot, table, construction, joints)},
    **{name: prepare for name, (prepare, _) in PICTURES.items()},
    **{made.__name__: made for made in (cell, compare, workspace, course, exercises, present, embedded)},
}


def shots(pages: Pages, url: str, prepare: Callable[[Studio], None], scheme: str) -> Iterator[Image.Image]:
    """A panel at every size."""
    for size in SIZES:
        studio = Studio(pages.take(), url)
        studio.begin(*size, scheme)
        studio.page.emulate_media(color_scheme=scheme, reduced_motion="reduce")  # type: ignore[arg-type]
        prepare(studio)
        studio.page.wait_for_timeout(1500)  # what is still on its way is drawn
        yield Image.open(io.BytesIO(studio.page.screenshot()))
        studio.end()
        pages.give_back(studio.page)


def sheet(pictures: list[Image.Image]) -> Image.Image:
    """All of them on one, in rows."""
    sizes = [(round(one.width * SCALE), round(one.height * SCALE)) for one in pictures]
    small = [one.resize(size, Image.Resampling.LANCZOS) for one, size in zip(pictures, sizes, strict=True)]
    places, x, y, below = [], 0, 0, 0
    for one in small:
        if x and x + one.width > WIDTH:
            x, y = 0, below + GAP
        places.append((x, y))
        x, below = x + one.width + GAP, max(below, y + one.height)
    made = Image.new("RGB", (max(x + one.width for (x, _), one in zip(places, small, strict=True)), below), "#888")
    for place, one in zip(places, small, strict=True):
        made.paste(one, place)
    return made


def main(folder: Path, wanted: list[str]) -> None:
    """Take those that are named, or all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as data, service(Path(data)) as (_, url), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        pages = Pages(browser)
        for name in wanted or PANELS:
            for scheme in ("light", "dark"):
                sheet(list(shots(pages, url, PANELS[name], scheme))).save(folder / f"{name}-{scheme}.png")
                print(name, scheme, flush=True)
        browser.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
