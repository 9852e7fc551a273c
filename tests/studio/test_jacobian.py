"""The Jacobian panel: the matrix, the ellipsoids as numbers and in the picture, and what a singularity takes away."""

import json
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Route, expect

from gelenk.robot.arrays import Array
from tests.studio.browser import Studio
from tests.studio.tables import ANTHROPOMORPHIC, keep, type_table
from tests.test_serve import get

SOMEWHERE = [0.2, -0.785, 0.1, -2.356, 0.3, 1.571, 0.785]
PANDA = ",".join(map(str, [*SOMEWHERE, 0.02]))


def wait_for_matrix(studio: Studio, expected: Array) -> None:
    """Wait until the panel shows this Jacobian."""
    shown = "JSON.parse(document.querySelector('[data-jacobian]')?.dataset.jacobian ?? '[]').flat()"
    flat = expected.ravel().tolist()
    studio.until(f"(x => x.length === {len(flat)} && {flat}.every((e, i) => Math.abs(e - x[i]) < 1e-9))({shown})")


def told(studio: Studio, name: str) -> Any:
    """Numbers that the panel shows, to the last digit."""
    text = studio.page.locator(f"[data-{name}]").get_attribute(f"data-{name}")
    assert text is not None
    return json.loads(text)


def answer(studio: Studio, operation: str, robot: str, **call: Any) -> Any:
    """What the service says, asked without the page."""
    status, content = get(f"{studio.url}/v1/robots/{robot}/{operation}", "POST", call)
    assert status == 200, content
    return content


def body(studio: Studio, name: str) -> Array:
    """Semi-axes of an ellipsoid in the scene, in the world: its columns, shape (3, 3), [m]."""
    studio.until(f"studio.view.scene.getObjectByName('{name}')")
    matrix = studio.run(
        "(name) => { studio.view.scene.updateMatrixWorld(true);"
        "return studio.view.scene.getObjectByName(name).children[0].matrixWorld.toArray(); }",
        name,
    )
    return np.array(matrix).reshape(4, 4).T[:3, :3]


@pytest.mark.slow
def test_matrix_measures_and_picture_are_the_services(studio: Studio) -> None:
    studio.open("jacobian", robot="panda", q=PANDA)
    J = np.array(answer(studio, "jacobian", "panda", joint_positions=[SOMEWHERE])["jacobians"][0])
    wait_for_matrix(studio, J)
    cells = studio.page.locator(".jacobian tbody td").all_text_contents()
    assert np.abs(np.array([float(cell.replace("−", "-")) for cell in cells]).reshape(6, 7) - J).max() < 6e-4
    sigmas = np.linalg.svd(J[:3], compute_uv=False)
    assert told(studio, "semi-axes") == pytest.approx(sigmas, abs=1e-12)
    measures = told(studio, "measures")
    assert measures["measure"] == pytest.approx(np.prod(sigmas), rel=1e-12)
    assert measures["condition_number"] == pytest.approx(sigmas[0] / sigmas[2], rel=1e-12)
    assert measures["isotropy"] == pytest.approx(sigmas[2] / sigmas[0], rel=1e-12)
    assert measures["rank"] == 3
    # The bodies that are drawn are those of JJᵀ and of its inverse, but for the scale of the picture.
    for name, shape in {
        "velocity ellipsoid": J[:3] @ J[:3].T,
        "force ellipsoid": np.linalg.inv(J[:3] @ J[:3].T),
    }.items():
        axes = body(studio, name)
        drawn = axes @ axes.T
        assert np.abs(drawn / np.trace(drawn) - shape / np.trace(shape)).max() < 1e-6, name
    # Live: another configuration by a slider, at the scale of the picture before where that is held.
    studio.button("Hold scale").click()
    before = body(studio, "velocity ellipsoid")
    studio.field("panda_joint4").fill("-1.2")
    moved = [*SOMEWHERE[:3], float(studio.field("panda_joint4").input_value()), *SOMEWHERE[4:]]
    J_moved = np.array(answer(studio, "jacobian", "panda", joint_positions=[moved])["jacobians"][0])
    wait_for_matrix(studio, J_moved)
    longest = [np.linalg.norm(axes, axis=0).max() for axes in (before, body(studio, "velocity ellipsoid"))]
    assert longest[1] / longest[0] == pytest.approx(np.linalg.svd(J_moved[:3])[1][0] / sigmas[0], rel=1e-6)


@pytest.mark.slow
def test_a_column_belongs_to_its_joint(studio: Studio) -> None:
    studio.open("jacobian", robot="panda", q=PANDA)
    J = np.array(answer(studio, "jacobian", "panda", joint_positions=[SOMEWHERE])["jacobians"][0])
    wait_for_matrix(studio, J)
    marked = studio.page.locator(".jacobian .marked")
    for by in ("focus", "hover"):
        getattr(studio.page.get_by_role("button", name="q₃, panda_joint3"), by)()
        assert studio.state("joint") == "panda_joint3"
        assert marked.count() == 7
        tip = studio.run(
            "(() => { const arrow = studio.view.scene.getObjectByName('column').children[1];"
            "return arrow.position.toArray(); })()"
        )
        assert np.cross(tip, J[:3, 2]) == pytest.approx(np.zeros(3), abs=1e-6)
        assert np.dot(tip, J[:3, 2]) > 0
        studio.field("panda_joint6").focus()
        studio.field("panda_joint6").hover()
        assert studio.state("joint") == "panda_joint6"
    studio.page.get_by_role("button", name="q₂, panda_joint2").click()
    assert studio.run("document.activeElement.getAttribute('aria-label')") == "panda_joint2"


def arm_jacobian(q: Array) -> Array:
    """Linear rows of the Jacobian of the anthropomorphic arm, as the lecture writes them."""
    (c1, c2, c23), (s1, s2, s23) = (f(np.array([q[0], q[1], q[1] + q[2]])) for f in (np.cos, np.sin))
    reach, height = 0.5 * c2 + 0.4 * c23, 0.5 * s2 + 0.4 * s23
    return np.array(
        [
            [-s1 * reach, -c1 * height, -0.4 * c1 * s23],
            [c1 * reach, -s1 * height, -0.4 * s1 * s23],
            [0.0, reach, 0.4 * c23],
        ]
    )


@pytest.mark.slow
def test_the_singularities_of_a_typed_arm(studio: Studio) -> None:
    type_table(studio, ANTHROPOMORPHIC)
    studio.page.get_by_role("tab", name="Jacobian").click()
    keep(studio, "jacobian_arm")  # the panel itself offers it
    q = np.array([0.3, 0.5, 0.4])
    for joint, value in enumerate(q, start=1):
        studio.type(f"joint_{joint}, number", str(value))
    turns = np.array([[0, np.sin(0.3), np.sin(0.3)], [0, -np.cos(0.3), -np.cos(0.3)], [1, 0, 0]])
    wait_for_matrix(studio, np.vstack((arm_jacobian(q), turns)))
    sigmas = np.linalg.svd(arm_jacobian(q), compute_uv=False)
    verdict = studio.page.locator(".singularity p").first.text_content() or ""
    assert f"Close to singular: the smallest σ is 1/{sigmas[0] / sigmas[2]:.1f} of the largest" in verdict
    # The nearest one is where the panel says, and there the arm's own determinant vanishes.
    studio.until("document.querySelector('.singularity').dataset.distance > 0")
    distance = told(studio, "distance")
    assert distance <= 0.4 + 1e-9  # no further than where it is stretched
    studio.button("Go there").click()
    there = np.array([studio.state("positions")[f"joint_{i}"] for i in (1, 2, 3)])
    assert np.linalg.norm(there - q) == pytest.approx(distance, abs=1e-9)
    assert abs(np.linalg.det(arm_jacobian(there))) < 1e-9
    # Stretched, it cannot move along its own line, and no joint feels a force along it.
    studio.type("joint_2, number", "0.5")
    studio.type("joint_3, number", "0")
    studio.until("document.querySelector('.singularity').dataset.singular === 'true'")
    line = np.array([np.cos(0.5) * np.cos(0.3), np.cos(0.5) * np.sin(0.3), np.sin(0.5)])
    words = studio.page.locator(".words").text_content() or ""
    written = f"({', '.join(f'{x:.2f}' for x in line)})"
    assert f"cannot move along {written}" in words
    assert f"No joint feels a force along {written}" in words
    assert "elbow" in words
    arrows = "studio.view.scene.getObjectByName('lost direction').children"
    heads = f"{arrows}.map((arrow) => arrow.children[1].position.toArray())"
    there_and_back = np.array(studio.run(heads))
    assert np.abs(np.cross(there_and_back, line)).max() < 1e-6
    assert there_and_back[0] @ there_and_back[1] < 0
    flat = np.linalg.norm(body(studio, "velocity ellipsoid"), axis=0)
    assert flat[2] < 1e-3 * flat[0]
    assert told(studio, "measures") == {"measure": 0, "condition_number": None, "isotropy": 0, "rank": 2}


FORMS = {
    "Tip axes": {"reference": "local"},
    "Spatial": {"reference": "world"},
    "ZYZ": {"representation": "zyz"},
    "RPY": {"representation": "rpy"},
}


@pytest.mark.slow
def test_every_form_of_the_matrix_and_a_reload(studio: Studio, refusals: set[int]) -> None:
    studio.open("jacobian", robot="panda", q=PANDA)
    for form, call in FORMS.items():
        studio.button(form).click()
        found = answer(studio, "jacobian", "panda", joint_positions=[SOMEWHERE], **call)
        wait_for_matrix(studio, np.array(found["jacobians"][0]))
    studio.button("Both").click()
    studio.button("Force").click()
    J = np.array(answer(studio, "jacobian", "panda", joint_positions=[SOMEWHERE])["jacobians"][0])
    studio.until("JSON.parse(document.querySelector('[data-semi-axes]').dataset.semiAxes).length === 6")
    assert told(studio, "semi-axes") == pytest.approx(np.linalg.svd(J, compute_uv=False), abs=1e-12)
    studio.until("location.hash.includes('jacobian.ellipsoids=velocity')")
    studio.page.reload()
    studio.wait_for_robot("panda")
    for name in ("RPY", "Both", "Velocity"):
        assert studio.button(name).get_attribute("aria-pressed") == "true"
    assert studio.button("Force").get_attribute("aria-pressed") == "false"
    studio.until("JSON.parse(document.querySelector('[data-semi-axes]')?.dataset.semiAxes ?? '[]').length === 6")
    assert told(studio, "semi-axes") == pytest.approx(np.linalg.svd(J, compute_uv=False), abs=1e-12)
    # Where the angles degenerate there is no analytic matrix, and the ellipse is there all the same.
    refusals.add(422)
    studio.open("jacobian", robot="planar_2r", q="0.3,0.8", **{"jacobian.form": "zyz"})
    problem = studio.page.locator(".problem:visible")
    problem.wait_for()
    assert "the zyz angles have no unique rate" in (problem.text_content() or "")
    assert len(told(studio, "semi-axes")) == 2
    studio.button("Base axes").click()
    problem.wait_for(state="hidden")


@pytest.mark.slow
def test_a_singularity_that_is_found_before_the_ellipsoids_follows_the_unit(studio: Studio) -> None:
    held: list[Route] = []
    studio.page.route("**/manipulability", lambda route: held.append(route))  # noqa: PLW0108 - it takes no built-in
    studio.open("jacobian", robot="planar_2r", q="0.3,0.8")
    found = "document.querySelector('.singularity').dataset.distance > 0"
    studio.until(found)
    held[0].continue_()
    studio.until("document.querySelector('[data-semi-axes]')")
    studio.run("studio.store.set({degrees: true})")
    expect(studio.page.locator(".nearest")).to_contain_text("45.8°")
    assert studio.run(found)


@pytest.mark.slow
def test_the_lever_arms_of_a_planar_arm_alone(studio: Studio, refusals: set[int]) -> None:
    image = "document.querySelector('figure img[alt=\"Lever arms of the force\"]')"
    studio.open("jacobian", robot="planar_2r", q="0.3,0.8")
    studio.type("Force along y", "-5")
    with studio.page.expect_request("**/statics") as sent:
        studio.button("Levers drawn").click()
    call: Any = sent.value.post_data_json
    assert call["wrenches"] == [[10, -5, 0]]
    assert call["joint_positions"] == [[0.3, 0.8]]
    studio.until(f"{image}?.naturalWidth > 0")
    refusals.add(422)
    studio.type("Force along z", "2")
    studio.button("Levers drawn").click()
    studio.page.get_by_text("a force in the plane of the arm").wait_for()
    assert studio.run(image) is None
