"""Judges of a servo's C: its functions by the law, from drawn inputs; its tables, among them the matrix of a trim.

The matrix of a trim is judged from its definition, by the literal reference: harmonic balance along the required
motion. The stand follows the programme but for small corrections c of mean and harmonics of each flywheel. By (8), with
a, b, ... derivatives of q'' along the required motion, a change e of the angles changes the carrier's coordinates by d:

    d'' = a d + b d' + r e + n e' + m e''.

d is the trigonometric polynomial that satisfies this at uniform times of a period. Its harmonics by c are G, of which
the matrix takes back a part, the gain, at least cost: see `least_cost_matrix`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from typing import Any

import numpy as np

from mahovik.contract.limits import LIMITS, SERVO_MATRIX, SERVO_PERIOD, Limits
from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo, Trim
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import Array, twists
from mahovik.proof.reference.pieces import bodies_of, spin_inertia
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Rows
from mahovik.proof.verify.draw import turns_of
from mahovik.proof.verify.programme.compiled import Part
from mahovik.proof.verify.programme.compiled import judge_law as judge
from mahovik.proof.verify.programme.mechanics import free_acceleration, moment
from mahovik.proof.verify.scales import Laws
from mahovik.proof.verify.servo import law

# -- functions ---------------------------------------------------------------------------------------------------------

INVALID_READINGS = (math.nan, math.inf, -math.inf, 1e300)
"""Readings of an encoder that has none."""


@dataclass(frozen=True)
class ServoCase:
    """A stand, a servo and its C; motion and programme, where they are known. `states`: drawn inputs of a function."""

    stand: Stand
    servo: Servo
    made: Part
    seed: int
    states: int
    motion: RequiredMotion | None
    programme: Programme | None

    @property
    def limits(self) -> Limits:
        """Accepted differences of the element type of the C."""
        return LIMITS[self.made.real]

    @property
    def scales(self) -> Laws:
        """The laws with their scales."""
        return Laws(self.made.real, np.random.default_rng((self.seed, 2)))

    @property
    def wheels(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def public(self) -> list[str]:
        """Functions that the C must have, and those that it has."""
        needed = ["servo_reset", "servo_step"]
        if self.made.library.has("trim_default"):
            needed += ["trim_reset", "trim_step"]
            # `generalized` of a held carrier's C gives the coordinates that its trim measures
            needed += ["trim_coordinates"] if self.stand.hold is None else []
        return self.made.functions(needed)

    @cached_property
    def inertia(self) -> Array:
        """J = f^T Theta f (N, kg m2) of each flywheel about its axis, by the literal reference."""
        return np.diag(spin_inertia(bodies_of(self.stand).flywheels))

    def default(self, name: str) -> dict[str, Any]:
        """Members of a table of the C, `servo_default` or `trim_default`."""
        table = self.made.library.read(self.made.library.default(name))
        return {member: np.array(x) if isinstance(x, list) else x for member, x in table.items()}


def judge_law(case: ServoCase, rows: Rows) -> None:
    """A function by its law, from drawn inputs, and what it must refuse."""
    draw, right = LAWS[rows.function]
    if rows.function == "trim_coordinates":
        trim, sequence = case.servo.trim, turns_of(case.stand.angles)
        right = partial(law.trim_coordinates, sequence, () if trim is None else trim.coordinates)
    beyond = {"sample": (WHOLE_ROUND + case.wheels,), "phase": (1.0,), "attitude": (1.01, 3.0)}
    judge(case.made, rows, draw(case, np.random.default_rng((case.seed, 1))), right, beyond)


def servo_resets(case: ServoCase, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """A state with something in every member."""
    yield {"state": {name: rng.uniform(1, 2, case.wheels) for name in ("integral", "speed", "torque")}}


def servo_samples(case: ServoCase, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """Inputs of `servo_step`, as the element type holds them.

    The folder's gains in every other sample, else drawn ones that use every term. Torques are such that limits cut now
    and then; errors small, of many turns, and just below and above half turns; in some samples encoders without a good
    reading.
    """
    n, most, unlimited = case.wheels, BOUNDS["MAX_PHASE"].at(case.made.real), BOUNDS["MAX_WRENCH"].value
    table = case.default("servo_default")
    for number in range(case.states):
        g = table
        if number % 2:
            g = {name: rng.uniform(0.1, 2.0, n) for name in table}
            g |= {"filter": rng.uniform(0.1, 1.0), "back": rng.uniform(0.0, 1.0, n), "lead": 0.0}
            g |= {name: np.full(n, unlimited) for name, k in (("limit", 3), ("change", 4)) if not number // 2 % k}
        size = np.where(g["limit"] < unlimited, g["limit"], g["angle"] + 1e-3)
        slip = size / np.maximum(g["speed"], 1e-6)
        state = {name: rng.uniform(-1, 1, n) * size for name in ("integral", "torque")}
        phi_ref = rng.uniform(-1, 1, n) * (10.0 if number % 4 else 0.4 * most)
        phi_dot_ref = rng.normal(size=n) * (1.0 if number % 3 else 200.0)
        small = 0.5 * rng.normal(size=n) * np.minimum(1.0, size / np.maximum(g["angle"], 1e-6))
        turns = rng.integers(-3, 4, n) + 0.5 + rng.choice([-1, 1], n) * 10.0 ** rng.uniform(-3, -1, n)
        whole = rng.integers(-20, 21, n) if number % 4 else rng.integers(-int(0.08 * most), int(0.08 * most) + 1, n)
        phi = phi_ref - (small, math.tau * turns, whole * math.tau + small)[number // 2 % 3]
        phi_dot = phi_dot_ref - 0.3 * rng.normal(size=n) * slip
        flags = rng.choice([0, 0, 1, -7], n) if number % 3 == 1 else None  # any but 0: no good reading
        lost, none = np.zeros(n) if flags is None else flags, INVALID_READINGS[number % len(INVALID_READINGS)]
        yield case.made.round({
            "gains": g, "state": state | {"speed": rng.normal(size=n) * slip}, "phi_ref": phi_ref,
            "phi_dot_ref": phi_dot_ref, "tau_ff": 0.3 * rng.normal(size=n) * size, "phi": np.where(lost, none, phi),
            "phi_dot": np.where(lost, none, phi_dot), "invalid": flags, "tau": np.full(n, np.nan),
        })  # fmt: skip


WHOLE_ROUND = 21
"""Samples of settling and window together, in drawn rounds."""


def trim_resets(case: ServoCase, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """A state with something in every member."""
    yield {"state": next(trim_samples(case, rng))["state"] | {"sample": 3, "rounds": 5}}


def trim_samples(case: ServoCase, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """Inputs of `trim_step`, as the element type holds them: every kind of sample of a round.

    The folder's design in every other sample, else a drawn one. Errors are such that limits cut now and then.
    """
    table, N = case.default("trim_default"), case.wheels
    C, T = np.shape(table["target"])
    for number in range(case.states):
        design = dict(table)
        if number % 2:
            design |= {"smoothing": rng.uniform(0.1, 1.0), "limit": rng.uniform(0.1, 0.5), "omega": rng.uniform(10, 99)}
            design |= {name: rng.normal(size=np.shape(table[name])) for name in ("inertia", "target", "matrix")}
        window = int(rng.integers(1, WHOLE_ROUND + 1))
        design |= {"settling": WHOLE_ROUND - window, "window": window}
        limit = float(design["limit"])
        error = (0.1, 1.0, 10.0)[number % 3] * limit / max(np.abs(design["matrix"]).sum(axis=1).max(), 1e-12)
        places = rng.integers(WHOLE_ROUND + N), WHOLE_ROUND - window, WHOLE_ROUND - 1, WHOLE_ROUND + rng.integers(N)
        state = {
            "sample": int(places[number // 2 % 4]),
            "sum": error * rng.normal(size=(C, T)),
            "wanted": limit * rng.uniform(-1, 1, (N, T)),
            "present": limit * rng.uniform(-1, 1, (N, T)),
            "rounds": (0, 5, law.MOST_ROUNDS)[number // 2 % 3],
        }
        phase = (0.5, 0.0, 1.0 - 2.0**-20)[number % 7] if number % 7 < 3 else float(rng.uniform(0.0, 1.0 - 2.0**-20))
        required = design["target"] @ law.waves(np.array([phase]), T // 2)[:, 0]
        yield case.made.round({
            "design": design, "state": state, "phase": phase, "q": required + error * rng.normal(size=C),
            **{name: rng.normal(size=N) for name in ("phi", "phi_dot", "tau")},
        })  # fmt: skip


NEAR = 0.05
"""Angle from a singular attitude, where angles lose their digits, from which poses are drawn."""


def poses(case: ServoCase, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """Inputs of `trim_coordinates`: any attitude that is not near a singular one, and those near that of E0."""
    from scipy.spatial.transform import Rotation

    measured, sequence = len(case.default("trim_default")["target"]), case.stand.angles
    for number in range(case.states):
        angles = rng.uniform(-1, 1, 3) * (math.pi, math.pi / 2 - NEAR, math.pi) * (1.0 if number % 3 else 0.1)
        angles[1] += math.pi / 2 if sequence == "euler" else 0.0
        attitude = np.roll(Rotation.from_euler(turns_of(sequence), angles).as_quat(), 1)
        position = rng.normal(size=3) * (1.0 if number % 2 else 1e3)
        yield case.made.round({"position": position, "attitude": attitude, "q": np.full(measured, np.nan)})


LAWS: dict[str, tuple[Callable[..., Iterator[dict[str, Any]]], Callable[..., dict[str, Any]]]] = {
    "servo_reset": (servo_resets, law.reset),
    "servo_step": (servo_samples, law.servo_step),
    "trim_reset": (trim_resets, law.reset),
    "trim_step": (trim_samples, law.trim_step),
    "trim_coordinates": (poses, law.trim_coordinates),
}
"""Inputs and law of each function; `trim_coordinates` needs to know the coordinates besides."""


# -- tables ------------------------------------------------------------------------------------------------------------

OF_PERIOD = {"lead": SERVO_PERIOD, "omega": SERVO_PERIOD, "matrix": SERVO_MATRIX}
"""Limits of members that depend on the period."""

SETTLING_CONSTANTS = 8.0
"""Time constants of the corrections' smoothing in the settling."""

RESTING = 1e-3
"""Scale of a coordinate that does not move, as a part of the largest coefficient (m or rad)."""

NODES = 4096
"""Times in a period at which the required motion is averaged."""

NEEDS_MOTION = "needs the required motion, which is not given"


def table_checks(case: ServoCase) -> Iterator[Check]:
    """Members of `servo_default` and `trim_default`, and the number of samples in a period."""
    library, trim = case.made.library, case.servo.trim
    samples = Fraction(library.constant("SERVO_TICKS"), library.constant("SERVO_PERIODS"))
    span = float(samples) * case.servo.period
    period = Check("SERVO_TICKS", "SERVO_PERIODS", SERVO_PERIOD, words="" if case.motion else NEEDS_MOTION)
    if case.motion is not None:
        period.compare(span, case.motion.span, case.motion.span)
    yield period
    yield from _members(case, "servo_default", gains_of(case, span))
    if (trim is None) == library.has("trim_default"):
        words = "of servo file and C one has a trim, the other none: generate the servo again"
        yield Check("trim_default", "trim", verdict="FAILED", words=words)
    elif trim is not None:
        row, matrix = Check("trim_default", "means are not corrected"), case.default("trim_default")["matrix"]
        row.demand(bool(np.any(matrix)) and not np.any(matrix[:, :: 2 * trim.harmonics + 1]))
        yield row
        yield from _members(case, "trim_default", design_of(case, samples))


def _members(case: ServoCase, table: str, expected: dict[str, Any]) -> Iterator[Check]:
    """Every member of a table, against the law with a scale; a text says why it is not compared."""
    table_of_c = case.default(table)
    for name in dict.fromkeys((*table_of_c, *expected)):
        limit = max(LIMITS[case.made.real].law, OF_PERIOD.get(name, 0.0))
        row, value = Check(table, name, limit), expected.get(name)
        if isinstance(value, str):
            row.words = value
        elif value is None:
            row.demand(False, words="no such number in the law")
        else:
            row.compare(table_of_c.get(name), *(value if isinstance(value, tuple) else (value, np.abs(value))))
        yield row


def gains_of(case: ServoCase, span: float) -> dict[str, Any]:
    """Gains of a servo file by the law, for a programme of the period `span` (s).

    The factors of J are the coefficients of (s^2 + 2 d w s + w^2)(s + i).
    """
    servo, J = case.servo, case.inertia
    T, w, d, i = servo.period, servo.bandwidth, servo.damping_ratio, servo.integral or 0.0
    _, speed, angle, integral = np.polymul([1.0, 2 * d * w, w * w], [1.0, i])
    most = BOUNDS["MAX_WRENCH"].value
    motors = [s.motor if servo.friction else None for s in case.stand.flywheels]
    return {
        "angle": J * angle,
        "speed": J * speed,
        "integral": J * integral * T,
        "back": np.full(len(J), 1.0 - math.exp(-w * T) if i else 0.0),
        "filter": 1.0 if servo.speed_filter is None else 1.0 - math.exp(-servo.speed_filter * T),
        "limit": np.minimum(servo.torque_limit, most),
        "change": np.minimum(np.array(servo.torque_rate) * T, most),
        "viscous": np.array([0.0 if m is None else m.viscous for m in motors]),
        "coulomb": np.array([0.0 if m is None else m.coulomb for m in motors]),
        "coulomb_rate": np.array([0.0 if m is None else 1.0 / m.coulomb_speed for m in motors]),
        "lead": (servo.latency + T / 2) / span % 1.0,
    }


def design_of(case: ServoCase, samples: Fraction) -> dict[str, Any]:
    """The design of the file's trim by the law, `samples` in a period."""
    trim = case.servo.trim
    assert trim is not None
    settling = round(trim.settling * samples)
    return {
        "settling": settling,
        "window": round(trim.averaging * samples),
        "smoothing": 1.0 - math.exp(-SETTLING_CONSTANTS / settling) if settling > SETTLING_CONSTANTS else 1.0,
        "limit": trim.limit,
        "omega": math.tau / (float(samples) * case.servo.period),
        "inertia": case.inertia,
        "target": NEEDS_MOTION if case.motion is None else _target(case),
        "matrix": _matrix(case),
    }


def _target(case: ServoCase) -> tuple[Array, Array]:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion, with their scales."""
    trim, motion = case.servo.trim, case.motion
    assert trim is not None and motion is not None
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    target, of_c = law.coefficients(q, phase, trim.harmonics).T, case.default("trim_default")["target"]
    # all coefficients are averages of the same samples; coordinates at rest have only their rounding
    scale = np.abs(target).max(axis=1, keepdims=True) + RESTING * np.abs(target).max()
    if of_c.shape == target.shape:
        target[:, 0] = of_c[:, 0]  # means, which are not corrected, are shifted by the programme's bias
    return target, scale


def _matrix(case: ServoCase) -> tuple[Array, Array] | str:
    """Corrections by the error, with their scale; or why they are not compared."""
    assert case.servo.trim is not None
    if case.motion is None or case.programme is None:
        return "only its zeros: motion and programme are not both given"
    try:
        return trim_matrix(case.stand, case.motion, case.programme, case.servo.trim)
    except StateError as error:
        return f"its judge refused: {error}"


# -- the matrix of a trim ----------------------------------------------------------------------------------------------

PROTECTED, WEIGHT = 2, 30.0
"""Harmonics above the corrected ones that cost, and the weight of their size in the largest effect on those."""

REACH = 1e-3
"""Part of the largest effect from which a direction of the error counts as in reach."""

DOUBT = 1e-4
"""Relative distance from REACH below which rounding may decide."""

FREE, STILL = 1e-11, 1e-6
"""Part of the largest singular value of the balance below which a motion of the carrier is free, and the largest
harmonics of such a motion of size 1 at which the others are determined nevertheless."""

STEP = 1e-5
"""Difference of a coordinate (m, rad), and of its change in a radian of the period; central differences."""


def trim_matrix(stand: Stand, motion: RequiredMotion, programme: Programme, trim: Trim) -> tuple[Array, Array]:
    """The matrix (N T, C T): correction by the error, T = 1 + 2 H terms of each flywheel and coordinate; its scale.

    Raises StateError: the reference has no answer on the way, or harmonics of the carrier are not determined.
    """
    highest = max([trim.harmonics + PROTECTED, *motion.harmonics, *(2 * abs(n) for n in programme.winding)])
    M, radian = 4 * highest + 25, motion.span / (2.0 * math.pi)
    t = motion.span * np.arange(M) / M
    effect = responses(slopes(stand, motion, programme, t, radian), trim.harmonics)
    units = _units(stand)[list(trim.coordinates)]
    measured = np.moveaxis(effect[:, list(trim.coordinates)], 1, 0) / units[:, None, None]
    T, columns = 2 * trim.harmonics + 1, effect.shape[-1]
    G, above = measured[:, 1:T].reshape(-1, columns), measured[:, T:].reshape(-1, columns)
    matrix = np.zeros((columns, len(units), T))
    matrix[:, :, 1:] = (trim.gain * least_cost_matrix(G, above, trim.harmonics)).reshape(columns, len(units), T - 1)
    scale = np.full(matrix.shape, np.abs(matrix).max())
    return tuple((numbers / units[:, None]).reshape(columns, -1) for numbers in (matrix, scale))  # type: ignore[return-value]


def least_cost_matrix(G: Array, above: Array, harmonics: int) -> Array:
    """The c (N T) that has the effect e at least cost, by e: N^-1 G^T (G N^-1 G^T)^+.

    The cost c^T N c weighs each harmonic k by 1 + k^2, and the effect `above` on higher harmonics by
    (WEIGHT / |G|)^2. Directions of e that need more than (1 / REACH)^2 of the easiest one's cost are left out.

    Raises StateError: rounding decides whether a direction is left out.
    """
    k = np.array([0, *np.repeat(np.arange(1, harmonics + 1), 2)], dtype=np.float64)
    cost = np.diag(np.tile(1.0 + k**2, G.shape[1] // len(k)))
    cost += (WEIGHT / np.linalg.norm(G, 2)) ** 2 * above.T @ above
    back = np.linalg.solve(cost, G.T)
    size, directions = np.linalg.eigh(G @ back)
    share = np.sqrt(np.maximum(size, 0.0) / size.max())
    if np.any(np.abs(share / REACH - 1.0) < DOUBT):
        raise StateError("a direction of the error is at the limit of reach")
    kept = share > REACH
    return np.asarray(back @ (directions[:, kept] / size[kept]) @ directions[:, kept].T)


def responses(of: Sequence[Array], harmonics: int) -> Array:
    """Harmonics (1 + 2 H.., m, N T) of the carrier's coordinates by the corrections, mean, cos, sin, ... in turn.

    `of`: `slopes` by all five at M uniform times, M odd, a radian of the period as the unit. Raises StateError: a free
    motion of the carrier has such harmonics, so that they are not determined.
    """
    from scipy.linalg import block_diag

    M, m, _ = of[2].shape
    k, phase, highest = np.fft.fftfreq(M, 1.0 / M), np.arange(M) / M, harmonics + PROTECTED
    # of the trigonometric polynomial through M values: the values, its derivatives by the phase
    values, first, second = (
        np.fft.ifft((1j * k[:, None]) ** n * np.fft.fft(np.eye(M), axis=0), axis=0).real for n in range(3)
    )
    pose, speed = (block_diag(*part) for part in of[:2])
    left = np.kron(second, np.eye(m)) - speed @ np.kron(first, np.eye(m)) - pose
    waved = law.waves(phase, harmonics).T
    forced = sum(
        np.einsum("ikl,ij->iklj", part, order @ waved)
        for part, order in zip(of[2:], (values, first, second), strict=True)
    )
    U, size, Vt = np.linalg.svd(left)
    kept = size >= FREE * size[0]
    free = law.coefficients(Vt[~kept].T.reshape(M, m, -1), phase, highest)
    if np.any(np.abs(free[1:]) > STILL):
        raise StateError("a free motion of the carrier changes the harmonics")
    d = Vt[kept].T @ ((U[:, kept].T @ np.reshape(forced, (m * M, -1))) / size[kept][:, None])
    return law.coefficients(d.reshape(M, m, -1), phase, highest)


def slopes(stand: Stand, motion: RequiredMotion, programme: Programme, t: Array, radian: float) -> list[Array]:
    """Derivatives (M, m, n) of q'' by q, q', phi, phi', phi'' at times t (M, s) along the required motion, in turn.

    A `radian` of the period (s) is the unit of time; central differences.
    """
    course, rows = motion.at(t, programme.bias), []
    for values in zip(course.q, course.q_dot, *programme.at(t), strict=True):

        def moved(k: int, way: Array, values: tuple[Array, ...] = values) -> Array:
            arguments = [value + way if i == k else value for i, value in enumerate(values)]
            return free_acceleration(stand, *arguments)

        columns = []
        for k, power in enumerate((0, 1, 0, 1, 2)):
            steps = STEP / radian**power * np.eye(len(values[k]))
            columns.append(radian**2 * np.array([moved(k, x) - moved(k, -x) for x in steps]).T / (2 * STEP))
        rows.append(columns)
    return [np.array(column) for column in zip(*rows, strict=True)]


def _units(stand: Stand) -> Array:
    """Metres and rotations (6; rad) that are worth a metre, by K of (2), mean over the flywheels' angles.

    Of a held carrier (m) what moves along each freedom with the same energy as a metre, by the mass.
    """
    m, N = 6 if stand.hold is None else len(stand.hold.freedoms), len(stand.flywheels)
    turns = [np.full(N, 2.0 * math.pi * j / 8) for j in range(8)]
    K = np.mean([moment(stand, np.zeros(m), np.zeros(m), phi, np.zeros(N)).at.K for phi in turns], axis=0)
    if stand.hold is None:
        return np.repeat([1.0, math.sqrt(K[0, 0] / (np.trace(K[3:, 3:]) / 3.0))], 3)
    return np.array([math.sqrt(K[0, 0] / (column @ K @ column)) for column in twists(stand.hold).T])
