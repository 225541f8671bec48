"""Modes whose formulas are known, and linear models of held carriers against differences of the literal reference."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cli.test_eval_held import TEXT
from mahovik.core.stand import load, loads
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Hold, MountingAxes, Stand
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import CheckError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.hold import accelerations
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.stands import path
from mahovik.use.simulate.held import home, move, rates
from mahovik.use.study.linear import linear_model, modes
from mahovik.use.study.rest import rest
from verify.holds import HOLDS

SPRUNG = """
schema = 1
name = "sprung"
[carrier]
mass = 2.0
inertia = [0.5, 0.3, 0.2]
[suspension]
stiffness = [800, 450, 200, 32, 12, 7.2]
damping = [8, 0, 100, 0.8, 0, 0]
"""


def test_a_mass_on_springs() -> None:
    """Every direction for itself: frequency sqrt(k/m), ratio c / 2 sqrt(k m); one is overdamped."""
    stand = loads(SPRUNG)
    found = modes(linear_model(stand, rest_state(stand)))
    k, m = np.array([800, 450, 200, 32, 12, 7.2]), np.array([2, 2, 2, 0.5, 0.3, 0.2])
    c = np.array([8, 0, 100, 0.8, 0, 0])
    swinging = [mode for mode in found.modes if mode.kind == "oscillation"]
    expected = sorted((np.sqrt(k[i] / m[i]) / 2 / np.pi, c[i] / 2 / np.sqrt(k[i] * m[i])) for i in (0, 1, 3, 4, 5))
    assert np.allclose(sorted((mode.frequency, mode.damping) for mode in swinging), expected, rtol=1e-12, atol=1e-12)
    decays = sorted(mode.eigenvalue.real for mode in found.modes if mode.kind == "decay")
    assert np.allclose(decays, np.sort(np.roots([2, 100, 200])), rtol=1e-12)
    assert found.zeros == 0
    assert not found.unstable
    assert [str(x) for x in found.coordinates][:2] == ["x [m]", "y [m]"]


def test_a_floating_stand_is_free_in_all_directions() -> None:
    stand = load(path("sat4"))
    found = modes(linear_model(stand, rest_state(stand), locked=True))
    assert [mode.kind for mode in found.modes] == ["free"] * 6
    assert found.zeros == 12
    assert np.array_equal([mode.shape.real for mode in found.modes], np.eye(6))
    assert len(modes(linear_model(stand, rest_state(stand))).modes) == 10


def test_a_spinning_flywheel_makes_it_nod() -> None:
    """Nutation of a gyrostat about its principal axes: H / sqrt(J2 J3), H of a flywheel along the first."""
    stand = load(path("sat4"))
    wheel = replace(stand.flywheels[0], position=(0.0, 0.0, 0.0))
    wheel = replace(wheel, mounting=MountingAxes((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    wheel = replace(
        wheel,
        mass=0.0,
        center_of_mass=(0.0, 0.0, 0.0),
        inertia=((0.02, 0, 0), (0, 1e-9, 0), (0, 0, 1e-9)),
        inertia_about="origin",
    )
    body = replace(stand.carrier, center_of_mass=(0.0,) * 3, inertia=((2.0, 0, 0), (0, 3.0, 0), (0, 0, 4.0)))
    plain = replace(stand, carrier=body, flywheels=(wheel,))
    state = replace(rest_state(plain), phi_dot=(600.0,))
    found = modes(linear_model(plain, state, locked=True))
    (nod,) = [mode for mode in found.modes if mode.kind == "oscillation"]
    assert nod.frequency == pytest.approx(0.02 * 600 / np.sqrt(12) / 2 / np.pi, rel=1e-8)
    assert nod.damping == 0.0


def test_free_flywheels_hang_like_pendulums() -> None:
    """shaker2: unbalance that hangs swings by sqrt(m g c / J), unbalance that stands falls; locked, neither."""
    stand = load(path("shaker2"))
    J = 0.0009 + 0.5 * 0.004**2
    expected = np.sqrt(0.5 * 9.81 * 0.004 / J) / 2 / np.pi
    for quarter, unstable in ((3, False), (1, True)):
        state = rest(stand, [quarter * np.pi / 2] * 2).state
        found = modes(linear_model(stand, state))
        assert found.unstable == unstable
        assert found.modes[0].frequency == pytest.approx(expected, rel=1e-3)  # the carrier gives way a little
        assert found.modes[0].kind == ("growth" if unstable else "oscillation")
        assert not modes(linear_model(stand, state, locked=True)).unstable


WEIGHT, ARM, INERTIA, SPIN = 2.5 * 9.81, 0.2, 0.02 + 2.5 * 0.2**2, 1e-3
"""N, m; about the pivot without and about its axis of the flywheel, kg m2."""


@pytest.mark.parametrize(("locked", "inertia"), [(True, INERTIA + SPIN), (False, INERTIA)])
def test_a_hanging_pendulum_has_the_frequency_of_the_formula(locked: bool, inertia: float) -> None:
    """sqrt(m g l / J) / 2 pi: a free flywheel about the same axis does not turn with the pendulum."""
    stand = loads(TEXT)
    found = modes(linear_model(stand, rest(stand).state, [], locked=locked))
    (swing,) = [mode for mode in found.modes if mode.kind == "oscillation"]
    assert swing.frequency == pytest.approx(math.sqrt(WEIGHT * ARM / inertia) / (2 * math.pi), rel=1e-12)
    assert [channel.name for channel in found.coordinates] == ["q_pitch", *([] if locked else ["phi w1"])]
    assert not found.unstable


def test_upright_it_falls_at_the_rate_of_the_formula() -> None:
    stand = loads(TEXT)
    found = modes(linear_model(stand, home(stand), [], locked=True))
    assert found.unstable
    falls = max(mode.eigenvalue.real for mode in found.modes)
    assert falls == pytest.approx(math.sqrt(WEIGHT * ARM / (INERTIA + SPIN)), rel=1e-12)


def test_a_mass_on_a_rail_with_a_spring() -> None:
    text = TEXT.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', "slide = [0, 3, 4]")
    stand = loads(text + "[suspension]\nstiffness = [1e6, 500, 500, 1e6, 1e6, 1e6]\ndamping = [0, 3, 3, 0, 0, 0]\n")
    model = linear_model(stand, rest(stand).state, [], locked=True)
    assert [str(each) for each in model.states] == ["q_1 [m]", "u_1 [m/s]"]
    assert pytest.approx(np.array([[0, 1], [-500 / 2.5, -3 / 2.5]]), abs=1e-9) == model.A
    push = dict(zip((each.name for each in model.inputs), model.B[1], strict=True))
    assert push["wrench Y"] == pytest.approx(0.6 / 2.5) and push["wrench Z"] == pytest.approx(0.8 / 2.5)


def slow_top() -> tuple[Stand, State]:
    """A ball joint off O1 with weight and three unbalanced flywheels, moving."""
    stand = random_stand(np.random.default_rng(2), 3, replace(BARE, gravity=True))
    stand = replace(stand, hold=Hold(HOLDS["ball joint"], (0.1, -0.2, 0.15), (0.0,) * 3, (0.0,) * 3))
    u = (0.4, -0.7, 0.5)
    assert stand.hold is not None
    state = move(home(stand), np.eye(3), np.array(twist_of(stand.hold, (0.3, 0.2, -0.5))))
    state = replace(state, u=u, V=twist_of(stand.hold, u))
    return stand, replace(state, phi=(0.3, 1.0, -2.0), phi_dot=(20.0, -30.0, 15.0))


def rate(stand: Stand, state: State, tau: Array) -> Array:
    """u* (m) and phi'' (N) by the literal reference."""
    assert stand.hold is not None
    none = np.zeros(len(tau), dtype=bool)
    V_dot, phi_ddot = accelerations(reference.pieces(stand, state), stand, tau, none)
    return np.concatenate([rates(stand.hold, V_dot), phi_ddot])


def test_the_derivatives_are_those_of_the_reference() -> None:
    stand, state = slow_top()
    model = linear_model(stand, state, [])
    hold = stand.hold
    assert hold is not None
    tau, C = np.array(model.state.tau), carrier_rotation(stand, state)
    m, N, h = 3, 3, 1e-5

    def rates_at(x: Array) -> Array:
        q, u, phi, phi_dot = np.split(x, [m, 2 * m, 2 * m + N])
        displaced = move(state, C, np.array(twist_of(hold, q.tolist())))
        total = np.array(state.u) + u
        displaced = replace(
            displaced,
            V=twist_of(hold, total.tolist()),
            u=tuple(total.tolist()),
            phi=tuple((np.array(state.phi) + phi).tolist()),
            phi_dot=tuple((np.array(state.phi_dot) + phi_dot).tolist()),
        )
        return rate(stand, displaced, tau)

    columns = [(rates_at(h * e) - rates_at(-h * e)) / (2 * h) for e in np.eye(2 * m + 2 * N)]
    rows = [*range(m, 2 * m), *range(2 * m + N, 2 * m + 2 * N)]
    size = np.abs(model.A[rows]).max()
    assert np.abs(np.column_stack(columns) - model.A[rows]).max() < 1e-7 * size
    assert rates_at(np.zeros(2 * m + 2 * N))[m:] == pytest.approx(np.zeros(N), abs=1e-9)  # phi'' of the state
    driven = np.column_stack([rate(stand, state, tau + e) - rate(stand, state, tau) for e in np.eye(N)])
    assert np.abs(driven - model.B[rows, :N]).max() < 1e-9 * np.abs(driven).max()
    u, v, w = state.u
    turning = np.array([[0, -w, v], [w, 0, -u], [-v, u, 0]])
    assert model.A[:m, :m] == pytest.approx(-turning, abs=1e-12)  # as the axes turn
    assert model.A[:m, m : 2 * m] == pytest.approx(np.eye(m), abs=1e-12)


def test_flywheels_of_a_clamped_carrier_turn_alone() -> None:
    stand = loads(TEXT.replace('["pitch"]\npivot = [0, 0, -0.2]', "[]"))
    found = linear_model(stand, home(stand), [])
    assert pytest.approx(np.array([[0, 1], [0, 0]])) == found.A and found.B[1, 0] == pytest.approx(1 / SPIN)
    assert [str(each) for each in found.states] == ["phi w1 [rad]", "phi_dot w1 [rad/s]"]
    (mode,) = modes(found).modes
    assert [each.name for each in modes(found).coordinates] == ["phi w1"] and abs(mode.shape[0]) == 1
    with pytest.raises(CheckError, match="the flywheels are locked, as `modes` has them by default; give"):
        linear_model(stand, home(stand), [], locked=True)
    knife_edge = loads(TEXT.replace('["pitch"]', '["x", "yaw"]'))
    with pytest.raises(CheckError, match="not a closed set"):
        linear_model(knife_edge, home(knife_edge), [])


def test_friction_and_a_stop_are_in_the_linear_model() -> None:
    """At rest the smoothed sign has the slope breakaway / smoothing; a stop that carries the weight is a spring."""
    hold = "slide = [1, 0, 0]\n[[hold.friction]]\nviscous = 3\ncoulomb = 0.1\nbreakaway = 0.2\nstribeck_speed = 1\n"
    stop = "smoothing = 0.1\n[[hold.stop]]\nat = 0.01\nstiffness = 500\ndamping = 100\n"
    text = TEXT.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', hold + stop)
    stand = replace(loads(text), gravity=(2.0, 0.0, 0.0))
    found = rest(stand).state
    depth = 2.5 * 2.0 / 500
    assert found.position[0] == pytest.approx(0.01 + depth, rel=1e-9)
    model = linear_model(stand, found, [], locked=True)
    drag = 3 + 0.2 / 0.1 + 100 * depth
    assert pytest.approx(np.array([[0, 1], [-500 / 2.5, -drag / 2.5]]), abs=1e-6) == model.A
