"""Terms of the equations as vectors, body by body: of Newton and Euler, of (8) as printed, and every wrench of (7).

A wrong factor of such a term is dozens of wrong products. It shows in all equations of which the body is a part.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Flywheel
from mahovik.core.stand.state import State
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import Phi, f, spin

MOST = 2
"""Wrong terms that are looked for at once."""

ROWS = 40
"""States by which they are looked for."""

DRIVE = "J11 phi_ddot of the drive alone"
"""The spin inertia as the drive feels it: an armature that does not turn with the rotor's frame is a part of it."""

ZERO = 1e-9
"""Part of the largest term of a component below which another is rounding."""

SAME = 1e-9
"""Square of the sine of two columns below which they are one."""

Wrench = tuple[Array, Array]
"""Force and moment (3; N, N m) in E1, about the mass centre or another stated point."""


@dataclass(frozen=True, eq=False)
class BodyTerm:
    """A term on the left-hand side of the equations, at n states.

    name      the term, with e the spin axis and r from the origin of the body to its mass centre
    bodies    those that have it; `expected`: its factor in the right equations
    on_O1     (n, 6) in E1 about O1; on_Os (N, n, 6) of each flywheel in E1 about its origin
    """

    name: str
    bodies: str
    expected: float
    on_O1: Array
    on_Os: Array


@dataclass(frozen=True)
class WrongBodyTerm:
    """A term and its factor in a program, where the right one is `term.expected`."""

    term: BodyTerm
    factor: float


def body_terms(states: Sequence[State], at: Sequence[Pieces]) -> list[BodyTerm]:
    """All terms at states with their accelerations: of all bodies, of all flywheels, of each body."""
    N = len(at[0].flywheels)
    found: dict[tuple[str, str, float], tuple[Array, Array]] = {}
    for i, (state, p) in enumerate(zip(states, at, strict=True)):
        V_dot = np.array(state.V_dot)
        bodies: tuple[PlacedBody, ...] = (*p.flywheels, *p.fixed)
        for s, k in enumerate(bodies):
            for name, expected, on_body in _terms(k, p, V_dot, state.phi_ddot[s] if s < N else 0.0):
                key = (name, k.body.name, expected)
                on_O1, on_Os = found.setdefault(key, (np.zeros((len(at), 6)), np.zeros((N, len(at), 6))))
                on_O1[i] = _moved(on_body, _origin(k)) if name != DRIVE else 0.0
                if s < N:
                    on_Os[s, i] = on_body
    terms = [BodyTerm(name, body, expected, *values) for (name, body, expected), values in found.items()]
    wheels = {k.body.name for k in at[0].flywheels}
    together: dict[tuple[str, str, float], list[BodyTerm]] = {}
    for each in terms:
        together.setdefault(("all bodies", each.name, each.expected), []).append(each)
        if each.bodies in wheels:
            together.setdefault(("flywheels", each.name, each.expected), []).append(each)
    sums = {
        key: BodyTerm(key[1], key[0], key[2], np.sum([x.on_O1 for x in own], 0), np.sum([x.on_Os for x in own], 0))
        for key, own in together.items()
        if len(own) > 1
    }
    same = {key for key, own in together.items() if key[0] == "all bodies" and {x.bodies for x in own} <= wheels}
    wholes = sorted((key for key in sums if key not in same), key=lambda key: key[0] == "all bodies")
    return [*terms, *(sums[key] for key in wholes)]


def torque_rows(terms: Sequence[BodyTerm], at: Sequence[Pieces]) -> list[Array]:
    """Columns (n, N) of the terms in the drive torques."""
    axes = np.array([[k.L[:3, 0] for k in p.flywheels] for p in at])
    return [np.einsum("nsi,sni->ns", axes, each.on_Os[:, :, 3:]) for each in terms]


def mount_rows(terms: Sequence[BodyTerm], at: Sequence[Pieces]) -> list[Array]:
    """Columns (n, 6 N) of the terms in the wrenches of mounts, in axes that do not turn."""
    turns = np.array([[C1(k.phi) @ k.L[:3, :3].T for k in p.flywheels] for p in at])
    found = []
    for each in terms:
        parts = each.on_Os.reshape(len(each.on_Os), len(at), 2, 3)
        found.append(np.einsum("nsij,snkj->nski", turns, parts).reshape(len(at), -1))
    return found


def explain(
    error: Array, columns: Sequence[Array], rounding: Array, first: Sequence[int] = ()
) -> list[tuple[int, float]]:
    """One column, or two, with their factors, that leave no more than `rounding` of an error; empty if none does.

    `first`: columns that come before others that explain it as well.
    """
    unit = np.maximum(np.sqrt(np.mean(error**2, axis=0)), rounding)
    e = (error / unit).ravel()
    limit = 4.0 * np.sqrt(float(np.mean((rounding / unit) ** 2)) * e.size)
    A = np.column_stack([(each / unit).ravel() for each in columns])
    size = np.linalg.norm(A, axis=0)
    largest = np.max([np.abs(each).max(axis=0) for each in columns], axis=0)
    there = np.array([j for j, x in enumerate(columns) if (np.abs(x).max(axis=0) > ZERO * largest).any()], dtype=int)
    A, size = A[:, there] / size[there], size[there]
    b = A.T @ e
    order = np.argsort(-np.abs(b), kind="stable")
    known = [j for j in range(len(there)) if there[j] in first]
    chosen: list[tuple[int, ...]] = [(int(j),) for j in (*known, *order[:4])]
    chosen += [(i, j) for i in known for j in known if i < j]
    G = A.T @ A
    with np.errstate(all="ignore"):
        explained = (b[:, None] ** 2 + b**2 - 2.0 * G * np.outer(b, b)) / (1.0 - G**2)
    explained = np.where(np.triu(1.0 - G**2 > SAME, 1), np.nan_to_num(explained), 0.0)
    # of pairs that explain alike, single bodies come before sums of bodies
    pairs = np.argsort(-np.round(explained / max(float(e @ e), 1e-300), 9), axis=None, kind="stable")[:4]
    chosen += [tuple(int(x) for x in np.unravel_index(k, explained.shape)) for k in pairs]
    for own in chosen:
        c = np.linalg.lstsq(A[:, own], e, rcond=None)[0]
        left = np.linalg.norm(e - A[:, own] @ c)
        if left <= min(limit, 0.01 * np.linalg.norm(e)):
            return [(int(there[j]), float(x / size[j])) for j, x in zip(own, c, strict=True)]
    return []


def _terms(k: PlacedBody, at: Pieces, V_dot: Array, phi_ddot: float) -> Iterator[tuple[str, float, Array]]:
    """Terms of one body by name with their factor: wrenches (6) in E1 about its own origin, of the left-hand side."""
    C, O = k.L[:3, :3], _origin(k)
    m, rc = k.Theta[0, 0], np.array(k.body.center_of_mass)
    r = C @ rc
    J = C @ (k.Theta[3:, 3:] - m * (rc @ rc * np.eye(3) - np.outer(rc, rc))) @ C.T
    v, w, a, alpha = at.V[:3], at.V[3:], V_dot[:3], V_dot[3:]
    forces = {
        ("m v_dot", 1.0): a,
        ("m omega x v", 1.0): np.cross(w, v),
        ("m omega_dot x O", 1.0): np.cross(alpha, O),
        ("m omega_dot x r", 1.0): np.cross(alpha, r),
        ("m omega x (omega x O)", 1.0): np.cross(w, np.cross(w, O)),
        ("m omega x (omega x r)", 1.0): np.cross(w, np.cross(w, r)),
    }
    moments = {("J omega_dot", 1.0): J @ alpha, ("omega x J omega", 1.0): np.cross(w, J @ w)}
    to_E1 = _block(C)
    if isinstance(k.body, Flywheel):
        e, speed = C[:, 0], k.phi_dot
        forces |= {
            ("m phi_ddot e x r", 1.0): phi_ddot * np.cross(e, r),
            ("m phi_dot omega x (e x r)", 2.0): speed * np.cross(w, np.cross(e, r)),
            ("m phi_dot^2 e x (e x r)", 1.0): speed**2 * np.cross(e, np.cross(e, r)),
        }
        moments |= {
            ("J e phi_ddot", 1.0): phi_ddot * J @ e,
            ("J phi_dot omega x e", 1.0): speed * J @ np.cross(w, e),
            ("phi_dot omega x J e", 1.0): speed * np.cross(w, J @ e),
            ("phi_dot e x J omega", 1.0): speed * np.cross(e, J @ w),
            ("phi_dot^2 e x J e", 1.0): speed**2 * np.cross(e, J @ e),
        }
        yield DRIVE, 1.0, np.concatenate([np.zeros(3), e * k.Theta[3, 3] * phi_ddot])
        V_s, turn = k.L.T @ at.V, k.Theta @ f
        for name, own in (
            ("Phi Ls Theta_s f phi_dot", Phi(V_s) @ turn * speed),
            ("Ls <e> Theta_s f phi_dot^2", spin @ turn * speed**2),
            ("Ls <e> Theta_s Ls^T phi_dot V", spin @ k.Theta @ V_s * speed),
            ("-Ls Theta_s <e> Ls^T phi_dot V", -k.Theta @ spin @ V_s * speed),
            ("I_s phi_ddot", turn * phi_ddot),
        ):
            yield name, 1.0, to_E1 @ own
    for (name, expected), x in forces.items():
        yield name, expected, _moved(np.concatenate([m * x, np.zeros(3)]), r)
    for (name, expected), moment in moments.items():
        yield name, expected, np.concatenate([np.zeros(3), moment])
    own = k.L.T @ at.V
    yield "Phi Theta V", 1.0, to_E1 @ Phi(own) @ k.Theta @ own
    if k.Lambda.any():
        back, V_r_dot = _moved_matrix(-O), at.V_r_dot(V_dot)
        yield "Lambda V_r_dot", 1.0, back @ k.Lambda @ V_r_dot
        p, h = np.split(k.Lambda @ at.V_r, 2)
        for name, wrench in (
            ("omega x p of Lambda V_r", np.concatenate([np.cross(at.V_r[3:], p), np.zeros(3)])),
            ("v x p of Lambda V_r", np.concatenate([np.zeros(3), np.cross(at.V_r[:3], p)])),
            ("omega x h of Lambda V_r", np.concatenate([np.zeros(3), np.cross(at.V_r[3:], h)])),
        ):
            yield name, 1.0, back @ wrench
    for kind, P in at.terms[k.body.name].items():
        if P.any():
            yield kind, 1.0, -to_E1 @ P
            yield f"force of {kind}", 1.0, -to_E1 @ np.concatenate([P[:3], np.zeros(3)])
            yield f"moment of {kind}", 1.0, -to_E1 @ np.concatenate([np.zeros(3), P[3:]])


def _origin(k: PlacedBody) -> Array:
    """Origin of a body in E1 (3, m): L = T(O) [C]."""
    S = k.L[3:, :3] @ k.L[:3, :3].T
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def _block(C: Array) -> Array:
    return np.asarray(np.kron(np.eye(2), C), dtype=np.float64)


def _moved(wrench: Array, arm: Array) -> Array:
    """A wrench (6) about a point, whose force acts at `arm` (3) from it."""
    return np.concatenate([wrench[:3], wrench[3:] + np.cross(arm, wrench[:3])])


def _moved_matrix(arm: Array) -> Array:
    """The matrix (6x6) of `_moved`."""
    x, y, z = arm
    found = np.eye(6)
    found[3:, :3] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    return found
