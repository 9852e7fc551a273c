"""Parts that an MJCF model has several times or takes from another model: `replicate` and `attach`.

A copy is a `frame` with what it repeats, under other names. Equalities between joints of a part are copied with it, and
those that lead out of it are dropped, as in MuJoCo.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from gelenk.errors import quoted
from gelenk.robot.formats.mjcf.scope import Attached, Model, ModelScope, below, placed, renamed
from gelenk.robot.formats.mjcf.values import from_euler, vector
from gelenk.robot.formats.sources import Fault
from gelenk.robot.xml import Element

MAX_AFFIX = 64
"""Largest length of what one copy adds to names."""


class Copies:
    """Puts copies in the place of each `replicate` and `attach`; `load` returns a model of the assets by its name."""

    def __init__(self, model: Model, load: Callable[[str], Model]) -> None:
        self._model, self._load = model, load

    def inside(self, element: Element) -> list[Element]:
        """Return what is in an element with all copies; raises InvalidUrdf with file, line and reason."""
        found: list[Element] = []
        for child in element.children:
            with placed(child):
                if child.tag == "replicate":
                    found += self._replicas(child)
                elif child.tag == "attach":
                    found.append(self._attached(child))
                else:
                    found.append(replace(child, children=self.inside(child)))
        return found

    def _replicas(self, element: Element) -> list[Element]:
        given, parts, upload = element.attributes, self.inside(element), self._model.upload
        if not re.fullmatch(r"[+-]?\d{1,18}", text := given.get("count", "")):
            raise Fault(f"count is {quoted(text)} but must be a whole number")
        count, separator = max(0, int(text)), _affix(given, "sep")
        upload.copy(count, sum(_size(part) for part in parts))
        offset, angles = vector(given, "offset"), vector(given, "euler")
        names = [f"{separator}{index:0{len(str(count))}d}" for index in range(count)]
        self._equalities(element, parts, names)
        frames, at = [], np.zeros(3)
        for index, name in enumerate(names):
            R = from_euler(index * angles, self._model.compiler)  # the angles grow, each by itself, as in MuJoCo
            where = {"pos": _words(at), "xyaxes": _words(R[:, :2].T.ravel())}
            copies = [renamed(part, lambda old, name=name: old + name) for part in parts]  # type: ignore[misc]
            frames.append(Element("frame", where, element.line, copies, element.file))
            at = at + R @ offset
        return frames

    def _equalities(self, element: Element, parts: list[Element], names: list[str]) -> None:
        """Repeat the equalities between joints of what is repeated under these names."""
        joints, kept = _joints(parts), []
        for equality, scope in self._model.equalities:
            ends = _ends(equality)
            if not ends & joints:
                kept.append((equality, scope))
            elif ends <= joints:
                self._model.upload.copy(1, len(names))
                kept += [(renamed(equality, lambda old, name=name: old + name), scope) for name in names]  # type: ignore[misc]
            else:
                where = f"the copies of line {element.line}"
                self._model.upload.warn(equality, f"it joins a joint of {where} with another one: it is not read")
        self._model.equalities = kept

    def _attached(self, element: Element) -> Element:
        given = element.attributes
        other, prefix = self._load(given.get("model", "")), _affix(given, "prefix")
        parts, scope = _chosen(other, given)
        self._model.upload.copy(1, sum(_size(part) for part in parts))
        joints = _joints(parts)
        self._model.equalities += [
            (renamed(equality, lambda old: prefix + old), around)
            for equality, around in other.equalities
            if _ends(equality) <= joints
        ]
        copies = [renamed(part, lambda old: prefix + old) for part in parts]
        return Attached("frame", {}, element.line, copies, element.file, scope=scope)


def _chosen(model: Model, given: Mapping[str, str]) -> tuple[list[Element], ModelScope]:
    """Return the body, or frame, of a model that is attached, else all in its world, with the scope around it."""
    contents = [child for section in model.sections("worldbody") for child in section.children]
    waiting = [(child, ModelScope(model)) for child in contents]
    for tag in ("body", "frame"):
        if (name := given.get(tag)) is None:
            continue
        while waiting:
            element, scope = waiting.pop()
            if element.tag == tag and element.attributes.get("name") == name:
                return [element], scope
            waiting += [(child, scope.inside(element)) for child in element.children]
        raise Fault(f"the model {quoted(given.get('model', ''))} has no {tag} {quoted(name)}")
    return contents, ModelScope(model)


def _affix(given: Mapping[str, str], key: str) -> str:
    affix = given.get(key, "")
    if len(affix) > MAX_AFFIX:
        raise Fault(f"{key} has {len(affix)} characters; at most {MAX_AFFIX} are allowed")
    return affix


def _size(element: Element) -> int:
    return sum(1 for _ in below(element))


def _joints(parts: list[Element]) -> set[str]:
    return {each.attributes.get("name", "") for part in parts for each in below(part) if each.tag == "joint"}


def _ends(equality: Element) -> set[str]:
    return {equality.attributes[key] for key in ("joint1", "joint2") if key in equality.attributes}


def _words(values: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]") -> str:
    return " ".join(repr(float(value)) for value in values)
