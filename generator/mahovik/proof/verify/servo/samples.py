"""Judges of `servo_reset` and `servo_step`: single samples from drawn states, with the folder's gains and others."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.servo.folder import CompiledServo
from mahovik.proof.verify.servo.law import Array, LawResult, servo_sample

SETPOINTS = ("phi_ref", "phi_dot_ref", "tau_ff")
STATE = ("integral", "speed", "torque")
INVALID_READINGS = (math.nan, math.inf, -math.inf, 1e300)
"""Readings of an encoder that has none."""


def check_status(row: Check, status: int, limited: bool | None, where: str) -> None:
    """Count a status; one that is not that of the law fails the row. `limited` None: rounding decides."""
    right = {True: ("LIMITED",), False: ("OK",), None: ("OK", "LIMITED")}[limited]
    words = f"status {status_words(status)}, expected {' or '.join(right)}"
    row.demand(status in [STATUS_VALUES[name] for name in right], where, words)


def reset_row(made: CompiledServo, function: str, kind: str) -> Check:
    """All members of the state that a reset makes are zero, whatever was there before."""
    row = Check(function, "state")
    ffi = made.library.ffi
    state = ffi.new(f"{made.prefix}_{kind} *")
    ffi.buffer(state)[:] = b"\x3f" * ffi.sizeof(state[0])
    status = made.call(function, state)
    wrong = [name for name, value in made.members(state).items() if np.any(np.asarray(value) != 0)]
    words = f"status {status_words(status)}; not zero: {', '.join(wrong) or 'none'}"
    row.demand(status == 0 and not wrong, "", words)
    return row


class _Samples:
    """Drawn samples of a servo: gains, states, wanted and measured values as the element type holds them."""

    def __init__(self, made: CompiledServo, seed: int) -> None:
        self._made, self._rng = made, np.random.default_rng((seed, 1))
        self._own = {name: np.asarray(value) for name, value in made.default("servo_default").items()}
        self.most = BOUNDS["MAX_PHASE"].at(made.real)

    def gains(self, number: int) -> dict[str, Array]:
        """The folder's gains in every other sample, else drawn ones that use every term."""
        if number % 2 == 0:
            return self._own
        n, rng = self._made.count, self._rng
        drawn: dict[str, Any] = {name: rng.uniform(0.1, 2.0, n) for name in self._own}
        drawn |= {"filter": rng.uniform(0.1, 1.0), "back": rng.uniform(0.0, 1.0, n), "lead": 0.0}
        for name, every in (("limit", 3), ("change", 4)):
            if number // 2 % every == 0:
                drawn[name] = np.full(n, BOUNDS["MAX_WRENCH"].value)
        return {name: self._made.round(value) for name, value in drawn.items()}

    def torque(self, g: dict[str, Array]) -> Array:
        """Magnitude of torques that limits cut now and then."""
        return np.asarray(np.where(g["limit"] < BOUNDS["MAX_WRENCH"].value, g["limit"], g["angle"] + 1e-3))

    def state(self, g: dict[str, Array]) -> dict[str, Array]:
        """A state that the servos can reach with these gains."""
        size, n = self.torque(g), self._made.count
        drawn = {name: self._rng.uniform(-1, 1, n) * size for name in ("integral", "torque")}
        drawn["speed"] = self._rng.normal(size=n) * size / np.maximum(g["speed"], 1e-6)
        return {name: self._made.round(value) for name, value in drawn.items()}

    def inputs(self, g: dict[str, Array], number: int) -> dict[str, Array]:
        """Wanted and measured values; errors small, of many turns, and just below and above half turns."""
        n, rng, size = self._made.count, self._rng, self.torque(g)
        phi_ref = rng.uniform(-1, 1, n) * (10.0 if number % 4 else 0.4 * self.most)
        small = 0.5 * rng.normal(size=n) * np.minimum(1.0, size / np.maximum(g["angle"], 1e-6))
        turns = rng.integers(-3, 4, n) + 0.5 + rng.choice([-1, 1], n) * 10.0 ** rng.uniform(-3, -1, n)
        most = 20 if number % 4 else int(0.08 * self.most)
        whole = rng.integers(-most, most + 1, n) * math.tau + small
        error = (small, math.tau * turns, whole)[number // 2 % 3]
        phi_dot_ref = rng.normal(size=n) * (1.0 if number % 3 else 200.0)
        drawn = {
            "phi_ref": phi_ref,
            "phi_dot_ref": phi_dot_ref,
            "tau_ff": 0.3 * rng.normal(size=n) * size,
            "phi": phi_ref - error,
            "phi_dot": phi_dot_ref - 0.3 * rng.normal(size=n) * size / np.maximum(g["speed"], 1e-6),
        }
        return {name: self._made.round(value) for name, value in drawn.items()}

    def mask(self) -> list[int]:
        """Flags of readings that are not good, of any value but 0."""
        flags = [int(each) for each in self._rng.choice([0, 0, 1, -7], self._made.count)]
        flags[int(self._rng.integers(self._made.count))] = 1
        return flags


def _step(
    made: CompiledServo, g: dict[str, Array], state: dict[str, Array], row: dict[str, Array], flags: list[int] | None
) -> tuple[int, dict[str, Array]]:
    """Status and results of one sample of the C: `tau` and the members of the state."""
    kept, tau = made.struct("servo_state", state), made.reals(np.zeros(made.count))
    given = [made.reals(row[name]) for name in (*SETPOINTS, "phi", "phi_dot")]
    status = made.call("servo_step", made.struct("servo_gains", g), kept, *given, made.flags(flags), tau)
    return status, {"tau": made.read(tau), **made.members(kept)}


def _compare(rows: dict[str, Check], found: dict[str, Array], expected: LawResult, where: str) -> None:
    """Note every result against the law."""
    for name, row in rows.items():
        row.compare(found[name], expected.values[name], expected.scales[name], where)


def step_rows(made: CompiledServo, seed: int, count: int) -> Iterator[Check]:
    """Torque, each member of the state, the status, and flags of encoders without a good reading."""
    tolerance = made.bounds.default
    drawn = _Samples(made, seed)
    rows = {name: Check("servo_step", name, tolerance) for name in ("tau", *STATE)}
    masked = Check("servo_step", "encoders without a good reading", tolerance)
    status_row, alone = Check("servo_step", "status"), Check("servo_step", "other flywheels")
    for number in range(count):
        g = drawn.gains(number)
        state, row = drawn.state(g), drawn.inputs(g, number)
        expected = servo_sample(g, state, row, row["phi"], row["phi_dot"], tolerance)
        status, found = _step(made, g, state, row, None if number % 2 else [0] * made.count)
        where = f"sample {number}"
        check_status(status_row, status, expected.limited, where)
        _compare(rows, found, expected, where)
        flags = drawn.mask()
        lost = np.array(flags) != 0
        none = INVALID_READINGS[number % len(INVALID_READINGS)]
        blind = row | {name: np.where(lost, none, row[name]) for name in ("phi", "phi_dot")}
        phi, phi_dot = np.where(lost, row["phi_ref"], row["phi"]), np.where(lost, row["phi_dot_ref"], row["phi_dot"])
        expected = servo_sample(g, state, row, phi, phi_dot, tolerance)
        status, without = _step(made, g, state, blind, flags)
        check_status(status_row, status, expected.limited, f"{where}, flags {flags}")
        _compare(dict.fromkeys(("tau", *STATE), masked), without, expected, f"{where}, flags {flags}")
        same = all(np.all(without[name][~lost] == found[name][~lost]) for name in ("tau", *STATE))
        words = "flywheels with a good reading have other bits than beside good ones"
        alone.demand(same, f"{where}, flags {flags}", words)
    yield from (each for each in (*rows.values(), masked))
    yield from (status_row, alone)
