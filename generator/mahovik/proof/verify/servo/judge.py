"""Judgement of a servo's C in a folder: its tables, every public function by the law, and what it must refuse."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.contract.limits import LIMITS
from mahovik.contract.quantities import BOUNDS, limits_of
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo, Trim
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.bodies import bodies_of, spinning_bodies
from mahovik.proof.reference.pieces import spin_inertia
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.compiled import Part, load_part
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.proof.verify.refusals import BEYOND, NULL, WrongValue, with_value
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.servo.law import (
    CHANGE,
    NEIGHBOURS,
    Array,
    TrimLaw,
    changed,
    coefficients,
    scales_of,
    servo_sample,
    waves,
)
from mahovik.proof.verify.servo.trim_matrix import trim_matrix

STATE = ("integral", "speed", "torque")
DEMAND = ("phi", "phi_dot", "tau")
INVALID_READINGS = (math.nan, math.inf, -math.inf, 1e300)
"""Readings of an encoder that has none."""

ROUNDS = ((3, 20, True, 0.1), (0, 7, True, 10.0), (2, 11, False, 1.0), (5, 1, False, 0.05))
"""Samples of settling and of a window, whether the numbers are the folder's, and the size of what is measured."""

ROUNDS_EACH = 3
MOST_ROUNDS = 2**31 - 1
"""Number of rounds at which the count stops."""

SEQUENCES = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""Axes about which psi, theta, phi turn, each in the frame that the one before has turned."""

NEAR, POSES = 0.05, 200
"""Poses with |cos theta| (Euler: |sin theta|) below this are left out: there angles lose their digits."""

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


@dataclass(frozen=True)
class ServoCase:
    """A stand, a servo and its C: where the judges of functions start. `count`: drawn samples of `servo_step`."""

    stand: Stand
    servo: Servo
    made: Part
    seed: int
    count: int

    @property
    def wheels(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def tolerance(self) -> float:
        """Accepted difference over the scale."""
        return LIMITS[self.made.real].law

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
    `name`: that of the programme in C. `count`: drawn samples of `servo_step`.

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
        case = ServoCase(stand, servo, load_part(stand, folder, "servo", name, Path(scratch)), seed, count)
        rows = (*table_checks(case, motion, programme), *function_checks(case))
    own = identities(stand)
    return Report(stand.name, own.structure, own.physics, f"servo {servo.name}", seed, count, case.tolerance, rows)


def table_checks(case: ServoCase, motion: RequiredMotion | None, programme: Programme | None) -> Iterator[Check]:
    """Every member of `servo_default` and `trim_default`, and the number of samples in a period."""
    trim, library = case.servo.trim, case.made.library
    samples = Fraction(library.constant("SERVO_TICKS"), library.constant("SERVO_PERIODS"))
    span, inertia = float(samples) * case.servo.period, _inertia(case.stand)
    yield from _members(case, "servo_default", gains_of(case.stand, case.servo, inertia, span), {"lead": TIME})
    if (trim is not None) != library.has("trim_default"):
        row = Check("trim_default", "trim")
        words = "the C has a trim, not the file" if trim is None else "the servo file has a trim, the C has none"
        row.demand(False, words=f"{words}: export the servo again")
        yield row
    elif trim is not None:
        settling = round(trim.settling * samples)
        yield from _members(
            case,
            "trim_default",
            {
                "settling": settling,
                "window": round(trim.averaging * samples),
                "smoothing": 1.0 - math.exp(-SETTLING_CONSTANTS / settling) if settling > SETTLING_CONSTANTS else 1.0,
                "limit": trim.limit,
                "omega": math.tau / span,
                "inertia": inertia,
                "target": None,
                "matrix": None,
            },
            {"omega": TIME},
        )
        yield _target_check(case, trim, motion)
        yield _matrix_check(case, trim, motion, programme)
    row = Check("SERVO_TICKS", "SERVO_PERIODS", TIME)
    if motion is None:
        row.words = NEEDS_MOTION
    else:
        row.compare(span, motion.span, motion.span)
    yield row


NEEDS_MOTION = "needs the required motion: give --motion MOTION.json"


def _members(case: ServoCase, table: str, expected: dict[str, Any], limits: dict[str, float]) -> Iterator[Check]:
    """Every member of a table of the C, but for those that are judged by themselves: None."""
    found = case.default(table)
    for name in dict.fromkeys((*found, *expected)):
        row = Check(table, name, max(case.tolerance, limits.get(name, 0.0)))
        if name not in expected:
            row.demand(False, words="no such number in the law")
        elif expected[name] is None:
            continue
        else:
            row.compare(found.get(name), expected[name], np.abs(expected[name]))
        yield row


def gains_of(stand: Stand, servo: Servo, J: Array, span: float) -> dict[str, Any]:
    """Gains of a servo file by the law, for a programme of the period `span` (s) and inertias J (N, kg m2).

    The factors of J are the coefficients of (s^2 + 2 d w s + w^2)(s + i).
    """
    T, w, d, i = servo.period, servo.bandwidth, servo.damping_ratio, servo.integral or 0.0
    _, speed, angle, integral = np.polymul([1.0, 2 * d * w, w * w], [1.0, i])
    most = BOUNDS["MAX_WRENCH"].value
    motors = [s.motor if servo.friction else None for s in stand.flywheels]
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


def _inertia(stand: Stand) -> Array:
    """J = f^T Theta f (N, kg m2) of each flywheel about its axis, by the literal reference."""
    return np.diag(spin_inertia(spinning_bodies(bodies_of(stand).mounted, rest_state(stand))))


def _target_check(case: ServoCase, trim: Trim, motion: RequiredMotion | None) -> Check:
    """Fourier coefficients (C, T) of the measured coordinates of the required motion."""
    row = Check("trim_default", "target", case.tolerance)
    if motion is None:
        row.words = NEEDS_MOTION
        return row
    phase = np.arange(NODES) / NODES
    q = motion.at(phase * motion.span, np.zeros_like(motion.mean)).q[:, list(trim.coordinates)]
    target = coefficients(q, phase, trim.harmonics).T
    # all coefficients are averages of the same samples; coordinates at rest have only their rounding
    scale = np.abs(target).max(axis=1, keepdims=True) + RESTING * np.abs(target).max()
    # means, which are not corrected, are shifted by the programme's bias
    row.compare(case.default("trim_default")["target"][:, 1:], target[:, 1:], scale)
    return row


def _matrix_check(case: ServoCase, trim: Trim, motion: RequiredMotion | None, programme: Programme | None) -> Check:
    """Corrections by the error. Without motion and programme only the zeros are judged: means are not corrected."""
    matrix, terms = case.default("trim_default")["matrix"], 2 * trim.harmonics + 1
    row = Check("trim_default", "matrix", max(MATRIX, case.tolerance))
    if matrix.shape != (case.wheels * terms, terms * len(trim.coordinates)):
        row.demand(False, words=f"its shape {list(matrix.shape)} is not that of the servo file")
    elif np.any(matrix[:, ::terms]) or not np.any(matrix):
        row.demand(False, words="it corrects means of the carrier, or nothing at all")
    elif motion is None or programme is None:
        row.words = "only its zeros: give --motion MOTION.json and --programme PROGRAMME.json"
    else:
        try:
            row.compare(matrix, *trim_matrix(case.stand, motion, programme, trim))
        except StateError as error:
            row.words = f"its judge refused: {error}"
    return row


def reset_checks(case: ServoCase, function: str, kind: str) -> list[Check]:
    """All members of the state that a reset makes are zero, whatever was there before."""
    row, ffi = Check(function, "state"), case.made.library.ffi
    state = ffi.new(f"{case.made.prefix}_{kind} *")
    ffi.buffer(state)[:] = b"\x3f" * ffi.sizeof(state[0])
    status, (members,) = case.made.call(function, state)
    wrong = [name for name, value in members.items() if np.any(np.asarray(value) != 0)]
    words = f"status {status_words(status)}; not zero: {', '.join(wrong) or 'none'}"
    row.demand(status == 0 and not wrong, words=words)
    return [row]


def demand_status(row: Check, status: int, limited: bool | None, where: str) -> None:
    """Count a status; one that is not that of the law fails the row. `limited` None: rounding decides."""
    right = {True: ("LIMITED",), False: ("OK",), None: ("OK", "LIMITED")}[limited]
    due = status in [STATUS_VALUES[name] for name in right]
    row.demand(due, where, f"status {status_words(status)}, expected {' or '.join(right)}")


def drawn_samples(
    case: ServoCase, rng: np.random.Generator
) -> Iterator[tuple[dict[str, Array], dict[str, Array], dict[str, Array]]]:
    """Gains, state, wanted and measured values of samples, as the element type holds them.

    The folder's gains in every other sample, else drawn ones that use every term. Torques are such that limits cut now
    and then; errors small, of many turns, and just below and above half turns.
    """
    n, most, unlimited = case.wheels, BOUNDS["MAX_PHASE"].at(case.made.real), BOUNDS["MAX_WRENCH"].value
    table = {name: np.asarray(value) for name, value in case.default("servo_default").items()}

    def rounded(drawn: dict[str, Any]) -> dict[str, Array]:
        return {name: case.made.round(value) for name, value in drawn.items()}

    for number in range(case.count):
        g: dict[str, Any] = table
        if number % 2:
            g = {name: rng.uniform(0.1, 2.0, n) for name in table}
            g |= {"filter": rng.uniform(0.1, 1.0), "back": rng.uniform(0.0, 1.0, n), "lead": 0.0}
            g |= {
                name: np.full(n, unlimited) for name, every in (("limit", 3), ("change", 4)) if not number // 2 % every
            }
        size = np.where(g["limit"] < unlimited, g["limit"], g["angle"] + 1e-3)
        state = {name: rng.uniform(-1, 1, n) * size for name in ("integral", "torque")}
        state["speed"] = rng.normal(size=n) * size / np.maximum(g["speed"], 1e-6)
        phi_ref = rng.uniform(-1, 1, n) * (10.0 if number % 4 else 0.4 * most)
        phi_dot_ref = rng.normal(size=n) * (1.0 if number % 3 else 200.0)
        small = 0.5 * rng.normal(size=n) * np.minimum(1.0, size / np.maximum(g["angle"], 1e-6))
        turns = rng.integers(-3, 4, n) + 0.5 + rng.choice([-1, 1], n) * 10.0 ** rng.uniform(-3, -1, n)
        whole = rng.integers(-20, 21, n) if number % 4 else rng.integers(-int(0.08 * most), int(0.08 * most) + 1, n)
        inputs = {
            "phi_ref": phi_ref,
            "phi_dot_ref": phi_dot_ref,
            "tau_ff": 0.3 * rng.normal(size=n) * size,
            "phi": phi_ref - (small, math.tau * turns, whole * math.tau + small)[number // 2 % 3],
            "phi_dot": phi_dot_ref - 0.3 * rng.normal(size=n) * size / np.maximum(g["speed"], 1e-6),
        }
        yield rounded(g), rounded(state), rounded(inputs)


def step_checks(case: ServoCase) -> Iterable[Check]:
    """Torque, each member of the state, the status, and flags of encoders without a good reading."""
    names, rng, size = ("tau", *STATE), np.random.default_rng((case.seed, 1)), CHANGE[case.made.real]
    rows = {name: Check("servo_step", name, case.tolerance) for name in names}
    masked = Check("servo_step", "encoders without a good reading", case.tolerance)
    status_row, alone = Check("servo_step", "status"), Check("servo_step", "other flywheels")
    for number, (g, state, inputs) in enumerate(drawn_samples(case, rng)):
        flags = rng.choice([0, 0, 1, -7], case.wheels)  # of readings that are not good: any value but 0
        flags[rng.integers(case.wheels)] = 1
        results = []
        for into, lost in ((rows, np.zeros_like(flags)), (dict.fromkeys(names, masked), flags)):
            where = f"sample {number}" + (f", flags {lost.tolist()}" if lost.any() else "")
            none = INVALID_READINGS[number % len(INVALID_READINGS)]
            read = inputs | {name: np.where(lost != 0, none, inputs[name]) for name in ("phi", "phi_dot")}
            mask = lost if lost.any() or number % 2 else None
            status, found = case.made.call("servo_step", g, state, *read.values(), mask, np.zeros(case.wheels))
            laws = [servo_sample(g, state, inputs, lost != 0)]
            for _ in range(NEIGHBOURS):
                aside = [changed(each, size, rng) for each in (g, state, inputs)]
                laws.append(servo_sample(aside[0], aside[1], aside[2], lost != 0))
            scales, limited = scales_of(laws, size)
            demand_status(status_row, status, limited, where)
            results.append({"tau": found[-1], **found[1]})
            for name in names:
                into[name].compare(results[-1][name], laws[0][name], scales[name], where)
        same = all(np.array_equal(*(each[name][flags == 0] for each in results)) for name in names)
        alone.demand(same, where, "flywheels with a good reading have other bits than beside good ones")
    return (*rows.values(), masked, status_row, alone)


def trim_checks(case: ServoCase) -> Iterable[Check]:
    """Corrected angles, speeds and torques; corrections, error and counts of the state; the status."""
    rng, made, size = np.random.default_rng((case.seed, 2)), case.made, CHANGE[case.made.real]
    rows = {name: Check("trim_step", name, case.tolerance) for name in (*DEMAND, "wanted", "present", "error")}
    status_row, counts = Check("trim_step", "status"), Check("trim_step", "sample, rounds")
    for settling, window, of_folder, part in ROUNDS:
        design = case.default("trim_default")
        if not of_folder:  # drawn, using every term
            design |= {"smoothing": rng.uniform(0.1, 1.0), "limit": rng.uniform(0.1, 0.5), "omega": rng.uniform(10, 99)}
            design |= {name: rng.normal(size=np.shape(design[name])) for name in ("inertia", "target", "matrix")}
            design["inertia"] = np.abs(design["inertia"])
        design = {name: made.round(value) for name, value in design.items()} | {"settling": settling, "window": window}
        designs = [design, *(changed(design, size, rng) for _ in range(NEIGHBOURS))]
        laws, target = [TrimLaw(each, case.wheels) for each in designs], design["target"]
        amplitude = part * float(design["limit"]) / max(float(np.abs(design["matrix"]).sum(axis=1).max()), 1e-12)
        table, state = made.hold("trim_step", design, {}, 0.0, *[None] * 4)[:2]
        largest: dict[str, Array] = {}
        for number in range(ROUNDS_EACH * (settling + window + case.wheels)):
            phase = (0.0, 0.5, 1.0 - 2.0**-20)[number % 7] if number % 7 < 3 else float(rng.uniform())
            phase = min(float(made.round(phase)), 1.0 - 2.0**-24)
            required = target @ waves(np.array([phase]), target.shape[1] // 2)[:, 0]
            q = made.round(required + amplitude * rng.normal(size=len(target)))
            given = {key: made.round(rng.normal(size=case.wheels)) for key in DEMAND}
            status, found = made.call("trim_step", table, state, phase, q, *given.values())
            answers = [laws[0].take(phase, q, given)]
            for law in laws[1:]:
                aside = changed({"phase": phase, "q": q, **given}, size, rng)
                answers.append(law.take(aside["phase"], aside["q"], aside))
            scales, limited = scales_of(answers, size)
            # the state keeps the rounding of earlier samples, so scales do not shrink
            largest = {name: np.maximum(scale, largest.get(name, 0.0)) for name, scale in scales.items()}
            where = f"{'its' if of_folder else 'drawn'} numbers, window {window}, sample {number}"
            demand_status(status_row, status, limited, where)
            results = {**found[1], "error": found[1]["sum"], **dict(zip(DEMAND, found[4:], strict=True))}
            for name, row in rows.items():
                if name != "error" or laws[0].ends_window:
                    row.compare(results[name], answers[0][name], largest[name], where)
            there, right = (results["sample"], results["rounds"]), (laws[0].sample, laws[0].rounds)
            counts.demand(there == right, where, f"{there}, expected {right}")
    return (*rows.values(), status_row, counts, _last_round(case))


def _last_round(case: ServoCase) -> Check:
    """The count of rounds stays at the largest int after the last flywheel's correction."""
    design = case.default("trim_default") | {"settling": 0, "window": 1}
    counts = {"sample": case.wheels, "rounds": MOST_ROUNDS}
    zeros = [np.zeros(case.wheels)] * 3
    status, found = case.made.call("trim_step", design, counts, 0.25, np.zeros(len(design["target"])), *zeros)
    end, row = (found[1]["sample"], found[1]["rounds"]), Check("trim_step", "rounds stop at the largest int")
    words = f"status {status_words(status)}, sample {end[0]}, rounds {end[1]}"
    row.demand(status >= 0 and end == (0, MOST_ROUNDS), words=words)
    return row


def coordinate_checks(case: ServoCase) -> list[Check]:
    """Measured coordinates from poses, by SciPy's rotations."""
    rng, made = np.random.default_rng((case.seed, 3)), case.made
    row = Check("trim_coordinates", "q", case.tolerance)
    coordinates = list(case.servo.trim.coordinates) if case.servo.trim is not None else []
    many, angular = len(case.default("trim_default")["target"]), np.array(coordinates) >= 3
    if many != len(coordinates):
        row.demand(False, words=f"the C measures {many} coordinates, the servo file {len(coordinates)}")
        return [row]
    for number in range(POSES):
        position = made.round(rng.normal(size=3) * (1.0 if number % 2 else 1e3))
        # any attitude, or one near that of E0
        drawn = rng.normal(size=4) if number % 3 else np.array([1.0, *(0.1 * rng.normal(size=3))])
        attitude = made.round(drawn / np.linalg.norm(drawn))
        angles = Rotation.from_quat(np.roll(attitude, -1)).as_euler(SEQUENCES[case.stand.angles])
        away = abs(math.sin(angles[1]) if case.stand.angles == "euler" else math.cos(angles[1]))
        if away < NEAR:
            continue
        status, (*_, q) = made.call("trim_coordinates", position, attitude, np.zeros(many))
        if status != STATUS_VALUES["OK"]:
            row.demand(False, f"pose {number}", f"status {status_words(status)}")
            continue
        expected = np.concatenate([position, angles])[coordinates]
        turns = np.where(angular, np.round((q - expected) / math.tau), 0.0)
        scale = np.where(angular, math.pi / away, np.maximum(np.abs(expected), 1e-300))
        row.compare(q - math.tau * turns, expected, scale, f"pose {number}")
    return [row]


JUDGES: dict[str, Callable[[ServoCase], Iterable[Check]]] = {
    "servo_reset": lambda case: reset_checks(case, "servo_reset", "servo_state"),
    "servo_step": step_checks,
    "trim_reset": lambda case: reset_checks(case, "trim_reset", "trim_state"),
    "trim_step": trim_checks,
    "trim_coordinates": coordinate_checks,
}
"""The judge of each public function."""


def function_checks(case: ServoCase) -> Iterator[Check]:
    """Every public function of the header, and those that it lacks."""
    public, trim = case.made.library.functions(), case.made.library.has("trim_default")
    for function in dict.fromkeys((*JUDGES, *public)):
        # `generalized` of a held carrier's C gives the coordinates that its trim measures
        needed = trim and (function != "trim_coordinates" or case.stand.hold is None)
        if function in public and function in JUDGES:
            yield from JUDGES[function](case)
            yield refusal_check(case, function)
        elif function in public or function.startswith("servo") or needed:
            row = Check(function, "function")
            row.demand(False, words="a public function without a judge" if function in public else LACKS)
            yield row


LACKS = "not in the C: export the servo again"

OPTIONAL, RESULTS, TRUSTED = ("invalid",), ("servo_step tau", "trim_coordinates q"), ("gains", "design")
"""Arguments that may be null; that only receive results; tables that a program has in its text."""

LIKE = {
    "phi_ref": "phi",
    "phi_dot_ref": "phi_dot",
    "tau_ff": "tau",
    "speed": "phi_dot",
    "integral": "tau",
    "torque": "tau",
}
"""Quantities of the contract whose bounds others have; a filtered speed may be the difference of two."""

NOT_FINITE = tuple((value, "NOT_FINITE") for value in (math.nan, math.inf, -math.inf))


def refusal_check(case: ServoCase, function: str) -> Check:
    """Bad inputs of a function are refused, one wrong value at a time, with all results untouched."""
    row, made = Check(function, "bad inputs refused, results untouched"), case.made
    good = _good_arguments(case, function)
    for wrong in _wrong_values(case, function, good):
        held = made.hold(function, *(None if x is NULL else x for x in with_value(good, wrong).values()))
        written = [each for each in held if isinstance(each, made.library.ffi.CData) and each != made.library.ffi.NULL]
        before = [bytes(made.library.ffi.buffer(each)) for each in written]
        status = int(made.library.function(function)(*held))
        words = f"status {status_words(status)}, expected {wrong.status}"
        row.demand(status == STATUS_VALUES[wrong.status], wrong.words, words)
        same = before == [bytes(made.library.ffi.buffer(each)) for each in written]
        row.demand(same, wrong.words, "refused, but results were written")
    return row


def _good_arguments(case: ServoCase, function: str) -> dict[str, Any]:
    """Arguments of a function by name; of a state those members that it checks."""
    numbers = [0.125] * case.wheels
    if function.endswith("reset"):
        return {"state": {}}
    if function == "servo_step":
        state = dict.fromkeys(STATE, numbers)
        inputs = dict.fromkeys(("phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot"), numbers)
        gains = case.made.library.default("servo_default")
        return {"gains": gains, "state": state, **inputs, "invalid": None, "tau": numbers}
    q = [0.125] * len(case.default("trim_default")["target"])
    if function == "trim_coordinates":
        return {"position": [0.125] * 3, "attitude": [1.0, 0.0, 0.0, 0.0], "q": q}
    given = {"design": case.made.library.default("trim_default"), "state": {"sample": 0, "rounds": 0}, "phase": 0.25}
    return given | {"q": q} | dict.fromkeys(DEMAND, numbers)


def _wrong_values(case: ServoCase, function: str, good: dict[str, Any]) -> Iterator[WrongValue]:
    """Every wrong value of every argument, and of what a state has."""
    for name, value in good.items():
        if name not in OPTIONAL and name != "phase":
            yield WrongValue((name,), NULL, "BAD_ARGUMENT")
        if name in (*OPTIONAL, *TRUSTED) or f"{function} {name}" in RESULTS:
            continue
        inputs: dict[tuple[str, ...], Any] = {(name,): value}
        if isinstance(value, dict):
            inputs = {(name, member): numbers for member, numbers in value.items()}
        for path, numbers in inputs.items():
            places = [(i,) for i in range(len(numbers))] if isinstance(numbers, list) else [()]
            for bad, status in _wrong_numbers(case, path[-1]):
                yield from (WrongValue((*path, *place), bad, status) for place in places)


def _wrong_numbers(case: ServoCase, symbol: str) -> tuple[tuple[float, str], ...]:
    """Wrong values of one number, with the statuses that are due."""
    if symbol in ("sample", "rounds"):  # counts that the trim never makes
        design = case.default("trim_default")
        end = int(design["settling"]) + int(design["window"]) + case.wheels
        return tuple((value, "BAD_ARGUMENT") for value in ((-1, end) if symbol == "sample" else (-1,)))
    if symbol in ("phase", "attitude"):
        wrong: tuple[float, ...] = (1.0, -0.01, 7.0) if symbol == "phase" else (1.01, 3.0)
    else:
        most = BEYOND * limits_of(LIKE.get(symbol, symbol), case.made.real)[0] * (2 if symbol == "speed" else 1)
        wrong = most, -most
    return (*NOT_FINITE, *((value, "RANGE") for value in wrong))
