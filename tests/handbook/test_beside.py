"""What stands beside a call in Python asks the same of the service: a curl that is run sends what the client sends."""

import json
import re
import subprocess
import threading
from collections.abc import Iterator
from html import unescape
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from urllib.parse import parse_qsl

import httpx2
import numpy as np
import pytest

from docs.handbook.beside import CALCULATORS, calculator, curl, tabbed
from gelenk.client import Client
from gelenk.client.call import Call
from gelenk.client.operations import Operations
from gelenk.client.refusals import Refused
from gelenk.contract.pose import Pose

PART = "<!-- run -->\n```python\ngelenk.robots()\n```\n\n```text\n[]\n```\n"
TARGET = Pose(position=[0.9, 0.8, 0.0], rpy=[0, 0, 0])
CALLS = (
    Operations.fk.describe("planar_2r", joint_positions=[[0.3, 0.8]]),
    Operations.ik.describe("planar_2r", targets=[TARGET] * 9, task=["x", "y"]),
    Operations.dh_table.describe("ur5", convention="modified", steps=True),
    Operations.remove_robot.describe("d'Alembert & co"),
    Operations.robots.describe(),
    Operations.picture.describe("v1/course/time-law", "svg", {"law": "cubic", "start": 0.2, "note": "Newton's"}),
)


class Listener(BaseHTTPRequestHandler):
    """Answers all with nothing, and remembers what it was asked."""

    def answer(self) -> None:
        """Note method, path, media types and body."""
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        kinds = [self.headers.get(name, "") for name in ("Content-Type", "Accept")]
        self.server.asked.append((self.command, self.path, *kinds, json.loads(body or "null")))  # type: ignore[attr-defined]
        self.send_response(200)
        self.end_headers()

    do_GET = do_POST = do_DELETE = answer

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@pytest.fixture(scope="module")
def listener() -> Iterator[HTTPServer]:
    with HTTPServer(("127.0.0.1", 0), Listener) as server:
        server.asked = []  # type: ignore[attr-defined]
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


def sent(call: Call[object]) -> tuple[object, ...]:
    """What the client asks."""
    requests: list[httpx2.Request] = []

    def answer(request: httpx2.Request) -> httpx2.Response:
        requests.append(request)
        return httpx2.Response(404, json={"type": "urn:gelenk:unknown-robot", "detail": "", "status": 404})

    with Client(transport=httpx2.MockTransport(answer)) as client, pytest.raises(Refused):
        client.send(call)
    (request,) = requests
    kinds = [request.headers.get(name, "") for name in ("Content-Type", "Accept")]
    return request.method, request.url.raw_path.decode(), *kinds, json.loads(request.content or "null")


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.path)
def test_curl_sends_what_the_client_sends(call: Call[object], listener: HTTPServer, tmp_path: object) -> None:
    command = curl(call)
    assert command is not None
    command = command.replace("http://127.0.0.1:8000", f"http://127.0.0.1:{listener.server_port}")
    subprocess.run(["bash", "-c", command], cwd=str(tmp_path), check=True, timeout=60)
    method, path, media_type, accept, body = sent(call)
    accept = {"application/json": "*/*"}.get(str(accept), accept)  # which the service takes for the same
    assert listener.asked.pop() == (method, path, media_type, accept, body)  # type: ignore[attr-defined]


def test_what_nobody_types_has_no_curl() -> None:
    assert curl(Operations.fk.describe("planar_2r", joint_positions=np.zeros((2, 2)))) is None
    assert curl(Operations.fk.describe("planar_2r", joint_positions=[[0.3, 0.8]] * 1000)) is None
    assert curl(Operations.add_archive.describe("arm", b"zip")) is None


def test_a_call_has_two_tabs_of_its_own_and_its_answer_below() -> None:
    text = tabbed(PART, CALLS[4:5] * 2, "call-7")
    assert text.count("curl -s http") == 1
    assert text.count('name="call-7"') == 2
    pieces = re.split(r"^```(?:python|sh|text)$", text, flags=re.MULTILINE)
    head, python, shell, answer = map(str.strip, pieces)
    assert head.startswith("<!-- run -->\n<div")
    assert python == "gelenk.robots()\n```"
    assert shell == "curl -s http://127.0.0.1:8000/v1/robots\n```\n\n</div>"
    assert answer == "[]\n```"


def test_of_a_loop_the_first_calls_are_shown() -> None:
    text = tabbed(PART, [Operations.robot.describe(f"arm_{n}") for n in range(5)], "call")
    assert text.count("curl -s") == 3
    assert "# and so on\n```" in text


def test_a_call_of_the_course_leads_to_its_calculator_with_the_same_numbers() -> None:
    law = Operations.time_law.describe(law="cubic", start=[0.2], target=[1.4], duration=2.0)
    text = tabbed(PART, [CALLS[0], law], "call", "../../")
    (href,) = re.findall(r'<p class="studio"><a href="([^"]+)">', text)
    path, _, fragment = unescape(href).partition("#")
    given = dict(parse_qsl(fragment))
    assert path == "../../"
    assert (given["panel"], given["course.task"]) == ("course", "time-law")
    assert json.loads(given["course.inputs"]) == json.loads(law.body)
    assert text.rstrip().endswith("</p>")


def test_other_calls_have_no_calculator() -> None:
    assert [calculator(call) for call in CALLS[:5]] == [None] * 5
    assert calculator(Operations.gear.describe(ratio=100.0)) is None


def test_the_studio_has_these_calculators() -> None:
    sources = Path(__file__).parents[2] / "app" / "studio" / "src" / "panels" / "course"
    paths = re.findall(r'path: "v1/course/([\w-]+)"', "".join(path.read_text("utf-8") for path in sources.glob("*.ts")))
    assert sorted(paths) == sorted(CALCULATORS)


def test_a_part_without_calls_is_left_alone() -> None:
    assert tabbed(PART, [], "call") == PART
