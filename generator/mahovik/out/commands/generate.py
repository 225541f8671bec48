"""`generate`: the C of a stand, with projects around it, programmes, servos and attitude loops."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from mahovik.contract.functions import ALL, is_default
from mahovik.errors import CheckError, UsageError
from mahovik.nearest import names_in, suggestion
from mahovik.out.arguments import (
    FileGiven,
    FilePath,
    Folder,
    Names,
    Number,
    Progressing,
    StandGiven,
    Text,
    command,
    file_name,
    motion_of,
    programme_of,
    quantity,
    servo_of,
)
from mahovik.out.notices import Progress, notify, warn, warn_of_turn
from mahovik.out.result import Result, column
from mahovik.writing import probe, write, write_all

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme
    from mahovik.core.motion.required import RequiredMotion
    from mahovik.core.motion.servo import Servo
    from mahovik.core.stand.model import Stand
    from mahovik.use.control.attitude import LoopOptions

Project = Annotated[str, "cmake|fmu|simulink|basilisk|BOARD"]
Settings = Annotated[str | Sequence[str] | Mapping[str, Number], "NAME=VALUE"]

BLOCKS = ("simulink", "basilisk")
"""Simulators for which there is a plant block."""

ALONE = ("fmu", "fuzz", *BLOCKS)
"""Projects that compile neither programmes nor loops, nor what is added to the C."""

OF_C = ("only", "with_", "batch")
"""Arguments that choose functions; what calls them chooses them elsewhere."""

FMU = {"kind": ("cs", "me"), "inputs": ("torque", "acceleration"), "binary": ("yes", "no")}
"""Settings of an FMU that are one of some words, the default first."""


@command(
    needs={
        " or ".join(f"project={name}" for name in ("fmu", *BLOCKS)): ("fmu",),
        "programme": ("motion", "servo", "name", "table"),
    },
    excludes={
        "programme": ("attitude",),
        "attitude": OF_C,
        " or ".join(f"project={name}" for name in ALONE): ("programme", "attitude", *OF_C),
        " or ".join(f"project={name}" for name in BLOCKS): ("real",),
    },
)
def generate(
    stand: StandGiven,
    *,
    output: Folder | None = None,
    only: Names = (),
    with_: Names = (),
    prefix: Text | None = None,
    real: Literal["double", "float"] | None = None,
    batch: bool = False,
    project: Project | None = None,
    fmu: Settings | None = None,
    programme: FileGiven | None = None,
    motion: FileGiven | None = None,
    servo: FilePath | None = None,
    table: Literal["quintic", "fourier"] = "quintic",
    name: Text = "programme",
    attitude: Settings | None = None,
    check: bool = False,
    progress: Progressing = None,
) -> Result:
    """Write the C of a stand.

    A complete folder: header, source, README, what --with adds, and a manifest with the hash of every file; beside
    these provenance.json, which the manifest does not list. It writes all or nothing, never overwrites files of
    others, and needs no compiler. Warns if float would not resolve an unbalance or would lose what short steps add,
    and where (12) is singular in practice. With --prefix the C is that of a stand of that name, and so is its physics
    hash; commands that read the folder, or a log of its C, find the name there.

    --project writes a project around the C: cmake, with the target mahovik::NAME; fmu, the stand
    behind the Functional Mock-up Interface 2.0; simulink or basilisk, a plant block; a processor or board, such as m7,
    where `make run` runs the self-test on the emulator and main.c is yours; fuzz, a harness for libFuzzer. --programme
    adds a programme as const tables with a clock that never drifts, with drive torques if --motion is given, to the C
    that the folder has, or with it; --servo adds the servos that follow it. --attitude writes an attitude loop with an
    example that closes it with the exact plant.

    Args:
        stand: the stand file.
        output: write into this folder, of project fmu this file; default ./NAME of the stand, with `-attitude` and
            `-PROJECT` behind it, or ./NAME.fmu.
        only: write these public functions alone and what they need, or all; list prints what there is.
        with_: add selftest, golden vectors; recorder, a log of flights; eva, proofs; batch; encoder, phases of counts.
        prefix: use this name in C instead of the stand's, so that two element types lie in one image.
        real: element type; default double, of a board the widest of its FPU, of a folder that exists its own.
        batch: add functions for many states at once.
        project: write a project of this kind around the C.
        fmu: set start=STATE.json (default the rest pose) or dt=TIME (the longest step inside, default 0.1 ms) of an FMU
            or a block, kind=cs|me, inputs=torque|acceleration or binary=yes|no of an FMU.
        programme: add this programme of `mahovik plan`.
        motion: read the required motion of the programme, for drive torques, feedforward and trim.
        servo: add the servos of this file. Exit status 1 if the sampled, delayed loop is not stable with enough margin.
        table: kind of the programme's table.
        name: name of the programme in C, so that several lie in one image.
        attitude: write an attitude loop for this task, or set task=NAME, rate=HZ (default 50), bandwidth=HZ (0.1),
            damping=RATIO (0.8), momentum=NMS (1, of the example), failure=coasts|held|none (of its first flywheel).
        check: write nothing, and exit with status 1 if the folder differs; options are those that it was made with,
            but an FMU, a file alone, takes them again.

    Raises:
        UsageError: options that contradict one another, files of others in the folder.
        CheckError: a programme that exceeds its bounds, a loop without margin, a folder that differs.
    """
    from mahovik.core.emit.delivered import Options, delivered_options, stand_in, with_prefix
    from mahovik.core.toolchain.targets import TARGETS
    from mahovik.out.api.stands import Stand

    machine = Stand.of(stand)
    only_, added = names_in("only", only, (*ALL, "list")), names_in("with_", with_)
    added += ("batch",) if batch else ()
    if only_ == ("list",):
        if added or project or programme or attitude or check:
            raise UsageError("only: list prints what there is, and goes with no other option")
        return _functions(machine)
    if project is not None and project not in (known := ("cmake", *ALONE, *TARGETS)):
        raise UsageError(f'project: unknown "{project}"{suggestion(project, known)}')
    if added and project not in (None, "cmake"):
        raise UsageError("with_: a board has the self-test and nothing else")
    named = with_prefix(machine, prefix)
    if project == "fmu" or (check and project is None and Path(output or "").suffix == ".fmu"):
        return _fmu(named, output, fmu, check, progress)
    with_loop = attitude is not None
    usual_name = "-".join(filter(None, (named.name, "attitude" * with_loop, project or "host" * with_loop)))
    folder = Path(usual_name if output is None else output)
    delivered = Options()
    if check or programme is not None:
        delivered = delivered_options(folder) or Options("")
    if programme is None:
        attitude, fmu = attitude or delivered.settings.get("attitude"), fmu or delivered.settings.get("fmu")
    if project is None and delivered.project:
        # which is to compile the programme as well
        project = delivered.project.removeprefix("attitude-" * (attitude is not None))
        if project.startswith("attitude-") and programme is None:
            raise CheckError(f"{folder} has an attitude loop: expected the attitude=TASK that it was made with")
        if programme is not None and project not in ("cmake", *TARGETS):
            raise UsageError(f"programme: {folder} has project {project}, which cannot play it: choose another folder")
    if prefix is None and (check or programme is not None):
        named = stand_in(folder, named, CheckError if check else UsageError)
    notify(progress, Progress(f"generate {named.name}"))
    contents, usual = Contents(), (TARGETS[project].real if project in TARGETS else None) or "double"
    if programme is not None:
        from mahovik.out.export.programme import element_type

        course, sources = programme_of(programme), (file_name(programme, "programme"), file_name(servo, "servo"))
        required = None if motion is None else motion_of(motion, named, course)
        usual = element_type(folder, named, real, usual)
        servos = None if servo is None else servo_of(servo, named)
        _add_programme(contents, named, course, required, servos, table, usual, sources, name)
    if programme is None or project is not None or not (folder / f"{named.name}.h").is_file():
        if project is None or project == "cmake":
            added = tuple(dict.fromkeys((*added, *delivered.additions)))
        loop = None if attitude is None else _loop_options(attitude)
        chosen = real or (delivered.real if check else "") or usual
        _add_project(contents, named, folder, project, loop, chosen, only_ or delivered.only, added, fmu)
    if check:
        _check_folder(folder, named, contents)
        return Result(f"{folder} is as the stand file gives it", meta={"folder": str(folder)}, details=("folder",))
    if programme is not None:
        from mahovik.out.export.programme import refuse_foreign

        refuse_foreign(folder, named, "servo", contents.servo, "" if name == "programme" else f"{name}_servo")
        refuse_foreign(folder, named, "programme", contents.programme, name)
    if project is None and contents.files:
        _warn(named, contents, only_)
    return _deliver(folder, named, contents, stand)


def _pairs(settings: Any, bare: str) -> dict[str, Any]:
    """Settings by name, of a mapping or of words NAME=VALUE; a word alone is the value of `bare`, "" for its name."""
    if isinstance(settings, Mapping):
        return dict(settings)
    pairs: dict[str, Any] = {}
    for word in [settings] if isinstance(settings, str) else settings:
        name, equals, text = str(word).partition("=")
        value: Any = text
        with contextlib.suppress(ValueError):
            value = float(text)
        pairs |= {name: value} if equals else {bare: word} if bare else {name: ""}
    return pairs


def _loop_options(attitude: Any) -> Any:
    """Options of an attitude loop: the name of a task, or settings. Raises UsageError."""
    from mahovik.use.control.attitude import LoopOptions

    settings = _pairs(attitude, "task")
    known = [field.name for field in fields(LoopOptions)]
    for key, value in settings.items():
        if key not in known:
            raise UsageError(f'attitude: unknown "{key}"{suggestion(key, known)}')
        if key not in ("task", "failure") and isinstance(value, str):
            raise UsageError(f'attitude {key}: expected a number, found "{value}"')
    if settings.get("failure", "none") not in ("coasts", "held", "none"):
        raise UsageError(f'attitude failure: unknown "{settings["failure"]}", expected coasts, held or none')
    return LoopOptions(**settings)


@dataclass
class Contents:
    """What is to be written.

    files        text by name, the manifest among them
    replaceable  those of which a user's own stay
    programme    files of a programme, with a manifest of their own
    servo        likewise of its servos
    lines        messages, a line each
    """

    files: dict[str, str] = field(default_factory=dict)
    replaceable: tuple[str, ...] = ()
    programme: dict[str, str] = field(default_factory=dict)
    servo: dict[str, str] = field(default_factory=dict)
    lines: tuple[str, ...] = ()


def _add_project(
    contents: Contents, stand: Stand, folder: Path, project: str | None, loop: LoopOptions | None, real: str,
    only: tuple[str, ...], additions: tuple[str, ...], fmu: Any,
) -> None:  # fmt: skip
    """Add the C and the project around it, which compiles programmes of the contents and of the folder.

    `loop`: options of an attitude loop; without a project for this machine. `fmu`: settings of a block. Both stand in
    the manifest. Raises UsageError, StandError.
    """
    settings: dict[str, Any] = {}
    if loop is None and project is None:
        from mahovik.core.emit.delivery import delivery

        contents.files = delivery(stand, real, only, additions)
    elif project == "fuzz":
        from mahovik.core.toolchain.checks import fuzz_project

        contents.files = fuzz_project(stand, real)
    elif project in BLOCKS:
        from mahovik.out.export.fmu import export_block
        from mahovik.proof.verify.states import state_object

        chosen = _fmu_settings(stand, fmu, {})
        contents.files = export_block(stand, str(project), **chosen)
        start = {} if chosen["start"] is None else {"start": state_object(chosen["start"])}
        settings = {"fmu": start | {"dt": chosen["dt"]}}
    elif loop is not None:
        from mahovik.out.export.project import attitude_project, attitude_sources, cmake_project

        made, settings = attitude_sources(stand, loop, real), {"attitude": asdict(loop)}
        contents.lines = (*contents.lines, *made.design.lines)
        if project == "cmake":
            contents.files = cmake_project(stand, real, loop=made)
        else:
            contents.files = attitude_project(stand, project or "host", loop, made, real)
    else:
        from mahovik.out.export.programme import files_in
        from mahovik.out.export.project import board_project, cmake_project

        beside = sorted({*files_in(folder, stand), *contents.programme, *contents.servo})
        if project == "cmake":
            contents.files = cmake_project(stand, real, only, additions, beside)
        else:
            contents.files = board_project(stand, str(project), real, only, beside)
            contents.replaceable = ("main.c",)
    if settings:
        from mahovik.core.emit.manifest import NAME, as_text

        document = json.loads(contents.files[NAME])
        contents.files[NAME] = as_text({**document, "settings": settings})


def _add_programme(
    contents: Contents, stand: Stand, programme: Programme, motion: RequiredMotion | None, servo: Servo | None,
    table: str, real: str, sources: tuple[str, str], called: str,
) -> None:  # fmt: skip
    """Add the C of a programme, and of the servos that follow it. Raises CheckError, UsageError.

    `sources`: files of programme and servo, in messages; `called`: its name in C.
    """
    if servo is None:
        from mahovik.out.export.programme import export_programme

        made = export_programme(stand, programme, motion, table, None, real, None, sources[0], called)
        contents.lines = made.lines
    else:
        from mahovik.out.export.servo import export_servo

        follower = export_servo(stand, programme, motion, servo, real, table, sources, called)
        made, contents.servo = follower.programme, follower.servo
        contents.lines = (*made.lines, *follower.lines)
    contents.programme = made.files


def _check_folder(folder: Path, stand: Stand, contents: Contents) -> None:
    """Raise CheckError where a folder is not what would be written; replaceable files are not compared."""
    from mahovik.core.emit.delivered import differences

    files = {name: text for name, text in contents.files.items() if name not in contents.replaceable}
    lines = differences(folder, stand, files, {**contents.programme, **contents.servo})
    if lines:
        raise CheckError("\n".join(lines))


def _deliver(folder: Path, stand: Stand, made: Contents, source: Any) -> Result:
    from mahovik.core.emit.delivered import deliver, provenance
    from mahovik.core.stand.files import content

    made_by = provenance(content(Path(source)) if isinstance(source, str | Path) else None)
    paths: list[Path] = []
    if made.files:
        done = deliver(folder, stand, made.files, replaceable=made.replaceable, made_by=made_by)
        paths, made.lines = [*done.paths], (*made.lines, *done.notes)
    paths += write_all(folder, {**made.programme, **made.servo})
    texts = {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    return _result(f"C of {stand.name}", folder, texts, made.lines)


def _result(title: str, folder: Path, texts: Mapping[str, str | bytes], lines: Sequence[str]) -> Result:
    """A row a file; what is no text has no lines."""
    return Result(
        title,
        (
            column("file", "", [str(folder / name) for name in texts]),
            column("lines", "", [text.count("\n") if isinstance(text, str) else None for text in texts.values()]),
            column("bytes", "", [len(text.encode() if isinstance(text, str) else text) for text in texts.values()]),
        ),
        rows="files",
        index="file",
        meta={"folder": str(folder)},
        messages=lines,
        details=("folder",),
    )


def _warn(stand: Stand, made: Contents, only: tuple[str, ...]) -> None:
    """Warn of what float does not resolve, of tasks out of reach, of a singular (12), as `mahovik check` does."""
    from mahovik.core.stand.summary import summarize
    from mahovik.use.simulate.held import USUAL_STEP, lost_increments, lost_increments_line
    from mahovik.use.study.shortfalls import excess, shortfalls, shortfalls_line, task_shortfalls

    def doubts() -> Iterator[str]:
        if json.loads(made.files["manifest.json"])["real"] == "float":
            speeds = [row.speed for row in summarize(stand, None).unbalance]
            yield shortfalls_line(shortfalls(stand, speeds))
            if lost := lost_increments(stand, speeds, USUAL_STEP):
                yield lost_increments_line(lost)
        yield from map(str, task_shortfalls(stand))
        inverted = not only or any(name.startswith(("inverse", *ALL)) for name in only)
        if not stand.tasks and inverted and (shortfall := excess(stand)) is not None:
            yield str(shortfall)

    for line in filter(None, doubts()):
        warn(line)


def _fmu_settings(stand: Stand, settings: Any, words: Mapping[str, tuple[str, ...]]) -> dict[str, Any]:
    """Start and longest step of an FMU or a block, and what is one of some words. Raises UsageError."""
    from mahovik.core.stand.units import TIME
    from mahovik.out.api.states import state_of
    from mahovik.use.simulate.case import HINT, START_KEYS

    chosen: dict[str, Any] = {"start": None, "dt": 1e-4, **{key: known[0] for key, known in words.items()}}
    for key, value in _pairs(settings or {}, "").items():
        if key not in chosen:
            raise UsageError(f'fmu: unknown "{key}"{suggestion(str(key), chosen)}')
        if key in words and str(value) not in words[key]:
            raise UsageError(f'fmu {key}: unknown "{value}"{suggestion(str(value), words[key])}')
        if key == "start":
            chosen[key] = state_of("fmu start", value, stand, START_KEYS, HINT)
        else:
            chosen[key] = quantity("fmu dt", value, TIME, 1e-9, 10.0) if key == "dt" else str(value)
    if chosen["start"] is None:
        warn_of_turn(stand)
    return chosen


def _fmu(stand: Stand, output: Any, settings: Any, check: bool, progress: Progressing) -> Result:
    """Write the FMU, or compare what a file holds. Raises UsageError, CheckError, ToolchainError."""
    import io
    import zipfile

    from mahovik.out.export.fmu import export_fmu

    chosen = _fmu_settings(stand, settings, FMU)
    if chosen["kind"] == "me" and isinstance(settings, Mapping) and "dt" in settings:
        raise UsageError("fmu dt: model exchange has no internal step, the tool integrates")
    target = Path(output) if output is not None else Path(f"{stand.name}.fmu")
    if target.suffix != ".fmu":
        target = target / f"{stand.name}.fmu"
    if not check:
        probe(target)
    notify(progress, Progress(f"FMU of {stand.name}"))
    made = export_fmu(stand, **chosen | {"binary": chosen["binary"] == "yes" and not check})
    if check:
        try:
            with zipfile.ZipFile(io.BytesIO(target.read_bytes())) as there:
                known = {name: there.read(name) for name in there.namelist()}
        except (OSError, zipfile.BadZipFile) as error:
            raise CheckError(f"{target}: cannot be read: {error}") from None
        texts = {name: text.encode() if isinstance(text, str) else text for name, text in made.files.items()}
        if wrong := [name for name, text in texts.items() if known.get(name) != text]:
            raise CheckError(f"{target}: {', '.join(wrong)}: not what the generator makes of the stand file")
        return Result(f"{target} is as the stand file gives it")
    write(target, made.content)
    return _result(f"FMU of {stand.name}", target.parent, {target.name: made.content}, made.lines)


def _functions(stand: Stand) -> Result:
    """The public functions of a stand, what each gives, and with which options it is written."""
    from mahovik.core.emit.generate import generate_all

    functions = [f for f in generate_all(stand, only=ALL).program.functions if f.public]
    functions.sort(key=lambda f: not is_default(f.name))
    return Result(
        f"functions of {stand.name}",
        (
            column("function", "", [f.name for f in functions]),
            column("written by", "", ["default" if is_default(f.name) else "all" for f in functions]),
            column("gives", "", [f.purpose.partition(". ")[0].partition(": ")[0].rstrip(".") for f in functions]),
        ),
        rows="functions",
    )
