"""`--json`: one document on standard output and nothing else there, also if a check fails.

Keys are the names and units of the rest of the project: SI, and the same order for the same input.

Keys are the names and units of the rest of the project: SI, and the same order for the same input.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import click

Command = TypeVar("Command", bound=Callable[..., Any] | click.Command)

_ASKED, _PRINTED = "mahovik.json", "mahovik.json.printed"


def json_option(words: str = "Print JSON.") -> Callable[[Command], Command]:
    """The option, as `as_json`."""
    return click.option("--json", "as_json", is_flag=True, callback=_note, help=words)


def print_json(values: Any) -> None:
    """Print the document of the running command: plain data and NumPy's; null for what is not finite."""
    print_json_text(json.dumps(_plain(values), indent=1, allow_nan=False))


def print_json_text(text: str) -> None:
    """Print a text that is already JSON."""
    click.echo(text.rstrip("\n"))
    click.get_current_context().meta[_PRINTED] = True


def print_failure(ctx: click.Context, lines: list[str]) -> None:
    """Print the reasons as JSON if --json was given and nothing was printed, so that a program gets one document."""
    if ctx.meta.get(_ASKED) and not ctx.meta.get(_PRINTED):
        click.echo(json.dumps({"error": lines}, indent=1))


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return _plain(value.tolist()) if hasattr(value, "tolist") else value


def _note(ctx: click.Context, _option: click.Parameter, value: bool) -> bool:
    ctx.meta[_ASKED] = value
    return value
