"""The table of all operations, which server, client, command line, workers and reference use.

It has the `ENDPOINT` of each module of this package that declares one, and the `resources`.
"""

import pkgutil
from importlib import import_module
from typing import Any, get_args

from gelenk import contract
from gelenk.contract.endpoint import Endpoint, Route, Tag
from gelenk.contract.resources import RESOURCES

_NAMES = [module.name for module in pkgutil.iter_modules(contract.__path__) if module.name != "endpoints"]
_MODULES = [import_module(f"{contract.__name__}.{name}") for name in _NAMES]
_TAGS = get_args(Tag)

ENDPOINTS: tuple[Endpoint[Any, Any], ...] = tuple(
    sorted(
        (module.ENDPOINT for module in _MODULES if hasattr(module, "ENDPOINT")),
        key=lambda endpoint: (_TAGS.index(endpoint.tag), endpoint.name),
    )
)
"""All operations with a request and an answer in JSON, sorted by tag and name."""
BY_NAME = {endpoint.name: endpoint for endpoint in ENDPOINTS}
ROUTES: dict[str, Route] = {route.id: route for route in (*RESOURCES, *ENDPOINTS)}
"""All operations of the API by their ids."""
