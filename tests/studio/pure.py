"""Functions of the studio that need no page, called from a test."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

_STUDIO = Path(__file__).parents[2] / "app" / "studio"
_BUNDLER = _STUDIO / "node_modules" / ".bin" / "esbuild"


def values(module: str, expressions: list[str]) -> list[Any]:
    """Values of JavaScript expressions in the names that a module of `src/` exports; undefined is null."""
    node = shutil.which("node")
    if node is None or not _BUNDLER.exists():
        pytest.skip("the studio's tools are not there: ./dev studio installs them")
    listed = ", ".join(f"(({expression}) ?? null)" for expression in expressions)
    source = f"import * as module from './src/{module}';\nconst m = module;\nconsole.log(JSON.stringify([{listed}]));"
    bundle = [str(_BUNDLER), "--bundle", "--format=esm", "--platform=node", "--loader=ts"]
    made = subprocess.run(bundle, input=source, cwd=_STUDIO, capture_output=True, text=True, check=True)
    command = [node, "--input-type=module"]
    ran = subprocess.run(command, input=made.stdout, capture_output=True, text=True, check=True)
    found: list[Any] = json.loads(ran.stdout)
    return found
