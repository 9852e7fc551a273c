"""How the page loads: what is on the canvas when, which meshes it asks for, and what it no longer waits for."""

import contextlib
import io
import json
import re
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Error, Route, expect

from tests.oracles import catalogue
from tests.studio.browser import Studio
from tests.test_serve import get

HELD_FRAMES = """
const queue = [], now = requestAnimationFrame.bind(globalThis);
globalThis.isHeld = false;
globalThis.requestAnimationFrame = (draw) => (isHeld ? queue.push(draw) : now(draw));
globalThis.hold = () => new Promise((held) => { isHeld = true; now(held); });
globalThis.release = () => { isHeld = false; queue.splice(0).forEach((draw) => now(draw)); };
"""
"""Frames of the page that wait as on a busy machine, while the browser itself goes on showing what there is.

Those that were asked for before have come when `hold` is done.
"""
MARKS = """
globalThis.marks = [];
const { view } = studio, keep = (when) => marks.push(`${when}: ${view.canvas.dataset.drawn ?? "none"}`);
const show = view.show.bind(view);
view.show = (model) => { show(model); keep("put there"); view.before.add(() => keep("to be drawn")); };
"""
"""Which robot the canvas names right after another is put there, and right before that is drawn.

A frame, a timer and another size all draw, and whichever comes first on a busy machine is told.
"""
BODY = '<visual><geometry><box size="0.2 0.2 1"/></geometry></visual>'
BARE = (
    f'<robot name="r"><link name="base">{BODY}</link><link name="tip"/><joint name="j" type="continuous">'
    '<parent link="base"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/></joint></robot>'
)
AT_A_TIME = 6
"""As many meshes as the page asks for before one has come."""
DRAWN = "studio.view.canvas.dataset.drawn"
AT_REST = "studio.view.canvas.width === 2 * studio.view.canvas.clientWidth"
"""With frames held, nothing is drawn any more by a timer."""


def colours(studio: Studio) -> int:
    """How many colours the middle of the canvas shows, where no words are: one where it is blank."""
    shown = Image.open(io.BytesIO(studio.page.locator("canvas").first.screenshot()))
    middle = shown.crop((0, shown.height // 4, shown.width, 3 * shown.height // 4))
    return len(middle.convert("RGB").getcolors(1 << 24) or [])


def upload(studio: Studio, name: str) -> None:
    call = {"method": "POST", "path": "v1/robots", "body": {"name": name, "urdf": BARE}}
    studio.run("(call) => studio.api.call(call)", call)


@pytest.mark.slow
def test_the_canvas_says_when_a_robot_has_been_drawn(studio: Studio) -> None:
    """A robot without meshes is loaded long before a busy machine draws it; a picture taken then is blank."""
    studio.open(robot="planar_2r")
    upload(studio, "drawn_late")
    studio.run(MARKS + "; studio.store.set({robot: 'drawn_late'})")
    studio.until(f"{DRAWN} === 'drawn_late'")
    assert studio.run("marks")[:2] == ["put there: none", "to be drawn: none"]
    assert colours(studio) > 50


@pytest.mark.slow
def test_the_canvas_is_never_blank_while_its_size_changes(studio: Studio) -> None:
    """Another size wipes a canvas, as when remarks above it take another line; it is drawn in the same frame."""
    studio.open(robot="planar_2r")
    studio.run(HELD_FRAMES + "; hold()")
    studio.until(AT_REST)
    before = colours(studio)
    assert before > 50
    width = studio.run("studio.view.canvas.clientWidth")
    studio.page.set_viewport_size({"width": 1100, "height": 700})
    studio.until(f"studio.view.canvas.clientWidth !== {width}")
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
    expect(studio.page.get_by_role("status").first).to_have_text("Meshes: 0 of 11, 0.0 MB …")
    assert studio.run("studio.view.countMeshes()") > 0, "until the meshes come, something moves"
    studio.hear(held, AT_A_TIME)
    studio.run("studio.store.set({robot: 'planar_2r'})")
    studio.wait_for_robot("planar_2r")
    studio.hear(aborted, AT_A_TIME)
    assert len(held) == AT_A_TIME, "and no others are begun"
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


@pytest.mark.slow
def test_a_table_that_comes_late_does_not_replace_the_one_that_is_typed(studio: Studio) -> None:
    """Of a chain, which the service has to look for."""
    held: list[Route] = []
    studio.page.route(re.compile(r"/dh\?"), lambda route: held.append(route))  # noqa: PLW0108 - it takes no built-in
    studio.open("pose", robot="planar_2r", tip="frame_1", show="dh")
    studio.hear(held)
    typed = catalogue.dh_table("scara")
    studio.run("(draft) => studio.store.set({robot: '', draft, base: null, tip: null})", typed)
    studio.wait_for_robot(None)
    with contextlib.suppress(Error):  # the page has given it up
        held[0].fulfill(json=get(held[0].request.url)[1])
    studio.address()
    assert studio.state("table")["dh"] == typed


@pytest.mark.slow
def test_a_panel_that_fails_to_load_leaves_the_one_that_is_open_by_then(studio: Studio) -> None:
    held: list[Route] = []
    failed: list[str] = []
    studio.page.route("**/chunks/exercises-*", lambda route: held.append(route))  # noqa: PLW0108 - it takes no built-in
    studio.page.on("requestfailed", lambda request: failed.append(request.url))
    studio.open("exercises", robot="planar_2r")
    studio.hear(held)
    studio.page.get_by_role("tab", name="Pose").click()
    held[0].abort()
    studio.hear(failed)
    studio.drawn()
    expect(studio.field("joint_1")).to_be_visible()
    assert studio.page.locator(".problem:visible").count() == 0
    studio.complaints.clear()  # the console tells of it too
