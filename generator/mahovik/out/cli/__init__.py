"""Commands that are not yet functions of `mahovik.out.commands`."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator
from importlib import import_module

import click

from mahovik.errors import MahovikError

OLD = {
    "Not yet functions": (
        *("new", "import", "verify", "judge", "cost", "evidence", "judge-log"),
        *("verify-programme",),
    )
}

_MODULES = {"import": "import_model"}


def old_command(name: str) -> click.Command:
    """The command of a name."""
    module = import_module(f"{__package__}.{_MODULES.get(name, name.replace('-', '_'))}")
    commands = (each for each in vars(module).values() if isinstance(each, click.Command))
    return next(each for each in commands if each.name == name)


@contextlib.contextmanager
def old_ends(ctx: click.Context) -> Iterator[None]:
    """Warnings as lines, and the reasons of a failed check as JSON."""
    from mahovik.out.cli.output import print_failure
    from mahovik.out.notices import MahovikWarning

    with warnings.catch_warnings():
        others = warnings.showwarning
        warnings.simplefilter("always", MahovikWarning)
        warnings.showwarning = lambda message, category, *more: (
            click.echo(f"warning: {message}", err=True)
            if issubclass(category, MahovikWarning)
            else others(message, category, *more)
        )
        try:
            yield
        except MahovikError as error:
            if error.exit_status == 1:
                print_failure(ctx, str(error).splitlines())
            raise
