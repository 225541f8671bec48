"""Templates of emitted files. They stand in templates/ of the repository and travel in the wheel."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined, Template, select_autoescape


def folders() -> list[Path]:
    """Where templates lie: in the package, or in the repository."""
    package = Path(__file__).resolve().parents[2]
    return [f for f in (package / "templates", package.parent.parent / "templates") if f.is_dir()]


@lru_cache(maxsize=1)
def environment() -> Environment:
    """Jinja environment: undefined names are errors; blocks are [% %] and values [= =], since C is full of braces."""
    return Environment(
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


def template(name: str) -> Template:
    """The template of that file name."""
    return environment().get_template(name)


def source_text(name: str) -> str:
    """A file beside the templates as it is: what others wrote, such as the headers of a standard."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), name)[0]
