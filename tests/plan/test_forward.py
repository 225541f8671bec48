"""(8) forward in time against the literal reference: acceleration, course, rest, sensitivity."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.errors import CheckError
from mahovik.plan.array import Array
from mahovik.plan.forward import Carrier, apart, drive, equilibrium, linearise, sensitivity, simulate
from mahovik.plan.forward.carrier import acceleration
from mahovik.plan.residual import Mechanics
from mahovik.reference import pieces
from mahovik.reference.forward import forward
from mahovik.stand.model import Stand
from mahovik.stand.random import BARE, EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.stand.state import State

KINDS = [replace(EVERYTHING, angles=s) for s in SEQUENCES] + [BARE, Features(), Features()]
HELD = replace(EVERYTHING, legs=0, stream=False)


def state_of(carrier: Carrier, phi: Array, phi_dot: Array) -> State:
    """One state of a carrier and its flywheels for the reference."""
    x, y, z, w = Rotation.from_matrix(carrier.C[0]).as_quat()
    zeros = (0.0,) * len(phi)
    return State(
        tuple(carrier.O1[0]), None, (w, x, y, z), tuple(carrier.V[0]), tuple(phi), tuple(phi_dot), zeros,
        (0.0,) * 6, zeros,
    )  # fmt: skip


def literal(stand: Stand, carrier: Carrier, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """V* (6) by the reference."""
    return forward(pieces(stand, state_of(carrier, phi, phi_dot)), phi_ddot)


def some(rng: np.random.Generator, M: int) -> Carrier:
    """Random states of a carrier."""
    return Carrier(rng.normal(size=(M, 3)) * 0.1, Rotation.random(M, rng).as_matrix(), rng.normal(size=(M, 6)))


@pytest.mark.parametrize("number", range(12))
def test_acceleration_is_that_of_the_reference(number: int) -> None:
    """On stands of all kinds, several states at once."""
    rng = np.random.default_rng(200 + number)
    stand = random_stand(rng, 1 + number % 6, KINDS[number % len(KINDS)])
    N, M = len(stand.flywheels), 3
    states = some(rng, M)
    phi, phi_dot, phi_ddot = (rng.normal(size=(M, N)) * size for size in (3.0, 60.0, 900.0))
    mechanics = Mechanics.of(stand)
    found = acceleration(mechanics, drive(mechanics, phi, phi_dot, phi_ddot), states)
    for m in range(M):
        expected = literal(stand, states[m : m + 1], phi[m], phi_dot[m], phi_ddot[m])
        assert abs(found[m] - expected).max() <= 1e-10 * abs(expected).max()


def wave(t: Array, N: int, shift: float = 0.0) -> tuple[Array, Array, Array]:
    """A smooth motion of N flywheels (M, N each), moved by `shift` in its first angle."""
    k = 5.0 + np.arange(N)
    first = np.zeros(N)
    first[0] = shift
    angle = np.outer(t, k)
    return np.sin(angle) + first * (1 + t[:, None]), k * np.cos(angle) + first, -(k**2) * np.sin(angle)


def test_course_is_that_of_an_adaptive_integration() -> None:
    """Every kind of wrench, 0.04 s: against SciPy on the reference, with quaternions."""
    rng = np.random.default_rng(5)
    stand = random_stand(rng, 3, EVERYTHING)
    mechanics = Mechanics.of(stand)
    start = some(rng, 1)
    n, until = 80, 0.04
    t = np.linspace(0.0, until, 2 * n + 1)
    given = drive(mechanics, *(x[:, None] for x in wave(t, 3)))
    final = simulate(mechanics, given, start, until / n)[-1]

    def rate(at: float, y: Array) -> Array:
        C = Rotation.from_quat(y[3:7]).as_matrix()
        here = Carrier(y[None, :3], C[None], y[None, 7:])
        V_dot = literal(stand, here, *(x[0] for x in wave(np.array([at]), 3)))
        x, y1, z, w = y[3:7]
        p, q, r = y[10:]
        turning = [w * p + y1 * r - z * q, w * q + z * p - x * r, w * r + x * q - y1 * p, -x * p - y1 * q - z * r]
        return np.concatenate([C @ y[7:10], 0.5 * np.array(turning), V_dot])

    y0 = np.concatenate([start.O1[0], Rotation.from_matrix(start.C[0]).as_quat(), start.V[0]])
    end = solve_ivp(rate, (0.0, until), y0, method="DOP853", rtol=1e-8, atol=1e-10).y[:, -1]
    expected = Carrier(end[None, :3], Rotation.from_quat(end[3:7]).as_matrix()[None], end[None, 7:])
    assert abs(apart(final, expected)).max() <= 2e-7


def test_sensitivity_is_that_of_differences() -> None:
    """Of the start and of the flywheels' motion, at the end of a course."""
    rng = np.random.default_rng(9)
    stand = random_stand(rng, 2, EVERYTHING)
    mechanics = Mechanics.of(stand)
    start = some(rng, 1)
    n, until, eps = 200, 0.1, 1e-5
    t = np.linspace(0.0, until, 2 * n + 1)

    def end(begin: Carrier, shift: float) -> Carrier:
        given = drive(mechanics, *(x[:, None] for x in wave(t, 2, shift)))
        return simulate(mechanics, given, begin, until / n)[-1]

    motion = wave(t[::2], 2)
    course = simulate(mechanics, drive(mechanics, *(x[:, None] for x in wave(t, 2))), start, until / n)
    found = linearise(mechanics, drive(mechanics, *motion), course[:, 0], motion[2])
    moved = wave(t[::2], 2, 1.0)
    push = np.zeros((n + 1, 6, 13))
    for B, before, after in zip((found.by_phi, found.by_phi_dot), motion, moved, strict=False):
        push[:, :, 12] += B[:, :, 0] * (after - before)[:, :1]
    x0 = np.hstack([np.eye(12), np.zeros((12, 1))])
    exact = sensitivity(found, push, x0, 2 * until / n)[-1]
    for column in range(13):
        step = eps * x0[:, column]
        shifts = eps if column == 12 else 0.0
        ahead, behind = (
            end(start.displaced(sign * step[None, :6])._replace(V=start.V + sign * step[6:]), sign * shifts)
            for sign in (1.0, -1.0)
        )
        difference = apart(ahead, behind)[0] / (2 * eps)
        assert abs(exact[:, column] - difference).max() <= 1e-4 * abs(exact[:, column]).max()


@pytest.mark.parametrize("seed", range(3))
def test_rest_is_rest_and_moves_with_the_angles(seed: int) -> None:
    """By the reference nothing accelerates there; its derivative is that of differences."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, 3, HELD)
    mechanics = Mechanics.of(stand)
    near = Carrier(np.zeros((1, 3)), np.eye(3)[None], np.zeros((1, 6)))
    phi = rng.normal(size=3)
    found = equilibrium(mechanics, phi, near)
    zero = np.zeros(3)
    assert abs(literal(stand, found.state, phi, zero, zero)).max() <= 1e-8
    for s in range(3):
        step = 1e-5 * np.eye(3)[s]
        ahead, behind = (equilibrium(mechanics, phi + d, found.state).state for d in (step, -step))
        difference = apart(ahead, behind)[0, :6] / 2e-5
        assert abs(found.by_phi[:, s] - difference).max() <= 1e-5 * abs(found.by_phi[:, s]).max()


def test_a_stand_that_falls_has_no_rest() -> None:
    """Weight and nothing that carries it: said in one line."""
    stand = random_stand(np.random.default_rng(1), 2, replace(BARE, gravity=True))
    near = Carrier(np.zeros((1, 3)), np.eye(3)[None], np.zeros((1, 6)))
    with pytest.raises(CheckError, match="nothing holds it"):
        equilibrium(Mechanics.of(stand), np.zeros(2), near)
