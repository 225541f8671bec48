"""Reads what a report is made from, and refuses what is of another stand."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mahovik.core.motion.programme import Programme, load_programme
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.out.report.plot.run import SUFFIXES, identity, read
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.run import Run
from mahovik.out.report.stand.run_of_stand import refuse_foreign_run
from mahovik.out.report.stand.state import state_shown
from mahovik.proof.cost.page import accepted
from mahovik.proof.verify.cost_files import FIGURES
from mahovik.proof.verify.delivery import accepted_figures
from mahovik.proof.verify.programme.identity import motion_finding, stand_finding
from mahovik.proof.verify.targets import asked


def gather(
    stand: Stand,
    stand_file: str,
    *,
    run_file: str | None = None,
    programme_file: str | None = None,
    motion_file: str | None = None,
    cost_folder: str | None = None,
    targets: str | None = None,
) -> Material:
    """The material of a report; nothing is computed yet.

    Raises UsageError, ProgrammeError, MotionError: a file that cannot be read, that is none of its kind, or that is of
    another stand or motion.
    """
    if motion_file is not None and programme_file is None:
        raise UsageError(f"--motion {motion_file}: goes with --programme P.json, which is missing")
    if targets is not None:
        asked(targets)
    run = None if run_file is None else _run(Path(run_file), stand)
    programme = None if programme_file is None else load_programme(programme_file)
    motion = None if motion_file is None else load_motion(motion_file, stand)
    if programme is not None and programme_file is not None:
        _refuse_foreign_programme(programme_file, stand, programme, motion)
    costs = () if cost_folder is None else _costs(Path(cost_folder), stand)
    state, words = state_shown(stand, run)
    return Material(
        stand=stand,
        state=state,
        state_words=words,
        stand_file=Path(stand_file).name,
        run=run,
        programme=programme,
        programme_file=_name(programme_file),
        motion=motion,
        motion_file=_name(motion_file),
        costs=costs,
        cost_file="" if cost_folder is None else FIGURES,
        targets=targets or "",
    )


def _name(path: str | None) -> str:
    return "" if path is None else Path(path).name


def _run(path: Path, stand: Stand) -> Run:
    if path.suffix not in SUFFIXES:
        raise UsageError(f"--run {path}: expected a name that ends in {' or '.join(SUFFIXES)}")
    run = Run(path.name, tuple(s.name for s in stand.flywheels), read(path))
    refuse_foreign_run(stand, run, identity(path), f"--run {path}")
    return run


def _costs(folder: Path, stand: Stand) -> tuple[Mapping[str, Any], ...]:
    """The accepted figures in a folder of generated C."""
    if not folder.is_dir():
        raise UsageError(f"--cost {folder}: no such folder; expected one of `mahovik cost`, with {FIGURES}")
    text = accepted_figures(folder, stand)
    if text is None:
        raise UsageError(f"--cost {folder}: has no {FIGURES}: `mahovik cost` measures and writes it")
    whole = json.loads(text)  # an object of this name, or it would have been refused
    own = identities(stand)
    for key, ours in (("structure", own.structure), ("physics", own.physics)):
        if whole.get(key) != ours:
            raise UsageError(
                f"--cost {folder}: figures of another stand: {key} is {whole.get(key)}, of the stand {ours}"
            )
    return tuple(accepted(text, str(folder / FIGURES), whole.get("lanes", 1)))


def _refuse_foreign_programme(source: str, stand: Stand, programme: Programme, motion: RequiredMotion | None) -> None:
    findings = [stand_finding(stand, programme)]
    findings += [] if motion is None else [motion_finding(motion, programme)]
    for each in findings:
        if not each.passed:
            raise UsageError(f"--programme {source}: {each.words}")
