"""Equations (1)-(13): what each says, who derives it, and which program functions have it.

The derivations are named by the objects themselves: what is not there cannot be imported.
"""

from __future__ import annotations

import inspect
import re
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from mahovik.core.derive import accumulate, attitude, carrier, drive, flywheel, motion, point, sensitivity, wrench
from mahovik.core.derive.document import generalized as document
from mahovik.core.program.function import Function
from mahovik.laws.leg import derive as leg
from mahovik.laws.suspension import derive as suspension
from mahovik.laws.weight import derive as weight
from mahovik.proof.reference import (
    coupled,
    forward,
    generalized,
    inverse,
    mass,
    momentum,
    partition,
    points,
    screw,
    torque,
    wrenches,
)
from mahovik.proof.reference import rotation as reference_rotation
from mahovik.proof.second import problems
from mahovik.proof.second import system as second_system

ROOT = Path(__file__).resolve().parents[2]

EQUATIONS = {
    "(1)": "momentum in E0: Z0 = L1 Z",
    "(2)": "momentum in E1 and mass matrix: Z = K V + sum I phi'",
    "(4)": "rate of momentum: Z* + Phi Z = F",
    "(5)": "Z* by K V*, K* V, phi'' and phi'^2",
    "(6)": "rate of the mass matrix, K*",
    "(7)": "external wrench of all bodies, F",
    "(8)": "equation of motion: K V* + M V + sum(I phi'' + J phi') = F",
    "(9)": "M, I, J",
    "(10)": "generalized coordinates: V = A q', V* = A q'' + D q'",
    "(11)": "the equation of motion in them: I0, J0",
    "(12)": "inverse problem: I phi'' = P - J phi'",
    "(13)": "flywheels in two parts, for optimal control",
}
"""The model has no (3)."""

OTHERS = {
    "drive torque": "tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s)",
    "whole system": "V* and phi'' together, for given drive torques",
    "motion in time": "steps of Runge and Kutta",
    "points": "what instruments and points measure",
}
"""Sections of the model whose equations have no number."""

DERIVED: dict[str, tuple[Any, ...]] = {
    "(1)": (carrier.momentum_in_E0,),
    "(2)": (
        flywheel.literal,
        flywheel.spun_inertia,
        flywheel.shifted_inertia,
        accumulate.sums,
        carrier.mass_matrix,
        carrier.momentum,
    ),
    "(4)": (carrier.remainder,),
    "(5)": (accumulate.sums, carrier.remainder),
    "(6)": (flywheel.literal, accumulate.weights, carrier.mass_matrix_rate),
    "(7)": (weight.weight, wrench.moment_of_force, suspension.relative_quaternion, leg.leg),
    "(8)": (carrier.remainder, carrier.reduced_inertia, carrier.reduced_moment, carrier.linear_part, sensitivity),
    "(9)": (flywheel.literal, flywheel.spin_momentum, accumulate.columns, carrier.velocity_column),
    "(10)": (attitude.attitude, attitude.kinematics, motion),
    "(11)": (document,),
    "(12)": (),
    "(13)": (),
    "drive torque": (drive.literal_torque, drive.bias_torque),
    "whole system": (drive,),
    "motion in time": (),
    "points": (point,),
}
"""In `derive`. (12) is (8) with other unknowns, and (13) is not emitted: the reference alone has it."""

REFERENCE: dict[str, tuple[Any, ...]] = {
    "(1)": (momentum,),
    "(2)": (mass, momentum),
    "(4)": (torque,),
    "(5)": (screw, forward),
    "(6)": (mass,),
    "(7)": (wrenches,),
    "(8)": (forward,),
    "(9)": (mass,),
    "(10)": (reference_rotation, generalized),
    "(11)": (generalized,),
    "(12)": (inverse,),
    "(13)": (partition,),
    "drive torque": (torque,),
    "whole system": (coupled,),
    "motion in time": (),
    "points": (points,),
}

SECOND: dict[str, tuple[Any, ...]] = {
    "(1)": (problems,), "(2)": (problems, second_system), "(4)": (second_system,), "(5)": (second_system,),
    "(6)": (second_system,), "(7)": (second_system,), "(8)": (problems,), "(9)": (second_system,),
}  # fmt: skip

ROLES: dict[str, tuple[str, ...]] = {
    "drive torque": ("torque", "balance", "carry_twist", "mount_wrench", "mounts", "prepare_mounts"),
    "whole system": ("coupled", "solve_coupled", "eliminate", "factor_schur", "solve_schur", "coupled_jacobian"),
    "motion in time": (
        *("advance", "finish", "rate", "stages", "step", "rate_driven", "stages_driven", "step_driven"),
        *("advance_carried", "finish_carried", "step_carried", "step_driven_carried"),
    ),
    "points": ("sense", "points", "place_point"),
    "mass centre": ("center_of_mass_velocity",),
    "rotations and placement": (
        "rotation", "rotate_back", "rotation_vector", "quaternion", "frame_of_axes", "place_flywheel", "stream_at",
    ),
    "phases and encoders": ("wrap", "phase_of_counts", "speed_of_counts", "accumulate"),
    "own mathematics": (
        "sincos", "sincos_each", "sqrt", "atan2", "exp", "unwound", "wrapped", "orthogonalise", "orthogonalise_*",
    ),
    "tasks": ("scale_turning", "project_*", "inverse_*", "torque_demand*", "torque_for_*"),
    "linear algebra": (
        "factor3", "solve3", "factor", "solve_gram", "solve_gram_*", "bounded_least_squares_*", "largest_share_*",
    ),
    "checks of inputs": (
        "within", "check_state", "check_motion", "check_inertia", "check_body", "check_dry_body", "check_added_mass",
        "check_parameters", "check_depth", "excessive", "motor_lacks",
    ),
}  # fmt: skip
"""Purposes of functions without an equation of the paper; `*`: any name of a task, or number of rows."""


def subjects(function: Function) -> list[str]:
    """Equations of a function; of one without, the section of the model or the purpose that ROLES gives it.

    Raises LookupError for a function that has neither.
    """
    found = numbers(function.equation)
    if not found:
        found = [role for role, names in ROLES.items() if any(fnmatchcase(function.name, name) for name in names)]
    if not found:
        raise LookupError(f"{function.name}: names no equation, and ROLES does not say what it is for")
    return found


def numbers(text: str) -> list[str]:
    """Equation numbers of `(2), (6)-(9)`."""
    found: list[str] = []
    for first, last in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", text):
        found += [f"({n})" for n in range(int(first), int(last or first) + 1)]
    return found


def called(thing: Any) -> str:
    """`core/derive/carrier.py momentum` of a function or module of the package."""
    module = thing if inspect.ismodule(thing) else inspect.getmodule(thing)
    assert module is not None
    path = module.__name__.removeprefix("mahovik.").replace(".", "/")
    return f"`{path}.py`" + ("" if inspect.ismodule(thing) else f" `{thing.__name__}`")
