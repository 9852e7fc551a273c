"""A page of the studio under test: what it does is asked of the page itself, and whatever it complains of is kept."""

import json
import os
import shutil
import time
from collections.abc import Sized
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import quote

from playwright.sync_api import Browser, ConsoleMessage, Error, Locator, Page, Request, Response, expect

from tests.test_serve import get

ARGUMENTS = [
    *("--no-sandbox", "--no-first-run", "--disable-quic", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    *("--disable-gpu-compositing", "--process-per-site"),
]
"""Chromium speaks to nobody else, and draws without a graphics card.

Only what a page draws with WebGL goes through the card's stand-in: whole pages through it cost half of all time. Pages
share a process, since a new one for each visit costs as much as the visit.
"""

PATIENCE = 200.0
"""How long whatever a test waits for may take, [s]: a busy machine draws slowly, a fresh tree compiles its kernels."""

expect.set_options(timeout=PATIENCE * 1000)

_NAMES = ("chromium", "chromium-browser", "google-chrome")

_FORGET = """() => {
  try {
    for (const kept of [localStorage, sessionStorage]) kept.clear();
  } catch { /* a page of no service has none */ }
  Storage.prototype.setItem = () => {};
}"""
"""The studio keeps its steps when it is left, at an address that the next test may open too."""

_WATCH_POLICY = """
globalThis.violations = [];
addEventListener("securitypolicyviolation", ({violatedDirective, blockedURI}) => {
  violations.push(`${violatedDirective} ${blockedURI}`);
});
"""


def chromium() -> str | None:
    """That of the variable CHROMIUM, which must be there, or one that is installed."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, _NAMES)), None)


class Pages:
    """Pages of one browser profile, each used by a test after the other: a new one costs several times its studio.

    The studio keeps in the browser a key for a service that wants one, what a person prefers, and steps to undo, which
    are forgotten here; a test begins at an empty page.
    """

    def __init__(self, browser: Browser, *, is_certificate_checked: bool = True) -> None:
        self._context = browser.new_context(ignore_https_errors=not is_certificate_checked)
        self._context.add_init_script(_WATCH_POLICY)
        self._context.set_default_timeout(PATIENCE * 1000)
        self._free: list[Page] = []

    def take(self) -> Page:
        """A page that shows nothing."""
        return self._free.pop() if self._free else self._context.new_page()

    def give_back(self, page: Page) -> None:
        """A page that a test has left, as it left it; one that no longer answers is not used again."""
        try:
            page.unroute_all(behavior="ignoreErrors")
            page.evaluate(_FORGET)
            page.goto("about:blank")
        except Error:
            page.close()
        else:
            self._free.append(page)


@dataclass
class Studio:
    """The studio of one test.

    Attributes:
        page: Playwright's page.
        url: Where the service is.
        complaints: Errors and warnings of the console, exceptions, requests to another host.
        refused: Statuses of the service's refusals, which the console reports by itself.
        expected: The statuses that it is to refuse something with.
    """

    page: Page
    url: str
    complaints: list[str] = field(default_factory=list)
    refused: list[int] = field(default_factory=list)
    expected: set[int] = field(default_factory=set)

    def begin(self, width: int = 1024, height: int = 640, scheme: Any = "light") -> None:
        """Listen, with nothing opened yet."""
        self.page.set_viewport_size({"width": width, "height": height})
        self.page.emulate_media(color_scheme=scheme)
        for event, listen in self._listeners():
            self.page.on(event, listen)

    def end(self) -> None:
        """Listen no more; the page may have complained of nothing, and been refused nothing but what was expected."""
        complaints = [*self.complaints, *self.run("globalThis.violations ?? []")]
        for event, listen in self._listeners():
            self.page.remove_listener(event, listen)
        assert complaints == [], complaints
        assert set(self.refused) == self.expected, self.refused

    def _listeners(self) -> list[tuple[Any, Any]]:
        return [("console", self._hear), ("pageerror", self._catch), ("request", self._see), ("response", self._note)]

    def open(self, panel: str = "pose", **address: str) -> None:
        """Open the page at a state, and wait for its robot."""
        self.go(
            "#"
            + "&".join(f"{key.replace('_', '-')}={quote(value)}" for key, value in {"panel": panel, **address}.items())
        )
        self.wait_for_robot(address.get("robot", None if "dh_table" in address else "panda"))

    def go(self, fragment: str) -> None:
        """Load the page anew at an address."""
        self.page.goto("about:blank")
        self.page.goto(f"{self.url}/{fragment}")

    def show(self, robot: str) -> None:
        """Another robot in the page as it is: in a fifth of the time that a new visit takes."""
        self.run("(robot) => { globalThis.before = studio.store.value.table; studio.store.set({robot}) }", robot)
        self.wait_for_robot(robot)
        self.until("!studio.store.value.dh || (studio.store.value.table && studio.store.value.table !== before)")

    def wait_for_robot(self, name: str | None) -> None:
        """Wait until a robot is drawn, and its meshes have come."""
        wanted = json.dumps(name)
        self.until(
            f"studio.store.value.model && studio.store.value.model.name === {wanted} && !studio.store.value.loading"
        )
        self.until("(({shown, failed, wanted}) => shown + failed.length >= wanted)(studio.store.value.model.meshes)")
        self.until("!studio.view || studio.view.canvas.dataset.drawn === studio.store.value.model.title")
        self.drawn()  # the last mesh has moved the camera

    def run(self, expression: str, argument: Any = None) -> Any:
        """The value of an expression in the page; playwright's own waiting would need `unsafe-eval`."""
        return self.page.evaluate(expression, argument)

    def until(self, expression: str) -> None:
        """Wait until an expression is true in the page: what it asks of may not be there yet, nor the page itself."""
        deadline = time.monotonic() + PATIENCE
        while (found := self._found(expression)) is not True:
            assert time.monotonic() < deadline, f"never true: {expression}, but {found}"
            time.sleep(0.02)

    def _found(self, expression: str) -> bool | str:
        """Whether an expression is true in the page as it is, or why that cannot be said."""
        asked = f"globalThis.studio !== undefined && Boolean({expression})"
        attempt = f"(() => {{ try {{ return {asked} }} catch (error) {{ return String(error) }} }})()"
        try:
            found: bool | str = self.run(attempt)
        except Error as error:
            if "context was destroyed" not in error.message:
                raise
            return error.message
        return found

    def hear(self, events: Sized, count: int = 1) -> None:
        """Wait until so many events have come to a list: Playwright hands them over while it is asked for something."""
        deadline = time.monotonic() + PATIENCE
        while len(events) < count:
            assert time.monotonic() < deadline, f"{len(events)} of {count} have come"
            self.run("1")

    def address(self) -> str:
        """The address, once it has followed the state: a timer of the page's own comes after those of before."""
        address: str = self.run("new Promise((done) => setTimeout(() => done(location.href), 300))")
        return address

    def drawn(self) -> None:
        """Wait until what has been asked for is drawn: a frame comes after those of before."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def typeset(self) -> None:
        """Wait for the fonts of what stands on the page: without them rows have other heights."""
        self.drawn()
        self.until("document.fonts.status === 'loaded'")

    def copied(self, button: Locator) -> str:
        """What a button puts into the clipboard, which it does in its own time."""
        self.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        self.run("navigator.clipboard.writeText('')")
        button.click()
        self.run("globalThis.copied = ''")
        self.until("(navigator.clipboard.readText().then((text) => { copied = text; }), copied)")
        text: str = self.run("copied")
        return text

    def state(self, key: str) -> Any:
        """A value of the page's state."""
        return self.run("(key) => studio.store.value[key]", key)

    def button(self, name: str) -> Locator:
        """A button by its very name."""
        return self.page.get_by_role("button", name=name, exact=True)

    def field(self, label: str) -> Locator:
        """A field by its very label."""
        return self.page.get_by_label(label, exact=True)

    def type(self, label: str, text: str) -> None:
        """Type into a field as a person does, and leave it by Enter."""
        self.field(label).fill(text)
        self.field(label).press("Enter")

    def tip(self) -> list[list[float]]:
        """T_base_tip as the Pose panel has it, to the last digit."""
        shown = self.page.locator("[data-matrix]").get_attribute("data-matrix")
        assert shown is not None
        matrix: list[list[float]] = json.loads(shown)
        return matrix

    def fk(self, robot: str, call: dict[str, Any]) -> Any:
        """What the service says, asked without the page."""
        status, answer = get(f"{self.url}/v1/robots/{robot}/fk", "POST", call)
        assert status == 200, answer
        return answer

    def _hear(self, message: ConsoleMessage) -> None:
        # Chromium reports every refusal of the service and what its software renderer finds slow, and the reader of
        # Collada what is odd about a file of the catalogue.
        if message.type not in {"error", "warning"} or "GPU stall due to ReadPixels" in message.text:
            return
        if message.type == "warning" and message.text.startswith("THREE.ColladaLoader"):
            return
        if not message.text.startswith("Failed to load resource: the server responded"):
            self.complaints.append(message.text)

    def _catch(self, error: Error) -> None:
        self.complaints.append(str(error))

    def _see(self, request: Request) -> None:
        if not request.url.startswith((f"{self.url}/", "about:", "blob:", "data:")):
            self.complaints.append(f"asked {request.url}")

    def _note(self, response: Response) -> None:
        if response.status >= 400:
            self.refused.append(response.status)
