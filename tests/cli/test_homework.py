"""Homework in a shell, without a server."""

import zipfile
from pathlib import Path

from gelenk.sheets.document import booklet_page, sheets_page
from gelenk.sheets.key import key_table
from tests.cli.conftest import Shell
from tests.sheets.examples import SECRET, homework

IDS = ("actuators.gear", "mobility.linkage")


def test_exercises_are_listed_and_shown(shell: Shell) -> None:
    told, _ = shell("exercises", "--lang", "de")
    assert "mobility.linkage" in told
    assert "Die Formel von Grübler in der Ebene" in told
    assert "constraints" in shell("exercises", "mobility.linkage", "--seed", 7)[0]


def test_sheets_for_a_class_and_their_grades(shell: Shell, tmp_path: Path) -> None:
    names, sheets = tmp_path / "class.txt", tmp_path / "sheets.zip"
    names.write_text("\ufeffAda\n\n Ben \n", encoding="utf-8")
    asked = ["sheet", *IDS, "--class", names, "--title", "Sheet 1", "--secret", SECRET]
    assert shell.bytes(*asked).decode() == sheets_page(homework(*IDS))
    assert shell.bytes(*asked, "--content", "solutions").decode() == booklet_page(homework(*IDS))
    shell("-o", sheets, *asked)
    key = zipped_file(sheets, "key.csv")
    assert key == key_table(homework(*IDS))
    shell("-o", tmp_path / "key.csv", *asked)
    assert (tmp_path / "key.csv").read_bytes().decode() == key
    assert zipped_file(sheets, "booklet.html") == booklet_page(homework(*IDS))
    (tmp_path / "answers.csv").write_text(key, encoding="utf-8", newline="")
    graded = shell.bytes("grade", tmp_path / "answers.csv", "--secret", SECRET).decode()
    assert graded.count("\n") == key.count("\n")
    assert shell.run("grade", "-", "--secret", SECRET, stdin=key.encode())[0].decode() == graded


def zipped_file(place: Path, name: str) -> str:
    return zipfile.ZipFile(place).read(name).decode()


def test_what_is_wrong_is_said(shell: Shell, tmp_path: Path) -> None:
    assert "GELENK_COURSE_SECRET" in shell("sheet", IDS[0], code=2)[1]
    assert (
        ".html, .pdf, .zip, .xml, .csv"
        in shell("-o", tmp_path / "a.doc", "sheet", IDS[0], "--secret", SECRET, code=2)[1]
    )
    assert "no such.txt" in shell("sheet", IDS[0], "--class", "no such.txt", "--secret", SECRET, code=2)[1]
    (tmp_path / "latin.csv").write_bytes(b"\xff")
    assert "UTF-8" in shell("grade", tmp_path / "latin.csv", "--secret", SECRET, code=2)[1]
