"""A DH table as URDF."""

from dataclasses import asdict
from typing import Any

from gelenk.contract.dh_to_urdf import ToUrdfRequest
from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.errors import listed
from gelenk.kinematics.judge.tables import certify_table
from gelenk.operations.outcome import always, json_only
from gelenk.robot.appearance import invented_masses
from gelenk.robot.description import MOVABLE, Description
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import UNLIMITED, read_urdf, write_urdf

is_heavy = always  # building a robot takes milliseconds


@json_only
def run(call: ToUrdfRequest) -> dict[str, Any]:
    """Write a DH table as URDF, and certify the robot in it."""
    table = call.dh.table()
    described = describe_dh(call.name, table)
    urdf = write_urdf(described)
    robot = RobotModel(read_urdf(urdf), (BASE_FRAME, TOOL_FRAME))
    certificate = certify_table(robot, robot.chain(None, None), table)
    return {
        "urdf": urdf,
        "joint_names": table.variables,
        "certificate": asdict(certificate),
        "notes": _notes(described),
        "warnings": described.warnings,
    }


def _notes(described: Description) -> list[str]:
    """Return notes on what a description says that its table did not."""
    notes = [invented_masses()]
    for key in ("velocity", "effort"):
        names = tuple(
            joint.name for joint in described.joints if joint.type in MOVABLE and not getattr(joint.limits, key)
        )
        if names:
            notes.append(
                f"no {key} limit is given for {listed(names)}: URDF wants one, and {UNLIMITED:g} stands for none"
            )
    return notes
