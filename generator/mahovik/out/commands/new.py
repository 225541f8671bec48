"""`new`: copy an example stand, make one of a model of another program, or write a program to be judged."""

from __future__ import annotations

from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from mahovik import stands
from mahovik.contract.evaluation import STATE, ZEROS, text_lines
from mahovik.core.stand.fields import stand_name_problem
from mahovik.core.stand.files import words_of_file
from mahovik.errors import CheckError, UsageError
from mahovik.nearest import names_in
from mahovik.out.arguments import FilePath, Names, Progressing, Text, Vector, command, vector
from mahovik.out.notices import Progress, notify
from mahovik.out.result import Result, column
from mahovik.writing import format_of, is_written_through, write, write_all

if TYPE_CHECKING:
    from mahovik.out.foreign.stand import ImportedStand

SUFFIXES = (".urdf", ".xml", ".mjcf", ".sdf", ".xacro")
"""Files of other programs, and of macros, for which their reader says what to do."""

OF_FILE = ("carrier", "instruments", "gravity", "armature", "fix")
"""Arguments that say how such a file is read."""

ADAPTER = "adapter"
"""What `new` writes that is no stand."""


@command(
    needs={"source=*.urdf or source=*.xml or source=*.mjcf or source=*.sdf": OF_FILE},
    excludes={"list": ("source", "output", "name", *OF_FILE)},
)
def new(
    source: Annotated[str, "NAME|FILE"] | None = None,
    *,
    output: FilePath | None = None,
    name: Text | None = None,
    carrier: Text | None = None,
    instruments: bool = False,
    gravity: Vector | None = None,
    armature: Literal["wheel"] | None = None,
    fix: Names | None = None,
    list: bool = False,
    progress: Progressing = None,
) -> Result:
    """Copy an example stand, or make one of a model of another program. Nothing is ever overwritten.

    NAME is an example, which comes with its motions, servo and regime; or `adapter`, of which `-o adapter.py` or
    `-o adapter.cpp` is a program that reads states and answers them, to be judged by `mahovik judge --with`: put your
    own equations into it. FILE is a URDF, an MJCF or an SDF (.urdf, .xml, .sdf), read with MuJoCo: the body that moves
    on the world is the carrier, its joint there is the hold, joints that turn on it without end are flywheels, fixed
    bodies are merged, bodies without mass and sites become points; what a stand cannot have is refused by name, what is
    left out is said, and the result is compared with the original.

    Args:
        source: example, adapter, or file of another program.
        output: write this file, or into this folder; default ./NAME.toml. To a device or a FIFO, such as /dev/stdout,
            the stand file alone is written.
        name: name of the stand in the new file; default that of -o, else the example's or the model's.
        carrier: body of FILE whose frame is E1, fixed to the first one; default the first.
        instruments: keep bodies of FILE that are fixed on the carrier as instruments, in place of merging them.
        gravity: gravity in E0, m/s2, where FILE has none; default 0.
        armature: `wheel`: the armature of a flywheel's joint is a thin disc on the flywheel, taken from the carrier;
            default: it is refused.
        fix: joints of FILE that are fixed where FILE has them.
        list: list the examples.

    Raises:
        UsageError: an unknown source, a file that exists.
        ForeignError: every feature of FILE that a stand cannot have.
    """
    if list:
        result = {example: _first_sentence(stands.path(example)) for example in stands.names()}
        return Result(
            "examples", (column("name", "", [*result]), column("words", "", [*result.values()])), rows="examples"
        )
    if source is None:
        raise UsageError(f"source: which example? One of {', '.join(stands.names())}; or {ADAPTER}, or a FILE")
    if name is not None and (problem := stand_name_problem(name)) is not None:
        raise UsageError(f"name {name}: {problem}")
    place = None if output is None else str(output)
    if source == ADAPTER:
        return _adapter(Path(place or "adapter.py"), name)
    if Path(source).suffix in SUFFIXES:
        fixed = [] if fix is None else [*names_in("fix", fix)]
        down = None if gravity is None else vector("gravity", gravity, "as 0,0,-9.81")
        options: dict[str, Any] = {"carrier": carrier, "instruments": instruments, "armature": armature, "fix": fixed}
        made, comparison = _imported(Path(source), name, down, progress, **options)
        return _write_stand(made, comparison, place)
    if Path(source).is_file():
        words = "a URDF, an MJCF or an SDF (.urdf, .xml, .sdf), or the name of an example"
        raise UsageError(f"{source}: is {words_of_file(Path(source)) or 'a file'}, expected {words}")
    return _example(source, place, name)


def _example(name: str, output: str | None, called: str | None) -> Result:
    source, target = stands.path(name), new_file(output, called or name)
    alone = is_written_through(target)
    messages: list[str] = []
    if called is None and not alone:  # the stand is called after its file, where a stand may be
        called = target.name.removesuffix(".toml")
        if called != name and (problem := stand_name_problem(called)) is not None:
            messages = [f"the stand is still named {name}, since {problem}; give another by name=NAME"]
            called = name
    files = {target.name: source}
    if not alone:
        stem = target.name.removesuffix(".toml")
        files |= {stem + motion.name.removeprefix(name): motion for motion in stands.motions(name)}
        files |= {f"{stem}.{kind}.toml": file for kind, file in stands.servo_and_regime(name).items()}
        for file_name in files:
            _refuse_existing(target.parent / file_name)
    texts = {file_name: file.read_text(encoding="utf-8") for file_name, file in files.items()}
    if called not in (None, name):
        texts[target.name] = texts[target.name].replace(f'\nname = "{name}"\n', f'\nname = "{called}"\n', 1)
    return _list_of(write_all(target.parent, texts), messages, alone)


def _list_of(paths: Any, messages: Any, through: bool = False) -> Result:
    """The files; to a device or a FIFO, which may be standard output, nothing more is said."""
    files = [str(path) for path in paths]
    return Result("", meta={"files": files}, messages=messages, details=("files",) if through else ())


def _adapter(path: Path, called: str | None) -> Result:
    """The skeleton in the language that the name of the file says. Raises UsageError."""
    from mahovik.core.emit.templates import template

    suffix = format_of(path, (".py", ".cpp"))
    if called is not None:
        raise UsageError(f"name {called}: no stand is written; it names that of an example")
    _refuse_existing(path)
    shapes = {key.name: key.shape or () for key in STATE.values() if key.default == ZEROS}
    zeros = [
        (name, "flywheels" if shape == ("N",) else shape[0])
        for name, shape in shapes.items()
        if shape != ("m",) and name not in ("angles", "wrench")
    ]
    write(path, template(f"adapter{suffix}.j2").render(contract=text_lines(), zeros=zeros, file=path.name))
    return _list_of([path], (), is_written_through(path))


def _imported(
    source: Path, called: str | None, gravity: Any, progress: Progressing, **options: Any
) -> tuple[ImportedStand, str]:
    """The stand of a model of another program, and how it compares with that. Raises ForeignError, CheckError."""
    from mahovik.out.foreign.original import LIMIT, compare, read
    from mahovik.out.foreign.stand import make_stand, stand_name

    model, original = read(source, gravity)
    made = make_stand(model, called or stand_name(model.name or source.stem), source.name, **options)
    notify(progress, Progress(f"comparing with {source.name}"))
    differences = compare(made, original)
    if wrong := ", ".join(f"{what} by {value:.2g}" for what, value in differences.items() if not value <= LIMIT):
        raise CheckError(f"{source.name}: the stand differs from MuJoCo's model, {wrong}: nothing was written")
    if not differences:
        return made, "not compared with the original: it has no motion"
    most = max(differences, key=lambda what: differences[what])
    words = f"largest relative difference {differences[most]:.1g} ({most})"
    aside = ", but for what is said above," if made.notes else ""
    return made, f"agrees with MuJoCo's model of the file{aside} at 20 random states, {words}"


def _write_stand(made: ImportedStand, comparison: str, output: str | None) -> Result:
    """The stand file, written; what was found, left out and compared."""
    stand = made.stand
    target = new_file(output, stand.name)
    write(target, made.text)
    parts = [(len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"), (len(stand.points), "point")]
    words = [f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in parts if n or noun == "flywheel"]
    return _list_of([target], [f"carrier {made.carrier}, {', '.join(words)}", *made.notes, comparison])


def new_file(output: str | None, name: str) -> Path:
    """Path of a new stand file: the given one, or NAME.toml in the given folder. Raises UsageError where it exists."""
    path = Path(output) if output is not None else Path(f"{name}.toml")
    if path.is_dir() or (output is not None and output.endswith("/")):
        path = path / f"{name}.toml"
    format_of(path, (".toml",))
    _refuse_existing(path)
    return path


def _refuse_existing(path: Path) -> None:
    """Raises UsageError: nothing is ever overwritten."""
    if path.exists() and not is_written_through(path):
        raise UsageError(f"{path}: exists already, nothing was written")


def _first_sentence(path: Path) -> str:
    """The first sentence of the comment that opens a stand file, on one line."""
    lines = path.read_text(encoding="utf-8").splitlines()
    opening = takewhile(lambda line: line.startswith("#") and line.strip("# "), lines)
    sentence, end, _ = " ".join(line.strip("# ") for line in opening).partition(". ")
    return sentence + end.rstrip()
