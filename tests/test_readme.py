"""The README's calls are run, and their answers are those that it prints."""

import json
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from starlette.testclient import TestClient

from tests.api.conftest import ready_client

README = Path("README.md").read_text(encoding="utf-8")
ROUNDING = 1e-12


class Call(NamedTuple):
    """A curl command, and what the README says it prints."""

    url: str
    body: str
    content_type: str
    prints_status: bool
    output: str


def calls() -> list[Call]:
    return [parse(block) for block in re.findall(r"```console\n\$ (curl.*?)\n```", README, re.DOTALL)]


def parse(block: str) -> Call:
    """The few options of curl that the README uses."""
    command, output = re.fullmatch(r"(.*')\n([^\n]+)", block, re.DOTALL).groups()  # type: ignore[union-attr]
    words = shlex.split(command.replace("\\\n", " "))[1:]
    options = {"-o": "", "-w": "", "-H": "", "-d": ""}
    urls = []
    while words:
        word = words.pop(0)
        if word in options:
            options[word] = words.pop(0)
        elif word != "-s":
            urls.append(word)
    (url,) = urls
    header, _, content_type = options["-H"].partition(": ")
    assert header == "Content-Type"
    assert url.startswith("http://localhost:8000")
    return Call(url.removeprefix("http://localhost:8000"), options["-d"], content_type, bool(options["-w"]), output)


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    yield from ready_client(tmp_path_factory.mktemp("readme"))


def test_there_are_five_calls() -> None:
    assert len(calls()) == 5


def test_the_calls_print_what_the_readme_says(client: TestClient) -> None:
    """In their order, because one uses the robot of the one before."""
    for call in calls():
        answer = client.post(call.url, content=call.body, headers={"content-type": call.content_type})
        if call.prints_status:
            assert str(answer.status_code) == call.output
        else:
            assert same(answer.json(), json.loads(call.output)), answer.text


def same(one: Any, other: Any) -> bool:
    """Equal, numbers up to rounding, which differs between processors; each request has an id of its own."""
    if isinstance(one, dict) and isinstance(other, dict):
        pairs = {key: (one[key], other[key]) for key in one if key in other}
        ids = pairs.pop("request_id", ("0" * 32, "0" * 32))
        has_ids = all(re.fullmatch("[0-9a-f]{32}", each) for each in ids)
        return list(one) == list(other) and has_ids and all(same(*pair) for pair in pairs.values())
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other, strict=True))
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) < ROUNDING
    return bool(one == other)


def test_every_setting_is_told() -> None:
    from dataclasses import fields

    from app.settings import Settings

    assert [field.name for field in fields(Settings) if f"`GELENK_{field.name.upper()}`" not in README] == []


def test_the_limits_are_those_of_the_code() -> None:
    from app.kinematics.ik import branches, search
    from app.model import dh, tree, urdf, xml
    from app.schemas import ik
    from app.settings import Settings
    from app.store import archive

    assert f"| {Settings().max_body_bytes // 2**20} MiB (`GELENK_MAX_BODY_BYTES`)" in README
    assert f"| {Settings().max_answer_numbers:,} (`GELENK_MAX_ANSWER_NUMBERS`)" in README
    limits = (
        f"{xml.MAX_BYTES // 2**20} MiB, {urdf.MAX_LINKS} links, {tree.MAX_DEPTH} joints deep, "
        f"{tree.MAX_MOVABLE} movable joints, {urdf.MAX_SHAPES} geometries"
    )
    assert limits in README
    assert f"| {dh.MAX_JOINTS} joints" in README
    assert f"{archive.MAX_ENTRIES:,} entries, {archive.MAX_UNPACKED // 2**20} MiB unpacked" in README
    assert f"targets in one call | {ik.MAX_TARGETS:,} |" in README
    assert f"with `trace` | {ik.MAX_STEPWISE:,} |" in README
    assert f"the budget of {search.MAX_ITERATIONS:,} iterations" in README
    assert f"where {branches.STARTS:,} starts converge" in README
    count = len(list(Path("robots").glob("*/robot.json")))
    assert f"({count} robots come with the service" in README
