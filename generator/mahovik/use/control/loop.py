"""The closed loop: a stand that differs from its file follows a programme under sampled servos; how well it follows.

At a sample, t = n T, encoders give angles delayed by their latency, and differences of them over T, which are the
speeds half a sample earlier. Both are compared with the programme at the same times. Torques are held from t + latency
for T; the feedforward is the programme's in the middle of that.

A periodic motion has steady errors, measured over the last periods. A stand that differs from its file hangs at a
slightly different mean pose, which flywheels cannot correct: they have no mean wrench. So the error is that of the
motion about its mean, and the mean is reported separately. A finite motion, a slew among them, is followed once, from
its required state: there the errors are those of the whole run, and what is left at the end.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.servo import ServoPrinter, ServoTables
from mahovik.core.lower.servo import ServoForm, TrimForm, lower_servo
from mahovik.core.motion.functions import Angles
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion, Slew, rows_of
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.coordinates import Coordinates, coordinates_of
from mahovik.core.stand.masses import mean_stand
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.motor import steepness
from mahovik.core.toolchain.compiled import Block, compile_library
from mahovik.core.toolchain.library import Library, uniform_data
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof.verify.programme.mechanics import scale_of, twist
from mahovik.use.control.servo import gains
from mahovik.use.control.trim import (
    ReferenceMotion,
    TrimDesign,
    design_trim,
    nodes,
    required_orbit,
    settled_state,
    trim_members,
)
from mahovik.use.numeric.course import Chart, equilibrium
from mahovik.use.numeric.frame import Frame
from mahovik.use.numeric.mechanics import Mechanics, inertia
from mahovik.use.numeric.se3 import EULER, Array
from mahovik.use.plan.problem import harmonics
from mahovik.use.simulate.course import Course
from mahovik.use.simulate.held import long_steps
from mahovik.use.simulate.run import STATE_COLUMNS

# -- the stand: carrier and flywheels under motor torques, in fixed steps of the emitted C

_MOST, _LONGEST, _SETTLED = 40, 3.0, 1e-13
"""Most steps of Newton's method; longest step of a coordinate, and the one that ends it, m or rad."""

_REACHED = 1e-6
"""m, rad: a pose farther off than this is one that the freedoms do not reach."""


def coordinates(stand: Stand, position: Array, attitude: Array, near: Array) -> Array:
    """q (M, 6; m, rad) of positions (M, 3) and quaternions (M, 4; w first), angles within half a turn of `near`.

    Of a held carrier those of its freedoms (M, m); what a pose is off the hold by rounding is left out. StateError: a
    pose is none that the hold allows.
    """
    rotations = Rotation.from_quat(attitude[:, [1, 2, 3, 0]])
    if stand.hold is not None:
        q = _held_coordinates(stand, position, rotations.as_matrix(), near)
        if np.isnan(q).any():
            raise StateError(f"{stand.name}: hold: found a pose far from the required one, which it does not allow")
        return q
    angles = rotations.as_euler(EULER[stand.angles])
    return np.hstack([position, near[:, 3:] + np.remainder(angles - near[:, 3:] + np.pi, 2.0 * np.pi) - np.pi])


def _held_coordinates(stand: Stand, O1: Array, C: Array, near: Array) -> Array:
    """Coordinates (M, m) of poses O1 (M, 3; m), C (M, 3, 3) of a held carrier, by Newton's method from `near` (M, m).

    Each row by itself, so that its bits depend on no other. Angles are those within half a turn of `near`. NaN where
    the freedoms do not reach the pose.
    """
    x, moving = near.copy(), np.arange(len(near))
    for _ in range(_MOST):
        off = _offset(stand, O1[moving], C[moving], x[moving])
        step = (np.linalg.pinv(Frame.of(stand).slopes(x[moving])[2]) @ off[:, :, None])[:, :, 0]
        x[moving] += np.clip(step, -_LONGEST, _LONGEST)
        far = np.abs(step).max(axis=1, initial=0.0) > _SETTLED * (1.0 + np.abs(x[moving]).max(axis=1, initial=0.0))
        moving = moving[far]
        if not len(moving):
            break
    lost = np.abs(_offset(stand, O1, C, x)).max(axis=1, initial=0.0) > _REACHED
    return np.where(lost[:, None], np.nan, x)


def _offset(stand: Stand, O1: Array, C: Array, x: Array) -> Array:
    """Shift and rotation vector (M, 6; m, rad) in E1 from the pose at coordinates x to another."""
    there, place = Frame.of(stand).pose(x)
    back = np.swapaxes(there, 1, 2)
    turned = Rotation.from_matrix(back @ C).as_rotvec()
    return np.hstack([(back @ (O1 - place)[:, :, None])[:, :, 0], turned])


STIFFNESS = 0.2
"""Largest product of step and fastest decay rate of a speed: a flywheel's by its motor, a freedom's by friction."""

TURN = 0.05
"""rad: largest turn of a flywheel in a step; the carrier's error is then far below a millionth of its motion."""


class Plant:
    """Plant in steps of fourth order. Torques are those of the motors at the speeds in the middle of each step.

    State: position (3), attitude (4, quaternion, w first), V (6), phi, phi_dot (N each); tau: torques at the end.
    """

    def __init__(self, stand: Stand, state: State) -> None:
        """In a state with a quaternion. Raises ToolchainError."""
        self._block = Block(stand, compile_library(stand, kind="states"), 1)
        block, N = self._block, len(stand.flywheels)
        x = block.x[:, 0]
        x[:] = [*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot]
        block.given["order"][0] = 4
        self.position, self.attitude, self.V, self.phi_dot = x[:3], x[3:7], x[7:13], x[13 + N : 13 + 2 * N]
        self._course = Course(block, [False] * N, [None] * N, by_torque=True)
        self._first, self.tau, self._fastest = np.array(state.phi), np.zeros(N), _steepest_rate(stand)

    @property
    def phi(self) -> Array:
        """Angles (N, rad), not wrapped."""
        return self._first + self._course.turned[:, 0]

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m). StateError: out of range."""
        if not np.all(np.isfinite(command)):
            raise StateError(f"at t = {begin:.6g} s a commanded torque is not a number")
        span = end - begin
        count = max(1, math.ceil(span * max(self._fastest, float(np.abs(self.phi_dot).max()) / TURN)))
        self._course.advance(command, begin, span / count, count)
        if why := self._block.reason(0):
            raise StateError(why)
        self.tau = self._block.given["tau"][:, 0].copy()


def _steepest_rate(stand: Stand) -> float:
    """Steps per second that the steepest motor needs, and the friction of a hold."""
    rates = [steepness(s.motor) / (0.5 * inertia(s)[3, 3]) for s in stand.flywheels]
    rates += [1.0 / friction.bound for friction in long_steps(stand, math.inf)]
    return float(max(rates, default=0.0)) / STIFFNESS


# -- what firmware does once per sample: read the encoders, and the C of servos and trim


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
    files = ServoPrinter(stand, lower_servo(made.layout, form), form, tables).code()
    header = f"{stand.name}.h"
    return Library.of_texts({**files, header: made.files[header]}, f"{stand.name}_servo.c", stand.name)


def _zeros(struct: Any) -> dict[str, Any]:
    return {f.name: uniform_data(f.type, f.shape, 0.0) for f in struct.fields}


# -- the loop

_AXES, _ANGLES = "xyz", ("psi", "theta", "phi")

LOST_ANGLE = math.pi
"""rad: a flywheel this far from its programme is lost: another turn is nearer."""

MEASURED, SETTLING = 10, 30
"""Periods of a periodic programme whose errors are measured, at the end; periods before them, without a trim."""

TABLE = 128
"""Nodes per period of the table in firmware, by default."""

LEFT, MOST_ROUNDS = 1e-2, 60
"""A trim runs until this part of the error is left, or for this many rounds."""

_CHUNK = 1000
"""Samples for which the programme is evaluated in one call."""


@dataclass(frozen=True, eq=False)
class Case:
    """Parameters of a simulation over `periods` periods of the programme, or once over a finite one.

    reference   the stand of the file, its programme and motion: the knowledge of firmware and generator
    real     the real stand
    design   of the trim; None: no trim
    start    "settled": the periodic motion of the real stand, flywheels on the programme; "programme": the required
             state; "rest": its rest, and first the programme's run-up. A finite programme begins in the required state
    """

    reference: ReferenceMotion
    real: Stand
    servo: Servo
    periods: int
    design: TrimDesign | None = None
    start: str = "settled"

    @property
    def first(self) -> int:
        """Number of the first sample: the programme begins at 0, a run-up before that."""
        table = self.reference.programme.runup
        if self.start != "rest" or table is None:
            return 0
        return -math.ceil(table.duration / self.servo.period * (1.0 - 1e-12))

    @property
    def last(self) -> int:
        """Number of the last sample."""
        return math.ceil(self.periods * self.reference.motion.span / self.servo.period * (1.0 - 1e-12))

    @property
    def delay(self) -> tuple[int, float]:
        """The servo's latency: whole samples, and the rest in s."""
        late = self.servo.latency / self.servo.period
        whole = math.floor(late + 1e-9)
        return whole, max(0.0, late - whole) * self.servo.period


@dataclass(eq=False)
class Record:
    """Rows at the samples; fewer if the run ended early. `stopped`: why it did, or None.

    t (M, s), position (M, 3), attitude (M, 4), V (M, 6), phi, phi_dot (M, N each): the true state
    tau           (M, N; N m): of motors and friction, during the step that ends there
    q, required   (M, 6; held M, m): the carrier's coordinates, actual and required; m, rad
    apart         (M, N; rad): of the flywheels from the programme with its corrections
    command       (M, N; N m): of the servos
    corrections   (M, N, T; rad): of the trim
    rounds, limited   corrections made; samples in which a torque was cut
    """

    reference: ReferenceMotion
    start: State
    t: Array
    position: Array
    attitude: Array
    V: Array
    phi: Array
    phi_dot: Array
    tau: Array
    q: Array
    required: Array
    apart: Array
    command: Array
    corrections: Array
    stopped: str | None = None
    interrupted: bool = False
    rounds: int = 0
    limited: int = 0

    def columns(self) -> dict[str, Array]:
        """The record as columns by name and unit: those of `mahovik simulate` and the required motion."""
        stand = self.reference.stand
        names = ["t [s]", *STATE_COLUMNS]
        q = self.q
        if stand.hold is None:
            q = q[:, 3:]
            names += [*(f"{a} [rad]" for a in _ANGLES), *(f"required {a} [m]" for a in _AXES)]
            names += [f"required {a} [rad]" for a in _ANGLES]
        else:
            held = coordinates_of(stand)
            heads = [f"{a} [{unit}]" if unit else a for a, unit in zip(held.names, held.unit_names, strict=True)]
            names += [f"{kind} {head}" for kind in ("q", "required") for head in heads]
        kinds = {"phi": "rad", "phi_dot": "rad/s", "tau": "N m", "apart": "rad", "command": "N m"}
        names += [f"{kind} {s.name} [{unit}]" for kind, unit in kinds.items() for s in stand.flywheels]
        parts = [self.t[:, None], self.position, self.attitude, self.V, q, self.required]
        data = np.hstack([*parts, *(getattr(self, kind) for kind in kinds)])
        return dict(zip(names, data.T, strict=True))


def make_case(
    stand: Stand, real: Stand, motion: RequiredMotion, programme: Programme, servo: Servo, periods: int | None,
    begin: str | None, table: int, source: str = "the programme", servos: str = "the servos",
) -> Case:  # fmt: skip
    """The case of a stand, one that differs from it, and a programme, with what is not given as it usually is.

    periods   None: until it has settled; begin: None: "settled", of a finite programme "programme"
    table     nodes per period; 0: the exact programme. A finite programme is a table of its own
    source, servos   what messages call programme and servos

    Raises UsageError.
    """
    if not programme.periodic:
        for name, value, usual in (("periods", periods, None), ("begin", begin, None), ("table", table, TABLE)):
            if value not in (usual, "programme"):
                raise UsageError(f"{name} {value}: {source} is finite, and followed once; leave --{name} out")
        begin, table, periods = "programme", 0, 1
    begin = begin or "settled"
    if begin == "rest" and programme.runup is None:
        raise UsageError(f"begin rest: {source} has no run-up; plan with `runup` in the motion file")
    if motion.span < 4.0 * servo.period:
        raise UsageError(
            f"{servos}: sample_period {servo.period:g} s: fewer than 4 samples in "
            f"{'a period' if programme.periodic else 'the duration'} of the programme, {motion.span:g} s"
        )
    reference = ReferenceMotion.of(stand, motion, programme, table or None)
    design = None if servo.trim is None else design_trim(stand, motion, programme, servo.trim)
    if periods is None:
        periods = SETTLING + MEASURED
        if design is not None:
            rounds = math.ceil(math.log(LEFT) / math.log(design.radius)) if design.radius > 0.0 else 1
            window = design.trim.settling + design.trim.averaging + 1
            periods = min(max(rounds, 1), MOST_ROUNDS) * window + MEASURED
    elif programme.periodic and periods < MEASURED + 1:
        raise UsageError(f"periods {periods}: expected at least {MEASURED + 1}: the last {MEASURED} are measured")
    return Case(reference, real, servo, periods, design, begin)


def close_loop(case: Case, progress: Callable[[float], None] | None = None) -> Record:
    """Run a case. `progress` receives the time (s) now and then.

    A lost motion or Ctrl-C ends the run early: the record's `stopped` says why. Raises StateError, CheckError,
    ToolchainError if it cannot begin.
    """
    start = starting_state(case)
    loop, rows, stopped, interrupted = _Loop(case, Plant(case.real, start)), [], None, False
    T, n = case.servo.period, case.first
    try:
        for n in range(case.first, case.last + 1):
            rows.append(loop.sample(n))
            if n < case.last:
                loop.advance(n)
            if progress is not None and n % 100 == 0:
                progress(n * T)
    except StateError as error:
        stopped = str(error)
    except KeyboardInterrupt:
        stopped, interrupted = f"stopped at t = {n * T:.6g} s of {case.last * T:.6g} s", True
    if not rows:
        raise StateError(stopped or "")
    columns: dict[str, Array] = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    columns["q"] = coordinates(case.real, columns["position"], columns["attitude"], columns["required"])
    controller = loop.controller
    return Record(
        case.reference, start, **columns, stopped=stopped, interrupted=interrupted, rounds=controller.rounds,
        limited=controller.limited,
    )  # fmt: skip


def required_state(stand: Stand, motion: RequiredMotion, programme: Programme, angles: Angles) -> State:
    """The state that a programme requires of the carrier at t = 0, with flywheels at the first of some angles."""
    course = motion.at(np.zeros(1), programme.bias)
    chart = Chart.at(Mechanics.of(stand), course.q[0])
    y = chart.of(course)[0]
    if programme.unbalance == "averaged":
        y[6:] = twist_at_rest(stand, y[6:], angles.phi[0], angles.phi_dot[0])
    return chart.state(y, angles.phi[0], angles.phi_dot[0])


def twist_at_rest(stand: Stand, V: Array, phi: Array, phi_dot: Array) -> Array:
    """Twist V (6) of the carrier of a stand that has the momentum of the mean stand with the twist V; phi, phi' (N)."""
    exact, mean = (Mechanics.of(variant).mass_and_coupling(phi[None]) for variant in (stand, mean_stand(stand)))
    (K, I), (K0, I0) = ((a[0], b[0]) for a, b in (exact, mean))
    return np.asarray(V + np.linalg.solve(K, (K0 - K) @ V + (I0 - I) @ phi_dot))


def starting_state(case: Case) -> State:
    """The real stand's state at t = 0. Raises CheckError: no periodic motion is near the required one."""
    wanted = case.reference
    mechanics = Mechanics.of(case.real)
    angles = wanted.angles(np.array([case.first * case.servo.period]))
    if not wanted.programme.periodic:
        return required_state(case.real, wanted.motion, wanted.programme, angles)
    count = nodes(wanted.motion, wanted.programme)
    orbit = required_orbit(mechanics, wanted.motion, wanted.programme, count)
    if case.start == "rest":
        y = equilibrium(orbit.chart, angles.phi[0]).y
    elif case.start == "programme":
        y = orbit.y[0]
    else:
        y = settled_state(mechanics, wanted.motion, wanted.programme, count)
    return orbit.chart.state(y, angles.phi[0], angles.phi_dot[0])


class _Loop:
    """Servo, encoders and plant, with the signals between them."""

    def __init__(self, case: Case, plant: Plant) -> None:
        self._case, self._plant = case, plant
        self._servo, self._wanted = case.servo, case.reference
        self.controller = Controller(case.reference, case.servo, case.design)
        self._ideal = case.servo.encoder == "ideal"
        self._encoders = Encoders(case.real, self._ideal)
        self._whole, self._part = case.delay
        self._waiting: deque[Array] = deque()
        self._history = _History(
            plant,
            case.first * case.servo.period,
            max(float(self._encoders.latency.max(initial=0.0)), case.servo.period),
        )
        self._before: Array | None = None
        self._chunk: int | None = None

    def sample(self, n: int) -> dict[str, Any]:
        """Measure and command; return the row of sample n by the names of a record."""
        case, plant, T = self._case, self._plant, self._servo.period
        t = n * T
        i = self._prepare(n)
        phi, phi_dot = self._measure(t)
        required = self._required[i]
        phase = math.fmod(t / self._wanted.motion.span, 1.0) if t >= 0.0 else 0.0
        measured = None
        if self.controller.trims and n >= 0:
            measured = coordinates(case.real, plant.position[None], plant.attitude[None], required[None])[0]
        command = self.controller.step(phase, measured, self._phi[i], self._phi_dot[i], self._tau[i], phi, phi_dot)
        corrections = self.controller.corrections
        apart = self._distances(i, plant.phi, phase, corrections)
        worst = int(np.argmax(np.abs(apart)))
        if not abs(apart[worst]) < LOST_ANGLE:
            name = case.real.flywheels[worst].name
            raise StateError(f"at t = {t:.6g} s the loop is lost: {name} is half a turn from its programme")
        self._command = command
        true = {name: np.copy(getattr(plant, name)) for name in ("position", "attitude", "V", "phi", "phi_dot", "tau")}
        row = {"t": t, **true, "required": required, "apart": apart, "command": command}
        return {**row, "corrections": corrections.copy()}

    def advance(self, n: int) -> None:
        """Move the plant from sample n to the next, under the torques commanded so far."""
        T, command = self._servo.period, self._command
        t = n * T
        if not self._waiting:  # before the first command acts, the torque is the programme's
            self._waiting.extend([command] * (self._whole + 1))
        self._waiting.append(command)
        old, new = self._waiting[0], self._waiting[1]
        if self._part > 1e-12 * T:
            self._push(old, t, t + self._part)
        self._push(new, t + self._part, t + T)
        self._waiting.popleft()

    def _push(self, command: Array, begin: float, end: float) -> None:
        self._plant.advance(command, begin, end)
        self._history.add(end)

    def _prepare(self, n: int) -> int:
        """Evaluate the programme at the samples of n's chunk; return n's row of it."""
        chunk, i = divmod(n, _CHUNK)
        if chunk != self._chunk:
            self._chunk = chunk
            T, wanted = self._servo.period, self._wanted
            t: Array = T * np.arange(chunk * _CHUNK, (chunk + 1) * _CHUNK, dtype=np.float64)
            late, half = self._encoders.latency, 0.0 if self._ideal else T / 2.0
            phi, phi_dot = np.empty((len(t), len(late))), np.empty((len(t), len(late)))
            for delay in np.unique(late):
                delayed = late == delay
                phi[:, delayed] = wanted.angles(t - delay).phi[:, delayed]
                phi_dot[:, delayed] = wanted.angles(t - delay - half).phi_dot[:, delayed]
            self._phi, self._phi_dot, self._true = phi, phi_dot, wanted.angles(t).phi
            self._tau = wanted.torques(t + self._servo.latency + T / 2.0)
            self._required = wanted.required_course(t)
        return i

    def _measure(self, t: float) -> tuple[Array, Array]:
        phi = self._encoders.read(self._history.at(t - self._encoders.latency))
        if self._ideal:
            return phi, self._plant.phi_dot.copy()
        T = self._servo.period
        if self._before is None:
            self._before = self._encoders.read(self._history.at(t - self._encoders.latency - T))
        phi_dot = (phi - self._before) / T
        self._before = phi
        return phi, phi_dot

    def _distances(self, i: int, phi: Array, phase: float, corrections: Array) -> Array:
        """Distances of the flywheels from the programme with its corrections (N, rad)."""
        wave = harmonics(1.0, corrections.shape[1], np.array([phase])).value[0]
        return np.asarray(phi - self._true[i] - corrections @ wave)


class _History:
    """Recent angles by cubic Hermite interpolation; before the first, speeds are taken as constant."""

    def __init__(self, plant: Plant, begin: float, span: float) -> None:
        self._plant, self._span = plant, span
        early = plant.phi - 2.0 * span * plant.phi_dot
        self._rows = deque([(begin - 2.0 * span, early, plant.phi_dot.copy())])
        self.add(begin)

    def add(self, t: float) -> None:
        self._rows.append((t, self._plant.phi.copy(), self._plant.phi_dot.copy()))
        while self._rows[1][0] < t - 2.0 * self._span:
            self._rows.popleft()

    def at(self, t: Array) -> Array:
        """Angles at times (N, s), one for each flywheel."""
        last, phi, _ = self._rows[-1]
        if np.all(t >= last):
            return phi.copy()
        times, angles, speeds = (np.array(column) for column in zip(*self._rows, strict=True))
        k, s = np.clip(np.searchsorted(times, t) - 1, 0, len(times) - 2), np.arange(len(t))
        h, a, b = times[k + 1] - times[k], angles[k, s], angles[k + 1, s]
        x, p, r = np.minimum((t - times[k]) / h, 1.0), h * speeds[k, s], h * speeds[k + 1, s]
        return np.asarray(a + x * (p + x * (3 * (b - a) - 2 * p - r + x * (2 * (a - b) + p + r))))


HARMONICS = 6
"""Harmonics of the error, at least; more if the motion has more."""

STILL = 1e-9
"""m, rad: a coordinate with a smaller amplitude is held still."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Errors:
    """Errors of following a required motion (all in m and rad), six; of a held carrier one a freedom.

    coordinates  that these are of
    amplitude  (6): of the required motion about its mean; of a finite one the largest distance from its beginning
    peak, rms  (6): of the error
    share, share_rms   largest and root mean square of the error of all six together, by the inertia's norm, as shares
               of the largest of the motion: no choice of units or axes changes them (`Scale` of proof/verify/programme)
    apart      (N): largest distance of the flywheels from the programme, rad
    periods, mean, harmonics   of a periodic programme: periods measured; mean error (6), and its amplitudes at
               harmonics 1..K of the programme (K, 6)
    end, share_end   of a finite one: error at the end (6), and that of all six together
    slew       where a slew ends: `angle` (rad) to the demanded attitude or line of sight, largest `rate` (rad/s) of its
               angular rows
    """

    coordinates: Coordinates
    amplitude: Array
    peak: Array
    rms: Array
    share: float
    share_rms: float
    apart: Array
    periods: int = 0
    mean: Array | None = None
    harmonics: Array | None = None
    end: Array | None = None
    share_end: float | None = None
    slew: Mapping[str, float] | None = None

    def shares(self) -> list[float | None]:
        """Peak errors over each coordinate's own amplitude; None for one that is held still."""
        return [float(p / a) if a > STILL else None for p, a in zip(self.peak, self.amplitude, strict=True)]

    def words(self, case: Case, record: Record, of: str) -> list[str]:
        """How well the carrier follows, in sentences; `of`: the mismatch of the run."""
        names = [s.name for s in case.reference.stand.flywheels]
        furthest, torques = int(np.argmax(self.apart)), np.abs(record.tau).max(axis=0)
        strongest = int(np.argmax(torques))
        about = f"about its mean, over the last {self.periods} of {case.periods} periods"
        if self.end is not None:
            about = f"{100 * (self.share_end or 0.0):.3g} % at the end"
        result = [
            f"error of the carrier {100 * self.share:.3g} % of its amplitude (rms {100 * self.share_rms:.3g} %), "
            f"{about}; {of}",
            f"flywheels: at most {1e3 * self.apart[furthest]:.3g} mrad from the programme ({names[furthest]}); "
            f"motor and friction at most {torques[strongest]:.4g} N m ({names[strongest]}), "
            f"cut in {record.limited} of {len(record.t)} samples",
        ]
        if self.slew is not None:
            angle, rate = (math.degrees(self.slew[key]) * 3600 for key in ("angle", "rate"))
            result.append(f"the slew ends {angle:.3g} arcsec from its end, with rates up to {rate:.3g} arcsec/s")
        if case.design is not None:
            result.append(
                f"trim: {record.rounds} rounds; an error falls to {case.design.radius:.3g} per round; the settled "
                f"trim converges while its model is less than {100 * case.design.margin:.3g} % wrong"
            )
        return result


def errors_of(record: Record, periods: int = MEASURED) -> Errors:
    """Errors of a run: of a periodic programme those of its last `periods` periods. Raises CheckError: too short."""
    motion = record.reference.motion
    error = record.q - record.required
    if not motion.periodic:
        shares = _shares(record, record.required, error)
        slew = None if motion.slew is None else _slew_end(record, motion.slew)
        amplitude = np.abs(record.required - record.required[0]).max(axis=0)
        errors = _errors(record, error, amplitude, shares, record.apart)
        return Errors(**errors, end=error[-1], share_end=float(shares[-1]), slew=slew)
    span, step = motion.span, float(record.t[1] - record.t[0]) if len(record.t) > 1 else np.inf
    rows = round(periods * span / step)
    if rows >= len(record.t):
        raise CheckError(f"the run ended at t = {record.t[-1] if len(record.t) else 0:.6g} s, before {periods} periods")
    last = slice(len(record.t) - 1 - rows, len(record.t) - 1)
    required, error = record.required[last], error[last]
    K = max(HARMONICS, *motion.harmonics, 1)
    terms = harmonics(span, 2 * min(K, max(1, round(span / step) // 2 - 1)) + 1, record.t[last]).value
    waves = np.linalg.lstsq(terms, error, rcond=None)[0]  # samples need not divide a period
    error, mean = error - waves[0], waves[0]
    amplitude = np.abs(required - np.linalg.lstsq(terms, required, rcond=None)[0][0]).max(axis=0)
    errors = _errors(record, error, amplitude, _shares(record, required, error), record.apart[last])
    return Errors(**errors, periods=periods, mean=mean, harmonics=np.hypot(waves[1::2], waves[2::2]))


def _errors(record: Record, error: Array, amplitude: Array, shares: Array, apart: Array) -> dict[str, Any]:
    return {
        "coordinates": coordinates_of(record.reference.stand),
        "amplitude": amplitude,
        "peak": np.abs(error).max(axis=0),
        "rms": np.sqrt(np.mean(error**2, axis=0)),
        "share": float(shares.max()),
        "share_rms": float(np.sqrt(np.mean(shares**2))),
        "apart": np.abs(apart).max(axis=0),
    }


def _shares(record: Record, required: Array, error: Array) -> Array:
    """Errors (M, 6; m, rad) of all six coordinates together (M), as shares of the largest of the motion."""
    wanted = record.reference
    moved = [twist(wanted.stand, q, e) for q, e in zip(required, error, strict=True)]
    scale = scale_of(wanted.stand, wanted.motion, wanted.exact)
    return scale.displacement_share(np.array(moved).reshape(-1, 6))


def _slew_end(record: Record, slew: Slew) -> Mapping[str, float] | None:
    if slew.kind == "still":
        return None
    w, x, y, z = record.attitude[-1]
    C = Rotation.from_quat([x, y, z, w]).as_matrix()
    demanded = slew.path(np.array([slew.angle]))[0] @ slew.start
    if slew.kind == "attitude":
        angle = float(Rotation.from_matrix(demanded.T @ C).magnitude())
    else:
        sight, wanted = C @ slew.axis, demanded @ slew.axis
        angle = float(np.arctan2(np.linalg.norm(np.cross(sight, wanted)), sight @ wanted))
    turning = [row.component.startswith("w") for row in slew.task.rows]
    rates = rows_of(record.reference.stand, slew.task)[turning] @ record.V[-1]
    return {"angle": angle, "rate": float(np.abs(rates).max())}
