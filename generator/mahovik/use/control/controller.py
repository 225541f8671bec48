"""What firmware does once per sample: read the encoders, and the C of servos and trim, compiled and called."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.servo import ServoTables, servo_code
from mahovik.core.lower.servo import ServoForm, TrimForm, lower_servo
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library, uniform_data
from mahovik.errors import StateError
from mahovik.use.control.reference_motion import ReferenceMotion
from mahovik.use.control.servo import gains
from mahovik.use.control.trim import TrimDesign, trim_members
from mahovik.use.numeric.se3 import Array


class Encoders:
    """Encoders of the stand file: a reading is the middle of the count reached.

    A flywheel without an encoder, or any if `ideal`, is measured exactly and without delay. `latency`: (N, s).
    """

    def __init__(self, stand: Stand, ideal: bool = False) -> None:
        encoders = [None if ideal else s.encoder for s in stand.flywheels]
        self.latency = np.array([0.0 if e is None else e.latency for e in encoders])
        self._exact = np.array([e is None for e in encoders])
        self._counts = np.array([1 if e is None else e.counts for e in encoders]) / (2.0 * np.pi)
        self._zero = np.array([0.0 if e is None else e.zero for e in encoders])

    def read(self, phi: Array) -> Array:
        """Angles (N, rad) as measured; true angles are not wrapped."""
        counted = (np.floor(self._counts * phi + self._zero) + 0.5 - self._zero) / self._counts
        return np.where(self._exact, phi, counted)


_LIMITED = STATUS_VALUES["LIMITED"]


class Controller:
    """`servo_step` and `trim_step` of the emitted C, with their states.

    limited      samples so far in which the servo cut a torque
    corrections  (N, T): present Fourier coefficients of the trim, rad; T = 1 without trim
    """

    def __init__(self, wanted: ReferenceMotion, servo: Servo, design: TrimDesign | None) -> None:
        stand, N = wanted.stand, len(wanted.stand.flywheels)
        members = None if design is None else trim_members(design, wanted.motion, wanted.programme, servo.period)
        trim = None if design is None else (design.trim.coordinates, design.trim.harmonics)
        self._library = library = _compile_servos(stand, trim)
        ffi, name = library.ffi, stand.name
        self._prefix, self._feedforward = name, servo.feedforward
        self._gains = ffi.new(f"{name}_servo_gains *", gains(stand, servo, wanted.motion.span))
        self._servo, self._servo_step = ffi.new(f"{name}_servo_state *"), library.function("servo_step")
        self._check(library.function("servo_reset")(self._servo))
        self.limited = 0
        # phi_ref, phi_dot_ref, tau_ff, phi, phi_dot, tau
        self._rows = np.zeros((6, N))
        self._places = [ffi.cast(f"{name}_real *", row.ctypes.data) for row in self._rows]
        self._all_valid = ffi.NULL
        self._trim: Any = None
        self.corrections = np.zeros((N, 1))
        if design is not None:
            self._design = ffi.new(f"{name}_trim_design *", members)
            self._trim, self._trim_step = ffi.new(f"{name}_trim_state *"), library.function("trim_step")
            self._check(library.function("trim_reset")(self._trim))
            self._coordinates = list(design.trim.coordinates)
            self._q = np.zeros(len(self._coordinates))
            self._q_place = ffi.cast(f"{name}_real *", self._q.ctypes.data)
            shape = (N, 2 * design.trim.harmonics + 1)
            self.corrections = np.frombuffer(ffi.buffer(self._trim.present), dtype=np.float64).reshape(shape)

    @property
    def trims(self) -> bool:
        """Whether it needs the carrier's coordinates."""
        return self._trim is not None

    @property
    def rounds(self) -> int:
        """Number of corrections by the trim."""
        return 0 if self._trim is None else int(self._trim.rounds)

    def step(
        self,
        phase: float,
        q: Array | None,
        phi_ref: Array,
        phi_dot_ref: Array,
        tau_ff: Array,
        phi: Array,
        phi_dot: Array,
    ) -> Array:
        """Torques (N, N m) of a sample. Raises StateError if the C refuses an input.

        phase   of the programme, in [0, 1); q (6): coordinates of the carrier, None without trim
        phi_ref, phi_dot_ref, tau_ff   of the programme (N each); phi, phi_dot: measured
        """
        rows = self._rows
        rows[0], rows[1], rows[3], rows[4] = phi_ref, phi_dot_ref, phi, phi_dot
        rows[2] = tau_ff if self._feedforward else 0.0
        if self._trim is not None and q is not None:
            self._q[:] = q[self._coordinates]
            self._check(self._trim_step(self._design, self._trim, phase, self._q_place, *self._places[:3]))
            if not self._feedforward:
                rows[2] = 0.0
        *measured, tau = self._places
        status = self._check(self._servo_step(self._gains, self._servo, *measured, self._all_valid, tau))
        self.limited += bool(status & _LIMITED)
        return np.array(rows[5])

    def _check(self, status: int) -> int:
        if status < 0:
            raise StateError(f"the servo refuses a sample: {status_words(status)}")
        return int(status)


@lru_cache(maxsize=4)
def _compile_servos(stand: Stand, trim: tuple[tuple[int, ...], int] | None) -> Library:
    """The C of servos for a stand; `trim`: measured coordinates, harmonics. Raises ToolchainError."""
    made = generate_all(stand, "double", ("torque",))
    form = ServoForm(made.layout.count, None if trim is None else TrimForm(*trim, held=stand.hold is not None))
    tables = ServoTables(_zeros(form.gains), None if trim is None else _zeros(form.design), 1.0)
    files = servo_code(stand, lower_servo(made.layout, form), form, tables)
    header = f"{stand.name}.h"
    return Library.of_texts({**files, header: made.files[header]}, f"{stand.name}_servo.c", stand.name)


def _zeros(struct: Any) -> dict[str, Any]:
    return {f.name: uniform_data(f.type, f.shape, 0.0) for f in struct.fields}
