"""The parts of the service: all pinned, each with an allowed licence, and the same bill of materials each time."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

from supply import licences, sbom
from supply.pinned import RUN_LOCK, STUDIO_LOCK, bundled_packages, python_packages

LOCKED = set(re.findall(r"^([a-z0-9.-]+)==([^ ;\\]+)", RUN_LOCK.read_text(), re.MULTILINE))


def test_every_entry_of_the_lock_is_pinned_with_hashes() -> None:
    packages = python_packages()
    assert {(each.name, each.version) for each in packages} == LOCKED
    assert sum(len(each.hashes) for each in packages) == RUN_LOCK.read_text().count("--hash=sha256:")
    assert {"numba", "fastapi", "pin"} <= {each.name for each in packages if each.is_for_here}


@pytest.mark.parametrize("entry", ["numpy>=2", "numpy==2.4.6", "numpy==2.4.6,>2 --hash=sha256:" + "0" * 64])
def test_what_is_not_pinned_is_refused(entry: str, tmp_path: Path) -> None:
    (tmp_path / "lock").write_text(entry + "\n")
    with pytest.raises(ValueError, match="numpy is not pinned"):
        python_packages(tmp_path / "lock")


def test_the_bundles_parts_are_those_that_are_no_tools() -> None:
    names = {each.name for each in bundled_packages()}
    assert {"three", "urdf-loader", "katex", "uplot"} <= names
    assert not names & {"esbuild", "typescript", "prettier"}


@pytest.mark.quick(6)
@pytest.mark.parametrize(
    ("expression", "allowed"),
    [
        ("MIT", True),
        ("BSD-3-Clause AND MIT", True),
        ("GPL-3.0-only OR MIT", True),
        ("Apache-2.0 WITH LLVM-exception", True),
        ("MPL-2.0 AND (Apache-2.0 OR GPL-3.0-only)", True),
        ("GPL-3.0-only", False),
        ("MIT AND GPL-3.0-only", False),
        ("MIT AND (LGPL-3.0-or-later OR AGPL-3.0-only)", False),
        ("GPL-2.0-only WITH Classpath-exception-2.0", False),
        ("Our own terms", False),
        ("", False),
        (licences.NONE, False),
    ],
)
def test_an_expression_is_judged_by_its_parts(expression: str, allowed: bool) -> None:
    assert licences.is_allowed(expression) is allowed


@pytest.mark.slow
def test_every_part_is_allowed(capsys: pytest.CaptureFixture[str]) -> None:
    licences.main()
    *lines, last = capsys.readouterr().out.splitlines()
    here = [part for part in (*python_packages(), *bundled_packages()) if part.is_for_here]
    assert last == f"{len(here)} parts, all allowed"
    assert [line.split()[0] for line in lines] == [part.name for part in here]


@pytest.mark.slow
def test_a_part_that_is_not_allowed_fails_by_name(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(licences, "ALLOWED", licences.ALLOWED - {"Apache-2.0"})
    with pytest.raises(SystemExit, match=r"opentelemetry-api.*urdf-loader"):
        licences.main()
    assert re.search(r"^urdf-loader .* Apache-2.0  NOT ALLOWED$", capsys.readouterr().out, re.MULTILINE)


def test_what_was_settled_is_settled_for_what_was_stated_then(monkeypatch: pytest.MonkeyPatch) -> None:
    (part,) = [each for each in python_packages() if each.name == "jrl-cmakemodules"]
    assert licences.judged(part).is_allowed
    monkeypatch.setattr(licences, "_of_installed", lambda _: "AGPL-3.0-only")
    assert not licences.judged(part).is_allowed


def test_the_bill_of_materials_is_valid_and_holds_each_part() -> None:
    text = sbom.bill_of_materials()
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(text) is None
    content = json.loads(text)
    components = {each["purl"]: each for each in content["components"]}
    expected = {f"pkg:pypi/{name}@{version}" for name, version in LOCKED}
    expected |= {f"pkg:npm/{part.name}@{part.version}" for part in bundled_packages()}
    assert set(components) == expected
    (root,) = [each for each in content["dependencies"] if each["ref"] == content["metadata"]["component"]["bom-ref"]]
    assert set(root["dependsOn"]) == expected
    locks = RUN_LOCK.read_text() + STUDIO_LOCK.read_text()
    hashes = [each["content"] for component in components.values() for each in component["hashes"]]
    assert [each for each in hashes if len(each) == 64 and each not in locks] == []
    assert "timestamp" not in content["metadata"]


@pytest.mark.slow
def test_the_bill_of_materials_is_the_same_each_time_and_another_for_another_lock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = [
        subprocess.run(
            [sys.executable, "-m", "supply.sbom"],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert runs[0] == runs[1]
    changed = tmp_path / "lock"
    changed.write_text(RUN_LOCK.read_text() + "\n")
    monkeypatch.setattr(sbom, "RUN_LOCK", changed)
    assert json.loads(sbom.bill_of_materials())["serialNumber"] != json.loads(runs[0])["serialNumber"]
