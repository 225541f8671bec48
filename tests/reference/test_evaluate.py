"""The contract of `evaluate`: names, shapes, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.contract.functions import wants_of
from mahovik.core.stand.model import Instrument, Point
from mahovik.core.stand.random import EXTREMES, extreme_state, random_stand
from mahovik.errors import StateError
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Array
from physics.general import draw
from physics.motions import motion, rate, rotation, second_rate

SHAPES: dict[str, dict[str, tuple[int | str, ...]]] = {
    "matrices": {"K": (6, 6), "K_dot": (6, 6), "M": (6, 6), "I": (6, "N"), "J": (6, "N"), "F": (6,)},
    "momentum": {"Z": (6,), "Z0": (6,), "energy": (), "center_of_mass": (3,)},
    "forward": {"V_dot": (6,)},
    "center_of_mass_velocity": {"center_of_mass_velocity": (3,)},
    "torque": {"tau": ("N",)},
    "mounts": {"mount_wrench": ("N", 6)},
    "coupled": {"V_dot": (6,), "phi_ddot": ("N",)},
    "inverse": {"phi_ddot": ("N",), "residual": (6,), "sigma": ("n",), "status": (), "rank": ()},
    "generalized": {"A": (6, 6), "D": (6, 6), "I0": (6, 6), "J0": (6, 6), "q_dot": (6,), "q_ddot": (6,)},
}


@pytest.mark.parametrize("flywheels", [0, 1, 7])
@pytest.mark.parametrize("want", SHAPES)
def test_each_want_gives_what_the_contract_names(want: str, flywheels: int) -> None:
    stand, state = draw(1, flywheels)
    values = evaluate(stand, state, [want])
    sizes = {"N": flywheels, "n": min(6, flywheels)}
    expected = {
        name: tuple(sizes[size] if isinstance(size, str) else size for size in shape)
        for name, shape in SHAPES[want].items()
    }
    assert {name: np.shape(value) for name, value in values.items()} == expected


def test_every_want_is_spoken_for() -> None:
    assert set(wants_of("reference")) == set(SHAPES) | {"points", "reaction"}  # reaction is of held carriers


@pytest.mark.parametrize(
    ("want", "message"),
    [
        ([], "empty"),
        (["forwards"], 'unknown "forwards"'),
        (["forward", "coupled"], "both give V_dot"),
        (["inverse", "momentum", "coupled"], "both give phi_ddot"),
    ],
)
def test_refused_wants(want: str, message: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=message):
        evaluate(stand, state, want)


def test_wants_together_give_what_each_gives_alone() -> None:
    stand, state = draw(1, 3)
    together = evaluate(stand, state, ["matrices", "inverse", "forward", "torque"])
    for want in ("matrices", "inverse", "forward", "torque"):
        for name, value in evaluate(stand, state, [want]).items():
            np.testing.assert_array_equal(together[name], value)


def test_generalized_matrices_with_a_stream_are_at_V() -> None:
    stand, state = draw(1, 3, stream=True)
    still = replace(stand, stream=None)
    want = ["generalized"]
    moving, resting = evaluate(stand, state, want), evaluate(still, state, want)
    for name in ("A", "D", "I0", "J0", "q_dot"):
        np.testing.assert_array_equal(moving[name], resting[name])
    assert np.abs(moving["q_ddot"] - resting["q_ddot"]).max() > 1e-3


def test_zero_stream_is_no_stream() -> None:
    stand, state = draw(1, 3)
    zero = replace(stand, stream=(0.0, 0.0, 0.0))
    for want in SHAPES:
        for name, value in evaluate(stand, state, [want]).items():
            np.testing.assert_array_equal(evaluate(zero, state, [want])[name], value)


def test_overflow_is_reported_not_returned() -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match="not finite"):
        evaluate(stand, replace(state, V=(1e200, 0, 0, 1e200, 0, 0)), ["forward"])


def test_stand_without_mass_has_no_center_of_mass() -> None:
    stand, state = draw(1, 0, instruments=0)
    weightless = replace(stand, carrier=replace(stand.carrier, mass=0.0, inertia_about="origin"))
    with pytest.raises(StateError, match="center_of_mass"):
        evaluate(weightless, state, ["momentum"])
    assert np.all(np.isfinite(evaluate(weightless, state, ["forward"])["V_dot"]))


@pytest.mark.parametrize("seed", range(5))
def test_points_are_where_and_as_fast_as_differences_say(seed: int) -> None:
    stand, state = draw(seed, 1, stream=True)
    along, step = motion(stand, state), 4e-3  # rates near 5 rad/s: 0.02^8, and 1e-16 / step^2, below 1e-11
    values = evaluate(stand, state, ["points"])["points"]
    assert list(values) == [*(p.name for p in stand.instruments), *(p.name for p in stand.points)]
    bodies: dict[str, Instrument | Point] = {p.name: p for p in stand.instruments}
    bodies |= {p.name: p for p in stand.points}
    for name, found in values.items():
        p = bodies[name]
        mount = bodies.get(p.mount) if isinstance(p, Point) else None
        r, R = np.array(p.position), Rotation.from_euler("ZYX", p.angles).as_matrix()
        if mount is not None:
            C = Rotation.from_euler("ZYX", mount.angles).as_matrix()
            r, R = np.array(mount.position) + C @ r, C @ R

        def place(t: float, r: Array = r) -> Array:
            now = along(t)
            return np.array(now.position) + rotation(stand, now) @ r

        def axes(t: float, R: Array = R) -> Array:
            return rotation(stand, along(t)) @ R

        def omega(t: float, R: Array = R) -> Array:
            return np.asarray(R.T @ np.array(along(t).V[3:]))

        C = axes(0.0)
        np.testing.assert_allclose(found["position"], place(0.0), rtol=0, atol=1e-14)
        np.testing.assert_allclose(found["C"], C, rtol=0, atol=1e-14)
        omega_cross = C.T @ rate(axes, step)
        spin = [omega_cross[2, 1], omega_cross[0, 2], omega_cross[1, 0]]
        np.testing.assert_allclose(found["twist"], [*(C.T @ rate(place, step)), *spin], rtol=0, atol=1e-11)
        specific_force = C.T @ (second_rate(place, step) - np.array(stand.gravity))
        np.testing.assert_allclose(found["specific_force"], specific_force, rtol=0, atol=1e-9)
        np.testing.assert_allclose(found["angular_acceleration"], rate(omega, step), rtol=0, atol=1e-11)


@pytest.mark.parametrize("kind", EXTREMES)
@pytest.mark.parametrize("flywheels", [0, 3, 8])
def test_extreme_states_of_the_accepted_range_are_evaluated(kind: str, flywheels: int) -> None:
    rng = np.random.default_rng(flywheels)
    for _ in range(5):
        stand = random_stand(rng, flywheels)
        state = extreme_state(stand, rng, kind)
        want = ["matrices", "momentum", "forward", "torque", "mounts", "inverse", "points"]
        values = evaluate(stand, state, want) | evaluate(stand, state, ["coupled"])
        assert values["V_dot"].shape == (6,)
        if kind == "near_singular":  # near, but not at it
            generalized = evaluate(stand, state, ["generalized"])
            q_ddot, D, A = generalized["q_ddot"], generalized["D"], generalized["A"]
            V_dot = evaluate(stand, state, ["forward"])["V_dot"]
            # A is singular to 1e-5, and D q' is large there, by its square
            scale = np.abs(V_dot).max() + np.abs(D @ generalized["q_dot"]).max() + np.abs(A @ q_ddot).max()
            found = A @ q_ddot + D @ generalized["q_dot"]
            np.testing.assert_allclose(found, V_dot, rtol=0, atol=1e-9 * scale)
