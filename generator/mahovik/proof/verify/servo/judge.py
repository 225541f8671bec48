"""Judgement of a servo's C in a folder: its tables, and every public function by the law, with what it must refuse."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.contract.limits import LIMITS
from mahovik.contract.quantities import BOUNDS, limits_of
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import bodies_of
from mahovik.proof.reference.pieces import spin_inertia
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.compiled import Part, law_checks, load_part, part_checks, refusal_check
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.proof.verify.refusals import BEYOND
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo import law
from mahovik.proof.verify.servo.trim_matrix import trim_matrix

INVALID_READINGS = (math.nan, math.inf, -math.inf, 1e300)
"""Readings of an encoder that has none."""

SEQUENCES = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""Axes about which psi, theta, phi turn, each in the frame that the one before has turned."""

TIME = 1e-9
"""Accepted relative error of what depends on the period: samples and periods in it are whole numbers below 2^31."""

SETTLING_CONSTANTS = 8.0
"""Time constants of the corrections' smoothing in the settling."""

RESTING = 1e-3
"""Scale of a coordinate that does not move, as a part of the largest coefficient (m or rad)."""

MATRIX = 1e-8
"""Accepted error of the matrix, by its largest number: both sides solve the linear equations of a period."""

NODES = 4096
"""Times in a period at which the required motion is averaged."""

NEEDS_MOTION = "needs the required motion: give --motion MOTION.json"


@dataclass(frozen=True)
class ServoCase:
    """A stand, a servo and its C; motion and programme, where they are known. `count`: drawn inputs of a function."""

    stand: Stand
    servo: Servo
    made: Part
    seed: int
    count: int
    motion: RequiredMotion | None
    programme: Programme | None

    @property
    def wheels(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @cached_property
    def inertia(self) -> Array:
        """J = f^T Theta f (N, kg m2) of each flywheel about its axis, by the literal reference."""
        return np.diag(spin_inertia(bodies_of(self.stand).flywheels))

    def default(self, name: str) -> dict[str, Any]:
        """Members of a table of the C, `servo_default` or `trim_default`."""
        found: dict[str, Any] = self.made.read(self.made.library.default(name))
        return found


def verify_servo(
    stand: Stand,
    servo: Servo,
    folder: Path,
    *,
    motion: RequiredMotion | None = None,
    programme: Programme | None = None,
    name: str = "programme",
    seed: int = 1,
    count: int = 200,
) -> Report:
    """Report on the C of a servo in a folder: each function, each member of its tables.

    `motion`: the required motion of its programme; without it the trim's target is not compared. `programme`: the
    programme itself; without both the trim's matrix is not compared.
    `name`: that of the programme in C. `count`: drawn inputs of each function.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile; stand, motion and programme do
    not belong together.
    """
    if motion is not None and servo.trim is not None and not motion.periodic:
        raise UsageError(f"{motion.name}: is finite, but a trim needs a periodic motion: give that of the programme")
    if programme is not None:
        if motion is None:
            raise UsageError("the programme is given without its motion: give --motion MOTION.json as well")
        for item in (stand_check(stand, programme), motion_check(motion, programme)):
            if item.failed:
                raise UsageError(f"{item.words}: give the programme that the servos follow")
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        made = load_part(stand, folder, "servo", name, Path(scratch))
        case = ServoCase(stand, servo, made, seed, count, motion, programme)
        rows = (*table_checks(case), *part_checks(made, judges_of(case)))
    own = identities(stand)
    limit = LIMITS[made.real].law
    return Report(stand.name, own.structure, own.physics, f"servo {servo.name}", seed, count, limit, rows)


def table_checks(case: ServoCase) -> Iterator[Check]:
    """Every member of `servo_default` and `trim_default`, and the number of samples in a period."""
    library, motion, limit = case.made.library, case.motion, LIMITS[case.made.real].law
    samples = Fraction(library.constant("SERVO_TICKS"), library.constant("SERVO_PERIODS"))
    tables: dict[str, dict[str, Any]] = {"servo_default": gains_of(case, float(samples) * case.servo.period)}
    if case.servo.trim is not None and library.has("trim_default"):
        tables["trim_default"] = design_of(case, samples)
        row, matrix = Check("trim_default", "means are not corrected"), case.default("trim_default")["matrix"]
        row.demand(bool(np.any(matrix)) and not np.any(matrix[:, :: 2 * case.servo.trim.harmonics + 1]))
        yield row
    elif case.servo.trim is not None or library.has("trim_default"):
        row = Check("trim_default", "trim")
        row.demand(False, words="of servo file and C one has a trim, the other none: export the servo again")
        yield row
    for table, expected in tables.items():
        found = case.default(table)
        for name in dict.fromkeys((*found, *expected)):
            row = Check(table, name, max(limit, {"lead": TIME, "omega": TIME, "matrix": MATRIX}.get(name, 0.0)))
            value = expected.get(name, "no such number in the law")
            if isinstance(value, str):
                row.words = value
                row.verdict = row.verdict if name in expected else "FAILED"
            else:
                row.compare(found.get(name), *(value if isinstance(value, tuple) else (value, np.abs(value))))
            yield row
    row = Check("SERVO_TICKS", "SERVO_PERIODS", TIME, words="" if motion else NEEDS_MOTION)
    if motion is not None:
        row.compare(float(samples) * case.servo.period, motion.span, motion.span)
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
    """The design of the file's trim by the law, `samples` in a period; with a scale, or why it is not compared."""
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
        "target": _target(case),
        "matrix": _matrix(case),
    }


def _target(case: ServoCase) -> tuple[Array, Array] | str:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion, with their scales."""
    trim, motion = case.servo.trim, case.motion
    if trim is None or motion is None:
        return NEEDS_MOTION
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    target, found = law.coefficients(q, phase, trim.harmonics).T, case.default("trim_default")["target"]
    # all coefficients are averages of the same samples; coordinates at rest have only their rounding
    scale = np.abs(target).max(axis=1, keepdims=True) + RESTING * np.abs(target).max()
    if found.shape == target.shape:
        target[:, 0] = found[:, 0]  # means, which are not corrected, are shifted by the programme's bias
    return target, scale


def _matrix(case: ServoCase) -> tuple[Array, Array] | str:
    """Corrections by the error, with their scale."""
    assert case.servo.trim is not None
    if case.motion is None or case.programme is None:
        return "only its zeros: give --motion MOTION.json and --programme PROGRAMME.json"
    try:
        return trim_matrix(case.stand, case.motion, case.programme, case.servo.trim)
    except StateError as error:
        return f"its judge refused: {error}"


def judges_of(case: ServoCase) -> dict[str, Callable[[str], Iterable[Check]]]:
    """The judge of each function that the C must have, and of one that it may have."""
    made, chosen = case.made, case.servo.trim.coordinates if case.servo.trim is not None else ()
    coordinates = partial(law.trim_coordinates, SEQUENCES[case.stand.angles], chosen)
    laws: dict[str, tuple[Callable[..., Iterator[dict[str, Any]]], Callable[..., dict[str, Any]]]] = {
        "servo_reset": (servo_resets, law.reset),
        "servo_step": (servo_samples, law.servo_step),
    }
    if made.library.has("trim_default"):
        laws |= {"trim_reset": (trim_resets, law.reset), "trim_step": (trim_samples, law.trim_step)}
        if case.stand.hold is None or made.library.has("trim_coordinates"):
            # `generalized` of a held carrier's C gives the coordinates that its trim measures
            laws["trim_coordinates"] = (poses, coordinates)

    def judge(function: str) -> Iterator[Check]:
        draw, right = laws[function]
        drawn = [*draw(case, np.random.default_rng((case.seed, 1)))]
        yield from law_checks(made, function, drawn, right, np.random.default_rng((case.seed, 2)))
        good = {"state": {}} if right is law.reset else drawn[0]  # a reset reads nothing
        yield refusal_check(made, function, good, _out_of_range(case))

    return dict.fromkeys(laws, judge)


def _out_of_range(case: ServoCase) -> dict[str, tuple[float, ...]]:
    """Numbers that are out of range, by argument or member; of counts those that the trim never makes."""
    like = {"phi_ref": "phi", "phi_dot_ref": "phi_dot", "tau_ff": "tau", "integral": "tau", "torque": "tau"}
    names = ("phi", "phi_dot", "tau", "position", "q", *like)
    most = {name: BEYOND * limits_of(like.get(name, name), case.made.real)[0] for name in names}
    most["speed"] = 2 * most["phi_dot"]  # the difference of two speeds
    ranges: dict[str, tuple[float, ...]] = {name: (limit, -limit) for name, limit in most.items()}
    end = WHOLE_ROUND + case.wheels
    return ranges | {"phase": (1.0, -0.01, 7.0), "attitude": (1.01, 3.0), "sample": (-1, end), "rounds": (-1,)}


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
    for number in range(case.count):
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
    for number in range(case.count):
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
    measured, sequence = len(case.default("trim_default")["target"]), case.stand.angles
    for number in range(case.count):
        angles = rng.uniform(-1, 1, 3) * (math.pi, math.pi / 2 - NEAR, math.pi) * (1.0 if number % 3 else 0.1)
        angles[1] += math.pi / 2 if sequence == "euler" else 0.0
        attitude = np.roll(Rotation.from_euler(SEQUENCES[sequence], angles).as_quat(), 1)
        position = rng.normal(size=3) * (1.0 if number % 2 else 1e3)
        yield case.made.round({"position": position, "attitude": attitude, "q": np.full(measured, np.nan)})
