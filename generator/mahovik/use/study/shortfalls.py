"""Demands that a stand's flywheels do not reach, and effects of unbalance that float does not resolve.

Demands are small ones on the carrier, of (12) as a whole and of the tasks of a stand. Far more than any motor has means
that (12) is singular in practice; a direction that no flywheel moves is out of reach.

The effect of a flywheel's unbalance on a result is the difference from a balanced and symmetric flywheel, by the
reference in double. The rounding of float is FACTOR units (2^-24) of the scale of the result, which is measured: what
it changes by where every number of stand and state changes a little. If the rounding is more than half of the effect in
every component, float cannot show the unbalance reliably, even with correct C. Flywheels have given speeds and some
phases: with the carrier at rest, where the unbalance stands beside weight and suspension, and moving by 1 m/s and
1 rad/s about every axis, where gyroscopic terms stand beside it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.contract.limits import PERTURBATIONS
from mahovik.core.stand.coordinates import row_name
from mahovik.core.stand.model import COMPONENTS, Flywheel, Stand, State, Task, TaskRow, Vec6, rest_state
from mahovik.proof import reference
from mahovik.proof.reference import pieces
from mahovik.proof.reference.algebra import Array, times
from mahovik.proof.reference.evaluate import held_state
from mahovik.proof.reference.inverse import CUTS, TaskRows, least_error, scaled_task, shares_of, task_rows, weights
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import (
    Bodies,
    Pieces,
    bodies_of,
    coupling,
    coupling_bias,
    mass_matrices,
    mass_matrix_rates,
    momentum,
    velocity_matrix,
)
from mahovik.proof.verify.scales import Scales
from mahovik.use.simulate.held import home

WHOLE = Task("", tuple(TaskRow("", component) for component in COMPONENTS))
"""(12) as a whole, a task of all six components of V*."""

_NEGLIGIBLE = 1e-3
"""Parts of a direction below this are not named."""

SMALL = 1e-3
"""m/s2, rad/s2: what is demanded of one row, of the others zero."""

POSITIONS = 5
"""Positions of the flywheels, at rest, over which the median is taken."""

_SEED = 20


@dataclass(frozen=True)
class Shortfall:
    """A direction of a demand that the flywheels cannot give, or not with what they have.

    task       its name; "" of (12) as a whole
    rows       names of its rows
    direction  of the demand (m, unit length): m/s2 and rad/s2
    flywheel   that needs most; "" where no flywheel helps
    share      of what it has, for a demand of SMALL; infinite where no flywheel helps
    """

    task: str
    rows: tuple[str, ...]
    direction: tuple[float, ...]
    flywheel: str
    share: float

    def __str__(self) -> str:
        parts = [(x, row) for x, row in zip(self.direction, self.rows, strict=True) if abs(x) > _NEGLIGIBLE]
        words = parts[0][1] if len(parts) == 1 else " ".join(f"{x:+.3g} {row}" for x, row in parts)
        if not self.flywheel:
            return (
                f"task {self.task}: no flywheel moves the carrier along {words} (UNREACHABLE); remove a row, "
                "or add or turn a flywheel"
            )
        needs = f"{SMALL:g} m/s2 or rad/s2 along {words} alone needs {self.share:.3g} times what {self.flywheel} has"
        if self.task:
            return f"task {self.task}: {needs} (EXCESSIVE); remove the row, or add or turn a flywheel"
        return (
            f"(12) is singular in practice: {needs} (EXCESSIVE); name the rows that you need, "
            '[task.pointing] rows = ["wx", "wy", "wz"], and ask the task'
        )


def excess(stand: Stand) -> Shortfall | None:
    """What (12) needs most for a small demand, if this is more than there is in most positions; else None.

    None of a held carrier, which (12) does not ask for all six components, nor of a stand whose tasks name what is
    asked.
    """
    if not stand.flywheels or stand.hold is not None or stand.tasks:
        return None
    return next(_shortfalls(stand, [WHOLE]), None)


def task_shortfalls(stand: Stand) -> list[Shortfall]:
    """At most one of each task: a direction out of reach at all tried positions, else the row that needs most.

    At rest, at seeded positions of the flywheels; a row needs too much if it does in most of them.
    """
    return list(_shortfalls(stand, stand.tasks))


def _shortfalls(stand: Stand, tasks: Sequence[Task]) -> Iterator[Shortfall]:
    """Those of some tasks; of (12) as a whole without directions out of reach, which few flywheels always leave."""
    bodies, rng, still, n = bodies_of(stand), np.random.default_rng(_SEED), rest_state(stand), len(stand.flywheels)
    phases = [tuple(rng.uniform(-np.pi, np.pi, n)) for _ in range(POSITIONS)]
    places = [pieces(stand, replace(still, phi=phi), bodies) for phi in phases] if tasks else []
    for task in tasks:
        rows, names = [task_rows(at, stand, task) for at in places], tuple(map(row_name, task.rows))
        missing = [_missing(at, row) for at, row in zip(places, rows, strict=True)] if task.name else [None]
        if missing[0] is not None and all(vector is not None for vector in missing):
            yield Shortfall(task.name, names, tuple(map(float, missing[0])), "", np.inf)
            continue
        needs = [_needed_share(stand, at, row) for at, row in zip(places, rows, strict=True)]
        needed = np.sort(needs, axis=0)[POSITIONS // 2]  # np.median would import numpy.ma
        i, s = divmod(int(np.argmax(needed)), n)
        if needed[i, s] > 1.0:
            direction = tuple(float(i == k) for k in range(len(names)))
            yield Shortfall(task.name, names, direction, stand.flywheels[s].name, float(needed[i, s]))


def _missing(at: Pieces, rows: TaskRows) -> Array | None:
    """The demand (m, unit length, largest part positive) that is least reached, if it is not reached at all."""
    m = len(rows.S)
    asked = scaled_task(at, rows, np.zeros(m))
    U, sigma, _ = np.linalg.svd(asked.W)
    if len(sigma) == m and sigma[-1] > CUTS.rank:  # sigma is a ratio of energies: 1 would be all of a flywheel's
        return None
    direction = np.linalg.solve(asked.root, U[:, -1])
    largest = direction[np.argmax(np.abs(direction))]
    return np.asarray(np.sign(largest) * direction / np.linalg.norm(direction), dtype=np.float64)


def _needed_share(stand: Stand, at: Pieces, rows: TaskRows) -> Array:
    """Share (m x N) of what each flywheel has, for SMALL of each row, beyond what no demand needs.

    The drive torques are linear in the motion that a flywheel makes: tau = tau_0 + I^T V* + Theta_ff phi''.
    """
    m, none = len(rows.S), np.zeros(len(stand.flywheels))
    scaled, at_rest, of_motors = scaled_task(at, rows, rows.s), torque(at, np.zeros(6), none), weights(stand)
    still = least_error(scaled, of_motors).phi_ddot

    def shares(demand: Array) -> Array:
        phi_ddot = least_error(replace(scaled, c=scaled.c - demand), of_motors).phi_ddot - still
        tau = at_rest + at.I.T @ forward(at, phi_ddot) + np.diag(at.Theta_ff) * phi_ddot
        return shares_of(stand, at, tau, phi_ddot)

    return np.array([shares(SMALL * unit) for unit in np.eye(m)])


UNIT = 2.0**-24
"""Largest relative error of one rounding in float."""

FACTOR = 32.0
"""Most units of rounding in a result, of its scale."""

PART = 0.5
"""Largest part of an effect that rounding may reach while the effect still shows."""

DOUBLE_NOISE = 1e-13
"""Part of the scale: a smaller effect is rounding of the reference, from a flywheel without unbalance."""

FEW, CLEARLY = 4, 10.0
"""Neighbours by which scales are first measured, and how far above rounding all effects are then surely resolved."""

PHASES = 2
"""Phases a quarter turn apart, so that no component of a turning vector is missed; half a turn on is the opposite."""

MOTIONS: Mapping[str, Vec6] = {"at rest": (0.0,) * 6, "moving by 1 m/s and 1 rad/s": (1.0,) * 6}
"""Motions V of the carrier, of a held one u, by their words in messages."""

QUANTITIES = {
    "forward": ("V_dot", "the carrier's acceleration V_dot"),
    "momentum": ("Z", "the momentum Z"),
    "mounts": ("mount_wrench", "the wrench of its mount"),
}
"""Keys and words of results by want of `eval`. Drive torques are left out: they need not show an unbalance."""


@dataclass(frozen=True)
class Unresolved:
    """A quantity in which float does not show the unbalance of a flywheel.

    flywheel, speed  its name, rad/s
    want, words      name in `eval`, and description
    motion           of the carrier, in words
    effect, rounding of the component that shows most; SI
    """

    flywheel: str
    speed: float
    want: str
    words: str
    motion: str
    effect: float
    rounding: float

    def __str__(self) -> str:
        return (
            f"float: the unbalance of {self.flywheel} at {self.speed * 30 / math.pi:.5g} rpm changes {self.words} by "
            f"{self.effect:.1e}, and float rounds it by up to {self.rounding:.1e} (carrier {self.motion}): "
            "generate double for it"
        )


def balanced_flywheel(flywheel: Flywheel) -> Flywheel:
    """The same flywheel without unbalance or asymmetry: mass centre on its axis, inertia of revolution."""
    J = flywheel.inertia
    across = 0.5 * (J[1][1] + J[2][2])
    return replace(
        flywheel,
        center_of_mass=(flywheel.center_of_mass[0], 0.0, 0.0),
        inertia=((J[0][0], 0.0, 0.0), (0.0, across, 0.0), (0.0, 0.0, across)),
    )


def shortfalls(stand: Stand, speeds: Sequence[float]) -> list[Unresolved]:
    """Quantities that float does not resolve with flywheels at these speeds (rad/s); one per flywheel and want."""
    if not stand.flywheels or not _unresolved(stand, speeds, FEW, CLEARLY):
        return []
    return _unresolved(stand, speeds, PERTURBATIONS, 1.0)


def _unresolved(stand: Stand, speeds: Sequence[float], neighbours: int, margin: float) -> list[Unresolved]:
    """Quantities with an effect below rounding times a margin, by scales that are measured with so many neighbours."""
    result: dict[tuple[int, str], Unresolved] = {}
    scales = Scales(stand, "float", neighbours=neighbours)
    balanced = replace(stand, flywheels=tuple(map(balanced_flywheel, stand.flywheels)))
    balanced_bodies = bodies_of(balanced)
    for motion in MOTIONS:
        best = {want: np.tile((0.0, np.inf), (len(speeds), 1)) for want in QUANTITIES}
        for state in states(stand, speeds, motion):
            for want, effects in _effects(scales, state, balanced, balanced_bodies).items():
                better = effects[:, 0] / effects[:, 1] > best[want][:, 0] / best[want][:, 1]
                best[want][better] = effects[better]
        for want, rows in best.items():
            for number, (effect, rounding) in enumerate(rows.tolist()):
                if 0.0 < effect * PART < margin * rounding:
                    name, words = stand.flywheels[number].name, QUANTITIES[want][1]
                    result[number, want] = Unresolved(name, speeds[number], want, words, motion, effect, rounding)
    return [result[key] for key in sorted(result)]


def _effects(scales: Scales, state: State, balanced: Stand, balanced_bodies: Bodies) -> dict[str, Array]:
    """Effect of each flywheel's unbalance and rounding (Nx2) by want, in the component that shows it best."""
    effects = {}
    with np.errstate(all="ignore"):
        balanced_pieces = reference.pieces(balanced, state, balanced_bodies)
        changed = with_one_balanced(scales.at(state), balanced_pieces)
    for want, (key, _) in QUANTITIES.items():
        measured = scales.want(state, want)
        if measured is None:
            continue  # a law is undefined: not a state of the stand
        value, size = np.array(measured.values[key]), np.array(measured.scales[key])
        if want == "mounts":  # each by the accelerations given and its own flywheel
            balanced_values = np.array(reference.evaluate(balanced, state, [want], balanced_pieces)[key])
        else:
            balanced_values = changed[want]
        change = np.abs(balanced_values - value)
        sizes = np.broadcast_to(size, change.shape)
        at = np.argmax(change / np.maximum(sizes, 1e-300), axis=1)
        effect, size = (np.take_along_axis(x, at[:, None], axis=1)[:, 0] for x in (change, sizes))
        seen = effect > DOUBLE_NOISE * size
        effects[want] = np.stack([np.where(seen, effect, 0.0), np.where(seen, FACTOR * UNIT * size, np.inf)], axis=1)
    return effects


def with_one_balanced(at: Pieces, balanced: Pieces) -> dict[str, Array]:
    """V_dot of (8) and momentum (Nx6 each) with one flywheel after the other as in `balanced`, the rest as in `at`.

    Flywheels add up in K, K*, J phi' and F. None accelerates.
    """
    wheels = at.bodies.flywheels
    change = replace(wheels, Theta=balanced.bodies.flywheels.Theta - wheels.Theta)
    K, K_dot = mass_matrices(change), mass_matrix_rates(change)
    turning = wheels.phi_dot[:, None]
    F = times(wheels.L, balanced.P_s - at.P_s)
    changed_bias = times(velocity_matrix(K, K_dot, at.V), at.V) + coupling_bias(change, at.V).T * turning
    K_changed, pull = at.K + K, at.F - at.bias + F - changed_bias
    mass = at.S.T @ K_changed @ at.S  # of u_dot, V_dot = S u_dot
    unit = 1.0 / np.sqrt(np.abs(np.diagonal(mass, axis1=1, axis2=2)))  # it is scaled to a unit diagonal
    scaled = mass * unit[:, :, None] * unit[:, None, :]
    asked = unit * (pull @ at.S)
    u_dot = unit * np.linalg.solve(scaled, asked[..., None])[..., 0]
    return {
        "forward": u_dot @ at.S.T,
        "momentum": momentum(at) + times(K, at.V) + coupling(change).T * turning,
    }


def states(stand: Stand, speeds: Sequence[float], motion: str) -> Iterator[State]:
    """States at some phases; neighbouring flywheels differ by a tenth of a radian, so that they do not cancel."""
    count = len(stand.flywheels)
    for k in range(PHASES):
        phases = tuple(0.3 + 0.1 * s + k * math.pi / 2 for s in range(count))
        state = replace(home(stand), phi=phases, phi_dot=tuple(speeds), V=MOTIONS[motion])
        yield held_state(stand, replace(state, u=state.V[: len(state.u)]))


def shortfalls_line(short: Sequence[Unresolved]) -> str:
    """One line on all quantities that float does not resolve; empty without any."""
    return f"{short[0]}{f' (and {len(short) - 1} more)' if len(short) > 1 else ''}" if short else ""
