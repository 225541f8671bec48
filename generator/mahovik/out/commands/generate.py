"""`generate`: the C of a stand, with projects around it, programmes, servos and attitude loops."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
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
    file_name,
    motion_of,
    programme_of,
    quantity,
    reading,
    servo_of,
)
from mahovik.out.notices import Progress, notify, warn, warn_of_turn
from mahovik.out.result import Result, column
from mahovik.writing import probe, write, write_all

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.out.export.folder import Contents

Project = Annotated[str, "cmake|fmu|simulink|basilisk|BOARD"]
Settings = Annotated[str | Mapping[str, Number], "NAME=VALUE"]

FMU = {"kind": ("cs", "me"), "inputs": ("torque", "acceleration"), "binary": ("yes", "no")}
"""Settings of an FMU that are one of some words, the default first."""


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
        output: write into this folder; default ./NAME of the stand.
        only: write these public functions alone and what they need, or all; list prints what there is.
        with_: add selftest, golden vectors; recorder, a log of flights; eva, proofs; batch; encoder, phases of counts.
        prefix: use this name in C instead of the stand's, so that two element types lie in one image.
        real: element type; default double, of a board the widest of its FPU, of a folder that exists its own.
        batch: add functions for many states at once.
        project: write a project of this kind around the C.
        fmu: set kind=cs|me, inputs=torque|acceleration, start=STATE.json, dt=TIME (the longest step
            inside, default 0.1 ms) or binary=yes|no of the FMU.
        programme: add this programme of `mahovik plan`.
        motion: read the required motion of the programme, for drive torques, feedforward and trim.
        servo: add the servos of this file. Exit status 1 if the sampled, delayed loop is not stable with enough margin.
        table: kind of the programme's table.
        name: name of the programme in C, so that several lie in one image.
        attitude: write an attitude loop for this task, or set task=NAME, rate=HZ (default 50), bandwidth=HZ (0.1),
            damping=RATIO (0.8), momentum=NMS (1, of the example), failure=coasts|held|none (of its first flywheel).
        check: write nothing, and exit with status 1 if the folder differs; options are those that it was made with.

    Raises:
        UsageError: options that contradict one another, files of others in the folder.
        CheckError: a programme that exceeds its bounds, a loop without margin, a folder that differs.
    """
    from mahovik.core.emit.delivered import Options, delivered_options, stand_in, with_prefix
    from mahovik.out.api.stands import Stand
    from mahovik.out.export.folder import (
        Contents,
        add_programme,
        add_project,
        check_folder,
        compiles_programmes,
        refuse_overwriting,
        refuse_unknown,
        usual_real,
    )

    machine = Stand.of(stand)
    only_, added = names_in("only", only, (*ALL, "list")), names_in("with_", with_)
    added += ("batch",) if batch else ()
    if only_ == ("list",):
        return _functions(machine)
    refuse_unknown(project)
    _refuse_contradictions(project, fmu, programme, motion, servo, attitude, name, real, only_, added)
    named = with_prefix(machine, prefix)
    if project == "fmu":
        return _fmu(named, output, fmu, check, progress)
    folder = Path(output) if output is not None else Path(_default_name(named, project, attitude))
    delivered = Options()
    if check or programme is not None:
        delivered = delivered_options(folder) or Options("")
    if project is None and delivered.project:
        project = delivered.project  # which is to compile the programme as well
        if programme is not None and not compiles_programmes(project):
            raise UsageError(
                f"programme: {folder} has the project {project}, which cannot play it: choose another folder"
            )
    if prefix is None and (check or programme is not None):
        named = stand_in(folder, named, CheckError if check else UsageError)
    notify(progress, Progress(f"generate {named.name}"))
    contents, usual = Contents(), usual_real(project)
    if programme is not None:
        from mahovik.out.export.programme.files import element_type

        course = programme_of(programme)
        usual = element_type(folder, named, real, usual)
        add_programme(
            contents,
            named,
            course,
            None if motion is None else motion_of(motion, named, course),
            None if servo is None else servo_of(servo, named),
            table,
            usual,
            (file_name(programme, "programme"), file_name(servo, "servo")),
            name,
        )
    if programme is None or project is not None or not (folder / f"{named.name}.h").is_file():
        if project is None or project == "cmake":
            added = tuple(dict.fromkeys((*added, *delivered.additions)))
        add_project(
            contents,
            named,
            folder,
            project,
            None if attitude is None else _loop_options(attitude),
            real or (delivered.real if check else "") or usual,
            only_ or delivered.only,
            added,
        )
    if check:
        check_folder(folder, named, contents)
        return Result(f"{folder} is as the stand file gives it", meta={"folder": str(folder)}, details=("folder",))
    if programme is not None:
        refuse_overwriting(folder, named, contents, name)
    if project is None and contents.files:
        _warn(named, contents, only_)
    return _deliver(folder, named, contents, stand)


def _refuse_contradictions(
    project: str | None, fmu: Any, programme: Any, motion: Any, servo: Any, attitude: Any, name: str, real: str | None,
    only: tuple[str, ...], added: tuple[str, ...],
) -> None:  # fmt: skip
    """Raise UsageError for options that mean nothing together."""
    from mahovik.out.export.folder import BLOCKS, compiles_programmes

    if fmu is not None and project != "fmu":
        raise UsageError("fmu: only with --project fmu")
    for what, value in (("motion", motion), ("servo", servo), ("name", name if name != "programme" else None)):
        if value is not None and programme is None:
            raise UsageError(f"{what}: needs --programme P.json, which is missing")
    if programme is not None and attitude is not None:
        raise UsageError("programme, attitude: both drive the flywheels; write them into two folders")
    if programme is not None and project is not None and not compiles_programmes(project):
        raise UsageError(f"programme: {project} has no firmware to play it; expected cmake or a board as project")
    if attitude is not None and project in ("fmu", "fuzz", *BLOCKS):
        raise UsageError(f"attitude: needs cmake or a board, not --project {project}")
    if (only or added) and (project in ("fmu", "fuzz", *BLOCKS) or attitude is not None):
        what = "attitude" if attitude is not None else "project"
        raise UsageError(f"{what}: has all functions that it calls; not with --only, --with, --batch")
    if added and project not in (None, "cmake"):
        raise UsageError("with_: a board has the self-test and nothing else")
    if real == "float" and project in BLOCKS:
        raise UsageError(f"real: the block of {project} computes in double, leave it out")


def _default_name(stand: Stand, project: str | None, attitude: Any) -> str:
    parts = [stand.name, *(["attitude"] if attitude is not None else []), *([project] if project else [])]
    return "-".join(parts if project or attitude is None else [*parts, "host"])


def _loop_options(attitude: Any) -> Any:
    """Options of an attitude loop: the name of a task, or settings. Raises UsageError."""
    from mahovik.use.control.attitude import LoopOptions

    settings = {"task": attitude} if isinstance(attitude, str) else dict(attitude)
    known = [field.name for field in fields(LoopOptions)]
    for key, value in settings.items():
        if key not in known:
            raise UsageError(f'attitude: unknown "{key}"{suggestion(key, known)}')
        if key not in ("task", "failure") and isinstance(value, str):
            raise UsageError(f'attitude {key}: expected a number, found "{value}"')
    if settings.get("failure", "none") not in ("coasts", "held", "none"):
        raise UsageError(f'attitude failure: unknown "{settings["failure"]}", expected coasts, held or none')
    return LoopOptions(**settings)


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


def _result(
    title: str, folder: Path, texts: Mapping[str, str | bytes], lines: Sequence[str], ok: bool = True
) -> Result:
    return Result(
        title,
        (
            column("file", "", [str(folder / name) for name in texts]),
            column("lines", "", [text.count("\n") if isinstance(text, str) else 0 for text in texts.values()]),
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
    import json

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


def _fmu(stand: Stand, output: Any, settings: Any, check: bool, progress: Progressing) -> Result:
    """Write the FMU, or compare what a file holds. Raises UsageError, CheckError, ToolchainError."""
    import io
    import zipfile

    from mahovik.core.stand.units import TIME
    from mahovik.out.export.fmu import export_fmu
    from mahovik.use.simulate.case import load_start

    chosen: dict[str, Any] = {"start": None, "dt": 1e-4, **{key: words[0] for key, words in FMU.items()}}
    for key, value in (settings if isinstance(settings, Mapping) else {settings: ""} if settings else {}).items():
        if key not in chosen:
            raise UsageError(f'fmu: unknown "{key}"{suggestion(str(key), chosen)}')
        if key in FMU and str(value) not in FMU[key]:
            raise UsageError(f'fmu {key}: unknown "{value}"{suggestion(str(value), FMU[key])}')
        chosen[key] = quantity("fmu dt", value, TIME, 1e-9, 10.0) if key == "dt" else str(value)
    if chosen["kind"] == "me" and isinstance(settings, Mapping) and "dt" in settings:
        raise UsageError("fmu dt: model exchange has no internal step, the tool integrates")
    target = Path(output) if output is not None else Path(f"{stand.name}.fmu")
    if target.suffix != ".fmu":
        target = target / f"{stand.name}.fmu"
    start = None if chosen["start"] is None else reading("state", Path(chosen["start"]), load_start, stand)
    if not check:
        probe(target)
    notify(progress, Progress(f"FMU of {stand.name}"))
    binary = chosen["binary"] == "yes" and not check
    made = export_fmu(stand, chosen["kind"], chosen["inputs"], chosen["dt"], start, binary)
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
    if start is None:
        warn_of_turn(stand)
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
