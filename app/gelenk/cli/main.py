"""The command `gelenk`: its options, its commands, and its exit codes (`EXIT_CODES`)."""

import sys
import traceback
from http import HTTPStatus
from pathlib import Path
from typing import Annotated

import typer

import gelenk
from gelenk.cli.files.outputs import Format, Output, check_ending, check_place
from gelenk.cli.light.group import Commands
from gelenk.client.refusals import NotAnswering, Refused, UnknownKeyword
from gelenk.errors import InvalidInput, KinematicsError, NotFound

_ASKED_WRONG, _NO_SERVICE, _FAILED, _INTERRUPTED = 2, 3, 4, 130
EXIT_CODES = (
    "Exit codes: 0, success; 1, the answer is no (a target out of reach, a different robot, a motion that cannot be "
    "completed); 2, the request is invalid; 3, no service answers; 4, the service refuses the request (a key is "
    "missing, it is overloaded), or an error occurred; 130, Ctrl-C."
)
_WRONG_FILES = (FileNotFoundError, IsADirectoryError, NotADirectoryError, PermissionError)
_NO_FAULT_OF_THE_CALL = frozenset({HTTPStatus.UNAUTHORIZED, HTTPStatus.TOO_MANY_REQUESTS})

cli = typer.Typer(
    name="gelenk",
    cls=Commands,
    help="Robot kinematics in a shell: on a server with --server, otherwise in this process.",
    epilog=EXIT_CODES,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def _print_version(is_wanted: bool) -> None:
    if is_wanted:
        typer.echo(f"gelenk {gelenk.__version__}")
        raise typer.Exit


@cli.callback()
def options(
    context: typer.Context,
    server: Annotated[
        str | None,
        typer.Option(
            envvar="GELENK_SERVER",
            help="Use this service, with the key in GELENK_KEY. If left out, the command computes by itself.",
        ),
    ] = None,
    form: Annotated[
        Format | None, typer.Option("--format", "-f", help="Output format: text for people, the others for programs.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Write to this file; .json, .csv or .npy sets the format.")
    ] = None,
    arg: Annotated[list[str] | None, typer.Option(help="For xacro: NAME=VALUE.")] = None,
    package: Annotated[list[str] | None, typer.Option(help="For xacro: NAME=FOLDER of $(find NAME).")] = None,
    strict: Annotated[
        bool, typer.Option("--strict", help="Also refuse a URDF for faults that do not affect kinematics.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the answer: no notes, no progress.")] = False,
    version: Annotated[  # noqa: ARG001  (answered by its callback)
        bool, typer.Option("--version", help="Print the version.", callback=_print_version, is_eager=True)
    ] = False,
) -> None:
    """Read the options that all commands share; they may stand anywhere on the line."""
    from gelenk.cli.session import Session  # noqa: PLC0415 - as each command, but not --help

    if output is not None:
        check_place(output)
        if form is None:
            check_ending(output, context.invoked_subcommand or "")
    context.obj = Session(server, Output(form, output, quiet), arg or (), package or (), strict)


def main() -> None:
    """Run a command; on an error, print a sentence and exit with a code."""
    try:
        cli(prog_name="gelenk")
    except NotAnswering as error:
        _end(error.detail, _NO_SERVICE)
    except KinematicsError as error:
        wants_key = isinstance(error, Refused) and error.status == HTTPStatus.UNAUTHORIZED
        hint = " (gelenk sends the one in GELENK_KEY)" if wants_key else ""
        _end(error.detail + hint, _ASKED_WRONG if _is_the_callers(error) else _FAILED)
    except UnknownKeyword as error:
        _end(str(error), _ASKED_WRONG)
    except ModuleNotFoundError as error:
        if error.name == "gelenk" or str(error.name).startswith("gelenk."):
            raise
        _end(
            f"{error.name} is missing, which computing or serving here needs: install gelenk[server] "
            "(in a checkout: pip install '.[server]'), or name a service with --server",
            _NO_SERVICE,
        )
    except OSError as error:
        named = f"{error.filename}: {error.strerror}" if error.filename else error.strerror or str(error)
        _end(named, _ASKED_WRONG if isinstance(error, _WRONG_FILES) else _FAILED)
    except Exception as error:
        if "KeyboardInterrupt" in str(error):  # pydantic wraps one
            sys.exit(_INTERRUPTED)
        traceback.print_exc()
        _end("something went wrong in the command itself: see above", _FAILED)


def _is_the_callers(error: KinematicsError) -> bool:
    if isinstance(error, Refused):
        return 400 <= error.status < 500 and error.status not in _NO_FAULT_OF_THE_CALL
    return isinstance(error, InvalidInput | NotFound)


def _end(sentence: str, code: int) -> None:
    from rich.console import Console  # noqa: PLC0415 - few calls end like this

    Console(stderr=True).print(f"gelenk: {sentence}", markup=False, highlight=False, soft_wrap=True)
    sys.exit(code)


if __name__ == "__main__":
    main()
