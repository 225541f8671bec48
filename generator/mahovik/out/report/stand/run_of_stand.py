"""Check that a run belongs to a stand: by its identities, by its columns, and by the equations themselves."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.out.report.stand.run import Run
from mahovik.proof import reference
from mahovik.proof.verify.compare import difference
from mahovik.proof.verify.scales import scales
from mahovik.use.simulate.columns import column_names

AGREES = 1e-6
"""Part of the natural scale: numbers of a run agree better, those of another stand worse."""

UNIT = 1e-6
"""Largest deviation of a quaternion's length from 1."""

_FLYWHEEL, _POINT = re.compile(r"phi_dot (\w+) \[rad/s\]"), re.compile(r"force_x (\w+) \[m/s2\]")
_POSE_AND_TWIST = 14
"""Columns of time, place, attitude and twist: the first ones of any run."""


def refuse_foreign_run(stand: Stand, run: Run, identity: Mapping[str, str] | None, where: str) -> None:
    """Raises UsageError, `where` in front, for a run of another stand, or a file that is no run of a stand.

    `identity`: name, structure and physics that the file carries; None: it carries none, so that the equations are
    asked whether its numbers are of this stand.
    """
    _refuse_names(stand, run, where)
    _refuse_missing(stand, run, where)
    if identity is not None:
        own = identities(stand)
        ours = {"stand": stand.name, "structure": own.structure, "physics": own.physics}
        for key, value in ours.items():
            if identity.get(key) != value:
                word = "name" if key == "stand" else key
                raise UsageError(f"{where}: run of another stand: {word} is {identity.get(key)}, of the stand {value}")
    elif (words := _disagreement(stand, run)) is not None:
        raise UsageError(f"{where}: run of another stand: {words}")


def _refuse_names(stand: Stand, run: Run, where: str) -> None:
    points = [*(p.name for p in stand.instruments), *(p.name for p in stand.points)]
    has_points = any(_POINT.fullmatch(name) for name in run.columns)
    pairs: list[tuple[str, re.Pattern[str], list[str]]] = [("flywheels", _FLYWHEEL, [s.name for s in stand.flywheels])]
    if has_points or run.V_dot is not None:
        pairs.append(("points", _POINT, points))
    for what, pattern, own in pairs:
        theirs = [match[1] for name in run.columns if (match := pattern.fullmatch(name))]
        if theirs != own:
            raise UsageError(
                f"{where}: run of another stand: its {what} are {', '.join(theirs) or 'none'}, "
                f"of the stand {', '.join(own) or 'none'}"
            )


def _refuse_missing(stand: Stand, run: Run, where: str) -> None:
    needed = column_names(stand, mounts=False)[:_POSE_AND_TWIST]
    kinds = (("phi", "rad"), ("phi_dot", "rad/s"), ("tau", "N m"))
    needed += [f"{kind} {s.name} [{unit}]" for s in stand.flywheels for kind, unit in kinds]
    for name in needed:
        if name not in run.columns:
            raise UsageError(f'{where}: no run of `mahovik simulate`: expected a column "{name}"')
    for name, column in run.columns.items():
        if (bad := np.flatnonzero(~np.isfinite(column))).size:
            words = f'column "{name}", row {bad[0] + 1} of {len(column)}: {column[bad[0]]} is not finite'
            raise UsageError(f"{where}: {words}{f', nor are {bad.size - 1} after it' if bad.size > 1 else ''}")
    if (back := np.flatnonzero(np.diff(run.t) <= 0.0)).size:
        row = int(back[0]) + 1
        raise UsageError(
            f'{where}: column "t [s]", row {row + 1} of {len(run.t)}: {run.t[row]:.9g} after {run.t[row - 1]:.9g}; '
            "expected times that increase"
        )
    length = np.sqrt(sum(run.columns[name] ** 2 for name in ("qw", "qx", "qy", "qz")))
    if (off := np.flatnonzero(np.abs(length - 1.0) > UNIT)).size:
        raise UsageError(
            f"{where}: columns qw, qx, qy, qz, row {off[0] + 1} of {len(length)}: of length {length[off[0]]:.6g}; "
            "expected a unit quaternion"
        )


def _disagreement(stand: Stand, run: Run) -> str | None:
    """What of (8), or of the drive torques, the numbers of the run contradict; None: nothing, or they cannot tell.

    A body that takes a run-time wrench is left out, since a run does not tell its wrenches.
    """
    if run.V_dot is None or run.phi_ddot is None:
        return None
    pushed = any(body.wrench_input for body in stand.bodies)
    for row in dict.fromkeys((0, len(run.t) // 2, len(run.t) - 1)):
        state = run.state(row)
        given: dict[str, tuple[Any, str]] = {"torque": (run.tau[row], "tau")}
        if not pushed:
            given["forward"] = (run.V_dot[row], "V_dot")
        for want, (found, quantity) in given.items():
            try:
                at = reference.pieces(stand, state)
                expected = reference.evaluate(stand, state, [want], at)[quantity]
                natural = scales(stand, state, at, want)[quantity]
            except (StateError, np.linalg.LinAlgError):
                return None
            keep = [i for i, s in enumerate(stand.flywheels) if not s.wrench_input] if want == "torque" else slice(None)
            off, _ = difference(found[keep], expected[keep], natural[keep])
            if off > AGREES:
                what = "the acceleration of its carrier" if want == "forward" else "a drive torque"
                return (
                    f"{what} at t = {run.t[row]:.6g} s is not that of the stand, {off:.1e} of its natural scale apart"
                )
    return None
