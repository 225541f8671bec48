"""A run of `mahovik simulate` as a report needs it: arrays in the stand's order; runs of other stands are refused."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Hold, Stand, Vec3, Vec6
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import StateError, UsageError
from mahovik.proof import reference
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.scales import scales_of
from mahovik.use.simulate.held import rates

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Run:
    """Columns of a run by their whole names, unit and all: M rows; `flywheels` are the stand's names in its order.

    `source` is the name of its file, without folders.
    """

    source: str
    flywheels: tuple[str, ...]
    columns: Mapping[str, Array]

    @cached_property
    def t(self) -> Array:
        """Times (M), s."""
        return self.columns["t [s]"]

    @cached_property
    def position(self) -> Array:
        """Position of O1 in E0 (M, 3), m."""
        return self._stack([f"{a} [m]" for a in "xyz"])

    @cached_property
    def quaternion(self) -> Array:
        """Attitude of the carrier (M, 4), w first, of x0 = C x1; unit length."""
        found = self._stack(["qw", "qx", "qy", "qz"])
        unit: Array = found / np.linalg.norm(found, axis=1, keepdims=True)
        return unit

    @cached_property
    def V(self) -> Array:
        """Twist of the carrier in E1 (M, 6), linear part first; m/s, rad/s."""
        return self._stack([*(f"v_{a} [m/s]" for a in "xyz"), *(f"omega_{a} [rad/s]" for a in "xyz")])

    @cached_property
    def V_dot(self) -> Array | None:
        """Derivative of its components (M, 6); m/s2, rad/s2. None: a run that follows a programme does not have it."""
        names = [*(f"v_dot_{a} [m/s2]" for a in "xyz"), *(f"omega_dot_{a} [rad/s2]" for a in "xyz")]
        return self._stack(names) if names[0] in self.columns else None

    @cached_property
    def phi(self) -> Array:
        """Phases of the flywheels (M, N), rad."""
        return self._flywheels("phi", "rad")

    @cached_property
    def phi_dot(self) -> Array:
        """Speeds of the flywheels (M, N), rad/s."""
        return self._flywheels("phi_dot", "rad/s")

    @cached_property
    def phi_ddot(self) -> Array | None:
        """Accelerations of the flywheels (M, N), rad/s2. None: a run that follows a programme does not have them."""
        there = all(f"phi_ddot {name} [rad/s2]" in self.columns for name in self.flywheels)
        return self._flywheels("phi_ddot", "rad/s2") if there else None

    @cached_property
    def tau(self) -> Array:
        """Drive torques (M, N), N m."""
        return self._flywheels("tau", "N m")

    @cached_property
    def reaction(self) -> Array | None:
        """Wrench of the hold on the carrier, in E1 about O1 (M, 6; N, N m); None: a free carrier has none."""
        names = [*(f"hold.reaction.{a} [N]" for a in "xyz"), *(f"hold.reaction.{a} [N m]" for a in "kmn")]
        return self._stack(names) if all(name in self.columns for name in names) else None

    def state(self, row: int, hold: Hold | None = None) -> State:
        """The state of a row, to be evaluated; accelerations zero where the run has none. No run-time wrench.

        `hold`: that of the stand, which gives the speeds of the freedoms.
        """
        zeros = (0.0,) * len(self.flywheels)
        found = State(
            position=cast(Vec3, tuple(self.position[row].tolist())),
            angles=None,
            quaternion=cast(Quaternion, tuple(self.quaternion[row].tolist())),
            V=cast(Vec6, tuple(self.V[row].tolist())),
            phi=tuple(np.remainder(self.phi[row], 2 * np.pi).tolist()),
            phi_dot=tuple(self.phi_dot[row].tolist()),
            phi_ddot=zeros if self.phi_ddot is None else tuple(self.phi_ddot[row].tolist()),
            V_dot=(0.0,) * 6 if self.V_dot is None else cast(Vec6, tuple(self.V_dot[row].tolist())),
            tau=tuple(self.tau[row].tolist()),
        )
        return found if hold is None else replace(found, u=rates(hold, found.V), u_dot=rates(hold, found.V_dot))

    def _flywheels(self, kind: str, unit: str) -> Array:
        return self._stack([f"{kind} {name} [{unit}]" for name in self.flywheels])

    def _stack(self, names: Sequence[str]) -> Array:
        if not names:
            return np.zeros((len(self.t), 0))
        return np.stack([self.columns[name] for name in names], axis=1)


AGREES = 1e-6
"""Part of the natural scale: numbers of a run agree better, those of another stand worse."""

UNIT = 1e-6
"""Largest deviation of a quaternion's length from 1."""

_FLYWHEEL, _POINT = re.compile(r"phi_dot (\w+) \[rad/s\]"), re.compile(r"force_x (\w+) \[m/s2\]")


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
    needed = ["t [s]", *(f"{a} [m]" for a in "xyz"), *(f"q{a}" for a in "wxyz")]
    needed += [*(f"v_{a} [m/s]" for a in "xyz"), *(f"omega_{a} [rad/s]" for a in "xyz")]
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
        state = run.state(row, stand.hold)
        given: dict[str, tuple[Any, str]] = {"torque": (run.tau[row], "tau")}
        if not pushed:
            given["forward"] = (run.V_dot[row], "V_dot")
        for want, (found, quantity) in given.items():
            try:
                at = reference.pieces(stand, state)
                expected = reference.evaluate(stand, state, [want], at)[quantity]
                natural = scales_of(stand, state, want)[quantity]
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
