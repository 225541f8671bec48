"""Expected results of a servo's self-test: samples with drawn inputs, run by the interpreter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.lower.golden import fnv1a
from mahovik.core.lower.servo import ServoForm
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Precision

SEED = 0x53455256
MULTIPLIER, INCREMENT = 1664525, 1013904223
"""x = MULTIPLIER x + INCREMENT modulo 2^32; its upper 24 bits are a number."""

LISTED = 3
"""Samples whose torques are listed."""

SWEEP = 200
"""Samples of a run, all of which are in its hash."""

LARGEST = {"phi_ref": 4.0, "phi_dot_ref": 64.0, "tau_ff": 4.0, "angle_error": 0.25, "speed_error": 2.0, "pose": 2.0**-7}
"""Magnitudes of what is drawn: powers of two, so that scaling is exact."""

LOST = 7
"""One in 7 readings is not good: it is the largest number."""

SETTLING, WINDOW = 3, 20
"""Period of the trim in the test, in samples: several rounds fit into the run."""


@dataclass(frozen=True)
class Golden:
    """Torques of the first samples; hashes of the runs of servo and trim (None without)."""

    torques: tuple[tuple[Any, ...], ...]
    servo: int
    trim: int | None


def is_lost(sample: int, flywheel: int) -> bool:
    """Whether an encoder gives no good reading in a sample of the run."""
    return (sample + flywheel) % LOST == 0


class DrawGenerator:
    """The generator that the C of the test has as well."""

    def __init__(self, precision: Precision) -> None:
        self._scalar = precision.scalar
        self._x = SEED

    def real(self, largest: float) -> Any:
        """A number in +-largest."""
        bits = self._next() >> 8
        return self._scalar(bits - (1 << 23)) * self._scalar(largest * 2.0**-23)

    def phase(self) -> Any:
        """A number in [0, 1)."""
        return self._scalar(self._next() >> 8) * self._scalar(2.0**-24)

    def reals(self, count: int, largest: float) -> list[Any]:
        """Return this many numbers."""
        return [self.real(largest) for _ in range(count)]

    def _next(self) -> int:
        self._x = (MULTIPLIER * self._x + INCREMENT) % (1 << 32)
        return self._x


def golden(
    program: Program, form: ServoForm, gains: Mapping[str, Any], design: Mapping[str, Any] | None = None
) -> Golden:
    """Runs of the servo with its gains, and of the trim with its design."""
    interpreter = Interpreter(program)
    torques, total = _servo(interpreter, program.precision, form, gains)
    trim = None if design is None else _trim(interpreter, program.precision, form, design)
    return Golden(torques, total, trim)


def _servo(
    interpreter: Interpreter, precision: Precision, form: ServoForm, gains: Mapping[str, Any]
) -> tuple[tuple[tuple[Any, ...], ...], int]:
    drawn, total, n = DrawGenerator(precision), fnv1a(b""), int(form.count)
    state = interpreter.run("servo_reset", {})[1]["state"]
    listed = []
    for number in range(SWEEP):
        phi_ref, phi_dot_ref, tau_ff = (drawn.reals(n, LARGEST[k]) for k in ("phi_ref", "phi_dot_ref", "tau_ff"))
        angle, speed = drawn.reals(n, LARGEST["angle_error"]), drawn.reals(n, LARGEST["speed_error"])
        inputs = {
            "gains": gains,
            "state": state,
            "phi_ref": phi_ref,
            "phi_dot_ref": phi_dot_ref,
            "tau_ff": tau_ff,
            "phi": [a - b for a, b in zip(phi_ref, angle, strict=True)],
            "phi_dot": [a - b for a, b in zip(phi_dot_ref, speed, strict=True)],
        }
        inputs["invalid"] = invalid = [int(is_lost(number, s)) for s in range(n)]
        for name in ("phi", "phi_dot"):
            inputs[name] = [precision.largest if bad else x for bad, x in zip(invalid, inputs[name], strict=True)]
        status, outputs = interpreter.run("servo_step", inputs)
        state = outputs["state"]
        listed.append(tuple(precision.scalar(x) for x in outputs["tau"]))
        total = _hash_answers(precision, total, int(status), outputs["tau"])
    return tuple(listed[:LISTED]), total


def _trim(interpreter: Interpreter, precision: Precision, form: ServoForm, design: Mapping[str, Any]) -> int:
    assert form.trim is not None
    drawn, total, n = DrawGenerator(precision), fnv1a(b""), int(form.count)
    state = interpreter.run("trim_reset", {})[1]["state"]
    filled = interpreter.fill_storage(form.design, {**design, "settling": SETTLING, "window": WINDOW})
    for _ in range(SWEEP):
        phase = drawn.phase()
        if form.trim.held:
            q = drawn.reals(int(form.trim.measured), LARGEST["pose"])
        else:
            pose = drawn.reals(6, LARGEST["pose"])
            place = {"position": pose[:3], "attitude": [1.0, *pose[3:]]}
            q = interpreter.run("trim_coordinates", place)[1]["q"]
        inputs = {
            "design": filled,
            "state": state,
            "phase": phase,
            "q": q,
            "phi": drawn.reals(n, LARGEST["phi_ref"]),
            "phi_dot": drawn.reals(n, LARGEST["phi_dot_ref"]),
            "tau": drawn.reals(n, LARGEST["tau_ff"]),
        }
        status, outputs = interpreter.run("trim_step", inputs)
        state = outputs["state"]
        total = _hash_answers(precision, total, int(status), [*outputs["phi"], *outputs["phi_dot"], *outputs["tau"]])
    return total


def _hash_answers(precision: Precision, total: int, status: int, values: list[Any]) -> int:
    kind = f"<f{precision.width // 8}"
    return fnv1a(np.array([status, *values], dtype=kind).tobytes(), total)
