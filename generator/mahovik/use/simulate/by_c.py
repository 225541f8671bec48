"""Motion by the generated C: its function `step`, or `step_driven` where all speeds are given."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any, cast

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.block import Block
from mahovik.core.toolchain.compiled import Real
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.pieces import stream_at
from mahovik.proof.verify.backends import KeptBackend
from mahovik.use.simulate.case import Array, Case, Moment, wrap_phases

REACTION = "forward"
"""Want that answers the reaction of a hold at a state with its accelerations."""


class CMotion:
    """Simulation by steps of the C. Given phases and speeds are set exactly at the beginning of each step.

    The carry of each number that is set begins as zero, where the case asks for a carry.
    Within a step torques, wrenches and flywheel accelerations are constant: torques and wrenches of its middle,
    accelerations by the speeds at its ends. Where a torque falls steeply with speed a step is cut into parts
    (Steepness). Beside torques a flywheel of given speed is locked at its mean speed, and the reaction to its
    acceleration is a wrench on the carrier (`add_reaction`).
    """

    def __init__(self, case: Case) -> None:
        self.case = case
        reacting = {case.stand.carrier.name} if case.regime.mixes_speed_and_torque else set()
        self.c = compiled_backend(with_wrench_inputs(case.stand, set(case.regime.wrenches) | reacting), case.real)
        self._block = block = Block(case.stand, self.c.made, 1, carried=case.carried)
        N = len(case.stand.flywheels)
        self._x, self._phi, self._phi_dot = (
            block.x[part, 0] for part in (slice(None), slice(13, 13 + N), slice(13 + N, None))
        )
        self._held = np.array(case.regime.has_speed_law, dtype=bool)
        self._rate = np.zeros(N)
        block.given["order"][0], block.given["locked"][:] = case.order, self._held
        start = case.start
        self._x[:13] = [*start.position, *self.c.arguments(start)["x"]["attitude"], *start.V]
        self._phi[:], self._phi_dot[:] = wrap_phases(case.phi0), case.phi_dot0
        self._steepness = Steepness(case)
        if self._steepness.matters:
            self._steepness.check(case.dt, mobility(block))

    def moments(self, mounts: bool) -> Iterator[Moment]:
        """One moment for every time of output. Raises StateError if the motion leaves the computable range."""
        phi = self.case.phi0.copy()
        times = self.case.times
        for k, t in enumerate(times):
            if k:
                phi = self._advance(float(times[k - 1]), float(t), phi)
            yield self._moment(float(t), phi, mounts)

    def _advance(self, begin: float, end: float, phi: Array) -> Array:
        """Step from one time of output to the next; return the phases there, not wrapped."""
        case = self.case
        count = max(1, math.ceil((end - begin) / case.dt * (1 - 1e-9)))
        h = (end - begin) / count
        times: Array = begin + h * np.arange(count + 1, dtype=np.float64)
        times[-1] = end
        if not case.regime.by_torque:
            return self._given_speeds(times)
        if begin == 0.0:
            self._rate = self._accelerations(0.0)[1]
        if not self._steepness.matters:
            turned = self._torque_steps(times)
        else:
            turned = np.zeros(len(phi))
            for one, next_ in itertools.pairwise(times):
                parts = self._steepness.parts(h, mobility(self._block), self._phi_dot, self._rate)
                turned += self._torque_steps(np.linspace(one, next_, parts + 1))
        return np.where(self._held, case.motion(times[-1:])[0][0], phi + turned)

    def _given_speeds(self, times: Array) -> Array:
        """Steps of equal length if all speeds are given; return the phases at the end."""
        h, block = float(times[1] - times[0]), self._block
        given, speeds, _ = self.case.motion(times)
        states, mean = wrap_phases(given), np.diff(speeds, axis=0) / h
        block.given["dt"][0] = h
        step, everything = "step_driven" if len(self._phi) else "step", np.ones_like(self._held)
        accelerations = block.given["phi_ddot"][:, 0]
        for k, begin in enumerate(times[:-1]):
            self._set_wrench(begin + h / 2)
            self._phi[:], self._phi_dot[:] = states[k], speeds[k]
            if self.case.carried:
                self._forget_rounding(everything)
            accelerations[:] = mean[k]
            if (status := block.run(step)) < 0:
                raise self._refusal("a step", status, begin)
        self._phi[:], self._phi_dot[:] = states[-1], speeds[-1]
        return np.asarray(given[-1])

    def _torque_steps(self, times: Array) -> Array:
        """Steps of equal length under torques; return the angles turned by the flywheels."""
        case, held, block = self.case, self._held, self._block
        h = float(times[1] - times[0])
        middles = times[:-1] + h / 2
        (given, speeds, _), (halfway, middle_speeds, _) = case.motion(times), case.motion(middles)
        states, mean = wrap_phases(given), np.diff(speeds, axis=0) / h
        locked = (speeds[:-1] + 4 * middle_speeds + speeds[1:]) / 6  # not a difference of phases, which may be large
        whole = np.zeros(len(self._rate))
        block.given["dt"][0] = h
        for k, middle in enumerate(middles):
            before, phase = self._phi_dot.astype(np.float64), self._phi.astype(np.float64)
            if case.regime.mixes_speed_and_torque:
                self._phi[held] = wrap_phases(halfway[k])[held]
            self._set_wrench(middle, np.where(held, mean[k], 0.0))
            self._phi[held], self._phi_dot[held] = states[k][held], locked[k][held]
            if case.carried:
                self._forget_rounding(held)
            block.given["tau"][:, 0] = case.torques(middle, before + h / 2 * self._rate)
            if (status := block.run("step")) < 0:
                raise self._refusal("a step", status, times[k])
            self._phi[held], self._phi_dot[held] = states[k + 1][held], speeds[k + 1][held]
            after = self._phi_dot.astype(np.float64)
            self._rate = (after - before) / h
            turned, expected = self._phi - phase, h * (before + after) / 2
            whole += turned + 2 * np.pi * np.round((expected - turned) / (2 * np.pi))
        return whole

    def _forget_rounding(self, which: Array) -> None:
        """Phases and speeds that were set have no carry."""
        self._block.given["carry"]["rounding"][0, 13:][np.tile(which, 2)] = 0.0

    def _set_wrench(self, t: float, accelerations: Array | None = None) -> None:
        """Set the run-time wrenches at a time; on the carrier also the reaction to given `accelerations`."""
        if self.case.regime.wrenches or self.case.regime.mixes_speed_and_torque:
            now = self.case.regime.wrench(t)
            for i, body in enumerate(self.c.inputs):
                self._block.given["wrench"][6 * i : 6 * i + 6, 0] = now.get(body, (0.0,) * 6)
        if self.case.regime.mixes_speed_and_torque and accelerations is not None:
            add_reaction(self._block, self.c.inputs.index(self.case.stand.carrier.name), accelerations)

    def _call(self, function: str, t: float) -> None:
        """Call a function of the C at the present state. Raises StateError: it refuses."""
        if (status := self._block.run(function)) < 0:
            raise self._refusal(function, status, t)

    def _refusal(self, function: str, status: int, t: float) -> StateError:
        """Why a function refuses the present state, in words."""
        where = f"at t = {t:.6g} s {function} returned {status_words(status)}"
        try:
            x, y, z = self._x[:3].tolist()
            stream_at(self.case.stand, (x, y, z))
        except StateError as outside:
            return StateError(f"{where}: {outside}")
        return StateError(f"{where}: the motion leaves its ranges")

    def _accelerations(self, t: float) -> tuple[Array, Array, Array]:
        """V_dot, phi_ddot and drive torques at the present state."""
        case, held, given = self.case, self._held, self._block.given
        tau = case.torques(t, self._phi_dot)
        phi_ddot = case.motion(np.array([t]))[2][0]
        if case.regime.by_torque:
            self._set_wrench(t, np.where(held, phi_ddot, 0.0))
            given["tau"][:, 0] = tau
            self._call("coupled", t)
            phi_ddot = np.where(held, phi_ddot, given["phi_ddot"][:, 0])
        else:
            self._set_wrench(t)
            given["phi_ddot"][:, 0] = phi_ddot
            self._call("forward", t)
        V_dot = given["V_dot"][:, 0].astype(np.float64)
        if case.stand.flywheels:
            given["phi_ddot"][:, 0] = phi_ddot
            self._call("torque", t)
            tau = np.where(held, given["tau"][:, 0], tau)
        return V_dot, phi_ddot, tau

    def _moment(self, t: float, phi: Array, mounts: bool) -> Moment:
        V_dot, phi_ddot, tau = self._accelerations(t)
        x = self._x
        state = self.case.state(t, x[:3], x[3:7], x[7:13], self._phi, self._phi_dot)
        state = self.case.moving(state, V_dot, phi_ddot)
        answers = self.c.evaluate(state, ["points", "mounts"] if mounts else ["points"])
        loads = np.array(answers["mount_wrench"]).reshape(-1, 6) if mounts else None
        reaction = None
        if self.case.stand.hold is not None:
            reaction = np.array(self.c.evaluate(state, [REACTION])["reaction"])
        return Moment(t, state, phi.copy(), tau, answers["points"], loads, reaction)


@lru_cache(maxsize=4)
def compiled_backend(stand: Stand, real: str = "double") -> KeptBackend:
    """The compiled C of a stand; the last few are at hand, so that many runs of one stand load it once."""
    return KeptBackend(stand, cast(Real, real))


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


def mobility(block: Block) -> Array:
    """d phi_ddot / d tau (N x N, magnitudes, 1/(kg m2)) at the one state of a block. Locked flywheels: zero.

    Of a state out of range it is what it was; the next step refuses that state as well.
    """
    if block.has("coupled_jacobian"):
        block.run("coupled_jacobian")
        return np.asarray(np.abs(block.member("coupled_jacobian", "phi_ddot_tau")[..., 0]))
    given, rates = block.given, []  # a clamped carrier has no Jacobians; phi'' is linear in the torques
    kept = given["tau"].copy()
    for tau in (np.zeros(len(kept)), *np.eye(len(kept))):
        given["tau"][:, 0] = tau
        block.run("coupled")
        rates.append(given["phi_ddot"][:, 0].copy())
    given["tau"][:] = kept
    return np.asarray(np.abs(np.array(rates[1:]) - rates[0]).T)


def add_reaction(block: Block, place: int, accelerations: Array) -> None:
    """Add -sum I_s phi_s'' of (8) to the wrench on the carrier, in E1 about O1, for these phi'' (N, rad/s2).

    `coupled` and `step` lock a flywheel at constant speed only. A known acceleration is a term without unknowns in (8)
    and can be added to F; it does not appear in the rows of other flywheels. `place`: that of the carrier's wrench.
    """
    block.call("matrices")
    coupling = block.member("matrices", "I")
    for s, value in enumerate(accelerations):
        if value:
            block.given["wrench"][6 * place : 6 * place + 6] -= coupling[:, s] * value


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
