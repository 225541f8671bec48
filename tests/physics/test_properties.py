"""The invariants of model.md that one state can show, over random stands that shrink to a small stand file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Carrier, Instrument, MountingAngles, Stand, State
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.damping.law import Damping
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.algebra import Array
from mahovik.proof.reference.motion import flywheel_accelerations
from physics.general import isolated, placed, without_wrench
from physics.motions import vec
from physics.properties import PROPERTY, assert_near, balance, cases, of_a_motion, scale, value, with_inertia
from physics.redescribed import redescribed, redescribed_state, transfer

Map = Callable[[Array], Array]


@PROPERTY
@given(case=cases(held=True))
def test_power_is_the_rate_of_energy(case: tuple[Stand, State]) -> None:
    """tau^T phi' + sum P_k . V_k = dT/dt, body by body; what a hold exerts has no power."""
    stand, state = case
    stand = replace(stand, stream=None)
    state = of_a_motion(stand, state)
    at, V_dot = pieces(stand, state), np.array(state.V_dot)
    work = [t * w for t, w in zip(state.tau, state.phi_dot, strict=True)]
    work += [float(at.P[k.body.name] @ k.twist(at.V)) for k in placed(at)]
    laws = at.F - sum((k.L @ at.P[k.body.name] for k in placed(at)), np.zeros(6))
    work.append(float(laws @ at.V))  # suspension and legs
    rates = [float(at.V @ sum(p.Lambda for p in at.fixed) @ V_dot)]
    rates += [float(p.twist(at.V) @ p.Theta @ p.twist(V_dot)) for p in at.fixed]
    s = at.bodies.flywheels
    accelerations = flywheel_accelerations(s, at.V, V_dot, np.array(state.phi_ddot))
    rates += [float(V_s @ Theta @ a) for V_s, Theta, a in zip(s.twists(at.V), s.Theta, accelerations, strict=True)]
    size = max(map(abs, [*work, *rates])) + float(np.abs(at.F) @ np.abs(at.V))
    size += float(np.abs(scale(stand, state, "forward")["V_dot"]) @ np.abs(at.K) @ np.abs(at.V))
    assert_near(sum(rates), sum(work), size)
    carrier = at.F @ at.V + sum(s.phi_dot * at.P[s.body.name][3] for s in at.flywheels)
    assert_near(carrier + np.dot(state.tau, state.phi_dot), sum(work), size)


@PROPERTY
@given(case=cases(low=1), which=st.sampled_from(["carrier", "instruments", "flywheels"]), seed=st.integers(0, 2**16))
def test_equation_8_is_linear_in_the_ten_parameters_of_a_body(case: tuple[Stand, State], which: str, seed: int) -> None:
    """f(a + b) + f(0) = f(a) + f(b) for mass, first moment and inertia of one body; so for each of them alone."""
    stand, state = case
    rng = np.random.default_rng(seed)
    if not (which == "carrier" or getattr(stand, which)):
        which = "carrier"

    def stand_with(parameters: tuple[float, Array, Array]) -> Stand:
        if which == "carrier":
            return replace(stand, carrier=with_inertia(stand.carrier, *parameters))
        first, *rest = getattr(stand, which)
        changed: dict[str, Any] = {which: (with_inertia(first, *parameters), *rest)}
        return replace(stand, **changed)

    def terms(one: Stand) -> Array:
        """Size of the terms of (8)."""
        size = scale(one, state, "matrices")
        motion = {"K": state.V_dot, "M": state.V, "I": state.phi_ddot, "J": state.phi_dot}
        return np.asarray(size["F"] + sum(size[name] @ np.abs(np.array(value)) for name, value in motion.items()))

    def draw_parameters() -> tuple[float, Array, Array]:
        root = rng.normal(size=(3, 3))
        m, mu = float(rng.uniform(1, 2)), rng.normal(size=3)
        return m, mu, root @ root.T + (mu @ mu * np.eye(3) - np.outer(mu, mu)) / m  # moments that masses can have

    (m1, mu1, J1), (m2, mu2, J2) = draw_parameters(), draw_parameters()
    zero = (0.0, np.zeros(3), np.zeros((3, 3)))
    both, one, two, none = map(stand_with, ((m1 + m2, mu1 + mu2, J1 + J2), (m1, mu1, J1), (m2, mu2, J2), zero))
    size = terms(both) + terms(one) + terms(two)
    assert_near(balance(both, state) + balance(none, state), balance(one, state) + balance(two, state), size)
    # alone: only the first moment, only the inertia changes; a first moment needs a mass to be written
    bare, moved, turned = map(stand_with, ((m1, 0 * mu1, 0 * J1), (m1, mu1, 0 * J1), (m1, 0 * mu1, J1)))
    parts = balance(moved, state) + balance(turned, state) - balance(bare, state)
    assert_near(parts, balance(one, state), size)


@PROPERTY
@given(case=cases(low=1), factor=st.sampled_from([-1.0, 0.5, 4.0]))
def test_free_motion_is_quadratic_in_velocities(case: tuple[Stand, State], factor: float) -> None:
    stand, state = case
    stand, state = isolated(replace(stand, stream=None)), without_wrench(state)
    state = replace(state, phi_ddot=(0.0,) * len(stand.flywheels))
    faster = replace(state, V=vec(np.array(state.V) * factor), phi_dot=vec(np.array(state.phi_dot) * factor))
    slow, there = (value(stand, s, "forward", "V_dot") for s in (state, faster))
    assert_near(there / factor**2, slow, scale(stand, state, "forward")["V_dot"])


@PROPERTY
@given(case=cases(laws={"suspension": 0, "torquer": 0}), seed=st.integers(0, 2**16))
def test_origin_and_axes_are_a_matter_of_choice(case: tuple[Stand, State], seed: int) -> None:
    """Laws tied to origin or axes are excluded: a suspension, and quadratic damping of the carrier."""
    stand, state = case
    rng = np.random.default_rng(seed)
    d, R = rng.uniform(-0.3, 0.3, 3), Rotation.from_rotvec(rng.uniform(-1, 1, 3)).as_matrix()
    state = replace(state, wrench={"carrier": (0.0,) * 6, **state.wrench})
    plain = replace(stand, carrier=with_plain_fluid(stand.carrier))
    other, other_state = redescribed(plain, d, R), redescribed_state(plain, state, d, R)
    back, turn = transfer(d, R).T, np.kron(np.eye(2), R.T)

    def same(x: Array) -> Array:
        return x

    def assert_both(want: str, name: str, carried: Map = same, spread: Map = same) -> None:
        plain_value, there = value(plain, state, want, name), value(other, other_state, want, name)
        size = scale(plain, state, want)[name]
        assert_near(there, carried(plain_value), spread(size) + scale(other, other_state, want)[name])

    for want, name in (("torque", "tau"), ("mounts", "mount_wrench"), ("coupled", "phi_ddot"), ("momentum", "Z0")):
        assert_both(want, name)
    assert_both("momentum", "energy")
    for want in ("forward", "coupled"):
        assert_both(want, "V_dot", lambda x: back @ x, lambda x: np.abs(back) @ x)
    assert_both("momentum", "Z", lambda x: np.linalg.inv(back.T) @ x, lambda x: np.abs(turn) @ x * 2 + 2 * x.max())


def with_plain_fluid(carrier: Carrier) -> Carrier:
    """The stand without damping that is tied to axes; buoyancy and damping can be redescribed."""
    damping = carrier.law(Damping)
    buoyancy = carrier.law(Buoyancy) or Buoyancy(0.0, (0.0, 0.0, 0.0))
    return replace(carrier, laws=(buoyancy, Damping(damping.linear if damping else None, None, ())))


@PROPERTY
@given(case=cases(low=2, held=True))
def test_the_order_of_flywheels_is_a_matter_of_choice(case: tuple[Stand, State]) -> None:
    stand, state = case
    turned = replace(stand, flywheels=stand.flywheels[::-1])
    lists: dict[str, Any] = {name: getattr(state, name)[::-1] for name in ("phi", "phi_dot", "phi_ddot", "tau")}
    other = replace(state, **lists)
    size = scale(stand, state, "coupled")
    answer, there = evaluate(stand, state, ["coupled"]), evaluate(turned, other, ["coupled"])
    assert_near(there["V_dot"], answer["V_dot"], size["V_dot"])
    assert_near(there["phi_ddot"][::-1], answer["phi_ddot"], size["phi_ddot"])


@PROPERTY
@given(case=cases(low=1, held=True))
def test_a_locked_flywheel_is_a_rigid_body(case: tuple[Stand, State]) -> None:
    stand, state = case
    *rest, last = stand.flywheels
    last = replace(last, mount="carrier", mounting=MountingAngles(0.7, -0.3, 0.4))
    stand = replace(stand, flywheels=(*rest, last))
    N = len(rest)
    state = replace(state, phi_dot=(*state.phi_dot[:N], 0.0), phi_ddot=(*state.phi_ddot[:N], 0.0))
    fields = ("name", "mass", "center_of_mass", "inertia", "inertia_about", "laws", "wrench_input")
    same: dict[str, Any] = {name: getattr(last, name) for name in fields}
    angles = (0.7, -0.3, 0.4 + state.phi[-1])
    body = Instrument(**same, position=last.position, angles=angles, added_mass=None)
    rigid = replace(stand, instruments=(*stand.instruments, body), flywheels=tuple(rest))
    kept: dict[str, Any] = {name: getattr(state, name)[:N] for name in ("phi", "phi_dot", "phi_ddot", "tau")}
    for want, names in (("forward", ("V_dot",)), ("momentum", ("Z", "Z0", "energy", "center_of_mass"))):
        for name in names:
            actual = value(rigid, replace(state, **kept), want, name)
            assert_near(actual, value(stand, state, want, name), scale(stand, state, want)[name])


@PROPERTY
@given(case=cases())
def test_both_forms_give_one_acceleration(case: tuple[Stand, State]) -> None:
    """The accelerations of (8) and of (11) are equal."""
    stand, state = case
    state = replace(state, quaternion=None, angles=(0.3, 0.8, -1.1))
    answer, size = evaluate(stand, state, ["generalized"]), scale(stand, state, "generalized")
    V_dot = answer["A"] @ answer["q_ddot"] + answer["D"] @ answer["q_dot"]
    assert_near(V_dot, value(stand, state, "forward", "V_dot"), np.abs(answer["A"]) @ size["q_ddot"] + np.abs(V_dot))


@PROPERTY
@given(case=cases(low=1, high=9))
def test_inverse_returns_what_forward_was_given(case: tuple[Stand, State]) -> None:
    """(12) inverts (8) in V*; where I has full column rank, in phi'' as well."""
    stand, state = case
    asked = replace(state, V_dot=vec(value(stand, state, "forward", "V_dot")))
    answer = evaluate(stand, asked, ["inverse"])
    if answer["rank"] < min(6, len(state.phi)) or answer["sigma"][-1] < 1e-4 * answer["sigma"][0]:
        return  # near singular: no property of digits
    size = scale(stand, asked, "inverse")
    assert_near(answer["residual"], np.zeros(6), size["residual"])
    if len(state.phi) <= 6:
        back = np.abs(np.linalg.pinv(pieces(stand, asked).I)) @ np.abs(size["residual"])
        assert_near(answer["phi_ddot"], state.phi_ddot, size["phi_ddot"] + back, times=10)


@PROPERTY
@given(case=cases(low=6, high=9))
def test_forward_returns_what_inverse_was_asked_for(case: tuple[Stand, State]) -> None:
    """Six flywheels and more reach every V*."""
    stand, state = case
    answer, size = evaluate(stand, state, ["inverse"]), scale(stand, state, "inverse")
    if answer["rank"] < 6 or answer["sigma"][-1] < 1e-4 * answer["sigma"][0]:
        return  # near singular: no property of digits
    moved = replace(state, phi_ddot=vec(answer["phi_ddot"]))
    reached = np.abs(np.linalg.inv(pieces(stand, state).K)) @ size["residual"]
    assert_near(value(stand, moved, "forward", "V_dot"), state.V_dot, scale(stand, moved, "forward")["V_dot"] + reached)


@PROPERTY
@given(case=cases(low=1, held=True))
def test_coupled_form_returns_the_motion_of_its_torque(case: tuple[Stand, State]) -> None:
    stand, state = case
    state = of_a_motion(stand, state)
    answer, size = evaluate(stand, state, ["coupled"]), scale(stand, state, "coupled")
    assert_near(answer["V_dot"], state.V_dot, size["V_dot"])
    assert_near(answer["phi_ddot"], state.phi_ddot, size["phi_ddot"])
