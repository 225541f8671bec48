"""The command line, made of the functions of `mahovik.out.commands`.

A command is a typed function in a module of its name, and a line in `out.commands.COMMANDS`:

    @command(needs={"speed": ("steps",)})
    def modes(
        stand: StandGiven,
        *,
        at: FileGiven = "rest",
        speed: Turning | None = None,
        progress: Progressing = None,
    ) -> Result:
        '''Find natural frequencies, damping and shapes.

        Args:
            at: state to linearise about, as `eval` reads it, or rest.
            speed: speed of a flywheel, rad/s or with a unit.
        '''

Arguments before the star have no name on the command line, those behind it are options, `output` is `-o`. Of the type,
bool is a flag, Literal a choice, a union with Sequence or Mapping may be repeated (NAME=VALUE makes a mapping), one
with float makes numbers of texts that are one; `Annotated` has the word for the value. `out.arguments` has types,
readers of files, and quantities with units. An argument `progress` is shown as a line. All checks stand in the
function: messages name an argument as their first word, or as `NAME=VALUE`, and the command line writes the option.
Heavy modules are imported in the function, so that help is there at once. The command line adds `--json`, and `-o FILE`
where the function has no `output`; it prints the `Result`, and exits with 0 if it is `ok`, else 1. Errors are one line
on standard error: 2 input, 1 a failed check, 130 Ctrl-C.
"""

from __future__ import annotations

import contextlib
import dataclasses
import inspect
import json
import os
import re
import sys
import typing
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib import import_module
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik import __version__
from mahovik.contract.evaluation import text_of_help
from mahovik.errors import MahovikError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.commands import COMMANDS
from mahovik.signatures import HIDDEN, alternatives, kinds_of

if TYPE_CHECKING:
    from mahovik.out.result import Result

INTERRUPTED, CLOSED = 130, 141
"""Exit status after Ctrl-C, and where the reader of standard output has closed it: as in shells."""

WHOLE, MOST = "no file is half written", 20
"""What is said of files after Ctrl-C; most problems of a file that are printed, of which people mend some at a time."""


# ---- a command of a function


def make_command(name: str) -> click.Command:
    """The command of a name in `COMMANDS`."""
    function = getattr(import_module(f"mahovik.out.commands.{name}"), name)
    words, entries = read_docstring(function)
    kinds = kinds_of(function)
    parameters = inspect.signature(function).parameters
    made = {key: _parameter(one, *kinds[key], entries.get(key, "")) for key, one in parameters.items()}
    params = [one for one in made.values() if one is not None]
    if name != "eval":  # which prints lines itself, as they come, so that a program can hold a conversation
        if "output" not in made:
            formats = "Write the result to this file: .csv, .json, .parquet, .svg or .png."
            params.append(click.Option(["-o", "save"], metavar="FILE", help=formats))
        params.append(click.Option(["--json", "as_json"], is_flag=True, help="Print JSON in place of tables."))
    epilog = text_of_help() if name in ("eval", "judge") else None
    return _Command(name, callback=partial(_run, function), params=params, help=words, epilog=epilog)


def read_docstring(function: Callable[..., Any]) -> tuple[str, dict[str, str]]:
    """What a function does, with indented lines kept as they are, and the entries of its arguments by name."""
    text, _, rest = (inspect.getdoc(function) or "").partition("\nArgs:\n")
    entries: dict[str, str] = {}
    for line in rest.partition("\n\n")[0].splitlines():
        if match := re.fullmatch(r"    (\w+): (.*)", line):
            name = match[1]
            entries[name] = match[2]
        elif entries:
            entries[name] += f" {line.strip()}"
    entries = {key: f"{words[0].upper()}{words[1:]}" for key, words in entries.items()}
    return re.sub(r"\n\n(?= )", "\n\n\b\n", text.partition("\nRaises:\n")[0].rstrip()), entries


class _Command(click.Command):
    """A command whose options that may be repeated take several values behind one name, too: `--free A B`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        repeated = {name for one in self.params if isinstance(one, click.Option) and one.multiple for name in one.opts}
        single = {name for one in self.params if isinstance(one, click.Option) and not one.is_flag for name in one.opts}
        arguments, result, last = len([one for one in self.params if isinstance(one, click.Argument)]), [], ""
        for k, word in enumerate(args):
            before = args[k - 1] if k else ""
            if word.startswith("-") or before in single:  # an option, or the value of one
                last = before if before in repeated else "" if word.startswith("-") else last
            elif arguments:
                arguments, last = arguments - 1, ""
            elif last:
                result.append(last)
            result.append(word)
        return super().parse_args(ctx, result)


def _parameter(one: inspect.Parameter, word: str, kinds: Sequence[Any], words: str) -> click.Parameter | None:
    """The argument or option of a parameter; None for what the command line itself gives."""
    required = one.default is one.empty
    if word == HIDDEN:
        return None
    if one.kind is one.POSITIONAL_OR_KEYWORD and one.name != "output":
        return click.Argument([one.name], required=required, metavar=f"{word}" if required else f"[{word}]")
    origins = {typing.get_origin(kind) or kind for kind in kinds}
    shown: dict[str, Any] = {"help": words, "required": required}
    if one.default not in (None, (), "", one.empty) and one.default is not False:
        shown |= {"default": one.default, "show_default": True}
    declarations = [option_name(one.name), one.name]
    if bool in origins:
        return click.Option(declarations, is_flag=True, help=words)
    if typing.Literal in origins:
        choices = [value for kind in kinds for value in typing.get_args(kind)]
        return click.Option(declarations, type=_Choice(choices), **shown)
    repeated = bool(origins & {Sequence, Mapping, list, dict}) and word not in ("FILE", "STAND.toml", "NAME,NAME")
    known = [inner for kind in kinds for part in (kind, *typing.get_args(kind)) for inner in alternatives(part)[1]]
    numbers: list[type] = [kind for kind in (int, float) if kind in known]
    shown |= {"metavar": word or ("N" if int in numbers else "NUMBER" if numbers else "TEXT"), "multiple": repeated}
    read = partial(_value, numbers, repeated, Mapping in origins)
    return click.Option(declarations, type=click.UNPROCESSED, callback=read, **shown)


def option_name(name: str) -> str:
    """How a parameter is written on the command line."""
    return "-o" if name == "output" else f"--{name.rstrip('_').replace('_', '-')}"


class _Choice(click.Choice[Any]):
    """Choices that the function checks, which names the argument."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        return next((choice for choice in self.choices if str(choice) == str(value)), value)


def _value(numbers: list[type], repeated: bool, mapping: bool, _: Any, option: click.Parameter, value: Any) -> Any:
    """What a function gets for the text or the texts of an option."""

    def read(text: Any) -> Any:
        for kind in numbers:
            with contextlib.suppress(ValueError):
                return kind(text)
        return text

    if not repeated or not isinstance(value, tuple):
        return read(value) if isinstance(value, str) else value
    pairs = [text.partition("=") for text in value]
    if mapping and pairs and all(equals for _, equals, _ in pairs):
        result = {name.strip(): read(text.strip()) for name, _, text in pairs}
        if len(result) < len(pairs):
            raise UsageError(f"{option.opts[0]}: a name is given twice")
        return result
    return [read(text) for text in value] if len(value) != 1 else read(value[0])


# ---- running it


def _run(function: Callable[..., Any], as_json: bool | None = None, save: str | None = None, **values: Any) -> None:
    """Call a function with what was given, print and save its result, and exit with its verdict."""
    parameters = inspect.signature(function).parameters
    arguments = {key: value for key, value in values.items() if value not in (None, [], ())}
    if save is not None:
        from mahovik.out.arguments import output_format

        texts = chain.from_iterable(x if isinstance(x, list | tuple) else [x] for x in arguments.values())
        words = [word for word in texts if isinstance(word, str)]
        output_format("-o", save, [*words, *(word.partition("=")[2] for word in words)])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        try:
            if "progress" in parameters:
                from mahovik.out.notices import progress

                with progress(f"{function.__name__} {Path(str(next(iter(arguments.values()), ''))).stem}") as show:
                    result = function(**arguments, progress=show)
            else:
                result = function(**arguments)
        except MahovikError as error:
            first = isinstance(error, UsageError)
            lines = [_with_options(line, parameters, first) for line in str(error).splitlines()]
            error.args = ("\n".join(lines), *error.args[1:])
            if as_json and error.exit_status == 1:
                click.echo(json.dumps({"error": lines}, indent=1))
            raise
        finally:
            said = [
                f"warning: {_with_options(words, parameters)}"
                for words in dict.fromkeys(str(x.message) for x in caught)
            ]
            for line in said:
                click.echo(line, err=True)
    result = dataclasses.replace(result, messages=[_with_options(line, parameters) for line in result.messages])
    if save is not None:
        result.save(save)
    if as_json is not None:
        _print(result, as_json, said)
    if result.meta.get("interrupted"):
        click.echo("interrupted: these are the results so far", err=True)
        raise SystemExit(INTERRUPTED)
    raise SystemExit(0 if result.ok else 1)


def _print(result: Result, as_json: bool, said: Sequence[str]) -> None:
    """Print a result: JSON, or tables that narrow terminals fold, with colours on a terminal, without what was said."""
    if as_json:
        click.echo(result.to_json())
        return
    result = dataclasses.replace(result, messages=[line for line in result.messages if line not in said])
    terminal = sys.stdout.isatty()
    without = os.environ.get("NO_COLOR") or os.environ.get("TERM", "").lower() in ("dumb", "unknown")
    styles = not without and bool(terminal or os.environ.get("FORCE_COLOR"))
    width = os.get_terminal_size(sys.stdout.fileno()).columns if terminal else None
    text = result.text(width, styles)
    encoding = sys.stdout.encoding or "utf-8"
    click.echo(text.encode(encoding, "replace").decode(encoding), nl=False, color=styles)


def _with_options(message: str, parameters: Mapping[str, inspect.Parameter], first: bool = False) -> str:
    """A message with options in place of arguments: `NAME=VALUE` anywhere in it, and of an error the `first` words."""
    made = {one.name: one for one in click.get_current_context().command.params}

    def option(name: str) -> str:
        one = made.get(name)
        return str(one.metavar).strip("[]") if isinstance(one, click.Argument) else option_name(name)

    def value(match: re.Match[str]) -> str:
        if isinstance(made.get(match[1]), click.Argument):
            return match[2]
        return f"{option(match[1])}{'' if match[2] == 'True' else f' {match[2]}'}"

    begin = message.partition(":")[0]
    names = begin.split(", ") if ", " in begin else [begin.partition(" ")[0]]
    if first and all(name in parameters for name in names):
        message = f"{', '.join(map(option, names))}{message[len(', '.join(names)) :]}"
    return re.sub(rf"(?<![^ ])({'|'.join(parameters)})=([^ ,;:]+)", value, message)


def _usage_words(error: click.UsageError) -> str:
    """What click found, in the words of other messages: the option, what was found, what was expected."""
    if isinstance(error, click.NoSuchOption):
        params = [] if error.ctx is None else error.ctx.command.params
        known = [name for one in params if isinstance(one, click.Option) for name in one.opts]
        return f"no such option {error.option_name}{suggestion(error.option_name, known)}"
    if isinstance(error, click.BadOptionUsage):
        return f"{error.option_name}: {'takes no value' if 'does not' in error.message else 'its value is missing'}"
    if error.ctx is not None and (extra := re.search(r"extra arguments? \((.*)\)", error.message)):
        return f"{extra[1]}: more than the arguments of the command"
    param = getattr(error, "param", None)
    words = " ".join(error.format_message().split()).rstrip(".").replace(". Did you mean", ", did you mean")
    if param is None:
        return words
    name = param.metavar if isinstance(param, click.Argument) else param.opts[0]
    return f"{name}: missing" if isinstance(error, click.MissingParameter) else words


# ---- all of them


@contextlib.contextmanager
def _ends() -> Iterator[None]:
    """Ends of a command other than a result, each a line on standard error and an exit status."""
    try:
        yield
    except BrokenPipeError:  # whoever reads has closed: nothing more is printed, nor flushed at exit
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise SystemExit(CLOSED) from None
    except click.exceptions.NoArgsIsHelpError:
        raise
    except click.UsageError as error:
        see = "" if error.ctx is None else f"; see {error.ctx.command_path} --help"
        click.echo(f"error: {_usage_words(error)}{see}", err=True)
        raise SystemExit(error.exit_code) from None
    except MahovikError as error:
        lines = str(error).splitlines() or [type(error).__name__]
        more = [f"{len(lines) - MOST} more problems, shown when these are mended"] if len(lines) > MOST else []
        for line in [*lines[:MOST], *more]:
            click.echo(f"error: {line}", err=True)
        raise SystemExit(error.exit_status) from None
    except (KeyboardInterrupt, click.Abort) as interrupt:
        click.echo(f"error: interrupted; {str(interrupt) or WHOLE}", err=True)
        raise SystemExit(INTERRUPTED) from None
    except OSError as error:
        from tempfile import gettempdir

        where = error.filename or f"standard output or the folder of temporary files, {gettempdir()}"
        click.echo(f"error: {where}: {error.strerror or error}", err=True)
        raise SystemExit(2) from None


class _Commands(click.Group):
    """The group, whose commands are made when they are asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(chain.from_iterable(COMMANDS.values()))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        return make_command(cmd_name) if cmd_name in self.list_commands(ctx) else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args[0] not in (names := self.list_commands(ctx)) and not args[0].startswith("-"):
            ctx.fail(f'no such command "{args[0]}"{suggestion(args[0], names)}')
        return super().resolve_command(ctx, args)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Commands under their headings; the options are in the usage line."""
        width = max(map(len, self.list_commands(ctx)))
        for title, commands in COMMANDS.items():
            formatter.write_heading(title)
            formatter.indent()
            formatter.write_dl([(name.ljust(width), words) for name, words in commands.items()])
            formatter.dedent()

    def make_context(self, *args: Any, **more: Any) -> click.Context:
        with _ends():
            return super().make_context(*args, **more)

    def invoke(self, ctx: click.Context) -> Any:
        with _ends():
            return super().invoke(ctx)


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    options_metavar="[-h | --version]",
    subcommand_metavar="COMMAND ...",
)
@click.version_option(__version__, prog_name="mahovik")
def main() -> None:
    """\b
    Verified C of carriers with unbalanced flywheels; try: mahovik new bench8
    Exit status: 0 good, 1 a check failed, 2 bad input or usage, 130 Ctrl-C.
    """
