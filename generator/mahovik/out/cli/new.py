"""`mahovik new`: copy an example stand."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.json_output import json_option, print_json


@click.command()
@click.argument("name", required=False, shell_complete=lambda _context, _argument, typed: _examples(typed))
@click.option("-o", "output", metavar="FILE|DIR", type=click.Path(), help="Output; default ./NAME.toml.")
@click.option("--list", "listed", is_flag=True, help="List the examples and stop.")
@json_option("Print the list, or the files written, as JSON.")
def new(name: str | None, output: str | None, listed: bool, as_json: bool) -> None:
    """Copy an example stand with its motions and servos. Nothing is ever overwritten."""
    from mahovik import stands
    from mahovik.proof.verify.files import write_all

    if listed:
        found = {each: _first_comment(stands.path(each)) for each in stands.names()}
        if as_json:
            print_json([{"name": each, "words": words} for each, words in found.items()])
        else:
            for each, words in found.items():
                click.echo(f"{each:10} {words}".rstrip())
        return
    if name is None:
        raise UsageError(f"which example? One of {', '.join(stands.names())}")
    source = stands.path(name)
    target = Path(output) if output is not None else Path(f"{name}.toml")
    if target.is_dir() or (output is not None and output.endswith("/")):
        target = target / f"{name}.toml"
    stem = target.name.removesuffix(".toml")
    files = {target.name: source}
    files |= {stem + motion.name.removeprefix(name): motion for motion in stands.motions(name)}
    files |= {f"{stem}.servo.toml": servo for servo in stands.servos(name)}
    for each in files:
        if (target.parent / each).exists():
            raise UsageError(f"{target.parent / each}: exists already, nothing was written")
    texts = {each: file.read_text(encoding="utf-8") for each, file in files.items()}
    paths = write_all(target.parent, texts)
    if as_json:
        print_json({"files": [str(path) for path in paths]})
        return
    for path in paths:
        click.echo(click.format_filename(path))


def _examples(typed: str) -> list[str]:
    """Names for completion in a shell."""
    from mahovik import stands

    return [name for name in stands.names() if name.startswith(typed)]


def _first_comment(path: Path) -> str:
    """The first line of a stand file's comment."""
    first = path.read_text(encoding="utf-8").partition("\n")[0]
    return first.lstrip("# ") if first.startswith("#") else ""
