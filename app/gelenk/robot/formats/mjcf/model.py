"""An MJCF model before its bodies: includes, compiler, defaults by class, meshes."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import PurePosixPath
from posixpath import relpath

from gelenk.errors import InvalidUrdf, counted, quoted
from gelenk.robot.formats.mjcf.copies import Copies
from gelenk.robot.formats.mjcf.scope import Model, ModelScope, Upload, placed
from gelenk.robot.formats.mjcf.values import Mesh, numbers, placement
from gelenk.robot.formats.sources import Fault, Sources, folder_of
from gelenk.robot.xml import Element

MAX_ATTACHED = 8
"""Largest number of models that attach each other in a chain."""
MAX_EQUALITIES = 1024
_INHERITING = frozenset({"mesh", "joint", "geom", "site", "frame", "equality"})
"""Elements whose defaults are looked up."""
_INERTIAS = ("convex", "exact", "legacy", "shell")
_UNREAD = frozenset({"tendon", "actuator", "sensor", "contact", "keyframe", "deformable"})


def read_model(root: Element, sources: Sources) -> Model:
    """Read everything but the bodies; raises InvalidUrdf with file, line and reason."""
    return _read(root, Upload(sources, root.file))


def _read(root: Element, upload: Upload) -> Model:
    model = Model(replace(root, children=_included(root, root.file, upload, {root.file})), upload)
    for element in model.sections("compiler"):
        with placed(element):
            model.compiler.read(element.attributes)
    for element in model.sections("default"):
        with placed(element):
            if (name := element.attributes.get("class", "main")) != "main":
                raise Fault(f"the outermost default is 'main' and takes no other name, such as {quoted(name)}")
        _read_defaults(model, element, "main")
    models: dict[str, str] = {}
    for element in (element for assets in model.sections("asset") for element in assets.children):
        with placed(element):
            if element.tag == "mesh":
                _read_mesh(model, element)
            elif element.tag == "model":
                path = upload.sources.path(element.attributes.get("file", ""), root.file)
                name = element.attributes.get("name") or upload.root(path).attributes.get("model", "")
                models[name] = path
    for element in model.root.children:
        if element.tag in _UNREAD and element.children:
            upload.warn(element, f"{element.tag} is not read")
    scope = ModelScope(model)
    if sum(len(section.children) for section in model.sections("equality")) > MAX_EQUALITIES:
        raise InvalidUrdf(f"the model has more than {MAX_EQUALITIES} equalities", None, root.line, root.file or None)
    model.equalities = [(element, scope) for section in model.sections("equality") for element in section.children]
    copies = Copies(model, lambda name: _attached(name, models, upload))
    sections = [
        replace(part, children=copies.inside(part)) if part.tag == "worldbody" else part for part in model.root.children
    ]
    model.root = replace(model.root, children=sections)
    return model


def _included(element: Element, first: str, upload: Upload, seen: set[str]) -> list[Element]:
    """Return the children of an element with included files in the place of each `include`."""
    found: list[Element] = []
    for child in element.children:
        with placed(child):
            upload.take()
            if child.tag != "include":
                found.append(replace(child, children=_included(child, first, upload, seen)))
                continue
            path = upload.sources.path(child.attributes.get("file", ""), first)  # names count from the first file
            if path in seen:
                raise Fault(f"{quoted(path)} is included twice")
            seen.add(path)
            found += _included(upload.sources.xml(path), first, upload, seen)
    return found


def _attached(name: str, paths: Mapping[str, str], upload: Upload) -> Model:
    """Return a model of the assets by its name, read once; raises Fault, and InvalidUrdf for what is wrong in it."""
    if name not in paths:
        raise Fault(f"there is no model {quoted(name)} among the assets")
    path, opened = paths[name], [upload.file, *upload.opened]
    if path in opened:
        raise Fault(f"{quoted(path)} attaches itself: {' → '.join([*opened[opened.index(path) :], path])}")
    if len(opened) > MAX_ATTACHED:
        raise Fault(f"more than {counted(MAX_ATTACHED, 'model')} attach each other in a chain")
    if path not in upload.models:
        root = upload.root(path)
        if root.tag != "mujoco":
            raise Fault(f"{quoted(path)} is no MJCF: its element is {quoted(root.tag)}")
        upload.opened.append(path)
        upload.models[path] = _read(root, upload)
        upload.opened.pop()
    return upload.models[path]


def _read_defaults(model: Model, element: Element, outer: str) -> None:
    """Read a `default` and those inside of it; a class has what the one around it has."""
    name = element.attributes.get("class", outer)
    mine = model.defaults.setdefault(name, {})
    if name != outer:
        for tag, attributes in model.defaults[outer].items():  # shared, not copied, where the class adds nothing
            mine[tag] = {**attributes, **mine[tag]} if tag in mine else attributes
    for child in element.children:
        if child.tag in _INHERITING and child.attributes:
            mine[child.tag] = {**mine.get(child.tag, {}), **child.attributes}
    for child in element.children:
        if child.tag == "default":
            _read_defaults(model, child, name)


def _read_mesh(model: Model, element: Element) -> None:
    given, compiler = ModelScope(model).given(element), model.compiler
    file = given.get("file")
    if file is None:
        return
    x, y, z = numbers(given, "scale", 3) or (1.0, 1.0, 1.0)
    name = given.get("name", PurePosixPath(file).stem)
    path = PurePosixPath(compiler.meshdir) / (PurePosixPath(file).name if compiler.strips_path else file)
    path = PurePosixPath(relpath(folder_of(model.root.file) or ".", folder_of(model.upload.file) or ".")) / path
    frame = {new: given[old] for old, new in (("refpos", "pos"), ("refquat", "quat")) if old in given}
    kind = given.get("inertia", "exact" if compiler.is_exact else "legacy")
    if kind not in _INERTIAS:
        raise Fault(f"inertia is {quoted(kind)} but must be one of {', '.join(_INERTIAS)}")
    if kind == "convex" and "maxhullvert" in given:
        model.upload.warn(element, "maxhullvert is not read: the mass is that of the whole hull")
    model.meshes[name] = Mesh(str(path), (x, y, z), placement(frame, compiler), kind)
