"""Requests with a field that its schema or the robot does not allow, with their verdict: `FIELDS`.

`mentions` are lower-case words that the lower-cased problem has to contain to be of use.
"""

from collections.abc import Iterator
from typing import Any

from tests.corpus.bodies import JSON, Call, written

PANDA = "/v1/robots/panda"
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
SEVEN = tuple(f"panda_joint{i}" for i in range(1, 8))


def asked(path: str, name: str, status: int, mentions: tuple[str, ...], fields: Any) -> Call:
    """A request of these fields."""
    return Call(name, "POST", path, (status,), mentions, written(fields), (JSON,))


def _positions(operation: str, **more: Any) -> Iterator[Call]:
    """Configurations that the Panda has not."""
    path = f"{PANDA}/{operation}"
    call = {"joint_positions": [READY], "tip_frame": "panda_link8", **more}
    for name, rows, mentions in (
        ("one joint short", [READY[:6]], SEVEN),
        ("one joint too many", [[*READY, 0.0]], SEVEN),
        ("no joints", [[]], SEVEN),
        ("ragged rows", [READY, READY[:3]], ("configuration 1", *SEVEN)),
        ("129 numbers", [[0.0] * 129], ("128",)),
        ("a joint left out by name", [dict(zip(SEVEN[:6], READY, strict=False))], ("panda_joint7",)),
        ("an unknown joint", [{**dict(zip(SEVEN, READY, strict=True)), "elbow": 0.0}], ("elbow",)),
        ("a flat list", READY, ("joint_positions",)),
        ("lists of lists", [[READY]], ("joint_positions",)),
        ("a text", "0 0 0 0 0 0 0", ("joint_positions",)),
        ("rows of texts", ["0 0 0 0 0 0 0"], ("joint_positions",)),
        ("a hole", [READY, None], ("joint_positions",)),
    ):
        yield asked(path, f"joint_positions: {name}", 422, mentions, {**call, "joint_positions": rows})
    for field in ("base_frame", "tip_frame"):
        for name, value, status, mentions in (
            ("unknown", "nose", 404, ("nose", "panda_link8")),
            ("with an escape sequence", "\x1b[31mnose\r\n\0", 404, ("panda_link8",)),
            ("with a lone surrogate", "\ud800", 400, ("json",)),
            ("empty", "", 422, (field,)),
            ("of 129 characters", "f" * 129, 422, (field,)),
            ("a number", 7, 422, (field,)),
            ("a list", ["panda_link8"], 422, (field,)),
        ):
            yield asked(path, f"{field} {name}", status, mentions, {**call, field: value})


def _ik() -> Iterator[Call]:
    """Targets and options of the inverse."""
    target = {"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.0, 0.0]}
    call = {"targets": [target], "tip_frame": "panda_link8"}
    eye = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    for name, pose, mentions in (
        ("no orientation", {"position": [0, 0, 0]}, ("targets",)),
        ("no position", {"rpy": [0, 0, 0]}, ("position",)),
        ("two orientations", {**target, "zyz": [0, 0, 0]}, ("targets",)),
        ("a matrix and a position", {"position": [0, 0, 0], "matrix": [[1, 0, 0, 0]] * 4}, ("matrix",)),
        ("a zero quaternion", {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 0]}, ("quaternion",)),
        ("a quaternion of length 2", {"position": [0, 0, 0], "quaternion_wxyz": [2, 0, 0, 0]}, ("quaternion",)),
        ("a quaternion that overflows", {"position": [0, 0, 0], "quaternion_wxyz": [1e308] * 4}, ("quaternion",)),
        ("a quaternion that vanishes", {"position": [0, 0, 0], "quaternion_wxyz": [1e-308] * 4}, ("quaternion",)),
        ("a reflection", {"position": [0, 0, 0], "rotation": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]}, ("rotation",)),
        ("a shear", {"position": [0, 0, 0], "rotation": [[1, 1e-5, 0], [0, 1, 0], [0, 0, 1]]}, ("rotation",)),
        ("a rotation that overflows", {"position": [0, 0, 0], "rotation": [[1e308] * 3] * 3}, ("rotation",)),
        ("a ragged rotation", {"position": [0, 0, 0], "rotation": [*eye[:2], [0, 0]]}, ("rotation",)),
        ("a position of 1e300", {**target, "position": [1e300, 0, 0]}, ("position",)),
        ("a list", [0.4, 0.1, 0.5, 0, 0, 0], ("targets",)),
        ("null", None, ("targets",)),
    ):
        yield asked(f"{PANDA}/ik", f"target with {name}", 422, mentions, {**call, "targets": [target, pose]})
    options: tuple[tuple[str, tuple[Any, ...]], ...] = (
        ("method", ("magic", "", None, 1)),
        ("solutions", ("most", 3)),
        ("position_tolerance", (0, -1e-6, 1e300, "small")),
        ("orientation_tolerance", (0, -1e-6, 1e300)),
        ("max_iterations", (0, -1, 10**30, 1.5, 1e300)),
        ("time_limit", (0, -1, 1e300, "1 s")),
        ("random_seed", (-1, 2**64, 10**30, 0.5, None)),
        ("task", ([], ["x", "x"], ["up"], "x", ["x"] * 7)),
        ("seeds", ([READY] * 2, [READY[:3]], [[1e400]], READY, "middle")),
        ("respect_limits", ("no", 0, None)),
        ("trace", ("yes", 1)),
    )
    for field, values in options:
        for value in values:
            body = written({**call, field: value}).replace(b"Infinity", b"1e400")
            statuses = (422,)
            yield Call(f"{field} {str(value)[:30]}", "POST", f"{PANDA}/ik", statuses, (field,), body, (JSON,))


def _trajectory() -> Iterator[Call]:
    """Motions that are none."""
    path = f"{PANDA}/trajectory"
    target = {"position": [0.5, 0.2, 0.4], "rpy": [3.141592653589793, 0.0, 0.3]}
    there = {"type": "joint", "target": [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]}
    call = {"start": READY, "segments": [there], "tip_frame": "panda_link8"}
    options: tuple[tuple[str, tuple[Any, ...]], ...] = (
        ("start", (None, [], READY[:6], {"panda_joint1": 0.0}, [4.0, *READY[1:]], "home")),
        ("segments", ([], None, {}, [None], [{}], [[]], [there] * 10_001, [{"type": "dance"}])),
        ("law", ("magic", None, 3)),
        ("duration", (0, -1, 1e300, "1 s")),
        ("sample_period", (0, -0.01, 1e300, 1e-300)),
        ("path_tolerance", (0, -1, 1e300)),
        ("velocity_scale", (0, -1, 1.01, 1e300)),
        ("acceleration_scale", (0, -1, 1.01)),
        ("limits", ([], {"joint_velocity": [1.0]}, {"joint_velocity": [-1.0] * 7}, {"speed": 1}, {"tip_velocity": 0})),
    )
    for field, values in options:
        for value in values:
            name = f"{field} {str(value)[:40]}"
            yield asked(path, name, 422, (field.removesuffix("s"),), {**call, field: value})
    for name, segment in (
        ("a line without a target", {"type": "line"}),
        ("a line to a configuration", {"type": "line", "target": READY}),
        ("a blend of a negative radius", {"type": "line", "target": target, "blend_radius": -1}),
        ("a circle without a point on it", {"type": "circle", "target": target}),
        ("a spline through nothing", {"type": "spline", "waypoints": []}),
        ("a spline of both kinds", {"type": "spline", "waypoints": [READY, target]}),
        ("a spline backwards in time", {"type": "spline", "waypoints": [READY, READY], "times": [1, 0]}),
        ("a spline of an unknown end", {"type": "spline", "waypoints": [READY], "boundary": "loose"}),
        ("a target short of a joint", {"type": "joint", "target": READY[:6]}),
        ("an unknown field", {**there, "speed": 1}),
    ):
        yield asked(path, f"segment: {name}", 422, ("segments",), {**call, "segments": [segment]})


def _workspace() -> Iterator[Call]:
    """Jobs that nobody can do."""
    call = {"kind": "cloud", "samples": 1000, "tip_frame": "panda_link8", "job_id": "hostile"}
    for field, value, status in (
        ("kind", "sphere", 422),
        ("samples", 0, 422),
        ("samples", -1, 422),
        ("samples", 1.5, 422),
        ("samples", 10**9, 413),
        ("samples", 10**30, 422),
        ("random_seed", -1, 422),
        ("random_seed", 2**64, 422),
        ("voxel_size", 0, 422),
        ("voxel_size", 1e-300, 422),
        ("voxel_size", 1e300, 422),
        ("task", [], 422),
        ("task", ["x", "x"], 422),
        ("plane", {"normal": [0, 0, 0], "origin": [0, 0, 0], "thickness": 0.1}, 422),
        ("plane", {"normal": [1e308, 1e308, 0], "origin": [0, 0, 0], "thickness": 0.1}, 422),
        ("plane", {}, 422),
        ("joint_ranges", {"panda_joint1": [1, 0]}, 422),
        ("joint_ranges", {"panda_joint1": [0]}, 422),
        ("joint_ranges", {"elbow": [0, 1]}, 422),
        ("joint_ranges", {"panda_joint1": [-100, 100]}, 422),
        ("orientations", 3, 422),
        *(("job_id", name, 422) for name in ("", "..", "../x", "a/b", "a b", ".x", "a\0", "ä", "j" * 65, 7, "x\n")),
    ):
        yield asked(f"{PANDA}/workspace", f"{field} {str(value)[:40]}", status, (field.partition("_")[0],),
                    {**call, field: value})  # fmt: skip


def _tables() -> Iterator[Call]:
    """What goes to the conversions beside a table."""
    row = {"type": "revolute", "a": 0.3, "alpha": 0.0, "d": 0.1, "theta": 0.0}
    dh = {"convention": "standard", "joints": [row, row]}
    for path, name, status, mentions, fields in (
        ("to-urdf", "no name", 422, ("name",), {"dh": dh}),
        ("to-urdf", "a name that leads out", 422, ("name",), {"name": "../arm", "dh": dh}),
        ("to-urdf", "a name with a newline", 422, ("name",), {"name": "arm\n", "dh": dh}),
        ("from-urdf", "no text", 422, ("urdf",), {"urdf": None}),
        ("from-urdf", "an empty text", 422, ("xml",), {"urdf": ""}),
        ("from-urdf", "an unknown frame", 404, ("nose",), {"urdf": '<robot><link name="a"/></robot>',
                                                           "tip_frame": "nose"}),
        ("from-urdf", "nothing that moves", 422, ("joint",), {"urdf": '<robot><link name="a"/></robot>'}),
        ("convert", "no convention", 422, ("convention",), {"dh": dh}),
        ("convert", "an unknown convention", 422, ("convention",), {"dh": dh, "convention": "craig"}),
        ("compare", "no robot", 422, ("robot",), {"dh": dh}),
        ("compare", "an unknown robot", 404, ("nobody",), {"dh": dh, "robot": "nobody"}),
        ("compare", "a robot that leads out", 422, ("robot",), {"dh": dh, "robot": "../panda"}),
        ("compare", "an unknown frame", 404, ("nose",), {"dh": dh, "robot": "ur5", "tip_frame": "nose"}),
        ("derive", "one joint short", 422, ("joint",), {"dh": dh, "joint_positions": [[0.0]]}),
        ("derive", "a table of no rows", 422, ("joints",), {"dh": {**dh, "joints": []}}),
    ):  # fmt: skip
        yield asked(f"/v1/dh/{path}", f"{path}: {name}", status, mentions, fields)


FIELDS: tuple[Call, ...] = (
    *(
        call
        for operation in ("fk", "jacobian", "dynamics", "manipulability", "singularities")
        for call in _positions(operation)
    ),
    asked(f"{PANDA}/fk", "a million rows and one", 422, ("1000000",), {"joint_positions": [[]] * 1_000_001}),
    *_positions("statics", wrenches=[[0, 0, -10, 0, 0, 0]]),
    *_positions("velocity", joint_velocities=[[0.1] * 7]),
    *_ik(),
    *_trajectory(),
    *_workspace(),
    *_tables(),
)
"""A field of one operation that its schema or the robot does not allow."""
