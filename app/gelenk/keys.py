"""Make a key: `gelenk keys NAME`, in a checkout `./dev keys NAME`.

The key is shown once; the service keeps only a hash to check it by.
"""

import argparse
import os
import sys
from pathlib import Path

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import InvalidKeys, Key, new_key, read_keys


def main() -> None:
    """Parse the arguments, and create the key."""
    parser = argparse.ArgumentParser(
        prog=sys.argv[0] if sys.argv[0] == "gelenk keys" else "./dev keys", description=__doc__
    )
    parser.add_argument("name", help="owner of the key, as named in the logs")
    parser.add_argument(
        "--scopes", nargs="+", default=[Scope.READ], type=Scope, choices=list(Scope), help="default: read"
    )
    parser.add_argument("--file", type=Path, help="file to add it to, the one in GELENK_API_KEYS; created if missing")
    arguments = parser.parse_args()
    try:
        token, key = new_key(arguments.name, arguments.scopes)
        if arguments.file is not None:
            add(key, arguments.file)
    except InvalidKeys as error:
        sys.exit(str(error))
    except OSError as error:
        sys.exit(f"{arguments.file}: {error.strerror}")
    print(token)
    where = f"its entry was added to {arguments.file}" if arguments.file else f"its entry: {key.entry()}"
    print(f"The key of {key.name} is shown above, only once; {where}", file=sys.stderr)


def add(key: Key, file: Path) -> None:
    """Add a key to a file, perhaps a new one, which only its owner can read; raises InvalidKeys or OSError."""
    descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o600)
    with open(descriptor, "r+", encoding="utf-8") as stream:  # noqa: PTH123 - a descriptor
        text = stream.read()
        if key.name in read_keys(text):
            raise InvalidKeys(f"{file} has a key of '{key.name}' already: choose another name, or remove its line")
        stream.write(("" if not text or text.endswith("\n") else "\n") + key.entry() + "\n")


if __name__ == "__main__":
    main()
