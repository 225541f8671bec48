"""MuJoCo's actuators of flywheels: the largest torque of a drive."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mahovik.core.stand.units import show


def torque_limits(model: Any) -> tuple[dict[int, float], list[str]]:
    """Largest drive torque, N m, by number of the joint, and messages about actuators, one line each.

    A motor (force = gain times control) limits by its force range, its control range and the joint's own range,
    times the gear; every other actuator is a law of control, which a stand does not have.
    """
    import mujoco

    limits: dict[int, float] = {}
    notes = []
    for joint in range(model.njnt):
        if model.jnt_actfrclimited[joint]:
            limits[joint] = float(np.abs(model.jnt_actfrcrange[joint]).max())
    for i in range(model.nactuator):
        name = f"actuator {show(model.actuator(i).name or str(i))}"
        on_joint = model.actuator_trntype[i] in (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
        gear = abs(float(model.actuator_gear[i][0]))
        motor = (
            model.actuator_gaintype[i] == int(mujoco.mjtGain.mjGAIN_FIXED)
            and model.actuator_biastype[i] == int(mujoco.mjtBias.mjBIAS_NONE)
            and model.actuator_dyntype[i] == int(mujoco.mjtDyn.mjDYN_NONE)
        )
        if not (on_joint and motor):
            what = "a law of control" if on_joint else "not on a joint"
            notes.append(f"{name}: {what}, left out: drives of a stand take torques")
            continue
        if model.actuator_damping[i] or np.any(model.actuator_dampingpoly[i]):
            notes.append(f"{name}: its damping is left out: see motor.viscous")
        given = []
        if model.actuator_forcelimited[i]:
            given.append(float(np.abs(model.actuator_forcerange[i]).max()) * gear)
        if model.actuator_ctrllimited[i]:
            gain = abs(float(model.actuator_gainprm[i][0]))
            given.append(float(np.abs(model.actuator_ctrlrange[i]).max()) * gain * gear)
        joint = int(model.actuator_trnid[i][0])
        given += [limits[joint]] if joint in limits else []
        if given and math.isfinite(min(given)):
            limits[joint] = min(given)
    return limits, notes
