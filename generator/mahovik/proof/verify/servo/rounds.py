"""Judges of `trim_reset`, `trim_step` and `trim_coordinates`: whole rounds, and poses of the carrier."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.servo.folder import CompiledServo
from mahovik.proof.verify.servo.law import Array, TrimLaw
from mahovik.proof.verify.servo.samples import check_status

INPUTS = ("phi", "phi_dot", "tau")
ROUNDS = ((3, 20, True, 0.1), (0, 7, True, 10.0), (2, 11, False, 1.0), (5, 1, False, 0.05))
"""Samples of settling and of a window, whether the numbers are the folder's, and the size of what is measured."""

ROUNDS_EACH = 3
MOST_ROUNDS = 2**31 - 1
"""Number of rounds at which the count stops."""

SEQUENCES = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""Axes about which psi, theta, phi turn, each in the frame that the one before has turned."""

NEAR = 0.05
"""Poses with |cos theta| (Euler: |sin theta|) below this are left out: there angles lose their digits."""


def _design(made: CompiledServo, rng: np.random.Generator, settling: int, window: int, own: bool) -> dict[str, Any]:
    """The folder's design, or a drawn one that uses every term, with these numbers of samples."""
    found = made.default("trim_default")
    if not own:
        found |= {"smoothing": rng.uniform(0.1, 1.0), "limit": rng.uniform(0.1, 0.5), "omega": rng.uniform(10, 100)}
        found |= {name: rng.normal(size=np.shape(found[name])) for name in ("inertia", "target", "matrix")}
        found |= {"inertia": np.abs(found["inertia"])}
    inputs = {name: made.round(value) for name, value in found.items()}
    return inputs | {"settling": settling, "window": window}


def trim_rows(made: CompiledServo, seed: int) -> Iterator[Check]:
    """Corrected angles, speeds and torques; corrections, error and counts of the state; the status."""
    rng = np.random.default_rng((seed, 2))
    terms = int(np.shape(made.default("trim_default")["target"])[1])
    # cosine and sine of k theta are sums of k angles: their rounding grows with k
    tolerance = made.bounds.default * max(1, terms // 2)
    rows = {name: Check("trim_step", name, tolerance) for name in (*INPUTS, "wanted", "present", "error")}
    status_row, counts = Check("trim_step", "status"), Check("trim_step", "sample, rounds")
    for settling, window, own, size in ROUNDS:
        design = _design(made, rng, settling, window, own)
        name = f"{'its' if own else 'drawn'} numbers, window {window}"
        _run(made, rng, design, size, name, (rows, status_row, counts))
    yield from (each for each in rows.values())
    yield from (status_row, counts, _last_round_row(made))


def _run(
    made: CompiledServo,
    rng: np.random.Generator,
    design: dict[str, Any],
    size: float,
    name: str,
    into: tuple[dict[str, Check], Check, Check],
) -> None:
    """Rounds of one design, sample by sample, compared with the law of the whole."""
    rows, status_row, counts = into
    law = TrimLaw(design, made.count, rows["phi"].limit)
    ffi = made.library.ffi
    state, table = ffi.new(f"{made.prefix}_trim_state *"), made.struct("trim_design", design)
    amplitude = size * float(design["limit"]) / max(float(np.abs(design["matrix"]).sum(axis=1).max()), 1e-12)
    for number in range(ROUNDS_EACH * (design["settling"] + design["window"] + made.count)):
        phase = (0.0, 0.5, 1.0 - 2.0**-20)[number % 7] if number % 7 < 3 else float(rng.uniform())
        phase = min(float(made.round(phase)), 1.0 - 2.0**-24)
        course = _series(np.asarray(design["target"]), phase)
        q = made.round(course + amplitude * rng.normal(size=len(course)))
        given = {key: made.round(rng.normal(size=made.count)) for key in INPUTS}
        changed = {key: made.reals(value) for key, value in given.items()}
        status = made.call("trim_step", table, state, phase, made.reals(q), *changed.values())
        expected, found, where = law.take(phase, q, given), made.members(state), f"{name}, sample {number}"
        check_status(status_row, status, expected.limited, where)
        for key in INPUTS:
            rows[key].compare(made.read(changed[key]), expected.values[key], expected.scales[key], where)
        largest = law.size.max(axis=1, keepdims=True)
        rows["wanted"].compare(found["wanted"], law.wanted, law.size, where)
        rows["present"].compare(found["present"], law.present, np.broadcast_to(largest, law.present.shape), where)
        if law.ends_window:
            rows["error"].compare(found["sum"], law.error, law.error_scale, where)
        words = f"{found['sample']}, {found['rounds']}, expected {law.sample}, {law.rounds}"
        counts.demand((found["sample"], found["rounds"]) == (law.sample, law.rounds), where, words)


def _series(coefficients: Array, phase: float) -> Array:
    """Values (C) of Fourier series with the coefficients (C, T) at a phase."""
    k = np.arange(1, coefficients.shape[1] // 2 + 1)
    spun = np.exp(2j * math.pi * k * phase)
    return np.asarray(coefficients[:, 0] + coefficients[:, 1::2] @ spun.real + coefficients[:, 2::2] @ spun.imag)


def _last_round_row(made: CompiledServo) -> Check:
    """The count of rounds stays at the largest int."""
    row = Check("trim_step", "rounds stop at the largest int")
    design = made.default("trim_default") | {"settling": 0, "window": 1}
    state = made.library.ffi.new(f"{made.prefix}_trim_state *")
    state.sample, state.rounds = made.count, MOST_ROUNDS  # the last flywheel's correction
    zeros = [made.reals(np.zeros(made.count)) for _ in INPUTS]
    q = made.reals(np.zeros(len(design["target"])))
    status = made.call("trim_step", made.struct("trim_design", design), state, 0.25, q, *zeros)
    words = f"status {status_words(status)}, sample {state.sample}, rounds {state.rounds}"
    row.demand(status >= 0 and (state.sample, state.rounds) == (0, MOST_ROUNDS), "", words)
    return row


def coordinate_rows(made: CompiledServo, stand: Stand, coordinates: tuple[int, ...], seed: int) -> Iterator[Check]:
    """Measured coordinates from poses, by SciPy's rotations. `coordinates`: numbers among x, y, z, psi, theta, phi."""
    rng = np.random.default_rng((seed, 3))
    row = Check("trim_coordinates", "q", made.bounds.default)
    many = len(made.default("trim_default")["target"])
    if many != len(coordinates):
        row.note(math.inf, "", f"the C measures {many} coordinates, the servo file {len(coordinates)}")
        yield row
        return
    for number in range(200):
        position = made.round(rng.normal(size=3) * (1.0 if number % 2 else 1e3))
        attitude = made.round(_turn(rng, number))
        w, x, y, z = attitude
        angles = Rotation.from_quat([x, y, z, w]).as_euler(SEQUENCES[stand.angles])
        away = abs(math.sin(angles[1]) if stand.angles == "euler" else math.cos(angles[1]))
        if away < NEAR:
            continue
        q = made.reals(np.zeros(many))
        status = made.call("trim_coordinates", made.reals(position), made.reals(attitude), q)
        if status != STATUS_VALUES["OK"]:
            row.note(math.inf, f"pose {number}", f"status {status_words(status)}")
            continue
        expected = np.concatenate([position, angles])[list(coordinates)]
        found, angular = made.read(q), np.array(coordinates) >= 3
        turns = np.where(angular, np.round((found - expected) / math.tau), 0.0)
        scale = np.where(angular, math.pi / away, np.maximum(np.abs(expected), 1e-300))
        row.compare(found - math.tau * turns, expected, scale, f"pose {number}")
    yield row


def _turn(rng: np.random.Generator, number: int) -> Array:
    """A unit quaternion, w first: any attitude, or one near that of E0."""
    drawn = rng.normal(size=4) if number % 3 else np.array([1.0, *(0.1 * rng.normal(size=3))])
    return np.asarray(drawn / np.linalg.norm(drawn))
