"""Keys: made at random, kept as hashes, taken away while the service runs; what is no key opens nothing."""

import hmac
import logging
import stat
import string
import time
from pathlib import Path

import pytest

from gelenk import keys
from gelenk.contract.endpoint import Scope
from gelenk.http.access import keyring
from gelenk.http.access.keyring import InvalidKeys, Keyring, new_key, read_keys
from tests.http.access.asking import HOST, application, ask, bearer
from tests.test_faults import wait_for


def test_a_key_is_known_by_its_entry_which_does_not_hold_it() -> None:
    token, key = new_key("anna", [Scope.WRITE, Scope.READ])
    assert token.startswith("gelenk.anna.")
    assert key.entry().startswith("anna:read+write:")
    assert token.rpartition(".")[2] not in key.entry()
    assert Keyring(key.entry()).find(token) == key
    other_token, other = new_key("anna", [Scope.READ])
    assert (other_token, other.salt) != (token, key.salt)
    assert Keyring(other.entry()).find(token) is None


def test_no_near_miss_opens() -> None:
    token, key = new_key("anna", [Scope.READ])
    ring = Keyring(key.entry())
    alphabet = string.ascii_letters + string.digits + "-_"
    for i in range(len(token)):
        for letter in {alphabet[(alphabet.find(token[i]) + 1) % 64], "\n", "\0", "é"}:
            assert ring.find(token[:i] + letter + token[i + 1 :]) is None
    for wrong in ("", "gelenk", "gelenk.anna.", token[:-1], token + "A", token + "\n", token.upper(), key.entry()):
        assert ring.find(wrong) is None
    assert ring.find(token) is not None


def test_every_token_is_hashed_and_compared_in_constant_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether or not there is such a name: how long it takes tells nothing."""
    token, key = new_key("anna", [Scope.READ])
    ring = Keyring(key.entry())
    calls: list[tuple[int, int]] = []
    original = hmac.compare_digest

    def compare(one: bytes, other: bytes) -> bool:
        calls.append((len(one), len(other)))
        return bool(original(one, other))

    monkeypatch.setattr(hmac, "compare_digest", compare)
    for text in (token, token.replace("anna", "otto"), token[:-1], ""):
        ring.find(text)
    assert calls == [(32, 32)] * 4


def test_a_zero_digest_is_nobodys_key() -> None:
    """What an unknown name is compared with is the hash of nothing that can be sent."""
    ring = Keyring(f"anna:read:{'00' * 16}:{'00' * 32}")
    assert ring.find(f"gelenk.anna.{'A' * 43}") is None
    assert ring.find(f"gelenk.otto.{'A' * 43}") is None


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("secret", "entry 1 is not"),
        ("anna:read:00:00", "entry 1 is not"),
        (f"anna:root:{'0' * 32}:{'0' * 64}", "scope 'root'; there are read, write, teach, admin"),
        (f"anna:read:{'0' * 32}:{'0' * 64} anna:write:{'1' * 32}:{'0' * 64}", "entry 2: the name 'anna' appears twice"),
        (f"anna:read:{'0' * 32}:{'0' * 64}x", "entry 1 is not"),
    ],
)
def test_wrong_entries_are_refused_with_their_number_and_without_their_text(text: str, reason: str) -> None:
    with pytest.raises(InvalidKeys, match=reason):
        read_keys(text)
    with pytest.raises(InvalidKeys) as caught:
        read_keys("hunter2")
    assert "hunter2" not in str(caught.value)


def test_too_many_keys_are_refused() -> None:
    entries = [f"k{i}:read:{'0' * 32}:{'0' * 64}" for i in range(keyring.MAX_KEYS + 1)]
    assert len(read_keys(" ".join(entries[:-1]))) == keyring.MAX_KEYS
    with pytest.raises(InvalidKeys, match="1001 keys are more than the 1000 allowed"):
        read_keys(" ".join(entries))


def test_neither_entries_nor_a_file(tmp_path: Path) -> None:
    with pytest.raises(InvalidKeys, match="No such file"):
        Keyring(str(tmp_path / "none"))
    with pytest.raises(InvalidKeys, match="directory"):
        Keyring(str(tmp_path))
    (tmp_path / "empty").write_text("# nobody yet\n")
    with pytest.raises(InvalidKeys, match="holds no key"):
        Keyring(str(tmp_path / "empty"))
    (tmp_path / "large").write_text("#" * 600_000)
    with pytest.raises(InvalidKeys, match="larger"):
        Keyring(str(tmp_path / "large"))


def made(arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> tuple[str, str]:
    monkeypatch.setattr("sys.argv", ["keys", *arguments])
    keys.main()
    printed = capsys.readouterr()
    return printed.out.strip(), printed.err


def test_keys_are_made_used_and_taken_away(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "keys"
    anna, told = made(["anna", "--scopes", "read", "write", "--file", str(file)], monkeypatch, capsys)
    otto, _ = made(["otto", "--file", str(file)], monkeypatch, capsys)
    assert anna not in told
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert anna not in file.read_text()
    monkeypatch.setattr(keyring, "_LOOK_SECONDS", 0.0)
    app = application(data_dir=tmp_path, api_keys=str(file))

    def status(token: str) -> int:
        return ask(app, "/v1/robots", headers=(HOST, bearer(token))).status

    assert (status(anna), status(otto)) == (200, 200)
    lines = file.read_text().splitlines(keepends=True)
    file.write_text("# otto only\n" + lines[1])
    wait_for(lambda: status(anna) == 401)  # each call looks at the file, beside the event loop
    assert status(otto) == 200


@pytest.mark.slow
def test_a_key_that_was_taken_away_opens_nothing_after_a_quiet_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The very first request: nobody has looked at the file meanwhile."""
    monkeypatch.setattr(keyring, "_LOOK_SECONDS", 0.1)
    (token, gone), (_, stays) = new_key("anna", [Scope.READ]), new_key("otto", [Scope.READ])
    file = tmp_path / "keys"
    file.write_text(f"{gone.entry()}\n{stays.entry()}\n")
    app = application(data_dir=tmp_path, api_keys=str(file))
    assert ask(app, "/v1/robots", headers=(HOST, bearer(token))).status == 200
    file.write_text(f"{stays.entry()}\n")
    time.sleep(0.3)
    assert ask(app, "/v1/robots", headers=(HOST, bearer(token))).status == 401


def test_a_file_that_has_become_wrong_leaves_the_keys_as_they_were(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    token, key = new_key("anna", [Scope.READ])
    file = tmp_path / "keys"
    file.write_text(key.entry())
    monkeypatch.setattr(keyring, "_LOOK_SECONDS", 0.0)
    ring = Keyring(str(file))
    for break_it in (lambda: file.write_text("nonsense"), file.unlink):
        break_it()
        with caplog.at_level(logging.ERROR):
            ring.refresh()
        assert "the keys stay as they were" in caplog.text
        assert ring.find(token) == key
    file.write_text("")
    ring.refresh()
    assert ring.find(token) is None


def test_a_name_is_given_once_and_a_foreign_file_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "keys"
    made(["anna", "--file", str(file)], monkeypatch, capsys)
    for arguments, reason in (
        (["anna", "--file", str(file)], "has a key of 'anna' already"),
        (["anna:", "--file", str(file)], "a key's name is"),
        (["anna", "--file", str(tmp_path)], "directory"),
    ):
        with pytest.raises(SystemExit, match=reason):
            made(arguments, monkeypatch, capsys)
    notes = tmp_path / "notes"
    notes.write_text("dear diary")
    with pytest.raises(SystemExit, match="entry 1 is not"):
        made(["anna", "--file", str(notes)], monkeypatch, capsys)
    assert notes.read_text() == "dear diary"


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "authorization",
    [
        b"",
        b"Bearer",
        b"Bearer ",
        b"Basic Z2VsZW5rOmFubmE=",
        b"gelenk.anna",
        b"Bearer \xff\xfe",
        b"Bearer " + b"x" * 60_000,
    ],
)
def test_what_is_no_key_is_a_small_401(authorization: bytes) -> None:
    _, key = new_key("anna", [Scope.READ])
    app = application(api_keys=key.entry())
    answer = ask(app, "/v1/robots", headers=(HOST, (b"authorization", authorization)))
    assert answer.status == 401
    assert (answer.header("www-authenticate") or "").startswith('Bearer realm="gelenk"')
    assert len(answer.body) < 1024


def test_a_wrong_key_is_told_apart_from_none_and_never_repeated() -> None:
    token, _ = new_key("anna", [Scope.READ])
    _, other = new_key("otto", [Scope.READ])
    app = application(api_keys=other.entry())
    answer = ask(app, "/v1/robots", headers=(HOST, bearer(token)))
    assert answer.header("www-authenticate") == 'Bearer realm="gelenk", error="invalid_token"'
    assert token.encode() not in answer.body
