"""The small pictures of the catalogue's robots, which the studio draws: `python -m tests.studio.thumbnails [NAME …]`.

Each one is drawn on black and on white: what differs between the two is how much of the ground is seen through. They
are looked at by eye before they are committed; a robot without one gets a neutral picture.
"""

import base64
import io
import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from tests.studio.browser import ARGUMENTS, Pages, Studio, chromium
from tests.test_serve import get, service

FOLDER = Path(__file__).parents[2] / "app" / "studio" / "thumbnails"
JOINTS = FOLDER / "joints.json"
SIZE = (256, 192)
EDGE = 6  # pixels left free at each side
LARGEST = 4000  # bytes

_UR = [0.6, -1.3, 1.5, -1.8, -1.57, 0.0]
CONFIGURATIONS = {
    "planar_2r": [0.4, 0.9],
    "planar_3r": [0.4, 0.6, 0.6],
    "scara": [0.5, 0.9, 0.08, 0.0],
    "anthropomorphic": [0.5, 0.7, -1.1],
    "anthropomorphic_wrist": [0.5, 1.9, 0.5, 0.3, 0.8, 0.0],
    "puma560": [0.5, -0.8, 0.4, 0.2, 0.7, 0.0],
    "stanford": [0.5, -1.2, 0.5, 0.0, 0.6, 0.0],
    **{
        f"{name}{variant}": _UR
        for name in ("ur3", "ur3e", "ur5", "ur5e", "ur10", "ur10e")
        for variant in ("", "_dh", "_gripper", "_joint_limited")
    },
    **{name: [0.4, -0.3, 0.0, -2.0, 0.0, 1.9, 0.8] for name in ("panda", "panda_dh", "panda_collision")},
    **{name: [0.4, -0.3, 0.0, 1.2, 0.0, 1.4, 0.0] for name in ("xarm7", "xarm7_dh")},
}
"""Of the default chain, where the first one that the studio shows says little about the arm."""

ON_GROUND = """async (ground) => {
  const {view} = studio;
  for (const node of view.scene.children)
    if (!node.isLight && node !== studio.store.value.model.root) node.visible = false;
  view.scene.background.set(ground);
  const bytes = new Uint8Array(await (await view.picture()).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}"""


AT_REST = "studio.view.canvas.width === 2 * studio.view.canvas.clientWidth"


def drawn(studio: Studio, ground: str) -> np.ndarray:
    """The picture on a ground, (height, width, 3) within 0 and 1."""
    studio.until(AT_REST)  # software draws with smooth edges then
    png = base64.b64decode(studio.run(ON_GROUND, ground))
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=float) / 255


def cut_out(on_black: np.ndarray, on_white: np.ndarray) -> Image.Image:
    """The robot alone, as large as the size allows."""
    alpha = np.clip(1 - (on_white - on_black).mean(axis=2), 0, 1)
    colour = on_black / np.maximum(alpha, 1e-6)[..., None]
    pixels = np.dstack([np.clip(colour, 0, 1), alpha])
    seen = np.argwhere(alpha > 0.05)
    (top, left), (bottom, right) = seen.min(axis=0), seen.max(axis=0) + 1
    cut = Image.fromarray((pixels[top:bottom, left:right] * 255).round().astype(np.uint8), "RGBA")
    scale = min((SIZE[0] - 2 * EDGE) / cut.width, (SIZE[1] - 2 * EDGE) / cut.height)
    small = cut.resize((max(1, round(cut.width * scale)), max(1, round(cut.height * scale))), Image.Resampling.LANCZOS)
    picture = Image.new("RGBA", SIZE)
    picture.paste(small, ((SIZE[0] - small.width) // 2, (SIZE[1] - small.height) // 2))
    return picture


def packed(picture: Image.Image) -> bytes:
    """WebP of the best quality that stays small."""
    for quality in range(85, 0, -5):
        content = io.BytesIO()
        picture.save(content, "WEBP", quality=quality, alpha_quality=max(quality, 30), method=6)
        if content.tell() <= LARGEST:
            break
    return content.getvalue()


def main(wanted: list[str]) -> None:
    """Draw those that are named, or all of the catalogue; and count the joints of their chains."""
    FOLDER.mkdir(exist_ok=True)
    joints: dict[str, int] = json.loads(JOINTS.read_text("utf-8")) if JOINTS.exists() else {}
    with tempfile.TemporaryDirectory() as data, service(Path(data)) as (_, url), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        studio = Studio(Pages(browser).take(), url)
        studio.begin(512, 384)
        names = wanted or [robot["name"] for robot in get(f"{url}/v1/robots")[1]["robots"]]
        for name in names:
            joints[name] = len(get(f"{url}/v1/robots/{name}")[1]["joint_names"])
            q = CONFIGURATIONS.get(name)
            studio.go(f"embed#robot={name}" + (f"&q={','.join(map(str, q))}" if q else ""))
            try:
                studio.wait_for_robot(name)
            except AssertionError as error:
                print(name, "has no picture:", error, flush=True)
                continue
            (FOLDER / f"{name}.webp").write_bytes(packed(cut_out(drawn(studio, "#000"), drawn(studio, "#fff"))))
            print(name, (FOLDER / f"{name}.webp").stat().st_size, flush=True)
            JOINTS.write_text(json.dumps(dict(sorted(joints.items())), indent=1) + "\n", "utf-8")
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
