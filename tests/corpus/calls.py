"""Requests that are none, with their verdict: `PATHS`, `RAW_PATHS`, `QUERIES`, `FORMS` and `HEADERS`.

`mentions` are lower-case words that the lower-cased problem has to contain to be of use.
"""

from tests.corpus.bodies import JSON, Call
from tests.corpus.fields import FIELDS, PANDA
from tests.corpus.npy import GOOD, VALUES, saved
from tests.corpus.zips import good

NPY = ("content-type", "application/x-npy")
PLANAR = "/v1/robots/planar_2r"

# --- Paths ---

_OUT = ("..%2f..%2frobot.json", "%2fetc%2fpasswd", "/etc/passwd", "..\\..\\robot.json", "%5c..%5cx.stl",
        "%252e%252e%252fx.stl", "....//x.stl", "file:///etc/passwd", "C:/x.stl",
        "a%00.stl", "%00", "%ff.stl", "%ed%a0%80.stl", "%1b[31m.stl", "%0d%0aSet-Cookie:x.stl", "\u2025/x.stl",
        "robot.json", "robot.urdf", "x" * 5000 + ".stl", "x/" * 3000 + "x.stl", "~root/x.stl", "CON.stl",
        "link0.dae%20", "*.dae", "")  # fmt: skip
_NO_NAMES = ("nobody", "%2e%2e", "..%2fpanda", "panda%2f..%2fpanda", "panda%00", "%00", "panda%0a", "PANDA",
             "p%61nda%20", "pand\u0430", "%ff", "%ed%a0%80", ".lock", "-x", "x" * 65, "x" * 10_000, "panda;x",
             "%1b%5b31m", "*", "$HOME", "{robot}")  # fmt: skip
"""A letter of another alphabet among them."""

PATHS: tuple[Call, ...] = (
    *(Call(f"mesh {path[:40]}", "GET", f"{PANDA}/meshes/{path}", (404,)) for path in _OUT),
    *(Call(f"robot {name[:40]}", "GET", f"/v1/robots/{name}", (404,)) for name in _NO_NAMES),
    *(
        Call(f"{method} robot {name[:40]}", method, f"/v1/robots/{name}", (404,), (), body, (JSON,))
        for name in _NO_NAMES
        for method, body in (("DELETE", b""), ("PUT", b'{"urdf": "<robot/>"}'))
    ),
    *(
        Call(f"fk of {name[:40]}", "POST", f"/v1/robots/{name}/fk", (404,), (), b'{"joint_positions": []}', (JSON,))
        for name in _NO_NAMES
    ),
    *(
        Call(f"{method} job {name[:40]}{end}", method, f"/v1/jobs/{name}{end}", (404,))
        for name in _NO_NAMES
        for method, end in (("GET", ""), ("DELETE", ""), ("GET", "/events"), ("GET", "/result"))
    ),
    *(
        Call(f"{method} {path[:60]}", method, path, (status,))
        for method, path, status in (
            ("GET", "/v1", 404),
            ("GET", "/v1/robots/", 404),
            ("GET", "//v1/robots", 404),
            ("GET", "/v1//robots", 404),
            ("GET", "/V1/robots", 404),
            ("GET", "/v1/robots/panda/", 404),
            ("GET", "/v1/robots/panda/fk", 405),
            ("POST", f"{PANDA}/dance", 404),
            ("POST", f"{PANDA}/fk/", 404),
            ("POST", f"{PANDA}/FK", 404),
            ("PUT", f"{PANDA}/fk", 405),
            ("PATCH", "/v1/robots", 405),
            ("PUT", "/v1/robots", 405),
            ("TRACE", "/v1/robots", 405),
            ("BREW", "/v1/robots", 405),
            ("GET", "/v1/" + "x/" * 20_000, 404),
            ("GET", "/%2e%2e/main.py", 404),
        )
    ),
)
"""Ways out of the folders, names that are none, and paths that lead nowhere."""

RAW_PATHS: tuple[Call, ...] = (
    *(
        Call(f"raw {path}", "GET", path, (404,))
        for path in (
            "/..",
            "/../../etc/passwd",
            "/static/../main.py",
            "/v1/robots/.",
            "/v1/robots/..",
            "/v1/robots/panda/../../../etc/passwd",
            f"{PANDA}/meshes/..",
            f"{PANDA}/meshes/../..",
            f"{PANDA}/meshes/.",
            f"{PANDA}/meshes/../../../robot.json",
            f"{PANDA}/meshes//etc/passwd",
            "/v1/jobs/..",
            "/v1/jobs/../robots/events",
        )
    ),
    Call("raw bytes", "GET", "/v1/robots/\u00ff\u00fe", (404,)),
    Call("raw escape sequence", "GET", "/v1/robots/\x1b[31m", (400, 404)),
    Call("raw NUL", "GET", "/v1/robots/\0", (400, 404)),
    Call("a path of 60,000 characters", "GET", "/v1/robots/" + "x" * 60_000, (400, 404, 414, 431)),
    Call("a query of 60,000 characters", "GET", f"{PANDA}/dh?tip_frame=" + "x" * 60_000, (400, 414, 422, 431)),
    Call("a host of another kind", "GET", "http://127.0.0.1/v1/robots/nobody", (400, 404)),
    Call("an asterisk", "OPTIONS", "*", (400, 404, 405)),
    Call(
        "a header of 200,000 characters", "GET", "/v1/robots/nobody", (400, 404, 431), (), b"", (("x", "y" * 200_000),)
    ),
    Call("5,000 headers", "GET", "/v1/robots/nobody", (400, 404, 431), headers=(("x", "y"),) * 5_000),
    *(
        Call(f"length {length!r}", "POST", f"{PLANAR}/fk", (400, 413), (), b"{}", (JSON, ("content-length", length)))
        for length in ("-1", "x", "1_0", "0x2", "9" * 30, "")
    ),
)
"""What no client of good manners sends: dots are not taken out, nothing is escaped, lengths are none."""


# --- Queries ---


def _npy(query: str, status: int, mentions: tuple[str, ...], operation: str = "fk") -> Call:
    return Call(
        f"npy {operation}?{query[:60]}", "POST", f"{PLANAR}/{operation}?{query}", (status,), mentions, GOOD, (NPY,)
    )


QUERIES: tuple[Call, ...] = (
    _npy("pose_format=euler", 422, ("pose_format",)),
    _npy("pose_format=", 422, ("pose_format",)),
    _npy("pose_format=rpy&pose_format=euler", 422, ("pose_format",)),
    _npy("respect_limits=perhaps", 422, ("respect_limits",)),
    _npy("tip_frame=nose", 404, ("nose",)),
    _npy("tip_frame=%1b%5b31m%00", 404, ()),
    _npy("tip_frame=%ed%a0%80", 404, ()),
    _npy("tip_frame=", 422, ("tip_frame",)),
    _npy("tip_frame=" + "x" * 5000, 422, ("tip_frame",)),
    _npy("frames=nose", 404, ("nose",)),
    _npy("joint_positions=0", 422, ("joint_positions",)),
    _npy("gripper=1", 422, ("gripper",)),
    _npy("%ff=1", 422, ()),
    _npy("%00=%00", 422, ()),
    _npy("=1", 422, ()),
    _npy("&".join(f"k{i}=1" for i in range(1001)), 413, ("1000",)),
    _npy("&".join(["frames=tool"] * 1001), 413, ("1000",)),
    _npy("rank_tolerance=nan", 422, ("rank_tolerance",), "jacobian"),
    _npy("rank_tolerance=1e400", 422, ("rank_tolerance",), "jacobian"),
    _npy("rank_tolerance=0", 422, ("rank_tolerance",), "jacobian"),
    _npy("derivatives=all", 422, ("derivatives",), "jacobian"),
    _npy("reference=moon", 422, ("reference",), "jacobian"),
    *(
        Call(f"json {operation}?x=1", "POST", f"{PANDA}/{operation}?x=1", (422,), ("query",), b"{}", (JSON,))
        for operation in ("fk", "jacobian", "ik", "statics", "dynamics", "manipulability", "velocity",
                          "singularities", "trajectory", "workspace")
    ),
    *(
        Call(f"dh?{query[:60]}", "GET", f"{PANDA}/dh?{query}", (status,), mentions)
        for query, status, mentions in (
            ("convention=craig", 422, ("convention",)),
            ("convention=", 422, ("convention",)),
            ("tip_frame=nose", 404, ("nose",)),
            ("tip_frame=%00", 404, ()),
            ("tip_frame=" + "x" * 5000, 422, ("tip_frame",)),
            ("base_frame=panda_link8&tip_frame=panda_link8", 422, ("joint",)),
            *((f"snap_tolerance={value}", 422, ("snap_tolerance",))
              for value in ("nan", "inf", "-1", "1e400", "x", "", "1e300")),
        )
    ),
)  # fmt: skip
"""Beside an array, and of the table of a robot."""


# --- Forms ---

_BOUNDARY = "gelenk"


def _form(*parts: bytes, end: bytes = b"--gelenk--\r\n") -> bytes:
    return b"".join(b"--gelenk\r\n" + part + b"\r\n" for part in parts) + end


def _field(name: str, value: bytes) -> bytes:
    return f'Content-Disposition: form-data; name="{name}"\r\n\r\n'.encode() + value


def _archive(content: bytes, filename: str = "robot.zip", name: str = "archive") -> bytes:
    disposition = f'Content-Disposition: form-data; name="{name}"; filename="{filename}"'
    return f"{disposition}\r\nContent-Type: application/zip\r\n\r\n".encode() + content


def _posted(name: str, statuses: tuple[int, ...], body: bytes, media_type: str = "") -> Call:
    kind = media_type or f"multipart/form-data; boundary={_BOUNDARY}"
    return Call(f"form: {name}", "POST", "/v1/robots", statuses, (), body, (("content-type", kind),))


_NAME = _field("name", b"refused")

FORMS: tuple[Call, ...] = (
    _posted("nothing", (400, 422), b""),
    _posted("no parts", (400, 422), b"--gelenk--\r\n"),
    _posted("no boundary", (400, 422), _form(_NAME, _archive(good())), "multipart/form-data"),
    _posted("an empty boundary", (400, 422), _form(_NAME), "multipart/form-data; boundary="),
    _posted("another boundary", (400, 422), _form(_NAME), "multipart/form-data; boundary=other"),
    _posted("a long boundary", (400, 422), _form(_NAME), "multipart/form-data; boundary=" + "x" * 10_000),
    _posted("a boundary outside ASCII", (400, 422), _form(_NAME), "multipart/form-data; boundary=ö"),
    _posted("a character set that is none", (400, 422), _form(_NAME),
            "multipart/form-data; boundary=gelenk; charset=klingon"),
    _posted("a character set of bytes", (400, 422), _form(_NAME),
            "multipart/form-data; boundary=gelenk; charset=base64"),
    _posted("cut in a part", (400, 422), _form(_NAME, _archive(good()))[:-200]),
    _posted("cut in a header", (400, 422), _form(_NAME)[:30]),
    _posted("no end", (400, 422), _form(_NAME, end=b"")),
    _posted("a part without a name", (400, 422), _form(b"Content-Disposition: form-data\r\n\r\nx")),
    _posted("a part without a header", (400, 422), _form(b"\r\nx")),
    _posted("a header of a megabyte", (400, 413, 422), _form(b"X: " + b"x" * 1_000_000 + b"\r\n\r\nx")),
    _posted("10,000 headers", (400, 413, 422), _form(b"X: y\r\n" * 10_000 + b"\r\nx")),
    _posted("100,000 parts", (400, 413, 422), _form(*[_field("x", b"")] * 100_000)),
    _posted("two archives", (400, 422), _form(_NAME, _archive(good()), _archive(good()))),
    _posted("an archive that is a field", (422,), _form(_NAME, _field("archive", b"PK"))),
    _posted("a name that is a file", (400, 422), _form(_archive(b"refused", "n", "name"), _archive(good()))),
    _posted("a field of a megabyte", (400, 413, 422), _form(_field("name", b"x" * 1_000_000), _archive(good()))),
    _posted("an unknown field", (422,), _form(_NAME, _field("colour", b"red"), _archive(good()))),
    _posted("a name outside UTF-8", (400, 422), _form(_field("name", b"\xff\xfe"), _archive(good()))),
    _posted("a name with NUL", (422,), _form(_field("name", b"a\0"), _archive(good()))),
    _posted("a name that leads out", (422,), _form(_field("name", b"../x"), _archive(good()))),
    _posted("a JSON body", (400, 422), b'{"name": "refused"}'),
    _posted("nested", (400, 422), _form(b"Content-Type: multipart/mixed; boundary=b\r\n\r\n--b\r\n\r\nx\r\n--b--")),
    _posted("unknown transfer encoding", (422,), _form(
        b'Content-Disposition: form-data; name="name"\r\nContent-Transfer-Encoding: base64\r\n\r\nLi4vLi4v')),
)  # fmt: skip
"""Uploads that are no forms, or not this one."""


# --- Headers of a good request ---


def _headed(name: str, statuses: tuple[int, ...], *headers: tuple[str, str]) -> Call:
    body = b'{"joint_positions": [[0.25, -0.5]]}'
    return Call(f"header: {name}", "POST", f"{PLANAR}/fk", statuses, (), body, (JSON, *headers))


HEADERS: tuple[Call, ...] = (
    _headed("Accept of nonsense", (200,), ("accept", ";;;,,,q=;/")),
    _headed("Accept with a weight that is none", (200,), ("accept", "application/x-npy;q=nan, application/json;q=inf")),
    _headed("Accept with a weight of 5,000 digits", (200,), ("accept", "application/json;q=0." + "1" * 5000)),
    _headed("Accept of 10,000 ranges", (200,), ("accept", ",".join(["text/x"] * 10_000))),
    _headed("Accept of 10,000 parameters", (200,), ("accept", "application/json" + ";x=y" * 10_000)),
    _headed("Accept outside ASCII", (200,), ("accept", "applicätion/json")),
    _headed("Accept with an escape sequence", (200,), ("accept", "\x1b[31m/json")),
    _headed("an unknown method to override", (200,), ("x-http-method-override", "DELETE")),
    _headed("an id of its own with an escape sequence", (200,), ("x-request-id", "\x1b[31mx")),
    _headed("an id of its own of 10,000 characters", (200,), ("x-request-id", "x" * 10_000)),
    _headed("a key where none is needed", (200,), ("authorization", "Bearer " + "x" * 5000)),
    _headed("cookies", (200,), ("cookie", "a=b; " * 1000)),
    _headed("a range", (200,), ("range", "bytes=0-0,1-1,2-2")),
    _headed("an address from elsewhere", (200,), ("x-forwarded-for", "\x1b[31m")),
    Call("header: npy that is called JSON", "POST", f"{PLANAR}/fk", (400,), ("json",), GOOD, (JSON,)),
    Call("header: JSON that is called npy", "POST", f"{PLANAR}/fk", (422,), ("npy",), b"[[0, 0]]", (NPY,)),
    Call("header: npy in NumPy's own words", "POST", f"{PLANAR}/fk", (415,), (), saved(VALUES),
         (("content-type", "application/octet-stream"),)),
)  # fmt: skip
"""Nothing that stands in a header brings anything down; what is no business of ours is passed over."""

ALL: tuple[Call, ...] = (*FIELDS, *PATHS, *QUERIES, *FORMS, *HEADERS)
