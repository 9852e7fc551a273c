"""Archives to be refused, `REFUSED_ZIPS`, and odd ones to be taken, `ODD_ZIPS`.

Each is the good archive, one URDF and one mesh, with one thing changed. They are made when asked for: some are large
once they are unpacked. `word` is one that the lower-cased message has to contain to be of use.
"""

import struct
import zipfile
import zlib
from collections.abc import Callable
from functools import partial
from io import BytesIO
from typing import NamedTuple

MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="arm"><link name="a"/></xacro:macro>
</robot>"""
URDF = """<robot name="arm">
  <link name="base"/>
  <link name="arm"><visual><geometry><mesh filename="package://arm_description/meshes/arm.stl"/></geometry></visual></link>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/>
  </joint>
</robot>"""
LINK = 0o120777 << 16
"""Attributes of a symbolic link."""
_CENTRAL = b"PK\x01\x02"
_LOCAL = b"PK\x03\x04"
_END = b"PK\x05\x06"


class RefusedZip(NamedTuple):
    """An archive that is no robot, or that does harm."""

    name: str
    make: Callable[[], bytes]
    word: str
    status: int = 422


class OddZip(NamedTuple):
    """An archive to be taken."""

    name: str
    make: Callable[[], bytes]


def zipped(files: dict[str, str | bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    """An archive as Python writes it."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()


def good(**more: str | bytes) -> bytes:
    """The good archive, and further files: `notes__txt` is notes.txt."""
    return zipped({"a.urdf": URDF, "b.stl": b"x", **{name.replace("__", "."): text for name, text in more.items()}})


def with_file(name: str, content: str | bytes = b"x") -> bytes:
    """The good archive and one more file, of a name that Python's own writer would change."""
    if not name.isascii():
        return zipped({"a.urdf": URDF, name: content})
    stand_in = "~" * len(name)
    return zipped({"a.urdf": URDF, stand_in: content}).replace(stand_in.encode(), name.encode())


def with_entry(content: bytes = b"x", **attributes: int) -> bytes:
    """The good archive and one more file with these attributes."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("a.urdf", URDF)
        entry = zipfile.ZipInfo("b.stl")
        for name, value in attributes.items():
            setattr(entry, name, value)
        archive.writestr(entry, content)
    return buffer.getvalue()


def changed(offset: int, form: str, value: int, signature: bytes = _CENTRAL) -> bytes:
    """The good archive with another value in the last record of a kind."""
    content = bytearray(good())
    struct.pack_into(form, content, content.rfind(signature) + offset, value)
    return bytes(content)


def flagged(bit: int) -> bytes:
    """A zip whose list of entries says something special of the last one."""
    content = bytearray(good())
    content[content.rfind(_CENTRAL) + 8] |= bit
    return bytes(content)


def nameless() -> bytes:
    """A zip whose last entry has no name in the list of entries; what was one is its comment."""
    content = bytearray(good())
    start = content.rfind(_CENTRAL)
    struct.pack_into("<3H", content, start + 28, 0, 0, len("b.stl"))
    return bytes(content)


def overlapping(shift: int = 0) -> bytes:
    """A zip whose second entry points into the first one's bytes."""
    content = bytearray(good())
    first, second = content.find(_CENTRAL), content.rfind(_CENTRAL)
    (start,) = struct.unpack_from("<L", content, first + 42)
    struct.pack_into("<L", content, second + 42, start + shift)
    return bytes(content)


def quoted_overlap(count: int) -> bytes:
    """Entries that each hold all later ones, headers included, and so the same compressed megabyte of zeros.

    A stored block of deflate goes round each header, so that to the entry before it is data like any other. This is
    how the known bombs of a few megabytes hold terabytes; no two entries start at the same place.
    """
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    plain = bytes(1_000_000)
    packed = packer.compress(plain) + packer.flush()
    entries: list[bytes] = []
    step = 0
    for number in reversed(range(count)):
        name = b"%04d.stl" % number
        sizes = struct.pack("<3L2H", zlib.crc32(plain), len(packed), len(plain), len(name), 0)
        header = struct.pack("<4s5H", _LOCAL, 20, 0, 8, 0, 0) + sizes + name
        step = len(header) + 5
        place = struct.pack("<3H2L", 0, 0, 0, 0, number * step)
        entries.insert(0, struct.pack("<4s6H", _CENTRAL, 20, 20, 0, 8, 0, 0) + sizes + place + name)
        packed = b"\0" + struct.pack("<2H", len(header), len(header) ^ 0xFFFF) + header + packed
        plain = header + plain
    files, urdf = packed[5:], zipped({"a.urdf": URDF})
    start, end = urdf.find(_CENTRAL), urdf.find(_END)
    last = bytearray(urdf[start:end])
    struct.pack_into("<L", last, 42, len(files))
    directory = b"".join(entries) + last
    content = files + urdf[:start]
    return (
        content + directory + struct.pack("<4s4H2LH", _END, 0, 0, count + 1, count + 1, len(directory), len(content), 0)
    )


def bomb(megabytes: int, files: int = 1) -> bytes:
    """A small archive of much: nothing but zeros, in equal shares."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.urdf", URDF)
        for number in range(files):
            with archive.open(f"{number}.stl", "w") as sink:
                for _ in range(megabytes // files):
                    sink.write(bytes(1024 * 1024))
    return buffer.getvalue()


def lying_bomb() -> bytes:
    """A bomb that says of itself that it holds one byte."""
    content = bytearray(bomb(300))
    struct.pack_into("<L", content, content.rfind(_CENTRAL) + 24, 1)
    return bytes(content)


def without_urdf_of_size(size: int) -> bytes:
    """A description that grows beyond what is allowed only when it is unpacked."""
    return zipped({"a.urdf": b"<robot " + bytes(size)})


def nested() -> bytes:
    """A zip in a zip in a zip, and no description outside."""
    content = good()
    for _ in range(3):
        content = zipped({"robot.zip": content})
    return content


def many(count: int) -> bytes:
    """Empty files in great number."""
    return zipped({"a.urdf": URDF, **{f"{i}.stl": b"" for i in range(count)}})


def many_folders() -> bytes:
    """A megabyte of empty files, each at the end of 95 folders of its own."""
    return zipped({"a.urdf": URDF, **{f"{number}/" + "m/" * 94 + "b.stl": b"" for number in range(1999)}})


def long_directory() -> bytes:
    """A list of entries that is longer than that of any robot: each entry has a comment of 60,000 bytes."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("a.urdf", URDF)
        for number in range(20):
            entry = zipfile.ZipInfo(f"{number}.stl")
            entry.comment = bytes(60_000)
            archive.writestr(entry, b"")
    return buffer.getvalue()


def counting_wrong(count: int) -> bytes:
    """An end record that gives another number of entries."""
    content = bytearray(many(2500) if count < 2500 else good())
    end = content.rfind(_END)
    struct.pack_into("<2H", content, end + 8, count, count)
    return bytes(content)


def zip64() -> bytes:
    """The format for archives beyond 4 GB, which nobody needs for a robot."""
    content = good()
    end = content.rfind(_END)
    record = struct.pack("<4sQ2H2L4Q", b"PK\x06\x06", 44, 45, 45, 0, 0, 2, 2, end - content.find(_CENTRAL), 0)
    return content[:end] + record + struct.pack("<4sLQL", b"PK\x06\x07", 0, end, 1) + content[end:]


def extra_field(kind: int, data: bytes, length: int) -> bytes:
    """A further field in the last entry of the list, of this length by its own word."""
    content = good()
    start, end = content.rfind(_CENTRAL), content.rfind(_END)
    field = struct.pack("<2H", kind, length) + data
    entry = bytearray(content[start:end] + field)
    struct.pack_into("<H", entry, 30, len(field))
    tail = bytearray(content[end:])
    (length,) = struct.unpack_from("<L", tail, 12)
    struct.pack_into("<L", tail, 12, length + len(field))
    return content[:start] + bytes(entry) + bytes(tail)


NO_ZIP = (
    *(
        RefusedZip(name, partial(bytes, content), "zip")
        for name, content in (
            ("empty", b""),
            ("a local header and nothing", b"PK\x03\x04 and nothing"),
            ("an end record alone, cut", b"PK\x05\x06"),
            ("a URDF", URDF.encode()),
            ("a tar", b"a.urdf" + bytes(94) + b"0000644" + bytes(411) + URDF.encode()),
            ("a gzip", b"\x1f\x8b\x08" + bytes(100)),
            ("cut at its end", zipped({"a.urdf": URDF})[:-30]),
            ("its end alone", zipped({"a.urdf": URDF})[-22:]),
        )
    ),
    RefusedZip("a list of entries that begins behind its end", partial(changed, 16, "<L", 1 << 30, _END), "overlap"),
    RefusedZip("a list of entries that is longer than all", partial(changed, 12, "<L", 1 << 19, _END), "zip"),
    RefusedZip("a list of entries somewhere else", partial(changed, 16, "<L", 3, _END), "overlap"),
    RefusedZip("a list of entries without a signature", partial(changed, 0, "<L", 0), "zip"),
    RefusedZip("an extra field that is cut", partial(extra_field, 1, b"\0", 8), "zip"),
    RefusedZip("format beyond 4 GB", zip64, "4 gb"),
    RefusedZip("of 65,535 entries by its own word", partial(counting_wrong, 65_535), "65535", 413),
)
"""Not an archive, or broken where its list of entries is."""

NO_ROBOT = (
    RefusedZip("nothing in it", partial(zipped, {}), "no description"),
    RefusedZip("no description", partial(zipped, {"a.stl": "x"}), "no description"),
    RefusedZip("two descriptions", partial(zipped, {"a.urdf": URDF, "b.urdf": URDF}), "name one"),
    RefusedZip("two descriptions in capitals", partial(zipped, {"a.urdf": URDF, "b.URDF": URDF}), "name one"),
    RefusedZip("the same description twice", partial(with_file, "a.urdf", URDF), "twice"),
    RefusedZip("a folder that is called a description", partial(zipped, {"a.urdf/": ""}), "no description"),
    RefusedZip("a zip in a zip in a zip", nested, "no description"),
    RefusedZip("xacro macros alone", partial(zipped, {"a.xacro": MACROS}), "no description"),
    RefusedZip("a description of no text", partial(zipped, {"a.urdf": b"\xff\xfe"}), "utf-8"),
    RefusedZip("a description that is empty", partial(zipped, {"a.urdf": b""}), "xml"),
    RefusedZip("a description of a ball joint", partial(zipped, {"a.urdf": URDF.replace("revolute", "ball")}), "ball"),
    RefusedZip("a description with a NUL", partial(zipped, {"a.urdf": URDF + "\0"}), "nul"),
    RefusedZip(
        "a description with entities",
        partial(zipped, {"a.urdf": '<!DOCTYPE r [<!ENTITY e SYSTEM "b.stl">]>' + URDF}),
        "dtd",
    ),
)
"""An archive, but not of one robot."""

BAD_PATHS = (
    *(
        RefusedZip(f"path {name}", partial(with_file, path), word)
        for name, path, word in (
            ("absolute", "/b.stl", "inside"),
            ("upwards", "../b.stl", "inside"),
            ("upwards in its middle", "m/../../b.stl", "inside"),
            ("upwards at its end", "m/..", "inside"),
            ("with backslashes", "..\\b.stl", "inside"),
            ("with a drive", "C:/b.stl", "inside"),
            ("with a stream of a file", "b.stl:x", "inside"),
            ("of a share", "\\\\host\\b.stl", "inside"),
            ("an address", "file:///b.stl", "inside"),
            ("with an empty part", "m//b.stl", "inside"),
            ("with a dot for a part", "m/./b.stl", "inside"),
            ("of 300 characters", "x" * 300 + ".stl", "characters"),
            ("of 304 bytes", "ä" * 150 + ".stl", "bytes"),
            ("of many folders", "m/" * 110 + "b.stl", "characters"),
            ("of 17 folders", "m/" * 17 + "b.stl", "17 folders"),
            ("with a newline", "b\n.stl", "printable"),
            ("with an escape sequence", "\x1b[31mb.stl", "printable"),
            ("with a mark that turns text round", "b\u202elts.exe.stl", "printable"),
            ("with a delete", "b\x7f.stl", "printable"),
            ("with a next line of C1", "b\x85.stl", "printable"),
        )
    ),
    RefusedZip("path of the description upwards", partial(zipped, {"../a.urdf": URDF}), "inside"),
    RefusedZip("path of the description absolute", partial(zipped, {"/a.urdf": URDF}), "inside"),
    RefusedZip("the same path twice", partial(zipped, {"a.urdf": URDF, "b.stl": "x", "B.STL": "x"}), "twice"),
    RefusedZip("a file that is a folder too", partial(good, **{"b__stl/n__stl": "x"}), "folder"),
    RefusedZip("an empty path", nameless, "inside"),
)
"""Every path stays inside, is printable, and stands there once."""

BAD_ENTRIES = (
    RefusedZip("a link", partial(with_entry, b"/etc/passwd", external_attr=LINK), "link"),
    RefusedZip("a pipe", partial(with_entry, external_attr=0o010644 << 16), "file"),
    RefusedZip("a device", partial(with_entry, external_attr=0o020644 << 16), "file"),
    RefusedZip("a socket", partial(with_entry, external_attr=0o140644 << 16), "file"),
    RefusedZip("encrypted", partial(flagged, 0x01), "encrypted"),
    RefusedZip("strongly encrypted", partial(flagged, 0x40), "unpacked"),
    RefusedZip("a patch", partial(flagged, 0x20), "unpacked"),
    *(
        RefusedZip(f"compressed by method {method}", partial(changed, 10, "<H", method), "compression")
        for method in (1, 6, 9, 12, 14, 93, 95, 99, 65_535)
    ),
    RefusedZip("compressed with bzip2", partial(zipped, {"a.urdf": URDF}, zipfile.ZIP_BZIP2), "compression"),
    RefusedZip("compressed with LZMA", partial(zipped, {"a.urdf": URDF}, zipfile.ZIP_LZMA), "compression"),
    RefusedZip("a wrong checksum", partial(changed, 16, "<L", 1), "unpacked"),
    RefusedZip("another name in its own header", partial(changed, 30, "B", ord("c"), _LOCAL), "unpacked"),
    RefusedZip("no header of its own", partial(changed, 0, "<L", 0, _LOCAL), "unpacked"),
    RefusedZip("fewer packed bytes than it says", partial(changed, 20, "<L", 1 << 20), "overlap"),
    RefusedZip("more packed bytes than it says", partial(changed, 20, "<L", 0), "unpacked"),
    RefusedZip("more bytes than it says", partial(changed, 24, "<L", 0), "unpacked"),
    RefusedZip("beyond the end of the archive", partial(changed, 42, "<L", 1 << 30), ""),
    RefusedZip("a name in UTF-8 that is none", lambda: flagged(0).replace(b"b.stl", b"\xff.stl"), ""),
)
"""An entry is a plain file, stored or deflated, and what its header says."""

BOMBS = (
    RefusedZip("300 MB of zeros", partial(bomb, 300), "268435456", 413),
    RefusedZip("300 MB of zeros in 300 files", partial(bomb, 300, 300), "268435456", 413),
    RefusedZip("300 MB that say that they are one byte", lying_bomb, "unpacked"),
    RefusedZip("a description of 3 MB", partial(without_urdf_of_size, 3_000_000), "2097152", 413),
    RefusedZip("2,001 meshes", partial(many, 2001), "2000", 413),
    RefusedZip("1,999 meshes below 95 folders each", many_folders, "95 folders"),
    RefusedZip("2,501 entries that say they are two", partial(counting_wrong, 2), "2000", 413),
    RefusedZip("a list of entries of a megabyte", long_directory, "list of entries", 413),
    RefusedZip("an entry on another", overlapping, "overlap"),
    RefusedZip("an entry a byte into another", partial(overlapping, 1), "overlap"),
    RefusedZip("200 entries, each within the one before", partial(quoted_overlap, 200), "overlap"),
)
"""Small until they are unpacked."""

REFUSED_ZIPS: tuple[RefusedZip, ...] = (*NO_ZIP, *NO_ROBOT, *BAD_PATHS, *BAD_ENTRIES, *BOMBS)

ODD_ZIPS: tuple[OddZip, ...] = (
    OddZip("with bytes before it", lambda: b"#!/bin/sh\n" + good()),
    OddZip("with a comment", lambda: good()[:-2] + b"\x05\x00hello"),
    OddZip("with folders", partial(zipped, {"arm/": "", "arm/a.urdf": URDF, "arm/m/": "", "arm/m/b.stl": "x"})),
    OddZip("with other files", partial(good, notes__txt="x", setup__py="import os", bomb__zip=b"PK")),
    OddZip("stored", partial(zipped, {"a.urdf": URDF}, zipfile.ZIP_STORED)),
    OddZip("with a file 16 folders deep", partial(with_file, "m/" * 16 + "b.stl")),
    OddZip("with names outside ASCII", partial(zipped, {"å.urdf": URDF, "ß/ö.stl": "x"})),
    OddZip("on another disk", partial(changed, 34, "<H", 7)),
    OddZip("with sizes of 64 bits that nobody needs", partial(extra_field, 1, b"\xff" * 8, 8)),
    OddZip("with an extra field of its time", partial(extra_field, 0x5455, b"\0" * 5, 5)),
)
"""Unusual and harmless."""
