"""The examples on the two-link arm in the service's schema: their requests are written there, their answers made."""

import json
from collections.abc import Iterator
from typing import Any

from docs.handbook.operations import compact
from docs.handbook.session import service
from docs.handbook.written import same
from gelenk.client.call import Call
from gelenk.contract.endpoints import BY_NAME
from gelenk.http.messages.openapi import EXAMPLES


def made() -> dict[str, Any]:
    """The examples with every answer made anew; a job has none."""
    found: dict[str, Any] = json.loads(EXAMPLES.read_text(encoding="utf-8"))
    for key, example in found.items():
        name = key.partition("/")[0]
        if not BY_NAME[name].is_job:
            body = json.dumps(example["request"]).encode()
            call = Call("POST", f"v1/robots/planar_2r/{name}", lambda response: json.loads(response.content), body=body)
            example["answer"] = service().send(call)
    return found


def renew_examples(write: bool) -> Iterator[str]:
    """What is wrong with the file, in a sentence, unless it can be written."""
    examples = made()
    # Not as laid out: the length of a number, which decides over a new line, differs between processors.
    if same(json.dumps(json.loads(EXAMPLES.read_text(encoding="utf-8"))), json.dumps(examples)):
        return
    if write:
        EXAMPLES.write_text(compact(examples) + "\n", encoding="utf-8")
    else:
        yield f"{EXAMPLES.name} is not current: ./dev handbook --write"
