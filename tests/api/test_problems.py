"""Every error class of the core has a status, a kind of its own, and something that raises it."""

import pytest
from starlette.testclient import TestClient

from app.api.problems import STATUS, kind_of, status_of
from app.model import errors

EXAMPLES: dict[type[errors.KinematicsError], tuple[str, str, object]] = {
    errors.InvalidUrdf: ("POST", "/v1/robots", {"name": "x", "urdf": "<robot/>"}),
    errors.InvalidDhTable: (
        "POST",
        "/v1/robots",
        {
            "name": "x",
            "dh": {
                "convention": "standard",
                "joints": [{"type": "revolute", "a": 0, "alpha": 0, "d": 0, "theta": 0, "lower": 1, "upper": 0}],
            },
        },
    ),
    errors.InvalidPose: (
        "POST",
        "/v1/robots",
        {
            "name": "x",
            "dh": {
                "convention": "standard",
                "joints": [{"type": "revolute", "a": 0, "alpha": 0, "d": 0, "theta": 0}],
                "base": {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 0]},
            },
        },
    ),
    errors.InvalidArray: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[1e9] * 7]}),
    errors.WrongJointCount: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[0]]}),
    errors.MissingJoint: ("POST", "/v1/robots/panda/fk", {"joint_positions": [{}]}),
    errors.UnknownJoint: ("POST", "/v1/robots/panda/fk", {"joint_positions": [{"nose": 0}]}),
    errors.OutsideLimits: (
        "POST",
        "/v1/robots/panda/fk",
        {"joint_positions": [[3] * 7], "respect_limits": True},
    ),
    errors.FrameNotOnChain: (
        "POST",
        "/v1/robots/panda/fk",
        {"joint_positions": [[0] * 7], "frames": ["panda_leftfinger"]},
    ),
    errors.RepresentationSingularity: (
        "POST",
        "/v1/robots/planar_2r/jacobian",
        {"joint_positions": [[0, 0]], "representation": "zyz"},
    ),
    errors.UnknownRobot: ("GET", "/v1/robots/nobody", None),
    errors.UnknownFrame: ("POST", "/v1/robots/panda/fk", {"joint_positions": [], "tip_frame": "nose"}),
    errors.UnknownMesh: ("GET", "/v1/robots/panda/meshes/nothing.stl", None),
    errors.TooLarge: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[0] * 7] * 200_000, "frames": "all"}),
    errors.RobotExists: ("POST", "/v1/robots", {"name": "panda", "urdf": '<robot name="r"><link name="l"/></robot>'}),
    errors.ReadOnlyRobot: ("DELETE", "/v1/robots/panda", None),
}
ELSEWHERE = {
    errors.UnsupportedJoint: "test_a_chain_across_a_floating_joint",
    errors.InvalidArchive: "test_robots.test_bad_archives_are_refused",
    errors.InvalidName: "tests.store.test_library",
    errors.CertificationFailed: "tests.kinematics.test_certify",
}


def concrete(error: type[errors.KinematicsError]) -> list[type[errors.KinematicsError]]:
    below = [leaf for child in error.__subclasses__() for leaf in concrete(child)]
    return below or [error]


@pytest.mark.parametrize("error", concrete(errors.KinematicsError), ids=lambda error: error.__name__)
def test_every_error_has_a_status_and_something_raises_it(
    client: TestClient, error: type[errors.KinematicsError]
) -> None:
    status = status_of(error)
    assert status in set(STATUS.values())
    if error in ELSEWHERE:
        return
    method, path, body = EXAMPLES[error]
    answer = client.request(method, path, json=body)
    assert answer.status_code == status, answer.text
    assert answer.json()["type"] == f"urn:gelenk:{kind_of(error)}"


def test_a_chain_across_a_floating_joint(client: TestClient) -> None:
    urdf = """<robot name="ship"><link name="sea"/><link name="hull"/><link name="crane"/>
    <joint name="waves" type="floating"><parent link="sea"/><child link="hull"/></joint>
    <joint name="slew" type="continuous"><parent link="hull"/><child link="crane"/><axis xyz="0 0 1"/></joint>
    </robot>"""
    created = client.post("/v1/robots", json={"name": "ship", "urdf": urdf})
    assert created.status_code == 201, created.text
    refused = client.post("/v1/robots/ship/fk", json={"tip_frame": "crane", "base_frame": "sea", "joint_positions": []})
    assert refused.status_code == 422
    assert refused.json()["type"] == "urn:gelenk:unsupported-joint"
    assert (refused.json()["joint"], refused.json()["joint_type"]) == ("waves", "floating")
    call = {"base_frame": "hull", "tip_frame": "crane", "joint_positions": [[0.5]]}
    assert client.post("/v1/robots/ship/fk", json=call).status_code == 200
