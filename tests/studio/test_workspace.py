"""The Workspace panel: a job of the service from its start to its picture, its numbers and its files."""

import io
import json
import urllib.request
from typing import Any

import numpy as np
import pytest

from gelenk.robot.arrays import Array
from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table
from tests.test_serve import get

SAMPLES = 10_000


def compute(studio: Studio) -> None:
    """Begin a job, and wait for its result."""
    studio.button("Compute").click()
    studio.until("document.querySelector('[data-points]')")


def job_of(studio: Studio) -> str:
    """The job that the address bar is going to name."""
    name: str = studio.state("options")["workspace.job"]
    return name


def asked(studio: Studio, job: str) -> Any:
    """A job, asked for without the page."""
    return get(f"{studio.url}/v1/jobs/{job}")[1]


def table_of(studio: Studio) -> Array:
    """The result's array, fetched without the page."""
    request = urllib.request.Request(
        f"{studio.url}/v1/jobs/{job_of(studio)}/result", headers={"Accept": "application/x-npy"}
    )
    with urllib.request.urlopen(request, timeout=60) as answer:
        table: Array = np.load(io.BytesIO(answer.read()))
    return table


POINTS = """(() => {
  const {geometry, material} = studio.view.scene.getObjectByName("workspace").children.find((child) => child.isPoints);
  return {
    position: [...geometry.attributes.position.array],
    color: [...geometry.attributes.color.array],
    planes: (material.clippingPlanes ?? []).map(({normal, constant}) => [...normal.toArray(), constant]),
  };
})()"""


def drawn(studio: Studio) -> dict[str, Array]:
    """What is in the picture: points, their colours, and the planes that cut them off."""
    found = {name: np.array(numbers) for name, numbers in studio.run(POINTS).items()}
    return {**found, "position": found["position"].reshape(-1, 3), "color": found["color"].reshape(-1, 3)}


def facts(studio: Studio) -> dict[str, str]:
    """The numbers below the picture."""
    titles = studio.page.locator(".workspace-facts dt").all_text_contents()
    values = studio.page.locator(".workspace-facts dd").all_text_contents()
    return {title: value.replace("−", "-") for title, value in zip(titles, values, strict=True)}


def downloaded(studio: Studio, button: str) -> bytes:
    """A file that the page saves."""
    with studio.page.expect_download() as download:
        studio.button(button).click()
    content: bytes = download.value.path().read_bytes()
    return content


@pytest.mark.slow
def test_the_cloud_of_the_panda(studio: Studio) -> None:
    studio.open("workspace", robot="panda", **{"workspace.samples": str(SAMPLES)})
    compute(studio)
    # The samples are those that the documentation promises, and the tip is there where it says.
    joints = studio.run("studio.store.value.model.chain('panda_link0', 'panda_hand_tcp')")
    lower, upper = (np.array([joint[end] for joint in joints]) for end in ("lower", "upper"))
    qs = lower + (upper - lower) * np.random.default_rng(0).random((SAMPLES, 7))
    poses = studio.fk("panda", {"joint_positions": qs.tolist(), "pose_format": "quaternion_xyzw"})["poses"]
    positions = np.array([pose["position"] for pose in poses])
    table = table_of(studio)
    assert np.abs(table[:, :3] - positions).max() < 1e-12
    picture = drawn(studio)
    assert np.abs(picture["position"] - positions).max() < 1e-6
    # Lighter is more manipulable: of sRGB in linear numbers green grows all along the scale.
    order = np.argsort(table[:, 3])
    assert (np.diff(picture["color"][order, 1]) >= 0).all()
    assert len(np.unique(picture["color"], axis=0)) > 200
    distances = np.linalg.norm(positions, axis=1)
    assert facts(studio)["Reach"] == f"{distances.min():.3f} to {distances.max():.3f} m"
    assert facts(studio)["z"] == f"{positions[:, 2].min():.3f} to {positions[:, 2].max():.3f} m"
    ticks = studio.page.locator(".scale-ticks span").all_text_contents()
    assert float(ticks[-1]) == pytest.approx(table[:, 3].max(), rel=5e-3)
    # A plane across x, moved: what lies behind it stays.
    studio.button("x").click()
    studio.field("Place of the section").fill("0.3")
    (plane,) = drawn(studio)["planes"]
    stays = positions @ plane[:3] + plane[3] >= 0
    assert (stays == (positions[:, 0] <= float(studio.field("Place of the section").input_value()))).all()
    studio.button("Slice").click()
    sides = drawn(studio)["planes"]
    assert len(sides) == 2
    inside = np.all(positions @ sides[:, :3].T + sides[:, 3] >= 0, axis=1)
    assert 0 < inside.sum() < 0.1 * SAMPLES
    assert np.ptp(positions[inside, 0]) < 0.06


@pytest.mark.slow
def test_files_the_best_configuration_and_the_link(studio: Studio) -> None:
    studio.open("workspace", robot="scara", **{"workspace.samples": str(SAMPLES)})
    compute(studio)
    table = table_of(studio)
    assert (np.load(io.BytesIO(downloaded(studio, "npy"))) == table).all()
    summary = json.loads(downloaded(studio, "JSON"))
    assert summary["samples"] == SAMPLES
    assert downloaded(studio, "SVG").startswith(b"<?xml")
    studio.button("Best configuration").click()
    q = studio.state("positions")
    status, answer = get(f"{studio.url}/v1/robots/scara/manipulability", "POST", {"joint_positions": [q]})
    assert status == 200
    assert answer["results"][0]["translation"]["measure"] == pytest.approx(table[:, 3].max(), rel=1e-9)
    # The link reopens all of it; another panel leaves the picture to the robot.
    studio.button("z").click()
    sides = drawn(studio)["planes"]
    job = job_of(studio)
    studio.until(f"location.hash.includes('workspace.job={job}') && location.hash.includes('workspace.section=z')")
    studio.page.reload()
    studio.wait_for_robot("scara")
    studio.until("document.querySelector('[data-points]')")
    assert (drawn(studio)["planes"] == sides).all()
    assert (drawn(studio)["position"] == table[:, :3].astype(np.float32)).all()
    studio.page.get_by_role("tab", name="Pose").click()
    assert studio.run("studio.view.scene.getObjectByName('workspace') === undefined")
    studio.page.get_by_role("tab", name="Workspace").click()
    studio.until("document.querySelector('[data-points]')")
    studio.button("Remove").click()
    studio.until("!document.querySelector('[data-points]')")
    assert asked(studio, job)["status"] == 404


@pytest.mark.slow
def test_the_colours_are_even(studio: Studio) -> None:
    """Along the scale each step is as large as any other in OKLab, and lighter."""
    studio.open("workspace", robot="planar_2r")
    pixels = studio.run(
        "(() => { const scale = document.querySelector('.scale-colours');"
        "return [...scale.getContext('2d').getImageData(0, 0, scale.width, 1).data]; })()"
    )
    srgb = np.array(pixels).reshape(-1, 4)[::15, :3] / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    cones = linear @ np.array([[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.6300]]).T
    lab = np.cbrt(cones) @ np.array([[0.2105, 0.7936, -0.0041], [1.9780, -2.4286, 0.4506], [0.0259, 0.7828, -0.8087]]).T
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert steps.max() / steps.min() < 1.1
    assert (np.diff(lab[:, 0]) > 0.02).all()


@pytest.mark.slow
def test_the_grid_of_a_typed_arm(studio: Studio, refusals: set[int]) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Workspace").click()
    keep(studio, "workspace_arm")  # the panel itself offers it
    studio.button("Grid").click()
    studio.field("Samples").select_option("30000")
    refusals.add(422)
    studio.type("Edge of a voxel", "1e-9")
    studio.button("Compute").click()
    problem = studio.page.locator(".problem:visible")
    problem.wait_for()
    assert "too small for this chain" in (problem.text_content() or "")
    studio.type("Edge of a voxel", "0.1")
    compute(studio)
    assert not problem.is_visible()
    table = table_of(studio)
    picture = drawn(studio)
    assert np.abs(picture["position"] - table[:, :3]).max() < 1e-6
    # A hollow ball: centres are on the grid, and between the arm folded and stretched but for half a diagonal.
    assert np.abs(picture["position"] / 0.1 - np.round(picture["position"] / 0.1)).max() < 1e-5
    distances = np.linalg.norm(picture["position"], axis=1)
    assert distances.max() < 0.9 + 0.1 * np.sqrt(3) / 2
    inner, outer = (float(word) for word in facts(studio)["Volume"].split()[::2][:2])
    exact = 4 / 3 * np.pi * (0.9**3 - 0.1**3)
    assert inner < exact < outer
    assert outer == pytest.approx(len(table) * 1e-3, rel=5e-3)
    # Its determinant is a₂ a₃ sin q₃ (a₂ cos q₂ + a₃ cos(q₂ + q₃)): no configuration is better than its maximum.
    q2, q3 = np.meshgrid(np.linspace(-np.pi, np.pi, 721), np.linspace(-np.pi, np.pi, 721))
    most = np.abs(0.5 * 0.4 * np.sin(q3) * (0.5 * np.cos(q2) + 0.4 * np.cos(q2 + q3))).max()
    best = float(studio.page.locator(".scale-ticks span").last.text_content() or "nan")
    assert 0.98 * most < best < 1.005 * most


@pytest.mark.slow
def test_a_job_goes_on_without_its_panel_until_it_is_cancelled(studio: Studio, refusals: set[int]) -> None:
    studio.open("workspace", robot="panda", **{"workspace.kind": "dexterity", "workspace.samples": "300000"})
    studio.button("Compute").click()
    bar = "document.querySelector('.progress')"
    studio.until(f"{bar}.value > 0.02")
    assert "Computing at" in (studio.page.get_by_text("It goes on when").text_content() or "")
    seen = studio.run(f"{bar}.value")
    job = job_of(studio)
    studio.page.get_by_role("tab", name="Pose").click()
    studio.page.get_by_role("tab", name="Workspace").click()
    studio.until(f"{bar}.value > {seen}")
    studio.button("Cancel").click()
    studio.until("document.querySelector('[data-state]').dataset.state === 'cancelled'")
    assert asked(studio, job)["state"] == "cancelled"
    studio.until(f"location.hash.includes('workspace.job={job}')")
    studio.page.reload()
    studio.wait_for_robot("panda")
    studio.page.get_by_text("Cancelled at").wait_for()
    # A job that is gone is told, and forgotten.
    get(f"{studio.url}/v1/jobs/{job}?finished=remove", "DELETE")
    refusals.add(404)
    studio.page.reload()
    studio.wait_for_robot("panda")
    studio.page.locator(".problem:visible").wait_for()
    assert "workspace.job" not in studio.state("options")
    assert job not in studio.address()


@pytest.mark.slow
def test_another_robots_workspace_is_not_drawn_on_this_one(studio: Studio) -> None:
    studio.open("workspace", robot="planar_2r", **{"workspace.samples": str(SAMPLES)})
    compute(studio)
    studio.run("studio.store.set({robot: 'scara'})")
    studio.wait_for_robot("scara")
    assert studio.run("studio.view.scene.getObjectByName('workspace').children.length") == 0
    studio.button("Show planar_2r").click()
    studio.wait_for_robot("planar_2r")
    positions = drawn(studio)["position"]
    assert len(positions) == SAMPLES
    assert np.abs(positions[:, 2]).max() == 0
