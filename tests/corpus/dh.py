"""DH tables and request bodies to be refused: `REFUSED_DH`, `REFUSED_JSON`.

Each is the good arm, `TABLE` in `GOOD_BODY`, with one thing changed. `mentions` are lower-case words that the
lower-cased message has to contain to be of use: the field, or the name that stands twice. For a field called
`a` or `d` it is "joint", since a single letter is in every message.
"""

import json
from typing import NamedTuple


class RefusedDh(NamedTuple):
    """A value of the field "dh" that is not a DH table, or not one that we take."""

    name: str
    table: object
    mentions: tuple[str, ...]


# --- The good arm, and the pieces to change in it ---

SHOULDER: dict[str, object] = {
    "name": "shoulder",
    "type": "revolute",
    "a": 0.3,
    "alpha": 0.0,
    "d": 0.1,
    "theta": 0.0,
}
ELBOW: dict[str, object] = {
    **SHOULDER,
    "name": "elbow",
    "lower": -2.0,
    "upper": 2.0,
    "velocity": 1.5,
    "effort": 20.0,
}
TABLE: dict[str, object] = {"convention": "standard", "joints": [SHOULDER, ELBOW]}
IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def table(**fields: object) -> dict[str, object]:
    """The good table with these fields changed or added."""
    return {**TABLE, **fields}


def elbow(**fields: object) -> dict[str, object]:
    """The good table with these fields of its second joint changed or added."""
    return table(joints=[SHOULDER, {**ELBOW, **fields}])


def elbow_without(field: str) -> dict[str, object]:
    """The good table with this field of its second joint left out."""
    return table(joints=[SHOULDER, {key: value for key, value in ELBOW.items() if key != field}])


def based(**pose: object) -> dict[str, object]:
    """The good table on a base of this pose."""
    return table(base=pose)


def turned(rotation: object) -> dict[str, object]:
    """The good table on a base turned by this rotation matrix."""
    return based(position=[0, 0, 0], rotation=rotation)


# --- Tables ---

TABLES = (
    RefusedDh("table null", None, ("dh",)),
    RefusedDh("table a list", [SHOULDER, ELBOW], ("dh",)),
    RefusedDh("table a text", "standard", ("dh",)),
    RefusedDh("table empty", {}, ("convention",)),
    RefusedDh("convention missing", {"joints": [SHOULDER]}, ("convention",)),
    RefusedDh("convention null", table(convention=None), ("convention",)),
    RefusedDh("convention unknown", table(convention="craig"), ("convention",)),
    RefusedDh("convention in capitals", table(convention="Standard"), ("convention",)),
    RefusedDh("joints missing", {"convention": "standard"}, ("joints",)),
    RefusedDh("joints null", table(joints=None), ("joints",)),
    RefusedDh("joints empty", table(joints=[]), ("joints",)),
    RefusedDh("joints an object", table(joints={"elbow": ELBOW}), ("joints",)),
    RefusedDh(
        "65 joints",
        table(joints=[{**SHOULDER, "name": f"joint_{i}"} for i in range(65)]),
        ("joints", "64"),
    ),
    RefusedDh("unknown field in the table", table(gripper="parallel"), ("gripper",)),
)
"""Not a table at all, or one with nothing (or far too much) in it."""

JOINTS = (
    RefusedDh("joint null", table(joints=[SHOULDER, None]), ("joint",)),
    RefusedDh("joint a row of numbers", table(joints=[[0.3, 0, 0.1, 0]]), ("joint",)),
    *(RefusedDh(f"{field} missing", elbow_without(field), (field,)) for field in ("type", "alpha", "theta")),
    *(RefusedDh(f"{field} missing", elbow_without(field), ("joint",)) for field in ("a", "d")),
    RefusedDh("unknown field in a joint", elbow(beta=0.0), ("beta",)),
    RefusedDh("type spherical", elbow(type="spherical"), ("type",)),
    RefusedDh("type continuous", elbow(type="continuous"), ("type",)),
    RefusedDh("type in capitals", elbow(type="Revolute"), ("type",)),
    RefusedDh("type null", elbow(type=None), ("type",)),
    RefusedDh("name empty", elbow(name=""), ("name",)),
    RefusedDh("name a number", elbow(name=2), ("name",)),
    RefusedDh("name with a newline", elbow(name="el\nbow"), ("name",)),
    RefusedDh("name with NUL", elbow(name="el\0bow"), ("name",)),
    RefusedDh("name of 10,000 characters", elbow(name="e" * 10_000), ("name",)),
    RefusedDh("two joints of one name", table(joints=[ELBOW, ELBOW]), ("elbow",)),
    RefusedDh("lower above upper", elbow(lower=1.0, upper=-1.0), ("lower",)),
    RefusedDh(
        "lower above the default upper",
        table(joints=[SHOULDER, {**SHOULDER, "name": "elbow", "lower": 4.0}]),
        ("lower",),
    ),
)
"""A joint is complete, of one of two types, named once, and has somewhere to be."""

FOLLOWERS = (
    *(
        RefusedDh(f"mimic {why}", elbow(mimic=mimic), ("mimic",))
        for why, mimic in (
            ("a text", "shoulder"),
            ("a list", ["shoulder"]),
            ("without a joint", {"multiplier": 2.0}),
            ("of itself", {"joint": "elbow"}),
            ("of no name", {"joint": ""}),
            ("of a name with a newline", {"joint": "shoul\nder"}),
            ("with a text for a multiplier", {"joint": "shoulder", "multiplier": "2"}),
            ("with null for an offset", {"joint": "shoulder", "offset": None}),
            ("with a multiplier of 1e300", {"joint": "shoulder", "multiplier": 1e300}),
            ("with an offset of 1e300", {"joint": "shoulder", "offset": -1e300}),
            ("with an unknown field", {"joint": "shoulder", "gear": 2.0}),
        )
    ),
    RefusedDh(
        "mimic of a mimic",
        table(
            joints=[
                SHOULDER,
                {**ELBOW, "mimic": {"joint": "wrist"}},
                {**SHOULDER, "name": "wrist", "mimic": {"joint": "shoulder"}},
            ]
        ),
        ("mimic", "wrist"),
    ),
)
"""A joint that follows another names one with a position of its own."""

NUMBERS = (
    *(
        RefusedDh(f"{field} {why}", elbow(**{field: value}), (field,))
        for field in ("alpha", "theta", "lower", "velocity")
        for why, value in (("a text", "1.5"), ("true", True), ("a list", [1.5]))
    ),
    RefusedDh("alpha null", elbow(alpha=None), ("alpha",)),
    RefusedDh("alpha the text NaN", elbow(alpha="NaN"), ("alpha",)),
    RefusedDh("a a text", elbow(a="0.3"), ("joint",)),
    RefusedDh("d false", elbow(d=False), ("joint",)),
    RefusedDh("a of 1e300", elbow(a=1e300), ("joint",)),
    RefusedDh("d of -1e300", elbow(d=-1e300), ("joint",)),
    RefusedDh("d of 2e6", elbow(d=2e6), ("joint",)),
    RefusedDh("alpha too large for a double", elbow(alpha=10**400), ("alpha",)),
)
"""A number is a JSON number, a length at most 1e6 m. Obliging converters take texts and truth values too."""

POSES = (
    RefusedDh("base a list", table(base=[0, 0, 0]), ("base",)),
    RefusedDh("base without an orientation", based(position=[0, 0, 0]), ("base",)),
    RefusedDh("base without a position", based(rpy=[0, 0, 0]), ("base", "position")),
    RefusedDh(
        "base with two orientations",
        based(position=[0, 0, 0], rpy=[0, 0, 0], quaternion_xyzw=[0, 0, 0, 1]),
        ("base",),
    ),
    RefusedDh(
        "base with a matrix and a position",
        based(position=[0, 0, 0], matrix=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
        ("base", "matrix"),
    ),
    RefusedDh("base with an unknown field", based(position=[0, 0, 0], euler=[0, 0, 0]), ("base", "euler")),
    *(
        RefusedDh(f"base position {why}", based(position=position, rpy=[0, 0, 0]), ("base", "position"))
        for why, position in (
            ("with two entries", [0, 0]),
            ("with four entries", [0, 0, 0, 0]),
            ("of texts", ["0", "0", "0"]),
            ("with true", [0, True, 0]),
            ("of 1e300", [1e300, 0, 0]),
        )
    ),
    RefusedDh("base rpy with two entries", based(position=[0, 0, 0], rpy=[0, 0]), ("base", "rpy")),
    *(
        RefusedDh(f"base rotation {why}", turned(rotation), ("base", "rotation"))
        for why, rotation in (
            ("a reflection", [[1, 0, 0], [0, 1, 0], [0, 0, -1]]),
            ("of zeros", [[0, 0, 0]] * 3),
            ("stretched by 1e-3", [[1.001, 0, 0], [0, 1, 0], [0, 0, 1]]),
            ("sheared by 1e-3", [[1, 1e-3, 0], [0, 1, 0], [0, 0, 1]]),
            ("with two rows", IDENTITY[:2]),
            ("with a short row", [[1, 0, 0], [0, 1], [0, 0, 1]]),
            ("of nine numbers in a row", [1, 0, 0, 0, 1, 0, 0, 0, 1]),
        )
    ),
    *(
        RefusedDh(f"tool matrix {why}", table(tool={"matrix": matrix}), ("tool", "matrix"))
        for why, matrix in (
            ("three by three", IDENTITY),
            ("three by four", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]),
            ("with another bottom row", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]),
            ("transposed", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.1, 0.2, 0.3, 1]]),
            (
                "of a determinant below 1e-307",
                [[0, 1, 0, 0], [1e-308, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
            ),
        )
    ),
    RefusedDh(
        "tool matrix a reflection",
        table(tool={"matrix": [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}),
        ("tool",),
    ),
    *(
        RefusedDh(
            f"tool quaternion {why}",
            table(tool={"position": [0, 0, 0], "quaternion_xyzw": quaternion}),
            ("tool", "quaternion"),
        )
        for why, quaternion in (
            ("zero", [0, 0, 0, 0]),
            ("of three entries", [0, 0, 1]),
        )
    ),
)
"""Base and tool are poses: one position, one orientation, and that a rotation to 1e-6."""

REFUSED_DH: tuple[RefusedDh, ...] = (*TABLES, *JOINTS, *FOLLOWERS, *NUMBERS, *POSES)


# --- Whole bodies of POST /v1/robots ---

URDF = '<robot name="stone"><link name="base"/></robot>'


def body(**fields: object) -> bytes:
    """A request body of these fields, in plain ASCII: what lies outside is escaped."""
    return json.dumps(fields).encode()


def alpha(token: str) -> bytes:
    """The good body with this, as it is, in the place of a number."""
    return body(name="arm", dh=elbow(alpha="TOKEN")).replace(b'"TOKEN"', token.encode())


def named(name: object) -> bytes:
    """The good body under this name."""
    return body(name=name, dh=TABLE)


GOOD_BODY = named("arm")

NOT_JSON = (
    ("empty body", b""),
    ("truncated", GOOD_BODY[:-2]),
    ("truncated within a text", GOOD_BODY[: GOOD_BODY.index(b"elbow") + 2]),
    ("text after the end", GOOD_BODY + b"}"),
    ("trailing comma", GOOD_BODY[:-1] + b",}"),
    ("comment", b"/* arm */" + GOOD_BODY),
    ("single quotes", GOOD_BODY.replace(b'"', b"'")),
    ("UTF-16", GOOD_BODY.decode().encode("utf-16")),
    ("UTF-16 without a mark", GOOD_BODY.decode().encode("utf-16-le")),
    ("UTF-32", GOOD_BODY.decode().encode("utf-32")),
    ("invalid UTF-8", GOOD_BODY.replace(b"elbow", b"el\xffbow")),
    ("surrogate as raw UTF-8", GOOD_BODY.replace(b"elbow", b"el\xed\xa0\x80bow")),
    ("NUL after the end", GOOD_BODY + b"\0"),
    ("raw NUL in a text", GOOD_BODY.replace(b"elbow", b"el\0bow")),
    ("100,000 brackets in a field", alpha("[" * 100_000 + "]" * 100_000)),
    ("100,000 brackets", b"[" * 100_000 + b"]" * 100_000),
    ("100,000 open brackets", b"[" * 100_000),
    ("100,000 braces", b'{"dh":' * 100_000 + b"1" + b"}" * 100_000),
)
"""Not JSON in UTF-8, or nested deeper than a recursive parser has stack."""

BAD_TOKENS = tuple(
    (f"number {name}", alpha(token))
    for name, token in (
        ("NaN", "NaN"),
        ("Infinity", "Infinity"),
        ("minus Infinity", "-Infinity"),
        ("1e400", "1e400"),
        ("-1e400", "-1e400"),
        ("of 5,000 digits", "9" * 5_000),
        ("hexadecimal", "0x10"),
        ("with a plus sign", "+1"),
        ("with a leading zero", "01"),
        ("as a text", '"1.5"'),
        ("true", "true"),
        ("null", "null"),
        ("missing", ""),
    )
)
"""In the place of a number. Python's own JSON takes the first five, and sends them out again."""

BAD_SHAPES = (
    ("top-level list", b"[" + GOOD_BODY + b"]"),
    ("top-level null", b"null"),
    ("top-level text", b'"arm"'),
    ("top-level number", b"1"),
    ("empty object", b"{}"),
    ("both urdf and dh", body(name="arm", urdf=URDF, dh=TABLE)),
    ("neither urdf nor dh", body(name="arm")),
    ("urdf null", body(name="arm", urdf=None)),
    ("dh null", body(name="arm", dh=None)),
    ("both null", body(name="arm", urdf=None, dh=None)),
    ("urdf a number", body(name="arm", urdf=1)),
    ("urdf a list of lines", body(name="arm", urdf=[URDF])),
    ("urdf an object", body(name="arm", urdf={"robot": {}})),
    ("urdf empty", body(name="arm", urdf="")),
    ("dh a list", body(name="arm", dh=[TABLE])),
    ("dh a text", body(name="arm", dh=json.dumps(TABLE))),
    ("description a number", body(name="arm", dh=TABLE, description=1)),
    ("default_chain a text", body(name="arm", dh=TABLE, default_chain="base")),
    ("unknown field", body(name="arm", dh=TABLE, colour="red")),
    ("lone surrogate in urdf", body(name="arm", urdf=URDF.replace("base", "ba\ud800se"))),
    ("lone surrogate in a joint name", body(name="arm", dh=elbow(name="el\ud800bow"))),
    ("lone surrogate in the description", body(name="arm", dh=TABLE, description="\udc00")),
)
"""JSON, but not this request. A lone surrogate passes most parsers and fails when it is written out again."""

BAD_NAMES = (
    ("name missing", body(dh=TABLE)),
    *(
        (f"name {why}", named(name))
        for why, name in (
            ("null", None),
            ("a number", 7),
            ("true", True),
            ("a list", ["arm"]),
            ("empty", ""),
            ("of 65 characters", "a" * 65),
            ("with a slash", "robots/arm"),
            ("with a backslash", "robots\\arm"),
            ("one dot", "."),
            ("two dots", ".."),
            ("with a dot first", ".arm"),
            ("with a hyphen first", "-arm"),
            ("with a space", "my arm"),
            ("with a newline at its end", "arm\n"),
            ("with NUL", "arm\0"),
            ("with a percent sign", "arm%2Fleg"),
            ("outside ASCII", "ärm"),
            ("in Arabic digits", "\u0661"),
            ("with a lone surrogate", "arm\ud800"),
        )
    ),
)
"""A name becomes a folder and a part of an address.

A pattern that ends in `$` lets the newline through, one with `\\w` the letters and digits outside ASCII.
"""

REFUSED_JSON: tuple[tuple[str, bytes], ...] = (*NOT_JSON, *BAD_TOKENS, *BAD_SHAPES, *BAD_NAMES)
