"""The studio's page and files as they are served: policy, caching, and nothing but the bundle."""

import gzip
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from gelenk.http.pages import STUDIO, STUDIO_POLICY


def test_the_page_and_all_that_it_loads_come_from_here(client: TestClient) -> None:
    page = client.get("/")
    assert page.headers["content-type"].startswith("text/html")
    links = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    assert {"studio/studio.js", "studio/studio.css", "studio/icon.svg", "docs"} <= set(links)
    for link in links:
        assert not link.startswith("/")  # relative: any path prefix will do
        assert client.get("/" + link).status_code == 200, link
    style = client.get("/studio/studio.css").text
    fonts = re.findall(r'url\("?\./([^)"]+)"?\)', style)
    assert len(fonts) == len({*fonts}) == 10
    for font in fonts:
        assert client.get(f"/studio/{font}").status_code == 200, font


def test_no_formula_asks_for_a_font_that_is_left_out() -> None:
    """The bundle has KaTeX's fonts of these commands, and of no other style: `UNUSED_FONTS` of its build."""
    root = STUDIO.parents[1]
    sources = [*(root / "gelenk").rglob("*.py"), *(root / "studio" / "src").rglob("*.ts")]
    styles = re.compile(r"\\((?:math|text)[a-z]+|(?:boldsymbol|bm|pmb|cal|frak|bf|it|tt)\b)")
    found = {name for path in sources for name in styles.findall(path.read_text("utf-8"))}
    assert found - {"textdegree"} == {"mathrm", "mathsf", "mathbb"}


@pytest.mark.parametrize("path", ["/", "/studio/studio.js", "/studio/studio.css", "/studio/LICENSES.txt"])
def test_the_policy_allows_nothing_inline_and_no_other_host(client: TestClient, path: str) -> None:
    headers = client.get(path).headers
    assert headers["content-security-policy"] == STUDIO_POLICY
    assert headers["x-content-type-options"] == "nosniff"
    assert "unsafe" not in STUDIO_POLICY
    assert "http" not in STUDIO_POLICY
    assert "*" not in STUDIO_POLICY


def test_nothing_in_the_page_is_inline(client: TestClient) -> None:
    text = client.get("/").text
    assert not re.search(r"<script(?![^>]*\ssrc=)|<style|\sstyle=|\son[a-z]+=", text)


def test_a_browser_asks_again_and_gets_no_second_copy(client: TestClient) -> None:
    for path in ("/", "/studio/studio.js"):
        first = client.get(path)
        assert first.headers["cache-control"] == "no-cache"
        again = client.get(path, headers={"If-None-Match": first.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")


@pytest.mark.parametrize("path", ["/", "/studio/studio.js", "/studio/studio.css", "/studio/icon.svg"])
def test_texts_are_compressed_for_who_takes_it(client: TestClient, path: str) -> None:
    plain = client.get(path, headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    packed = client.get(path, headers={"Accept-Encoding": "gzip"})
    assert packed.headers["content-encoding"] == "gzip"
    assert packed.content == plain.content  # decompressed by the client
    for answer in (plain, packed):
        assert answer.headers["vary"] == "Accept-Encoding"
        assert answer.headers["content-security-policy"] == STUDIO_POLICY
        assert answer.headers["content-type"] == plain.headers["content-type"]
    assert packed.headers["etag"] == f"W/{plain.headers['etag']}"
    for coding in ("gzip", "identity"):
        for tag in (plain.headers["etag"], packed.headers["etag"]):
            again = client.get(path, headers={"Accept-Encoding": coding, "If-None-Match": tag})
            assert (again.status_code, again.content) == (304, b"")


UNPACKED = """const {brotliDecompressSync} = require("node:zlib"), {readFileSync} = require("node:fs");
const same = (file) => brotliDecompressSync(readFileSync(`${file}.br`)).equals(readFileSync(file));
console.log(JSON.stringify(process.argv.slice(1).filter((file) => !same(file))));"""


def test_brotli_has_the_same_content(client: TestClient) -> None:
    """What the build left beside each text, read by Node; it is smaller than by gzip, and sent to who takes it."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("Node.js is not installed: nobody here reads Brotli")
    texts = [path for path in STUDIO.rglob("*") if path.suffix in {".css", ".html", ".js", ".svg", ".txt"}]
    assert len(texts) > 10
    made = subprocess.run([node, "--eval", UNPACKED, *map(str, texts)], capture_output=True, text=True, check=True)
    assert json.loads(made.stdout) == []
    script = STUDIO / "studio.js"
    with client.stream("GET", "/studio/studio.js", headers={"Accept-Encoding": "gzip, deflate, br"}) as answer:
        sent = b"".join(answer.iter_raw())
    assert answer.headers["content-encoding"] == "br"
    assert answer.headers["vary"] == "Accept-Encoding"
    assert answer.headers["content-type"] == client.get("/studio/studio.js").headers["content-type"]
    assert sent == Path(f"{script}.br").read_bytes()
    assert len(sent) < 0.95 * len(gzip.compress(script.read_bytes()))
    for refused in ("br;q=0, gzip", "gzip", "br;q=0.0,gzip;q=0.5"):
        with client.stream("GET", "/studio/studio.js", headers={"Accept-Encoding": refused}) as answer:
            assert answer.headers["content-encoding"] == "gzip", refused


def test_compressing_saves_what_it_is_for(client: TestClient) -> None:
    with client.stream("GET", "/studio/studio.js", headers={"Accept-Encoding": "gzip"}) as answer:
        sent = sum(map(len, answer.iter_raw()))
    assert sent == int(answer.headers["content-length"]) < (STUDIO / "studio.js").stat().st_size / 2


def test_a_part_of_a_file_is_one_of_the_file_as_it_is(client: TestClient) -> None:
    headers = {"Range": "bytes=10-19", "Accept-Encoding": "gzip"}
    part = client.get("/studio/studio.js", headers=headers)
    assert (part.status_code, part.content) == (206, (STUDIO / "studio.js").read_bytes()[10:20])
    assert "content-encoding" not in part.headers


def test_only_what_is_named_by_its_content_is_kept_for_good(client: TestClient) -> None:
    files = [path for folder in ("chunks", "fonts") for path in (STUDIO / folder).iterdir()]
    named = [path.relative_to(STUDIO) for path in files if path.suffix != ".br"]
    assert len(named) > 20
    for path in named:
        assert client.get(f"/studio/{path}").headers["cache-control"] == "public, max-age=31536000, immutable", path
    assert client.get("/studio/icon.svg").headers["cache-control"] == "no-cache"
    fonts = [path for path in named if path.suffix == ".woff2"]
    assert "content-encoding" not in client.get(f"/studio/{fonts[0]}").headers


def test_all_that_the_first_picture_needs_is_asked_for_at_once(client: TestClient) -> None:
    """What the script imports is named by the page too, and together it is no more than a megabyte."""
    named = set(re.findall(r'<link rel="modulepreload" href="studio/([^"]+)">', client.get("/").text))
    script = client.get("/studio/studio.js").text
    assert named == set(re.findall(r'from"\./(chunks/[^"]+)"', script))
    assert sum((STUDIO / name).stat().st_size for name in (*named, "studio.js")) < 1.1e6


def test_nothing_is_left_that_no_file_names() -> None:
    """What a page can come to load is named, with its hash, by what names the page's script in turn."""
    paths = [path for folder in ("chunks", "fonts") for path in (STUDIO / folder).iterdir() if path.suffix != ".br"]
    texts = [path.read_text() for path in STUDIO.rglob("*") if path.suffix in {".css", ".html", ".js"}]
    assert {path.name for path in paths if not any(path.name in text for text in texts)} == set()


@pytest.mark.parametrize(
    "path",
    ["../package.json", "%2e%2e/package.json", "..%2fsrc/main.ts", "src/main.ts", "nothing.js", "fonts", "", "%00"],
)
def test_nothing_else_is_served(client: TestClient, path: str) -> None:
    answer = client.get(f"/studio/{path}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


def test_the_bundle_names_its_licences() -> None:
    text = (STUDIO / "LICENSES.txt").read_text()
    for package in ("three", "urdf-loader", "katex"):
        assert re.search(rf"^{package} [\d.]+ \(", text, re.MULTILINE)
