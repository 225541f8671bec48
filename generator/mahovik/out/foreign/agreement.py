"""Comparison of an imported stand with the original file in Pinocchio or MuJoCo: relative differences of the dynamics.

Both are compared in the terms of docs/model.md; the originals use only the joint names of the stand.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.random import random_state
from mahovik.core.stand.state import State
from mahovik.out.foreign.merge import ImportedStand
from mahovik.out.foreign.mjcf import without_log
from mahovik.out.foreign.model import Array, Place
from mahovik.proof.reference import evaluate

_ZERO6: Vec6 = (0.0,) * 6

QUANTITIES = ("K", "I", "bias", "V_dot", "phi_ddot", "tau")
"""Mass matrix (6x6) and coupling (6xN) of the carrier, its bias (6), accelerations for given tau, tau for a motion."""


class Original(Protocol):
    """The original file in a program that reads it. `fixed_attitude` (3x3): that of a carrier that cannot move."""

    name: str
    fixed_attitude: Array | None

    def evaluate(self, C: Array, state: State) -> Mapping[str, Array]:
        """The available QUANTITIES at a state whose carrier has the attitude C (3x3)."""


LIMIT = 1e-9
"""Largest relative difference of the equations (K, I, bias, tau) that rounding can cause."""


def disagreement(errors: Mapping[str, float]) -> str:
    """Message: quantities of the equations that differ by more than LIMIT; "" if none does.

    Accelerations do not decide: the condition of the mass matrix amplifies their rounding.
    """
    wrong = [
        f"{name} by {errors[name]:.2g}" for name in ("K", "I", "bias", "tau") if not errors.get(name, 0.0) <= LIMIT
    ]
    return ", ".join(wrong)


def agreement(found: ImportedStand, original: Original, count: int = 20, seed: int = 1) -> dict[str, float]:
    """Largest difference of each quantity at random states, relative to the largest component of the original's.

    NaN where a component is NaN at one of them.
    """
    rng = np.random.default_rng(seed)
    worst: dict[str, float] = {}
    for _ in range(count):
        state = random_state(found.stand, rng)
        if original.fixed_attitude is not None:
            w, x, y, z = Rotation.from_matrix(original.fixed_attitude).as_quat(scalar_first=True).tolist()
            state = replace(state, angles=None, quaternion=(w, x, y, z), V=_ZERO6, V_dot=_ZERO6)
        ours = _reference_quantities(found.stand, state)
        theirs = original.evaluate(_attitude(state), state)
        for name, value in theirs.items():
            if value.size:
                scale = float(np.abs(value).max())
                error = float(np.abs(ours[name] - value).max()) / (scale or 1.0)
                worst[name] = float(np.maximum(worst.get(name, 0.0), error))  # NaN stays, as disagreement
    return worst


def _reference_quantities(stand: Stand, state: State) -> dict[str, Array]:
    """QUANTITIES of the stand, by the literal reference."""
    at = evaluate(stand, state, ("matrices", "coupled", "torque"))
    bias = at["M"] @ np.array(state.V) + at["J"] @ np.array(state.phi_dot) - at["F"]
    return {name: np.asarray(at[name]) for name in QUANTITIES if name != "bias"} | {"bias": bias}


def _attitude(state: State) -> Array:
    """Attitude C of the carrier."""
    if state.quaternion is not None:
        return np.asarray(Rotation.from_quat(state.quaternion, scalar_first=True).as_matrix())
    return np.asarray(Rotation.from_euler("ZYX", state.angles or (0.0, 0.0, 0.0)).as_matrix())


def twist_map(place: Place) -> Array:
    """The twist of a frame from that of a frame E1 that is fixed at `place` in it: V_there = T V (6x6)."""
    p, R = place.origin, place.axes
    cross = np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]])
    return np.block([[R, cross @ R], [np.zeros((3, 3)), R]])


def _quantities(full: Array, bias: Array, motion: Any, tau: Array) -> dict[str, Array]:
    """QUANTITIES from the mass matrix (6 + N square), bias and accelerations (6 + N) of carrier and flywheels."""
    found = full[:6, :6], full[:6, 6:], bias[:6], motion[:6], motion[6:], tau
    return dict(zip(QUANTITIES, found, strict=True))


class PinocchioOriginal:
    """A URDF in Pinocchio, with a free root, or the body that floats on it. ImportError without Pinocchio."""

    fixed_attitude: Array | None

    def __init__(self, path: Path, found: ImportedStand, floats: bool) -> None:
        import pinocchio as pin

        self.name = f"Pinocchio {pin.__version__}"
        self.fixed_attitude = None
        self._pin = pin
        self._model = (
            pin.buildModelFromUrdf(str(path))
            if floats
            else pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())
        )
        self._model.gravity.linear = np.array(found.stand.gravity)
        self._data = self._model.createData()
        joints = [self._model.joints[self._model.getJointId(name)] for name in found.joints]
        self._q = [joint.idx_q for joint in joints]
        self._v = np.array([*range(6), *(joint.idx_v for joint in joints)])
        self._T = np.eye(self._model.nv)
        self._T[:6, :6] = twist_map(found.place)
        self._turned = found.place.axes.T

    def evaluate(self, C: Array, state: State) -> Mapping[str, Array]:
        """See Original."""
        pin, model, data, order, T = self._pin, self._model, self._data, self._v, self._T
        q = np.zeros(model.nq)
        q[3:7] = Rotation.from_matrix(C @ self._turned).as_quat()
        for at, phi in zip(self._q, state.phi, strict=True):
            q[at : at + 2] = np.cos(phi), np.sin(phi)  # a joint without end has both

        def there(motion: Array) -> Array:
            full = np.zeros(model.nv)
            full[order] = T @ motion
            return full

        def here(forces: Array) -> Array:
            return np.asarray(T.T @ forces[order])

        v = there(np.array([*state.V, *state.phi_dot]))
        full = np.triu(pin.crba(model, data, q))
        full = full + np.triu(full, 1).T
        full = T.T @ full[np.ix_(order, order)] @ T
        bias = here(pin.rnea(model, data, q, v, np.zeros(model.nv)))
        given = here(pin.rnea(model, data, q, v, there(np.array([*state.V_dot, *state.phi_ddot]))))
        tau = np.zeros(model.nv)
        tau[order[6:]] = state.tau
        moved = np.linalg.solve(T, pin.aba(model, data, q, v, tau)[order])
        return _quantities(full, bias, moved, given[6:])


class MujocoOriginal:
    """An MJCF file in MuJoCo, without contacts, friction, limits and laws of control.

    For a fixed base it has only tau, of flywheels that turn on a carrier at rest.
    `model`: the file as compiled by MuJoCo.
    """

    fixed_attitude: Array | None

    def __init__(self, model: Any, found: ImportedStand, free: bool) -> None:
        import mujoco

        self.name = f"MuJoCo {mujoco.__version__}"
        self._mj = mujoco
        self._model = model
        off = mujoco.mjtDisableBit
        model.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_CONSTRAINT | off.mjDSBL_ACTUATION
        model.dof_damping[:] = 0.0
        model.dof_frictionloss[:] = 0.0
        self._data = mujoco.MjData(model)
        self._free = free
        self._q = model.jnt_qposadr[list(found.numbers)]
        self._v = np.array([*range(6 * free), *model.jnt_dofadr[list(found.numbers)]], dtype=int)
        self._T = twist_map(found.place)
        self._turned = found.place.axes.T
        self.fixed_attitude = None
        if not free:
            mujoco.mj_kinematics(model, self._data)
            root = model.body_rootid[model.jnt_bodyid[found.numbers[0]]] if found.numbers else 1
            self.fixed_attitude = self._data.xmat[root].reshape(3, 3) @ found.place.axes

    def evaluate(self, C: Array, state: State) -> Mapping[str, Array]:
        """See Original. A free joint has v in E0 and its derivative: v' = C (v* + omega x v)."""
        mj, model, data, order = self._mj, self._model, self._data, self._v
        data.qpos[:] = model.qpos0
        data.qpos[self._q] = state.phi
        n = len(state.phi)
        base = 6 * self._free
        turn = np.eye(base + n)
        turning = np.zeros(base + n)
        V, V_dot = (self._T @ np.array(each) for each in (state.V, state.V_dot))
        if self._free:
            root = C @ self._turned
            data.qpos[3:7] = Rotation.from_matrix(root).as_quat(scalar_first=True)
            turn[:3, :3] = root
            turning[:3] = root @ np.cross(V[3:], V[:3])
        data.qvel[order] = turn @ np.concatenate([V[:base], state.phi_dot])
        data.qfrc_applied[:] = 0.0
        data.qfrc_applied[order] = [*[0.0] * base, *state.tau]
        with without_log():
            mj.mj_forward(model, data)
        given = np.concatenate([V_dot[:base], state.phi_ddot])
        accelerations = np.linalg.solve(turn, data.qacc[order] - turning)
        full = np.zeros((model.nv, model.nv))
        mj.mj_fullM(model, data, full)
        full = full[np.ix_(order, order)]
        bias = turn.T @ (full @ turning + data.qfrc_bias[order])
        full = turn.T @ full @ turn
        tau = (full @ given + bias)[base:]
        if not self._free:
            return {"tau": tau}
        T = np.eye(6 + n)
        T[:6, :6] = self._T
        full, bias, moved = T.T @ full @ T, T.T @ bias, np.linalg.solve(T, accelerations)
        return _quantities(full, bias, moved, tau)
