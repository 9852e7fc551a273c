"""Checks that the links and joints of a description form one tree, and that mimic joints follow a movable joint."""

from collections import Counter
from collections.abc import Iterable, Mapping

from gelenk.errors import InvalidUrdf, counted, listed, quoted
from gelenk.robot.description import MOVABLE, Description, Joint

MAX_DEPTH = 256
MAX_MOVABLE = 128
"""Largest number of movable joints: the memory that dynamics algorithms allocate grows with its cube."""
MAX_MULTIPLIER = 1e6


def check_tree(description: Description, lines: Mapping[str, int]) -> None:
    """Check that links and joints, each of them checked before, form one tree.

    `lines` gives the line of each "link <name>" and "joint <name>", for the messages.

    Raises:
        InvalidUrdf: Duplicate names, unknown links, two parents, not one root, cycles, too deep or large, bad mimics.
    """
    _check_names(description, lines)
    _check_ends(description, lines)
    _check_roots(description)
    _check_reach(description, lines)
    for joint in description.joints:
        _check_mimic(description, joint, lines)


def _refuse(reason: str, kind: str, name: str, lines: Mapping[str, int]) -> InvalidUrdf:
    return InvalidUrdf(reason, f"{kind} {quoted(name)}", lines.get(f"{kind} {name}"))


def _check_names(description: Description, lines: Mapping[str, int]) -> None:
    for kind, names in (("link", description.frames), ("joint", [joint.name for joint in description.joints])):
        for name in _repeated(names):
            raise _refuse("duplicate name: it is used more than once", kind, name, lines)


def _check_ends(description: Description, lines: Mapping[str, int]) -> None:
    known = set(description.frames)
    pairs: dict[frozenset[str], str] = {}
    for joint in description.joints:
        for end, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in known:
                raise _refuse(f"its {end} {quoted(link)} is an unknown link", "joint", joint.name, lines)
        if joint.parent == joint.child:
            raise _refuse(f"link {quoted(joint.parent)} is its own parent", "joint", joint.name, lines)
        pair = frozenset((joint.parent, joint.child))
        if pair in pairs:
            ends = f"links {quoted(joint.parent)} and {quoted(joint.child)}"
            reason = f"{ends} are joined by two joints, this one and {quoted(pairs[pair])}"
            raise _refuse(reason, "joint", joint.name, lines)
        pairs[pair] = joint.name
    for child in _repeated(joint.child for joint in description.joints):
        above = tuple(joint.name for joint in description.joints if joint.child == child)
        raise _refuse(f"has two parents or more: it is the child of the joints {listed(above)}", "link", child, lines)


def _check_roots(description: Description) -> None:
    roots = tuple(name for name in description.frames if name not in description.joint_above)
    if not roots:
        cycle = listed(description.frames)
        raise InvalidUrdf(f"no root: every link is the child of a joint, so the joints close a cycle: {cycle}")
    if len(roots) > 1:
        raise InvalidUrdf(f"{counted(len(roots), 'link')} without a parent: {listed(roots)}; a robot has exactly one")


def _check_reach(description: Description, lines: Mapping[str, int]) -> None:
    """Check the limits, and that the root reaches every link: one that it does not reach hangs on a cycle."""
    depth = {description.root: 0}
    pending = [description.root]
    while pending:
        link = pending.pop()
        for joint in description.joints_below[link]:
            depth[joint.child] = depth[link] + 1
            pending.append(joint.child)
    for name in description.frames:
        if name not in depth:
            raise _refuse("is part of a cycle: it is not connected to the root", "link", name, lines)
    deepest = max(depth, key=lambda name: depth[name])
    if depth[deepest] > MAX_DEPTH:
        raise _refuse(f"is {depth[deepest]} joints deep; at most {MAX_DEPTH} are allowed", "link", deepest, lines)
    movable = sum(joint.type in MOVABLE for joint in description.joints)
    if movable > MAX_MOVABLE:
        raise InvalidUrdf(f"the robot has {movable} movable joints; at most {MAX_MOVABLE} are allowed")


def _check_mimic(description: Description, follower: Joint, lines: Mapping[str, int]) -> None:
    seen = {follower.name}
    multiplier, offset = 1.0, 0.0
    joint = follower
    while joint.mimic is not None:
        leader = description.joint.get(joint.mimic.joint)
        if leader is None:
            raise _refuse(f"mimic of the unknown joint {quoted(joint.mimic.joint)}", "joint", joint.name, lines)
        if leader.name in seen:
            raise _refuse("mimic leads in a circle, back to the joint itself", "joint", follower.name, lines)
        if leader.type not in MOVABLE:
            raise _refuse(f"mimic of joint {quoted(leader.name)}, which is {leader.type}", "joint", joint.name, lines)
        offset += multiplier * joint.mimic.offset
        multiplier *= joint.mimic.multiplier
        if max(abs(multiplier), abs(offset)) > MAX_MULTIPLIER:
            raise _refuse(f"mimic multiplier or offset beyond {MAX_MULTIPLIER:g}", "joint", follower.name, lines)
        seen.add(leader.name)
        joint = leader


def _repeated(names: Iterable[str]) -> list[str]:
    return [name for name, count in Counter(names).items() if count > 1]
