"""`mahovik new`: copy an example stand, or write a skeleton of a program that `mahovik judge` can judge."""

from __future__ import annotations

from itertools import takewhile
from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import argument, command, file_option, flag, json_option, option
from mahovik.out.cli.output import new_file, print_json, print_paths, require_suffix

ADAPTER = "adapter"
"""What `new` writes that is no example."""


@command()
def new(
    name: str | None = argument(
        "[NAME]", required=False, shell_complete=lambda _context, _argument, typed: _examples(typed)
    ),
    output: str | None = file_option("-o", "FILE|DIR", "Write the stand file here; default ./NAME.toml."),
    own_name: str | None = option(
        "--name", "Name the stand in the new file; default: the name of -o, else the example's.", metavar="NAME"
    ),
    listed: bool = flag("--list", "List the examples and stop."),
    as_json: bool = json_option("Print the list, or the files written, as JSON."),
) -> None:
    """Copy an example stand with its motions and servos. Nothing is ever overwritten.

    `new adapter -o adapter.py` or `-o adapter.cpp` writes a program that reads states and answers them, to be judged by
    `mahovik judge --with`: put your own equations into it.

    To a device or a FIFO, such as -o /dev/stdout, the stand file alone is written.
    """
    from mahovik import stands
    from mahovik.writing import is_written_through, write_all

    if listed:
        found = {each: _first_sentence(stands.path(each)) for each in stands.names()}
        if as_json:
            print_json([{"name": each, "words": words} for each, words in found.items()])
        else:
            for each, words in found.items():
                click.echo(f"{each:10} {words}".rstrip())
        return
    if name is None:
        raise UsageError(f"which example? One of {', '.join(stands.names())}; or {ADAPTER}")
    if name == ADAPTER:
        _write_adapter(Path(output or "adapter.py"), own_name, as_json)
        return
    source = stands.path(name)
    if own_name is not None:
        _check_name(own_name)
    target = new_file(output, own_name or name)
    alone = is_written_through(target)
    own_name = own_name or (name if alone else _name_of_file(target, name))
    files = {target.name: source}
    if not alone:
        stem = target.name.removesuffix(".toml")
        files |= {stem + motion.name.removeprefix(name): motion for motion in stands.motions(name)}
        files |= {f"{stem}.servo.toml": servo for servo in stands.servos(name)}
        for each in files:
            if (target.parent / each).exists():
                raise UsageError(f"{target.parent / each}: exists already, nothing was written")
    texts = {each: file.read_text(encoding="utf-8") for each, file in files.items()}
    if own_name != name:
        texts[target.name] = texts[target.name].replace(f'\nname = "{name}"\n', f'\nname = "{own_name}"\n', 1)
    paths = write_all(target.parent, texts)
    if as_json:
        print_json({"files": [str(path) for path in paths]})
    else:
        print_paths(paths, err=alone)  # standard output may be what was written


def _write_adapter(path: Path, own_name: str | None, as_json: bool) -> None:
    """Write the skeleton in the language that the name of the file says. Raises UsageError."""
    from mahovik.contract.evaluation import STATE, ZEROS, text_lines
    from mahovik.core.emit.templates import template
    from mahovik.writing import is_written_through, write

    suffix = require_suffix(str(path), [".py", ".cpp"])
    if own_name is not None:
        raise UsageError(f"--name {own_name}: no stand is written; it names that of an example")
    if path.exists() and not is_written_through(path):
        raise UsageError(f"{path}: exists already, nothing was written")
    shapes = {key.name: key.shape or () for key in STATE.values() if key.default == ZEROS}
    zeros = [
        (name, "flywheels" if shape == ("N",) else shape[0])
        for name, shape in shapes.items()
        if shape != ("m",) and name not in ("angles", "wrench")
    ]
    write(path, template(f"adapter{suffix}.j2").render(contract=text_lines(), zeros=zeros, file=path.name))
    if as_json:
        print_json({"files": [str(path)]})
    else:
        print_paths([path], err=is_written_through(path))


def _name_of_file(target: Path, example: str) -> str:
    """Name of the stand after its file; that of the example if a stand cannot be called so, which is noted."""
    name = target.name.removesuffix(".toml")
    if name == example:
        return name
    from mahovik.core.stand.fields import stand_name_problem

    problem = stand_name_problem(name)
    if problem is None:
        return name
    click.echo(f"note: the stand is still named {example}, since {problem}; give another by --name", err=True)
    return example


def _check_name(name: str) -> None:
    """Raises UsageError if a stand cannot have this name."""
    from mahovik.core.stand.fields import stand_name_problem

    problem = stand_name_problem(name)
    if problem is not None:
        raise UsageError(f"--name: {problem}")


def _examples(typed: str) -> list[str]:
    """Names for completion in a shell."""
    from mahovik import stands

    return [name for name in (*stands.names(), ADAPTER) if name.startswith(typed)]


def _first_sentence(path: Path) -> str:
    """The first sentence of the comment that opens a stand file, on one line."""
    lines = path.read_text(encoding="utf-8").splitlines()
    opening = takewhile(lambda line: line.startswith("#") and line.strip("# "), lines)
    words = " ".join(line.strip("# ") for line in opening)
    sentence, end, _ = words.partition(". ")
    return sentence + end.rstrip()
