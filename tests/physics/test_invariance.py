"""What is a matter of choice changes nothing: origin and axes of E1, order of flywheels; and how (8) scales."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Body, Damping, MountingAxes, Stand
from mahovik.core.stand.state import State
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.laws.suspension.data import Suspension
from mahovik.laws.torquer.data import Torquers
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.rotation import flywheel_rotation
from physics.general import draw, isolated, rows
from physics.motions import cross, rotation, vec, with_rotation

SEEDS = range(8)
ROUNDING = 1e-10  # two ways of some hundred operations, condition of the 6 + N matrix below 1e4


def transfer(d, R):
    """L (6x6) from the new E1 (origin d, axes R, both in the old one) to the old."""
    return np.block([[R, np.zeros((3, 3))], [cross(d) @ R, R]])


def fixed_angles(C: np.ndarray):
    return vec(Rotation.from_matrix(C).as_euler("ZYX"))


def redescribed(stand: Stand, d, R):
    """The same stand described in an E1 with origin d and axes R; of laws tied to axes, only linear damping."""
    L = transfer(d, R)
    back = np.linalg.inv(L)

    def place(position: np.ndarray):
        return vec(R.T @ (np.array(position) - d))

    def symmetric(matrix: np.ndarray):
        return rows((matrix + matrix.T) / 2)

    def carried(matrix: np.ndarray):
        return None if matrix is None else symmetric(back @ np.array(matrix) @ back.T)

    c = stand.carrier
    rc = np.array(c.center_of_mass)
    Jc = np.array(c.inertia)
    if c.inertia_about == "origin":
        Jc = Jc + c.mass * cross(rc) @ cross(rc)
    carrier = replace(
        c,
        center_of_mass=place(rc),
        inertia=symmetric(R.T @ Jc @ R),
        inertia_about="center_of_mass",
        added_mass=carried(c.added_mass),
        buoyancy=replace(c.buoyancy, center=place(c.buoyancy.center)),
        damping=Damping(carried(c.damping.linear), None, ()),
    )
    instruments = tuple(
        replace(
            p,
            position=place(p.position),
            angles=fixed_angles(R.T @ Rotation.from_euler("ZYX", p.angles).as_matrix()),
            added_mass=carried(p.added_mass),
        )
        for p in stand.instruments
    )

    def remounted(s):
        C_s = R.T @ flywheel_rotation(s, 0.0)
        return replace(s, position=place(s.position), mounting=MountingAxes(vec(C_s[:, 0]), vec(C_s[:, 1])))

    flywheels = tuple(remounted(s) if s.mount == "carrier" else s for s in stand.flywheels)
    points = tuple(
        replace(
            p,
            position=place(p.position),
            angles=fixed_angles(R.T @ Rotation.from_euler("ZYX", p.angles).as_matrix()),
        )
        if p.mount == "carrier"
        else p
        for p in stand.points
    )
    legs = tuple(replace(leg, carrier=place(leg.carrier)) for leg in legs_of(stand))

    def turned(torquer):
        return replace(torquer, dipole=vec(R.T @ np.array(torquer.dipole))) if torquer.mount == "carrier" else torquer

    torquers = [law for law in stand.laws if isinstance(law, Torquers)]
    torquers = [replace(law, torquers=tuple(map(turned, law.torquers))) for law in torquers]
    return replace(stand, carrier=carrier, instruments=instruments, flywheels=flywheels, points=points).with_laws(
        Legs(legs), *torquers
    )


def redescribed_state(stand: Stand, state: State, d, R):
    L, C = transfer(d, R), rotation(stand, state)
    moved = replace(
        state,
        position=vec(np.array(state.position) + C @ d),
        V=vec(L.T @ np.array(state.V)),
        V_dot=vec(L.T @ np.array(state.V_dot)),
        wrench={**state.wrench, "carrier": vec(np.linalg.solve(L, state.wrench["carrier"]))},
    )
    return with_rotation(moved, C @ R)


@pytest.mark.parametrize("stream", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_moving_O1_and_turning_E1_changes_nothing_observable(seed: int, stream: bool) -> None:
    stand, state = draw(seed, 5, stream=stream)
    damping = replace(stand.carrier.damping, quadratic=None, terms=())
    stand = replace(stand.without_laws(Suspension), carrier=replace(stand.carrier, damping=damping))
    rng = np.random.default_rng(seed)
    d, R = rng.uniform(-0.3, 0.3, 3), Rotation.from_rotvec(rng.uniform(-1, 1, 3)).as_matrix()
    other, other_state = redescribed(stand, d, R), redescribed_state(stand, state, d, R)
    L = transfer(d, R)

    def both(want: str):
        return evaluate(stand, state, [want]), evaluate(other, other_state, [want])

    here, there = both("momentum")
    np.testing.assert_allclose(there["Z0"], here["Z0"], rtol=0, atol=ROUNDING * np.abs(here["Z0"]).max())
    assert there["energy"] == pytest.approx(here["energy"], rel=ROUNDING)
    np.testing.assert_allclose(R @ there["center_of_mass"] + d, here["center_of_mass"], rtol=0, atol=ROUNDING)

    here, there = both("forward")
    V_dot = L.T @ here["V_dot"]
    np.testing.assert_allclose(there["V_dot"], V_dot, rtol=0, atol=ROUNDING * np.abs(V_dot).max())

    here, there = both("coupled")
    scale = np.abs(here["phi_ddot"]).max()
    np.testing.assert_allclose(there["phi_ddot"], here["phi_ddot"], rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(there["V_dot"], L.T @ here["V_dot"], rtol=0, atol=ROUNDING * scale)

    here, there = both("inverse")
    assert there["status"] == here["status"]
    assert there["rank"] == here["rank"]
    np.testing.assert_allclose(there["sigma"], here["sigma"], rtol=0, atol=ROUNDING)
    scale = np.abs(here["phi_ddot"]).max() / here["sigma"][-1]
    np.testing.assert_allclose(there["phi_ddot"], here["phi_ddot"], rtol=0, atol=ROUNDING * scale)
    scale = np.abs(here["residual"]).max()
    np.testing.assert_allclose(there["residual"], np.linalg.solve(L, here["residual"]), rtol=0, atol=ROUNDING * scale)

    for want, name in (("torque", "tau"), ("mounts", "mount_wrench")):
        here, there = both(want)
        scale = np.abs(here[name]).max()
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=ROUNDING * scale)

    here, there = both("points")
    for name, point in here["points"].items():
        for quantity, value in point.items():
            scale = max(1.0, np.abs(value).max())
            np.testing.assert_allclose(there["points"][name][quantity], value, rtol=0, atol=ROUNDING * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_order_of_flywheels_is_of_no_consequence(seed: int) -> None:
    stand, state = draw(seed, 7)
    order = [3, 1, 2, 0, 6, 5, 4]
    shuffled = replace(stand, flywheels=tuple(stand.flywheels[i] for i in order))
    per_flywheel = ("phi", "phi_dot", "phi_ddot", "tau")
    moved = replace(state, **{name: tuple(getattr(state, name)[i] for i in order) for name in per_flywheel})
    for want in ("matrices", "momentum", "forward", "torque", "mounts", "coupled", "inverse", "generalized"):
        here, there = evaluate(stand, state, [want]), evaluate(shuffled, moved, [want])
        for name, value in here.items():
            if name in ("status", "rank"):
                assert there[name] == value
                continue
            expected = value[order] if name in ("tau", "mount_wrench", "phi_ddot") else value
            expected = value[:, order] if name in ("I", "J") else expected
            if name == "residual":  # seven flywheels reach everything: rounding only, of the size of the demand
                expected, scale = np.zeros(6), 1e3
            else:
                scale = max(1.0, np.abs(value).max())
            np.testing.assert_allclose(there[name], expected, rtol=0, atol=ROUNDING * scale)


def balance(stand: Stand, state: State):
    """K V* + M V + sum (I phi'' + J phi') - F of (8) for given V*, phi''."""
    at = evaluate(stand, state, ["matrices"])
    V, V_dot, phi_dot, phi_ddot = map(np.array, (state.V, state.V_dot, state.phi_dot, state.phi_ddot))
    return at["K"] @ V_dot + at["M"] @ V + at["I"] @ phi_ddot + at["J"] @ phi_dot - at["F"]


def with_inertia(body: Body, mass, mu, J):
    """The body with this mass, first moment and moments of inertia about its origin."""
    rc = np.zeros(3) if mass == 0 else np.array(mu) / mass
    return replace(body, mass=mass, center_of_mass=vec(rc), inertia=rows(J), inertia_about="origin")


@pytest.mark.parametrize("which", ["carrier", "instrument", "flywheel"])
@pytest.mark.parametrize("seed", SEEDS)
def test_equation_8_is_linear_in_mass_first_moment_and_inertia(seed: int, which: str) -> None:
    """f(a + b) + f(0) = f(a) + f(b) in the ten parameters of one body, weight included; not scaled one by one."""
    stand, state = draw(seed, 3)
    rng = np.random.default_rng(seed)

    def at(mass, mu, J) -> np.ndarray:
        if which == "carrier":
            changed = replace(stand, carrier=with_inertia(stand.carrier, mass, mu, J))
        elif which == "instrument":
            body, *rest = stand.instruments
            changed = replace(stand, instruments=(with_inertia(body, mass, mu, J), *rest))
        else:
            body, *rest = stand.flywheels
            changed = replace(stand, flywheels=(with_inertia(body, mass, mu, J), *rest))
        return balance(changed, state)

    def parameters():
        a = rng.normal(size=(3, 3))
        return float(rng.uniform(1, 2)), rng.normal(size=3), a @ a.T

    (m1, mu1, J1), (m2, mu2, J2) = parameters(), parameters()
    zero = (0.0, np.zeros(3), np.zeros((3, 3)))
    one, two, both = at(m1, mu1, J1), at(m2, mu2, J2), at(m1 + m2, mu1 + mu2, J1 + J2)
    scale = max(np.abs(one).max(), np.abs(two).max())
    np.testing.assert_allclose(both + at(*zero), one + two, rtol=0, atol=1e-13 * scale)  # sums only
    # each of the three by itself
    for part in ((m1, mu2 * 0, J2 * 0), (m2, mu1, J2 * 0), (m2, mu2 * 0, J1)):
        mass, mu, J = part
        base = at(mass, np.zeros(3), np.zeros((3, 3)))
        added = at(mass, mu, J) - base
        doubled = at(mass, 2 * mu, 2 * J) - base
        np.testing.assert_allclose(doubled, 2 * added, rtol=0, atol=1e-13 * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_equation_8_is_quadratic_in_velocities(seed: int) -> None:
    stand, state = draw(seed, 4)
    stand = isolated(stand)  # linear damping is not quadratic

    def at(k) -> np.ndarray:
        phi_dot = vec(k * np.array(state.phi_dot))
        return balance(stand, replace(state, V=vec(k * np.array(state.V)), phi_dot=phi_dot))

    rest = at(0.0)
    scale = np.abs(at(1.0)).max()
    for k in (2.0, -1.0, -3.0):
        np.testing.assert_allclose(at(k) - rest, k * k * (at(1.0) - rest), rtol=0, atol=1e-13 * k * k * scale)
