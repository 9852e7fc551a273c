"""The DH table of a chain in a URDF."""

from dataclasses import asdict
from typing import Any

from gelenk.contract.dh import table_content
from gelenk.contract.dh_from_urdf import FromUrdfOptions, FromUrdfRequest
from gelenk.dh.compare.of_chain import dh_of_chain
from gelenk.dh.placing import placing_steps
from gelenk.operations.outcome import always, json_only
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf

is_heavy = always  # building a robot takes milliseconds


@json_only
def run(call: FromUrdfRequest) -> dict[str, Any]:
    """Compute the DH table of a chain in a URDF, with its certificate."""
    description = read_urdf(call.urdf, call.strict)
    return table_answer(RobotModel(description), call, description.warnings)


def table_answer(robot: RobotModel, options: FromUrdfOptions, warnings: tuple[str, ...]) -> dict[str, Any]:
    """Return the table of a chain with its certificate, as JSON content."""
    chain = robot.chain(options.base_frame, options.tip_frame)
    table, notes, certificate = dh_of_chain(robot, chain, options.convention, options.snap_tolerance)
    return {
        "dh": table_content(table),
        "joint_names": table.variables,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "certificate": asdict(certificate),
        "notes": notes,
        "warnings": warnings,
        "steps": placing_steps(chain, table, options.columns) if options.steps else None,
    }
