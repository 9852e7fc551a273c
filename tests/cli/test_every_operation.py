"""Command line, client and API give the same answer to the same question: each operation of the schema, its example.

The operations are those of the schema, so that a new one that the client or the command line cannot ask fails here.
"""

import inspect
import json
import urllib.request
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import quote, urlencode

import pytest
import typer
from pydantic import BaseModel
from typer.core import TyperGroup

from gelenk.cli.main import cli
from gelenk.client import Client
from gelenk.client.operations import Operations
from gelenk.client.refusals import Refused
from tests.cli.conftest import Shell
from tests.client.test_operations import NAMES as METHODS
from tests.openapi import NO_ANSWER, document, example_of
from tests.test_serve import get

NAMES = {**METHODS, "watch_job": "watch", "get_job_result": "workspace_result"}
"""Methods of the client by the operation that they ask, where the two have other names."""
ORDER = {"post": 0, "get": 1, "put": 2, "delete": 3}
FIRST = {"watch_job"}
"""What waits until there is something that the others can be asked about."""
MOMENTS = {"created", "started", "finished"}
DIFFERENT = {"compare_dh": 1}
"""Exit codes of commands whose answer is no: the table of the example is not that of the robot."""


@dataclass(frozen=True)
class Question:
    """An operation with what the schema gives as its example."""

    id: str
    method: str
    path: str
    names: dict[str, Any]
    query: dict[str, Any]
    body: dict[str, Any]

    @property
    def fields(self) -> dict[str, Any]:
        """What the client's method takes; other forms of an answer are those of its `picture` and `dh_file`."""
        has_format = self.method == "GET" and self.id != "get_robot_dh"
        query = {name: value for name, value in self.query.items() if has_format or name != "format"}
        return {**query, **self.body}

    @property
    def name(self) -> str:
        return NAMES.get(self.id, self.id)


SCHEMA = document()


def questions() -> Iterator[Question]:
    for path, entries in SCHEMA["paths"].items():
        for method, operation in entries.items():
            given: dict[str, dict[str, Any]] = {"path": {}, "query": {}, "header": {}}
            for parameter in operation.get("parameters", []):
                example = next(iter(parameter["examples"].values()))["value"]
                given[parameter["in"]][parameter["name"]] = example
            content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
            body = example_of(content) or {}
            yield Question(operation["operationId"], method.upper(), path, given["path"], given["query"], body)


ASKED = (question for question in questions() if question.id not in NO_ANSWER)
QUESTIONS = sorted(ASKED, key=lambda one: (ORDER[one.method.lower()], one.id not in FIRST))
Way: TypeAlias = Callable[[Question], Any]


def by_api(url: str) -> Way:
    """With nothing of ours in between."""

    def ask(question: Question) -> Any:
        path = question.path.format(**{name: quote(value) for name, value in question.names.items()})
        query = "?" + urlencode(question.query, doseq=True) if question.query else ""
        wanted = {"Accept": "application/json"}
        request = urllib.request.Request(url + path + query, method=question.method, headers=wanted)
        if question.body:
            request.add_header("Content-Type", "application/json")
            request.data = json.dumps(question.body).encode()
        with urllib.request.urlopen(request, timeout=120) as answer:
            content, kind = answer.read(), answer.headers.get_content_type()
        if kind == "text/event-stream":
            return json.loads(content.decode().strip().rpartition("data: ")[2])
        return json.loads(content) if kind == "application/json" else content

    return ask


def by_client(gelenk: Client) -> Way:
    def ask(question: Question) -> Any:
        answer = getattr(gelenk, question.name)(*question.names.values(), **question.fields)
        if inspect.isgenerator(answer):
            *_, answer = answer
        if isinstance(answer, BaseModel):
            return answer.model_dump(mode="json", exclude_unset=True)
        return b"" if answer is None else answer if isinstance(answer, bytes) else answer.encode()

    return ask


def by_ask(shell: Shell, *options: str) -> Way:
    """The command for every operation; the one that waits has a name of its own."""

    def ask(question: Question) -> Any:
        if question.id == "watch_job":
            return shell.json(*options, "jobs", "watch", question.names["job"])
        names = dict(question.names)
        robot = ["--robot", names.pop("robot")] if "robot" in names else []
        fields = json.dumps({**names, **question.fields})
        return read(shell.bytes(*options, "ask", question.name, fields, *robot))

    return ask


def read(content: bytes) -> Any:
    return json.loads(content) if content.startswith(b"{") else content


Arguments: TypeAlias = Sequence[object]


@dataclass(frozen=True)
class Files:
    """What an example holds, as the files that a command takes."""

    folder: Path

    def of(self, content: Any, name: str) -> Path:
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path


def row(numbers: Sequence[float]) -> str:
    return " ".join(map(repr, numbers))


def chain(fields: dict[str, Any]) -> Arguments:
    return ["--base", fields.get("base_frame"), "--tip", fields["tip_frame"]][0 if "base_frame" in fields else 2 :]


def at(fields: dict[str, Any]) -> Arguments:
    return [word for q in fields["joint_positions"] for word in ("-q", row(q))]


def rest(fields: dict[str, Any], *told: str) -> Arguments:
    return ["--fields", json.dumps({name: value for name, value in fields.items() if name not in told})]


COMMANDS: dict[str, Callable[[dict[str, Any], Files], Arguments]] = {
    "list_robots": lambda _, __: ["robots"],
    "get_robot": lambda f, _: ["robots", f["robot"]],
    "get_robot_urdf": lambda f, _: ["robots", f["robot"], "--urdf"],
    "get_robot_mjcf": lambda f, _: ["robots", f["robot"], "--as", "mjcf"],
    "get_robot_screws": lambda f, _: ["robots", f["robot"], "--as", "screws", *chain(f)],
    "add_robot": lambda f, files: ["add", files.of(f["dh"], f"{f['name']}.json"), "--description", f["description"]],
    "replace_robot": lambda f, files: [
        *("add", files.of(f["dh"], "again.json"), "--replace", "--name", f["robot"]),
        *("--description", f["description"]),
    ],
    "remove_robot": lambda f, _: ["remove", f["robot"]],
    "list_scenes": lambda _, __: ["scenes", "list"],
    "get_scene": lambda f, _: ["scenes", "show", f["scene"]],
    "add_scene": lambda f, files: ["scenes", "put", files.of({"objects": f["objects"]}, f"{f['name']}.json")],
    "replace_scene": lambda f, files: [
        *("scenes", "put", files.of({"objects": f["objects"]}, "again.json"), "--name", f["scene"]),
    ],
    "remove_scene": lambda f, _: ["scenes", "remove", f["scene"]],
    "get_robot_dh": lambda f, _: [
        *("dh", "from-urdf", f["robot"], "--convention", f["convention"], "--snap", f["snap_tolerance"]),
        *chain(f),
    ],
    "dh_to_urdf": lambda f, files: ["dh", "to-urdf", files.of(f["dh"], "arm.json"), "--name", f["name"]],
    "dh_from_urdf": lambda f, files: [
        *("dh", "from-urdf", files.of(f["urdf"], "arm.urdf"), "--snap", f["snap_tolerance"]),
        *chain(f),
    ],
    "convert_dh": lambda f, files: ["dh", "convert", files.of(f["dh"], "arm.json"), "--convention", f["convention"]],
    "compare_dh": lambda f, files: ["dh", "compare", files.of(f["dh"], "arm.json"), f["robot"], *chain(f)],
    "derive_dh": lambda f, files: ["dh", "derive", files.of(f["dh"], "arm.json"), *rest(f, "dh")],
    "forward_kinematics": lambda f, _: ["fk", f["robot"], *at(f), *chain(f), "--pose", f["pose_format"]],
    "jacobian": lambda f, _: ["jacobian", f["robot"], *at(f), "--reference", f["reference"]],
    "inverse_kinematics": lambda f, _: [
        *("ik", f["robot"], "--to", row([*f["targets"][0]["position"], *f["targets"][0]["rpy"]])),
        *chain(f),
    ],
    "manipulability": lambda f, _: ["manipulability", f["robot"], *at(f), *rest(f, "robot", "joint_positions")],
    "trajectory": lambda f, files: [
        *("trajectory", f["robot"], "--start", row(f["start"])),
        *("--motion", files.of({name: f[name] for name in f if name not in {"robot", "start"}}, "motion.json")),
    ],
    "workspace": lambda f, _: [
        *("workspace", f["robot"], "--job", "--kind", f["kind"], "--samples", f["samples"], *chain(f)),
        *rest(f, "robot", "kind", "samples", "tip_frame"),
    ],
    "list_exercises": lambda f, _: ["exercises", "--lang", f["language"]],
    "draw_exercise": lambda f, _: ["exercises", f["exercise"], "--seed", f["seed"]],
    "write_sheets": lambda f, files: [
        *("sheet", *f["exercises"], "--class", files.of("\n".join(f["participants"]), "class.txt")),
        *("--title", f["title"], "--secret", f["secret"]),
    ],
    "grade_sheets": lambda f, files: ["grade", files.of(f["csv"], "answers.csv"), "--secret", f["secret"]],
    "list_jobs": lambda f, _: ["jobs", "list", "--limit", f["limit"], "--before", f["before"]],
    "get_job": lambda f, _: ["jobs", "show", f["job"]],
    "watch_job": lambda f, _: ["jobs", "watch", f["job"]],
    "get_job_result": lambda f, _: ["jobs", "result", f["job"]],
    "cancel_job": lambda f, _: ["jobs", "cancel", f["job"], "--finished", f["finished"]],
}
"""Each operation that has a command of its own, with the arguments that say what its example does."""
ON_A_SERVER = {"workspace"}
"""Whose command begins a job for others to look at, which ends with the process that does it."""
NO_OPERATION = {"ask", "serve", "bench", "keys"}


def by_commands(shell: Shell, folder: Path, *options: str) -> Way:
    """Commands of their own, where there are; what is over by then has been asked by the other way."""
    otherwise = by_ask(shell, *options)

    def ask(question: Question) -> Any:
        command = COMMANDS.get(question.id)
        if command is None or (question.id in ON_A_SERVER and not options):
            return otherwise(question)
        arguments = command({**question.names, **question.fields}, Files(folder))
        code = DIFFERENT.get(question.id, 0)
        return read(shell.bytes("--format", "json", *options, *arguments, code=code))

    return ask


def answers(way: Way) -> dict[str, Any]:
    """Of all operations; what the first add, the last remove."""
    return {question.id: comparable(question, way(question)) for question in QUESTIONS}


def comparable(question: Question, answer: Any) -> Any:
    """An answer without what is another one each time: moments, and how much there was to do."""
    if question.id == "metrics":
        return sorted(line for line in answer.decode().splitlines() if line.startswith("# HELP"))
    if question.id == "list_jobs":  # there may be more by now
        return sorted(answer)
    if question.id in {"workspace", "cancel_job", "get_job", "watch_job"}:
        moments = MOMENTS | ({"state", "progress", "attempts"} if question.id == "workspace" else set())
        return {name: value for name, value in answer.items() if name not in moments}
    return answer


@pytest.fixture(scope="module")
def expected(url: str) -> dict[str, Any]:
    return answers(by_api(url))


@pytest.mark.slow
def test_the_client_says_what_the_api_does(url: str, expected: dict[str, Any]) -> None:
    with Client(url) as gelenk:
        assert answers(by_client(gelenk)) == expected


@pytest.mark.slow
@pytest.mark.parametrize("where", ["here", "there"])
@pytest.mark.parametrize("how", ["fields as JSON", "commands"])
def test_the_command_line_says_what_the_api_does(
    shell: Shell, url: str, expected: dict[str, Any], tmp_path: Path, where: str, how: str
) -> None:
    """In its own process, and on a server; by the command for all operations, and by those that some have."""
    options = ("--server", url) if where == "there" else ()
    found = answers(by_commands(shell, tmp_path, *options) if how == "commands" else by_ask(shell, *options))
    assert found == expected


def fields_of(part: dict[str, Any]) -> set[str]:
    """The names of all fields that a part of the schema allows."""
    if "$ref" in part:
        part = SCHEMA["components"]["schemas"][part["$ref"].rpartition("/")[2]]
    inner = [one for kind in ("oneOf", "anyOf", "allOf") for one in part.get(kind, [])]
    return set(part.get("properties", {})).union(*map(fields_of, inner))


def test_the_client_takes_what_the_schema_does_and_nothing_else() -> None:
    """Also what no example holds."""
    for question in QUESTIONS:
        if question.id not in {"watch_job", "get_dh_picture"}:  # `watch` and `picture`
            operation = SCHEMA["paths"][question.path][question.method.lower()]
            content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
            parameters = operation.get("parameters", [])
            allowed = {one["name"] for one in parameters if one["in"] != "header"} | fields_of(
                content.get("schema", {})
            )
            allowed -= {"format"}  # which the client's `picture` has
            taken = set(inspect.signature(vars(Operations)[question.name].describe).parameters)
            assert taken == allowed, question.id


def test_every_command_is_compared(tmp_path: Path) -> None:
    fields = {question.id: {**question.names, **question.fields} for question in QUESTIONS}
    asked = {tuple(map(str, said(fields[name], Files(tmp_path))))[:2] for name, said in COMMANDS.items()}
    for command in commands():
        if command[0] not in NO_OPERATION:
            assert any(words[: len(command)] == command for words in asked), " ".join(command)


def commands() -> Iterator[tuple[str, ...]]:
    group = typer.main.get_command(cli)
    assert isinstance(group, TyperGroup)
    for name, command in group.commands.items():
        if isinstance(command, TyperGroup):
            yield from ((name, part) for part in command.commands)
        else:
            yield (name,)


WRONG: dict[str, tuple[str, str, dict[str, Any]]] = {
    "unknown robot": ("fk", "pandda", {"joint_positions": [[0.0] * 7]}),
    "unknown frame": ("fk", "panda", {"joint_positions": [[0.0] * 7], "tip_frame": "hand"}),
    "unknown field": ("jacobian", "panda", {"joint_positions": [[0.0] * 7], "colour": "red"}),
    "missing field": ("ik", "panda", {}),
    "wrong count": ("statics", "panda", {"joint_positions": [[0.0] * 6], "gravity": True}),
    "wrong kind": ("dynamics", "panda", {"joint_positions": [["0"] * 7]}),
    "no rotation": ("ik", "panda", {"targets": [{"position": [0.4, 0.0, 0.4], "quaternion_xyzw": [0, 0, 0, 0]}]}),
    "wrong method": ("ik", "panda", {"targets": [{"matrix": [[1, 0, 0, 0], [0, 1, 0, 0]]}], "method": "guess"}),
    "too many samples": ("workspace", "panda", {"samples": 10**9}),
    "no motion": ("trajectory", "panda", {"start": [0.0] * 7, "segments": []}),
    "not a robot": ("dh_from_urdf", "", {"urdf": "<robot/>"}),
    "no table": ("dh_to_urdf", "", {"name": "arm", "dh": {"convention": "standard", "joints": []}}),
    "no orientation": ("orientation", "", {"zyz": [0.1, 0.2, 0.3], "rpy": [0.1, 0.2, 0.3]}),
    "no duration": ("time_law", "", {"law": "cubic", "start": 0.0, "target": 1.0, "duration": -1.0}),
    "unknown job": ("job", "", {"job": "nothing"}),
    "read only": ("remove_robot", "panda", {}),
    "name taken": ("add_robot", "", {"name": "panda", "urdf": "<robot name='a'><link name='b'/></robot>"}),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_in_the_sentence_of_the_api(shell: Shell, url: str, name: str) -> None:
    operation, robot, fields = WRONG[name]
    about = [robot] if robot else []
    with Client(url) as gelenk:
        call = vars(Operations)[operation].describe(*about, **fields)
        status, problem = get(f"{url}/{call.path}", call.method, json.loads(call.body or b"null"))
        with pytest.raises(Refused) as refused:
            gelenk.send(call)
    assert refused.value.status == status >= 400
    assert refused.value.problem == problem | {"request_id": refused.value.problem["request_id"]}
    arguments = ["ask", operation, json.dumps(fields), *(["--robot", robot] if robot else [])]
    for options in ((), ("--server", url)):
        assert shell(*options, *arguments, code=2)[1] == f"gelenk: {problem['detail']}\n"
