"""All files in one; questions for PrairieLearn, run as it runs them."""

import io
import json
import random
import sys
import types
import uuid
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gelenk.sheets.bundle import bundle
from gelenk.sheets.cloze import fits
from gelenk.sheets.key import key_table
from gelenk.sheets.moodle import moodle_xml
from gelenk.sheets.pages import booklet_page, sheets_page
from gelenk.sheets.prairielearn import prairielearn_files
from tests.exercises.forms import sent
from tests.sheets.examples import homework, odd
from tests.sheets.test_pages import Reader


def test_a_bundle_has_every_file_and_is_always_the_same() -> None:
    one = homework("actuators.gear", "mobility.linkage")
    content = bundle(one)
    assert content == bundle(homework("actuators.gear", "mobility.linkage"))
    archive = zipfile.ZipFile(io.BytesIO(content))
    assert archive.testzip() is None
    expected: dict[str, str | bytes] = {
        "sheets.html": sheets_page(one),
        "booklet.html": booklet_page(one),
        "key.csv": key_table(one),
        "moodle.xml": moodle_xml(one),
        **dict(prairielearn_files(one)),
    }
    found = {name: archive.read(name) for name in archive.namelist()}
    assert found == {name: text.encode() if isinstance(text, str) else text for name, text in expected.items()}


@pytest.fixture
def prairielearn(monkeypatch: pytest.MonkeyPatch) -> None:
    """What `server.py` needs of it: an array as JSON, as `to_json` is documented."""
    module = types.ModuleType("prairielearn")
    module.to_json = lambda array: {"_type": "ndarray", "_value": array.tolist()}  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "prairielearn", module)


def generated(folder: Path, seed: int) -> dict[str, Any]:
    data: dict[str, Any] = {"params": {}, "correct_answers": {}, "options": {"question_path": str(folder)}}
    namespace: dict[str, Any] = {}
    exec((folder / "server.py").read_text(), namespace)  # noqa: S102 - as PrairieLearn does
    random.seed(seed)
    namespace["generate"](data)
    return data


def written(tmp_path: Path, files: Any) -> Path:
    for name, content in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content, encoding="utf-8")
    return tmp_path / "prairielearn"


@pytest.mark.slow
@pytest.mark.usefixtures("prairielearn")
def test_prairielearn_gets_the_right_answers(tmp_path: Path) -> None:
    one = homework()
    place, ids = written(tmp_path, prairielearn_files(one)), set()
    for exercise, variants in one.pools():
        folder = place / exercise.id.replace(".", "_")
        assert folder.exists() == all(map(fits, variants))
        if not folder.exists():
            continue
        info = json.loads((folder / "info.json").read_text())
        assert info["type"] == "v3"
        ids.add(uuid.UUID(info["uuid"]))
        expected = [
            {field.name: sent(one.answers[field.name]) for field in one.fields if field.kind in ("number", "vector")}
            for one in variants
        ]
        for seed in range(4):
            answers = generated(folder, seed)["correct_answers"]
            plain = {
                name: np.ravel(value["_value"] if isinstance(value, dict) else value) for name, value in answers.items()
            }
            assert any(all(np.allclose(plain[name], right) for name, right in one.items()) for one in expected)
        html = (folder / "question.html").read_text()
        Reader(html)
        for field in variants[0].fields:
            assert f'answers-name="{field.name}"' in html
    assert len(ids) == sum(1 for path in place.iterdir() if path.is_dir())


@pytest.mark.usefixtures("prairielearn")
def test_prairielearn_gets_each_kind_of_field(tmp_path: Path) -> None:
    data = generated(written(tmp_path, prairielearn_files(odd())) / "signs_all", 1)
    assert data["correct_answers"]["angle"] == 3.0
    assert data["correct_answers"]["vector"] == {"_type": "ndarray", "_value": [[1.0, 2.0, 3.0]]}
    assert data["correct_answers"]["matrix"]["_value"] == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    assert data["correct_answers"]["set"]["_value"] == pytest.approx(np.array([[-2.0, 6.0 - 2 * np.pi], [3.0, 1.0]]))
    assert "choice" not in data["correct_answers"]
    assert data["params"]["choice"] == {"c0": "true", "c1": "false", "c2": "false"}
    assert data["params"]["vector"]["tolerance"] == pytest.approx(0.03)
    assert data["params"]["angle"]["tolerance"] == 0.01
