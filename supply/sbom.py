"""`./dev sbom`: the parts of the service as CycloneDX 1.6, from the lock files alone.

The same lock files give the same bytes: there is no time in it, and its serial number is made from them.
"""

import hashlib
import json
import sys
import tomllib
import uuid

from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

from supply.pinned import ROOT, RUN_LOCK, STUDIO_LOCK, Pinned, bundled_packages, python_packages

_SPACE = uuid.UUID("6f1f9c0e-8f0b-5f3c-9c56-2d6a7d0f6b11")
"""Serial numbers of other projects are made from another one."""


def main() -> None:
    """Print it."""
    sys.stdout.write(bill_of_materials())


def bill_of_materials() -> str:
    """The parts as CycloneDX JSON."""
    bom = Bom()
    bom.metadata.component = _service()
    parts = [_component(part) for part in (*python_packages(), *bundled_packages())]
    bom.components.update(parts)
    bom.register_dependency(bom.metadata.component, parts)
    content = json.loads(JsonV1Dot6(bom).output_as_string())
    del content["metadata"]["timestamp"]
    digest = hashlib.sha256(RUN_LOCK.read_bytes() + STUDIO_LOCK.read_bytes()).hexdigest()
    content["serialNumber"] = uuid.uuid5(_SPACE, digest).urn
    return json.dumps(content, indent=2, sort_keys=True) + "\n"


def _service() -> Component:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    name, version = project["name"], project["version"]
    return Component(type=ComponentType.APPLICATION, name=name, version=version, bom_ref=f"{name}@{version}")


def _component(part: Pinned) -> Component:
    group, _, name = part.name.rpartition("/")
    purl = PackageURL(part.ecosystem, group or None, name, part.version)
    return Component(
        type=ComponentType.LIBRARY,
        group=group or None,
        name=name,
        version=part.version,
        purl=purl,
        bom_ref=purl.to_string(),
        hashes=[HashType(alg=HashAlgorithm(part.algorithm), content=each) for each in part.hashes],
        properties=[Property(name="gelenk:marker", value=part.marker)] if part.marker else [],
    )


if __name__ == "__main__":
    main()
