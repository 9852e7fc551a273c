"""The keys of the service: created at random, stored as salted hashes, read from a file or the environment.

A key is 32 random bytes after its name, `gelenk.anna.…`. 256 bits cannot be guessed, so a slow hash would protect
nothing and cost time in each request. Salted BLAKE2b does not reveal the key either, and takes half a microsecond.
"""

import hashlib
import hmac
import logging
import re
import secrets
import time
from collections.abc import Collection, Mapping
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path

from gelenk.contract.endpoint import Scope

MAX_KEYS = 1000
_MAX_BYTES = 512 * 1024
_NAME = r"[A-Za-z0-9][A-Za-z0-9_-]{0,31}"
_ENTRY = re.compile(
    rf"(?P<name>{_NAME}):(?P<scopes>[a-z]+(\+[a-z]+)*):(?P<salt>[0-9a-f]{{32}}):(?P<digest>[0-9a-f]{{64}})"
)
_TOKEN = re.compile(rf"gelenk\.(?P<name>{_NAME})\.[A-Za-z0-9_-]{{43}}")
_COMMENT = re.compile(r"#[^\n]*")
_LOOK_SECONDS = 1.0
_PATIENCE = 0.5
"""Longest wait of a request while the key file is checked, [s]."""

logger = logging.getLogger("gelenk")


class InvalidKeys(Exception):
    """Raised for keys that cannot be accepted; the message says why."""


@dataclass(frozen=True, slots=True)
class Key:
    """A key as the service stores it: its owner's name, which appears in logs, and a salted hash instead of its text.

    `salt` is 16 random bytes, `digest` the BLAKE2b of the key under it, 32 bytes.
    """

    name: str
    scopes: frozenset[Scope]
    salt: bytes
    digest: bytes

    def entry(self) -> str:
        """Return the key as a line of a key file: name, scopes, salt and hash."""
        scopes = "+".join(scope for scope in Scope if scope in self.scopes)
        return f"{self.name}:{scopes}:{self.salt.hex()}:{self.digest.hex()}"


def new_key(name: str, scopes: Collection[Scope]) -> tuple[str, Key]:
    """Create a key; return the text that its owner sends, and what the service stores; raises InvalidKeys."""
    if not re.fullmatch(_NAME, name):
        raise InvalidKeys("a key's name is 1 to 32 letters, digits, '_' or '-', the first one a letter or digit")
    if not scopes:
        raise InvalidKeys(f"a key needs a scope; there are {', '.join(Scope)}")
    token, salt = f"gelenk.{name}.{secrets.token_urlsafe(32)}", secrets.token_bytes(16)
    return token, Key(name, frozenset(scopes), salt, _digest(salt, token))


def read_keys(text: str) -> dict[str, Key]:
    """Parse keys from entries separated by white space, and return them by name; `#` starts a comment.

    Raises InvalidKeys for an invalid entry (not quoted: it may be a secret), a name used twice, and too many keys.
    """
    keys: dict[str, Key] = {}
    for number, entry in enumerate(_COMMENT.sub("", text).split(), start=1):
        match = _ENTRY.fullmatch(entry)
        if match is None:
            raise InvalidKeys(f"entry {number} is not name:scopes:salt:hash, as `./dev keys` writes it")
        words = match["scopes"].split("+")
        if unknown := [word for word in words if word not in set(Scope)]:
            raise InvalidKeys(f"entry {number} has the scope '{unknown[0][:20]}'; there are {', '.join(Scope)}")
        if match["name"] in keys:
            raise InvalidKeys(f"entry {number}: the name '{match['name']}' appears twice")
        salt, digest = bytes.fromhex(match["salt"]), bytes.fromhex(match["digest"])
        keys[match["name"]] = Key(match["name"], frozenset(map(Scope, words)), salt, digest)
    if len(keys) > MAX_KEYS:
        raise InvalidKeys(f"{len(keys)} keys are more than the {MAX_KEYS} allowed")
    return keys


class Keyring:
    """The keys that are valid now: entries, or those of a file, which is read again when it has changed.

    Raises InvalidKeys if the setting is neither entries nor the path of a file, or holds no key.
    """

    def __init__(self, setting: str) -> None:
        self._file = None if _ENTRY.match(setting.strip()) else Path(setting).expanduser()
        self._stamp: tuple[int, int, int] | None = None
        self._looked = time.monotonic()
        self._beside = ThreadPoolExecutor(1, thread_name_prefix="keys")
        self._keys: Mapping[str, Key] = read_keys(setting) if self._file is None else self._read(self._file)
        if not self._keys:
            raise InvalidKeys(f"{setting} holds no key; `./dev keys` makes one")

    def find(self, token: str) -> Key | None:
        """Find the key of a caller's token, or None. A wrong token takes as long to check as a valid one."""
        match = _TOKEN.fullmatch(token)
        key = self._keys.get(match["name"]) if match else None
        digest = _digest(key.salt if key else bytes(16), token)
        return key if hmac.compare_digest(digest, key.digest if key else bytes(32)) else None

    def refresh_if_due(self) -> None:
        """Check the file again, at most once a second, in a thread: the file may be on a slow disk."""
        now, looked = time.monotonic(), self._looked
        if self._file is not None and now >= looked + _LOOK_SECONDS:
            self._looked = now
            refreshing = self._beside.submit(self.refresh)
            if now > looked + 2.0 * _LOOK_SECONDS:  # after a quiet time; a key may have been removed since
                wait((refreshing,), _PATIENCE)

    def refresh(self) -> None:
        """Read the file again if it has changed; if that fails, keep the present keys."""
        if self._file is None:
            return
        try:
            if _stamp(self._file) != self._stamp:
                self._keys = self._read(self._file)
                logger.warning("%d keys read again", len(self._keys))
        except (InvalidKeys, OSError) as error:
            logger.error("the keys stay as they were: %s", error)

    def _read(self, file: Path) -> dict[str, Key]:
        try:
            stamp = _stamp(file)
            with file.open(encoding="utf-8", errors="replace") as stream:
                text = stream.read(_MAX_BYTES + 1)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or "not the name of a file"
            raise InvalidKeys(f"neither entries nor a file that can be read ({reason})") from None
        if len(text) > _MAX_BYTES:
            raise InvalidKeys(f"the file is larger than {_MAX_BYTES} bytes")
        keys = read_keys(text)
        self._stamp = stamp
        return keys


def _digest(salt: bytes, token: str) -> bytes:
    return hashlib.blake2b(token.encode("utf-8", "surrogatepass"), key=salt, digest_size=32).digest()


def _stamp(file: Path) -> tuple[int, int, int]:
    found = file.stat()
    return found.st_mtime_ns, found.st_size, found.st_ino
