"""Options and arguments of commands, written once: as the defaults of the parameters of the command's function.

    @command()
    def modes(stand_file: str = STAND_FILE, name: str = option("--name", "Name the stand.")) -> None:

The name of a parameter is that of the value; the help shows the options in the order of the parameters.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.contract.functions import ALL, DEFAULT
from mahovik.errors import UsageError
from mahovik.nearest import names_in
from mahovik.out.cli import quantities
from mahovik.out.cli.output import note_json

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand


@dataclass(frozen=True)
class Parameter:
    """An option or argument of a command, without its name in Python."""

    make: Callable[..., click.Parameter]
    declarations: tuple[str, ...]
    attributes: dict[str, Any]


def command(
    name: str | None = None,
    *,
    short_help: str | None = None,
    group: click.Group | None = None,
    lines: Sequence[str] = (),
) -> Callable[[Callable[..., None]], click.Command]:
    """Make a command of a function whose parameters have options and arguments as defaults; its docstring is the help.

    The command is added to `group`; `lines` stand as they are at the end of its help.
    """

    def make_command(function: Callable[..., None]) -> click.Command:
        defaults = {key: each.default for key, each in inspect.signature(function).parameters.items()}
        params = [each.make([*each.declarations, key], **each.attributes) for key, each in defaults.items()]
        own, words = name or function.__name__.replace("_", "-"), inspect.getdoc(function)
        found = click.Command(
            own, callback=function, params=params, help=words, short_help=short_help, epilog=_as_is(lines)
        )
        if group is not None:
            group.add_command(found)
        return found

    return make_command


def _as_is(lines: Sequence[str]) -> str:
    """Text of which click folds no line."""
    return "\n".join(line or "\n\b" for line in ("", *lines))


def argument(metavar: str | None, *, reads: str | None = None, **attributes: Any) -> Any:
    """An argument: by default the path of a file; `reads`: what file, if it is not the stand's."""
    known: dict[str, Any] = {"metavar": metavar, "type": click.Path()}
    if reads is not None:
        known["callback"] = lambda _context, _own, path: _no_stand("", path, reads)
    return Parameter(click.Argument, (), known | attributes)


def option(
    declaration: str,
    help: str,
    *,
    parse: Callable[[str, str], object] | None = None,
    reads: str | None = None,
    **attributes: Any,
) -> Any:
    """An option; its default is shown. `help` is a sentence that begins with what the option does.

    parse  makes its value of the option's name and text
    reads  what file it reads, as "a regime file": a stand file in its place is refused by name
    """
    known: dict[str, Any] = {"help": help, "show_default": "default" in attributes}
    if reads is not None:
        known["callback"] = lambda _context, own, path: _no_stand(f"{own.opts[0]} ", path, reads)
    if parse is not None:
        known["callback"] = lambda _context, own, text: None if text is None else parse(own.opts[0], text)
    return Parameter(click.Option, (declaration,), known | attributes)


def flag(declaration: str, help: str, **attributes: Any) -> Any:
    """An option without a value."""
    return option(declaration, help, is_flag=True, **attributes)


def choice(declaration: str, values: Sequence[str], help: str, **attributes: Any) -> Any:
    """An option with one of some values."""
    return option(declaration, help, type=click.Choice(values), **attributes)


def file_option(declaration: str, metavar: str, help: str, **attributes: Any) -> Any:
    """An option that names a file or folder; where one of JSON is read, a name that ends in .toml is refused."""
    parse = _json_name if metavar.endswith(".json") and declaration != "-o" else None
    return option(declaration, help, parse=parse, metavar=metavar, type=click.Path(), **attributes)


def _json_name(name: str, path: str) -> str:
    if path.endswith(".toml"):
        raise UsageError(f"{name} {path}: expected a JSON file; the name is that of a TOML file, such as a stand")
    return path


def _no_stand(where: str, given: Any, expected: str) -> Any:
    """The path or paths given. Raises UsageError if one is that of a stand file.

    Readers of other files would list every key of it as unknown, and not say what the file is.
    """
    for path in (given,) if isinstance(given, str) else given or ():
        if path.endswith(".toml") and is_stand_file(Path(path)):
            raise UsageError(f"{where}{path}: this is a stand file, expected {expected}")
    return given


def is_stand_file(path: Path) -> bool:
    """Whether the file holds TOML with the keys that no other file of the project has together."""
    import tomllib

    try:
        if not path.is_file():  # of a FIFO the reader would find nothing more
            return False
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False  # the reader says what is wrong with it
    return "schema" in found and "carrier" in found


def json_option(help: str = "Print JSON instead of text.") -> Any:
    """The option `--json`."""
    return flag("--json", help, callback=note_json)


def whole_number(_context: click.Context, _option: click.Parameter, value: str | None) -> int | None:
    """Callback of a choice between numbers."""
    return None if value is None else int(value)


def names_of_functions(name: str, text: str) -> tuple[str, ...]:
    """Names of functions between commas, each once, or `all` or `list` alone. Raises UsageError."""
    return names_in(name, text, (*ALL, "list"))


STAND_FILE = argument("STAND.toml")
STAND_FILE_OR_NONE = argument("[STAND.toml]", required=False)
REAL = choice("--real", ["double", "float"], "Choose the element type of the C.", default="double")
ONLY = option(
    "--only",
    f"Write these public functions alone, and what they need, or all; default {', '.join(DEFAULT)}.",
    metavar="NAME,NAME|all",
    parse=names_of_functions,
)
WITH = option(
    "--with",
    "Add selftest, golden vectors; recorder, a log of flights; eva, proofs; batch, many states at once; encoder, "
    "phases of counts.",
    metavar="NAME,NAME",
    parse=names_in,
)
PREFIX = option(
    "--prefix", "Use this name in C instead of the one of the stand: two element types in one image.", metavar="NAME"
)
MOTION = file_option("--motion", "M.json", "Read the required motion from this file.", required=True)
SEED_OF_STARTS = option("--seed", "Draw the starts from this seed.", metavar="N", type=click.IntRange(min=0), default=0)
SEED_OF_STATES = option("--seed", "Draw the random states from this seed.", type=click.IntRange(0), default=1)
STATES = option("--states", "Evaluate this number of states.", type=click.IntRange(1, 1_000_000), default=200)
TIME_LIMIT = option("--time", "Limit the time of the search.", metavar="TIME", parse=quantities.time_limit)
JUNIT = file_option("--junit", "FILE", "Write the table as JUnit XML too.")
WORST = file_option("-o", "FILE", "Write the worst states, for `eval`; default: on failure only.")
PHASES = option("--phase", 'Set the phase at t = 0, "w1=90 deg"; default 0.', metavar="NAME=ANGLE", multiple=True)
JSON = json_option()


def load_stand(stand_file: str) -> Stand:
    """The stand of a file. Raises StandError."""
    from mahovik.core.stand import load

    return load(stand_file)


def is_given(name: str) -> bool:
    """Whether the user gave an option of the running command, by its name in Python."""
    source = click.get_current_context().get_parameter_source(name)
    return source not in (None, click.core.ParameterSource.DEFAULT)


def read_phases(stand: Stand, given: tuple[str, ...]) -> list[float]:
    """Phases (rad) by flywheel. Raises UsageError."""
    from mahovik.contract.quantities import BOUNDS
    from mahovik.core.stand.units import ANGLE, QuantityError, number
    from mahovik.nearest import suggestion

    names = [s.name for s in stand.flywheels]
    phi = [0.0] * len(names)
    for each in given:
        name, _, text = each.partition("=")
        if name not in names:
            raise UsageError(
                f'--phase {each}: unknown flywheel "{name}"{suggestion(name, names, "the stand has none")}'
            )
        try:
            phi[names.index(name)] = float(text)
        except ValueError:
            try:
                phi[names.index(name)] = number(text, ANGLE)
            except QuantityError as error:
                raise UsageError(f"--phase {each}: {error}") from None
        if not abs(phi[names.index(name)]) <= BOUNDS["MAX_PHASE"].value:
            raise UsageError(f"--phase {each}: out of range")
    return phi
