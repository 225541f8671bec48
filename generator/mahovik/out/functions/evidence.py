"""`generate`: the C of a stand. `verify`: C against the reference."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.contract.functions import ALL
from mahovik.core.stand import load as load_file
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.errors import UsageError
from mahovik.nearest import names_in
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import StandGiven
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell, warn

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel
    from mahovik.proof.diagnose.diagnosis import Diagnosis
    from mahovik.proof.verify.check import Report


COMPARED = ("value", "second")
"""Columns of a verification with differences from the reference: of what is judged, of the second derivation."""


class Verification(Table):
    """Verdict on C or on a program: a row per quantity, with differences relative to its natural scale.

    `passed`: something was compared, and nothing failed. `diagnosis` names the fault where `judge` was asked for it.
    """

    def __init__(self, result: Report, diagnosis: Diagnosis | None = None) -> None:
        self.result, self.diagnosis = result, diagnosis

    @property
    def columns(self) -> tuple[Column, ...]:
        rows = self.result.rows

        def numbers(values: Sequence[float | None]) -> Any:
            return np.array([np.nan if x is None else x for x in values])

        return (
            Column("judged", "", np.array([row.judged for row in rows], dtype=object)),
            Column("quantity", "", np.array([row.quantity for row in rows], dtype=object)),
            Column("states", "", np.array([row.states for row in rows])),
            Column("value", "", numbers([row.value for row in rows])),
            Column("second", "", numbers([row.second for row in rows])),
            Column("limit", "", numbers([row.limit for row in rows])),
            Column("verdict", "", np.array([row.verdict for row in rows], dtype=object)),
        )

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.shares import shares

        return [shares("difference", {name: self[name] for name in COMPARED}, self["limit"])]

    @property
    def passed(self) -> bool:
        """Whether something was compared and nothing failed."""
        return self.result.passed

    @property
    def conclusion(self) -> str:
        """The verdict in one line."""
        from mahovik.proof.verify.check import conclusion

        return conclusion(self.result)

    @property
    def explanation(self) -> tuple[str, ...]:
        """The diagnosis in sentences; none without one."""
        if self.diagnosis is None:
            return ()
        from mahovik.proof.diagnose.diagnosis import sentences

        return tuple(sentences(self.diagnosis))

    def to_dict(self) -> dict[str, Any]:
        """All of it, as `mahovik verify --json` prints it."""
        from mahovik.proof.verify.check import as_json

        found: dict[str, Any] = json.loads(as_json(self.result, self.more()))
        return found

    def more(self) -> dict[str, Any]:
        """What `mahovik judge --json` prints besides the rows."""
        if self.diagnosis is None:
            return {}
        from mahovik.proof.diagnose.diagnosis import as_object

        return {"diagnosis": as_object(self.diagnosis)}

    def __repr__(self) -> str:
        return f"<Verification of {self.result.stand}: {self.conclusion}>"


def verify(
    stand: StandGiven,
    *,
    states: int = 200,
    seed: int = 1,
    against: str | Path | None = None,
    real: str | None = None,
    judges: bool = False,
    progress: OnProgress | None = None,
) -> Verification:
    """Judge the generated C by the literal reference and the second derivation, at random and extreme states.

    against      folder of the C to judge; None: a fresh copy
    real         "double" or "float"; None: that of the folder, else double
    judges       judge by Pinocchio and MuJoCo instead, without the laws that they do not have

    Raises StandError, ToolchainError where it does not compile, CheckError where it is of another stand.
    """
    from mahovik.proof.second.reading import load_tables
    from mahovik.proof.verify.delivery import Options, delivered_options, stand_in
    from mahovik.proof.verify.harness import verify_c

    own: CoreStand = Stand.of(stand)
    document = load_tables(Path(stand)) if isinstance(stand, str | Path) else Stand.of(stand).to_dict()
    folder, words = None if against is None else Path(against), f"verify {own.name}"
    if judges and folder is not None:
        raise UsageError("--judges judges a fresh copy: not with --with, --against")
    if folder is not None:
        own, real = stand_in(folder, own), real or (delivered_options(folder) or Options()).real
    real = real or "double"

    def on_state(done: float, *_: object) -> None:
        tell(progress, Progress(words, done, states))

    if judges:
        from mahovik.proof.verify.judges import verify_judges

        return Verification(verify_judges(own, seed=seed, count=states, progress=on_state))
    found = verify_c(own, seed=seed, count=states, against=folder, real=real, progress=on_state, document=document)
    return Verification(found)


class Generated(Table):
    """The files of a stand's C: a row per file. `files` are their texts by name; `folder`: where they were written."""

    index = "file"

    def __init__(self, stand: CoreStand, files: Mapping[str, str], folder: Path | None, notes: Sequence[str]) -> None:
        self.stand, self.files, self.folder, self.notes = stand, dict(files), folder, tuple(notes)

    @property
    def columns(self) -> tuple[Column, ...]:
        return (
            Column("file", "", np.array(list(self.files), dtype=object)),
            Column("lines", "", np.array([text.count("\n") for text in self.files.values()])),
            Column("bytes", "", np.array([len(text.encode()) for text in self.files.values()])),
        )

    def __repr__(self) -> str:
        where = "" if self.folder is None else f" in {self.folder}"
        return f"<Generated C of {self.stand.name}: {len(self.files)} files{where}>"


def generate(
    stand: StandGiven,
    folder: str | Path | None = None,
    *,
    real: str = "double",
    batch: bool = False,
    only: str | Sequence[str] = (),
    additions: str | Sequence[str] = (),
    prefix: str | None = None,
    progress: OnProgress | None = None,
) -> Generated:
    """Derive and write the C of a stand, a complete folder; `folder` None: nothing is written.

    real       "double" or "float"; batch: also functions for many states
    only       these public functions and what they need, names or a text with commas; (): the default ones; "all"
    additions  "selftest", "recorder", "eva", "batch", "encoder": likewise, what `--with` adds
    prefix     the first word of every name in C, in place of the stand's name

    Raises StandError, UsageError; nothing is written over files of others.
    """
    from mahovik.core.emit.delivery import delivery
    from mahovik.proof.verify.delivery import deliver, provenance, with_prefix

    own = load_file(stand) if isinstance(stand, str | Path) else stand  # of a held carrier too
    own = with_prefix(own, prefix)
    tell(progress, Progress(f"generate {own.name}"))
    chosen, added = names_in("only", only, ALL), names_in("additions", additions)
    files = delivery(own, real, chosen, tuple(dict.fromkeys((*added, *(["batch"] if batch else [])))))
    if folder is None:
        return Generated(own, files, None, ())
    if real == "float":
        _warn_of_float(own)
    _warn_of_tasks(own)
    if not own.tasks and (not chosen or any(name.startswith(("inverse", *ALL)) for name in chosen)):
        _warn_of_excess(own)
    text = content(Path(stand)) if isinstance(stand, str | Path) else None
    done = deliver(Path(folder), own, files, made_by=provenance(text))
    written = {path.relative_to(Path(folder)).as_posix(): path.read_text(encoding="utf-8") for path in done.paths}
    return Generated(own, written, Path(folder), done.notes)


def _warn_of_float(stand: CoreStand) -> None:
    """Warn of what float does not resolve, or loses in short steps, at the motors' speeds, as `mahovik check` does."""
    from mahovik.core.stand.summary import summarize
    from mahovik.use.study.increments import USUAL_STEP, lost_increments, lost_increments_line
    from mahovik.use.study.resolution import shortfalls, shortfalls_line

    speeds = [row.speed for row in summarize(stand, None).unbalance]
    if short := shortfalls(stand, speeds):
        warn(shortfalls_line(short))
    if lost := lost_increments(stand, speeds, USUAL_STEP):
        warn(lost_increments_line(lost))


def _warn_of_tasks(stand: CoreStand) -> None:
    """Warn of tasks that the flywheels do not reach, as `mahovik check` does."""
    from mahovik.use.study.task_reach import task_shortfalls

    for short in task_shortfalls(stand):
        warn(str(short))


def _warn_of_excess(stand: CoreStand) -> None:
    """Warn where (12) is singular in practice, as `mahovik check` does."""
    from mahovik.use.study.excess import excess

    if (found := excess(stand)) is not None:
        warn(str(found))
