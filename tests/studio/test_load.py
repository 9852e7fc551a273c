"""How the page loads: what is on the canvas when, which meshes it asks for, and what it no longer waits for."""

import io
import json
import time
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Route

from tests.studio.browser import Studio

HELD_FRAMES = """
const queue = [], now = requestAnimationFrame.bind(globalThis);
globalThis.isHeld = false;
globalThis.requestAnimationFrame = (draw) => (isHeld ? queue.push(draw) : now(draw));
globalThis.release = () => { isHeld = false; queue.splice(0).forEach((draw) => now(draw)); };
"""
"""Frames of the page that wait as on a busy machine, while the browser itself goes on showing what there is."""
BODY = '<visual><geometry><box size="0.2 0.2 1"/></geometry></visual>'
BARE = (
    f'<robot name="r"><link name="base">{BODY}</link><link name="tip"/><joint name="j" type="continuous">'
    '<parent link="base"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/></joint></robot>'
)
DRAWN = "studio.view.canvas.dataset.drawn"


def colours(studio: Studio) -> int:
    """How many colours the canvas shows: one where it is blank."""
    shown = Image.open(io.BytesIO(studio.page.locator("canvas").first.screenshot()))
    return len(shown.convert("RGB").getcolors(1 << 24) or [])


def upload(studio: Studio, name: str) -> None:
    call = {"method": "POST", "path": "v1/robots", "body": {"name": name, "urdf": BARE}}
    studio.run("(call) => studio.api.call(call)", call)


@pytest.mark.slow
def test_the_canvas_says_when_a_robot_has_been_drawn(studio: Studio) -> None:
    """A robot without meshes is loaded long before a busy machine draws it; a picture taken then is blank."""
    studio.open(robot="planar_2r")
    upload(studio, "drawn_late")
    studio.run(HELD_FRAMES + "; isHeld = true; studio.store.set({robot: 'drawn_late'})")
    studio.until("studio.store.value.model.name === 'drawn_late' && !studio.store.value.loading")
    assert studio.run(f"{DRAWN} ?? null") is None
    studio.run("release()")
    studio.until(f"{DRAWN} === 'drawn_late'")
    assert colours(studio) > 50


@pytest.mark.slow
def test_the_canvas_is_never_blank_while_its_size_changes(studio: Studio) -> None:
    """Another size wipes a canvas, as when remarks above it take another line; it is drawn in the same frame."""
    studio.open(robot="planar_2r")
    studio.until(f"{DRAWN} === 'planar_2r'")
    before = colours(studio)
    assert before > 50
    width = studio.run("studio.view.canvas.width")
    studio.run(HELD_FRAMES + "; isHeld = true")
    studio.page.set_viewport_size({"width": 1100, "height": 700})
    studio.until(f"studio.view.canvas.width !== {width}")
    assert colours(studio) > before / 2
    studio.run("release()")


@pytest.mark.slow
def test_the_panda_is_small(studio: Studio) -> None:
    """The bytes of the first visit, without those of headers: the page, its scripts, answers and meshes."""
    sizes: dict[str, int] = {}
    session = studio.page.context.new_cdp_session(studio.page)
    session.send("Network.enable")
    session.send("Network.setCacheDisabled", {"cacheDisabled": True})
    session.on("Network.loadingFinished", lambda event: sizes.update({event["requestId"]: event["encodedDataLength"]}))
    studio.open(robot="panda")
    assert studio.state("model")["meshes"]["failed"] == []
    assert 5e5 < sum(sizes.values()) < 2.5e6
    triangles = """(() => {
      let count = 0;
      studio.store.value.model.root.traverse((node) => node.isMesh && (count += node.geometry.index.count / 3));
      return count;
    })()"""
    assert 20_000 < studio.run(triangles) < 40_000
    session.detach()


@pytest.mark.slow
def test_meshes_of_a_robot_that_is_left_are_fetched_no_longer(studio: Studio) -> None:
    held: list[Route] = []
    aborted: list[str] = []
    studio.page.on("requestfailed", lambda request: aborted.append(request.url))

    def hold(route: Route) -> None:
        held.append(route)

    studio.page.route("**/panda/meshes/**", hold)
    studio.go("#panel=pose&robot=panda")
    studio.until("studio.store.value.model?.name === 'panda' && studio.view.canvas.dataset.drawn === 'panda'")
    assert studio.page.get_by_role("status").first.text_content() == "Meshes: 0 of 11, 0.0 MB …"
    assert studio.run("studio.view.countMeshes()") > 0, "until the meshes come, something moves"
    asked = len(held)
    assert 0 < asked <= 6
    studio.run("studio.store.set({robot: 'planar_2r'})")
    studio.wait_for_robot("planar_2r")
    deadline = time.monotonic() + 60
    while len(aborted) < asked:
        assert time.monotonic() < deadline, "they are still being fetched"
        studio.run("1")  # so that Playwright hears of them
    assert len(held) == asked, "and no others are begun"
    assert studio.run("studio.store.value.model.meshes.failed.length") == 0
    studio.page.unroute_all(behavior="ignoreErrors")


@pytest.mark.slow
def test_a_mesh_that_cannot_be_made_small_is_shown_as_it_is(studio: Studio) -> None:
    asked: list[str] = []

    def refuse(route: Route) -> None:
        accept = route.request.headers["accept"]
        asked.append(accept)
        problem: dict[str, Any] = {"title": "Too slow", "detail": "It takes too long."}
        if "gltf" in accept:
            route.fulfill(status=504, body=json.dumps(problem), content_type="application/problem+json")
        else:
            route.continue_()

    studio.page.route("**/talos_left_arm/meshes/**", refuse)
    studio.expected.add(504)
    studio.open(robot="talos_left_arm")
    assert studio.run("studio.store.value.model.meshes.failed.length") == 0
    assert asked.count("*/*") == len(asked) / 2
