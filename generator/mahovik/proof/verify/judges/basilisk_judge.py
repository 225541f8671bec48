"""Basilisk as a judge: its spacecraft, and its reaction wheels; back-substitution gives V* and phi'' of drive torques.

Its attitude is in modified Rodrigues parameters, its velocity that of O1 in E0, its acceleration the derivative of
this: v_E0' = C (v* + omega x v). It gives no joint forces, no points, and no wrench or torque of a given motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import Basilisk
import numpy as np
from Basilisk.architecture.bskLogging import BasiliskError
from Basilisk.simulation import reactionWheelStateEffector, spacecraft, svIntegrators

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof.verify.judges.basilisk_wheel import Wheel, hub, unsupported_features, wheels
from mahovik.proof.verify.judges.rigid import Array, Values, attitude

Model = Literal["JitterFullyCoupled", "JitterSimple"]

STEP = 10_000_000
"""ns from one call of its integrator to the next, which keeps the attitude off its singularity."""

TOLERANCE = 1e-14
"""Tolerance of a step of its integrator, relative and absolute; it measures the length of a whole state."""


class BasiliskSpacecraft:
    """A free spacecraft whose flywheels are state effectors; see MovingJudge.

    Methods of flywheels that raise NotImplementedError have another form for reaction wheels than for rotors on hinges:
    the class of each has its own.
    """

    name: str
    version: str = Basilisk.__version__

    def __init__(
        self, stand: Stand, unsupported: Sequence[str], effectors: Sequence[Any], bearing_wheels: bool = False
    ) -> None:
        """`unsupported`: what the stand has and Basilisk lacks; `bearing_wheels`: put their masses on the carrier.

        Raises UsageError where there is something of that, or Basilisk refuses the stand.
        """
        if unsupported:
            raise UsageError(f"--judges: Basilisk's free spacecraft has no {', '.join(unsupported)}")
        self.stand = stand
        self.craft = spacecraft.Spacecraft()
        mass, center, tensor = hub(stand, bearing_wheels)
        self.craft.hub.mHub = mass
        self.craft.hub.r_BcB_B = column(center)
        self.craft.hub.IHubPntBc_B = tensor.tolist()
        for effector in effectors:
            self.craft.addStateEffector(effector)
        self._integrator = svIntegrators.svIntegratorRKF78(self.craft)
        self._integrator.relTol = self._integrator.absTol = TOLERANCE
        self.craft.setIntegrator(self._integrator)
        self._clock = 0  # ns
        try:
            for effector in effectors:
                effector.Reset(0)
            self.craft.Reset(0)
        except BasiliskError as error:
            raise UsageError(f"--judges: Basilisk refuses this stand: {error}") from None

    def put_flywheels(self, state: State) -> None:
        """Set phases, speeds and drive torques of a state."""
        raise NotImplementedError

    def flywheel_rates(self) -> Array:
        """phi'' (N)."""
        raise NotImplementedError

    def flywheel_motion(self) -> tuple[Array, Array]:
        """phi, phi' (N)."""
        raise NotImplementedError

    def evaluate(self, state: State) -> Values:
        """K, V_dot, phi_ddot of `tau`; nothing of a state with a run-time wrench."""
        if state.wrench:
            return {}
        C = self._set_state(state)
        self.craft.equationsOfMotion(0.0, 1.0)
        acceleration, omega_dot = self.rate("hubVelocity"), self.rate("hubOmega")
        v, omega = np.split(np.array(state.V), 2)
        return {
            "K": self._mass_matrix(),
            "V_dot": np.concatenate([C.T @ acceleration - np.cross(omega, v), omega_dot]),
            "phi_ddot": self.flywheel_rates(),
        }

    def move(self, state: State, seconds: float) -> tuple[Array, Array, Array, Array, Array]:
        """See MovingJudge; by Basilisk's own integrator."""
        self._set_state(state)
        until = self._clock + round(seconds * 1e9)
        while self._clock < until:
            self._clock = min(self._clock + STEP, until)
            self.craft.UpdateState(self._clock)
        C = _matrix(self.value("hubSigma"))
        V = np.concatenate([C.T @ self.value("hubVelocity"), self.value("hubOmega")])
        return self.value("hubPosition"), C, V, *self.flywheel_motion()

    def _set_state(self, state: State) -> Array:
        """Put the state into Basilisk's; returns C."""
        turn = attitude(self.stand, state)
        C = np.asarray(turn.as_matrix())
        self.put_state("hubPosition", state.position)
        self.put_state("hubVelocity", C @ np.array(state.V[:3]))
        self.put_state("hubSigma", turn.as_mrp())
        self.put_state("hubOmega", state.V[3:])
        self.put_flywheels(state)
        return C

    def _mass_matrix(self) -> Array:
        """K of its mass properties, which equationsOfMotion has brought up to date."""
        m, c, J = (np.array(self.craft.dynManager.getPropertyReference(name)) for name in _PROPERTIES)
        mass, (x, y, z) = float(m[0, 0]), (float(m[0, 0]) * c).ravel()
        first = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        return np.block([[mass * np.eye(3), -first], [first, J]])

    def put_state(self, name: str, numbers: Any) -> None:
        """Set a state of the spacecraft."""
        self.craft.dynManager.getStateObject(name).setState(column(numbers))

    def value(self, name: str) -> Array:
        """Numbers of a state of the spacecraft."""
        return np.array(self.craft.dynManager.getStateObject(name).getState(), dtype=np.float64).ravel()

    def rate(self, name: str) -> Array:
        """Derivative of a state of the spacecraft."""
        return np.array(self.craft.dynManager.getStateObject(name).getStateDeriv(), dtype=np.float64).ravel()


class BasiliskJudge(BasiliskSpacecraft):
    """See MovingJudge. Raises UsageError where the stand has what Basilisk lacks.

    `model`: of the wheels; JitterSimple puts their unbalance on the carrier as a force, and is exact for balanced ones.
    `asymmetric`: take wheels of two transverse moments, for which JitterFullyCoupled is not exact.
    """

    name = "basilisk"

    def __init__(self, stand: Stand, model: Model = "JitterFullyCoupled", asymmetric: bool = False) -> None:
        unsupported = unsupported_features(stand, asymmetric)
        self._wheels = [] if unsupported else [_payload(wheel, model) for wheel in wheels(stand)]
        self._effector = reactionWheelStateEffector.ReactionWheelStateEffector()
        # extreme states are compared as well: nothing may be cut
        self._effector.setMaxWheelAcceleration(np.inf)
        for wheel in self._wheels:
            self._effector.addReactionWheel(wheel)
        effectors = [self._effector] if self._wheels else []
        super().__init__(stand, unsupported, effectors, bearing_wheels=model == "JitterSimple")

    def put_flywheels(self, state: State) -> None:
        """Set phases, speeds and drive torques of a state."""
        if self._wheels:
            self.put_state(self._effector.nameOfReactionWheelOmegasState, state.phi_dot)
            self.put_state(self._effector.nameOfReactionWheelThetasState, state.phi)
        for wheel, tau in zip(self._wheels, state.tau, strict=True):
            wheel.u_current = tau

    def flywheel_rates(self) -> Array:
        """phi'' (N)."""
        return self.rate(self._effector.nameOfReactionWheelOmegasState) if self._wheels else np.zeros(0)

    def flywheel_motion(self) -> tuple[Array, Array]:
        """phi, phi' (N)."""
        if not self._wheels:
            return np.zeros(0), np.zeros(0)
        names = self._effector.nameOfReactionWheelThetasState, self._effector.nameOfReactionWheelOmegasState
        phi, phi_dot = map(self.value, names)
        return phi, phi_dot


_PROPERTIES = ("m_SC", "centerOfMassSC", "inertiaSC")


def _payload(wheel: Wheel, model: Model) -> Any:
    """A wheel as Basilisk takes it, without friction and without limits."""
    found = reactionWheelStateEffector.RWConfigPayload()
    found.label = wheel.name[:5]
    found.RWModel = getattr(reactionWheelStateEffector, model)
    found.rWB_B = column(wheel.center)
    found.gsHat_B, found.w2Hat0_B, found.w3Hat0_B = map(column, wheel.axes.T)
    found.mass = wheel.mass
    found.Js, found.Jt, found.Jg = map(float, np.diag(wheel.tensor))
    found.U_s, found.U_d = wheel.static, float(wheel.tensor[0, 2])
    return found


def column(numbers: Any) -> list[list[float]]:
    """Numbers as Basilisk takes a vector."""
    return [[float(x)] for x in numbers]


def _matrix(sigma: Array) -> Array:
    """C (3x3) of modified Rodrigues parameters."""
    x, y, z = sigma
    square = float(sigma @ sigma)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + (8.0 * cross @ cross + 4.0 * (1.0 - square) * cross) / (1.0 + square) ** 2)
