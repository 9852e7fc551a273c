"""Any sequence of calls on robots, to a service of two workers: whichever is asked knows what a dictionary knows."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar, Literal

import pytest
from hypothesis import HealthCheck, settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule, run_state_machine_as_test

from tests.test_serve import service
from tests.uploads import Answer, Upload, ask

TIMES = 4
"""How often each question is asked, on connections of their own: workers take turns by chance."""
CATALOGUE = "ur5"

names = st.sampled_from(["a", "b", "a.b-C_1"])
uploads = st.builds(Upload, st.sampled_from(["urdf", "zip", "dh"]), st.integers(1, 3))


def kind_of(answer: Answer) -> tuple[int, str]:
    """A status, and the word for what is wrong, if something is."""
    if answer.status < 400:
        return answer.status, ""
    return answer.status, answer.content["type"].removeprefix("urn:gelenk:")


class Robots(RuleBasedStateMachine):
    """Robots by name as they are known here, and the service that must know the same."""

    url: ClassVar[str]

    def __init__(self) -> None:
        super().__init__()
        self.known: dict[str, Upload] = {}

    @initialize()
    def begin_with_none(self) -> None:
        for name in self.listed():
            assert ask(self.url, f"/v1/robots/{name}", "DELETE").status == 204

    @rule(name=names, upload=uploads)
    def add(self, name: str, upload: Upload) -> None:
        answer = upload.send(self.url, name, is_new=True)
        present = self.known.setdefault(name, upload)
        if present is upload:
            assert kind_of(answer) == (201, "")
        else:
            assert kind_of(answer) == ((200, "") if present == upload else (409, "robot-exists"))

    @rule(name=names, upload=uploads)
    def replace(self, name: str, upload: Upload) -> None:
        answer = upload.send(self.url, name, is_new=False)
        if name in self.known:
            assert kind_of(answer) == (200, "")
            self.known[name] = upload
        else:
            assert kind_of(answer) == (404, "unknown-robot")

    @rule(name=names)
    def remove(self, name: str) -> None:
        answer = ask(self.url, f"/v1/robots/{name}", "DELETE")
        assert kind_of(answer) == ((204, "") if self.known.pop(name, None) else (404, "unknown-robot"))

    @rule(upload=uploads)
    def write_to_the_catalogue(self, upload: Upload) -> None:
        assert kind_of(upload.send(self.url, CATALOGUE, is_new=True)) == (409, "robot-exists")
        assert kind_of(upload.send(self.url, CATALOGUE, is_new=False)) == (403, "read-only-robot")
        assert kind_of(ask(self.url, f"/v1/robots/{CATALOGUE}", "DELETE")) == (403, "read-only-robot")

    @rule(name=names, part=st.sampled_from(["", "/urdf", "/meshes/meshes/part.stl"]))
    def read(self, name: str, part: Literal["", "/urdf"]) -> None:
        """What was uploaded comes back to the last byte."""
        for _ in range(TIMES):
            if name in self.known:
                assert self.known[name].is_what(self.url, name)
            else:
                assert kind_of(ask(self.url, f"/v1/robots/{name}{part}")) == (404, "unknown-robot")

    @rule(name=names)
    def compute(self, name: str) -> None:
        """No worker computes with a robot that another one has replaced or removed."""
        body = json.dumps({"joint_positions": [[0.0]]}).encode()
        for _ in range(TIMES):
            answer = ask(self.url, f"/v1/robots/{name}/fk", "POST", body)
            if name not in self.known:
                assert kind_of(answer) == (404, "unknown-robot")
                continue
            upload = self.known[name]
            height = [float(upload.number), 0.0, 0.0] if upload.form == "dh" else [0.0, 0.0, float(upload.number)]
            assert answer.content["poses"][0]["position"] == height

    @invariant()
    def list_all(self) -> None:
        for _ in range(2):
            assert self.listed() == sorted(self.known)

    def listed(self) -> list[str]:
        robots = ask(self.url, "/v1/robots").content["robots"]
        return sorted(robot["name"] for robot in robots if robot["source"] == "uploaded")


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder: Path = tmp_path_factory.mktemp("data")
    with service(folder, "--workers", "2", GELENK_CREW_PROCESSES="2") as (_, url):
        yield url


@pytest.mark.slow
def test_every_worker_knows_what_a_dictionary_knows(running: str) -> None:
    Robots.url = running
    run_state_machine_as_test(
        Robots,
        settings=settings(
            max_examples=50,
            stateful_step_count=15,
            deadline=None,
            derandomize=True,
            suppress_health_check=list(HealthCheck),
        ),
    )
