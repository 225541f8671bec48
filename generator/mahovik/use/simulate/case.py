"""A simulation: stand, regime, start, times, data for every backend, and the moments that it yields; a start's file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.evaluation import STATE
from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.regime import Regime
from mahovik.core.stand.files import readable_text
from mahovik.core.stand.model import Stand, State, Vec3, Vec6
from mahovik.core.stand.units import show
from mahovik.errors import StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.verify.draw import with_pose
from mahovik.use.simulate.held import allowed_start, rates

Array = NDArray[np.float64]


LARGE = 0.1 * BOUNDS["MAX_PHASE"].value  # rad; larger phases are wrapped before they enter a state
MAX_STEP = BOUNDS["MAX_STEP"].value  # s; the C refuses longer steps
MAX_ROWS = 10_000_000  # of output
_TURN = 2 * math.pi


@dataclass(frozen=True, eq=False)
class Case:
    """A run of `until` s with output every `every` s; steps of at most `dt` s, of order 4 or 2.

    `start`: position, attitude, V; also phases and speeds that the regime does not give. `real`: element type of the
    C; `carried`: its steps keep what rounding takes, in a carry. Raises UsageError.
    """

    stand: Stand
    regime: Regime
    start: State
    until: float
    every: float = 1e-3
    dt: float = 1e-4
    order: int = 4
    real: str = "double"
    carried: bool = False

    def __post_init__(self) -> None:
        for name in ("until", "every", "dt"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise UsageError(f"{name} {value:g}: expected a time above 0, in s")
        if self.dt > MAX_STEP:
            raise UsageError(f"dt {self.dt:g}: expected at most {MAX_STEP:g} s, the longest step of the C")
        if self.order not in (2, 4):
            raise UsageError(f"order {self.order}: expected 4 or 2")
        if self.until / self.every > MAX_ROWS:
            raise UsageError(f"every {self.every:g}: more than {MAX_ROWS // 1_000_000} million rows")

    @cached_property
    def times(self) -> Array:
        """Times of output: 0, every, 2 every, ..., until."""
        whole = math.floor(self.until / self.every * (1 + 1e-12))
        times: Array = self.every * np.arange(whole + 1, dtype=np.float64)
        if self.until - times[-1] > 1e-9 * self.every:
            times = np.append(times, self.until)
        times[-1] = self.until
        return times

    @cached_property
    def phi0(self) -> Array:
        """Phases at t = 0."""
        pairs = zip(self.regime.flywheels, self.start.phi, strict=True)
        return np.array([phi if wheel.phase is None else wheel.phase for wheel, phi in pairs], dtype=np.float64)

    @cached_property
    def phi_dot0(self) -> Array:
        """Speeds at t = 0: by the speed law, or the given ones for a torque law."""
        _, by_law, _ = self.regime.motion(np.zeros(1))
        triples = zip(self.regime.flywheels, self.start.phi_dot, by_law[0], strict=True)
        result = [
            (open_ if wheel.speed is None else wheel.speed) if wheel.by_torque else law for wheel, open_, law in triples
        ]
        return np.array(result, dtype=np.float64)

    def motion(self, t: Array) -> tuple[Array, Array, Array]:
        """phi, phi', phi'' (times x N) of flywheels whose speed is given."""
        phi, phi_dot, phi_ddot = self.regime.motion(t)
        return phi + self.phi0, phi_dot, phi_ddot

    def wrenches(self, t: Array, bodies: Sequence[str]) -> Array:
        """Run-time wrenches (times x 6 W) of the regime on bodies, in their order."""
        none, tables = np.zeros((len(t), 6)), self.regime.wrenches
        return np.hstack([np.zeros((len(t), 0)), *(tables[b].at(t) if b in tables else none for b in bodies)])

    def torques(self, t: float, phi_dot: Array) -> Array:
        """Drive torques at a time and speeds, by motors and regime."""
        return self.regime.torques(t, phi_dot, tuple(s.motor for s in self.stand.flywheels))

    def state(self, t: float, position: Array, attitude: Array, V: Array,
              phi: Array, phi_dot: Array) -> State:  # fmt: skip
        """A state for evaluation, with the run-time wrenches at time t and a normalised quaternion."""
        length = math.hypot(*attitude)
        w, x, y, z = (float(c) / length for c in attitude)
        return replace(
            self.start,
            position=cast(Vec3, tuple(position.tolist())),
            angles=None,
            quaternion=(w, x, y, z),
            V=cast(Vec6, tuple(V.tolist())),
            phi=tuple(wrap_phases(phi).tolist()),
            phi_dot=tuple(phi_dot.tolist()),
            wrench=self.regime.wrench(t),
            u=rates(self.stand.hold, V),
        )

    def moving(self, state: State, V_dot: Array, phi_ddot: Array) -> State:
        """The state with its accelerations."""
        return replace(
            state,
            V_dot=cast(Vec6, tuple(V_dot.tolist())),
            phi_ddot=tuple(phi_ddot.tolist()),
            u_dot=rates(self.stand.hold, V_dot),
        )


def wrap_phases(phi: Array) -> Array:
    """Phases wrapped into a state's range."""
    return np.where(np.abs(phi) > LARGE, np.remainder(phi, _TURN), phi)


START_KEYS = ("id", "position", "angles", "quaternion", "V", "u", "phi", "phi_dot")
"""Keys of a state that a start may have."""

REST_KEYS = ("state", "V_dot", "free", "unstable")
"""Keys of the rest pose in the JSON of `mahovik check`."""


HINT = "; the regime gives torques and wrenches"


def load_start(path: Path, stand: Stand, keys: tuple[str, ...] = START_KEYS, hint: str = HINT) -> State:
    """The state in a JSON file; `keys` are allowed. Raises UsageError; `hint`: why no others."""
    try:
        text = readable_text(path, "a state (JSON)")
    except ValueError as error:
        raise UsageError(str(error)) from None
    try:
        return read_start(text, stand, keys, hint)
    except UsageError as error:
        raise UsageError(f"{path.name}: {error}") from None


def read_start(text: str, stand: Stand, keys: tuple[str, ...] = START_KEYS, hint: str = HINT) -> State:
    """The state that a JSON text gives, as `load_start`. Raises UsageError."""
    from mahovik.proof.verify.states import read_object, read_request, refuse_duplicates

    try:
        start = read_object(text)
        refuse_duplicates(start)
        if isinstance(start.get("rest"), dict):  # what `mahovik check --json` printed
            start = start["rest"]
        if "state" in start:
            _refuse_unknown(start, REST_KEYS, "")
            start = start["state"]
            if not isinstance(start, dict):
                raise StateError("state: expected an object")
            refuse_duplicates(start)
        _refuse_unknown(start, keys if stand.hold else tuple(key for key in keys if key != "u"), hint)
        state = read_request(stand, {**start, "want": ["forward"]}).state
        return allowed_start(stand, with_pose(stand, state, start.keys()) if stand.hold is not None else state)
    except StateError as error:
        raise UsageError(str(error)) from None


def _refuse_unknown(document: dict[str, Any], keys: tuple[str, ...], hint: str) -> None:
    for key in document:
        if key not in keys:
            if key in STATE:
                raise StateError(f'"{key}" is not part of a start, expected some of {", ".join(keys)}{hint}')
            raise StateError(f"unknown key {show(key)}{suggestion(key, keys)}")
