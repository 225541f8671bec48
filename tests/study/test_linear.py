"""Linear models against the second derivation and differences of the reference; modes whose formulas are known."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import mahovik
from mahovik.core.stand import load, loads
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Hold, MountingAxes, Stand, State, rest_state
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array, carrier_rotation
from mahovik.proof.reference.motion import coupled
from mahovik.proof.verify.states import state_object
from mahovik.stands import path
from mahovik.use.simulate.held import home, move, rates
from mahovik.use.study.linear import LinearModel, linear_model, modes
from mahovik.use.study.rest import rest
from study.energy_linear import Matrices, linear
from verify.holds import HOLDS, PENDULUM

AGREEMENT = 1e-10
"""Relative to the largest number of a row; the largest of a hundred stands is 6e-12, where rows nearly cancel."""


def disagreement(model: LinearModel, expected: Matrices) -> float:
    """Largest difference of A, B, C and D, each row relative to its largest number."""
    worst = 0.0
    for name in "ABCD":
        a, b = getattr(model, name), getattr(expected, name)
        assert a.shape == b.shape
        if b.size:
            size = np.abs(b).max(axis=1, keepdims=True)
            worst = max(worst, float((np.abs(a - b) / np.where(size > 0, size, 1.0)).max()))
    return worst


def random_case(seed: int, flywheels: int, **kinds: Any) -> tuple[Stand, State]:
    """A random stand with all that is named, and a state of it."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, Features(**kinds))
    return stand, random_state(stand, rng)


EVERY_WRENCH = {"laws": {"suspension": 1, "leg": 2}, "fluid": True, "stream": True, "gravity": True}


@pytest.mark.parametrize(
    ("seed", "kinds"),
    [(1, {"points": 2, "wrench_inputs": True, **EVERY_WRENCH}), (2, {"instruments": 2, **EVERY_WRENCH})],
)
def test_it_is_the_derivative_of_the_second_derivation(seed: int, kinds: dict[str, Any]) -> None:
    stand, state = random_case(seed, 3, **kinds)
    assert disagreement(linear_model(stand, state), linear(stand, state)) < AGREEMENT


@pytest.mark.parametrize("name", ["shaker2", "sat4", "auv6"])
def test_at_rest_and_with_flywheels_turning_steadily(name: str) -> None:
    stand = load(path(name))
    state = replace(rest(stand).state, phi_dot=(100.0,) * len(stand.flywheels))
    assert disagreement(linear_model(stand, state), linear(stand, state)) < AGREEMENT


def test_locked_flywheels_are_one_with_the_carrier() -> None:
    """The second derivation answers as the drives do: tau keeps phi'' whatever the carrier does."""
    stand, state = random_case(5, 2, laws={"suspension": 1}, points=1)
    free, locked = linear_model(stand, state), linear_model(stand, state, locked=True)
    N = len(stand.flywheels)
    keep = np.linalg.solve(free.B[12 + N :, :N], free.A[12 + N :, :12])  # phi'' = 0 = A x + B tau
    assert np.allclose(locked.A, free.A[:12, :12] - free.B[:12, :N] @ keep, rtol=0, atol=1e-9 * np.abs(free.A).max())
    assert locked.A.shape == (12, 12)
    assert [str(x) for x in locked.inputs] == [f"wrench {x} [{'N' if x in 'XYZ' else 'N m'}]" for x in "XYZKMN"]


def test_points_are_those_named_in_that_order() -> None:
    stand = load(path("sat4"))
    assert linear_model(stand, rest_state(stand)).points == ("acc1",)
    assert linear_model(stand, rest_state(stand), ["carrier", "acc1"]).points == ("carrier", "acc1")
    assert linear_model(stand, rest_state(stand), []).C.shape == (0, 20)
    with pytest.raises(UsageError, match='at acc2: unknown, did you mean "acc1"'):
        linear_model(stand, rest_state(stand), ["acc2"])
    with pytest.raises(UsageError, match="given twice"):
        linear_model(stand, rest_state(stand), ["acc1", "acc1"])
    with pytest.raises(StateError, match="not finite"):
        linear_model(stand, replace(rest_state(stand), V=(1e200, 0, 0, 0, 0, 1e200)))


@pytest.mark.parametrize("flywheels", ["free", "locked"])
def test_files_read_back_to_the_same_bits(flywheels: Literal["free", "locked"], tmp_path: Path) -> None:
    stand, state = random_case(7, 2, points=2, wrench_inputs=True)
    model = linear_model(stand, state, locked=flywheels == "locked")
    start = {key: value for key, value in state_object(state).items() if key not in ("V_dot", "tau")}
    result = mahovik.modes(stand, start=start, flywheels=flywheels)
    result.save(tmp_path / "model.json")
    text = json.loads((tmp_path / "model.json").read_text())
    for name in "ABCD":
        matrix = getattr(model, name)
        assert np.array_equal(np.array(text[name]).reshape(matrix.shape), matrix)
    for name in ("states", "inputs", "outputs"):
        for key, attribute in ((name, "name"), (f"{name[:-1]}_units", "unit")):
            names = [getattr(axis, attribute) for axis in getattr(model, name)]
            assert text[key] == names
    assert text["flywheels"] == flywheels


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
    """Each direction has frequency sqrt(k/m) and ratio c / 2 sqrt(k m); one is overdamped."""
    stand = loads(SPRUNG)
    result = modes(linear_model(stand, rest_state(stand)))
    k, m = np.array([800, 450, 200, 32, 12, 7.2]), np.array([2, 2, 2, 0.5, 0.3, 0.2])
    c = np.array([8, 0, 100, 0.8, 0, 0])
    swinging = [mode for mode in result.modes if mode.kind == "oscillation"]
    expected = sorted((np.sqrt(k[i] / m[i]) / 2 / np.pi, c[i] / 2 / np.sqrt(k[i] * m[i])) for i in (0, 1, 3, 4, 5))
    assert np.allclose(sorted((mode.frequency, mode.damping) for mode in swinging), expected, rtol=1e-12, atol=1e-12)
    decays = sorted(mode.eigenvalue.real for mode in result.modes if mode.kind == "decay")
    assert np.allclose(decays, np.sort(np.roots([2, 100, 200])), rtol=1e-12)
    assert result.zeros == 0
    assert not result.unstable
    assert [str(x) for x in result.coordinates][:2] == ["x [m]", "y [m]"]


def test_a_floating_stand_is_free_in_all_directions() -> None:
    stand = load(path("sat4"))
    result = modes(linear_model(stand, rest_state(stand), locked=True))
    assert [mode.kind for mode in result.modes] == ["free"] * 6
    assert result.zeros == 12
    assert np.array_equal([mode.shape.real for mode in result.modes], np.eye(6))
    assert len(modes(linear_model(stand, rest_state(stand))).modes) == 10


def test_a_spinning_flywheel_makes_it_nod() -> None:
    """The nutation of a gyrostat about its principal axes is H / sqrt(J2 J3), H of a flywheel along the first."""
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
    result = modes(linear_model(plain, state, locked=True))
    (nod,) = [mode for mode in result.modes if mode.kind == "oscillation"]
    assert nod.frequency == pytest.approx(0.02 * 600 / np.sqrt(12) / 2 / np.pi, rel=1e-8)
    assert nod.damping == 0.0


WEIGHT, ARM, INERTIA, SPIN = 2.5 * 9.81, 0.2, 0.02 + 2.5 * 0.2**2, 1e-3
"""N, m; about the pivot without and about its axis of the flywheel, kg m2."""


@pytest.mark.parametrize(("locked", "inertia"), [(True, INERTIA + SPIN), (False, INERTIA)])
def test_a_hanging_pendulum_has_the_frequency_of_the_formula(locked: bool, inertia: float) -> None:
    """It is sqrt(m g l / J) / 2 pi; a free flywheel about the same axis does not turn with the pendulum."""
    stand = loads(PENDULUM)
    result = modes(linear_model(stand, rest(stand).state, [], locked=locked))
    (swing,) = [mode for mode in result.modes if mode.kind == "oscillation"]
    assert swing.frequency == pytest.approx(math.sqrt(WEIGHT * ARM / inertia) / (2 * math.pi), rel=1e-12)
    assert [channel.name for channel in result.coordinates] == ["q_pitch", *([] if locked else ["phi w1"])]
    assert not result.unstable
    upright = modes(linear_model(stand, home(stand), [], locked=locked))
    assert upright.unstable
    falls = max(mode.eigenvalue.real for mode in upright.modes)
    assert falls == pytest.approx(math.sqrt(WEIGHT * ARM / inertia), rel=1e-12)


def test_a_mass_on_a_rail_with_a_spring() -> None:
    text = PENDULUM.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', "slide = [0, 3, 4]")
    stand = loads(text + "[suspension]\nstiffness = [1e6, 500, 500, 1e6, 1e6, 1e6]\ndamping = [0, 3, 3, 0, 0, 0]\n")
    model = linear_model(stand, rest(stand).state, [], locked=True)
    assert [str(variable) for variable in model.states] == ["q_1 [m]", "u_1 [m/s]"]
    assert pytest.approx(np.array([[0, 1], [-500 / 2.5, -3 / 2.5]]), abs=1e-9) == model.A
    push = dict(zip((variable.name for variable in model.inputs), model.B[1], strict=True))
    assert push["wrench Y"] == pytest.approx(0.6 / 2.5) and push["wrench Z"] == pytest.approx(0.8 / 2.5)


def rate(stand: Stand, state: State, tau: Array) -> Array:
    """u* (m) and phi'' (N) by the literal reference."""
    assert stand.hold is not None
    none = np.zeros(len(tau), dtype=bool)
    V_dot, phi_ddot = coupled(reference.pieces(stand, state), tau, none)
    return np.concatenate([rates(stand.hold, V_dot), phi_ddot])


def test_the_derivatives_are_those_of_the_reference() -> None:
    """The stand moves on a ball joint off O1, with weight and three unbalanced flywheels."""
    hold, u = Hold(HOLDS["ball joint"], (0.1, -0.2, 0.15), (0.0,) * 3, (0.0,) * 3), (0.4, -0.7, 0.5)
    stand = replace(random_stand(np.random.default_rng(2), 3, replace(BARE, gravity=True)), hold=hold)
    state = move(home(stand), np.eye(3), np.array(twist_of(hold, (0.3, 0.2, -0.5))))
    state = replace(state, u=u, V=twist_of(hold, u), phi=(0.3, 1.0, -2.0), phi_dot=(20.0, -30.0, 15.0))
    model = linear_model(stand, state, [])
    tau, C = np.array(model.state.tau), carrier_rotation(stand, state)
    m, N, h = 3, 3, 1e-5

    def rates_at(x: Array) -> Array:
        q, u_aside, phi, phi_dot = np.split(x, [m, 2 * m, 2 * m + N])
        displaced = move(state, C, np.array(twist_of(hold, q.tolist())))
        total = np.array(state.u) + u_aside
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
    turning = np.cross(u, np.eye(3)).T
    assert model.A[:m, :m] == pytest.approx(-turning, abs=1e-12)  # as the axes turn
    assert model.A[:m, m : 2 * m] == pytest.approx(np.eye(m), abs=1e-12)


def test_flywheels_of_a_clamped_carrier_turn_alone() -> None:
    stand = loads(PENDULUM.replace('["pitch"]\npivot = [0, 0, -0.2]', "[]"))
    model = linear_model(stand, home(stand), [])
    assert pytest.approx(np.array([[0, 1], [0, 0]])) == model.A and model.B[1, 0] == pytest.approx(1 / SPIN)
    assert [str(variable) for variable in model.states] == ["phi w1 [rad]", "phi_dot w1 [rad/s]"]
    (mode,) = modes(model).modes
    assert [variable.name for variable in modes(model).coordinates] == ["phi w1"] and abs(mode.shape[0]) == 1
    with pytest.raises(CheckError, match="the flywheels are locked, as `modes` has them by default; give"):
        linear_model(stand, home(stand), [], locked=True)
    knife_edge = loads(PENDULUM.replace('["pitch"]', '["x", "yaw"]'))
    with pytest.raises(CheckError, match="not a closed set"):
        linear_model(knife_edge, home(knife_edge), [])


def test_friction_and_a_stop_are_in_the_linear_model() -> None:
    """At rest the smoothed sign has the slope breakaway / smoothing; a stop that carries the weight is a spring."""
    hold = "slide = [1, 0, 0]\n[[hold.friction]]\nviscous = 3\ncoulomb = 0.1\nbreakaway = 0.2\nstribeck_speed = 1\n"
    stop = "smoothing = 0.1\n[[hold.stop]]\nat = 0.01\nstiffness = 500\ndamping = 100\n"
    text = PENDULUM.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', hold + stop)
    stand = replace(loads(text), gravity=(2.0, 0.0, 0.0))
    state = rest(stand).state
    depth = 2.5 * 2.0 / 500
    assert state.position[0] == pytest.approx(0.01 + depth, rel=1e-9)
    model = linear_model(stand, state, [], locked=True)
    drag = 3 + 0.2 / 0.1 + 100 * depth
    assert pytest.approx(np.array([[0, 1], [-500 / 2.5, -drag / 2.5]]), abs=1e-6) == model.A


def course(damping: str) -> float:
    """Largest growth rate (1/s) of small motions of a hull from a course ahead at U."""
    stand = loads(f"""
schema = 1
name = "hull"
[carrier]
mass = 20.0
inertia = [0.3, 2.0, 2.0]
added_mass = [2, 25, 24, 0, 1.5, 1.5]
[carrier.damping]
{damping}
""")
    ahead = linear_model(stand, replace(rest_state(stand), V=(U, 0.0, 0.0, 0.0, 0.0, 0.0)), [], locked=True)
    return float(np.linalg.eigvals(ahead.A[6:, 6:]).real.max())


U = 1.5
PUBLISHED = 'derivatives = "with added-mass products"'


@pytest.mark.parametrize("damping", ["", PUBLISHED])
def test_growth_by_the_moment_of_munk(damping: str) -> None:
    """(m + L22) v' = -(m + L11) U r and (J + L66) r' = (L11 - L22) U v; with the key only -m U r is left."""
    expected = U * math.sqrt((20 + 2) * (25 - 2) / ((20 + 25) * (2.0 + 1.5))) if not damping else 0.0
    assert course(damping) == pytest.approx(expected, rel=1e-6, abs=1e-4)


@pytest.mark.parametrize("Nv", [-3.0, -300.0])
def test_course_by_the_stability_roots(Nv: float) -> None:
    """Sway and yaw of (M) x' = (N) x with published derivatives, as in a handbook of ship motion."""
    Yv, Yr, Nr = -60.0, 8.0, -40.0
    values = {"Y v": Yv, "Y r": Yr, "N v": Nv, "N r": Nr, "Z w": -90.0, "M q": -50.0, "X |u|": -9.0}
    terms = (f'{{ wrench = "{key[0]}", of = ["u", "{key[2:]}"], value = {value} }}' for key, value in values.items())
    M, N = np.diag([45.0, 3.5]), U * np.array([[Yv, Yr - 20.0], [Nv, Nr]])
    roots = np.linalg.eigvals(np.linalg.solve(M, N)).real
    expected = max(float(roots.max()), 0.0)  # roll is neutral
    assert course(f"terms = [{', '.join(terms)}]\n{PUBLISHED}") == pytest.approx(expected, rel=1e-6, abs=1e-4)
