"""The group of all commands: its options anywhere on the line, and each command loaded when it is called.

A command's module takes a good part of a second to load with all that it needs, and the list of commands needs none.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from itertools import islice
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperCommand, TyperGroup, TyperOption

if TYPE_CHECKING:
    from typer._click.core import Command, Context
    from typer._click.formatting import HelpFormatter

SUMMARIES = {
    "light.programs": {
        "serve": "Run the service: --host, --port, --workers; --help says more.",
        "keys": "Create an API key: NAME, --scopes, --file; --help says more.",
    },
    "robots": {
        "robots": "List the robots, or show one.",
        "add": "Add a robot to the service; without --server it is only checked.",
        "remove": "Remove an uploaded robot from the service.",
        "scenes": "Scenes of a service: what stands around a robot or hangs on it.",
    },
    "arms": {
        "fk": "Forward kinematics: the pose of the tip at each configuration.",
        "jacobian": "The Jacobian at each configuration: rows linear, then angular.",
        "ik": "Inverse kinematics: configurations that bring the tip to each target; exit code 1 if a target has none.",
        "manipulability": "How well the tip can move and push at each configuration.",
    },
    "motions": {
        "trajectory": "A motion through configurations and poses, joints first, or of a tool; "
        "exit code 1 if it cannot be completed.",
        "workspace": "What the tip can reach: points as CSV or npy, a summary otherwise.",
    },
    "homework": {
        "exercises": "List the exercises, or show one.",
        "sheet": "Write sheets for a class: HTML, or as --output ends: "
        ".html, .pdf, .csv (key), .xml (Moodle), .zip (all).",
        "grade": "Grade the answers of a class: points and mistakes as CSV. The secret must be that of the sheets.",
    },
    "bench": {
        "bench": "Measure how fast fk, jacobian and ik are answered, one by one and in batches: "
        "one caller, call after call.",
    },
    "ask": {
        "ask": "Any operation of the API, with its fields as JSON; the answer is JSON too.",
    },
    "tables": {"dh": "Denavit-Hartenberg tables: to and from URDF, compared, derived."},
    "jobs": {"jobs": "Jobs of a service: list, follow, read, cancel or remove them."},
}
"""First sentences of the commands, by module and name; a test compares them with those of the commands themselves."""
_MODULE_OF = {name: module for module, commands in SUMMARIES.items() for name in commands}


class _Loaded(Mapping[str, "Command"]):
    """The commands by name, each module loaded when one of its commands is asked for."""

    def __getitem__(self, name: str) -> "Command":
        return _of_module(_MODULE_OF[name])[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_MODULE_OF)

    def __len__(self) -> int:
        return len(_MODULE_OF)


@cache
def _of_module(module: str) -> Mapping[str, "Command"]:
    from gelenk.cli.session import example_of  # noqa: PLC0415 - as the commands, which need it themselves

    holder, found = typer.Typer(rich_markup_mode=None, add_completion=False), import_module(f"gelenk.cli.{module}")
    for name in SUMMARIES[module]:
        command = getattr(found, name)
        if isinstance(command, typer.Typer):
            holder.add_typer(command)
        else:
            settings = getattr(found, "SETTINGS", None)
            holder.command(name, epilog=example_of(name), context_settings=settings)(command)
    return typer.main.get_group(holder).commands


class Anywhere(TyperGroup):
    """A group of commands that takes its own options behind a command's name too."""

    def parse_args(self, ctx: "Context", args: list[str]) -> list[str]:
        """Read a line, the options of the group first, wherever they stand."""
        return super().parse_args(ctx, self._sorted(ctx, args))

    def _sorted(self, ctx: "Context", args: list[str]) -> list[str]:
        """Put the options of the group first; what follows `--`, or a command that passes all on, stays as it is."""
        options = {name: one for one in self.params if isinstance(one, TyperOption) for name in one.opts}
        own: list[str] = []
        rest: list[str] = []
        words, has_command = iter(args), False
        for word in words:
            if (option := options.get(_option_of(word))) is not None:
                own.append(word)
                if not option.is_flag and word == _option_of(word):
                    own += self._value(ctx, word, words)
                continue
            rest.append(word)
            command = None if has_command or word.startswith("-") else self.get_command(ctx, word)
            has_command = has_command or not word.startswith("-")
            if word == "--" or (command is not None and command.context_settings.get("ignore_unknown_options")):
                rest += words
        return own + rest

    def _value(self, ctx: "Context", word: str, words: Iterator[str]) -> list[str]:
        value = list(islice(words, 1))
        if not value and not ctx.resilient_parsing:
            ctx.fail(f"Option '{word}' requires an argument.")
        return value


class Commands(Anywhere):
    """The commands of `SUMMARIES`."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**{**settings, "commands": _Loaded()})

    def list_commands(self, ctx: "Context") -> list[str]:  # noqa: ARG002
        """Return the names of all commands."""
        return [*self.commands]

    def format_commands(self, ctx: "Context", formatter: "HelpFormatter") -> None:
        """Write names and summaries of all commands."""
        named = {name: text for commands in SUMMARIES.values() for name, text in commands.items()}
        listed: dict[str, Command] = {name: TyperCommand(name, help=text) for name, text in named.items()}
        TyperGroup(commands=listed).format_commands(ctx, formatter)


def _option_of(word: str) -> str:
    """Return the option that a word begins with, in `--name=value` and `-nvalue` too."""
    return word.partition("=")[0] if word.startswith("--") else word[:2]
