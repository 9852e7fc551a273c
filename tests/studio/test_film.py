"""A planned motion as a film, read again by other programs: Pillow, the browser's player, a reader of Matroska here."""

import io
import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence
from playwright.sync_api import Route, expect

from tests.studio.browser import Studio
from tests.studio.pure import values
from tests.studio.test_trajectory import add, plan

PERIOD = 0.04
MASTERS = {0x18538067, 0x1549A966, 0x1654AE6B, 0xAE, 0xE0, 0x1F43B675, 0x1C53BB6B, 0xBB, 0xB7}
"""Elements that contain others: segment, information, tracks, track, video, cluster, cues."""
DURATION, CODEC, WIDTH, START, BLOCK, PLACE = 0x4489, 0x86, 0xB0, 0xE7, 0xA3, 0xF1


def elements(data: bytes, start: int = 0) -> Iterator[tuple[int, int, bytes]]:
    """Name, place and content of each element of a Matroska file, those inside others too."""
    at = 0
    while at < len(data):
        place, name_length = start + at, 9 - data[at].bit_length()
        name = int.from_bytes(data[at : at + name_length])
        at += name_length
        size_length = 9 - data[at].bit_length()
        size = int.from_bytes(data[at : at + size_length]) & ((1 << (7 * size_length)) - 1)
        at += size_length
        content = data[at : at + size]
        assert len(content) == size
        yield name, place, content
        if name in MASTERS:
            yield from elements(content, start + at)
        at += size


def rgba(pictures: np.ndarray) -> str:
    """Pictures of [r, g, b] as the page has them, in JavaScript."""
    opaque = np.dstack([pictures, np.full((*pictures.shape[:2], 1), 255)])
    return json.dumps(opaque.astype(int).ravel().tolist())


def gifs(*films: tuple[list[np.ndarray], int]) -> list[Image.Image]:
    """What the page's encoder makes of pictures, each shown for so many hundredths, as Pillow reads it."""
    made = "((all, width, height, delay) => { const gif = new m.Gif(width, height, delay, new m.Palette(all)); "
    made += "for (const each of all) gif.add(each); return [...gif.end()]; })"
    calls = []
    for pictures, delay in films:
        height, width = pictures[0].shape[:2]
        calls.append(f"{made}([{','.join(map(rgba, pictures))}], {width}, {height}, {delay})")
    return [Image.open(io.BytesIO(bytes(data))) for data in values("film/gif.ts", calls)]


def frames(image: Image.Image) -> list[np.ndarray]:
    return [np.asarray(frame.convert("RGB"), dtype=int) for frame in ImageSequence.Iterator(image)]


def test_pillow_reads_the_pictures_of_a_gif() -> None:
    """Few colours come back as they are, also where the next picture changes only a part; many come near."""
    rng = np.random.default_rng(4)
    colours = rng.integers(0, 256, (40, 3))
    noise = [colours[rng.integers(0, 40, (90, 70))] for _ in range(2)]  # more runs than there are codes
    part = noise[1].copy()
    part[20:40, 10:30] = colours[0]
    ramp = np.stack(np.broadcast_arrays(np.arange(128)[:, None] * 2, np.arange(96)[None] * 2, 77), axis=-1)
    plain = np.full((3, 5, 3), 201)
    read, many, one = gifs(([*noise, part, part], 7), ([ramp], 4), ([plain], 4))
    assert read.info["loop"] == 0
    assert [frame.info["duration"] for frame in ImageSequence.Iterator(read)] == [70] * 4
    for frame, wanted in zip(frames(read), [*noise, part, part], strict=True):
        assert np.abs(frame - wanted).max() <= 7  # of colours that share their first five bits
    [seen] = frames(many)
    assert np.sqrt(((seen - ramp) ** 2).sum(-1)).max() < 24
    assert (frames(one)[0] == plain).all()


def test_a_picture_for_each_period_and_for_the_end() -> None:
    found = values("film/film.ts", [f"m.timesOf({duration})" for duration in (0, 0.04, 0.1, 1, 3.08)])
    assert found[0] == [0, 0]
    assert found[1] == [0, 0.04]
    assert found[2] == pytest.approx([0, 0.04, 0.08, 0.1])
    for times, duration in zip(found[3:], (1, 3.08), strict=True):
        assert len(times) == round(duration / PERIOD) + 1
        assert times[-1] == duration


def motion(studio: Studio) -> float:
    """A planned motion; how long it is, [s]."""
    studio.open("trajectory", robot="planar_2r", q="0.2,0.4")
    add(studio, "Joint target", [1.4, 1.2])
    return float(plan(studio)["duration"])


def filmed(studio: Studio, form: str) -> bytes:
    """Press the button, and wait for the file."""
    with studio.page.expect_download(timeout=240_000) as download:
        studio.button(form).click()
    assert download.value.suggested_filename == f"planar_2r.{form.lower()}"
    return Path(download.value.path()).read_bytes()


@pytest.mark.slow
def test_a_motion_as_a_gif(studio: Studio) -> None:
    duration = motion(studio)
    studio.field("Time in the motion").fill("0.3")
    before = studio.state("positions")
    read = Image.open(io.BytesIO(filmed(studio, "GIF")))
    pictures = frames(read)
    count = math.ceil(duration / PERIOD - 1e-9) + 1
    assert len(pictures) == count
    assert {frame.info["duration"] for frame in ImageSequence.Iterator(read)} == {1000 * PERIOD}
    changed = (np.abs(pictures[0] - pictures[-1]).max(-1) > 60).mean()
    assert 0.002 < changed < 0.5  # the arm, not the ground
    assert max(read.size) <= 640
    expect(studio.page.locator(".filming [role=status]")).to_contain_text(f"planar_2r.gif: {count} pictures, ")
    assert studio.state("positions") == before


@pytest.mark.slow
def test_a_motion_as_a_webm(studio: Studio) -> None:
    """Its blocks are at the times of the motion; the browser plays it, and its ends differ as those of the motion."""
    duration = motion(studio)
    if not studio.run("'VideoEncoder' in globalThis"):
        pytest.skip("this Chromium compresses no videos")
    data = filmed(studio, "WebM")
    found = list(elements(data))
    count = math.ceil(duration / PERIOD - 1e-9) + 1
    start, times = 0, []
    for name, _, content in found:
        if name == START:
            start = int.from_bytes(content)
        if name == BLOCK:
            times.append(start + int.from_bytes(content[1:3], signed=True))
    assert times == [round(1000 * i * PERIOD) for i in range(count)]
    assert [content for name, _, content in found if name == CODEC] == [b"V_VP8"]
    segment = next(place for name, place, _ in found if name == 0x18538067) + 12
    clusters = [place - segment for name, place, _ in found if name == 0x1F43B675]
    assert [int.from_bytes(content) for name, _, content in found if name == PLACE] == clusters

    studio.page.goto("about:blank")
    shown = studio.run(
        """async (data) => {
          const video = document.createElement("video");
          const on = (event) => new Promise((done, fail) => {
            video.addEventListener(event, done, {once: true});
            video.addEventListener("error", () => fail(video.error.message), {once: true});
          });
          const loaded = on("loadeddata");
          video.src = URL.createObjectURL(new Blob([new Uint8Array(data)], {type: "video/webm"}));
          await loaded;
          const canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
          const context = canvas.getContext("2d", {willReadFrequently: true});
          const pixels = [];
          for (const time of [0, video.duration - 0.02]) {
            const there = on("seeked");
            video.currentTime = time;
            await there;
            context.drawImage(video, 0, 0);
            pixels.push(context.getImageData(0, 0, canvas.width, canvas.height).data);
          }
          let changed = 0;
          for (let i = 0; i < pixels[0].length; i += 4)
            changed += [0, 1, 2].some((part) => Math.abs(pixels[0][i + part] - pixels[1][i + part]) > 60);
          return {duration: video.duration, changed: changed / (canvas.width * canvas.height)};
        }""",
        list(data),
    )
    assert shown["duration"] == pytest.approx(count * PERIOD, abs=1e-3)
    assert 0.002 < shown["changed"] < 0.5


@pytest.mark.slow
def test_a_film_is_cancelled(studio: Studio) -> None:
    """Nothing is saved, the arm goes back to where it was, and the next film can begin."""
    motion(studio)
    held: list[Route] = []

    def hold(route: Route) -> None:
        held.append(route)

    studio.page.route("**/chunks/film-*", hold)
    studio.field("Time in the motion").fill("0.3")
    before = studio.state("positions")
    with studio.page.expect_request("**/chunks/film-*"):
        studio.button("GIF").click()
    expect(studio.page.get_by_role("progressbar", name="Pictures drawn")).to_be_visible()
    studio.button("Cancel").press("Enter")
    held[0].continue_()
    expect(studio.page.locator(".filming [role=status]")).to_have_text("Cancelled.")
    expect(studio.button("Cancel")).to_be_hidden()
    assert studio.state("positions") == before
    assert len(filmed(studio, "GIF")) > 1000
