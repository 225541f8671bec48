"""Vehicles of docs/vehicles: stand files against the formulas of the papers, evaluated here by themselves."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.special import roots_legendre

from audits import npsauv
from audits.audit import Array, rigid_mass, rigid_products, to_body
from mahovik.core.stand import Stand, State, load, loads
from mahovik.core.stand.random import random_state
from mahovik.core.stand.summary import summarize
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.propeller.law import Propellers
from mahovik.proof.reference import evaluate
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import conclusion
from mahovik.proof.verify.harness import verify_c

VEHICLES = Path(__file__).parents[2] / "docs" / "vehicles"
AGREEMENT = 1e-12
DOWN = (0.0, 0.0, 1.0)


def restoring(stand: Stand, state: State, weight: float, G: float, buoyancy: float, B: float) -> Array:
    """Weight at (0, 0, G) and buoyancy at (0, 0, B) (6)."""
    down = to_body(stand, state, DOWN)
    arm = np.array([0.0, 0.0, 1.0])
    moment = np.cross(arm, down)
    return np.concatenate([(weight - buoyancy) * down, (G * weight - B * buoyancy) * moment])


def nps(stand: Stand, state: State) -> tuple[Array, Array]:
    """Mass matrix and right-hand side of Healey and Lienard (1993), with factor epsilon of the propeller's race."""
    V = np.array(state.V)
    J = np.array([[2038.0, 13.58, 13.58], [13.58, 13587.0, 13.58], [13.58, 13.58, 13587.0]])
    M = rigid_mass(5454.54, (0.0, 0.0, 0.061), J) + npsauv.added_mass(1000.0)
    right = npsauv.products(5454.54, V, heave=-1.0, pitch=1.0) + npsauv.hydrodynamic(V, 1000.0) + block_drag(V)
    rudder, stern, port, starboard = (fin.deflection for fin in deflected(stand))
    bow, u = port + starboard, V[0]
    force = 500.0 * 5.3**2 * u**2
    screws = stand.carrier.law(Propellers)
    assert screws is not None
    turning = 0.012 * screws.propellers[0].speed
    right += steering(V, turning / u, rudder, stern, bow)
    right[0] += 500.0 * 5.3**2 * 0.00385 * (abs(turning) * turning - abs(u) * u)
    right[0] -= force * 1e-2 * (rudder**2 + stern**2)
    right[1] += force * 2.7e-2 * rudder
    right[2] -= force * (7.3e-2 * stern + 1.3e-2 * bow)
    right[4] += 5.3 * force * (-4.1e-2 * stern + 3.5e-3 * bow)
    right[5] -= 5.3 * force * 1.3e-2 * rudder
    return M, right + restoring(stand, state, 53400.0, 0.061, 53400.0, 0.0)


def steering(V: Array, e: float, rudder: float, stern: float, bow: float) -> Array:
    """Products of velocities and deflections, and of epsilon (6), e = 0.012 n/u above 0; bow planes by their sum."""
    u, v, w, p, q, r = V
    r2, r3, r4 = (500.0 * 5.3**n for n in (2, 3, 4))
    race = -1.0 + (np.sqrt(1.0 + 0.008 * 5.3**2 / 2.0 * abs(e) * e) - 1.0) / (np.sqrt(1.0 + 0.008 * 5.3**2 / 2.0) - 1.0)
    X = r3 * (-1.0e-3 * u * r * rudder + (2.5e-2 * stern - 1.3e-3 * bow) * u * q)
    X += r2 * (1.7e-3 * u * v * rudder + (4.6e-2 * stern + 0.5e-2 * bow) * u * w)
    X += race * (r3 * 2.0e-3 * u * q * stern + r2 * (3.5e-3 * u * w * stern - 1.6e-3 * u**2 * stern**2))
    Z = race * (-r3 * 2.9e-3 * u * q - r2 * (5.1e-3 * u * w + 1.0e-2 * u**2 * stern))
    K = -race * r4 * 5.7e-4 * u * p
    pitch = -race * (r4 * 1.6e-3 * u * q + r3 * (2.9e-3 * u * w + 5.2e-3 * u**2 * stern))
    return np.array([X, 0.0, Z, K, pitch, 0.0])


def block_drag(V: Array) -> Array:
    """Integral over the length of 500 (0.5 0.53 v^2 + 0.6 0.53 w^2) (v, w)/sqrt(v^2 + w^2), ten points of Gauss."""
    roots, weights = roots_legendre(10)
    x = 2.65 * roots
    across, down = V[1] + x * V[5], V[2] - x * V[4]
    drag = 500.0 * 2.65 * weights * 0.53 * (0.5 * across**2 + 0.6 * down**2) / np.hypot(across, down)
    Y, Z = -drag * across, -drag * down
    return np.array([0.0, Y.sum(), Z.sum(), 0.0, -(x * Z).sum(), (x * Y).sum()])


def remus(stand: Stand, state: State) -> tuple[Array, Array]:
    """Mass matrix and right-hand side of Prestero (2001), fins as in the stand, propeller at 1500 rpm."""
    m, z, V = 299 / 9.81, 0.0196, np.array(state.V)
    u, v, w, p, q, r = V
    M = rigid_mass(m, (0.0, 0.0, z), np.diag([0.177, 3.45, 3.45])) + np.diag([0.930, 35.5, 35.5, 0.0704, 4.88, 4.88])
    M[1, 5] -= 1.93
    M[5, 1] -= 1.93
    M[2, 4] += 1.93
    M[4, 2] += 1.93
    X = -1.62 * u * abs(u) - 35.5 * w * q - 1.93 * q * q + 35.5 * v * r - 1.93 * r * r
    Y = -1310 * v * abs(v) + 0.632 * r * abs(r) + 5.22 * u * r + 35.5 * w * p + 1.93 * p * q - 28.6 * u * v
    Z = -131 * w * abs(w) - 0.632 * q * abs(q) - 5.22 * u * q - 35.5 * v * p + 1.93 * r * p - 28.6 * u * w
    K = -0.130 * p * abs(p)
    pitch = 3.18 * w * abs(w) - 188 * q * abs(q) - 2.0 * u * q - 1.93 * v * p + 4.86 * r * p + 24.0 * u * w
    N = -3.18 * v * abs(v) - 94.0 * r * abs(r) - 2.0 * u * r - 1.93 * w * p - 4.86 * p * q - 24.0 * u * v
    rudder, stern = (fin.deflection for fin in deflected(stand))
    Y, N = Y + 9.64 * u**2 * rudder, N - 6.15 * u**2 * rudder
    Z, pitch = Z - 9.64 * u**2 * stern, pitch - 6.15 * u**2 * stern
    X, K = X + 3.86, K - 0.543
    rigid = rigid_products(m, (0.0, 0.0, z), np.diag([0.177, 3.45, 3.45]), V)
    return M, rigid + np.array([X, Y, Z, K, pitch, N]) + restoring(stand, state, 299.0, z, 306.0, 0.0)


def deflected(stand: Stand) -> tuple[Fin, ...]:
    """The fins of the carrier."""
    law = stand.carrier.law(Fins)
    assert law is not None
    return law.fins


def dsrv(stand: Stand, state: State) -> tuple[Array, Array]:
    """Z and M of Healey (1992) in their primed units times rho/2 L^n, Z_delta below zero; the rest a rigid body.

    Z_qdot and M_wdot by their mean; the righting moment with the sine of the pitch angle, and as large in roll.
    """
    V, r = np.array(state.V), [512.5 * 5.0**n for n in range(6)]
    u, w, q = V[0], V[2], V[4]
    m, J = 0.036391 * r[3], 0.001925 * r[5]
    M = np.diag([m] * 3 + [J] * 3)
    M[2, 2] += 0.031545 * r[3]
    M[4, 4] += 0.001573 * r[5]
    M[2, 4] = M[4, 2] = 0.000138 * r[4]
    right = rigid_products(m, (0.0, 0.0, 0.0), J * np.eye(3), V)
    right[2] += -0.017455 * r[3] * u * q - 0.043938 * r[2] * u * w
    right[4] += -0.01131 * r[4] * u * q + 0.011175 * r[3] * u * w
    (plane,) = deflected(stand)
    right[2] -= 0.027695 * r[2] * u**2 * plane.deflection
    right[4] -= 0.012797 * r[3] * u**2 * plane.deflection
    righting = 0.156276 * r[3] * np.cross(DOWN, to_body(stand, state, DOWN))
    return M, right + np.concatenate([np.zeros(3), righting])


PAPERS = {"nps_auv2": nps, "remus100": remus, "dsrv": dsrv}


@pytest.mark.parametrize("name", PAPERS)
def test_stand_is_the_published_vehicle(name: str) -> None:
    """The wrench K V* that the C needs is the paper's, relative to the sum of its terms."""
    text = (VEHICLES / f"{name}.toml").read_text(encoding="utf-8")
    deflections = iter((0.1, -0.2, 0.15, -0.05))
    stand = loads(
        re.sub(
            "deflection = 0.0",
            lambda _: f"deflection = {next(deflections)}",
            text.replace("speed = 0.0", "speed = 150.0"),
        )
    )
    assert len(deflected(stand)) == text.count("[[fin]]") > 0
    program = CBackend(stand)
    assert not [line for line in summarize(stand).warnings if "added mass" in line]
    for number in range(8):
        state = ahead(random_state(stand, np.random.default_rng(number)))
        M, right = PAPERS[name](stand, state)
        right = right + np.array(state.wrench["carrier"])  # of planes and propeller
        for answers in (program.evaluate(state, ["forward"]), evaluate(stand, state, ["forward"])):
            V_dot = np.array(answers["V_dot"])
            scale = np.abs(M) @ np.abs(V_dot) + np.abs(right)
            assert np.max(np.abs(M @ V_dot - right) / scale) < AGREEMENT


def ahead(state: State) -> State:
    """The state with u above 0: the race of NPS AUV II is published for n and u of the same sign."""
    u, v, w, p, q, r = state.V
    return replace(state, V=(abs(u), v, w, p, q, r))


@pytest.mark.slow
@pytest.mark.parametrize("name", PAPERS)
def test_the_c_of_a_vehicle_is_verified(name: str) -> None:
    report = verify_c(load(VEHICLES / f"{name}.toml"), count=20)
    assert report.passed, conclusion(report)
