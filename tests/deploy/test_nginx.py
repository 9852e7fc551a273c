"""Behind nginx, by TLS and below a path prefix, everything is as it is without it."""

import http.client
import io
import json
import re
import ssl
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urljoin, urlsplit

import httpx2
import numpy as np
import pytest

from gelenk.client import Client
from tests.deploy.nginx import NAME, in_front_of, nginx, trusting
from tests.test_serve import HOST, service

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(nginx() is None, reason="there is no nginx: apt-get install nginx-light openssl"),
]
PREFIX = "/gelenk"
MOST = 64 * 2**20
JSON = {"Content-Type": "application/json"}
ROW = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
TABLE = {"convention": "standard", "joints": [ROW]}


@dataclass(frozen=True, slots=True)
class Lab:
    """A service behind nginx."""

    secure: str
    plain: str
    trusted: ssl.SSLContext
    data_dir: Path

    def connection(self) -> http.client.HTTPSConnection:
        return http.client.HTTPSConnection(urlsplit(self.secure).netloc, timeout=120, context=self.trusted)

    def ask(
        self, path: str, body: bytes | None = None, headers: dict[str, str] | None = None, method: str = ""
    ) -> tuple[int, http.client.HTTPMessage, bytes]:
        connection = self.connection()
        try:
            connection.request(method or ("GET" if body is None else "POST"), path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def ask_json(self, path: str, body: Any = None, method: str = "") -> tuple[int, http.client.HTTPMessage, Any]:
        sent = None if body is None else json.dumps(body).encode()
        status, headers, content = self.ask(path, sent, JSON, method)
        return status, headers, json.loads(content)


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    data_dir, folder = tmp_path_factory.mktemp("data"), tmp_path_factory.mktemp("nginx")
    arguments = ("--root-path", PREFIX, "--workers", "2")
    with (
        service(data_dir, *arguments, GELENK_TRUSTED_HOSTS=NAME, GELENK_TRUSTED_PROXIES=HOST) as (_, url),
        in_front_of(url, folder) as (secure, plain, certificate),
    ):
        yield Lab(secure, plain, trusting(certificate), data_dir)


@pytest.mark.parametrize("page", ["docs", "redoc", ""])
def test_all_that_a_page_names_is_there(lab: Lab, page: str) -> None:
    status, headers, content = lab.ask(f"{PREFIX}/{page}")
    assert (status, headers.get_content_type()) == (200, "text/html")
    names = re.findall(r'(?:src|href)="([^"]+)"', content.decode())
    files = [name for name in names if not name.startswith(("data:", "#", "http"))]
    assert files
    assert [name for name in files if name.startswith("/")] == []
    assert {name: lab.ask(urljoin(f"{PREFIX}/{page}", name))[0] for name in files} == dict.fromkeys(files, 200)


def test_the_schema_says_where_the_service_is(lab: Lab) -> None:
    status, _, schema = lab.ask_json(f"{PREFIX}/openapi.json")
    assert status == 200
    assert schema["servers"] == [{"url": PREFIX}]


def test_the_prefix_alone_and_plain_http_lead_there(lab: Lab) -> None:
    status, headers, _ = lab.ask(PREFIX)
    assert (status, headers["Location"]) == (308, f"{PREFIX}/")
    connection = http.client.HTTPConnection(urlsplit(lab.plain).netloc, timeout=60)
    connection.request("GET", f"{PREFIX}/v1/robots?x=1")
    answer = connection.getresponse()
    assert (answer.status, answer.headers["Location"]) == (308, f"https://{HOST}{PREFIX}/v1/robots?x=1")
    connection.close()
    assert lab.ask("/v1/robots")[0] == 404


def test_a_job_and_its_events_as_they_come(lab: Lab) -> None:
    wanted = {"kind": "dexterity", "samples": 20_000, "voxel_size": 0.1, "orientations": 100}  # takes minutes
    status, headers, job = lab.ask_json(f"{PREFIX}/v1/robots/panda/workspace", wanted)
    assert status == 202, job
    where = headers["Location"]
    assert where == f"{PREFIX}/v1/jobs/{job['id']}"
    watching = lab.connection()
    watching.request("GET", f"{where}/events")
    stream = watching.getresponse()
    assert stream.headers.get_content_type() == "text/event-stream"
    assert stream.readline() == b"event: progress\n"
    status, _, now = lab.ask_json(where)  # a proxy that collects the stream first would tell when all is over
    assert (status, now["state"] in {"queued", "running"}) == (200, True), now
    assert lab.ask_json(where, method="DELETE")[0] == 200
    rest = stream.read().decode()
    watching.close()
    assert rest.rpartition("event: ")[2].startswith("finished\nid: cancelled\n")


def test_the_result_of_a_job(lab: Lab) -> None:
    status, headers, _ = lab.ask_json(f"{PREFIX}/v1/robots/planar_2r/workspace", {"samples": 2000, "random_seed": 1})
    assert status == 202
    where = headers["Location"]
    events = lab.ask(f"{where}/events")[2].decode()
    assert events.rpartition("event: ")[2].startswith("finished\nid: succeeded\n")
    status, _, content = lab.ask(f"{where}/result", headers={"Accept": "application/x-npy"})
    assert status == 200
    cloud = np.load(io.BytesIO(content))
    assert cloud.shape == (2000, 4)
    assert np.hypot(cloud[:, 0], cloud[:, 1]).max() <= 2.0 + 1e-9


def test_the_client_through_nginx(lab: Lab) -> None:
    """Arrays of some megabytes there and back; the last configuration once more in JSON."""
    qs = np.random.default_rng(5).uniform(-1.0, 1.0, (100_000, 7))
    with Client(f"{lab.secure}{PREFIX}", transport=httpx2.HTTPTransport(verify=lab.trusted)) as gelenk:
        poses = gelenk.arrays.fk("panda", qs)
        (alone,) = gelenk.fk("panda", joint_positions=[list(qs[-1])]).poses
    assert len(poses) == len(qs)
    assert alone.position is not None
    assert poses[-1][:3] == pytest.approx(np.array(alone.position), abs=1e-12)
    assert poses[-1][3:] == pytest.approx(np.array(alone.quaternion_xyzw), abs=1e-12)


def padded(length: int) -> bytes:
    """An upload of so many bytes; JSON may have any space around it."""
    body = json.dumps({"name": f"arm-{length}", "dh": TABLE}).encode()
    return body + b" " * (length - len(body))


def test_the_largest_body_comes_through(lab: Lab) -> None:
    status, headers, content = lab.ask(f"{PREFIX}/v1/robots", padded(MOST), JSON)
    assert status == 201, content
    assert headers["Location"] == f"{PREFIX}/v1/robots/arm-{MOST}"
    assert lab.ask_json(headers["Location"])[0] == 200


def test_a_larger_one_is_a_problem_all_the_same(lab: Lab) -> None:
    connection = lab.connection()
    connection.putrequest("POST", f"{PREFIX}/v1/robots")
    connection.putheader("Content-Length", str(MOST + 1))
    connection.endheaders(b"{")  # the rest is not waited for
    answer = connection.getresponse()
    problem = json.loads(answer.read())
    connection.close()
    assert (answer.status, answer.headers.get_content_type()) == (413, "application/problem+json")
    assert (problem["type"], problem["status"]) == ("urn:gelenk:too-large", 413)
    assert re.fullmatch("[0-9a-f]{32}", problem["request_id"])


@pytest.mark.parametrize(
    ("path", "status"), [("/v1/robots/nobody/fk", 404), ("/v1/robots/ur5/fk", 422), ("/v1/nothing", 404)]
)
def test_a_problem_names_the_path_that_was_asked_for(lab: Lab, path: str, status: int) -> None:
    answered, headers, problem = lab.ask_json(f"{PREFIX}{path}", {"joint_positions": [[0.0]]})
    assert (answered, headers.get_content_type()) == (status, "application/problem+json")
    assert problem["instance"] == f"{PREFIX}{path}"


def test_a_host_that_the_service_does_not_know(lab: Lab) -> None:
    status, _, content = lab.ask(f"{PREFIX}/v1/robots", headers={"Host": "evil.example.com"})
    problem = json.loads(content)
    assert (status, problem["instance"]) == (421, f"{PREFIX}/v1/robots")
    assert lab.ask(f"{PREFIX}/v1/robots", headers={"Host": NAME})[0] == 200


def test_a_page_of_the_service_may_write_and_another_may_not(lab: Lab) -> None:
    body = json.dumps({"name": "written", "dh": TABLE}).encode()
    own, other = {**JSON, "Origin": lab.secure}, {**JSON, "Origin": "https://evil.example.com"}
    assert lab.ask(f"{PREFIX}/v1/robots", body, other)[0] == 403
    assert lab.ask(f"{PREFIX}/v1/robots", body, own)[0] == 201


def test_nobody_writes_in_the_name_of_another(lab: Lab) -> None:
    body = json.dumps({"name": "by-whom", "dh": TABLE}).encode()
    assert lab.ask(f"{PREFIX}/v1/robots", body, {**JSON, "X-Forwarded-For": "203.0.113.9"})[0] == 201
    lines = (lab.data_dir / "audit" / "audit.jsonl").read_text().splitlines()
    last = json.loads(lines[-1])
    assert "203.0.113.9" not in lines[-1]
    assert HOST in last.values()


def test_while_the_service_is_away_there_is_a_problem(tmp_path: Path) -> None:
    with in_front_of("http://127.0.0.1:9", tmp_path) as (secure, plain, certificate):
        alone = Lab(secure, plain, trusting(certificate), tmp_path)
        status, headers, problem = alone.ask_json(f"{PREFIX}/v1/robots")
    assert (status, headers["Retry-After"], headers.get_content_type()) == (502, None, "application/problem+json")
    assert (problem["type"], problem["status"]) == ("urn:gelenk:service-away", 502)
