"""The contract of `evaluate`: names, shapes, refusals."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Instrument, Point
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
