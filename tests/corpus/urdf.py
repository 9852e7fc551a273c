"""Robot descriptions with their verdict: `REFUSED`, `EXPANDED`, `FORGIVEN`, `ODD`, `MISSING_MESHES`, `VALID`.

A text reaches the reader as UTF-8. Most of them are one small arm, a `base` that carries a `forearm` by the
joint `elbow`, with one thing changed; as it stands the arm is valid and gives no warning. `mentions` are
lower-case words that the lower-cased message has to contain to be of use: the name of the culprit and what is
wrong with it. It is empty where good messages share no word.
"""

from typing import NamedTuple


class Refused(NamedTuple):
    """A description that is not a robot, or not one that we take."""

    name: str
    text: str
    mentions: tuple[str, ...]


class Odd(NamedTuple):
    """A description to be accepted with a warning."""

    name: str
    text: str
    mentions: tuple[str, ...]


class Valid(NamedTuple):
    """A description to be accepted without a warning; `joint_count` leaves out fixed and mimic joints."""

    name: str
    text: str
    joint_count: int


# --- The small arm, and the pieces to change in it ---

AXIS = '<axis xyz="0 0 1"/>'
LIMIT = '<limit lower="-1" upper="1" effort="10" velocity="2"/>'
MOVING = AXIS + LIMIT
MIMIC = '<mimic joint="thumb"/>'


def inertial(mass: str = "1", ixx: str = "1", iyy: str = "1", izz: str = "1", ixy: str = "0") -> str:
    """The inertial element of a link."""
    moments = f'ixx="{ixx}" iyy="{iyy}" izz="{izz}" ixy="{ixy}" ixz="0" iyz="0"'
    return f'<inertial><mass value="{mass}"/><inertia {moments}/></inertial>'


INERTIAL = inertial()


def link(name: str, body: str = INERTIAL) -> str:
    """A link; with mass and inertia unless a body is given."""
    return f'<link name="{name}">{body}</link>'


def joint(name: str, parent: str, child: str, body: str = MOVING, kind: str = "revolute") -> str:
    """A joint between two links; revolute about z unless told otherwise."""
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{body}</joint>'


def fixed(name: str, parent: str, child: str) -> str:
    """A fixed joint."""
    return joint(name, parent, child, body="", kind="fixed")


def robot(*parts: str) -> str:
    """A robot of these links and joints."""
    return f'<robot name="arm">{"".join(parts)}</robot>'


def one_joint(body: str = MOVING, kind: str = "revolute") -> str:
    """The arm, with this inside its joint `elbow`."""
    return robot(link("base"), link("forearm"), joint("elbow", "base", "forearm", body, kind))


def one_link(body: str) -> str:
    """The arm, with this inside its link `forearm`."""
    return robot(link("base"), link("forearm", body), joint("elbow", "base", "forearm"))


def one_shape(shape: str) -> str:
    """The arm, with this as the visual geometry of its `forearm`."""
    return one_link(INERTIAL + f"<visual><geometry>{shape}</geometry></visual>")


def arm_and(*parts: str) -> str:
    """The arm, with these beside its links and its joint."""
    return robot(link("base"), link("forearm"), joint("elbow", "base", "forearm"), *parts)


def gripper(mimic: str, kind: str = "revolute", leader: str = "revolute") -> str:
    """Two fingers on a base: `thumb` leads, `finger` carries this mimic element."""
    return robot(
        link("base"),
        link("thumb_tip"),
        link("finger_tip"),
        joint("thumb", "base", "thumb_tip", MOVING, leader),
        joint("finger", "base", "finger_tip", MOVING + mimic, kind),
    )


def followers(leaders: dict[str, str], multiplier: str = "1") -> str:
    """Joints on one base, each a follower of the joint that it is mapped to."""
    return robot(
        link("base"),
        *(link(f"{name}_tip") for name in leaders),
        *(
            joint(name, "base", f"{name}_tip", f'{MOVING}<mimic joint="{leader}" multiplier="{multiplier}"/>')
            for name, leader in leaders.items()
        ),
    )


def star(links: int, kind: str = "fixed", body: str = "") -> str:
    """One hub with all other links directly on it."""
    rays = range(1, links)
    return robot(
        link("hub"),
        *(link(f"ray_{i}") for i in rays),
        *(joint(f"to_ray_{i}", "hub", f"ray_{i}", body, kind) for i in rays),
    )


def chain(links: int) -> str:
    """Links in a row, fixed to each other."""
    return robot(
        *(link(f"bead_{i}") for i in range(links)),
        *(fixed(f"thread_{i}", f"bead_{i - 1}", f"bead_{i}") for i in range(1, links)),
    )


def shapes(visuals: int, collisions: int = 0) -> str:
    """The arm, with that many spheres on its `forearm`."""
    sphere = '<geometry><sphere radius="0.1"/></geometry>'
    drawn = f"<visual>{sphere}</visual>" * visuals + f"<collision>{sphere}</collision>" * collisions
    return one_link(INERTIAL + drawn)


def many_attributes(count: int) -> str:
    """Attributes that no element knows."""
    return " ".join(f'a{i}=""' for i in range(count))


# --- Refused ---

ARM = one_joint()
XACRO_ARM = ARM.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"')

XML = (
    Refused("empty text", "", ()),
    Refused("white space only", " \n\t", ()),
    Refused("not XML", "solid forearm", ("xml",)),
    Refused("JSON instead of XML", '{"robot": "arm"}', ("xml",)),
    Refused("truncated between elements", ARM.removesuffix("</robot>"), ("xml",)),
    Refused("truncated within a tag", ARM[: len(ARM) // 2], ("xml",)),
    Refused("tags that cross", '<robot name="arm"><link name="base"></robot></link>', ("xml",)),
    Refused("an attribute twice", '<robot name="arm"><link name="base" name="foot"/></robot>', ("xml",)),
    Refused("two root elements", ARM + ARM, ("xml",)),
    Refused("text after the root element", ARM + "the end", ("xml",)),
    Refused("other root element", '<sdf version="1.9"><model name="arm"/></sdf>', ("robot",)),
    Refused("root element in capitals", '<Robot name="arm"><link name="base"/></Robot>', ("robot",)),
)
"""Not XML, or XML that is not a robot. Lenient parsers repair the truncated ones into a shorter robot."""

LAUGHS = "".join(f'<!ENTITY laugh{i} "{f"&laugh{i - 1};" * 10}">' for i in range(1, 10))
FORBIDDEN_XML = (
    Refused("document type alone", "<!DOCTYPE robot>" + ARM, ()),
    Refused("document type elsewhere", '<!DOCTYPE robot SYSTEM "http://example.org/robot.dtd">' + ARM, ()),
    Refused("internal entity", f'<!DOCTYPE robot [<!ENTITY one "1">]>{one_link(inertial(mass="&one;"))}', ()),
    Refused(
        "billion laughs",
        f'<!DOCTYPE robot [<!ENTITY laugh0 "ha">{LAUGHS}]>{one_link(INERTIAL + "&laugh9;")}',
        (),
    ),
    Refused(
        "external entity",
        f'<!DOCTYPE robot [<!ENTITY file SYSTEM "file:///etc/passwd">]>{one_link(INERTIAL + "&file;")}',
        (),
    ),
    Refused("parameter entity", '<!DOCTYPE robot [<!ENTITY % more SYSTEM "more.dtd"> %more;]>' + ARM, ()),
    Refused("undefined entity", one_link(INERTIAL + "&nobody;"), ()),
    *(
        Refused(f"encoding {encoding}", f'<?xml version="1.0" encoding="{encoding}"?>{ARM}', ("utf-8",))
        for encoding in ("utf-16", "utf-32", "utf-7", "latin-1", "iso-8859-1", "windows-1252")
    ),
)
"""Entities read files and grow without bound; a second encoding lets two readers see two different robots."""

CHARACTERS = (
    Refused("NUL after the root element", ARM + "\0", ()),
    Refused("NUL and more after the root element", ARM + "\0" + ARM, ()),
    Refused("NUL between elements", one_joint(AXIS + "\0" + LIMIT), ()),
    Refused("NUL in a name", ARM.replace("elbow", "el\0bow"), ()),
    Refused("NUL reference in a name", ARM.replace("elbow", "el&#0;bow"), ()),
    Refused("control character in a name", ARM.replace("elbow", "el\x01bow"), ()),
    Refused("control reference in a name", ARM.replace("elbow", "el&#1;bow"), ()),
    Refused("terminal escape in a name", ARM.replace("forearm", "\x1b[2Jforearm"), ()),
    Refused("lone surrogate in a name", ARM.replace("elbow", "el\ud800bow"), ()),
    Refused("surrogate reference in a name", ARM.replace("elbow", "el&#xD800;bow"), ()),
    Refused("newline reference in a joint name", ARM.replace("elbow", "el&#10;bow"), ("name",)),
    Refused("tab reference in a link name", ARM.replace("forearm", "fore&#9;arm"), ("name",)),
    Refused("delete reference in a joint name", ARM.replace("elbow", "el&#x7f;bow"), ("name",)),
    Refused("C1 control reference in a link name", ARM.replace("forearm", "fore&#x85;arm"), ("name",)),
)
"""Names reach logs, terminals, file names and C strings. The last four are well-formed XML all the same."""

NAMES = (
    Refused("link without a name", arm_and("<link/>"), ("link", "name")),
    Refused("link with an empty name", arm_and('<link name=""/>'), ("link", "name")),
    Refused("joint without a name", ARM.replace(' name="elbow"', ""), ("joint", "name")),
    Refused("joint with an empty name", ARM.replace("elbow", ""), ("joint", "name")),
    Refused("two links of one name", arm_and(link("forearm")), ("forearm", "link")),
    Refused(
        "two joints of one name",
        arm_and(link("hand"), joint("elbow", "forearm", "hand")),
        ("elbow", "joint"),
    ),
    Refused("link name of 10,000 characters", ARM.replace("forearm", "f" * 10_000), ("name",)),
    Refused("joint name of 10,000 characters", ARM.replace("elbow", "e" * 10_000), ("name",)),
)
"""Everything is addressed by name, so a name is there, is unique, and can be printed."""

HOOPS = link("hoop_1") + link("hoop_2") + link("hoop_3")
TREE = (
    Refused("no links", '<robot name="arm"/>', ("link",)),
    Refused(
        "no root, a cycle of three",
        robot(
            HOOPS,
            joint("hoop_12", "hoop_1", "hoop_2"),
            joint("hoop_23", "hoop_2", "hoop_3"),
            joint("hoop_31", "hoop_3", "hoop_1"),
        ),
        ("hoop",),
    ),
    Refused("two roots", arm_and(link("pedestal")), ("base", "pedestal")),
    Refused(
        "two roots with their own trees",
        arm_and(link("pedestal"), link("lamp"), joint("neck", "pedestal", "lamp")),
        ("base", "pedestal"),
    ),
    *(
        Refused(
            name,
            arm_and(
                HOOPS,
                joint("hoop_01", "forearm", "hoop_1"),
                joint("hoop_12", "hoop_1", "hoop_2"),
                joint("hoop_23", "hoop_2", "hoop_3"),
                joint(closing, "hoop_3", "hoop_1"),
            ),
            ("hoop",),
        )
        for name, closing in (
            ("cycle below a root", "hoop_31"),
            ("cycle whose closing joint sorts first", "a_hoop"),
        )
    ),
    Refused(
        "cycle apart from the tree",
        arm_and(HOOPS, *(joint(f"hoop_{a}{b}", f"hoop_{a}", f"hoop_{b}") for a, b in ("12", "23", "31"))),
        ("hoop",),
    ),
    Refused(
        "joint from a link to itself",
        robot(link("base"), link("forearm"), joint("elbow", "forearm", "forearm")),
        ("elbow",),
    ),
    Refused("two parents, each a root", arm_and(link("stand"), joint("wrist", "stand", "forearm")), ()),
    Refused(
        "two parents in a diamond",
        arm_and(
            link("left"),
            link("hand"),
            joint("to_left", "base", "left"),
            joint("left_hand", "left", "hand"),
            joint("right_hand", "forearm", "hand"),
        ),
        ("hand",),
    ),
    Refused(
        "two joints between the same links",
        robot(
            link("base"),
            link("wrist"),
            joint("wrist_1", "base", "wrist"),
            joint("wrist_2", "base", "wrist"),
        ),
        ("wrist",),
    ),
)
"""A robot is one tree. Some of these crash other readers; in others links vanish or a joint counts twice.

Where a message may name either a link or a joint, both carry the word that is asked for.
"""

PARENT = '<parent link="base"/>'
CHILD = '<child link="forearm"/>'
JOINTS = (
    Refused("joint without a parent", ARM.replace(PARENT, ""), ("elbow", "parent")),
    Refused("joint without a child", ARM.replace(CHILD, ""), ("elbow", "child")),
    Refused("joint with two parents", one_joint(MOVING + '<parent link="foot"/>'), ("elbow", "parent")),
    Refused("joint with two children", one_joint(MOVING + '<child link="hand"/>'), ("elbow", "child")),
    Refused("parent element without a link", ARM.replace(PARENT, "<parent/>"), ("elbow", "parent")),
    Refused("child element without a link", ARM.replace(CHILD, "<child/>"), ("elbow", "child")),
    Refused("unknown parent", ARM.replace(PARENT, '<parent link="phantom"/>'), ("elbow", "phantom")),
    Refused("unknown child", ARM.replace(CHILD, '<child link="phantom"/>'), ("elbow", "phantom")),
    Refused("unknown joint type", one_joint(kind="helical"), ("elbow", "type")),
    Refused("joint type in capitals", one_joint(kind="REVOLUTE"), ("elbow", "type")),
    Refused("empty joint type", one_joint(kind=""), ("elbow", "type")),
    Refused("missing joint type", ARM.replace(' type="revolute"', ""), ("elbow", "type")),
    Refused("revolute without a limit", one_joint(AXIS), ("elbow", "limit")),
    Refused("prismatic without a limit", one_joint(AXIS, "prismatic"), ("elbow", "limit")),
    Refused(
        "lower above the upper that is left out",
        one_joint(AXIS + '<limit lower="1" effort="10" velocity="2"/>'),
        ("elbow", "lower"),
    ),
    Refused(
        "lower above upper",
        one_joint(AXIS + '<limit lower="1" upper="-1" effort="10" velocity="2"/>'),
        ("elbow", "lower"),
    ),
    Refused(
        "prismatic with lower above upper",
        one_joint(AXIS + '<limit lower="1" upper="-1" effort="10" velocity="2"/>', "prismatic"),
        ("elbow", "lower"),
    ),
)
"""A joint has one parent, one child, one known type, and limits that leave somewhere to be."""

AXES = (
    *(
        Refused(f"{kind} with a zero axis", one_joint('<axis xyz="0 0 0"/>' + LIMIT, kind), ("elbow", "axis"))
        for kind in ("revolute", "continuous", "prismatic")
    ),
    *(
        Refused(f"axis {xyz}", one_joint(f'<axis xyz="{xyz}"/>' + LIMIT), ("elbow", "axis"))
        for xyz in ("0 0 1e-200", "0 0 1e-400", "0 0 1e308", "1e200 1e200 0")
    ),
    Refused("axis without xyz", one_joint("<axis/>" + LIMIT), ("elbow", "axis")),
)
"""No direction, or one whose length under- or overflows: taken as it is, it makes a rotation of zeros."""

REPEATED = (
    Refused("two origins", one_joint(MOVING + '<origin xyz="1 0 0"/><origin xyz="2 0 0"/>'), ("elbow", "origin")),
    Refused("two axes", one_joint(MOVING + '<axis xyz="1 0 0"/>'), ("elbow", "axis")),
    Refused(
        "two limits",
        one_joint(MOVING + '<limit lower="-2" upper="2" effort="10" velocity="2"/>'),
        ("elbow", "limit"),
    ),
    Refused("two mimics", gripper(MIMIC + MIMIC.replace("/>", ' offset="1"/>')), ("finger", "mimic")),
)
"""Readers differ in whether the first or the last one counts, so neither does."""

NOT_A_NUMBER = {
    "nan": "NaN",
    "infinity": "inf",
    "minus infinity": "-Infinity",
    "too large for a double": "1e400",
    "hexadecimal": "0x10",
    "a word": "one",
    "cut short": "1e",
    "with a decimal comma": "0,5",
    "with an underscore": "1_0",
    "in Arabic digits": "\u0661",
    "a xacro expression": "${pi/2}",
}
"""What Python's float() or C's strtod() may take, and what no one takes."""

BAD_SCALARS = {**NOT_A_NUMBER, "empty": "", "two numbers": "1 1"}
BAD_VECTORS = {
    **{f"{why} within": f"1 {number} 0" for why, number in NOT_A_NUMBER.items()},
    "empty": "",
    "too short": "1 0",
    "too long": "1 0 0 0",
    "separated by commas": "1,0,0",
    "separated by commas and spaces": "1, 0, 0",
    "separated by semicolons": "1;0;0",
}

SCALARS = (
    ("elbow", "lower", one_joint(AXIS + '<limit lower="{}" upper="100" effort="10" velocity="2"/>')),
    ("elbow", "upper", one_joint(AXIS + '<limit lower="-100" upper="{}" effort="10" velocity="2"/>')),
    ("elbow", "effort", one_joint(AXIS + '<limit lower="-1" upper="1" effort="{}" velocity="2"/>')),
    ("elbow", "velocity", one_joint(AXIS + '<limit lower="-1" upper="1" effort="10" velocity="{}"/>')),
    ("finger", "multiplier", gripper('<mimic joint="thumb" multiplier="{}"/>')),
    ("finger", "offset", gripper('<mimic joint="thumb" offset="{}"/>')),
)

VECTORS = (
    ("elbow", "origin", one_joint('<origin xyz="{}"/>' + MOVING)),
    ("elbow", "rpy", one_joint('<origin rpy="{}"/>' + MOVING)),
    ("elbow", "axis", one_joint('<axis xyz="{}"/>' + LIMIT)),
)

NUMBERS = (
    *(
        Refused(f"{owner} {field} {why}", text.format(number), (owner, field))
        for owner, field, text in SCALARS
        for why, number in BAD_SCALARS.items()
    ),
    *(
        Refused(f"{owner} {field} {why}", text.format(numbers), (owner, field))
        for owner, field, text in VECTORS
        for why, numbers in BAD_VECTORS.items()
    ),
)
"""Every kind of number against everything that is not one: a NaN let in here comes out as a pose."""

VALUES = (
    *(
        Refused(f"joint {xyz} m away", one_joint(f'<origin xyz="{xyz}"/>' + MOVING), ("elbow", "origin"))
        for xyz in ("1e300 0 0", "0 -1e300 0", "0 0 2e6")
    ),
)
"""Finite, but no robot: nothing lies more than 1e6 m away."""

MIMICS = (
    Refused("mimic without a joint", gripper("<mimic/>"), ("finger", "mimic")),
    Refused("mimic of an unknown joint", gripper('<mimic joint="phantom"/>'), ("finger", "phantom")),
    Refused("mimic of a link", gripper('<mimic joint="thumb_tip"/>'), ("finger", "thumb_tip")),
    Refused("mimic of itself", gripper('<mimic joint="finger"/>'), ("finger", "mimic")),
    Refused(
        "mimics in a circle of two",
        followers({"finger_1": "finger_2", "finger_2": "finger_1"}),
        ("finger", "mimic"),
    ),
    Refused(
        "mimics in a circle of three",
        followers({"finger_1": "finger_2", "finger_2": "finger_3", "finger_3": "finger_1"}),
        ("finger", "mimic"),
    ),
    *(
        Refused(f"mimic of a {kind} joint", gripper(MIMIC, leader=kind), ("finger", "mimic"))
        for kind in ("fixed", "planar", "floating")
    ),
    *(
        Refused(f"mimic by a {kind} joint", gripper(MIMIC, kind), ("finger", "mimic"))
        for kind in ("planar", "floating")
    ),
    *(
        Refused(
            f"mimic with {field} {number}",
            gripper(f'<mimic joint="thumb" {field}="{number}"/>'),
            ("finger", field),
        )
        for field in ("multiplier", "offset")
        for number in ("1e308", "-1e308")
    ),
    Refused(
        "mimic multipliers whose product overflows",
        followers({f"finger_{i}": f"finger_{i + 1}" for i in range(110)}, "1e3").replace(
            "</robot>", link("finger_tip") + joint("finger_110", "base", "finger_tip") + "</robot>"
        ),
        ("finger", "multiplier"),
    ),
)
"""A mimic follows one movable joint by a factor that stays finite, and in the end someone leads."""

XACRO = tuple(
    Refused(
        f"xacro {element.split()[0]} left in",
        XACRO_ARM.replace("</robot>", f"<xacro:{element}/></robot>"),
        ("xacro",),
    )
    for element in (
        'macro name="leg" params="side"',
        'include filename="leg.xacro"',
        'property name="r" value="1"',
    )
) + tuple(
    Refused(
        f"xacro block left in a {place}",
        XACRO_ARM.replace(f"</{place}>", f'<xacro:insert_block name="where"/></{place}>', 1),
        ("xacro",),
    )
    for place in ("joint", "link")
)
"""A xacro file that was not expanded: its robot lies elsewhere, and what remains would be a wrong one."""

SIZES = (
    Refused("513 links in a star", star(513), ("link", "512")),
    Refused("513 links in a chain", chain(513), ()),
    Refused("chain of 258 links", chain(258), ("256",)),
    Refused("129 degrees of freedom", star(130, "revolute", MOVING), ("128",)),
    Refused("513 visuals", shapes(513), ("512",)),
    Refused("600 visuals", shapes(600), ("512",)),
    Refused("300 visuals and 300 collisions", shapes(300, 300), ("512",)),
    Refused("elements nested 10,000 deep", arm_and("<a>" * 10_000 + "</a>" * 10_000), ()),
    Refused(
        "100,000 attributes",
        one_joint(f'<axis xyz="0 0 1" {many_attributes(100_000)}/>' + LIMIT),
        ("attribute",),
    ),
    Refused("more than 2 MiB", ARM + f"<!--{'x' * 2 * 1024 * 1024}-->", ()),
    Refused("more than 2 MiB in few characters", ARM + f"<!--{'ä' * 1024 * 1024}-->", ()),
)
"""Beyond the limits: each of these costs a parser, a stack or a matrix far more than it cost to send."""

EXPANDED = frozenset({"xacro macro left in", "xacro property left in"})
"""What the reader of URDFs refuses, and an upload of a robot expands first."""
REFUSED: tuple[Refused, ...] = (
    *XML,
    *FORBIDDEN_XML,
    *CHARACTERS,
    *NAMES,
    *TREE,
    *JOINTS,
    *AXES,
    *REPEATED,
    *NUMBERS,
    *VALUES,
    *MIMICS,
    *XACRO,
    *SIZES,
)

# --- Forgiven: accepted with a warning, as kinematics does not feel it, and refused by the strict reading ---

FORGIVEN: tuple[Refused, ...] = (
    Refused("two inertials", one_link(INERTIAL + inertial("2")), ("forearm", "inertial")),
    Refused(
        "two masses",
        one_link(INERTIAL.replace('<mass value="1"/>', '<mass value="1"/><mass value="2"/>')),
        ("forearm", "mass"),
    ),
    Refused("negative mass", one_link(inertial(mass="-1")), ("forearm", "mass")),
    Refused(
        "xacro block left in an inertial",
        XACRO_ARM.replace("</inertial>", '<xacro:insert_block name="where"/></inertial>', 1),
        ("xacro",),
    ),
    Refused("negative radius of a sphere", one_shape('<sphere radius="-1"/>'), ("forearm", "radius")),
    Refused("negative radius", one_shape('<cylinder radius="-1" length="1"/>'), ("forearm", "radius")),
    Refused("negative length", one_shape('<cylinder radius="1" length="-1"/>'), ("forearm", "length")),
    Refused("negative size", one_shape('<box size="1 -1 1"/>'), ("forearm", "size")),
    Refused("sphere without a radius", one_shape("<sphere/>"), ("forearm", "radius")),
    Refused("box without a size", one_shape("<box/>"), ("forearm", "size")),
    Refused("mesh without a file name", one_shape("<mesh/>"), ("forearm", "mesh")),
    Refused("mesh with an empty file name", one_shape('<mesh filename=""/>'), ("forearm", "mesh")),
    Refused(
        "two shapes in one geometry",
        one_shape('<sphere radius="1"/><box size="1 1 1"/>'),
        ("forearm", "geometry"),
    ),
    Refused(
        "two geometries in one visual",
        one_shape('<sphere radius="1"/></geometry><geometry><box size="1 1 1"/>'),
        ("forearm", "geometry"),
    ),
    *(
        Refused(f"forearm {field} {why}", text.format(number), ("forearm", field))
        for field, text in (
            ("mass", one_link(inertial(mass="{}"))),
            ("ixx", one_link(inertial(ixx="{}"))),
            ("ixy", one_link(inertial(ixy="{}"))),
            ("radius", one_shape('<sphere radius="{}"/>')),
            ("length", one_shape('<cylinder radius="0.1" length="{}"/>')),
        )
        for why, number in BAD_SCALARS.items()
    ),
    *(
        Refused(f"forearm {field} {why}", text.format(numbers), ("forearm", field))
        for field, text in (
            ("origin", one_link(INERTIAL.replace("<mass", '<origin xyz="{}"/><mass'))),
            ("size", one_shape('<box size="{}"/>')),
            ("scale", one_shape('<mesh filename="package://arm/forearm.stl" scale="{}"/>')),
        )
        for why, numbers in BAD_VECTORS.items()
    ),
)
"""Masses that no body has, and shapes that a browser cannot draw."""

# --- Odd: accepted, with a warning ---

ODD_JOINTS = (
    Odd("continuous with position limits", one_joint(kind="continuous"), ("elbow", "limit")),
    Odd("axis of length two", one_joint('<axis xyz="0 0 2"/>' + LIMIT), ("elbow", "axis")),
    Odd(
        "prismatic axis of length √2",
        one_joint('<axis xyz="1 1 0"/>' + LIMIT, "prismatic"),
        ("elbow", "axis"),
    ),
    Odd("revolute without an axis", one_joint(LIMIT), ("elbow", "axis")),
    Odd("prismatic without an axis", one_joint(LIMIT, "prismatic"), ("elbow", "axis")),
    Odd(
        "continuous without an axis",
        one_joint('<limit effort="10" velocity="2"/>', "continuous"),
        ("elbow", "axis"),
    ),
    *(
        Odd(f"limit with only {which} end", one_joint(AXIS + limit), ("elbow", missing))
        for which, missing, limit in (
            ("a lower", "upper", LIMIT.replace(' upper="1"', "")),
            ("an upper", "lower", LIMIT.replace(' lower="-1"', "")),
        )
    ),
    Odd("limit without ends", one_joint(AXIS + '<limit effort="10" velocity="2"/>'), ("elbow", "lower")),
    Odd("mimic by a fixed joint", gripper(MIMIC, "fixed"), ("finger", "mimic")),
    *(
        Odd(f"limit with {why} {field}", one_joint(AXIS + limit), ("elbow", field))
        for field, value in (("effort", "10"), ("velocity", "2"))
        for why, limit in (
            ("no", LIMIT.replace(f' {field}="{value}"', "")),
            ("zero", LIMIT.replace(f'{field}="{value}"', f'{field}="0"')),
        )
    ),
    Odd(
        "floating joint outside the chain",
        arm_and(link("drone"), joint("flight", "base", "drone", "", "floating")),
        ("flight", "floating"),
    ),
    Odd(
        "planar joint outside the chain",
        arm_and(link("sledge"), joint("glide", "base", "sledge", AXIS, "planar")),
        ("glide", "planar"),
    ),
)
"""Kinematics can be computed, though not quite as written: a default steps in, or a value is ignored."""

ODD_LINKS = (
    Odd("moving link without inertia", one_link(""), ("forearm", "inertia")),
    Odd("inertia against the triangle inequality", one_link(inertial(izz="3")), ("forearm", "inertia")),
    Odd("negative moment of inertia", one_link(inertial(ixx="-1")), ("forearm", "inertia")),
    Odd("inertia with too large a product", one_link(inertial(ixy="5")), ("forearm", "inertia")),
    Odd("zero mass with inertia", one_link(inertial(mass="0")), ("forearm", "mass")),
)
"""Poses are right all the same; dynamics will not be."""

MESHES_ELSEWHERE = tuple(
    Odd(name, one_shape(f'<mesh filename="{filename}"/>'), ("mesh", "not opened"))
    for name, filename in (
        ("mesh in a parent folder", "../secret.stl"),
        ("mesh in a parent folder of its package", "package://arm/meshes/../../../secret.stl"),
        ("mesh in a parent folder, with backslashes", "meshes\\..\\..\\secret.stl"),
        ("mesh by absolute path", "/etc/passwd"),
        ("mesh on another machine", "\\\\machine\\share\\secret.stl"),
        ("mesh on a drive", "C:\\secret.stl"),
        ("mesh by file address", "file:///etc/passwd"),
        ("mesh by file address in capitals", "FILE:///etc/passwd"),
        ("mesh by web address", "http://example.org/forearm.stl"),
        ("mesh by secure web address", "https://example.org/forearm.stl"),
    )
)
"""In our file system, or fetched by the viewer's browser from a third party: no one may follow these."""

MISSING_MESHES = (
    Odd(
        "visual mesh not sent along",
        one_shape('<mesh filename="package://arm/forearm.stl"/>'),
        ("forearm.stl",),
    ),
    Odd(
        "collision mesh not sent along",
        one_shape('<mesh filename="meshes/hull.obj"/>').replace("visual>", "collision>"),
        ("hull.obj",),
    ),
)
"""Valid by their text, which is all the reader sees: whoever takes in the files has to warn."""

UNKNOWN = (
    Odd("misspelt element in the robot", arm_and('<jiont name="wrist" type="fixed"/>'), ("jiont",)),
    Odd("misspelt element in a joint", one_joint(MOVING + '<orign xyz="1 0 0"/>'), ("elbow", "orign")),
    Odd("misspelt element in a link", one_link(INERTIAL + "<colision/>"), ("forearm", "colision")),
    Odd(
        "misspelt element in an inertial",
        ARM.replace("<inertial>", '<inertial><orign xyz="1 0 0"/>'),
        ("base", "orign"),
    ),
    Odd(
        "misspelt element in a visual",
        one_link(INERTIAL + '<visual><geometry><sphere radius="1"/></geometry><orign/></visual>'),
        ("forearm", "orign"),
    ),
    Odd("unknown attribute of a joint", ARM.replace(' type="', ' colour="red" type="'), ("elbow", "colour")),
    Odd(
        "unknown attribute of a link",
        ARM.replace('name="forearm"', 'name="forearm" colour="red"'),
        ("colour",),
    ),
    Odd("misspelt attribute of an origin", one_joint(MOVING + '<origin xzy="1 0 0"/>'), ("elbow", "xzy")),
)
"""Often a slip of the pen: a misspelt origin is a joint in the wrong place, and nothing else would tell."""

ODD: tuple[Odd, ...] = (*ODD_JOINTS, *ODD_LINKS, *MESHES_ELSEWHERE, *UNKNOWN)


# --- Valid: accepted, without a warning ---

WHEEL = AXIS + '<limit effort="10" velocity="2"/>'

PLAIN = (
    Valid("one link", '<robot name="stone"><link name="base"/></robot>', 0),
    Valid("one revolute joint", one_joint('<origin xyz="0 0 0.3" rpy="0 1.57 0"/>' + MOVING), 1),
    Valid("one continuous joint", one_joint(WHEEL, "continuous"), 1),
    Valid("joint without an origin", ARM, 1),
    Valid("origin without attributes", one_joint("<origin/>" + MOVING), 1),
    Valid("fixed joints only", robot(*map(link, "abc"), fixed("ab", "a", "b"), fixed("bc", "b", "c")), 0),
    Valid(
        "prismatic first joint",
        robot(
            link("rail"),
            link("carriage"),
            link("arm"),
            joint("slide", "rail", "carriage", kind="prismatic"),
            joint("swing", "carriage", "arm"),
        ),
        2,
    ),
    Valid(
        "joints before links, children first",
        robot(
            joint("wrist", "forearm", "hand"),
            joint("elbow", "base", "forearm"),
            link("hand"),
            link("forearm"),
            link("base"),
        ),
        2,
    ),
    Valid(
        "lower equal to upper",
        one_joint(AXIS + '<limit lower="0.5" upper="0.5" effort="10" velocity="2"/>'),
        1,
    ),
)
"""The format's plain cases, in whatever order it allows."""

WRITTEN = (
    Valid("UTF-8 declared", f'<?xml version="1.0" encoding="UTF-8"?>\n{ARM}', 1),
    Valid("utf-8 declared in small letters", f"<?xml version='1.0' encoding='utf-8'?>\n{ARM}", 1),
    Valid("comment and processing instruction first", f"<?editor vi?><!-- an arm -->{ARM}", 1),
    Valid("comments everywhere", ARM.replace("><", "><!-- and -->\n<"), 1),
    Valid("byte order mark", "\ufeff" + ARM, 1),
    Valid("byte order mark and declaration", f'\ufeff<?xml version="1.0" encoding="utf-8"?>{ARM}', 1),
    Valid("Windows line ends", ARM.replace("><", ">\r\n<"), 1),
    Valid("xacro namespace declared", XACRO_ARM, 1),
    Valid("tabs and newlines in numbers", one_joint('<axis xyz="\t0\n 0\r\n1 "/>' + LIMIT), 1),
    Valid("exponents, plus signs, bare points", one_joint('<origin xyz="+1e-3 -.5E+0 2."/>' + MOVING), 1),
    Valid("names outside ASCII", ARM.replace("forearm", "Glied_ä").replace("elbow", "Gelenk_β"), 1),
    Valid("names by character reference", ARM.replace("forearm", "Glied_&#228;"), 1),
    Valid("predefined entities in a name", ARM.replace("forearm", "&lt;fore&amp;arm&gt;"), 1),
)
"""The same arm as editors and exporters write it."""

REVERSED = '<mimic joint="thumb" multiplier="-0.5" offset="0.1"/>'
LED = (
    Valid("mimic", gripper(REVERSED), 1),
    Valid("mimic with defaults", gripper(MIMIC), 1),
    Valid(
        "mimic of a leader defined later",
        robot(
            joint("finger", "base", "finger_tip", MOVING + REVERSED),
            joint("thumb", "base", "thumb_tip"),
            *map(link, ("base", "finger_tip", "thumb_tip")),
        ),
        1,
    ),
    Valid(
        "mimic of a leader further out",
        robot(
            *map(link, ("base", "finger_tip", "thumb_tip")),
            joint("finger", "base", "finger_tip", MOVING + REVERSED),
            joint("thumb", "finger_tip", "thumb_tip"),
        ),
        1,
    ),
    Valid(
        "mimic of a mimic",
        gripper(REVERSED).replace(
            "</robot>",
            link("pinky_tip") + joint("pinky", "base", "pinky_tip", MOVING + '<mimic joint="finger"/>') + "</robot>",
        ),
        1,
    ),
    Valid(
        "mimic of a continuous joint",
        robot(
            *map(link, ("base", "left_wheel", "right_wheel")),
            joint("left", "base", "left_wheel", WHEEL, "continuous"),
            joint("right", "base", "right_wheel", WHEEL + '<mimic joint="left"/>', "continuous"),
        ),
        1,
    ),
)
"""Followers in every arrangement that URDF allows; some readers know only leaders that come first."""

FURNISHED = (
    Valid(
        "all the known elements",
        arm_and(
            '<material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>',
            '<gazebo reference="forearm"><mu1>0.2</mu1><plugin name="p" filename="p.so"/></gazebo>',
            '<transmission name="gear"><type>transmission_interface/SimpleTransmission</type>'
            '<joint name="elbow"/><actuator name="motor"/></transmission>',
        )
        .replace("</joint>", '<dynamics damping="0.1" friction="0.2"/></joint>', 1)
        .replace(
            "</link>",
            '<visual name="tube"><origin xyz="0 0 1"/><material name="steel"/>'
            '<geometry><cylinder radius="0.1" length="2"/></geometry></visual>'
            '<collision><geometry><box size="0.2 0.2 2"/></geometry></collision></link>',
        ),
        1,
    ),
    Valid(
        "calibration and safety controller",
        one_joint(
            MOVING
            + '<calibration rising="0"/>'
            + '<safety_controller soft_lower_limit="-1" soft_upper_limit="1" k_position="9" k_velocity="1"/>'
        ),
        1,
    ),
    Valid("axis and limit on a fixed joint", one_joint(MOVING, "fixed"), 0),
)
"""What complete robots carry beside their kinematics; none of it deserves a warning."""

LARGEST = (
    Valid("512 links", star(512), 0),
    Valid("chain of 256 links", chain(256), 0),
    Valid("128 degrees of freedom", star(129, "revolute", MOVING), 128),
    Valid("512 geometries", shapes(256, 256), 1),
)
"""Just within the limits, so that these cut where they say."""

VALID: tuple[Valid, ...] = (*PLAIN, *WRITTEN, *LED, *FURNISHED, *LARGEST)
