"""The reader of robot descriptions against its corpus, against itself, and against mutations of real files."""

import sysconfig
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from gelenk.errors import InvalidUrdf
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from tests.corpus.urdf import ARM, MISSING_MESHES, ODD, REFUSED, VALID, Odd, Refused, Valid, one_joint
from tests.oracles import catalogue
from tests.robots import reread, samples, swept, without_warnings
from tests.speed import is_within

SECONDS = 1.0
"""What a hostile description may cost at most."""


@pytest.mark.parametrize("case", REFUSED, ids=lambda case: case.name)
def test_refused(case: Refused) -> None:
    start = process_time()
    with pytest.raises(InvalidUrdf) as caught:
        read_urdf(case.text)
    assert is_within(process_time() - start, SECONDS)
    message = str(caught.value)
    assert all(word in message.lower() for word in case.mentions), message
    assert message.isprintable()
    assert len(message) < 1000


@pytest.mark.parametrize("case", ODD, ids=lambda case: case.name)
def test_accepted_with_a_warning(case: Odd) -> None:
    warnings = read_urdf(case.text).warnings
    assert any(all(word in warning.lower() for word in case.mentions) for warning in warnings), warnings


@pytest.mark.parametrize("case", VALID, ids=lambda case: case.name)
def test_accepted_without_a_warning(case: Valid) -> None:
    description = read_urdf(case.text)
    assert description.warnings == ()
    assert len(description.movable) == case.joint_count


@pytest.mark.parametrize("case", MISSING_MESHES, ids=lambda case: case.name)
def test_meshes_are_named_and_not_looked_for(case: Odd) -> None:
    description = read_urdf(case.text)
    assert description.warnings == ()
    assert description.meshes[0].endswith(case.mentions)


ACCEPTED: list[Odd | Valid] = [*ODD, *VALID, *MISSING_MESHES]


@pytest.mark.parametrize("case", ACCEPTED, ids=lambda case: case.name)
def test_written_and_read_again(case: Odd | Valid) -> None:
    description = read_urdf(case.text)
    assert without_warnings(reread(description)) == without_warnings(description)


@pytest.mark.parametrize("name", swept(catalogue.URDFS))
def test_catalogue_written_and_read_again(name: str) -> None:
    description = read_urdf(catalogue.urdf_text(name))
    assert without_warnings(reread(description)) == without_warnings(description)


@pytest.mark.parametrize("seed", range(50))
def test_any_axis_written_and_read_again(seed: int) -> None:
    axis = " ".join(str(x) for x in np.random.default_rng(seed).normal(size=3))
    description = read_urdf(ARM.replace("0 0 1", axis))
    assert reread(description).joints == description.joints


def test_what_is_read() -> None:
    limit = '<limit lower="-0.5" upper="1.5" effort="10" velocity="2"/>'
    text = one_joint(f'<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 2 0"/>{limit}', "prismatic")
    elbow = read_urdf(text).joint["elbow"]
    assert (elbow.type, elbow.parent, elbow.child, elbow.axis) == ("prismatic", "base", "forearm", (0.0, 1.0, 0.0))
    assert (elbow.origin.xyz, elbow.origin.rpy) == ((1.0, 2.0, 3.0), (0.1, 0.2, 0.3))
    limits = elbow.limits
    assert (limits.lower, limits.upper, limits.velocity, limits.effort) == (-0.5, 1.5, 2.0, 10.0)


def test_an_error_names_the_line() -> None:
    with pytest.raises(InvalidUrdf) as caught:
        read_urdf(ARM.replace("><", ">\n<").replace('upper="1"', 'upper="-2"'))
    lines = ARM.replace("><", ">\n<").split("\n")
    assert caught.value.line == 1 + next(i for i, line in enumerate(lines) if line.startswith("<limit"))
    assert caught.value.element == "joint 'elbow'"


def test_warnings_stand_in_the_order_of_the_document() -> None:
    strange = " ".join(f'strange_{i}="{i}"' for i in range(8))
    warnings = read_urdf(ARM.replace("<limit", f"<limit {strange}")).warnings
    assert [warning.split("'")[3] for warning in warnings] == [f"strange_{i}" for i in range(8)]


# Every file of the data package, whether in the catalogue or not

ALL_FILES = sorted((Path(sysconfig.get_paths()["purelib"]) / "cmeel.prefix/share/example-robot-data").rglob("*.urdf"))
NOT_ROBOTS = {"alex_psyonic_hands": "mimic of the unknown joint 'index_q1'", "ur3": "has no link"}
"""A pair of hands whose fingers were renamed on one side only, and a xacro expanded to nothing."""


@pytest.mark.quick(12)
@pytest.mark.parametrize("path", ALL_FILES, ids=lambda path: path.stem)
def test_public_files_are_read(path: Path) -> None:
    if path.stem in NOT_ROBOTS:
        with pytest.raises(InvalidUrdf, match=NOT_ROBOTS[path.stem]):
            read_urdf(path.read_text())
    else:
        assert read_urdf(path.read_text()).links


# Mutations

TOKENS = (
    "<", ">", '"', "/", " ", "&", "\0", "\ud800", "é", "\u2028", "-", ".", "e", "9", "1e308", "1e-308", "nan", "inf",
    "0 0 0", "<!--", "-->", "<![CDATA[", "<joint", "</joint>", "<link/>", "<mimic joint=", 'type="continuous"',
)  # fmt: skip


def mutated(text: str, rng: np.random.Generator) -> str:
    """One to three edits: a stretch left out, a stretch doubled elsewhere, a token put in, two words swapped."""
    for _ in range(rng.integers(1, 4)):
        start, target = sorted(rng.integers(0, len(text), 2))
        stretch = text[start : start + rng.integers(1, 60)]
        token = TOKENS[rng.integers(len(TOKENS))]
        quotes = [part for part in text[start : start + 400].split('"')[1:-1:2] if part]
        match rng.integers(5):
            case 0:
                text = text[:start] + text[start + len(stretch) :]
            case 1:
                text = text[:target] + stretch + text[target:]
            case 2:
                text = text[:target] + token + text[target + rng.integers(0, 3) :]
            case 3 if len(quotes) > 1:
                text = text.replace(f'"{quotes[0]}"', f'"{quotes[-1]}"', 1)
            case _ if quotes:
                text = text[:start] + text[start:].replace(f'"{quotes[0]}"', f'"{token}"', 1)
    return text


def poses_are_sane(text: str) -> bool:
    """Whether a mutated description is refused, or else a robot whose poses are poses."""
    try:
        description = read_urdf(text)
    except InvalidUrdf:
        return False
    assert without_warnings(reread(description)) == without_warnings(description)
    robot = RobotModel(description)
    chain = robot.chain(None, None)
    Rs = forward_kinematics(robot, chain, samples(chain, 4), robot.frames_on(chain)).poses.rotations
    assert np.abs(Rs @ Rs.swapaxes(1, 2) - np.eye(3)).max() < 1e-9
    return True


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["double_pendulum", "panda", "so101", "talos_left_arm", "xarm7", "z1"])
def test_mutations_are_refused_or_robots(name: str) -> None:
    text, rng = catalogue.urdf_text(name), np.random.default_rng(7)
    accepted = sum(poses_are_sane(mutated(text, rng)) for _ in range(80))
    assert 5 < accepted < 75


def test_writing_escapes_names() -> None:
    description = read_urdf(ARM.replace("forearm", "&lt;fore&amp;arm&gt; &quot;&apos;"))
    assert description.frames[1] == "<fore&arm> \"'"
    assert write_urdf(description).isascii()
