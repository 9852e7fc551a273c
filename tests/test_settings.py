"""Settings come from the environment; a misspelt or impossible one is refused before anything starts."""

from pathlib import Path

import pytest

from gelenk.settings import InvalidSetting, Settings


def test_defaults_and_values() -> None:
    assert Settings.from_environment({"HOME": "x"}).max_body_bytes == 64 * 1024 * 1024
    settings = Settings.from_environment(
        {
            "GELENK_DATA_DIR": "data",
            "GELENK_ROOT_PATH": "/gelenk/",
            "GELENK_MAX_BODY_BYTES": "1000",
            "GELENK_CREW_PROCESSES": "3",
        }
    )
    assert settings.data_dir == Path("data")
    assert settings.root_path == "/gelenk"
    assert (settings.max_body_bytes, settings.crew_processes) == (1000, 3)


def test_settings_of_several_values() -> None:
    settings = Settings.from_environment(
        {
            "GELENK_TRUSTED_HOSTS": "Lab.example.org, *.example.net [fe80::1]",
            "GELENK_ALLOWED_ORIGINS": "https://lab.example.org:8443,http://[::1]:5173",
            "GELENK_TRUSTED_PROXIES": "10.0.0.5,fd00::/8",
            "GELENK_FRAME_ANCESTORS": "http://localhost:8888",
            "GELENK_OPEN_ACCESS": "yes",
        }
    )
    assert settings.trusted_hosts == ("lab.example.org", "*.example.net", "[fe80::1]")
    assert settings.allowed_origins == ("https://lab.example.org:8443", "http://[::1]:5173")
    assert settings.trusted_proxies == ("10.0.0.5", "fd00::/8")
    assert settings.frame_ancestors == ("http://localhost:8888",)
    assert settings.open_access


@pytest.mark.quick(6)
@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("GELENK_DATADIR", "x"),
        ("GELENK_API_KEYS", ""),
        ("GELENK_OPEN_ACCESS", "true"),
        ("GELENK_TRUSTED_HOSTS", "lab.example.org:8000"),
        ("GELENK_TRUSTED_HOSTS", "lab*.example.org"),
        ("GELENK_ALLOWED_ORIGINS", "lab.example.org"),
        ("GELENK_ALLOWED_ORIGINS", "https://lab.example.org/"),
        ("GELENK_FRAME_ANCESTORS", "'self'"),
        ("GELENK_TRUSTED_PROXIES", "proxy"),
        ("GELENK_LOG_LEVEL", "loud"),
        ("GELENK_OTLP_ENDPOINT", "collector:4318"),
        ("GELENK_MAX_BODY_BYTES", "0"),
        ("GELENK_MAX_BODY_BYTES", "-1"),
        ("GELENK_MAX_BODY_BYTES", "64M"),
        ("GELENK_ROOT_PATH", "gelenk"),
    ],
)
def test_what_cannot_be_taken_is_refused_by_name(variable: str, value: str) -> None:
    with pytest.raises(InvalidSetting, match=variable):
        Settings.from_environment({variable: value})
