"""Input of the sections of a report, read from files, and what a section is; files of another stand are refused."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.motion.programme import Programme, load_programme
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.errors import UsageError
from mahovik.out.report.plot.run import SUFFIXES, identity, read
from mahovik.out.report.stand.run import Run, refuse_foreign_run
from mahovik.proof.cost.page import read_accepted_costs
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.verify.delivery import FIGURES
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.proof.verify.targets import parse_targets
from mahovik.use.simulate.held import home, move
from mahovik.writing import format_of


@dataclass(frozen=True, eq=False)
class Material:
    """A stand with the other inputs of the report. Files are named without folders: `..._file`, "" if not given.

    state, state_words   at which matrices are shown, and which state that is, in words
    run          of this stand; None: none was given
    programme, motion    of this stand; a motion goes with a programme
    costs        figures of `mahovik cost` for this stand, a target each, as its JSON holds them; none were given: ()
    cost_file    its name
    targets      of `--targets`: processors on which the self-test is run now; "" for none
    """

    stand: Stand
    state: State
    state_words: str
    stand_file: str = ""
    run: Run | None = None
    programme: Programme | None = None
    programme_file: str = ""
    motion: RequiredMotion | None = None
    motion_file: str = ""
    costs: tuple[Mapping[str, Any], ...] = ()
    cost_file: str = ""
    targets: str = ""


@dataclass(frozen=True)
class Section:
    """One section: `anchor` is its id in the page, `html` trusted markup in which all text is escaped already.

    failures   what it shows as failed, a line each: the page says so at its top, and the command's status is 1
    summary    what the head of the page says of it, in a few words; "" for nothing
    """

    anchor: str
    title: str
    html: str
    failures: tuple[str, ...] = ()
    summary: str = ""


@lru_cache(maxsize=4)
def generate_once(stand: Stand, real: str = "double") -> Generated:
    """Program, numbers and C text of a stand by element type. Raises StandError."""
    return generate_all(stand, real)


WORDS = (
    "a chosen state: the carrier moves and is turned; phases are 0.7 rad apart, every flywheel keeps its motor's "
    "no-load speed, else 3000 rpm"
)

HELD_WORDS = (
    "a chosen state: each freedom is off the home pose and moves; phases are 0.7 rad apart, every flywheel keeps its "
    "motor's no-load speed, else 3000 rpm"
)

CLAMPED_WORDS = (
    "a chosen state of the clamped carrier: phases are 0.7 rad apart, every flywheel keeps its motor's no-load speed, "
    "else 3000 rpm"
)

_APART = 0.7

_TURNED, _MOVED = 0.3, 0.02  # rad, m: from the home pose

FREE_SPEEDS = (0.3, -0.2, 0.4, 0.1, -0.15, 0.2)
"""m/s or rad/s: speeds of the freedoms of a held carrier in the chosen state."""

STILL = 1e-9
"""m/s and rad/s: a carrier slower than this, with flywheels at rest, moves by rounding alone."""


def choose_state(stand: Stand, run: Run | None) -> tuple[State, str]:
    """The last row of the run, and words that say so; the chosen state without a run, or where all is at rest there.

    At rest `M`, `K*`, `J` and `D` are zero but for rounding, which would be shown as if it were their structure.
    """
    words = WORDS if stand.hold is None else HELD_WORDS if stand.hold.freedoms else CLAMPED_WORDS
    if run is None:
        return chosen_state(stand), words
    last, row = run.state(-1, stand.hold), f"the last row of the run, t = {run.t[-1]:.6g} s"
    if not any(last.phi_dot) and max(map(abs, last.V)) < STILL:
        return chosen_state(stand), f"{row}, is at rest; shown instead: {words}"
    return last, row


def chosen_state(stand: Stand) -> State:
    """A fixed state for a stand: attitude away from the singularity of every sequence, flywheels at speed."""
    rows = summarize(stand).unbalance
    state = State(
        position=(0.0, 0.0, 0.0),
        angles=(0.3, 0.4, 0.2),
        quaternion=None,
        V=(0.1, -0.2, 0.15, 0.3, -0.2, 0.4),
        phi=tuple(math.remainder(_APART * i, 2 * math.pi) for i in range(len(rows))),
        phi_dot=tuple(row.speed for row in rows),
        phi_ddot=(0.0,) * len(rows),
        V_dot=(0.0,) * 6,
        tau=(0.0,) * len(rows),
    )
    return state if stand.hold is None else _held_state(stand, stand.hold, state)


def _held_state(stand: Stand, hold: Hold, state: State) -> State:
    """The state with a pose and a twist that the hold allows."""
    at_home, u = home(stand), FREE_SPEEDS[: len(hold.freedoms)]
    way = [_MOVED if each.kind == "slide" else _TURNED for each in hold.freedoms]
    moved = move(at_home, carrier_rotation(stand, at_home), np.array(twist_of(hold, way)))
    none = (0.0,) * len(u)
    return replace(
        state,
        position=moved.position, angles=None, quaternion=moved.quaternion, V=twist_of(hold, u), u=u, u_dot=none,
    )  # fmt: skip


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
        parse_targets(targets)
    run = None if run_file is None else _run(Path(run_file), stand)
    programme = None if programme_file is None else load_programme(programme_file)
    motion = None if motion_file is None else load_motion(motion_file, stand, programme)
    if programme is not None and programme_file is not None:
        _refuse_foreign_programme(programme_file, stand, programme, motion)
    costs = () if cost_folder is None else _costs(Path(cost_folder), stand)
    state, words = choose_state(stand, run)
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
    if format_of(path, SUFFIXES) is None:
        raise UsageError(f"--run {path}: expected a name that ends in {' or '.join(SUFFIXES)}")
    run = Run(path.name, tuple(s.name for s in stand.flywheels), read(path))
    refuse_foreign_run(stand, run, identity(path), f"--run {path}")
    return run


def _costs(folder: Path, stand: Stand) -> tuple[Mapping[str, Any], ...]:
    """The accepted figures in a folder of generated C."""
    if not folder.is_dir():
        raise UsageError(f"--cost {folder}: no such folder; expected one of `mahovik cost`, with {FIGURES}")
    whole = read_accepted_costs(folder, stand)
    if whole is None:
        raise UsageError(f"--cost {folder}: has no {FIGURES}: `mahovik cost` measures and writes it")
    own = identities(stand)
    for key, ours in (("structure", own.structure), ("physics", own.physics)):
        if whole.get(key) != ours:
            raise UsageError(
                f"--cost {folder}: figures of another stand: {key} is {whole.get(key)}, of the stand {ours}"
            )
    return tuple(whole["targets"])


def _refuse_foreign_programme(source: str, stand: Stand, programme: Programme, motion: RequiredMotion | None) -> None:
    owners = [stand_check(stand, programme)]
    owners += [] if motion is None else [motion_check(motion, programme)]
    for owner in owners:
        if owner.failed:
            raise UsageError(f"--programme {source}: {owner.words}")
