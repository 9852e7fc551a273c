"""A page of the studio under test: what it does is asked of the page itself, and whatever it complains of is kept."""

import json
import os
import shutil
import time
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import quote

from playwright.sync_api import Browser, ConsoleMessage, Error, Locator, Page, Request, Response

from tests.test_serve import get

ARGUMENTS = [
    *("--no-sandbox", "--no-first-run", "--disable-quic", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
]
"""Chromium speaks to nobody else, and draws without a graphics card."""

_NAMES = ("chromium", "chromium-browser", "google-chrome")

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

    The studio keeps in the browser a key for a service that wants one, and what a person prefers, which is forgotten
    here; a test begins at an empty page.
    """

    def __init__(self, browser: Browser, *, is_certificate_checked: bool = True) -> None:
        self._context = browser.new_context(ignore_https_errors=not is_certificate_checked)
        self._context.add_init_script(_WATCH_POLICY)
        self._context.set_default_timeout(90_000)  # a busy machine draws slowly
        self._free: list[Page] = []

    def take(self) -> Page:
        """A page that shows nothing."""
        return self._free.pop() if self._free else self._context.new_page()

    def give_back(self, page: Page) -> None:
        """A page that a test has left, as it left it; one that no longer answers is not used again."""
        try:
            page.unroute_all(behavior="ignoreErrors")
            page.evaluate("() => { try { localStorage.clear() } catch { /* a page of no service has none */ } }")
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
        assert complaints == []
        assert set(self.refused) == self.expected

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

    def wait_for_robot(self, name: str | None) -> None:
        """Wait until a robot is drawn, and its meshes have come."""
        wanted = json.dumps(name)
        self.until(
            f"studio.store.value.model && studio.store.value.model.name === {wanted} && !studio.store.value.loading"
        )
        self.until("(({shown, failed, wanted}) => shown + failed.length >= wanted)(studio.store.value.model.meshes)")
        self.until("!studio.view || studio.view.canvas.dataset.drawn === studio.store.value.model.title")

    def run(self, expression: str, argument: Any = None) -> Any:
        """The value of an expression in the page; playwright's own waiting would need `unsafe-eval`."""
        return self.page.evaluate(expression, argument)

    def until(self, expression: str, seconds: float = 60.0) -> None:
        """Wait until an expression is true in the page."""
        deadline = time.monotonic() + seconds
        while not self.run(f"globalThis.studio !== undefined && Boolean({expression})"):
            assert time.monotonic() < deadline, f"never true: {expression}"
            time.sleep(0.02)

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
