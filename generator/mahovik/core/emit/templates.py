"""Templates of emitted files. They stand in templates/ of the repository and travel in the wheel."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from mahovik import __version__
from mahovik.core.emit.layout import wrap_statement

if TYPE_CHECKING:
    from jinja2 import Environment, Template


def folders() -> list[Path]:
    """Where templates lie: in the package, or in the repository."""
    package = Path(__file__).resolve().parents[2]
    return [f for f in (package / "templates", package.parent.parent / "templates") if f.is_dir()]


@lru_cache(maxsize=1)
def environment() -> Environment:
    """Jinja environment: undefined names are errors; blocks are [% %] and values [= =], since C is full of braces.

    All templates know `version`, and its three numbers as `release`. `lines|indented(4)` are lines that stand so far
    to the right, `text|wrapped(4)` is a statement that may be long.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape  # most commands print no C

    result = Environment(
        loader=FileSystemLoader(folders()),
        undefined=StrictUndefined,
        autoescape=select_autoescape(["html", "html.j2"]),
        block_start_string="[%",
        block_end_string="%]",
        variable_start_string="[=",
        variable_end_string="=]",
        comment_start_string="[#",
        comment_end_string="#]",
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    result.globals["version"] = __version__
    result.globals["release"] = [int(part) for part in re.findall(r"\d+", __version__)[:3]]
    result.filters["indented"] = lambda lines, by: "\n".join(" " * by + line for line in lines)
    result.filters["thousands"] = "{:,}".format
    result.filters["wrapped"] = lambda text, by: "\n".join(wrap_statement(text, " " * by))
    return result


def template(name: str) -> Template:
    """The template of that file name."""
    return environment().get_template(name)


def source_text(name: str) -> str:
    """Text of a file beside the templates that is used unchanged, such as the headers of a standard."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), name)[0]
