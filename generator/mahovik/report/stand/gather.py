"""Reads what a report is made from, and refuses what is of another stand."""

from __future__ import annotations

from pathlib import Path

from mahovik.errors import UsageError
from mahovik.motion.programme import load_programme
from mahovik.motion.required import load_motion
from mahovik.report.plot.run import SUFFIXES, read
from mahovik.report.stand.material import Material
from mahovik.report.stand.run import Run
from mahovik.stand.model import Stand
from mahovik.stand.random_state import random_state
from mahovik.verify.programme.identity import motion_finding, stand_finding


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
    """The material of a report. Raises UsageError, ProgrammeError, MotionError; nothing is computed yet."""
    if motion_file is not None and programme_file is None:
        raise UsageError("--motion: goes with --programme")
    run = None if run_file is None else _run(Path(run_file), stand)
    programme = None if programme_file is None else load_programme(programme_file)
    motion = None if motion_file is None else load_motion(motion_file, stand)
    if programme is not None:
        findings = [stand_finding(stand, programme)]
        findings += [] if motion is None else [motion_finding(motion, programme)]
        for each in findings:
            if not each.passed:
                raise UsageError(f"--programme {programme_file}: {each.words}")
    import numpy as np

    state = random_state(stand, np.random.default_rng(1)) if run is None else run.state(-1)
    return Material(
        stand,
        state,
        "a random one" if run is None else f"the last row of {run.source}",
        Path(stand_file).name,
        run,
        programme,
        "" if programme_file is None else Path(programme_file).name,
        motion,
        "" if motion_file is None else Path(motion_file).name,
        None if cost_folder is None else Path(cost_folder),
        targets or "",
    )


def _run(path: Path, stand: Stand) -> Run:
    if path.suffix not in SUFFIXES:
        raise UsageError(f"--run {path}: expected a name that ends in {' or '.join(SUFFIXES)}")
    return Run(path.name, tuple(s.name for s in stand.flywheels), read(path))
