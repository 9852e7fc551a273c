"""Traces: sent where the setting says, a span for each request, in its caller's trace; otherwise nothing is loaded."""

import gzip
import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from http.client import HTTPConnection
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest

from gelenk import serve
from tests.test_serve import service

TRACE = "4bf92f3577b34da6a3ce929d0e0e4736"


@contextmanager
def collector() -> Iterator[tuple[str, list[Any]]]:
    """Takes traces, and keeps their spans."""
    spans: list[Any] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            if self.path == "/v1/traces":
                if self.headers.get("Content-Encoding") == "gzip":
                    body = gzip.decompress(body)
                for resource in ExportTraceServiceRequest.FromString(body).resource_spans:
                    names = {each.key: each.value.string_value for each in resource.resource.attributes}
                    assert names["service.name"] == "gelenk"
                    spans.extend(span for scope in resource.scope_spans for span in scope.spans)
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}", spans
        finally:
            server.shutdown()


@pytest.mark.slow
def test_a_request_is_a_span_of_its_callers_trace_and_names_its_id(tmp_path: Path) -> None:
    with collector() as (endpoint, spans):
        # Over a connection that is kept, as clients have it: there, head and body may leave together.
        with (
            service(tmp_path, GELENK_OTLP_ENDPOINT=endpoint) as (_, url),
            closing(HTTPConnection(urlsplit(url).netloc, timeout=60)) as connection,
        ):
            headers = {
                "Content-Type": "application/json",
                "X-Request-Id": "traced-1",
                "traceparent": f"00-{TRACE}-00f067aa0ba902b7-01",
            }
            body = json.dumps({"joint_positions": [[0.0, 0.0]]})
            connection.request("POST", "/v1/robots/planar_2r/fk", body, headers)
            answer = connection.getresponse()
            assert answer.headers["x-request-id"] == "traced-1"
            assert json.load(answer)["poses"][0]["position"] == [1.7, 0.0, 0.0]
        (span,) = [each for each in spans if each.trace_id.hex() == TRACE and each.kind == 2]
    told = {each.key: each.value for each in span.attributes}
    assert told["gelenk.request_id"].string_value == "traced-1"
    assert told["http.route"].string_value == "/v1/robots/{robot}/fk"
    assert told["http.response.status_code"].int_value == 200
    assert "error.type" not in told
    assert span.status.code != 2, "an error"
    assert span.end_time_unix_nano > span.start_time_unix_nano


@pytest.mark.slow
def test_without_the_setting_nothing_of_it_is_loaded(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from gelenk.main import create_app; "
        "from gelenk.settings import Settings; create_app(Settings(data_dir=Path(sys.argv[1]))); print(*sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code, tmp_path], capture_output=True, text=True, check=True)
    assert "fastapi" in run.stdout.split()
    assert not [name for name in run.stdout.split() if name.startswith(("opentelemetry.sdk", "opentelemetry.exporter"))]


def test_the_extra_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(serve, "find_spec", lambda _: None)
    monkeypatch.setattr("sys.argv", ["serve"])
    monkeypatch.setenv("GELENK_OTLP_ENDPOINT", "http://127.0.0.1:4318")
    with pytest.raises(SystemExit, match=r"requirements-tracing\.lock"):
        serve.main()
