"""The studio's first visit at 10 Mbit/s, and what dragging costs, in a headless Chromium that draws by software.

Every visit has an empty cache. The very first one also finds nothing prepared on the service.
"""

import gzip
import math
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np
from playwright.sync_api import Browser, sync_playwright

from gelenk.package_data import studio as bundle
from tests.benchmarks.table import Row
from tests.studio.browser import ARGUMENTS, Pages, Studio, chromium
from tests.studio.inverse import SOLVED, START
from tests.studio.test_ik_motion import HANDLE
from tests.test_serve import service

VISITS = 3
BYTES_PER_SECOND = 10e6 / 8
LATENCY_MS = 20
MOVES = 30
WATCH_TASKS = """globalThis.tasks = [];
new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({duration}) => duration)))
  .observe({type: "longtask"})"""
WATCH_JOINTS = """(() => {
  globalThis.waits = [];
  const {store} = studio, set = store.set.bind(store);
  let moved = null;
  addEventListener("pointermove", () => (moved ??= performance.now()), {capture: true});
  store.set = (change) => {
    set(change);
    if (!("positions" in change) || moved === null) return;
    waits.push(performance.now() - moved);
    moved = null;
  };
})()"""
NEXT_FRAME = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(tasks.splice(0)))))"
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0]?.startTime"


class Visit(NamedTuple):
    """What a visit took until the Panda was on the screen with its meshes: [bytes], number, [s]."""

    bytes: float
    requests: int
    painted: float
    usable: float
    complete: float


def measure() -> list[Row]:
    """Visits, then drags of a joint and of the target of inverse kinematics."""
    with tempfile.TemporaryDirectory() as data, service(Path(data)) as (_, url), browser() as launched:
        visits = [visit(launched, url) for _ in range(VISITS + 1)]
        tasks, waits = drags(launched, url)
    first, later = visits[0], [median(column) for column in zip(*visits[1:], strict=True)]
    size, packed = bundle_bytes()
    return [
        Row("studio, bytes until the Panda is drawn", f"{later[0] / 1e6:.2f} MB", wanted="≤ 2.5 MB"),
        Row("studio, requests until then", f"{later[1]:.0f}"),
        Row("studio, first contentful paint", f"{later[2]:.2f} s", wanted="≤ 0.5 s"),
        Row("studio, usable: the robot is there and its joints move", f"{later[3]:.2f} s", wanted="≤ 3 s"),
        Row("studio, all meshes drawn", f"{later[4]:.2f} s"),
        Row("studio, all meshes drawn, first visit to a new service", f"{first.complete:.2f} s"),
        Row("studio, longest task of a move while dragging, 95th percentile", tasks, wanted="≤ 50 ms"),
        Row("studio, from pointer to joints by inverse kinematics, median", waits, wanted="≤ 20 ms"),
        Row("studio, main bundle", f"{size / 1e6:.2f} MB", f"{packed / 1e6:.2f} MB by gzip", wanted="≤ 1.1 MB"),
    ]


@contextmanager
def browser() -> Iterator[Browser]:
    """A Chromium as the tests have it."""
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        yield launched
        launched.close()


def visit(launched: Browser, url: str) -> Visit:
    """Open the page in a profile of its own, with a connection of 10 Mbit/s."""
    pages = Pages(launched)
    studio = Studio(pages.take(), url)
    studio.begin(width=1440, height=900)
    session = studio.page.context.new_cdp_session(studio.page)
    session.send("Network.enable")
    limits = {"downloadThroughput": BYTES_PER_SECOND, "uploadThroughput": BYTES_PER_SECOND, "latency": LATENCY_MS}
    session.send("Network.emulateNetworkConditions", {"offline": False, **limits})
    sizes: list[float] = []
    session.on("Network.loadingFinished", lambda event: sizes.append(event["encodedDataLength"]))
    studio.page.goto(f"{url}/#robot=panda")
    studio.until("studio.store.value.model && !studio.store.value.loading")
    usable = studio.run(NEXT_DRAWN)
    studio.wait_for_robot("panda")
    complete = studio.run(NEXT_DRAWN)
    found = Visit(sum(sizes), len(sizes), studio.run(PAINTED) / 1e3, usable / 1e3, complete / 1e3)
    studio.page.context.close()
    return found


NEXT_DRAWN = """new Promise((done) =>
  requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now()))))"""


def drags(launched: Browser, url: str) -> tuple[str, str]:
    """The longest task of each move of a joint's slider, and how long the joints take after the pointer; as text."""
    studio = Studio(Pages(launched).take(), url)
    studio.begin(width=1440, height=900)
    studio.open("pose", robot="panda")
    box = studio.field("panda_joint1").bounding_box()
    assert box is not None
    studio.run(WATCH_TASKS)
    mouse, y = studio.page.mouse, box["y"] + box["height"] / 2
    mouse.move(box["x"] + box["width"] * 0.2, y)
    mouse.down()
    longest = []
    for step in range(MOVES):
        mouse.move(box["x"] + box["width"] * (0.2 + 0.6 * step / MOVES), y)
        longest.append(max(studio.run(NEXT_FRAME), default=0.0))
    mouse.up()
    tail = float(np.percentile(longest, 95))
    studio.open("ik", robot="panda", q=START)
    studio.until(SOLVED)
    studio.run(WATCH_JOINTS)
    start, end = studio.run(HANDLE, [2, 0]), studio.run(HANDLE, [2, 0.1])
    mouse.move(*start)
    mouse.down()
    for step in range(MOVES):
        part = math.sin(2 * math.pi * step / MOVES) / 2
        mouse.move(*(np.array(start) + (np.array(end) - start) * part))
        studio.run(NEXT_DRAWN)
    mouse.up()
    waits = studio.run("waits")
    return f"{tail:.0f} ms" if tail else "< 50 ms", f"{median(waits):.0f} ms" if waits else "none moved"


def bundle_bytes() -> tuple[int, int]:
    """What the page loads at once of its own scripts, [bytes], as they are and compressed."""
    chunks = re.findall(r'href="studio/(chunks/[^"]+)"', (bundle() / "index.html").read_text())
    contents = [(bundle() / name).read_bytes() for name in ("studio.js", *chunks)]
    return sum(map(len, contents)), sum(len(gzip.compress(content)) for content in contents)
