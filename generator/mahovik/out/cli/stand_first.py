"""The order of arguments: the stand first, everything else by options. Other positional orders still work.

A command that had another order takes further arguments, which its help does not show:

    def replay(stand_file=STAND_FILE_OR_NONE, further=FURTHER, log_file=needed_option("--log", ...)):
        stand_file, (log,) = stand_first(stand_file, further, {"--log": log_file}, former=("--log", STAND), least=1)
"""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from typing import Any, TypeVar

import click

from mahovik.out.cli.options import Parameter, file_option

STAND = "STAND.toml"
OptionalName = TypeVar("OptionalName", str, str | None)


class _HiddenArgument(click.Argument):
    """Arguments that the usage line does not show."""

    def get_usage_pieces(self, ctx: click.Context) -> list[str]:
        return []


FURTHER: Any = Parameter(_HiddenArgument, (), {"nargs": -1, "type": click.Path()})
"""Arguments after the first one: those of the former order."""


def needed_option(declaration: str, metavar: str, help: str) -> Any:
    """An option that is required, unless the arguments have the former order."""
    return file_option(declaration, metavar, f"{help}  [required]")


def stand_first(
    stand: OptionalName,
    further: tuple[str, ...],
    options: Mapping[str, str | None],
    *,
    former: tuple[str, ...],
    least: int | None = None,
) -> tuple[OptionalName, list[str]]:
    """The stand file and the values of `options`, in their order. Arguments in the former order are noted.

    former   names of the arguments in turn: names of `options`, and STAND
    least    how many of them were needed; default: all

    Raises click.UsageError if an option is missing, or an argument is too many.
    """
    given = tuple(each for each in (stand, *further) if each is not None)
    if all(value is None for value in options.values()):
        order = _order(given, former)
        if len(order) >= (least or len(former)) and order != (STAND,):
            values = dict(zip(order, given, strict=True))
            of_stand: Any = values.get(STAND)
            note_order(of_stand, {name: values.get(name) for name in options})
            return of_stand, [values[name] for name in options]
    context = click.get_current_context()
    missing = [name for name, value in options.items() if value is None]
    if further:
        instead = f", expected {missing[0]} {further[0]}" if missing else ""
        raise click.UsageError(f"Got unexpected extra argument ({' '.join(further)}){instead}.", context)
    if missing:
        raise click.UsageError(f"Missing option '{missing[0]}'.", context)
    return stand, [str(value) for value in options.values()]


def note_order(stand: str | None, options: Mapping[str, str | None]) -> None:
    """Say in one line on standard error how the same command is written now."""
    context: click.Context | None = click.get_current_context()
    names: list[str] = []
    while context is not None and context.parent is not None:
        names.insert(0, str(context.info_name))
        context = context.parent
    words = ["mahovik", *names, *(() if stand is None else (stand,))]
    words += [word for name, value in options.items() if value is not None for word in (name, value)]
    click.echo(f"note: arguments have a new order, from now on write: {shlex.join(words)} ...", err=True)


def _order(given: tuple[str, ...], former: tuple[str, ...]) -> tuple[str, ...]:
    """Names of the arguments in the former order, or in that with the stand first; empty if there are too many."""
    if len(given) > len(former):
        return ()
    if given and given[0].endswith(".toml"):
        former = (STAND, *(name for name in former if name != STAND))
    return former[: len(given)]
