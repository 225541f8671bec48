"""Common behaviour of commands: errors as lines, and suggestions for misspelt commands."""

from __future__ import annotations

import contextlib
import os
import sys
import warnings
from collections.abc import Iterable, Iterator
from typing import Any

import click

from mahovik.errors import MahovikError
from mahovik.nearest import suggestion
from mahovik.out.cli.output import CLOSED, INTERRUPTED, print_failure
from mahovik.out.functions.notices import MahovikWarning

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

    def __init__(self, *given: Any, **more: Any) -> None:
        super().__init__(*given, **more)
        self._sections: dict[str, list[str]] = {}

    def add_section(self, title: str, commands: Iterable[click.Command]) -> None:
        """Add commands, shown under this heading in the help."""
        for command in commands:
            self.add_command(command)
            assert command.name is not None
            self._sections.setdefault(title, []).append(command.name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Section by section, one line per command; no empty lines between, so that all fit on a screen."""
        if not self._sections:
            super().format_commands(ctx, formatter)
            return
        width = max(len(name) for name in self.commands)
        for title, names in self._sections.items():
            formatter.write_heading(title)
            formatter.indent()
            limit = formatter.width - width - 6
            formatter.write_dl([(n.ljust(width), self.commands[n].get_short_help_str(limit)) for n in names])
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
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if self.get_command(ctx, name) is None and not name.startswith("-"):
            ctx.fail(f'no such command "{name}"{suggestion(name, self.commands)}')
        return super().resolve_command(ctx, args)
