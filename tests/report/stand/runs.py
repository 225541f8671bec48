"""Runs and material for tests of the report, made by the literal reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import State, rest_state
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.run import Run
from mahovik.proof import reference


def example(name: str) -> Stand:
    return load(stands.path(name))


def material(stand: Stand, run: Run | None = None) -> Material:
    return Material(stand, rest_state(stand), "rest", f"{stand.name}.toml", run)


def run_of(stand: Stand, columns: dict[str, np.ndarray]) -> Run:
    return Run("run.csv", tuple(s.name for s in stand.flywheels), columns)


def right_states(stand: Stand, count: int) -> list[State]:
    """Random states with V* by (8) and drive torques, by the reference."""
    rng, found = np.random.default_rng(5), []
    for _ in range(count):
        state = replace(random_state(stand, rng, phase_limit=50.0), angles=None, wrench={})
        q = np.array(state.quaternion or rng.normal(size=4))
        state = replace(state, quaternion=tuple((q / np.linalg.norm(q)).tolist()))
        V_dot = reference.evaluate(stand, state, ["forward"])["V_dot"]
        state = replace(state, V_dot=tuple(V_dot.tolist()))
        tau = reference.evaluate(stand, state, ["torque"])["tau"]
        found.append(replace(state, tau=tuple(tau.tolist())))
    return found


def run_through(stand: Stand, states: Sequence[State]) -> Run:
    """A run whose rows are these states."""
    columns = {"t [s]": 0.01 * np.arange(len(states))}

    def add(names: Sequence[str], values: np.ndarray) -> None:
        columns.update({name: values[:, i] for i, name in enumerate(names)})

    add([f"{a} [m]" for a in "xyz"], np.array([s.position for s in states]))
    add(["qw", "qx", "qy", "qz"], np.array([s.quaternion for s in states]))
    add([*(f"v_{a} [m/s]" for a in "xyz"), *(f"omega_{a} [rad/s]" for a in "xyz")], np.array([s.V for s in states]))
    rates = [*(f"v_dot_{a} [m/s2]" for a in "xyz"), *(f"omega_dot_{a} [rad/s2]" for a in "xyz")]
    add(rates, np.array([s.V_dot for s in states]))
    for kind, unit in (("phi", "rad"), ("phi_dot", "rad/s"), ("phi_ddot", "rad/s2"), ("tau", "N m")):
        names = [f"{kind} {s.name} [{unit}]" for s in stand.flywheels]
        add(names, np.array([getattr(s, kind) for s in states]).reshape(len(states), len(names)))
    return run_of(stand, columns)
