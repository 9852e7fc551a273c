"""Where mutations start: the corpus, without what is large, and words that mean something to each reader.

A mutation of a large input costs as much as of a hundred others.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tests.corpus import dh, npy, urdf, zips

_LONGEST = 4000
NUMBERS = (
    *(b"0", b"-0.0", b"1", b"-1", b"1e308", b"-1e308", b"1e-308", b"5e-324", b"1e400", b"NaN", b"inf", b"-Infinity"),
    *(b"1e6", b"1000001", b"3.141592653589793", b"9" * 40, b"0x1p3", b"1_0", b"\xd9\xa1", b"+1", b".5", b"1."),
)
"""Such as readers stumble over."""
URDF_WORDS = (
    *(b"<link name='a'/>", b"<joint", b"</joint>", b"</robot>", b'type="continuous"', b'type="prismatic"'),
    *(b'type="planar"', b'type="floating"', b'type="fixed"', b'<parent link="base"/>', b'<child link="base"/>'),
    *(b'<axis xyz="0 0 0"/>', b'<mimic joint="elbow" multiplier="1e308"/>', b'<limit lower="1" upper="-1"/>'),
    *(b"<!DOCTYPE r [<!ENTITY e 'x'>]>", b"&e;", b"<![CDATA[", b"]]>", b"<!--", b"-->", b"<?xml version='1.1'?>"),
    *(b"\0", b"\xff", b"\xed\xa0\x80", b"\xef\xbb\xbf", b"xmlns='u'", b'"', b"'", b"<", b">", b"&#0;", b"&#x1b;"),
)
DH_WORDS = (
    *(b"null", b"true", b"{}", b"[]", b'"a"', b'"prismatic"', b'"modified"', b'"mimic":{"joint":"shoulder"}'),
    *(b'"base":{"position":[0,0,0],"rpy":[0,0,0]}', b'"tool":{"matrix":[[1,0,0,0]]}', b'"lower":', b'"upper":'),
    *(b"\\ud800", b"\\u0000", b"\0", b"\xff", b"[[[[[[[[", b"]]]]]]]]", b"{", b"}", b",", b":", b'"'),
)
NPY_WORDS = (
    *(b"'<f8'", b"'>f2'", b"'|O'", b"'|V8'", b"'<f16'", b"[('a','<f8')]", b"True", b"False", b"None", b"'shape'"),
    *(b"'descr'", b"'fortran_order'", b"(", b")", b",", b"-", b"**", b"\\", b"\n", b"L", b"\0", b"\xff"),
    *(b"\x93NUMPY", b"\x01\x00", b"\x02\x00", b"\x03\x00", b"\0" * 8, b"\xff" * 8, b"\0\0\0\0\0\0\xf0\x7f"),
)
ZIP_WORDS = (
    *(b"PK\x01\x02", b"PK\x03\x04", b"PK\x05\x06", b"PK\x06\x06", b"PK\x06\x07", b"PK\x07\x08", b"\x01\x00\x08\x00"),
    *(b"\0\0", b"\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\xff", b"\x01\0", b"\x08\0", b"\x0c\0", b"\x00\x08", b"\x14\0"),
    *(
        b"a.urdf",
        b"b.stl",
        b"../",
        b"/",
        b"\\",
        b":",
        b"\x1b",
        b"\xc3\xb6",
        b"up\x09\0",
        b"UT\x05\0",
        b"\x00\xa0\xff\xa1",
    ),
)


class Seeds(NamedTuple):
    """Inputs to start from.

    Attributes:
        good: Those that a reader takes.
        bad: Those that it refuses.
    """

    good: tuple[bytes, ...]
    bad: tuple[bytes, ...]


def descriptions() -> Seeds:
    """URDFs."""
    good = [*(case.text for case in urdf.VALID), *(case.text for case in urdf.ODD)]
    bad = [case.text for case in urdf.REFUSED]
    return _short(*([text.encode("utf-8", "surrogatepass") for text in texts] for texts in (good, bad)))


def tables() -> Seeds:
    """Bodies with a DH table."""
    bad = [dh.body(name="arm", dh=case.table) for case in dh.REFUSED_DH]
    return _short(
        [dh.GOOD_BODY, *(dh.body(name="arm", dh=table) for table in _good_tables())],
        [*bad, *(body for _, body in dh.REFUSED_JSON)],
    )


def _good_tables() -> Iterator[dict[str, object]]:
    """Such as have each field that a table may have."""
    yield dh.elbow(mimic={"joint": "shoulder", "multiplier": -0.5, "offset": 0.25})
    yield dh.elbow(mimic={"joint": "driver"}, type="prismatic", lower=-0.5, upper=0.5)
    yield {**dh.based(position=[0.5, 0, -1], zyz=[0.1, 0.2, 0.3]), "convention": "modified"}
    yield dh.table(tool={"matrix": [[0, -1, 0, 0.5], [1, 0, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]})
    for field, value in (("quaternion_wxyz", [0.6, 0.8, 0, 0]), ("rotation_vector", [1, 2, 3]), ("rpy", [3, 2, 1])):
        yield dh.based(position=[1, 2, 3], **{field: value})


def arrays() -> Seeds:
    """Bodies as npy; some of the bad ones are arrays, but no configurations of a robot."""
    bad = (*npy.NO_ARRAY, *npy.BAD_HEADERS, *npy.BAD_KINDS, *npy.BAD_SHAPES)
    good = [*(case.body for case in npy.GOOD_NPY), *(case.body for case in npy.WRONG_FOR_THE_CHAIN)]
    return _short(good, [case.body for case in bad])


def archives() -> Seeds:
    """Zips, but for the bombs."""
    good = [zips.good(), zips.good(c__obj=b"v 0 0 0\n" * 40, textures__png=bytes(64))]
    bad = (*zips.NO_ZIP, *zips.NO_ROBOT, *zips.BAD_PATHS, *zips.BAD_ENTRIES)
    return _short([*good, *(case.make() for case in zips.ODD_ZIPS)], [case.make() for case in bad])


def _short(good: Sequence[bytes], bad: Sequence[bytes]) -> Seeds:
    return Seeds(*(tuple(data for data in inputs if len(data) < _LONGEST) for inputs in (good, bad)))
