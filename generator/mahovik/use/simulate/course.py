"""Motion of n samples in time by the C: all steps between moments of output are made in `templates/course.c`.

A regime goes there as rows of numbers, one for each step, so that no step is a call of Python. Samples differ in the
numbers of their stands (tables) and in their states at t = 0; the regime is the same for all.
"""

from __future__ import annotations

import ctypes
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any

import numpy as np

from mahovik.core.emit.templates import folders
from mahovik.core.motion.laws import RunUp, TorqueLaw, TorqueSpeed
from mahovik.core.motion.regime import Regime
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import UNLIMITED, Curve, Motor, slip
from mahovik.core.toolchain.compiled import Array, Block, CompiledLibrary, StandTables
from mahovik.core.toolchain.library import FLAGS, load_compiled
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.pieces import stream_at
from mahovik.use.simulate.case import Case, wrap_phases

TORQUE_STEP = 0.1
"""Largest (fall of torque by speed) (turning acceleration by torque) dt of a step.

The torque of a step is taken at a speed extrapolated from the previous step. Such a scheme is stable below 1; at 0.1
its error in approaching a speed is a thousandth of the remaining difference.
"""

MOST_PARTS = 1000
"""Most parts of a step; a law that needs more is refused before the run."""

STEPS, NUMBERS = 1 << 15, 1 << 18
"""Steps whose rows are made at once, about; numbers of moments that are kept at once, about."""

SAMPLES = 256
"""States that are stepped together: they stay in the cache of the processor with their tables."""

FUNCTIONS = {
    "readings": "points", "loads": "mounts", "I": "matrices", "reaction": "reaction", "coordinates": "generalized"
}  # fmt: skip
"""Functions of the C that answer what may be needed at moments of output, besides the motion itself."""


@dataclass(eq=False)
class Moments:
    """K moments of output of n samples, which are last. What is not needed has no components.

    t (K); state (K, 13 + 2 N, n): position, quaternion (w first), V, phi (wrapped), phi'; V_dot (K, 6, n)
    phi (K, N, n)   angles, not wrapped; phi_ddot, tau (K, N, n): accelerations and drive torques
    readings        (K, 24 S, n): of `points`; loads (K, 6 N, n): wrenches of the mounts on the flywheels
    I               (K, 6 N, n): of (8); reaction (K, 6, n): of the hold on the carrier, in E1 about O1
    coordinates     (K, c, n): of the freedoms of a held carrier: q, where it turns freely a quaternion, q_dot
    """

    t: Array
    state: Array
    V_dot: Array
    phi: Array
    phi_ddot: Array
    tau: Array
    readings: Array
    loads: Array
    I: Array
    reaction: Array
    coordinates: Array


NEEDS = frozenset(("V_dot", "phi", "phi_ddot", "tau", *FUNCTIONS))
"""What may be needed besides states."""


# -- the memory of the C -----------------------------------------------------------------------------------------------

_POINTER, _INT, _SIZE, _REAL = ctypes.c_void_p, ctypes.c_int, ctypes.c_size_t, ctypes.c_double


class _Call(ctypes.Structure):
    _fields_ = (("function", _POINTER), ("passed", _POINTER))


class _Curve(ctypes.Structure):
    _fields_ = (("points", _INT), ("speed", _POINTER), ("torque", _POINTER))


class _Drive(ctypes.Structure):
    _fields_ = (
        ("delivered", _Curve), ("to", _REAL), ("band", _REAL), ("limit", _Curve), ("by_sense", _INT),
        ("viscous", _REAL), ("coulomb", _REAL), ("coulomb_speed", _REAL),
    )  # fmt: skip


class _Answer(ctypes.Structure):
    _fields_ = (("call", _Call), ("source", _POINTER), ("to", _POINTER), ("bytes", _SIZE))


class _Course(ctypes.Structure):
    _fields_ = (
        ("n", _SIZE), ("left", _SIZE), ("flywheels", _INT), ("inputs", _INT), ("by_torque", _INT), ("solves", _INT),
        ("reacting", _INT), ("held", _INT),
        *((name, _POINTER) for name in ("phi", "phi_dot", "phi_ddot", "tau", "wrench", "dt", "carry", "coupling")),
        *((name, _POINTER) for name in ("given", "drives", "rate", "turned", "before")),
        *((name, _Call) for name in ("step", "matrices", "solve", "torque")),
        ("answers", _POINTER), ("many", _INT), ("numbers", _INT),
        *((name, _POINTER) for name in ("status", "where", "now", "when")),
    )  # fmt: skip


_ROWS = (
    "count", "begin", "length", "phi", "phi_dot", "mean", "between", "halfway", "command", "wrench", "end_phi_ddot",
    "end_wrench", "end_command",
)  # fmt: skip


class _Rows(ctypes.Structure):
    _fields_ = (("stretches", _INT), *((name, _POINTER) for name in _ROWS))


@cache
def _compiled(real: str) -> Any:
    """`course_run` for an element type. Raises ToolchainError."""
    source = next(path for folder in folders() if (path := folder / "course.c").is_file())
    run = load_compiled(source, (*FLAGS, f"-DREAL={real}", "-lm"), ctypes.CDLL).course_run
    run.argtypes, run.restype = (_POINTER, _POINTER), _INT
    return run


def _address(array: Array) -> int | None:
    return array.ctypes.data if array.size else None


class Course:
    """Steps of the states of a block, all in one call.

    given      flywheels whose speed is given; `laws`: of the torque of each, or None
    by_torque  steps are those of `step`, with torques, else of `step_driven`, with given accelerations
    reacts     given speeds vary beside torques: the carrier, which takes a run-time wrench, bears their reaction
    needs      what `run` keeps besides states, of NEEDS
    """

    def __init__(
        self,
        block: Block,
        has_speed_law: Sequence[bool],
        laws: Sequence[TorqueLaw | None],
        by_torque: bool,
        reacts: bool = False,
        needs: Collection[str] = (),
    ) -> None:
        """Raises ToolchainError."""
        self.block, self.needs = block, frozenset(needs)
        self._kept: list[Any] = []  # what the C reads and writes lives as long as this
        N, n, stand, memory = len(block.stand.flywheels), block.n, block.stand, block.given
        self.rate, self.turned = np.zeros((N, n)), np.zeros((N, n))
        self.status, self.where, now = (np.zeros(n, dtype=np.int32) for _ in range(3))
        self.when = np.zeros(n)
        memory["locked"][:] = np.array(has_speed_law, dtype=np.int32)
        self._functions = ["a step", "coupled" if by_torque and N else "forward", "torque", "matrices"]
        answers = self._answers(needs)
        matrices = self._call("matrices") if reacts else _Call()
        shared: tuple[Array, ...] = (
            block.x[13 : 13 + N],
            block.x[13 + N :],
            *(memory[k] for k in ("phi_ddot", "tau", "wrench", "dt")),
        )
        self._c = _Course(
            *(n, n, N, memory["wrench"].shape[0], by_torque and N > 0, bool(self.needs - {"phi"})),
            *(6 * block.inputs.index(stand.carrier.name) if reacts else -1, stand.hold is not None),
            *map(self._at, shared),
            self._at(memory.get("carry", np.zeros(0))),
            self._at(block.member("matrices", "I") if reacts else np.zeros(0)),
            self._at(memory["locked"]),
            self._drives(laws),
            *(self._at(array) for array in (self.rate, self.turned, np.zeros((2 * N, n)))),
            self._call("step" if by_torque or not N else "step_driven"),
            matrices,
            self._call(self._functions[1]),
            self._call("torque") if N else _Call(),
            *(self._pointer(answers), len(answers), 13 + 2 * N),
            *(self._at(array) for array in (self.status, self.where, now, self.when)),
        )
        self._answer = answers
        self._run = _compiled("float" if block.x.dtype == np.float32 else "double")
        self._stretches: dict[int, tuple[dict[str, Array], Any]] = {}  # of `advance`, by number of steps

    def run(self, rows: Mapping[str, Array], moments: dict[str, Array], begins: bool) -> int:
        """Step through the stretches of `rows`; put the moments at their ends into arrays of `memory`.

        begins  whether it is the moment at t = 0, whose accelerations the first step needs

        Returns how many moments are kept: fewer where all states are refused.
        """
        self._c.solves = begins or bool(self.needs - {"phi"})
        for answer, name in zip(self._answer, self._names, strict=True):
            answer.to = moments[name].ctypes.data
        done = self._make(_Rows(len(rows["count"]), *(_address(rows[name]) for name in _ROWS)))
        for name in self._records:  # of a function without batch
            K, components, n = moments[name].shape
            moments[name] = moments[name].reshape(K, n, components).transpose(0, 2, 1)
        return done

    def _make(self, rows: Any) -> int:
        before = self._c.left
        done = int(self._run(ctypes.byref(self._c), ctypes.byref(rows)))
        if self._c.left < before:
            self.block.refuse(self.status, self._place, "")
        return done

    def advance(self, command: Array, t: float, h: float, count: int) -> None:
        """Make steps of h s from the time t (s) on, under constant commanded torques (N, N m); no run-time wrench."""
        if count not in self._stretches:
            N, W, real = len(command), len(self.block.given["wrench"]), self.block.x.dtype
            rows: dict[str, Array] = {}
            rows |= {name: np.zeros((count + 1, N), real) for name in ("phi", "phi_dot", "mean", "between", "halfway")}
            rows |= {"wrench": np.zeros((count, W), real), "end_wrench": np.zeros(W, real)}
            rows |= {"count": np.array([count], dtype=np.int32), "begin": np.zeros(1), "length": np.zeros(1)}
            rows |= {"command": np.zeros((count, N)), "end_command": np.zeros(N), "end_phi_ddot": np.zeros(N, real)}
            self._stretches[count] = rows, _Rows(1, *(_address(rows[name]) for name in _ROWS))
            self._memory = self.memory(1)
        rows, passed = self._stretches[count]
        rows["command"][:], rows["end_command"][:], rows["begin"][0], rows["length"][0] = command, command, t, h
        for answer, name in zip(self._answer, self._names, strict=True):
            answer.to = self._memory[name].ctypes.data
        self._make(passed)

    def _place(self, j: int) -> str:
        return f"at t = {self.when[j]:.6g} s {self._functions[self.where[j]]}"

    def _answers(self, needs: Collection[str]) -> Any:
        """What is kept of each moment: the state first, then what is needed."""
        block = self.block
        sources: dict[str, Array] = {"state": block.x, "V_dot": block.given["V_dot"], "phi": self.turned}
        sources |= {name: block.given[name] for name in ("phi_ddot", "tau")}
        calls = {need: FUNCTIONS[need] for need in needs if need in FUNCTIONS and block.has(FUNCTIONS[need])}
        if block.stand.hold is None:
            calls.pop("coordinates", None)
        self._names = [name for name in (*sources, *calls) if name == "state" or name in needs]
        self._functions += [calls.get(name, "") for name in self._names]
        answers = (_Answer * len(self._names))()
        for answer, name in zip(answers, self._names, strict=True):
            answer.call = self._call(calls.get(name, ""))
            if name in calls:
                sources[name] = block.member("matrices", "I") if name == "I" else block.found[calls[name]]
            answer.source, answer.bytes = self._at(sources[name]), sources[name].nbytes
        self._records = [name for name in calls if not sources[name].flags.c_contiguous]
        return answers

    def memory(self, moments: int) -> dict[str, Array]:
        """Arrays (moments, components, n) for `run`, of NEEDS and the state; without components where not needed."""
        n = self.block.n
        result = {name: np.zeros((moments, 0, n)) for name in NEEDS}
        for name, answer in zip(self._names, self._answer, strict=True):
            kind = np.dtype(np.float64) if name == "phi" else self.block.x.dtype
            result[name] = np.zeros((moments, answer.bytes // (kind.itemsize * n), n), kind)
        return result

    def _call(self, function: str) -> Any:
        if not self.block.has(function):
            return _Call()
        code, passed = self.block.address(function)
        pointers = (_POINTER * len(passed))(*map(_address, passed))
        self._kept += [pointers, passed]
        return _Call(code, ctypes.addressof(pointers))

    def _drives(self, laws: Sequence[TorqueLaw | None]) -> int | None:
        pointers = np.zeros((len(laws), self.block.n), dtype=np.uintp)
        for s, law in enumerate(laws):
            pointers[s] = [self._pointer(self._drive(law, of[s])) for of in self.block.motors]
        return self._at(pointers)

    def _drive(self, law: TorqueLaw | None, motor: Motor | None) -> Any:
        of_law = (law.to, law.band) if isinstance(law, RunUp) else (0.0, 0.0)
        delivered = self._curve(law.curve if isinstance(law, TorqueSpeed) else ())
        friction = (0.0, 0.0, 1.0) if motor is None else (motor.viscous, motor.coulomb, motor.coulomb_speed)
        limit = self._curve((motor or UNLIMITED).limit)
        return _Drive(delivered, *of_law, limit, not (motor or UNLIMITED).torque_speed, *friction)

    def _curve(self, curve: Curve) -> Any:
        speeds, torques = np.array(curve, dtype=np.float64).reshape(-1, 2).T.copy()
        return _Curve(len(curve), self._at(speeds), self._at(torques))

    def _pointer(self, structures: Any) -> int:
        self._kept.append(structures)
        return ctypes.addressof(structures)

    def _at(self, array: Array) -> int | None:
        self._kept.append(array)
        return _address(array)


# -- a run -------------------------------------------------------------------------------------------------------------


def motion(case: Case, block: Block, needs: Collection[str] = NEEDS, parts: int = 1) -> Iterator[Moments]:
    """The motion of all states of a block under the regime of a case, in pieces of some moments of output.

    block   of the stand of the case, which takes what its regime needs (`stand_for`), in the states at t = 0; phases
            and speeds that the regime gives are set here. Samples that are refused have `block.reason(j)`
    needs   of NEEDS
    parts   see `together`

    Ends early where all samples are refused, at the beginning with a piece of no moments.
    """
    regime, N, x = case.regime, len(case.stand.flywheels), block.x
    laws = [wheel.law if isinstance(wheel.law, TorqueLaw) else None for wheel in regime.flywheels]
    block.given["order"][0] = case.order
    held = np.array(regime.has_speed_law, dtype=bool)
    phase, speed = (
        held | np.array([getattr(wheel, name) is not None for wheel in regime.flywheels], dtype=bool)
        for name in ("phase", "speed")
    )
    begin = np.where(phase[:, None], case.phi0[:, None], x[13 : 13 + N])
    x[13 : 13 + N] = wrap_phases(begin)
    x[13 + N :] = np.where(speed[:, None], case.phi_dot0[:, None], x[13 + N :])
    course = Course(block, regime.has_speed_law, laws, regime.by_torque, regime.mixes_speed_and_torque, needs)
    counts = np.maximum(1, np.ceil(np.diff(case.times, prepend=0.0) / case.dt * (1 - 1e-9))).astype(np.int32)
    counts *= parts if regime.by_torque else 1
    counts[0] = 0
    at_once = max(1, NUMBERS // sum(buffer.nbytes // 8 for buffer in course.memory(1).values()))
    first, total = 0, len(counts)
    while first < total:
        steps = np.cumsum(counts[first : first + at_once])
        last = first + (max(1, int(np.searchsorted(steps, STEPS, "right"))) if first else 1)
        moments = course.memory(last - first)
        rows = _rows(case, block.inputs, block.x.dtype, first, counts[first:last].tobytes())
        kept = course.run(rows, moments, not first)
        if not first:
            course.rate[:] = block.given["phi_ddot"]
        t = case.times[first : first + kept]
        if "phi" in needs:
            moments["phi"] += begin
            moments["phi"][:kept, held] = case.motion(t)[0][:, held, None]
        for j in np.flatnonzero(course.status < 0):
            late = t > course.when[j] if course.where[j] == 0 else t >= course.when[j]
            for array in moments.values():
                array[:kept][late, :, j] = np.nan
        if kept or not first:
            yield Moments(t, **{name: array[:kept] for name, array in moments.items()})
        if kept < last - first:
            return
        first = last


@lru_cache(maxsize=4)  # blocks of many samples have the same
def _rows(case: Case, inputs: tuple[str, ...], real: Any, first: int, of_moments: bytes) -> Mapping[str, Array]:
    """What the C reads of the steps that lead to moments of output from number `first` on: see `course.c`.

    inputs      bodies that take a run-time wrench; real: type of the C
    of_moments  numbers of steps to each moment, as bytes of int32
    """
    counts = np.frombuffer(of_moments, dtype=np.int32)
    ends = case.times[first : first + len(counts)]
    begins = np.append(case.times[first - 1] if first else 0.0, ends[:-1])
    lengths = (ends - begins) / np.maximum(counts, 1)
    rows = np.cumsum(counts + 1)
    of = np.repeat(np.arange(len(counts)), counts + 1)
    times = begins[of] + lengths[of] * (np.arange(rows[-1]) - (rows - counts - 1)[of])
    times[rows - 1] = ends
    begin = np.delete(np.arange(rows[-1]), rows - 1)
    h = lengths[of][begin]
    middles = times[begin] + h / 2
    phi, speeds, _ = case.motion(times)
    mean = (speeds[begin + 1] - speeds[begin]) / h[:, None]
    result = {"phi": wrap_phases(phi), "phi_dot": speeds, "mean": mean, "between": mean, "halfway": mean}
    if case.regime.by_torque:
        halfway, middle_speeds, _ = case.motion(middles)
        result["halfway"] = wrap_phases(halfway)
        # not a difference of phases, which may be large
        result["between"] = (speeds[begin] + 4 * middle_speeds + speeds[begin + 1]) / 6
    result |= {"wrench": case.wrenches(middles, inputs), "end_wrench": case.wrenches(ends, inputs)}
    result["end_phi_ddot"] = case.motion(ends)[2]
    double = {"begin": begins, "length": lengths}
    double |= {"command": case.regime.commands(middles), "end_command": case.regime.commands(ends)}
    return {
        "count": np.ascontiguousarray(counts, dtype=np.int32),
        **{name: np.ascontiguousarray(array, dtype=real) for name, array in result.items()},
        **{name: np.ascontiguousarray(array, dtype=np.float64) for name, array in double.items()},
    }


def stand_for(stand: Stand, regime: Regime) -> Stand:
    """The stand with run-time wrenches on the bodies that need them for the regime."""
    bodies = set(regime.wrenches) | ({stand.carrier.name} if regime.mixes_speed_and_torque else set())

    def one(body: Any) -> Any:
        return replace(body, wrench_input=True) if body.name in bodies else body

    return replace(
        stand,
        carrier=one(stand.carrier),
        instruments=tuple(map(one, stand.instruments)),
        flywheels=tuple(map(one, stand.flywheels)),
    )


def _parts_of(case: Case, block: Block) -> tuple[Array, Mapping[int, str]]:
    """Parts (n) into which steps are cut, so that none is too long for how steeply torque falls with speed.

    block   in the states at t = 0: their mobility d phi_ddot / d tau counts

    Also why, by number of the state, a law is too steep.
    """
    falls = np.array([case.regime.steepness(motors) for motors in block.motors]).T
    if not np.any(falls > 0.0):
        return np.ones(block.n), {}
    block.given["locked"][:] = case.regime.has_speed_law
    mobility = _mobility(block)
    rates = sum(mobility[:, s] * fall for s, fall in enumerate(falls))  # 1/s; in this order, whatever n is
    parts = np.fmax(1.0, np.ceil(case.dt * np.max(rates, axis=0) / TORQUE_STEP))  # upper bounds of the eigenvalues
    falls = np.broadcast_to(falls, mobility.shape[1:])
    reasons = {}
    for j in np.flatnonzero(parts > MOST_PARTS).tolist():
        worst = int(np.argmax(falls[:, j] * np.diag(mobility[..., j])))
        wheel, motor = case.regime.flywheels[worst], block.motors[j % len(block.motors)][worst]
        milder = "a wider `band`" if isinstance(wheel.law, RunUp) else "a `torque_speed` that is less steep"
        rubs = motor is not None and 2.0 * slip(motor) > falls[worst, j]
        mend = "a larger `coulomb_speed` of its motor" if rubs else milder
        reasons[j] = (
            f"{case.regime.name}: flywheel {wheel.name}: its torque falls by up to "
            f"{falls[worst, j]:.3g} N m per rad/s, too steep for steps of {case.dt:.3g} s; expected {mend}, "
            f"dt={case.dt * MOST_PARTS / parts[j]:.2g}, or backend=scipy"
        )
    return parts, reasons


def _mobility(block: Block) -> Array:
    """d phi_ddot / d tau (N, N, n; magnitudes, 1/(kg m2)) at the states of a block: phi'' is linear in the torques."""
    memory, rates = block.given, []
    for tau in (np.zeros(len(memory["tau"])), *np.eye(len(memory["tau"]))):
        memory["tau"][:] = tau[:, None]
        block.run("coupled")
        rates.append(memory["phi_ddot"].astype(np.float64))
    memory["tau"][:] = 0.0
    return np.abs(np.array(rates[1:]) - rates[0]).swapaxes(0, 1)


def together(
    case: Case | None,
    made: CompiledLibrary,
    x: Array,
    tables: StandTables | None,
    size: int = SAMPLES,
    lost: dict[int, str] | None = None,
) -> Iterator[tuple[Array, Block, int]]:  # fmt: skip
    """Blocks of states (13 + 2 N, n) that are stepped together; numbers of these, and the parts of their steps.

    What is computed of a state depends on no other: those of a block have equal parts.

    case  None: there are no steps
    size  states of a block, at most, a multiple of all LANES
    lost  states for which a law is too steep are left out, and the reasons put here; None: UsageError is raised
    """
    stand, n = made.source.stand, x.shape[1]

    def blocks(rows: Array, of: StandTables | None) -> Iterator[tuple[Array, Block]]:
        for first in range(0, len(rows), size):
            block = Block(stand, made, len(rows[first : first + size]), of, first, case is not None and case.carried)
            block.x[:] = x[:, rows[first : first + size]]
            yield rows[first : first + size], block

    parts = np.ones(n)
    if case is not None and case.regime.by_torque:
        for rows, block in blocks(np.arange(n), tables):
            parts[rows], reasons = _parts_of(case, block)
            for j, reason in reasons.items():
                if lost is None:
                    raise UsageError(reason)
                parts[rows[j]], lost[int(rows[j])] = np.inf, reason
    counts = np.unique(parts)
    for count in counts[np.isfinite(counts)].tolist():
        of = np.flatnonzero(parts == count)
        for rows, block in blocks(of, tables if tables is None or len(counts) == 1 else tables.part(of)):
            yield rows, block, int(count)


def why_refused(stand: Stand, block: Block, j: int) -> str:
    """Why sample j is refused, with what is wrong with its place in a stream; "" where it is not."""
    words = block.reason(j)
    try:
        stream_at(stand, tuple(block.x[:3, j].tolist()))
    except StateError as outside:
        return f"{words.rpartition(': ')[0]}: {outside}" if words else ""
    return words
