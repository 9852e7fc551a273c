"""Settings come from the environment; a misspelt or impossible one is refused before anything starts."""

from pathlib import Path

import pytest

from app.settings import InvalidSetting, Settings


def test_defaults_and_values() -> None:
    assert Settings.from_environment({"HOME": "x"}).max_body_bytes == 64 * 1024 * 1024
    settings = Settings.from_environment(
        {
            "GELENK_DATA_DIR": "data",
            "GELENK_ROOT_PATH": "/gelenk/",
            "GELENK_MAX_BODY_BYTES": "1000",
            "GELENK_THREADS": "3",
        }
    )
    assert settings.data_dir == Path("data")
    assert settings.root_path == "/gelenk"
    assert (settings.max_body_bytes, settings.threads) == (1000, 3)


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("GELENK_DATADIR", "x"),
        ("GELENK_API_KEYS", "secret"),
        ("GELENK_MAX_BODY_BYTES", "0"),
        ("GELENK_MAX_BODY_BYTES", "-1"),
        ("GELENK_MAX_BODY_BYTES", "64M"),
        ("GELENK_ROOT_PATH", "gelenk"),
    ],
)
def test_what_cannot_be_taken_is_refused_by_name(variable: str, value: str) -> None:
    with pytest.raises(InvalidSetting, match=variable):
        Settings.from_environment({variable: value})
