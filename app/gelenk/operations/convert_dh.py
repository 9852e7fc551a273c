"""Conversion of a DH table to the other convention."""

from dataclasses import asdict
from typing import Any

from gelenk.contract.convert_dh import ConvertRequest
from gelenk.contract.dh import table_content
from gelenk.dh.table_steps import conversion_steps
from gelenk.dh.tables.convert import converted
from gelenk.kinematics.judge.tables import certify_conversion
from gelenk.operations.outcome import always, json_only

is_heavy = always  # building a robot takes milliseconds


@json_only
def run(call: ConvertRequest) -> dict[str, Any]:
    """Convert a DH table to the other convention, and certify the result."""
    table = call.dh.table()
    other = converted(table, call.convention)
    return {
        "dh": table_content(other),
        "joint_names": other.variables,
        "certificate": asdict(certify_conversion(table, other)),
        "steps": conversion_steps(table, other, call.columns) if call.steps else None,
    }
