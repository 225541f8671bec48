"""`new`: copy an example stand, make one of a model of another program, or write a program to be judged."""

from __future__ import annotations

from collections.abc import Callable
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from mahovik.errors import CheckError, UsageError
from mahovik.out.arguments import FilePath, Progressing, Text, vector
from mahovik.out.notices import Progress, tell
from mahovik.out.result import Result, column

if TYPE_CHECKING:
    from mahovik.out.foreign.agreement import Original
    from mahovik.out.foreign.merge import ImportedStand
    from mahovik.out.foreign.model import ForeignModel

ADAPTER = "adapter"
"""What `new` writes that is no stand."""

Source = Annotated[str, "NAME|FILE"]
Vector = Annotated[tuple[float, float, float] | str, "X,Y,Z"]


def new(
    source: Source | None = None,
    *,
    output: FilePath | None = None,
    name: Text | None = None,
    carrier: Text | None = None,
    instruments: bool = False,
    gravity: Vector | None = None,
    list: bool = False,
    progress: Progressing = None,
) -> Result:
    """Copy an example stand, or make one of a model of another program. Nothing is ever overwritten.

    NAME is an example, which comes with its motions and servos; or `adapter`, of which `-o adapter.py` or
    `-o adapter.cpp` is a program that reads states and answers them, to be judged by `mahovik judge --with`: put your
    own equations into it. FILE is a URDF (.urdf) or a model of MuJoCo (.xml): its root link or free body is the
    carrier, joints that turn without end are flywheels, fixed bodies are merged, bodies without mass and sites become
    points; features that a stand cannot have are refused, all of them at once, and the result is compared with the
    original.

    Args:
        source: example, adapter, or file of another program.
        output: write this file, or into this folder; default ./NAME.toml. To a device or a FIFO, such as /dev/stdout,
            the stand file alone is written.
        name: name of the stand in the new file; default that of -o, else the example's or the model's.
        carrier: body of FILE whose frame is E1, fixed to the first one; default the first.
        instruments: keep bodies of FILE that are fixed on the carrier as instruments, in place of merging them.
        gravity: gravity in E0, m/s2, which a URDF does not have; default 0.
        list: list the examples.

    Raises:
        UsageError: an unknown source, a file that exists.
        ForeignError: every feature of FILE that a stand cannot have.
    """
    from mahovik import stands

    if list:
        found = {each: _first_sentence(stands.path(each)) for each in stands.names()}
        return Result(
            "examples", (column("name", "", [*found]), column("words", "", [*found.values()])), rows="examples"
        )
    if source is None:
        raise UsageError(f"source: which example? One of {', '.join(stands.names())}; or {ADAPTER}, or a FILE")
    if name is not None:
        _check_name(name)
    place = None if output is None else str(output)
    if source == ADAPTER:
        return _adapter(Path(place or "adapter.py"), name)
    if Path(source).suffix in (".urdf", ".xml", ".mjcf"):
        return _import(Path(source), place, name, carrier, gravity, instruments, progress)
    if carrier is not None or instruments or gravity is not None:
        what = "carrier" if carrier is not None else "instruments" if instruments else "gravity"
        raise UsageError(f"{what}: of a FILE of another program, not of the example {source}")
    return _example(source, place, name)


def _example(name: str, output: str | None, called: str | None) -> Result:
    from mahovik import stands
    from mahovik.writing import is_written_through, write_all

    source, target = stands.path(name), new_file(output, called or name)
    alone = is_written_through(target)
    messages: list[str] = []
    if called is None and not alone:
        called, messages = _name_of_file(target, name)
    files = {target.name: source}
    if not alone:
        stem = target.name.removesuffix(".toml")
        files |= {stem + motion.name.removeprefix(name): motion for motion in stands.motions(name)}
        files |= {f"{stem}.servo.toml": servo for servo in stands.servos(name)}
        for each in files:
            if (target.parent / each).exists():
                raise UsageError(f"{target.parent / each}: exists already, nothing was written")
    texts = {each: file.read_text(encoding="utf-8") for each, file in files.items()}
    if called not in (None, name):
        texts[target.name] = texts[target.name].replace(f'\nname = "{name}"\n', f'\nname = "{called}"\n', 1)
    return _list_of(write_all(target.parent, texts), messages, alone)


def _list_of(paths: Any, messages: Any, through: bool = False) -> Result:
    """The files; to a device or a FIFO, which may be standard output, nothing more is said."""
    files = [str(path) for path in paths]
    return Result("", meta={"files": files}, messages=messages, details=("files",) if through else ())


def _adapter(path: Path, called: str | None) -> Result:
    """The skeleton in the language that the name of the file says. Raises UsageError."""
    from mahovik.contract.evaluation import STATE, ZEROS, text_lines
    from mahovik.core.emit.templates import template
    from mahovik.writing import format_of, is_written_through, write

    suffix = format_of(path, (".py", ".cpp"))
    if suffix is None:
        raise UsageError(f"-o {path}: expected a name that ends in .py or .cpp")
    if called is not None:
        raise UsageError(f"name {called}: no stand is written; it names that of an example")
    if path.exists() and not is_written_through(path):
        raise UsageError(f"{path}: exists already, nothing was written")
    shapes = {key.name: key.shape or () for key in STATE.values() if key.default == ZEROS}
    zeros = [
        (name, "flywheels" if shape == ("N",) else shape[0])
        for name, shape in shapes.items()
        if shape != ("m",) and name not in ("angles", "wrench")
    ]
    write(path, template(f"adapter{suffix}.j2").render(contract=text_lines(), zeros=zeros, file=path.name))
    return _list_of([path], (), is_written_through(path))


def _import(
    source: Path, output: str | None, called: str | None, carrier: str | None, gravity: Any, instruments: bool,
    progress: Progressing,
) -> Result:  # fmt: skip
    """The stand of a model of another program, compared with the original. Raises ForeignError, CheckError."""

    from mahovik.out.foreign.merge import make_stand
    from mahovik.out.foreign.naming import stand_name
    from mahovik.out.foreign.write import stand_file
    from mahovik.writing import write

    original: Callable[[ImportedStand], Original]
    if source.suffix == ".urdf":
        from mahovik.out.foreign.urdf import read_urdf

        model: ForeignModel = read_urdf(source)

        def original(found: ImportedStand) -> Original:
            from mahovik.out.foreign.agreement import PinocchioOriginal

            return PinocchioOriginal(source, found, model.free is True)
    else:
        from mahovik.out.foreign.mjcf import read_mjcf

        if gravity is not None:
            raise UsageError("gravity: a model of MuJoCo has its own")
        model = read_mjcf(source)

        def original(found: ImportedStand) -> Original:
            from mahovik.out.foreign.agreement import MujocoOriginal
            from mahovik.out.foreign.mjcf import compile_model

            return MujocoOriginal(compile_model(source), found, model.free is not False)

    own = called or stand_name(model.name or source.stem)
    target = new_file(output, own)
    down = None if gravity is None else vector("gravity", gravity, "as 0,0,-9.81")
    made = make_stand(
        model,
        own,
        source.name,
        carrier=carrier,
        gravity=down,
        instruments=instruments,
    )
    text = stand_file(made, source.name, "mahovik new")
    tell(progress, Progress(f"comparing with {source.name}"))
    comparison = _comparison_words(made, original, source)
    write(target, text)
    stand = made.stand
    parts = [(len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"), (len(stand.points), "point")]
    words = [f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in parts if n or noun == "flywheel"]
    return _list_of([target], [f"carrier {made.carrier}, {', '.join(words)}", *made.notes, comparison])


def _comparison_words(made: ImportedStand, original: Callable[[ImportedStand], Original], source: Path) -> str:
    """Agreement of the stand with the original file, in words. Raises CheckError."""
    from mahovik.out.foreign.agreement import LIMIT, agreement, disagreement

    try:
        theirs = original(made)
    except ImportError as error:
        return f"not compared with the original: {error.name or error} is not installed: pip install pin"
    except ValueError as error:
        return f"not compared with the original: {' '.join(str(error).split())}"
    errors = agreement(made, theirs)
    if wrong := disagreement(errors):
        raise CheckError(
            f"{source.name}: the stand differs from the original in {theirs.name}, {wrong}: nothing was written"
        )
    if not errors:
        return "not compared with the original: fixed on the world and without flywheels it has no motion"
    alone = "" if "K" in errors else f" in {', '.join(errors)} alone, since it is fixed on the world there"
    loose = {name: error for name, error in errors.items() if error > LIMIT}  # an acceleration: the equations agree
    tight = {name: error for name, error in errors.items() if error <= LIMIT}
    most, but = "", ""
    if tight:
        worst = max(tight, key=lambda name: tight[name])
        most = f", largest relative difference {tight[worst]:.1g} ({worst})"
    if loose:
        apart = max(loose, key=lambda name: loose[name])
        but = f"; but {apart} by {loose[apart]:.1g}: the mass matrix is so uneven that rounding decides"
    return f"agrees with the original in {theirs.name} at 20 random states{alone}{most}{but}"


def new_file(output: str | None, name: str) -> Path:
    """Path of a new stand file: the given one, or NAME.toml in the given folder. Raises UsageError where it exists."""
    from mahovik.writing import is_written_through

    path = Path(output) if output is not None else Path(f"{name}.toml")
    if path.is_dir() or (output is not None and output.endswith("/")):
        path = path / f"{name}.toml"
    if path.exists() and not is_written_through(path):
        raise UsageError(f"{path}: exists already, nothing was written")
    return path


def _name_of_file(target: Path, example: str) -> tuple[str, list[str]]:
    """Name of the stand after its file; that of the example where a stand cannot be called so, which is noted."""
    name = target.name.removesuffix(".toml")
    if name == example:
        return name, []
    from mahovik.core.stand.fields import stand_name_problem

    if (problem := stand_name_problem(name)) is None:
        return name, []
    return example, [f"the stand is still named {example}, since {problem}; give another by --name"]


def _check_name(name: str) -> None:
    """Raises UsageError if a stand cannot have this name."""
    from mahovik.core.stand.fields import stand_name_problem

    if (problem := stand_name_problem(name)) is not None:
        raise UsageError(f"name {name}: {problem}")


def _first_sentence(path: Path) -> str:
    """The first sentence of the comment that opens a stand file, on one line."""
    lines = path.read_text(encoding="utf-8").splitlines()
    opening = takewhile(lambda line: line.startswith("#") and line.strip("# "), lines)
    sentence, end, _ = " ".join(line.strip("# ") for line in opening).partition(". ")
    return sentence + end.rstrip()
