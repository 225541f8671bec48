"""Motions by the integrators of MuJoCo and Basilisk against steps of the generated C; Basilisk's rotors on hinges."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.core.stand import Stand, load
from mahovik.core.stand.masses import inertia_about_center, pose
from mahovik.core.stand.model import State
from mahovik.core.stand.random import BARE, random_stand, random_state
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.judges import Mujoco, attitude, bare_stand
from mahovik.stands import path
from toolchain.quick import quick
from verify.holds import DRY, random_held_stand

Array = NDArray[np.float64]
Ends = tuple[Array, Rotation, Array, Array, Array]
"""Position, C, V, phases and speeds at the end of a motion."""

SECONDS, STEPS, LIMIT = 0.25, 1000, 1e-11
"""Speeds of flywheels are below 20 rad/s: a step turns one by less than 5 mrad, and order 4 errs by 1e-12 of a turn."""

needs_basilisk = pytest.mark.skipif(
    importlib.util.find_spec("Basilisk") is None and not os.environ.get("CI"), reason="no Basilisk: pip install bsk"
)


def moderate(stand: Stand, seed: int) -> State:
    """A state with drive torques from which flywheels make about a turn."""
    rng, N = np.random.default_rng(seed), len(stand.flywheels)
    tau = [x * s.inertia[0][0] for x, s in zip(rng.uniform(-10.0, 10.0, N), stand.flywheels, strict=True)]
    speeds = rng.uniform(5.0, 20.0, N) * rng.choice([-1.0, 1.0], N)
    state = replace(random_state(stand, rng), phi_dot=tuple(speeds.tolist()), tau=tuple(tau))
    return replace(state, wrench=MappingProxyType({}))


@cache
def compiled(stand: Stand) -> CBackend:
    return CBackend(stand)


def stepped(stand: Stand, state: State) -> Ends:
    """The end of a motion by `step` of the C."""
    backend = compiled(stand)
    arguments = backend.arguments(state) | {"dt": SECONDS / STEPS, "order": 4}
    for _ in range(STEPS):
        status, outputs = backend.call("step", arguments)
        assert status >= 0
        arguments["x"] = outputs["next"]
    x: Mapping[str, Any] = arguments["x"]
    turn = Rotation.from_quat(x["attitude"], scalar_first=True)
    return np.array(x["position"]), turn, *(np.array(x[key]) for key in ("V", "phi", "phi_dot"))


def difference(one: Ends, other: Ends) -> float:
    """The largest of the differences, rad or relative to the largest component, or to 1; the C wraps phases."""
    off = [float((one[1].inv() * other[1]).magnitude())]
    off += np.abs(np.exp(1j * one[3]) - np.exp(1j * other[3])).tolist()
    return max(*off, *(float(np.abs(one[k] - other[k]).max() / max(1.0, np.abs(one[k]).max())) for k in (0, 2, 4)))


def moved_by_mujoco(stand: Stand, state: State) -> Ends:
    """The end of a motion by MuJoCo's own Runge-Kutta method."""
    program = Mujoco(stand)
    u = state.V if stand.hold is None else state.u
    program.solve(state, np.array([*(program.rates * u), *state.phi_dot]))
    model, data, N = program.model, program.data, len(stand.flywheels)
    model.opt.integrator, model.opt.timestep = mujoco.mjtIntegrator.mjINT_RK4, SECONDS / STEPS
    mujoco.mj_step(model, data, STEPS)
    mujoco.mj_forward(model, data)
    V = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, 1, V, 1)
    turn = Rotation.from_quat(data.xquat[1], scalar_first=True)
    return data.xpos[1].copy(), turn, np.roll(V, 3), data.qpos[model.nq - N :].copy(), data.qvel[model.nv - N :].copy()


@pytest.mark.parametrize("hold", ["free", "hinge", "ball joint"])
def test_mujoco_moves_as_the_c_steps(hold: str) -> None:
    stand = random_stand(np.random.default_rng(2), 2, DRY) if hold == "free" else random_held_stand(hold, 2, DRY, 2)
    state = moderate(stand, 3)
    expected = stepped(stand, state)
    assert difference(moved_by_mujoco(stand, state), expected) < LIMIT
    slower = replace(state, V=tuple(0.999999 * np.array(state.V)), u=tuple(0.999999 * np.array(state.u)))
    assert difference(moved_by_mujoco(stand, slower), expected) > 1e3 * LIMIT


class BasiliskRotors:
    """A free stand without gravity: Basilisk's spacecraft with a `spinningBodyOneDOF`, a rotor on a hinge, a flywheel.

    Rotors may have any mass, centre of mass and tensor. Its attitude is in modified Rodrigues parameters, its velocity
    that of O1 in E0, its acceleration the derivative of this: C (v* + omega x v).
    """

    def __init__(self, stand: Stand, flywheels: Any = None) -> None:
        """`flywheels`: what it gets, where these are not the stand's."""
        from Basilisk.architecture import messaging
        from Basilisk.simulation import spacecraft, spinningBodyOneDOFStateEffector, svIntegrators

        self.messaging, self.stand, self.craft = messaging, stand, spacecraft.Spacecraft()
        fixed = [(body, *pose(stand, body)) for body in (stand.carrier, *stand.instruments)]
        mass = sum(body.mass for body, _, _ in fixed)
        centers = [place + axes @ np.array(body.center_of_mass) for body, place, axes in fixed]
        center = sum((body.mass * c for (body, _, _), c in zip(fixed, centers, strict=True)), np.zeros(3)) / mass
        tensor = np.zeros((3, 3))
        for (body, _, axes), c in zip(fixed, centers - center, strict=True):
            tensor += axes @ inertia_about_center(body) @ axes.T + body.mass * (c @ c * np.eye(3) - np.outer(c, c))
        self.craft.hub.mHub, self.craft.hub.r_BcB_B = mass, column(center)
        self.craft.hub.IHubPntBc_B = tensor.tolist()
        self.torques: list[Any] = []
        self.rotors: list[Any] = []
        for s in flywheels or stand.flywheels:
            rotor, torque = (
                spinningBodyOneDOFStateEffector.SpinningBodyOneDOFStateEffector(),
                messaging.ArrayMotorTorqueMsg(),
            )
            place, axes = pose(stand, s)
            rotor.nameOfThetaState, rotor.nameOfThetaDotState = f"phi {s.name}", f"phi_dot {s.name}"
            rotor.mass, rotor.k, rotor.c, rotor.sHat_S = s.mass, 0.0, 0.0, column((1.0, 0.0, 0.0))
            rotor.r_ScS_S, rotor.IPntSc_S = column(s.center_of_mass), inertia_about_center(s).tolist()
            rotor.r_SB_B, rotor.dcm_S0B = column(place), axes.T.tolist()
            rotor.motorTorqueInMsg.subscribeTo(torque)
            self.craft.addStateEffector(rotor)
            self.rotors, self.torques = [*self.rotors, rotor], [*self.torques, torque]
        self.integrator = svIntegrators.svIntegratorRKF78(self.craft)
        self.integrator.relTol = self.integrator.absTol = 1e-14
        self.craft.setIntegrator(self.integrator)
        for module in (*self.rotors, self.craft):
            module.Reset(0)

    def put(self, state: State) -> Array:
        """Set the state; returns C."""
        turn, put = attitude(self.stand, state), self.craft.dynManager.getStateObject
        C: Array = turn.as_matrix()
        put("hubPosition").setState(column(state.position))
        put("hubVelocity").setState(column(C @ np.array(state.V[:3])))
        put("hubSigma").setState(column(turn.as_mrp()))
        put("hubOmega").setState(column(state.V[3:]))
        for k, rotor in enumerate(self.rotors):
            put(rotor.nameOfThetaState).setState([[state.phi[k]]])
            put(rotor.nameOfThetaDotState).setState([[state.phi_dot[k]]])
            payload = self.messaging.ArrayMotorTorqueMsgPayload()
            payload.motorTorque = [state.tau[k]]
            self.torques[k].write(payload)
            rotor.UpdateState(0)  # it reads the torque
        return C

    def coupled(self, state: State) -> tuple[Array, Array]:
        """V_dot and phi_ddot."""
        C, get = self.put(state), self.craft.dynManager.getStateObject
        self.craft.equationsOfMotion(0.0, 1.0)
        moved, turned = (np.array(get(name).getStateDeriv()).ravel() for name in ("hubVelocity", "hubOmega"))
        phi_ddot = [get(rotor.nameOfThetaDotState).getStateDeriv()[0][0] for rotor in self.rotors]
        v, omega = np.split(np.array(state.V), 2)
        return np.concatenate([C.T @ moved - np.cross(omega, v), turned]), np.array(phi_ddot)

    def moved(self, state: State) -> Ends:
        """The end of a motion."""
        self.put(state)
        for clock in np.arange(1, 26) * round(
            SECONDS * 1e9 / 25
        ):  # in parts, which keep the attitude off its singularity
            self.craft.UpdateState(int(clock))
        names = ["hubPosition", "hubVelocity", "hubSigma", "hubOmega"]
        names += [rotor.nameOfThetaState for rotor in self.rotors] + [
            rotor.nameOfThetaDotState for rotor in self.rotors
        ]
        position, v, sigma, omega, *phases = (
            np.array(self.craft.dynManager.getStateObject(n).getState()).ravel() for n in names
        )
        turn, (phi, phi_dot) = Rotation.from_mrp(sigma), np.reshape(phases, (2, -1))
        return position, turn, np.concatenate([turn.inv().apply(v), omega]), phi, phi_dot


def column(numbers: Any) -> list[list[float]]:
    """A vector as Basilisk takes it."""
    return [[float(x)] for x in numbers]


def worst_acceleration(stand: Stand, program: BasiliskRotors) -> float:
    """Largest difference of V_dot and phi_ddot at ordinary states, relative to the largest element of each."""
    rng, off = np.random.default_rng(1), 0.0
    for _ in range(5):
        state = replace(random_state(stand, rng), wrench=MappingProxyType({}))
        ours = compiled(stand).evaluate(state, ("coupled",))
        for one, other in zip((ours["V_dot"], ours["phi_ddot"]), program.coupled(state), strict=True):
            off = max(off, float(np.abs(np.array(one) - other).max() / np.abs(other).max()))
    return off


STANDS = {
    "random": random_stand(np.random.default_rng(5), 3, replace(BARE, instruments=2)),
    **{name: replace(bare_stand(load(path(name))), gravity=(0.0, 0.0, 0.0)) for name in ("bench8", "sat4")},
}


@needs_basilisk
@pytest.mark.parametrize("name", quick(1, STANDS))
def test_rotors_of_basilisk_move_as_the_c_steps(name: str) -> None:
    """No flywheel is cut: two transverse moments, all products of inertia, any unbalance."""
    stand, state = STANDS[name], moderate(STANDS[name], 3)
    program = BasiliskRotors(stand)
    assert worst_acceleration(stand, program) < 1e-11
    assert difference(program.moved(state), stepped(stand, state)) < LIMIT


@needs_basilisk
@pytest.mark.parametrize("key", ["center_of_mass", "position", "inertia"])
def test_a_wrong_rotor_is_caught(key: str) -> None:
    """Basilisk gets one number of one rotor that is wrong in the seventh digit."""
    stand = STANDS["random"]
    *rest, last = stand.flywheels
    wrong = replace(last, **{key: (np.array(getattr(last, key)) * (1.0 + 1e-7)).tolist()})
    assert worst_acceleration(stand, BasiliskRotors(stand, (*rest, wrong))) > 1e-9
