"""Wrenches of laws against published formulas, integrals and products written out by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from audits.audit import momentum_products, without_added_products
from laws.stands import CONTROL, MAIN, RUDDER, SLENDER, STILL, TEXTS, WHOLE, bearing
from mahovik.core.lower.law_arrays import LawArrays
from mahovik.core.stand import Stand, loads, rest_state
from mahovik.core.stand.law import Velocity
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS
from mahovik.core.stand.random import random_state
from mahovik.laws.control.law import ControlDerivatives
from mahovik.laws.control.reference import control_derivatives
from mahovik.laws.cross_flow.reference import cross_flow_drag
from mahovik.laws.damping.law import Damping, DampingTerm, products_of_added_mass
from mahovik.laws.damping.reference import products_in_derivatives
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fading.reference import fading_damping
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.fin.reference import lift_and_drag, lift_coefficient
from mahovik.laws.propeller.law import Propeller
from mahovik.laws.propeller.reference import thrust_and_torque
from mahovik.laws.torquer.law import Torquer, Torquers
from mahovik.proof import reference

twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)
propellers = st.sampled_from([MAIN, WHOLE, STILL, replace(MAIN, speed=-20.0), replace(STILL, whole=True)])


@given(twists)
def test_control_derivatives_are_products_written_out(V: np.ndarray) -> None:
    """The wrench is that of the products, written out by hand, of rudder, speed and propeller race."""
    carrier = loads(CONTROL).carrier
    law = carrier.law(ControlDerivatives)
    assert law is not None
    wrench = control_derivatives(carrier, law, V)
    u, v, w, p, _, r = V
    race = np.sqrt(u * u + 2e-4 * 90.0**2) - abs(u)
    expected = [-3.1 * u * r * 0.2, 2.5 * u * abs(v) * 0.2 * race, -4.2 * w**3, -0.3 * p * race, 0, 1e-4 * 90.0**2]
    np.testing.assert_allclose(wrench, expected, rtol=1e-12, atol=1e-12)


@given(twists)
def test_fading_damping_as_published(V: np.ndarray) -> None:
    """REMUS 100 in the Marine Systems Simulator: D(1,1) and D(2,2) times exp(-3 U_r), U_r = |v|."""
    law = loads(TEXTS["fading"]).carrier.law(FadingDamping)
    assert law is not None
    u, v, w, p, q, r = V
    fade = math.exp(-3 * math.sqrt(u * u + v * v + w * w))
    expected = [-fade * d * x for d, x in zip((2, 20, 20, 0.1, 3, 3), (u, v, w, p, q, r), strict=True)]
    np.testing.assert_allclose(fading_damping(law, V), expected, rtol=1e-14, atol=1e-300)
    assert float(fading_damping(law, V) @ V) <= 0.0


def test_moment_of_torquers_by_hand() -> None:
    """Field and dipoles at an aligned attitude: (2, 0, 0) + (0, 3, 0) of the turned boom, times (20, 0, -40) uT."""
    stand = loads(TEXTS["torquers"])
    assert stand.law(Torquers) == Torquers(
        (2e-5, 0.0, -4e-5), (Torquer("mx", "carrier", (2.0, 0.0, 0.0)), Torquer("my", "boom", (3.0, 0.0, 0.0)))
    )
    F = reference.pieces(stand, rest_state(stand)).F
    np.testing.assert_allclose(F, [0, 0, 0, -12e-5, 8e-5, -6e-5], rtol=1e-12, atol=1e-19)


def test_the_magnetic_field_is_constant_in_E0() -> None:
    """Half a turn about z turns the field in E1, and so the moment of a dipole along x."""
    stand = loads(TEXTS["torquers"])
    turned = replace(rest_state(stand), angles=(np.pi, 0.0, 0.0))
    F = reference.pieces(stand, turned).F
    np.testing.assert_allclose(F[3:], np.cross([2.0, 3.0, 0.0], [-2e-5, 0.0, -4e-5]), rtol=1e-12, atol=1e-19)


@pytest.mark.parametrize("together", [False, True])
def test_drag_is_the_integral_along_the_axis(together: bool) -> None:
    """Sway, heave, pitch and yaw without a change of sign inside: two points between stations are exact apart."""
    V = np.array([1.0, 0.9, -1.3, 0.4, 0.3, 0.2])

    def force(x: float, which: int) -> float:
        h, b, C_y, C_z = (
            np.interp(x, SLENDER.x, table)
            for table in (SLENDER.height, SLENDER.breadth, SLENDER.drag_y, SLENDER.drag_z)
        )
        v, w = V[1] + x * V[5], V[2] - x * V[4]
        if together:
            drag = (C_y * h * v**2 + C_z * b * w**2) / np.sqrt(v**2 + w**2)
            return float(drag * (v, w)[which])
        return float((C_y * h * v * abs(v), C_z * b * w * abs(w))[which])

    def integral(which: int, power: int) -> float:
        parts = zip(SLENDER.x[:-1], SLENDER.x[1:], strict=True)
        return float(sum(quad(lambda x: x**power * force(x, which), a, b, epsabs=0, epsrel=1e-12)[0] for a, b in parts))

    expected = -512.5 * np.array([0, integral(0, 0), integral(1, 0), 0, -integral(1, 1), integral(0, 1)])
    wrench = cross_flow_drag(replace(SLENDER, points=16, together=together), V)
    np.testing.assert_allclose(wrench, expected, rtol=1e-10, atol=1e-10)
    coarse = cross_flow_drag(replace(SLENDER, points=3, together=together), V)
    np.testing.assert_allclose(coarse, expected, rtol=1e-3 if together else 1e-10, atol=1e-10)


@given(twists, st.booleans())
def test_drag_of_strips_takes_power(V: np.ndarray, together: bool) -> None:
    P = cross_flow_drag(replace(SLENDER, together=together), V)
    assert float(P @ V) <= 1e-12 * float(np.abs(P) @ np.abs(V))


def by_terms(stand: Stand) -> Stand:
    """The stand with rows of `terms` in place of the key: the products of added mass with the other sign."""
    damping = stand.carrier.law(Damping)
    assert damping is not None
    rows = without_added_products(np.array(stand.carrier.added_mass))
    added = tuple(_term(row) for row in rows)
    law = replace(damping, terms=(*damping.terms, *added), contains_products=False)
    return replace(stand, carrier=stand.carrier.with_laws(law))


def _term(row: Mapping[str, Any]) -> DampingTerm:
    first, second = (Velocity(TWIST_LETTERS.index(letter), absolute=False) for letter in row["of"])
    return DampingTerm(WRENCH_LETTERS.index(row["wrench"]), (first, second), row["value"])


def test_key_is_the_terms_that_take_the_products_out() -> None:
    seed = 1
    stand = bearing("products", seed)
    state = random_state(stand, np.random.default_rng(seed))
    wants = ["forward", "momentum"]
    answer, expected = reference.evaluate(stand, state, wants), reference.evaluate(by_terms(stand), state, wants)
    np.testing.assert_allclose(answer["V_dot"], expected["V_dot"], rtol=1e-11)
    damping = stand.carrier.law(Damping)
    assert damping is not None
    twice = replace(stand, carrier=stand.carrier.with_laws(replace(damping, contains_products=False)))
    other = np.array(reference.evaluate(twice, state, ["forward"])["V_dot"])
    assert np.abs(other - answer["V_dot"]).max() > 1e-3 * np.abs(other).max()


@given(twists)
def test_products_have_no_power_and_are_those_of_the_handbook(V: np.ndarray) -> None:
    """They are Fossen's C(V) V, and planning has their slopes."""
    stand = bearing("products", 5)
    carrier = stand.carrier
    P, Lambda = products_in_derivatives(carrier, V), np.array(carrier.added_mass)
    size = float(np.abs(Lambda).max() * (V @ V)) + 1e-9
    np.testing.assert_allclose(P, momentum_products(Lambda, V), rtol=0, atol=1e-13 * size)
    assert abs(float(P @ V)) <= 1e-13 * size * float(np.abs(V).max() + 1)
    warned = -np.einsum("ijk,j,k->i", products_of_added_mass(Lambda), V, V)
    np.testing.assert_allclose(P, warned, rtol=0, atol=1e-13 * size)
    damping = Damping(None, None, (), contains_products=True)
    law = LawArrays(replace(stand, carrier=replace(carrier, laws=(damping,)))).bodies[0]
    assert law is not None
    np.testing.assert_allclose(law.wrench(V[None])[0], P, rtol=0, atol=1e-13 * size)
    step = np.eye(6)
    slopes = (law.wrench(V + step) - law.wrench(V - step)) / 2  # exact: it is quadratic
    np.testing.assert_allclose(
        law.rate(V[None])[0], slopes.T, rtol=0, atol=1e-12 * (size + float(np.abs(Lambda).sum()))
    )


@given(st.floats(0.2, 3), st.floats(-3, 3), st.floats(-3, 3), st.floats(-0.4, 0.4))
def test_body_and_planes_of_a_torpedo_as_published(u: float, v: float, w: float, delta: float) -> None:
    """REMUS 100 in the Marine Systems Simulator: lift and drag of the hull by alpha, forces of planes and rudders."""
    rho, diameter, length = 1026.0, 0.19, 1.6
    area = 0.7 * length * diameter
    aspect = diameter**2 / area
    text = TEXTS["fins"].replace("area = 0.2", f"area = {area!r}").replace("aspect = 0.5", f"aspect = {aspect!r}")
    law = loads(text.replace("1025", "1026")).carrier.law(Fins)
    assert law is not None
    hull = lift_and_drag(law.fins[0], np.array([u, v, w, 0, 0, 0]))
    alpha, square = np.arctan2(w, u), u**2 + v**2 + w**2
    C_L = np.pi * aspect / (1 + np.sqrt(1 + (aspect / 2) ** 2)) * alpha
    lift, drag = (rho / 2 * square * area * C for C in (C_L, 0.2 + C_L**2 / (np.pi * 0.7 * aspect)))
    X, Z = -np.cos(alpha) * drag + np.sin(alpha) * lift, -np.sin(alpha) * drag - np.cos(alpha) * lift
    np.testing.assert_allclose(hull, [X, 0, Z, 0, 0, 0], rtol=1e-13, atol=1e-12)

    slope, small = 0.7, 0.01
    base = Fin("s", (-0.7, 0, 0), (1, 0, 0), (0, 1, 0), rho, small, slope, 0, 1 / slope, None, delta, "across", False)
    X, Z = (-rho / 2 * (u**2 + w**2) * small * slope * x for x in (delta**2, delta))
    np.testing.assert_allclose(lift_and_drag(base, np.array([u, v, w, 0, 0, 0])), [X, 0, Z, 0, 0.7 * Z, 0], atol=1e-12)
    rudder = replace(base, span=(0, 0, -1))
    X, Y = (-rho / 2 * (u**2 + v**2) * small * slope * x for x in (delta**2, delta))
    wrench = lift_and_drag(rudder, np.array([u, v, w, 0, 0, 0]))
    np.testing.assert_allclose(wrench, [X, Y, 0, 0, 0, -0.7 * Y], atol=1e-12)


def test_lift_stalls() -> None:
    stalling = replace(RUDDER, stall=0.25, lift_slope=2.0)
    angles = np.array([-1.6, -0.25, 0.0, 0.2, 0.25, (0.25 + np.pi / 2) / 2, np.pi / 2, 3.0])
    lift = [lift_coefficient(stalling, angle) for angle in angles]
    np.testing.assert_allclose(lift, [0, -0.5, 0, 0.4, 0.5, 0.25, 0, 0], atol=1e-15)


@given(twists, st.floats(-1.5, 1.5))
def test_a_fin_that_feels_the_flow_drags(V: np.ndarray, deflection: float) -> None:
    """Lift has no power in the flow at the fin, drag takes power."""
    fin = replace(RUDDER, deflection=deflection)
    velocity = V[:3] + np.cross(V[3:], fin.position)
    force = lift_and_drag(fin, V)[:3]
    assert force @ velocity <= 1e-12 * math.hypot(*force) * math.hypot(*velocity)
    lifting = replace(fin, drag=0.0, induced=0.0)
    force = lift_and_drag(lifting, V)[:3]
    assert abs(force @ velocity) <= 1e-12 * math.hypot(*force) * math.hypot(*velocity)


@given(st.floats(0.1, 3), st.floats(-1, 1), st.floats(1, 1500))
def test_propellers_as_published(u: float, v: float, rpm: float) -> None:
    """REMUS 100 of the Marine Systems Simulator, K_T and K_Q linear in J = 0.944 U/(n D); NPS AUV II, by n/u."""
    rho, D, n, U = 1026.0, 0.14, rpm / 60, np.sqrt(u * u + v * v)
    J = 0.944 * U / (n * D)
    slopes = [(0.1798 - 0.4566) / 0.6632, (0.0312 - 0.07) / 0.6632]
    X = 0.9 * rho * n**2 * D**4 * (0.4566 + slopes[0] * J)
    K = rho * n**2 * D**5 * (0.07 + slopes[1] * J) / 10
    remus = Propeller(
        "p", (0, 0, 0), (1, 0, 0), rho, D, (0.4566, slopes[0], 0), (0.007, slopes[1] / 10, 0), 2 * np.pi * n,
        0.056, 0.1, whole=True, left=True,
    )  # fmt: skip
    V = np.array([u, v, 0, 0.1, 0, 0])
    size = 0.9 * rho * n**2 * D**4
    np.testing.assert_allclose(thrust_and_torque(remus, V), [X, 0, 0, K, 0, 0], rtol=1e-12, atol=1e-13 * size)

    L, water, Cd0, omega = 5.3, 1025.0, 0.00385, 2 * np.pi * n
    eta = 0.012 * omega / u
    X = water / 2 * L**2 * u**2 * Cd0 * (abs(eta) * eta - 1)
    scaled = Cd0 * L**2 / 2
    auv = Propeller(
        "p", (0, 0, 0), (1, 0, 0), water, 1.0, (scaled * (0.012 * 2 * np.pi) ** 2, 0, -scaled), (0, 0, 0), omega, 0, 0,
        whole=False, left=False,
    )  # fmt: skip
    bound = 1e-13 * water * scaled * (u**2 + (0.012 * omega) ** 2)
    np.testing.assert_allclose(thrust_and_torque(auv, V), [X, 0, 0, 0, 0, 0], rtol=1e-12, atol=bound)


@given(propellers, twists)
def test_turning_and_moving_the_other_way_is_the_opposite(p: Propeller, V: np.ndarray) -> None:
    if not p.whole:
        np.testing.assert_array_equal(thrust_and_torque(replace(p, speed=-p.speed), -V), -thrust_and_torque(p, V))
    mirrored = thrust_and_torque(replace(p, left=not p.left), V)
    np.testing.assert_allclose(mirrored[:3], thrust_and_torque(p, V)[:3])
