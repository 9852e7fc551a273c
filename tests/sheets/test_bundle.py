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
from gelenk.sheets.document import booklet_page, sheets_page
from gelenk.sheets.key import key_table
from gelenk.sheets.moodle import fits, moodle_xml
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


def weighted(data: dict[str, Any]) -> None:
    parts = data["partial_scores"].values()
    data["score"] = sum(part["score"] * part.get("weight", 1) for part in parts) / sum(
        p.get("weight", 1) for p in parts
    )


@pytest.fixture
def prairielearn(monkeypatch: pytest.MonkeyPatch) -> None:
    """What `server.py` needs of it: arrays as JSON, and the score of all parts, as these are documented."""
    module = types.ModuleType("prairielearn")
    module.to_json = lambda array: {"_type": "ndarray", "_value": array.tolist()}  # type: ignore[attr-defined]
    module.from_json = lambda value: value["_value"] if isinstance(value, dict) else value  # type: ignore[attr-defined]
    module.set_weighted_score_data = weighted  # type: ignore[attr-defined]
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
        assert info.keys() == {"uuid", "title", "topic", "tags", "type"}  # all that are required, none that is unknown
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


@pytest.mark.usefixtures("prairielearn")
@pytest.mark.parametrize(("apart", "score"), [(0.0, 1.0), (2 * np.pi, 1.0), (-4 * np.pi + 0.005, 1.0), (np.pi, 0.0)])
def test_prairielearn_accepts_whole_turns(tmp_path: Path, apart: float, score: float) -> None:
    """After its elements have compared the numbers."""
    folder = written(tmp_path, prairielearn_files(odd())) / "signs_all"
    data = generated(folder, 1)
    names = list(data["params"]["turns"])
    assert names == ["angle", "set"]
    right = data["correct_answers"]
    turned = {"_type": "ndarray", "_value": (np.array(right["set"]["_value"]) + apart).tolist()}
    data["submitted_answers"] = {"angle": right["angle"] + apart, "set": turned}
    data["partial_scores"] = {name: {"score": float(apart == 0.0), "weight": 1} for name in names}
    namespace: dict[str, Any] = {}
    exec((folder / "server.py").read_text(), namespace)  # noqa: S102 - as PrairieLearn does
    namespace["grade"](data)
    assert [part["score"] for part in data["partial_scores"].values()] == [score, score]
    assert data["score"] == score


@pytest.mark.usefixtures("prairielearn")
def test_an_empty_answer_stays_wrong_in_prairielearn(tmp_path: Path) -> None:
    folder = written(tmp_path, prairielearn_files(odd())) / "signs_all"
    data = {**generated(folder, 1), "submitted_answers": {}, "partial_scores": {"angle": {"score": 0.0}}}
    namespace: dict[str, Any] = {}
    exec((folder / "server.py").read_text(), namespace)  # noqa: S102 - as PrairieLearn does
    namespace["grade"](data)
    assert data["score"] == 0.0
