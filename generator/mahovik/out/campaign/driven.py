"""Many samples of which some flywheels are driven by torque: the steps of `simulate`, all samples at once."""

from __future__ import annotations

import itertools
import math

import numpy as np

from mahovik.core.toolchain.block import Block
from mahovik.out.campaign.observe import Observer
from mahovik.out.campaign.pose import Array
from mahovik.use.simulate.by_c import Steepness, add_reaction
from mahovik.use.simulate.case import Case, wrap_phases


class DrivenByTorque:
    """Runs blocks through a case whose regime gives torques, of all flywheels or of some.

    inputs    bodies that take a run-time wrench
    mobility  (N, N): d phi_ddot / d tau of the stand of the file, magnitudes; None: no torque falls with speed
    """

    def __init__(self, case: Case, inputs: tuple[str, ...], mobility: Array | None) -> None:
        """Raises UsageError: a law is too steep."""
        self._case, self._inputs, self._mobility = case, inputs, mobility
        self._steepness = Steepness(case)
        self._held = np.array(case.regime.has_speed_law, dtype=bool)
        if mobility is not None:
            self._steepness.check(case.dt, mobility)

    def run(self, block: Block, observer: Observer) -> None:
        """Step all samples from their states at t = 0, and show the observer every time of output."""
        case, N = self._case, len(self._held)
        given, held = block.given, self._held
        given["order"][0], given["locked"][:] = case.order, held
        block.x[13 : 13 + N], block.x[13 + N :] = wrap_phases(case.phi0)[:, None], case.phi_dot0[:, None]
        times = case.times.tolist()
        rate = np.zeros((N, block.n))
        for k, end in enumerate(times):
            if k:
                begin = times[k - 1]
                count = max(1, math.ceil((end - begin) / case.dt * (1 - 1e-9)))
                grid = begin + (end - begin) / count * np.arange(count + 1, dtype=np.float64)
                grid[-1] = end
                if self._mobility is None:
                    self._steps(block, grid, rate)
                else:
                    # as many as any sample needs at any speed: the steps of one sample do not depend on the others
                    parts = self._steepness.most_parts((end - begin) / count, self._mobility)
                    for one, next_ in itertools.pairwise(grid):
                        self._steps(block, np.linspace(one, next_, parts + 1), rate)
            observer.take(end, lambda t: self._solve(block, t))
            if not k:
                self._solve(block, 0.0)
                rate[:] = given["phi_ddot"]

    def _steps(self, block: Block, times: Array, rate: Array) -> None:
        """Steps of equal length under torques."""
        case, held, N, given = self._case, self._held, len(self._held), block.given
        h = float(times[1] - times[0])
        middles = times[:-1] + h / 2
        (phi, speeds, _), (halfway, middle_speeds, _) = case.motion(times), case.motion(middles)
        states, mean = wrap_phases(phi), np.diff(speeds, axis=0) / h
        locked = (speeds[:-1] + 4 * middle_speeds + speeds[1:]) / 6
        own_phi, own_speeds = block.x[13 : 13 + N], block.x[13 + N :]
        some = bool(held.any())
        given["dt"][0] = h
        for k, middle in enumerate(middles.tolist()):
            before = own_speeds.copy()
            if some:
                own_phi[held] = wrap_phases(halfway[k])[held][:, None]
            self._wrench(block, middle, np.where(held, mean[k], 0.0))
            if some:
                own_phi[held], own_speeds[held] = states[k][held][:, None], locked[k][held][:, None]
            given["tau"][:] = case.torques(middle, before + h / 2 * rate)
            block.call("step", float(times[k]))
            if some:
                own_phi[held], own_speeds[held] = states[k + 1][held][:, None], speeds[k + 1][held][:, None]
            rate[:] = (own_speeds - before) / h

    def _wrench(self, block: Block, t: float, accelerations: Array) -> None:
        """Run-time wrenches at a time; on the carrier also the reaction to given accelerations (N)."""
        wrench = block.given["wrench"]
        if wrench.size:
            now = self._case.regime.wrench(t)
            wrench[:] = np.concatenate([now.get(body, (0.0,) * 6) for body in self._inputs])[:, None]
        if self._case.regime.mixes_speed_and_torque:
            add_reaction(block, self._inputs.index(self._case.stand.carrier.name), accelerations)

    def _solve(self, block: Block, t: float) -> None:
        """V_dot, phi_ddot and drive torques at the state of the block."""
        case, held, given = self._case, self._held, block.given
        N = len(held)
        phi_ddot = case.motion(np.array([t]))[2][0]
        driven = case.torques(t, block.x[13 + N :])
        self._wrench(block, t, np.where(held, phi_ddot, 0.0))
        given["tau"][:] = driven
        block.call("coupled" if N else "forward", t)
        given["phi_ddot"][held] = phi_ddot[held][:, None]
        if held.any():
            block.call("torque", t)
            given["tau"][~held] = driven[~held]
        if case.stand.hold is not None and case.regime.mixes_speed_and_torque:  # the hold bears phi'' besides
            self._wrench(block, t, np.zeros(N))
