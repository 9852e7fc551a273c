"""A DH table as text for other programs: CSV, LaTeX, a MATLAB function, a robot of the Robotics Toolbox for Python.

Numbers are written so that they read back exactly, but for LaTeX, which is for readers and has nine decimals.
"""

import csv
import io
import re
from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.writing import matrix
from gelenk.dh.table_steps import table_array
from gelenk.errors import InvalidField, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhJoint, DhTable

TableFormat: TypeAlias = Literal["csv", "latex", "matlab", "roboticstoolbox"]

_COLUMNS = ("name", "type", "a", "alpha", "d", "theta", "lower", "upper", "velocity", "effort")
_MIMIC = ("joint", "multiplier", "offset")

_MATLAB = """function T = {name}(q)
%{remarks}
% q: positions of {variables}, [rad or m]. T: pose of the tip in the base, 4 x 4.
table = [ ... % a in m, alpha in rad, d in m, theta in rad, 1 where the joint slides
{rows}];
T_base_0 = {base};
T_n_tool = {tool};
positions = {coupling} * q(:) + {offsets};
T = T_base_0;
for i = 1:size(table, 1)
    a = table(i, 1);
    alpha = table(i, 2);
    d = table(i, 3) + table(i, 5) * positions(i);
    theta = table(i, 4) + (1 - table(i, 5)) * positions(i);
    about_x = [1 0 0 a; 0 cos(alpha) -sin(alpha) 0; 0 sin(alpha) cos(alpha) 0; 0 0 0 1];
    about_z = [cos(theta) -sin(theta) 0 0; sin(theta) cos(theta) 0 0; 0 0 1 d; 0 0 0 1];
    T = T * {product};
end
T = T * T_n_tool;
end
"""

_TOOLBOX = '''"""{remarks}"""

import numpy as np
from roboticstoolbox import DHRobot, {classes}
from spatialmath import SE3

robot = DHRobot(
    [
{rows}    ],
    name={name!r},
    base=SE3(np.array({base}), check=False),
    tool=SE3(np.array({tool}), check=False),
)
'''


def written_table(table: DhTable, kind: TableFormat, name: str, remarks: Sequence[str]) -> str:
    """Return a table as text; the remarks, a line each, become comments at its head.

    Raises InvalidField if the format cannot express that a joint follows another one.
    """
    lines = (f"{table.convention} convention, lengths in m, angles in rad", *remarks)
    comments = [line.replace("\n", " ") for line in lines]
    match kind:
        case "csv":
            return _csv(table, comments)
        case "latex":
            return _latex(table, comments)
        case "matlab":
            return _matlab(table, name, comments)
        case "roboticstoolbox":
            return _toolbox(table, name, comments)


def identifier(name: str) -> str:
    """Return a name that MATLAB takes for a function and its file, made from that of a robot."""
    word = re.sub(r"\W", "_", name, flags=re.ASCII)
    return word if word[:1].isalpha() else f"robot_{word}"


def _csv(table: DhTable, remarks: Sequence[str]) -> str:
    """Write the form that the command line reads: what the rows do not say is in comments."""
    text = io.StringIO(newline="")
    ends = {"base": table.base, "tool": table.tool}
    places = [f'{end}: {{"matrix": {_rows(T)}}}' for end, T in ends.items() if not np.array_equal(T, np.eye(4))]
    text.writelines(f"# {line}\n" for line in (f"convention: {table.convention}", *remarks[1:], *places))
    follows = any(row.mimic is not None for row in table.joints)
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow([*_COLUMNS, *(f"mimic.{key}" for key in _MIMIC if follows)])
    for row in table.joints:
        values = [getattr(row, column) for column in _COLUMNS]
        followed = [None if row.mimic is None else getattr(row.mimic, key) for key in _MIMIC if follows]
        rows.writerow(["" if value is None else value for value in (*values, *followed)])
    return text.getvalue()


def _latex(table: DhTable, remarks: Sequence[str]) -> str:
    lines = [*(f"% {line}" for line in remarks), rf"\[ {table_array(table)} \]"]
    for place, T in ((r"T^{b}_{0}", table.base), (r"T^{n}_{t}", table.tool)):
        if not np.array_equal(T, np.eye(4)):
            lines.append(rf"\[ {place} = {matrix(T)} \]")
    return "\n".join([*lines, ""])


def _matlab(table: DhTable, name: str, remarks: Sequence[str]) -> str:
    order = {variable: j for j, variable in enumerate(table.variables)}
    coupling, offsets = np.zeros((len(table.joints), len(order))), np.zeros((len(table.joints), 1))
    for i, row in enumerate(table.joints):
        mimic = row.mimic
        coupling[i, order[row.name if mimic is None else mimic.joint]] = 1.0 if mimic is None else mimic.multiplier
        offsets[i] = 0.0 if mimic is None else mimic.offset
    rows = ((row.a, row.alpha, row.d, row.theta, float(row.type == "prismatic")) for row in table.joints)
    return _MATLAB.format(
        name=identifier(name),
        remarks="\n%".join(f" {line}" for line in remarks),
        variables=", ".join(table.variables),
        rows="".join(f"    {', '.join(map(repr, row))}; ... % {i}\n" for i, row in enumerate(rows, start=1)),
        base=_brackets(table.base),
        tool=_brackets(table.tool),
        coupling=_brackets(coupling),
        offsets=_brackets(offsets),
        product="about_z * about_x" if table.convention == "standard" else "about_x * about_z",
    )


def _toolbox(table: DhTable, name: str, remarks: Sequence[str]) -> str:
    follower = next((row.name for row in table.joints if row.mimic is not None), None)
    if follower is not None:
        reason = f"the Robotics Toolbox has no joint that follows another one, as {quoted(follower)} does"
        raise InvalidField("format", reason)
    suffix = "DH" if table.convention == "standard" else "MDH"
    classes = sorted({f"{row.type.title()}{suffix}" for row in table.joints}, reverse=True)
    return _TOOLBOX.format(
        remarks="\n".join(line.replace("\\", "/").replace('"', "'") for line in remarks),
        classes=", ".join(classes),
        rows="".join(f"        {_link(row, suffix)},\n" for row in table.joints),
        name=name,
        base=_rows(table.base),
        tool=_rows(table.tool),
    )


def _link(row: DhJoint, suffix: str) -> str:
    lower, upper = row.limits
    if row.type == "revolute":
        fixed = f"d={row.d!r}, a={row.a!r}, alpha={row.alpha!r}, offset={row.theta!r}"
        return f"Revolute{suffix}({fixed}, qlim=[{lower!r}, {upper!r}])"
    fixed = f"theta={row.theta!r}, a={row.a!r}, alpha={row.alpha!r}, offset={row.d!r}"
    return f"Prismatic{suffix}({fixed}, qlim=[{lower!r}, {upper!r}])"


def _rows(T: Array) -> str:
    return str(T.tolist())


def _brackets(values: Array) -> str:
    return "[" + "; ".join(", ".join(map(repr, row)) for row in values.tolist()) + "]"
