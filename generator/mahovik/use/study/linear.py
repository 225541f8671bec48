"""A, B, C, D: evolution of small deviations from a motion of the whole system, with exact derivatives; and its modes.

Channels name states, inputs and outputs; an output is the displacement of a point of the carrier from that motion.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mahovik.core.stand.hold import closing_words, freedom_names, is_closed, twists
from mahovik.core.stand.masses import pose, transfer
from mahovik.core.stand.model import Hold, Stand, State
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.reference.algebra import carrier_rotation
from mahovik.proof.reference.motion import point_transfers
from mahovik.use.numeric.frame import Twists, in_fluid
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import (
    Linear,
    Slopes,
    drive,
    linear,
    prescribed_at,
    slopes_of_residual,
    slopes_of_torques,
)
from mahovik.use.numeric.se3 import Array, Complex, block_diagonal, place, skew, turn
from mahovik.use.simulate.held import rates
from mahovik.use.study.rest import reduced_basis


class Channel(NamedTuple):
    """One state, input or output: a name (a space only before a flywheel or point), and an SI unit."""

    name: str
    unit: str

    def __str__(self) -> str:
        return f"{self.name} [{self.unit}]"


AXES = ("x", "y", "z")


def triple(prefix: str, unit: str, suffix: str = "") -> list[Channel]:
    """Three channels along the axes."""
    return [Channel(f"{prefix}{axis}{suffix}", unit) for axis in AXES]


def states(stand: Stand, locked: bool) -> tuple[Channel, ...]:
    """Pose (6), V (6), then phi (N) and phi' (N) of flywheels that are not locked.

    Of a held carrier the freedoms (m) and their speeds (m) in place of pose and V.
    """
    if stand.hold is None:
        carrier = [*triple("", "m"), *triple("r", "rad"), *triple("v_", "m/s"), *triple("omega_", "rad/s")]
    else:
        carrier = _freedoms(stand.hold)  # none where it is clamped
    if locked:
        return tuple(carrier)
    names = [s.name for s in stand.flywheels]
    angles = [Channel(f"phi {name}", "rad") for name in names]
    return (*carrier, *angles, *(Channel(f"phi_dot {name}", "rad/s") for name in names))


def _freedoms(hold: Hold) -> list[Channel]:
    """Freedoms q_NAME (m, rad; of a basis without a unit), then their speeds u_NAME."""
    units = [{"slide": "m", "turn": "rad"}.get(freedom.kind, "1") for freedom in hold.freedoms]
    named = list(zip(freedom_names(hold), units, strict=True))
    rates = {"m": "m/s", "rad": "rad/s", "1": "1/s"}
    return [*(Channel(f"q_{name}", unit) for name, unit in named),
            *(Channel(f"u_{name}", rates[unit]) for name, unit in named)]  # fmt: skip


def inputs(stand: Stand, locked: bool) -> tuple[Channel, ...]:
    """Drive torques (N) of flywheels that are not locked, then the wrench on the carrier (6)."""
    drives = [] if locked else [Channel(f"tau {s.name}", "N m") for s in stand.flywheels]
    wrench = [Channel(f"wrench {letter}", "N" if letter in "XYZ" else "N m") for letter in "XYZKMN"]
    return (*drives, *wrench)


def outputs(points: tuple[str, ...]) -> tuple[Channel, ...]:
    """Displacement, velocity, acceleration (3 each) of every point."""
    result: list[Channel] = []
    for name in points:
        for prefix, unit in (("d", "m"), ("v", "m/s"), ("a", "m/s2")):
            result += triple(f"{prefix}_", unit, f" {name}")
    return tuple(result)


class Place(NamedTuple):
    """A point or instrument on the carrier: origin (3; m) from O1, axes (3, 3), both in E1."""

    name: str
    origin: Array
    axes: Array


def places(stand: Stand, names: Sequence[str] | None = None) -> tuple[Place, ...]:
    """The points and instruments named, in that order; None: all of the stand. Raises UsageError.

    The carrier's name stands for O1 on the axes of E1.
    """
    known = {name: Place(name, place(L), L[:3, :3]) for name, L in point_transfers(stand).items()}
    if names is None:
        return tuple(known.values())
    known[stand.carrier.name] = Place(stand.carrier.name, np.zeros(3), np.eye(3))
    for i, name in enumerate(names):
        if name not in known:
            raise UsageError(f"at {name}: unknown{suggestion(name, known)}")
        if name in names[:i]:
            raise UsageError(f"at {name}: given twice")
    return tuple(known[name] for name in names)


def output_rows(place: Place, V: Array, V_dot: Array) -> tuple[Array, Array]:
    """Rows (9, 12) by pose and V, and (9, 6) by V*: displacement, velocity, acceleration of a point.

    They are differences in E0 from the nominal motion, on the point's axes in that motion. V, V* (6): nominal motion.
    """
    r, v, omega, v_dot, omega_dot = place.origin, V[:3], V[3:], V_dot[:3], V_dot[3:]
    arm, turning = skew(r), skew(omega)
    velocity = v + np.cross(omega, r)
    acceleration = v_dot + np.cross(omega, velocity) + np.cross(omega_dot, r)
    at = np.zeros((9, 12))
    at[:3, :3], at[:3, 3:6] = np.eye(3), -arm
    at[3:6, 3:6], at[3:6, 6:9], at[3:6, 9:] = -skew(velocity), np.eye(3), -arm
    at[6:, 3:6] = -skew(acceleration)
    at[6:, 6:9], at[6:, 9:] = turning, -skew(velocity) - turning @ arm
    rate = np.zeros((9, 6))
    rate[6:, :3], rate[6:, 3:] = np.eye(3), -arm
    axes = np.kron(np.eye(3), place.axes.T)
    return axes @ at, axes @ rate


SPIN = block_diagonal(skew(np.array([1.0, 0.0, 0.0])))
"""[<e>] (6, 6) of (5): derivative of a flywheel's axes as it turns."""

STEADY = 1e-9
"""m/s2, rad/s2: remaining V* that counts as rest; rounding is far below this."""


@dataclass(frozen=True, eq=False)
class LinearModel:
    """x' = A x + B u, y = C x + D u for small deviations from the motion through a state. SI.

    states    (n): x, y, z (m) and rx, ry, rz (rad): place of O1 and rotation vector of the carrier from its pose in
              that motion, on E1 as it is there; deviations of V (6), of phi (N) and phi' (N). Of a held carrier m
              freedoms q, along which it is displaced by the twist S q, and their speeds, in place of pose and V
    inputs    (m): drive torques (N), then a wrench on the carrier about O1, in E1 (6)
    outputs   (p): per point displacement, velocity, acceleration in E0, on the point's axes in that motion (3 each)
    A, B, C, D   n x n, n x m, p x n, p x m
    state     the state, with V* and the drive torques that keep its phi''
    points    their names
    locked    flywheels keep their prescribed motion; without their states and inputs
    """

    stand: Stand
    state: State
    points: tuple[str, ...]
    locked: bool
    states: tuple[Channel, ...]
    inputs: tuple[Channel, ...]
    outputs: tuple[Channel, ...]
    A: Array
    B: Array
    C: Array
    D: Array

    @property
    def freedoms(self) -> int:
        """Number of freedoms of the carrier: 6 of a free one, m of a held one; as many states are displacements."""
        return int(twists(self.stand.hold).shape[1])

    @property
    def steady(self) -> bool:
        """V* and phi'' vanish to rounding; otherwise the matrices hold for a moment only and do not show stability."""
        return all(abs(x) <= STEADY for x in (*self.state.V_dot, *self.state.phi_ddot))


def linear_model(
    stand: Stand, state: State, points: Sequence[str] | None = None, *, locked: bool = False
) -> LinearModel:
    """The linear model of `stand` about `state`, seen at `points` (names of points and instruments; None: all).

    Flywheels have the accelerations `state.phi_ddot`; V* follows from (8), and their drive torques from both, so
    `V_dot` and `tau` of the state are ignored. `locked`: the flywheels' motion is prescribed, 12 states are left.
    Raises UsageError for an unknown point, StateError if a law is undefined or a number is not finite; CheckError of a
    held carrier that cannot move, or whose freedoms are no coordinates.
    """
    _check_hold(stand, locked)
    seen = places(stand, points)
    equations = _Equations.at(stand, state)
    N = len(stand.flywheels)
    free = 0 if locked else N
    V, V_dot = equations.V, equations.V_dot
    n = 12 + 2 * free
    A, B = np.zeros((n, n)), np.zeros((n, free + 6))
    A[:3, :3] = A[3:6, 3:6] = -skew(V[3:])
    A[:3, 3:6] = -skew(V[:3])
    A[:6, 6:12] = np.eye(6)
    A[12 : 12 + free, 12 + free :] = np.eye(free)
    by_state, by_input = equations.accelerations(free)
    A[6:12], A[12 + free :] = by_state[:6], by_state[6:]
    B[6:12], B[12 + free :] = by_input[:6], by_input[6:]
    rows = [output_rows(place, V, V_dot) for place in seen]
    at = np.vstack([np.zeros((0, 12)), *(x for x, _ in rows)])
    rate = np.vstack([np.zeros((0, 6)), *(x for _, x in rows)])
    C = rate @ A[6:12]
    C[:, :12] += at
    names = tuple(place.name for place in seen)
    u_dot, tau = rates(stand.hold, V_dot), tuple(equations.tau.tolist())
    nominal = replace(state, V_dot=tuple(V_dot.tolist()), u_dot=u_dot, tau=tau)
    channels = (states(stand, locked), inputs(stand, locked), outputs(names))
    D = rate @ B[6:12]
    along, back = _along_freedoms(stand.hold, 2 * free)
    A, B, C = back @ A @ along, back @ B, C @ along
    return LinearModel(stand, nominal, names, locked, *channels, A + 0.0, B + 0.0, C + 0.0, D + 0.0)


def _check_hold(stand: Stand, locked: bool) -> None:
    """Raises CheckError for a held carrier without coordinates, or where nothing can move."""
    hold, start = stand.hold, f"{stand.name}: no linear model: "
    if hold is None:
        return
    if not is_closed(hold):
        raise CheckError(f"{start}the freedoms of [hold] are not a closed set; {closing_words(hold)}")
    if not hold.freedoms and (locked or not stand.flywheels):
        reason = "there is no flywheel; give freedoms"
        if stand.flywheels:
            reason = "the flywheels are locked, as `modes` has them by default; give flywheels=free, or freedoms"
        raise CheckError(f"{start}[hold] clamps the carrier, and {reason}")


def _along_freedoms(hold: Hold | None, of_flywheels: int) -> tuple[Array, Array]:
    """States of the free carrier by those of a held one, diag(S, S, E), and back; `others`: states of flywheels.

    The set of twists is closed, so the equations lead out of it nowhere, and any inverse of S takes them back.
    """
    S = twists(hold)
    pair = np.kron(np.eye(2), S), np.kron(np.eye(2), np.linalg.pinv(S))
    m = 2 * S.shape[1]
    whole, inverse = np.zeros((12 + of_flywheels, m + of_flywheels)), np.zeros((m + of_flywheels, 12 + of_flywheels))
    whole[:12, :m], inverse[:m, :12] = pair
    whole[12:, m:] = inverse[m:, 12:] = np.eye(of_flywheels)
    return whole, inverse


@dataclass(frozen=True, eq=False)
class _Equations:
    """R = 0, tau, and all derivatives at one state (M = 1), run-time wrenches included."""

    V: Array
    V_dot: Array
    tau: Array
    mass: Array
    by_state: Array
    S: Array

    @staticmethod
    def at(stand: Stand, state: State) -> _Equations:
        mechanics = Mechanics.of(stand)
        phi, phi_dot, phi_ddot = (np.array([x], dtype=np.float64) for x in (state.phi, state.phi_dot, state.phi_ddot))
        still = _twists(stand, state)
        push, push_by_phi, about = _run_time(mechanics, state)
        S = twists(stand.hold)
        with np.errstate(all="ignore"):  # an overflow is not finite, and is reported below
            held = linear(prescribed_at(mechanics, still), phi, phi_dot, phi_ddot)
            driven = drive(mechanics, phi, phi_dot, phi_ddot)
            V_dot = S @ driven.mobility[0] @ (held.R[0] + push)
            moving = still._replace(V_r_dot=still.V_r_dot + V_dot)
            wheels = linear(prescribed_at(mechanics, moving), phi, phi_dot, phi_ddot)
            by = slopes_of_residual(mechanics, moving, driven), slopes_of_torques(mechanics, moving, phi, phi_dot)
        mass, by_state = _arrange_derivatives(*by, wheels, push_by_phi)
        tau = wheels.tau[0] - about
        if not all(np.all(np.isfinite(x)) for x in (V_dot, tau, mass, by_state)):
            raise StateError(f"{stand.name}: the linear model is not finite at this state")
        return _Equations(still.V[0], V_dot, tau, mass, by_state, S)

    def accelerations(self, free: int) -> list[Array]:
        """V* and phi'' (6 + free) by the states (12 + 2 free) and by the inputs (free + 6); V* = S u*."""
        N = len(self.tau)
        columns = [*range(12), *(range(12, 12 + 2 * N) if free else ())]
        by_input = np.zeros((6 + free, free + 6))
        by_input[6:, :free], by_input[:6, free:] = np.eye(free), np.eye(6)
        right = np.hstack([self.by_state[: 6 + free, columns], by_input])
        m = self.S.shape[1]
        P = np.zeros((6 + free, m + free))
        P[:6, :m], P[6:, m:] = self.S, np.eye(free)
        solved = P @ np.linalg.solve(P.T @ self.mass[: 6 + free, : 6 + free] @ P, P.T @ right)
        return np.hsplit(solved, [len(columns)])


def _arrange_derivatives(by: Slopes, of_tau: Slopes, wheels: Linear, push_by_phi: Array) -> tuple[Array, Array]:
    """The full mass matrix (6 + N), and derivatives of R and -tau by pose, V, phi, phi' (6 + N, 12 + 2 N)."""
    coupled = [of_tau.by_twist_dot[0], np.diag(wheels.tau_by_phi_ddot[0])]
    mass = np.block([[-by.by_twist_dot[0], -wheels.by_phi_ddot[0]], coupled])
    carrier = [by.by_pose[0], by.by_twist[0], wheels.by_phi[0] + push_by_phi, wheels.by_phi_dot[0]]
    drives = [of_tau.by_pose[0], of_tau.by_twist[0], np.diag(wheels.tau_by_phi[0]), np.diag(wheels.tau_by_phi_dot[0])]
    return mass, np.vstack([np.hstack(carrier), -np.hstack(drives)])


def _twists(stand: Stand, state: State) -> Twists:
    """The carrier's motion (M = 1), V* = 0."""
    V = np.array([state.V])
    return in_fluid(stand, carrier_rotation(stand, state)[None], np.array([state.position]), V, np.zeros_like(V))


def _run_time(mechanics: Mechanics, state: State) -> tuple[Array, Array, Array]:
    """Run-time wrenches: sum in E1 about O1 (6), by phi (6, N), and their moments about the spin axes (N)."""
    stand = mechanics.stand
    total, by_phi, about = np.zeros(6), np.zeros((6, mechanics.N)), np.zeros(mechanics.N)
    none = (0.0,) * 6
    total += np.array(state.wrench.get(stand.carrier.name, none))
    for p in stand.instruments:
        total += transfer(*pose(stand, p)) @ np.array(state.wrench.get(p.name, none))
    for k, s in enumerate(stand.flywheels):
        P, L = np.array(state.wrench.get(s.name, none)), mechanics.tables.Lm[k] @ block_diagonal(turn(0, state.phi[k]))
        total += L @ P
        by_phi[:, k] = L @ SPIN @ P
        about[k] = P[3]
    return total, by_phi, about


SAME = 1e-9
"""Relative difference below which two magnitudes of eigenvalues are equal but for rounding."""

FREE = 1e-6
"""Part of the largest eigenvalue below which one is zero: a pair of zeros scatters by the root of rounding."""

STIFF = 1e-10
"""Part of the largest stiffness below which a direction is free."""

SLOWEST = 1e-6
"""1/s: slower modes always count as zero."""

SMALL = 5e-4
"""Part of the largest displacement of a shape: smaller ones are left out."""

ALIGNED = 1.0
"""deg: a phase this near to 0 or 180 deg is written as a sign."""


@dataclass(frozen=True, eq=False)
class Mode:
    """One mode: exp(eigenvalue t) times its shape.

    kind        "free": eigenvalue zero, no restoring force; "oscillation": a pair; "decay", "growth": real
    eigenvalue  1/s; for a pair, the one with positive imaginary part
    frequency   |eigenvalue| / 2 pi, Hz: natural, without damping
    damping     ratio, -Re / |eigenvalue|; negative: it grows
    shape       (n, complex) displacements by `Modes.coordinates`, the largest is 1
    """

    kind: str
    eigenvalue: complex
    frequency: float
    damping: float
    shape: Complex

    @property
    def damped_frequency(self) -> float:
        """Im(eigenvalue) / 2 pi, Hz."""
        return float(self.eigenvalue.imag) / (2.0 * np.pi)


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes of a model by natural frequency, free ones first. A pair of eigenvalues is one mode.

    coordinates  of the shapes: pose (6), or the freedoms (m) of a held carrier, and phi of free flywheels
    zeros        number of zero eigenvalues; an undamped free direction has two, its position and its speed
    """

    coordinates: tuple[Channel, ...]
    modes: tuple[Mode, ...]
    zeros: int

    @property
    def unstable(self) -> bool:
        """Whether some mode grows."""
        return any(mode.damping < 0.0 and mode.kind != "free" for mode in self.modes)


def modes(model: LinearModel) -> Modes:
    """The modes of a linear model. Free directions (without stiffness) replace zero eigenvalues."""
    n, m = len(model.A), model.freedoms
    places = [*range(m), *range(2 * m, m + n // 2)]
    values, vectors = np.linalg.eig(model.A)
    limit = max(FREE * float(np.abs(values).max(initial=0.0)), SLOWEST)
    zero = np.abs(values) <= limit
    result = [_free(column) for column in _still(model.A, places)]
    rounding = FREE * np.abs(values)
    result += [
        _mode(complex(values[i]), vectors[places, i], bool(abs(values[i].imag) > rounding[i]))
        for i in _by_size(values)
        if not zero[i] and values[i].imag > -rounding[i]
    ]
    coordinates = tuple(model.states[i] for i in places)
    return Modes(coordinates, tuple(result), int(zero.sum()))


def _by_size(values: Complex) -> list[int]:
    """Indices of eigenvalues by magnitude; of magnitudes that only rounding tells apart, the growing one first."""
    order = np.argsort(np.abs(values), kind="stable")
    sizes = np.abs(values)[order]
    group = np.concatenate([[0], np.cumsum(np.diff(sizes) > SAME * sizes[1:])]).astype(int)
    return [int(order[i]) for i in np.lexsort((-values[order].real, group))]


def _mode(value: complex, shape: Complex, turning: bool) -> Mode:
    size = abs(value)
    kind = "oscillation" if turning else "decay" if value.real < 0.0 else "growth"
    damping = -value.real / size
    if abs(damping) <= FREE:
        damping = 0.0  # rounding, of either sign
    return Mode(kind, value, size / (2.0 * np.pi), damping, _scale_mode(shape))


def _free(shape: Array) -> Mode:
    return Mode("free", 0j, 0.0, 0.0, _scale_mode(shape.astype(np.complex128)))


def _scale_mode(shape: Complex) -> Complex:
    """Scale so that the largest displacement (m or rad) is 1."""
    largest = shape[int(np.argmax(np.abs(shape)))]
    return np.asarray(shape / largest) if largest != 0.0 else shape


def _still(A: Array, places: list[int]) -> list[Array]:
    """Displacements (a basis) that nothing brings back: A x = 0 with no speed in x."""
    _, sizes, rows = np.linalg.svd(A[:, places])
    kept = sizes > max(STIFF * float(sizes.max(initial=0.0)), SLOWEST**2)
    return list(reduced_basis(rows[int(kept.sum()) :]))


def shape_words(modes: Modes, shape: Complex) -> str:
    """Displacements of a shape, largest first, with their phases unless these are signs."""
    largest_first = sorted(zip(modes.coordinates, shape.tolist(), strict=True), key=lambda pair: -abs(pair[1]))
    return ", ".join(f"{channel.name} {_number(x)}" for channel, x in largest_first if abs(x) > SMALL)


def _number(x: complex) -> str:
    degrees = math.degrees(cmath.phase(x))
    if abs(degrees) <= ALIGNED:
        return f"{abs(x):.3g}"
    if abs(degrees) >= 180.0 - ALIGNED:
        return f"{-abs(x):.3g}"
    return f"{abs(x):.3g} at {degrees:.0f} deg"
