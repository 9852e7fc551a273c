"""The Trajectory panel: a motion is built from poses of the arm, planned, played and judged."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from playwright.sync_api import Route

from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table
from tests.studio.test_page import AXE, CUT_OFF
from tests.test_serve import get

HOME = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
ABOVE = [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]
ASIDE = [0.6, -0.3, 0.1, -2.2, 0.05, 1.8, 0.9]
FAR = [0.5, -0.1, 0.1, -1.9, 0.05, 1.8, 0.9]
TOLERANCE = 1e-9


def put(studio: Studio, configuration: list[float]) -> None:
    """Move the chain's joints, as another panel would."""
    studio.run(
        """(q) => {
          const {model, base, tip, positions} = studio.store.value;
          const joints = model.chain(base ?? model.ends.base_frame, tip ?? model.ends.tip_frame);
          const moved = Object.fromEntries(joints.map(({name}, i) => [name, q[i]]));
          studio.store.set({positions: {...positions, ...moved}});
        }""",
        configuration,
    )


def add(studio: Studio, name: str, configuration: list[float]) -> None:
    """Add a pose of the arm to the motion."""
    put(studio, configuration)
    studio.button(name).click()


def plan(studio: Studio) -> Any:
    """Press Plan; the service's answer to the very call that the panel shows."""
    studio.button("Plan").wait_for()  # one of a link may be on its way
    studio.run("studio.store.set({plan: null})")
    studio.button("Plan").click()
    studio.until("studio.store.value.plan")
    return asked(studio)


def asked(studio: Studio) -> Any:
    """What the service says to the call under "as request", asked without the page."""
    if not studio.button("JSON").is_visible():
        studio.page.get_by_text("As request").click()
    studio.button("JSON").click()
    call = json.loads(studio.page.locator(".request code").text_content() or "")
    robot = studio.run("studio.store.value.model.name")
    status, answer = get(f"{studio.url}/v1/robots/{robot}/trajectory", "POST", call)
    assert status == 200, answer
    return answer


def seek(studio: Studio, time: float) -> list[float]:
    """Scrub to a time; the joints' positions then."""
    studio.field("Time in the motion").fill(str(time))
    return shown(studio)


def shown(studio: Studio) -> list[float]:
    """The joints that the plan moves, as they are on the screen."""
    found: list[float] = studio.run(
        "(({positions, plan}) => plan.answer.joint_names.map((name) => positions[name]))(studio.store.value)"
    )
    return found


def row(studio: Studio, name: str) -> list[str]:
    """A row of the audit."""
    cells = studio.page.locator(".findings tr", has=studio.page.get_by_role("rowheader", name=name, exact=True))
    return [text.replace("−", "-") for text in cells.locator("td").all_text_contents()]


def panda(studio: Studio) -> None:
    studio.open("trajectory", robot="panda", q=",".join(map(str, [*HOME, 0.02])))


@pytest.mark.slow
def test_a_motion_of_the_panda(studio: Studio) -> None:
    """Built, planned and scrubbed: joints, audit and the tip's way are those of the service's samples."""
    panda(studio)
    assert "add its pose" in (studio.page.locator(".plan-status").text_content() or "")
    assert studio.button("Plan").is_disabled()
    add(studio, "Joint target", ABOVE)
    add(studio, "Line", ASIDE)
    add(studio, "Circle via", FAR)
    assert studio.button("Plan").is_disabled()
    add(studio, "Circle target", ABOVE)
    add(studio, "Spline", FAR)
    add(studio, "Waypoint", HOME)
    answer = plan(studio)
    assert [segment["type"] for segment in answer["segments"]] == ["joint", "line", "circle", "spline"]
    assert studio.page.locator("h2").last.text_content() == f"Motion of {answer['duration']:.3f} s"
    assert shown(studio) == pytest.approx(HOME, abs=TOLERANCE)
    times, positions = np.array(answer["times"]), np.array(answer["joint_positions"])
    for i in np.linspace(0, len(times) - 1, 9).astype(int):
        assert np.abs(np.array(seek(studio, times[i])) - positions[i]).max() < TOLERANCE

    audit = answer["audit"]
    for name in ("velocity", "acceleration", "jerk"):
        value, ratio, joint, time = row(studio, name.capitalize())
        assert float(value.split()[0]) == pytest.approx(abs(audit[name]["value"]), abs=6e-3)
        assert float(ratio.split()[0]) == pytest.approx(100 * audit[name]["ratio"], abs=0.06)
        assert f"panda_{joint}" == audit[name]["joint"]
        assert float(time.split()[0]) == pytest.approx(audit[name]["time"], abs=6e-4)
    studio.page.locator(".goto.worst").click()
    worst = max((audit[name] for name in ("velocity", "acceleration")), key=lambda peak: float(peak["ratio"]))
    at = int(np.abs(times - worst["time"]).argmin())
    speed = np.abs(answer["joint_velocities"]).max()
    assert np.abs(np.array(shown(studio)) - positions[at]).max() <= speed * abs(times[at] - worst["time"]) + TOLERANCE

    with studio.page.expect_download() as download:
        studio.button("CSV").click()
    assert download.value.suggested_filename == "panda.csv"
    table = np.genfromtxt(download.value.path(), delimiter=",", names=True)
    assert (table.dtype.names or ())[:2] == ("time", "q_panda_joint1")
    assert np.array_equal(table["time"], times)
    assert np.array_equal(table["qdd_panda_joint7"], np.array(answer["joint_accelerations"])[:, 6])

    points = np.array(studio.run(WAY)).reshape(-1, 3)
    tips = np.array([pose["position"] for pose in answer["tip_poses"]])
    step = np.linalg.norm(np.diff(tips, axis=0), axis=1).max()
    assert len(points) > 200
    for tip in tips[:: len(tips) // 20]:
        assert np.linalg.norm(points - tip, axis=1).min() < step
    assert np.abs(points[0] - tips[0]).max() < 1e-6  # the picture is in single precision
    assert np.abs(points[-1] - tips[-1]).max() < 1e-6


WAY = """(() => {
  const line = studio.view.scene.getObjectByName("way of the tip").geometry;
  const {instanceStart: from, instanceEnd: to} = line.attributes;
  const at = (part, i) => [part.getX(i), part.getY(i), part.getZ(i)];
  return [...Array(from.count).keys()].flatMap((i) => at(from, i)).concat(at(to, to.count - 1));
})()"""
"""The points of the tip's way in the picture, one after the other."""


@pytest.mark.slow
def test_a_motion_of_a_typed_arm(studio: Studio) -> None:
    """A typed arm is first added to the robots; its time is that of the trapezoid by hand."""
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Trajectory").click()
    keep(studio, "typed_for_motion")
    put(studio, [0.0, 0.5, 0.5])
    studio.page.locator(".segment-head").first.click()
    studio.button("Set to the present pose").click()
    studio.page.get_by_text("Move the arm", exact=True).click()
    studio.type("joint_1, number", "1.2")
    studio.type("joint_3, number", "-0.1")
    studio.button("Joint target").click()
    answer = plan(studio)
    # Joint 1 goes 1.2 rad at the assumed 1 rad/s and 2 rad/s²: d/v + v/a.
    assert answer["duration"] == pytest.approx(1.2 + 0.5, abs=1e-12)
    assert "1.700 s" in (studio.page.locator("h2").last.text_content() or "")
    for time in (0.25, 0.5, 0.85, 1.6):
        assert seek(studio, time)[:2] == pytest.approx([trapezoid(time, 1.2, 1.0, 2.0), 0.5], abs=1e-12)
    assert seek(studio, 1.7) == pytest.approx([1.2, 0.5, -0.1], abs=1e-12)
    assert row(studio, "Velocity")[:3] == ["1.000 rad/s", "100.0 %", "joint_1"]
    studio.run("studio.store.set({degrees: true})")
    assert row(studio, "Velocity")[0] == f"{math.degrees(1.0):.2f} °/s"


def trapezoid(time: float, distance: float, speed: float, acceleration: float) -> float:
    """How far a trapezoid of velocity has come."""
    duration, ramp = distance / speed + speed / acceleration, speed / acceleration
    if time <= ramp:
        return acceleration * time**2 / 2
    if time <= duration - ramp:
        return speed * (time - ramp / 2)
    return distance - acceleration * (duration - time) ** 2 / 2


@pytest.mark.slow
def test_the_profiles_are_the_services_samples(studio: Studio) -> None:
    """Values at the time that is shown, jerk by differences of the samples, and what is drawn on the canvas."""
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Joint target", [0.9, 0.1])
    studio.page.locator("details.law summary").click()
    studio.field("Law of time").select_option("Quintic")
    studio.type("Sample period", "0.001")
    answer = plan(studio)
    times = np.array(answer["times"])
    jerk = np.gradient(np.array(answer["joint_accelerations"]), times, axis=0)
    expected = {
        "Position": answer["joint_positions"],
        "Velocity": answer["joint_velocities"],
        "Acceleration": answer["joint_accelerations"],
        "Jerk": jerk,
    }
    for i in (len(times) // 5, len(times) // 2):
        seek(studio, times[i])
        for name, values in expected.items():
            studio.button(name).click()
            texts = studio.page.locator(".profile-value").all_text_contents()
            numbers = [float(text.replace("−", "-")) for text in texts]
            assert numbers == pytest.approx(list(values[i]), abs=6e-4 + 1e-4 * np.abs(jerk).max()), name

    studio.button("Velocity").click()
    plot = studio.page.locator(".profiles .u-over")
    box = plot.bounding_box()
    assert box is not None
    plot.click(position={"x": box["width"] * 0.75, "y": 40})
    at = float(studio.field("Time in the motion").input_value())
    assert at == pytest.approx(0.75 * answer["duration"], abs=2 * answer["duration"] / box["width"])
    share = at / answer["duration"]
    reached = 0.9 * (10 * share**3 - 15 * share**4 + 6 * share**5)
    assert shown(studio)[0] == pytest.approx(reached, abs=1e-9)

    # The limits of joint 1, which the motion does not reach, are dashed lines from one side to the other.
    studio.button("Acceleration").click()
    studio.page.get_by_title("joint_2: show or hide").click()
    columns, rows = drawn(studio, "--joint-1"), drawn(studio, "--joint-1", axis=0)
    assert columns.sum() > 0.9 * box["width"]
    dashed = np.flatnonzero((0.3 * box["width"] < rows) & (rows < 0.8 * box["width"]))
    assert len(dashed) == 2
    middle = dashed.mean()
    peak = abs(answer["audit"]["acceleration"]["ratio"])
    assert peak < 0.95
    filled = np.flatnonzero(rows)
    inner = filled[(filled > dashed[0] + 1) & (filled < dashed[1] - 1)]
    assert (middle - inner.min()) / (middle - dashed[0]) == pytest.approx(peak, abs=0.04)
    # Far limits are left out, until they are asked for.
    studio.button("Position").click()
    before = drawn(studio, "--joint-1", axis=0)
    studio.button("All limits").click()
    after = drawn(studio, "--joint-1", axis=0)
    assert (before > 0.3 * box["width"]).sum() == 0
    assert (after > 0.3 * box["width"]).sum() == 2
    studio.page.get_by_title("joint_1: show or hide").click()
    assert drawn(studio, "--joint-1").sum() == 0


def drawn(studio: Studio, hue: str, axis: int = 1) -> Any:
    """In the plot, how many pixels of a colour each row has (axis 0), or whether each column has one."""
    studio.drawn()
    pixels = studio.run(
        """(hue) => {
          const canvas = document.querySelector(".profiles canvas");
          const probe = document.body.appendChild(document.createElement("i"));
          probe.style.color = `var(${hue})`;
          const wanted = getComputedStyle(probe).color.match(/\\d+/g).map(Number);
          probe.remove();
          const {width, height} = canvas;
          const copy = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
          copy.drawImage(canvas, 0, 0);
          const {data} = copy.getImageData(0, 0, width, height);
          const least = wanted.indexOf(Math.min(...wanted));
          // Thin lines cover half of a pixel, and are so much paler.
          const isWanted = (i) => {
            const pixel = data.subarray(4 * i, 4 * i + 4);
            const pale = Math.max(0, (pixel[least] - wanted[least]) / (255 - wanted[least]));
            return pixel[3] > 64 && pale < 0.7
              && wanted.every((value, k) => Math.abs(pixel[k] - value - pale * (255 - value)) < 40);
          };
          const found = [...Array(width * height).keys()].filter(isWanted);
          return {found, width, height};
        }""",
        hue,
    )
    mask = np.zeros(pixels["width"] * pixels["height"], bool)
    mask[pixels["found"]] = True
    mask = mask.reshape(pixels["height"], pixels["width"])
    return mask.sum(axis=1) if axis == 0 else mask.any(axis=0)


@pytest.mark.slow
def test_it_is_played(studio: Studio) -> None:
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Joint target", [0.4, 0.7])
    answer = plan(studio)
    studio.field("Speed").select_option("2×")
    studio.button("Play").click()
    studio.until(f"Math.abs(studio.store.value.positions.joint_1 - 0.4) < {TOLERANCE}")
    assert shown(studio) == pytest.approx([0.4, 0.7], abs=TOLERANCE)
    assert studio.button("Play").is_visible()
    # Over and over: it passes its beginning again, and stops where it is told to.
    studio.button("Loop").click()
    studio.button("Play").click()
    studio.until("studio.store.value.positions.joint_1 < 0.2")
    studio.until("studio.store.value.positions.joint_1 > 0.2")
    studio.until("studio.store.value.positions.joint_1 < 0.2")
    studio.button("Pause").click()
    paused = shown(studio)
    studio.page.wait_for_timeout(100)
    assert shown(studio) == paused
    # The keyboard scrubs by a hundredth, and plays.
    seek(studio, 0.0)
    studio.field("Time in the motion").press("ArrowRight")
    assert float(studio.field("Time in the motion").input_value()) == pytest.approx(answer["duration"] / 100)
    there = studio.field("Time in the motion").input_value()
    studio.field("Time in the motion").press("Space")
    studio.until(f"document.querySelector('.player input').value !== {there!r}")
    studio.button("Pause").click()


@pytest.mark.slow
def test_segments_are_changed_moved_and_removed(studio: Studio) -> None:
    """What is typed is what is asked for; another panel and a reload leave all of it as it is."""
    studio.open("trajectory", robot="ur5_dh", q="0,-1.2,1.4,-1.7,-1.5,0.2")
    first, second = [0.2, -1.1, 1.4, -1.7, -1.5, 0.2], [0.3, -1.2, 1.5, -1.7, -1.5, 0.3]
    add(studio, "Joint target", first)
    add(studio, "Joint target", second)
    assert segments(studio) == [
        {"type": "joint", "target": pytest.approx(first)},
        {"type": "joint", "target": pytest.approx(second)},
    ]
    studio.page.locator(".segment-head").nth(1).click()
    studio.field("Segment 1, type").select_option("line")
    expected = studio.fk("ur5_dh", {"joint_positions": [first], "pose_format": "rpy"})["poses"][0]
    assert segments(studio)[0] == {"type": "line", "target": {k: pytest.approx(v) for k, v in expected.items()}}
    studio.type("Segment 1, target, z", "0.55")
    studio.field("Segment 1, law").select_option("Cubic")
    studio.type("Segment 1, velocity scale", "0.5")
    studio.button("Move segment 1 down").click()
    assert [segment["type"] for segment in segments(studio)] == ["joint", "line"]
    studio.page.locator("details.law summary").click()
    studio.field("Law of time").select_option("Jerk-limited")
    studio.type("Velocity scale", "0.8")
    studio.type("joint_3, velocity", "1.5")
    studio.type("Tip velocity", "0.2")
    studio.field("Near a singularity").select_option("Damp the joints")
    answer = plan(studio)
    assert answer["limits"]["joint_velocity"][2] == pytest.approx(0.8 * 1.5)
    assert answer["limit_sources"]["joint_velocity"][2] == "request"
    assert [segment["law"] for segment in answer["segments"]] == ["jerk_limited", "cubic"]
    assert answer["tip_poses"][-1]["position"][2] == pytest.approx(0.55, abs=1e-4)
    assert answer["audit"]["tip"]["speed"]["value"] < 0.2

    studio.button("Jerk").click()
    motion, planned = studio.state("motion"), studio.state("plan")
    studio.page.get_by_role("tab", name="Pose").click()
    studio.page.get_by_role("tab", name="Trajectory").click()
    assert (studio.state("motion"), studio.state("plan")) == (motion, planned)
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("ur5_dh")
    studio.until("studio.store.value.plan")  # a link plans what it holds
    assert studio.state("motion") == motion
    assert studio.run("studio.store.value.plan.answer.duration") == planned["answer"]["duration"]
    assert studio.button("Jerk").get_attribute("aria-pressed") == "true"
    # Another chain has a motion of its own; this one comes back with its chain.
    studio.field("Tip frame").select_option("link_4")
    assert segments(studio) == []
    studio.field("Tip frame").select_option("tool")
    assert studio.state("motion") == motion
    studio.button("Remove segment 1").click()
    assert "changed since" in (studio.page.locator(".plan-status").text_content() or "")
    assert [segment["type"] for segment in segments(studio)] == ["line"]


def segments(studio: Studio) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = studio.state("motion")["segments"]
    return found


@pytest.mark.slow
def test_a_spline_is_passed_at_given_times(studio: Studio) -> None:
    """Through the waypoints at their times; of the tip, once it is one of poses."""
    start, first, second = [0.0, 0.5], [0.4, 0.7], [0.9, 0.2]
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Spline", first)
    studio.page.locator(".segment-head").nth(1).click()
    studio.field("Segment 1, waypoints are passed").select_option("At given times")
    add(studio, "Waypoint", second)
    studio.type("Segment 1, waypoint 1, time", "1.5")
    studio.type("Segment 1, waypoint 2, time", "3.25")
    assert segments(studio) == [{"type": "spline", "waypoints": [first, second], "times": [1.5, 3.25]}]
    assert studio.run(CUT_OFF) == []
    answer = plan(studio)
    assert answer["duration"] == pytest.approx(3.25)
    for time, place in ((0.0, start), (1.5, first), (3.25, second)):
        assert seek(studio, time) == pytest.approx(place, abs=1e-9)
    studio.button("Segment 1, remove waypoint 2").click()
    assert segments(studio) == [{"type": "spline", "waypoints": [first], "times": [1.5]}]
    studio.button("Tip").click()
    [pose] = segments(studio)[0]["waypoints"]
    expected = studio.fk("planar_2r", {"joint_positions": [first], "pose_format": "rpy"})["poses"][0]
    assert pose["position"] == pytest.approx(expected["position"], abs=1e-12)
    assert studio.button("Joints").is_disabled()
    studio.field("Segment 1, waypoints are passed").select_option("As soon as limits allow")
    assert "changed since" in (studio.page.locator(".plan-status").text_content() or "")


@pytest.mark.slow
def test_what_cannot_be_done_says_why_and_where(studio: Studio, refusals: set[int]) -> None:
    """A refused field is told at its segment; a way out of reach is shown as far as it goes."""
    studio.open("trajectory", robot="ur5_dh", q="0,-1.2,1.4,-1.7,-1.5,0.2")
    add(studio, "Line", [0.2, -1.1, 1.4, -1.7, -1.5, 0.2])
    studio.page.locator(".segment-head").nth(1).click()
    studio.type("Segment 1, blend", "0.1")
    studio.button("Plan").click()
    error = studio.page.locator(".segment-error:visible")
    error.wait_for()
    assert "nothing to blend into" in (error.text_content() or "")
    refusals.add(422)
    studio.type("Segment 1, blend", "")
    studio.type("Segment 1, target, x", "1.5")
    answer = plan(studio)
    failure = answer["failure"]
    assert failure["reason"] == "out_of_reach"
    box = studio.page.locator(".ended")
    text = box.text_content() or ""
    assert f"{100 * answer['completed_fraction']:.1f} %" in text
    assert "out of reach" in text
    assert "Segment 1" in text
    mark = studio.run(
        "studio.view.scene.getObjectByName('failure').getWorldPosition(studio.view.camera.position.clone()).toArray()"
    )
    assert mark == pytest.approx(failure["position"], abs=1e-12)  # the base is the world
    box.get_by_role("button").click()
    assert np.abs(np.array(shown(studio)) - answer["joint_positions"][-1]).max() < TOLERANCE
    assert studio.page.locator(".segment-error:visible").count() == 0


@pytest.mark.slow
def test_a_motion_begins_and_ends_moving(studio: Studio, refusals: set[int]) -> None:
    """The rates of its ends are in the call and the link; one that is refused says so at its field."""
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Joint target", [0.9, 0.1])
    studio.page.locator("summary", has_text="Law and limits").click()
    studio.field("Law of time").select_option("Jerk-limited")
    studio.page.locator("summary", has_text="Moving ends").click()
    studio.type("joint_1, start velocity", "0.3")
    studio.type("joint_2, end velocity", "-9")
    studio.button("Plan").click()
    error = studio.page.locator(".folded .segment-error:visible")
    error.wait_for()
    refusals.add(422)
    assert "'end_velocities': that of joint 2 is -9, beyond its limit 1" in (error.text_content() or "")
    assert studio.field("joint_2, end velocity").get_attribute("aria-invalid") == "true"
    assert studio.field("joint_2, start velocity").get_attribute("aria-invalid") == "false"
    studio.type("joint_2, end velocity", "-0.2")
    answer = plan(studio)
    assert answer["joint_velocities"][0] == pytest.approx([0.3, 0.0], abs=TOLERANCE)
    assert answer["joint_velocities"][-1] == pytest.approx([0.0, -0.2], abs=TOLERANCE)
    assert error.count() == 0
    motion = studio.state("motion")
    assert (motion["start_velocities"], motion["end_velocities"]) == ([0.3, 0], [0, -0.2])
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("planar_2r")
    assert studio.state("motion") == motion
    studio.page.locator("summary", has_text="at its start and end").click()
    studio.type("joint_1, start velocity", "")
    assert "start_velocities" not in studio.state("motion")


@pytest.mark.slow
def test_torques_with_a_payload(studio: Studio, refusals: set[int]) -> None:
    """Drawn with the motors' limits, as the service has them; a payload that is none says so at its field."""
    panda(studio)
    add(studio, "Joint target", ABOVE)
    studio.page.locator("summary", has_text="Torques and payload").click()
    assert studio.field("Payload, centre z").is_disabled()
    studio.type("Payload, mass", "0")
    studio.button("Plan").click()
    studio.page.locator(".folded .segment-error", has_text="greater than 0").wait_for()
    refusals.add(422)
    assert studio.field("Payload, mass").get_attribute("aria-invalid") == "true"
    studio.type("Payload, mass", "3")
    studio.type("Payload, centre z", "0.1")
    studio.button("Within the motors’ effort").click()
    answer = plan(studio)
    motion = studio.state("motion")
    assert motion["payload"] == {"mass": 3, "center": [0, 0, 0.1]}
    assert (motion["limits"], motion["torques"]) == ({"joint_torque": "effort"}, True)
    peak = answer["audit"]["joint_torque"]
    value, ratio, joint, _ = row(studio, "Torque")
    assert float(value.split()[0]) == pytest.approx(abs(peak["value"]), abs=6e-3)
    assert float(ratio.split()[0]) == pytest.approx(100 * peak["ratio"], abs=0.06)
    assert f"panda_{joint}" == peak["joint"]
    studio.button("Torque").click()
    for i in (0, len(answer["times"]) // 3, -1):
        seek(studio, answer["times"][i])
        texts = studio.page.locator(".profile-value").all_text_contents()
        shown_torques = [float(text.replace("−", "-")) for text in texts]
        assert shown_torques == pytest.approx(answer["joint_torques"][i], abs=6e-4)
    studio.button("All limits").click()
    plot = studio.page.locator(".profiles .u-over").bounding_box()
    assert plot is not None
    rows = drawn(studio, "--joint-4", axis=0)
    lowest, *_, highest = np.flatnonzero(rows)
    assert min(rows[lowest], rows[highest]) > 0.3 * plot["width"], "its limits are dashed lines around the torques"
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("panda")
    assert studio.state("motion") == motion


@pytest.mark.slow
def test_a_press_on_a_plot_that_presenting_enlarges(another: Callable[..., Studio]) -> None:
    """It means the time under the pointer: that is where the time's line is drawn, and the cursor's."""
    studio = another(width=1440, height=900)
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Joint target", [0.9, 0.1])
    answer = plan(studio)
    studio.button("Present").click()
    plot = studio.page.locator(".profiles .u-over")
    plot.scroll_into_view_if_needed()
    studio.until("document.querySelector('.profiles .u-over').currentCSSZoom > 1")
    box = plot.bounding_box()
    assert box is not None
    x = box["x"] + 0.3 * box["width"]
    studio.page.mouse.click(x, box["y"] + 60)
    at = float(studio.field("Time in the motion").input_value())
    assert at == pytest.approx(0.3 * answer["duration"], abs=3 * answer["duration"] / box["width"])
    for line in (".profile-now", ".u-cursor-x"):
        left = f"document.querySelector('.profiles {line}').getBoundingClientRect().left"
        studio.until(f"Math.abs({left} - {x}) < 4")


@pytest.mark.slow
def test_the_path_of_a_tool(studio: Studio, refusals: set[int], tmp_path: Path) -> None:
    """Poses from a table; the turns that the service chooses are drawn, and the pose that blocks it is named."""
    studio.open("trajectory", robot="ur5")
    studio.page.locator("summary", has_text="Tool path").click()
    table = tmp_path / "seam.csv"

    def load(*lines: str) -> None:
        table.write_text("\n".join(lines))
        studio.field("Poses of the tool, a table").set_input_files([])
        studio.field("Poses of the tool, a table").set_input_files(table)

    said = studio.page.locator(".folded .segment-error")
    for lines, problem in (
        (["0.5,0,0.1"], "line 1 has 3 numbers"),
        (["", "0.5,0,0.1,pi,0,a"], "first line names no columns"),
        (["0.5,0,0.1,pi,0,0", "0.5,0,high,pi,0,0"], "line 2: “high” is no number"),
    ):
        load(*lines)
        said.filter(has_text=problem).wait_for()
    load("2 0 0.1 pi 0 0", "0.5 0.1 0.1 pi 0 0")
    studio.page.get_by_text("2 poses in place of segments").wait_for()
    studio.button("Plan").click()
    said.filter(has_text="way-point 0 is out of reach").wait_for()
    refusals.add(422)

    load("name; x [m]; y; z; qx; qy; qz; qw", *(f"{y}; 0,5; 0.0{y}; 0.1; 1; 0; 0; 0" for y in range(5)))
    studio.until("studio.store.value.motion.path.poses.length === 5")
    answer = plan(studio)
    poses = [{"position": [0.5, y / 100, 0.1], "quaternion_xyzw": [1, 0, 0, 0]} for y in range(5)]
    motion = studio.state("motion")
    assert motion["path"] == {"poses": poses, "free": ["rz"]}
    expected = [
        studio.fk("ur5", {"joint_positions": [q], "pose_format": "matrix"})["poses"][0]["matrix"]
        for q in answer["path"]["joint_positions"]
    ]
    for column, axis in enumerate("xyz"):
        assert lines_along(studio, axis) == pytest.approx(np.array(expected)[:, :3, column], abs=1e-5), axis
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("ur5")
    assert studio.state("motion") == motion

    studio.page.locator("summary", has_text="Tool path").click()
    load(*(f"{0.5 + 0.2 * i} 0.1 0.1 pi 0 0" for i in range(4)))
    studio.until("studio.store.value.motion.path.poses.length === 4")
    studio.button("Begin where the arm is").click()
    blocked = plan(studio)
    assert blocked["joint_positions"][0] == pytest.approx(studio.state("motion")["start"])
    reached = len(blocked["path"]["turns"])
    assert 0 < reached < 4
    assert f"Way-point {reached} stops the tip" in (studio.page.locator(".ended").text_content() or "")
    assert len(lines_along(studio, "muted")) == 4 - reached
    studio.button("Back to segments").click()
    assert "path" not in studio.state("motion")


def lines_along(studio: Studio, hue: str) -> Any:
    """The directions of the short lines at the way-points of a tool that have a colour."""
    ends = studio.run(
        """(hue) => {
          const {attributes} = studio.view.scene.getObjectByName(`way-points ${hue}`).geometry;
          const at = (part) => (i) => [part.getX(i), part.getY(i), part.getZ(i)];
          const read = (part) => [...Array(part.count).keys()].map(at(part));
          const {instanceStart: from, instanceEnd: to} = attributes;
          return [read(from), read(to)];
        }""",
        hue,
    )
    along = np.subtract(*reversed(ends))
    return along / np.linalg.norm(along, axis=1, keepdims=True)


@pytest.mark.slow
def test_a_plan_is_saved_for_a_controller(studio: Studio, refusals: set[int]) -> None:
    """As the service's own answers; what an arm cannot be written as says why."""
    studio.open("trajectory", robot="ur5", q="0,-1.2,1.6,-0.4,1.2,0")
    add(studio, "Joint target", [0.05, -1.2, 1.6, -0.4, 1.2, 0.0])
    answer = plan(studio)
    texts = {name: saved(studio, *name) for name in (("ROS, JSON", "json"), ("ROS, YAML", "yaml"))}
    for message in map(yaml.safe_load, texts.values()):
        assert message["joint_names"] == answer["joint_names"]
        assert [point["positions"] for point in message["points"]] == answer["joint_positions"]
    assert json.loads(texts["ROS, JSON", "json"])["header"]["frame_id"] == "base_link"
    program = saved(studio, "URScript", "script")
    assert program.count("servoj([") == len(answer["times"]) - 1
    panda(studio)
    add(studio, "Joint target", ABOVE)
    plan(studio)
    studio.button("URScript").click()
    studio.page.get_by_text("urscript is for arms of 6 turning joints; here are 7 joints").wait_for()
    refusals.add(422)


def saved(studio: Studio, name: str, ending: str) -> str:
    """The text of a file that is saved."""
    with studio.page.expect_download() as download:
        studio.button(name).click()
    assert download.value.suggested_filename == f"ur5.{ending}"
    return download.value.path().read_text()


@pytest.mark.slow
def test_a_plan_is_cancelled(studio: Studio) -> None:
    studio.open("trajectory", robot="planar_2r", q="0,0.5")
    add(studio, "Joint target", [0.4, 0.7])
    held: list[Route] = []

    def hold(route: Route) -> None:
        held.append(route)

    studio.page.route("**/trajectory", hold)
    studio.button("Plan").click()
    studio.hear(held)
    studio.page.get_by_text("Planning …").wait_for()
    assert studio.button("Plan").count() == 0
    studio.button("Cancel").click()
    studio.button("Plan").wait_for()
    assert studio.state("plan") is None
    assert len(held) == 1
    studio.page.unroute("**/trajectory")
    assert plan(studio)["completed_fraction"] == 1


@pytest.mark.slow
def test_a_motion_in_a_link_that_is_none_is_left_aside(studio: Studio) -> None:
    own = {"robot": "planar_2r", "base_frame": "base", "tip_frame": "tool", "start": [0.1, 0.2], "segments": []}
    for motion in (
        "{",
        "[]",
        json.dumps({**own, "start": "here"}),
        json.dumps({**own, "segments": [{"type": "jump", "target": [0, 0]}]}),
        json.dumps({**own, "segments": [{"type": "line", "target": [0, 0]}]}),
        json.dumps({**own, "robot": "panda"}),
    ):
        studio.open("trajectory", robot="planar_2r", q="0.3,0.4", motion=motion)
        assert studio.state("motion") == {**own, "start": [0.3, 0.4]}, motion
    studio.open("trajectory", robot="planar_2r", q="0.3,0.4", motion=json.dumps(own))
    assert studio.state("motion") == own


@pytest.mark.slow
def test_axe_finds_nothing_serious_in_a_planned_motion(another: Callable[..., Studio]) -> None:
    if not AXE.exists():
        pytest.skip("axe-core is not there: ./dev studio installs it")
    studio = another(scheme="light", width=1024, height=768)
    studio.open("trajectory", robot="ur5_dh", q="0,-1.2,1.4,-1.7,-1.5,0.2")
    add(studio, "Joint target", [0.2, -1.1, 1.4, -1.7, -1.5, 0.2])
    add(studio, "Line", [0.3, -1.2, 1.5, -1.7, -1.5, 0.3])
    plan(studio)
    studio.page.locator(".segment-head").nth(2).click()
    studio.page.locator("details.law summary").click()
    for colours in ("Dark", "Light"):
        studio.button(colours).click()
        findings: list[Any] = studio.run(AXE.read_text() + "; axe.run().then(({violations}) => violations)")
        serious = [
            (found["id"], found["nodes"][0]["html"]) for found in findings if found["impact"] in {"serious", "critical"}
        ]
        assert serious == []
    assert studio.run(CUT_OFF) == []


@pytest.mark.slow
def test_task_blends_and_the_shortest_time(studio: Studio) -> None:
    """They go into the call, come back from a link, and the durations shown are the service's."""
    studio.open("trajectory", robot="panda", tip="panda_link8")
    put(studio, HOME)
    for configuration in (ABOVE, ASIDE, FAR):
        put(studio, configuration)
        studio.button("Spline" if configuration is ABOVE else "Waypoint").click()
    studio.page.get_by_role("button", name="3 waypoints").click()
    studio.field("Segment 1, between waypoints").select_option("blends")
    assert not studio.field("Segment 1, at its ends").is_visible()
    add(studio, "Joint target", HOME)
    studio.page.get_by_text("Law and limits").click()
    directions = studio.page.get_by_role("group", name="Directions in which the way counts")
    directions.get_by_role("button", name="rz").click()
    studio.button("Compare with time-optimal").click()
    answer = plan(studio)
    motion = studio.state("motion")
    assert motion["task"] == ["x", "y", "z", "rx", "ry"]
    assert motion["compare_timing"] is True
    assert motion["segments"][0]["blends"] is True
    lines = studio.page.locator(".timing tbody tr").all()
    assert len(lines) >= 1
    for line, timing in zip(lines, answer["timing"], strict=True):
        words = line.text_content() or ""
        assert f"{timing['uniform_duration']:.3f} s" in words
        assert f"{timing['time_optimal_duration']:.3f} s" in words
    studio.address()
    studio.page.reload()
    studio.wait_for_robot("panda")
    assert studio.state("motion") == motion


@pytest.mark.slow
def test_a_law_that_a_blend_replaces_is_said_above_the_result(studio: Studio) -> None:
    """What was taken is what the service says, not what the page thinks of blends; a law that is kept needs no word."""
    panda(studio)
    add(studio, "Line", ABOVE)
    add(studio, "Line", ASIDE)
    answer = plan(studio)
    said = studio.page.get_by_role("list", name="Laws that were replaced")
    assert {segment["law"] for segment in answer["segments"]} == {"trapezoidal"}
    assert said.is_hidden()
    blend = "studio.store.set({motion: {...%s, segments: %s.segments.map((one, i) => i ? one : {...one, ...%s})}})"
    motion = "studio.store.value.motion"
    studio.run(blend % (motion, motion, "{blend_radius: 0.02}"))
    answer = plan(studio)
    assert {segment["law"] for segment in answer["segments"]} == {"time_optimal"}
    assert said.inner_text() == "Segments 1, 2: Time-optimal in place of trapezoidal; the notes say why."
    assert any("in place of `trapezoidal`" in note for note in answer["segments"][0]["notes"])
    studio.run(f"studio.store.set({{motion: {{...{motion}, law: 'quintic'}}}})")
    answer = plan(studio)
    assert {segment["law"] for segment in answer["segments"]} == {"quintic"}
    assert said.is_hidden()


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_a_plan_comes_into_sight_with_the_keyboard(another: Callable[..., Studio], size: tuple[int, int]) -> None:
    """The result's title is seen and has the focus; whoever has gone on to a field meanwhile is left there."""
    studio = another(width=size[0], height=size[1])
    panda(studio)
    for configuration in (ABOVE, ASIDE, FAR):
        add(studio, "Joint target", configuration)
    studio.page.get_by_text("Law and limits").click()
    studio.button("Plan").click()
    studio.until("studio.store.value.plan")
    focus = "document.activeElement.textContent"
    studio.until(f"{focus}.startsWith('Motion of')")
    top = "document.activeElement.getBoundingClientRect().top"
    below = "document.querySelector('#panel').getBoundingClientRect()"
    studio.until(f"{top} >= {below}.top && {top} < {below}.top + 60")
    studio.run("studio.store.set({plan: null})")
    held: list[Route] = []
    studio.page.route("**/trajectory", lambda route: held.append(route))  # noqa: PLW0108 - it takes no built-in
    studio.button("Plan").click()
    assert studio.run(focus) == "Cancel"
    studio.field("Sample period").focus()
    studio.until("document.activeElement.tagName === 'INPUT'")
    studio.hear(held)  # the page hands its call over in its own time
    held[0].continue_()
    studio.until("studio.store.value.plan")
    assert studio.run("document.activeElement.tagName") == "INPUT"


@pytest.mark.slow
def test_a_circle_is_blended_into_a_line_by_its_radius(studio: Studio) -> None:
    """The circle of three places, 0.2 m around one in the middle, then a line; no picture of a fly-over is offered."""
    places = ([0.9, 0.9, 0.0], [0.7, 1.1, 0.0], [0.5, 1.1, 0.0])
    via, end, after = ({"position": position, "rpy": [0, 0, 0]} for position in places)
    segments = [{"type": "circle", "via": via, "target": end}, {"type": "line", "target": after}]
    motion = {"robot": "planar_2r", "base_frame": "base", "tip_frame": "tool", "start": [0.3, 0.8], "task": ["x", "y"]}
    studio.open("trajectory", robot="planar_2r", motion=json.dumps({**motion, "segments": segments}))
    studio.until("studio.store.value.plan")
    studio.page.locator(".segment-head").nth(1).click()
    studio.type("Segment 1, blend", "0.05")
    assert studio.page.get_by_label("Segment 1, blend by").count() == 0
    answer = plan(studio)
    assert studio.state("motion")["segments"][0]["blend_radius"] == 0.05
    assert answer["segments"][0]["blend"]["radius"] == 0.05
    assert studio.button("Corner 1 drawn").count() == 0


@pytest.mark.slow
def test_pictures_of_a_plan(studio: Studio) -> None:
    corner, end = ({"position": position, "rpy": [0, 0, 0]} for position in ([0.9, 1.1, 0.0], [0.5, 1.1, 0.0]))
    lines = [{"type": "line", "target": corner, "blend_radius": 0.05}, {"type": "line", "target": end}]
    motion = {
        "robot": "planar_2r",
        "base_frame": "base",
        "tip_frame": "tool",
        "start": [0.3, 0.8],
        "segments": lines,
        "task": ["x", "y"],
        "limits": {"tip_velocity": 0.2},
    }
    studio.open("trajectory", robot="planar_2r", motion=json.dumps(motion))
    studio.until("studio.store.value.plan")
    for name, button, title in (
        ("trajectory", "Profiles drawn", "Profiles of the joints"),
        ("manipulability", "Ellipses drawn", "Velocity ellipses along the motion"),
        ("fly-over", "Corner 1 drawn", "Fly-over from line 1 to line 2"),
    ):
        with studio.page.expect_request(f"**/{name}") as sent:
            studio.button(button).click()
        studio.until(f"document.querySelector('figure img[alt=\"{title}\"]')?.naturalWidth > 0")
        assert studio.page.locator("figure").count() == 1
    asked_for: Any = sent.value.post_data_json
    assert asked_for["corner"] == corner["position"]
    assert asked_for["end"] == pytest.approx(end["position"], abs=1e-6)
    assert asked_for["radius"] == pytest.approx(0.05)
    assert asked_for["speed_before"] == asked_for["speed_after"] == 0.2
