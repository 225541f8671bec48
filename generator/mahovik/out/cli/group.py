"""Common behaviour of commands: errors as lines, and suggestions for misspelt commands."""

from __future__ import annotations

import contextlib
import os
import sys
import warnings
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from itertools import chain
from typing import Any

import click

from mahovik.errors import MahovikError
from mahovik.nearest import suggestion
from mahovik.out.cli.output import CLOSED, INTERRUPTED, print_failure
from mahovik.out.notices import MahovikWarning

_MODULES = {"import": "import_model", "eval": "evaluate", "modes": "linear", "linearize": "linear"}
"""Modules of this folder that have another name than their command."""

INTERRUPTION = "error: interrupted; no file is half written"


@contextlib.contextmanager
def _closed_by_reader() -> Iterator[None]:
    """The end of a command whose reader has closed (`| head`): nothing more is printed, nor flushed at exit."""
    try:
        yield
    except BrokenPipeError:
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise SystemExit(CLOSED) from None


@contextlib.contextmanager
def _usage_in_a_line() -> Iterator[None]:
    """Wrong options and arguments as one line, like all bad input (click prints four). Help if nothing was given."""
    try:
        yield
    except click.exceptions.NoArgsIsHelpError:
        raise
    except click.UsageError as error:
        what = " ".join(error.format_message().split()).rstrip(".").replace(". Did you mean", ", did you mean")
        see = "" if error.ctx is None else f"; see {error.ctx.command_path} --help"
        click.echo(f"error: {what}{see}", err=True)
        raise SystemExit(error.exit_code) from None


@contextlib.contextmanager
def _warnings_as_lines() -> Iterator[None]:
    """Warnings of the functions of the Python interface, each a line on standard error."""
    with warnings.catch_warnings():
        others = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *more: Any, **named: Any) -> None:
            if issubclass(category, MahovikWarning):
                click.echo(f"warning: {message}", err=True)
            else:
                others(message, category, *more, **named)

        warnings.simplefilter("always", MahovikWarning)
        warnings.showwarning = show
        yield


class Commands(click.Group):
    """A group whose commands end in `error: ...` lines and an exit status; no traceback for a user's mistake."""

    def __init__(self, *given: Any, sections: Mapping[str, Sequence[str]] | None = None, **more: Any) -> None:
        """`sections`: names of commands by heading, whose modules are imported when a command is asked for."""
        super().__init__(*given, **more)
        self._sections = sections or {}

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Section by section, one line per command; no empty lines between, so that all fit on a screen."""
        if not self._sections:
            super().format_commands(ctx, formatter)
            return
        width = max(map(len, self.list_commands(ctx)))
        for title, names in self._sections.items():
            formatter.write_heading(title)
            formatter.indent()
            limit = formatter.width - width - 6
            commands = [(name, self.get_command(ctx, name)) for name in names]
            formatter.write_dl([(name.ljust(width), c.get_short_help_str(limit)) for name, c in commands if c])
            formatter.dedent()

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """If commands have sections, the options are in the usage line, and only the commands follow."""
        if self._sections:
            self.format_commands(ctx, formatter)
        else:
            super().format_options(ctx, formatter)

    def make_context(self, *given: Any, **more: Any) -> click.Context:
        """Overrides click: Ctrl-C exits with 130."""
        try:
            with _closed_by_reader(), _usage_in_a_line():
                return super().make_context(*given, **more)
        except KeyboardInterrupt:
            click.echo(INTERRUPTION, err=True)
            raise SystemExit(INTERRUPTED) from None

    def invoke(self, ctx: click.Context) -> Any:
        try:
            with _closed_by_reader(), _warnings_as_lines(), _usage_in_a_line():
                return super().invoke(ctx)
        except MahovikError as error:
            lines = str(error).splitlines() or [type(error).__name__]
            for line in lines:
                click.echo(f"error: {line}", err=True)
            if error.exit_status == 1:
                print_failure(ctx, lines)
            ctx.exit(error.exit_status)
        except KeyboardInterrupt:
            # a command that keeps its results so far prints its own message
            click.echo(INTERRUPTION, err=True)
            ctx.exit(INTERRUPTED)
        except OSError as error:
            where = f"{error.filename}: " if error.filename else ""
            click.echo(f"error: {where}{error.strerror or error}", err=True)
            ctx.exit(2)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Commands in the order of use."""
        return [*self.commands, *chain.from_iterable(self._sections.values())]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name, or None."""
        if cmd_name not in chain.from_iterable(self._sections.values()):
            return super().get_command(ctx, cmd_name)
        module = import_module(f"{__package__}.{_MODULES.get(cmd_name, cmd_name.replace('-', '_'))}")
        commands = (each for each in vars(module).values() if isinstance(each, click.Command))
        return next(each for each in commands if each.name == cmd_name)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if self.get_command(ctx, name) is None and not name.startswith("-"):
            ctx.fail(f'no such command "{name}"{suggestion(name, self.list_commands(ctx))}')
        return super().resolve_command(ctx, args)
