"""Functions of a servo's C by the law: inputs that are drawn for each, and what they must refuse."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from mahovik.contract.limits import LIMITS, Limits
from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.algebra import Array
from mahovik.proof.reference.pieces import bodies_of, spin_inertia
from mahovik.proof.verify.compare import Rows
from mahovik.proof.verify.held import turns_of
from mahovik.proof.verify.programme.compiled import Part
from mahovik.proof.verify.programme.compiled import judge_law as judge
from mahovik.proof.verify.scales import Laws
from mahovik.proof.verify.servo import law

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
