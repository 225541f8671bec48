"""Motion by the generated C: its function `step`, or `step_driven` where all speeds are given."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.emit.names import member as c_member
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.pieces import stream_at
from mahovik.proof.verify.c_backend import CBackend
from mahovik.use.simulate.case import Array, Case, Moment, wrap_phases

REACTION = "forward"
"""Want that answers the reaction of a hold at a state with its accelerations."""


class CMotion:
    """Simulation by steps of the C. Given phases and speeds are set exactly at the beginning of each step.

    The carry of each number that is set begins as zero, where the case asks for a carry.
    Within a step torques, wrenches and flywheel accelerations are constant: torques and wrenches of its middle,
    accelerations by the speeds at its ends. Where a torque falls steeply with speed a step is cut into parts
    (Steepness). Beside torques a flywheel of given speed is locked at its mean speed,
    and the reaction to its acceleration is a wrench on the carrier (Reaction).
    """

    def __init__(self, case: Case) -> None:
        self.case = case
        reacting = {case.stand.carrier.name} if case.regime.mixes_speed_and_torque else set()
        self.c = compiled_backend(with_wrench_inputs(case.stand, set(case.regime.wrenches) | reacting), case.real)
        self._name = "step" if case.regime.by_torque or not case.stand.flywheels else "step_driven"
        N = len(case.stand.flywheels)
        ffi = self.c.library.ffi
        self._x = ffi.new(f"{case.stand.name}_state *")
        kind = self.c.program.precision.scalar
        self._view = np.frombuffer(ffi.buffer(self._x), dtype=kind)
        self._carry = ffi.new(f"{case.stand.name}_step_carry *")
        self._rounding = np.frombuffer(ffi.buffer(self._carry), dtype=kind)
        self._phi, self._phi_dot = slice(13, 13 + N), slice(13 + N, 13 + 2 * N)
        self._drive = np.zeros(max(N, 1), dtype=kind)
        self._given = np.array(case.regime.has_speed_law, dtype=bool)
        self._locked = np.array([*map(int, case.regime.has_speed_law), 0], dtype=np.intc)
        self._wrench = np.zeros(6 * max(len(self.c.inputs), 1), dtype=kind)
        self._rate = np.zeros(N)
        self._turns = np.zeros(N)
        start = case.start
        attitude = self.c.arguments(start)["x"]["attitude"]
        self._view[:13] = [*start.position, *attitude, *start.V]
        self._view[self._phi] = wrap_phases(case.phi0)
        self._view[self._phi_dot] = case.phi_dot0
        self._reaction = Reaction(self.c, self._x) if case.regime.mixes_speed_and_torque else None
        self._steepness = Steepness(case)
        self._mobility: Mobility | ClampedMobility | None = None
        if self._steepness.matters:
            hold = case.stand.hold
            make = Mobility if hold is None or hold.freedoms else ClampedMobility
            self._mobility = make(self.c, self._x, self._locked[:N].tolist())
            self._steepness.check(case.dt, self._mobility.matrix())

    def moments(self, mounts: bool) -> Iterator[Moment]:
        """One moment for every time of output. Raises StateError if the motion leaves the computable range."""
        phi = self.case.phi0.copy()
        times = self.case.times
        for k, t in enumerate(times):
            if k:
                phi = self._advance(float(times[k - 1]), float(t), phi)
            yield self._moment(float(t), phi, mounts)

    def _arguments(self, h: float) -> list[Any]:
        ffi = self.c.library.ffi

        def real(array: Array) -> Any:
            return ffi.cast(f"{self.case.stand.name}_real *", array.ctypes.data)

        known = {
            "table": self.c.library.default("default"),
            "x": self._x,
            "tau": real(self._drive),
            "phi_ddot": real(self._drive),
            "locked": ffi.cast("int *", self._locked.ctypes.data),
            "wrench": real(self._wrench),
            "dt": h,
            "order": self.case.order,
            "carry": self._carry if self.case.carried else ffi.NULL,
            "next": self._x,
        }
        return [known[a.name] for a in self.c.program.function(self._name).arguments]

    def _advance(self, begin: float, end: float, phi: Array) -> Array:
        """Step from one time of output to the next; return the phases there, not wrapped."""
        case, view = self.case, self._view
        count = max(1, math.ceil((end - begin) / case.dt * (1 - 1e-9)))
        h = (end - begin) / count
        times: Array = begin + h * np.arange(count + 1, dtype=np.float64)
        times[-1] = end
        if not case.regime.by_torque:
            return self._given_speeds(times)
        if begin == 0.0:
            self._rate = self._accelerations(0.0)[1]
        if self._mobility is None:
            turned = self._torque_steps(times)
        else:
            turned = np.zeros(len(phi))
            for one, next_ in itertools.pairwise(times):
                parts = self._steepness.parts(h, self._mobility.matrix(), view[self._phi_dot], self._rate)
                turned += self._torque_steps(np.linspace(one, next_, parts + 1))
        return np.where(self._given, case.motion(times[-1:])[0][0], phi + turned)

    def _given_speeds(self, times: Array) -> Array:
        """Steps of equal length if all speeds are given; return the phases at the end."""
        view, h = self._view, float(times[1] - times[0])
        step, arguments = self.c.library.function(self._name), self._arguments(h)
        given, speeds, _ = self.case.motion(times)
        states, mean = wrap_phases(given), np.diff(speeds, axis=0) / h
        for k, begin in enumerate(times[:-1]):
            self._set_wrench(begin + h / 2)
            view[self._phi], view[self._phi_dot] = states[k], speeds[k]
            self._rounding[13:] = 0.0
            self._drive[: len(mean[k])] = mean[k]
            self._check(step(*arguments), begin)
        view[self._phi], view[self._phi_dot] = states[-1], speeds[-1]
        return np.asarray(given[-1])

    def _torque_steps(self, times: Array) -> Array:
        """Steps of equal length under torques; return the angles turned by the flywheels."""
        case, view, held = self.case, self._view, self._given
        h = float(times[1] - times[0])
        step, arguments = self.c.library.function(self._name), self._arguments(h)
        middles = times[:-1] + h / 2
        (given, speeds, _), (halfway, middle_speeds, _) = case.motion(times), case.motion(middles)
        states, mean = wrap_phases(given), np.diff(speeds, axis=0) / h
        locked = (speeds[:-1] + 4 * middle_speeds + speeds[1:]) / 6  # not a difference of phases, which may be large
        whole = np.zeros(len(self._rate))
        for k, middle in enumerate(middles):
            before, phase = (view[part].astype(np.float64) for part in (self._phi_dot, self._phi))
            if self._reaction is not None:
                view[self._phi][held] = wrap_phases(halfway[k])[held]
            self._set_wrench(middle, np.where(held, mean[k], 0.0))
            view[self._phi][held], view[self._phi_dot][held] = states[k][held], locked[k][held]
            self._rounding[13:][np.tile(held, 2)] = 0.0
            self._drive[:] = case.torques(middle, before + h / 2 * self._rate)
            self._check(step(*arguments), times[k])
            view[self._phi][held], view[self._phi_dot][held] = states[k + 1][held], speeds[k + 1][held]
            after = view[self._phi_dot].astype(np.float64)
            self._rate = (after - before) / h
            turned, expected = view[self._phi] - phase, h * (before + after) / 2
            whole += turned + 2 * np.pi * np.round((expected - turned) / (2 * np.pi))
        return whole

    def _set_wrench(self, t: float, accelerations: Array | None = None) -> None:
        """Set the run-time wrenches at a time; on the carrier also the reaction to given `accelerations`."""
        if self.case.regime.wrenches or self._reaction is not None:
            now = self.case.regime.wrench(t)
            for i, body in enumerate(self.c.inputs):
                self._wrench[6 * i : 6 * i + 6] = now.get(body, (0.0,) * 6)
        if self._reaction is not None and accelerations is not None:
            self._wrench[self._reaction.place] += self._reaction.wrench(accelerations)

    def _check(self, status: int, t: float) -> None:
        if status < 0:
            where = f"at t = {t:.6g} s a step returned {status_words(status)}"
            try:
                x, y, z = self._view[:3].tolist()
                stream_at(self.case.stand, (x, y, z))
            except StateError as outside:
                raise StateError(f"{where}: {outside}") from None
            raise StateError(f"{where}: the motion leaves its ranges")

    def _accelerations(self, t: float) -> tuple[Array, Array, Array]:
        """V_dot, phi_ddot and drive torques at the present state."""
        case, view = self.case, self._view
        phi_dot = view[self._phi_dot].copy()
        state = case.state(t, view[:3], view[3:7], view[7:13], view[self._phi], phi_dot)
        tau = np.array(case.torques(t, phi_dot))
        inputs = self.c.arguments(replace(state, tau=tuple(tau.tolist()))) | {"x": self._x}
        phi_ddot = case.motion(np.array([t]))[2][0]
        if case.regime.by_torque:
            self._set_wrench(t, np.where(self._given, phi_ddot, 0.0))
            now = {"locked": self._locked[:-1].tolist(), "wrench": self._wrench.tolist()}
            found = self._call("coupled", inputs | now, t)
            phi_ddot = np.where(self._given, phi_ddot, found["phi_ddot"])
        else:
            found = self._call("forward", inputs | {"phi_ddot": phi_ddot.tolist()}, t)
        V_dot = np.array(found["V_dot"])
        if case.stand.flywheels:
            inputs |= {"phi_ddot": phi_ddot.tolist(), "V_dot": V_dot.tolist()}
            needed = np.array(self._call("torque", inputs, t)["tau"])
            tau = np.where([each.by_torque for each in case.regime.flywheels], tau, needed)
        return V_dot, phi_ddot, tau

    def _call(self, function: str, inputs: dict[str, Any], t: float) -> dict[str, Any]:
        status, outputs = self.c.call(function, inputs)
        self._check(status, t)
        return outputs

    def _moment(self, t: float, phi: Array, mounts: bool) -> Moment:
        view = self._view
        V_dot, phi_ddot, tau = self._accelerations(t)
        state = self.case.state(t, view[:3], view[3:7], view[7:13], view[self._phi], view[self._phi_dot].copy())
        state = self.case.moving(state, V_dot, phi_ddot)
        want = ["points", "mounts"] if mounts else ["points"]
        found = self.c.evaluate(state, want)
        loads = np.array(found["mount_wrench"]).reshape(-1, 6) if mounts else None
        reaction = None
        if self.case.stand.hold is not None:
            reaction = np.array(self.c.evaluate(state, [REACTION])["reaction"])
        return Moment(t, state, phi.copy(), tau, found["points"], loads, reaction)


@lru_cache(maxsize=4)
def compiled_backend(stand: Stand, real: str = "double") -> CBackend:
    """The compiled C of a stand; the last few are cached, so that many runs of one stand compile once."""
    return CBackend(stand, real)


def with_wrench_inputs(stand: Stand, bodies: set[str]) -> Stand:
    """The stand with a run-time wrench on the named bodies, besides those that have one already."""

    def one(body: Any) -> Any:
        return replace(body, wrench_input=body.wrench_input or body.name in bodies)

    return replace(
        stand,
        carrier=one(stand.carrier),
        instruments=tuple(map(one, stand.instruments)),
        flywheels=tuple(map(one, stand.flywheels)),
    )


TORQUE_STEP = 0.1
"""Largest (fall of torque by speed) (turning acceleration by torque) dt of a step.

The torque of a step is taken at a speed extrapolated from the previous step. Such a scheme is stable below 1; at 0.1
its error in approaching a speed is a thousandth of the remaining difference.
"""

MOST = 1000
"""Most parts of a step; a law that needs more is refused before the run."""


class Steepness:
    """Parts into which the steps of a case must be cut.

    `mobility`: d phi_ddot / d tau at the present state (N x N, magnitudes, 1/(kg m2)).
    """

    def __init__(self, case: Case) -> None:
        self._regime = case.regime
        self._motors = tuple(s.motor for s in case.stand.flywheels)
        anywhere = np.full(len(self._motors), np.inf)
        self._most = self._regime.steepness(-anywhere, anywhere, self._motors)
        self.matters = bool(np.any(self._most > 0.0))

    def parts(self, h: float, mobility: Array, speeds: Array, rate: Array) -> int:
        """Number of parts of a step of `h` s that begins at these speeds (rad/s), changing at `rate` (rad/s2)."""
        if _parts(h, mobility, self._most) == 1:
            return 1
        reach = 2.0 * h * np.abs(rate)  # steepest slope in the range that the step may reach
        return min(MOST, _parts(h, mobility, self._regime.steepness(speeds - reach, speeds + reach, self._motors)))

    def most_parts(self, h: float, mobility: Array) -> int:
        """Largest number of parts of a step of `h` s, at any speed."""
        return _parts(h, mobility, self._most)

    def check(self, h: float, mobility: Array) -> None:
        """Raise UsageError if steps of `h` s need too many parts."""
        parts = self.most_parts(h, mobility)
        if parts > MOST:
            worst = int(np.argmax(self._most * np.diag(mobility)))
            raise UsageError(
                f"{self._regime.name}: flywheel {self._regime.flywheels[worst].name}: its torque falls by up to "
                f"{self._most[worst]:.3g} N m per rad/s, too steep for steps of {h:.3g} s; expected a wider `band` "
                f"(or `coulomb_speed` of its motor), --dt {h * MOST / parts:.2g}, or --backend scipy"
            )


def _parts(h: float, mobility: Array, falls: Array) -> int:
    fastest = float((mobility * falls).sum(axis=1).max())  # 1/s; upper bound of the eigenvalues
    return max(1, math.ceil(h * fastest / TORQUE_STEP))


def result_view(c: CBackend, x: Any, function: str, member: str, **given: Any) -> tuple[Callable[[], int], Array]:
    """A call of a C function at the state `x`, which its owner updates, and the numbers of one member of its result.

    Inputs that are not given are zero. A state out of range leaves the numbers; the next step refuses it as well.
    """
    ffi, name = c.library.ffi, c.program.name
    out = ffi.new(f"{name}_{function}_result *")
    count = max(6 * len(c.inputs), len(given.get("locked", ())), 1)
    zero = ffi.new(f"{name}_real[]", count)
    known = {"table": c.library.default("default"), "x": x, "tau": zero, "wrench": zero, "out": out, **given}
    arguments = [known[a.name] for a in c.program.function(function).arguments]
    call = c.library.function(function)
    return lambda: int(call(*arguments)), np.frombuffer(
        ffi.buffer(ffi.addressof(out, c_member(member))), dtype=c.program.precision.scalar
    )


class Mobility:
    """d phi_ddot / d tau (N x N, 1/(kg m2)) at the state `x`, which its owner updates. Locked flywheels: zero."""

    def __init__(self, c: CBackend, x: Any, locked: list[int]) -> None:
        array = c.library.ffi.new("int[]", locked)
        self._call, view = result_view(c, x, "coupled_jacobian", "phi_ddot_tau", locked=array)
        self._view = view.reshape(len(locked), -1)

    def matrix(self) -> Array:
        """Mobility matrix; unchanged if the state is out of range."""
        self._call()
        return np.abs(self._view)


class ClampedMobility:
    """Mobility of a clamped carrier, whose C has no Jacobians: by calls of `coupled`, linear in the torques."""

    def __init__(self, c: CBackend, x: Any, locked: list[int]) -> None:
        self._c, self._inputs = c, {"x": x, "locked": locked, "table": c.library.default("default")}
        self._inputs["wrench"] = [0.0] * (6 * max(len(c.inputs), 1))
        self._matrix = np.zeros((len(locked), len(locked)))

    def matrix(self) -> Array:
        """Mobility matrix; unchanged if the state is out of range."""
        torques = np.vstack([np.zeros(len(self._matrix)), np.eye(len(self._matrix))])
        found = [self._c.call("coupled", self._inputs | {"tau": tau.tolist()}) for tau in torques]
        if all(status >= 0 for status, _ in found):
            rates = np.array([outputs["phi_ddot"] for _, outputs in found])
            self._matrix = np.abs(rates[1:] - rates[0]).T
        return self._matrix


class Reaction:
    """-sum I_s phi_s'' of (8) at the state `x`, which its owner updates; `place`: index of the carrier's wrench.

    `coupled` and `step` lock a flywheel at constant speed only. A known acceleration is a term
    without unknowns in (8) and can be added to F; it does not appear in the rows of other flywheels.
    """

    def __init__(self, c: CBackend, x: Any) -> None:
        self._call, view = result_view(c, x, "matrices", "I")
        self._I = view.reshape(6, -1)
        first = 6 * c.inputs.index("carrier")
        self.place = slice(first, first + 6)

    def wrench(self, accelerations: Array) -> Array:
        """Force and moment about O1 in E1 for these phi'' (N, rad/s2; zero if not given)."""
        return np.zeros(6) if self._call() < 0 else -(self._I @ accelerations)
