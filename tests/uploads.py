"""Robots to upload in each form, and scenes; what comes back shows which one it is. And a call of the service."""

import io
import json
import random
import zipfile
from dataclasses import dataclass
from http.client import HTTPConnection
from typing import Any, Literal
from urllib.parse import urlsplit

import numpy as np

_URDF = """<robot name="r"><link name="base"/><link name="tip">{mesh}</link><joint name="j" type="continuous">
<parent link="base"/><child link="tip"/><origin xyz="0 0 {number}"/><axis xyz="0 0 1"/></joint></robot>"""
_MESH = '<visual><geometry><mesh filename="package://arm/part.stl"/></geometry></visual>'
_BOUNDARY = "gelenk"


@dataclass(frozen=True, slots=True)
class Answer:
    """What has come back."""

    status: int
    body: bytes

    @property
    def content(self) -> Any:
        """The body as JSON."""
        return json.loads(self.body)


def ask(url: str, path: str, method: str = "GET", body: bytes | None = None, kind: str = "application/json") -> Answer:
    """One call on a connection of its own.

    Raises:
        OSError: There is no answer.
        HTTPException: There is half of one.
    """
    connection = HTTPConnection(urlsplit(url).netloc, timeout=60)
    try:
        connection.request(method, path, body, {"Content-Type": kind} if body is not None else {})
        answer = connection.getresponse()
        return Answer(answer.status, answer.read())
    finally:
        connection.close()


def read(url: str, path: str) -> Answer:
    """What is there.

    Raises:
        OSError: There is no answer, or one that says that the service could not look.
    """
    answer = ask(url, path)
    if answer.status >= 500:
        raise OSError(f"{path}: {answer.status} {answer.body[:200]!r}")
    return answer


@dataclass(frozen=True, slots=True)
class Upload:
    """A robot as it is uploaded.

    Attributes:
        form: How.
        number: Which one.
    """

    form: Literal["urdf", "zip", "dh", "scene"]
    number: int

    def send(self, url: str, name: str, is_new: bool) -> Answer:
        """Add it, or put it in the place of another one."""
        path, method = ("/v1/robots", "POST") if is_new else (f"/v1/robots/{name}", "PUT")
        named = {"name": name} if is_new else {}
        if self.form == "scene":
            path, scene = path.replace("robots", "scenes"), json.dumps(named | {"objects": [self._object()]})
            return ask(url, path, method, self._form({"scene": scene}), f"multipart/form-data; boundary={_BOUNDARY}")
        if self.form == "zip":
            return ask(url, path, method, self._form(named), f"multipart/form-data; boundary={_BOUNDARY}")
        content = {"dh": self._table()} if self.form == "dh" else {"urdf": self._urdf()}
        return ask(url, path, method, json.dumps(named | content).encode())

    def is_what(self, url: str, name: str) -> bool:
        """Whether what has the name is this one: a table, a URDF with its mesh to the last byte, a scene.

        Raises:
            OSError: As `read`.
        """
        if self.form == "scene":
            scene = read(url, f"/v1/scenes/{name}")
            file = {"name": "part.npy", "size": len(self._cloud())}
            return scene.status == 200 and scene.content == {"name": name, "objects": [self._object()], "files": [file]}
        if self.form == "dh":
            robot = read(url, f"/v1/robots/{name}")
            return robot.status == 200 and robot.content["dh"] is not None and self._is_table(robot.content["dh"])
        urdf = read(url, f"/v1/robots/{name}/urdf")
        if (urdf.status, urdf.body) != (200, self._urdf().encode()):
            return False
        mesh = read(url, f"/v1/robots/{name}/meshes/meshes/part.stl")
        return (mesh.status, mesh.body) == (200, self._mesh()) if self.form == "zip" else mesh.status == 404

    def _object(self) -> dict[str, Any]:
        return {"name": f"part {self.number}", "shape": {"type": "points", "file": "part.npy", "radius": 0.01}}

    def _table(self) -> dict[str, Any]:
        row = {"type": "revolute", "a": float(self.number), "alpha": 0.0, "d": 0.0, "theta": 0.0}
        return {"convention": "standard", "joints": [row]}

    def _is_table(self, table: dict[str, Any]) -> bool:
        return [row["a"] for row in table["joints"]] == [float(self.number)]

    def _urdf(self) -> str:
        return _URDF.format(number=self.number, mesh=_MESH if self.form == "zip" else "")

    def _mesh(self) -> bytes:
        return random.Random(self.number).randbytes(200_000)

    def _cloud(self) -> bytes:
        """Return points as npy: they are looked at before they are stored."""
        file = io.BytesIO()
        np.save(file, np.random.default_rng(self.number).random((16_000, 3), np.float32))
        return file.getvalue()

    def _form(self, fields: dict[str, str]) -> bytes:
        parts = [f'name="{name}"\r\n\r\n{value}'.encode() for name, value in fields.items()]
        if self.form == "scene":
            parts.append(b'name="files"; filename="part.npy"\r\n\r\n' + self._cloud())
        else:
            parts.append(b'name="archive"; filename="r.zip"\r\n\r\n' + self._archive())
        lines = b"".join(
            f"--{_BOUNDARY}\r\nContent-Disposition: form-data; ".encode() + part + b"\r\n" for part in parts
        )
        return lines + f"--{_BOUNDARY}--\r\n".encode()

    def _archive(self) -> bytes:
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w") as archive:
            archive.writestr("arm.urdf", self._urdf())
            archive.writestr("meshes/part.stl", self._mesh())
        return file.getvalue()
