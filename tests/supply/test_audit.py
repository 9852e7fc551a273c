"""The audit by pip-audit itself, of lock files and folders: found, not found, nobody there."""

import json
from pathlib import Path

import pytest
import yaml

from supply import advisories, audit
from tests.test_serve import free_port

ADVISORY = {
    "id": "PYSEC-2099-1",
    "summary": "An example.",
    "published": "2099-01-02T03:04:05Z",
    "affected": [
        {
            "package": {"name": "idna", "ecosystem": "PyPI"},
            "ranges": [{"type": "ECOSYSTEM", "events": [{"introduced": "0"}, {"fixed": "99.1"}]}],
        }
    ],
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Advisories in both forms in which they are published, and a file that is none."""
    known = tmp_path / "advisories"
    (known / "idna").mkdir(parents=True)
    (known / "idna" / "PYSEC-2099-1.yaml").write_text(yaml.safe_dump(ADVISORY))
    elsewhere = {"package": {"name": "click", "ecosystem": "npm"}, "versions": ["1.0"]}
    (known / "other.json").write_text(json.dumps({"id": "GHSA-1", "affected": [elsewhere]}))
    (known / "list.json").write_text("[]")
    return known


@pytest.fixture
def lock(tmp_path: Path) -> Path:
    file = tmp_path / "lock"
    file.write_text("".join(f"{name}==1.0 --hash=sha256:{'0' * 64}\n" for name in ("idna", "click")))
    return file


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> None:
    monkeypatch.setattr("sys.argv", ["audit", *arguments])
    audit.main()


@pytest.mark.slow
def test_nothing_known(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path, folder: Path
) -> None:
    lock.write_text(lock.read_text().replace("idna==1.0", "idna==99.1"))
    run(monkeypatch, "--lock", str(lock), "--advisories", str(folder))
    told = ["advisories on 1 packages, the last one of 2099-01-02", "2 packages without known vulnerabilities"]
    assert capsys.readouterr().out.splitlines() == told


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [[], ["--if-reachable"]])
def test_a_vulnerability_fails_with_the_version_that_mends_it(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    lock: Path,
    folder: Path,
    arguments: list[str],
) -> None:
    with pytest.raises(SystemExit, match="there are known vulnerabilities"):
        run(monkeypatch, "--lock", str(lock), "--advisories", str(folder), *arguments)
    assert capsys.readouterr().out.splitlines()[1:] == ["idna 1.0: PYSEC-2099-1, fixed in 99.1"]


@pytest.mark.slow
def test_what_is_installed_in_a_folder(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path, folder: Path
) -> None:
    for name in ("idna", "click"):
        installed = tmp_path / "site-packages" / f"{name}-2.0.dist-info"
        installed.mkdir(parents=True)
        (installed / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 2.0\n")
    with pytest.raises(SystemExit, match="there are known vulnerabilities"):
        run(monkeypatch, "--installed", str(tmp_path / "site-packages"), "--advisories", str(folder))
    assert capsys.readouterr().out.splitlines()[1:] == ["idna 2.0: PYSEC-2099-1, fixed in 99.1"]


def test_a_folder_without_advisories_is_no_audit(monkeypatch: pytest.MonkeyPatch, lock: Path, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="holds no advisory"):
        run(monkeypatch, "--lock", str(lock), "--advisories", str(tmp_path / "nothing"))


@pytest.mark.parametrize(
    ("version", "is_affected"),
    [
        ("0.9", False),
        ("1.0", True),
        ("1.9", True),
        ("2.0rc1", True),
        ("2.0", False),
        ("3.0", True),
        ("3.5", True),
        ("3.5.1", False),
        ("7.7", True),
        ("no version", True),
    ],
)
def test_ranges_of_versions(version: str, is_affected: bool) -> None:
    """Several ranges in one list, in no order, the last version that is affected, and one that is only listed."""
    events = [{"introduced": "3.0"}, {"fixed": "2.0"}, {"introduced": "1.0"}, {"last_affected": "3.5"}]
    ranges = [{"type": "GIT", "events": [{"introduced": "0"}]}, {"type": "ECOSYSTEM", "events": events}]
    package = {"name": "Some_Package", "ecosystem": "PyPI"}
    advisory = {"affected": [{"package": package, "ranges": ranges, "versions": ["7.7"]}]}
    assert advisories.is_affected(advisory, "some-package", version) == is_affected
    assert not advisories.is_affected(advisory, "another", version)


@pytest.mark.slow
def test_nobody_there_is_said_and_fails_unless_told_otherwise(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], lock: Path
) -> None:
    url = f"http://127.0.0.1:{free_port()}/v1/query"
    options = ["--lock", str(lock), "--vulnerability-service", "osv", "--osv-url", url, "--timeout", "5"]
    with pytest.raises(SystemExit, match="NOT AUDITED"):
        run(monkeypatch, *options)
    run(monkeypatch, *options, "--if-reachable")
    assert capsys.readouterr().out.startswith("NOT AUDITED")


def test_who_knows_no_package_has_audited_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An index without advisories, such as a mirror, skips all of them; pip-audit itself calls that a success."""
    skipped = [{"name": name, "skip_reason": "not found"} for name in ("idna", "click")]
    monkeypatch.setattr(audit, "asked", lambda *_: skipped)
    with pytest.raises(SystemExit, match="NOT AUDITED"):
        run(monkeypatch)
    monkeypatch.setattr(audit, "asked", lambda *_: [*skipped, {"name": "pin", "version": "4", "vulns": []}])
    run(monkeypatch)
    assert capsys.readouterr().out == "1 packages without known vulnerabilities, 2 NOT AUDITED\n"
