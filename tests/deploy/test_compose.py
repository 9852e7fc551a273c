"""The compositions name what there is, and say the same of the service as its other parts do."""

import re
from pathlib import Path
from typing import Any

import pytest

from gelenk.settings import Settings
from tests.deploy.monitoring import PROMETHEUS, read_yaml

ALONE, LAB = read_yaml(Path("compose.yaml")), read_yaml(Path("deploy/compose.lab.yaml"))
SERVICES: dict[str, dict[str, Any]] = {
    name: {**ALONE["services"].get(name, {}), **LAB["services"][name]} for name in LAB["services"]
}


def together() -> dict[str, str]:
    return {**ALONE["services"]["gelenk"]["environment"], **LAB["services"]["gelenk"]["environment"]}


def test_the_settings_are_taken() -> None:
    alone, lab = (
        Settings.from_environment(ALONE["services"]["gelenk"]["environment"]),
        Settings.from_environment(together()),
    )
    assert alone.open_access
    assert not lab.open_access
    assert lab.api_keys == "/run/secrets/keys"
    target = read_yaml(PROMETHEUS / "prometheus.yml")["scrape_configs"][0]["static_configs"][0]["targets"][0]
    assert target.split(":")[0] in lab.trusted_hosts
    assert target.split(":")[0] in SERVICES


def test_what_is_mounted_is_there() -> None:
    volumes = {*ALONE["volumes"], *LAB["volumes"]}
    for name, parts in SERVICES.items():
        for mount in parts["volumes"]:
            source = mount.split(":")[0]
            assert source in volumes or (source.startswith("./") and Path(source).is_dir()), (name, mount)
            assert source in volumes or mount.endswith(":ro")


def test_each_secret_is_one_that_the_ignored_folder_holds() -> None:
    ignored = Path(".gitignore").read_text(encoding="utf-8").splitlines()
    for name, secret in LAB["secrets"].items():
        assert secret["file"] == f"./deploy/secrets/{name}"
    assert "deploy/secrets/" in ignored
    assert {name for parts in SERVICES.values() for name in parts["secrets"]} == set(LAB["secrets"])


@pytest.mark.parametrize("name", SERVICES)
def test_every_part_is_bounded_and_has_no_rights(name: str) -> None:
    parts = SERVICES[name]
    assert parts["mem_limit"]
    assert parts["cpus"]
    assert parts["cap_drop"] == ["ALL"]
    assert parts["security_opt"] == ["no-new-privileges:true"]
    assert all(port.startswith("127.0.0.1:") for port in parts.get("ports", []))


def test_images_of_others_have_a_version() -> None:
    images = [parts["image"] for name, parts in SERVICES.items() if name != "gelenk"]
    assert all(re.fullmatch(r"[a-z]+/[a-z]+:v?\d+\.\d+\.\d+", image) for image in images), images


def test_the_service_is_healthy_when_it_is_ready() -> None:
    assert "/readyz" in SERVICES["gelenk"]["healthcheck"]["test"][-1]
    compile(SERVICES["gelenk"]["healthcheck"]["test"][-1], "healthcheck", "exec")
