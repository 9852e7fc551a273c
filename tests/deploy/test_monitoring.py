"""Prometheus and Grafana ask for metrics that there are, in queries and files that their programs take."""

import json
import shutil
import subprocess
import time
import urllib.parse
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from prometheus_client.parser import text_string_to_metric_families
from starlette.testclient import TestClient

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from tests.deploy.monitoring import PROMETHEUS, alerts, dashboard_queries, panels, program, read_yaml, selectors
from tests.http.conftest import ready_client
from tests.test_serve import HOST, free_port, get, service

TARGET = {"position": [0.4, 0.1, 0.5], "rpy": [3.0, 0.2, 0.4]}
CALLS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("panda/fk", {"joint_positions": [[0.0] * 7]}),
    ("panda/ik", {"targets": [TARGET], "tip_frame": "panda_link8"}),
    ("planar_2r/workspace", {"samples": 100, "random_seed": 1}),
)
"""After these everything has been counted once."""


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    yield from ready_client(tmp_path_factory.mktemp("data"))


@pytest.mark.slow
def test_every_metric_and_label_that_is_asked_for_is_there(client: TestClient) -> None:
    for path, call in CALLS:
        assert client.post(f"/v1/robots/{path}", json=call).is_success
    known: dict[str, set[str]] = {}
    for family in text_string_to_metric_families(client.get("/metrics").text):
        for sample in family.samples:
            known.setdefault(sample.name, set()).update(sample.labels)
    asked = [(query, *selector) for _, query in [*dashboard_queries(), *alerts()] for selector in selectors(query)]
    assert len({name for _, name, _ in asked}) >= 14
    assert [query for query, name, labels in asked if name not in known or labels - known[name]] == []


def test_every_metric_is_shown_or_watched(client: TestClient) -> None:
    """But for the moments at which counters began, which the library adds."""
    families = text_string_to_metric_families(client.get("/metrics").text)
    names = {family.name for family in families if not family.name.endswith("_created")}
    text = " ".join(query for _, query in [*dashboard_queries(), *alerts()])
    assert {name for name in names if name not in text} == set()


def test_the_panels_do_not_lie_upon_each_other() -> None:
    taken: set[tuple[int, int]] = set()
    for panel in panels():
        place = panel["gridPos"]
        cells = {(place["x"] + x, place["y"] + y) for x in range(place["w"]) for y in range(place["h"])}
        assert not cells & taken, panel["title"]
        assert place["x"] + place["w"] <= 24
        taken |= cells
    assert len({panel["id"] for panel in panels()}) == len(panels())


def promtool(*arguments: str | Path) -> str:
    """What promtool says of files, which must be good of them."""
    tool = program("promtool")
    if tool is None:
        pytest.skip("there is no promtool: apt-get install prometheus")
    run = subprocess.run([tool, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def test_prometheus_takes_its_files(tmp_path: Path) -> None:
    written(tmp_path, "gelenk:8000", "a key")
    assert "7 rules found" in promtool("check", "config", tmp_path / "prometheus.yml")


def test_prometheus_takes_every_query_of_the_dashboard(tmp_path: Path) -> None:
    rules = [{"record": f"panel:{number}", "expr": query} for number, (_, query) in enumerate(dashboard_queries())]
    file = tmp_path / "queries.yml"
    file.write_text(yaml.safe_dump({"groups": [{"name": "dashboard", "rules": rules}]}))
    assert f"{len(rules)} rules found" in promtool("check", "rules", file)


def test_the_alerts_are_raised_by_what_they_are_for(tmp_path: Path) -> None:
    shutil.copy(PROMETHEUS / "alerts.yml", tmp_path)
    shutil.copy("tests/deploy/alerts_test.yml", tmp_path)
    promtool("test", "rules", tmp_path / "alerts_test.yml")
    told = {
        rule["alertname"]
        for case in read_yaml(tmp_path / "alerts_test.yml")["tests"]
        for rule in case["alert_rule_test"]
    }
    assert told == {name for name, _ in alerts()}


@pytest.mark.slow
def test_the_dashboard_shows_a_running_service(tmp_path: Path) -> None:
    """Prometheus itself, with the files of `deploy`, asks a service with keys; every panel gets numbers."""
    server = program("prometheus")
    if server is None:
        pytest.skip("there is no Prometheus: apt-get install prometheus")
    keys = {name: new_key(name, scopes) for name, scopes in (("anna", list(Scope)), ("prometheus", [Scope.ADMIN]))}
    (tmp_path / "keys").write_text("".join(f"{key.entry()}\n" for _, key in keys.values()))
    anna = {"Authorization": f"Bearer {keys['anna'][0]}"}
    with service(tmp_path / "data", GELENK_API_KEYS=str(tmp_path / "keys")) as (_, url):
        written(tmp_path, urllib.parse.urlsplit(url).netloc, keys["prometheus"][0])
        port = free_port()
        command = [server, f"--config.file={tmp_path}/prometheus.yml", f"--storage.tsdb.path={tmp_path}/tsdb"]
        command += [f"--web.listen-address={HOST}:{port}", "--log.level=error"]
        with subprocess.Popen(command) as run:
            try:
                wait_for_numbers(f"http://{HOST}:{port}", url, anna)
            finally:
                run.terminate()
                run.wait(timeout=60)


def wait_for_numbers(prometheus: str, url: str, key: dict[str, str]) -> None:
    """Go on calling, for a rate needs two looks, until every panel has a number."""
    deadline = time.monotonic() + 300
    missing = list(dashboard_queries())
    while missing:
        for path, call in CALLS:
            posted(f"{url}/v1/robots/{path}", call, key)
        missing = [(title, query) for title, query in missing if not results(prometheus, query)]
        assert time.monotonic() < deadline, missing
        time.sleep(0.5)
    (up,) = results(prometheus, 'up{job="gelenk"}')
    assert up["value"][1] == "1"
    (answered,) = results(prometheus, 'sum(gelenk_answers_total{operation="forward_kinematics",status="200"})')
    assert float(answered["value"][1]) >= 2


def posted(url: str, call: dict[str, Any], key: dict[str, str]) -> None:
    request = urllib.request.Request(url, json.dumps(call).encode(), {"Content-Type": "application/json", **key})
    with urllib.request.urlopen(request, timeout=60) as answer:
        assert answer.status in {200, 202}


def results(prometheus: str, query: str) -> list[dict[str, Any]]:
    """What Prometheus answers; nothing as long as it starts."""
    try:
        status, answer = get(f"{prometheus}/api/v1/query?query={urllib.parse.quote(query)}")
    except (OSError, json.JSONDecodeError):
        return []
    assert status in {200, 503}, answer
    found: list[dict[str, Any]] = answer["data"]["result"] if status == 200 else []
    return found


def written(folder: Path, target: str, key: str) -> None:
    """The files of Prometheus in a folder, for a service elsewhere, which is asked more often."""
    (folder / "key").write_text(key)
    configuration = read_yaml(PROMETHEUS / "prometheus.yml")
    configuration["global"] = {"scrape_interval": "1s", "evaluation_interval": "1s"}
    (job,) = configuration["scrape_configs"]
    job["authorization"]["credentials_file"] = str(folder / "key")
    job["static_configs"] = [{"targets": [target]}]
    (folder / "prometheus.yml").write_text(yaml.safe_dump(configuration))
    shutil.copy(PROMETHEUS / "alerts.yml", folder)
