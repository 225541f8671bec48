"""Terms of the equations as vectors, body by body: of Newton and Euler, of (8) as printed, and every wrench of (7).

A wrong factor of such a term is dozens of wrong products. It shows in all equations of which the body is a part.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mahovik.core.stand.model import Flywheel
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.numbers import pairs_explain
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import Phi, block_diagonal, f, force_at, spin

ROWS = 40
"""States by which they are looked for."""

DRIVE = "J11 phi_ddot of the drive alone"
"""The spin inertia as the drive feels it: an armature that does not turn with the rotor's frame is a part of it."""

ZERO = 1e-9
"""Part of the largest term of a component below which another is rounding."""

Term = tuple[str, str, float]
"""Bodies that have it; the term on the left-hand side, with e the spin axis and r from the origin of the body to its
mass centre; its factor in the right equations."""


def body_terms(states: Sequence[State], at: Sequence[Pieces], equations: str, rows: Array) -> dict[Term, Array]:
    """Columns (n, c) of all terms of each body, of all flywheels and of all bodies, in the errors of some equations.

    equations  "wrench": rows^T of it on the carrier, on the right-hand side; "torque"; "mounts"
    """
    N = len(at[0].bodies.flywheels.bodies)
    single: dict[Term, Array] = {}
    for i, (state, p) in enumerate(zip(states, at, strict=True)):
        for k in (*p.flywheels, *(k for k in p.bodies.placed() if not isinstance(k.body, Flywheel))):
            s = next((s for s, w in enumerate(p.flywheels) if w.body is k.body), None)
            for name, factor, wrench in _terms(k, p, vector(state.V_dot), 0.0 if s is None else state.phi_ddot[s]):
                if equations == "wrench":
                    row = -rows.T @ k.L @ wrench * (name != DRIVE)
                else:
                    shape = (N,) if equations == "torque" else (N, 6)
                    row = np.zeros(shape)
                    if s is not None:
                        row[s] = wrench[3] if equations == "torque" else block_diagonal(C1(k.phi)) @ wrench
                row = row.ravel()
                single.setdefault((k.body.name, name, factor), np.zeros((len(at), row.size)))[i] = row
    wheels = {body.name for body in at[0].bodies.flywheels.bodies}
    sums: dict[Term, Array] = {}
    for together, names in (("flywheels", wheels), ("all bodies", set(at[0].terms))):
        for _, name, factor in dict.fromkeys((together, *key[1:]) for key in single):
            parts = [x for (body, *term), x in single.items() if term == [name, factor] and body in names]
            bodies = {body for body, *term in single if term == [name, factor]}
            if len(parts) > 1 and not (together == "all bodies" and bodies <= wheels):
                sums[together, name, factor] = np.sum(parts, axis=0)
    return single | sums


def explain(
    error: Array, terms: Mapping[Term, Array], rounding: Array, first: Sequence[Term] = ()
) -> dict[Term, float]:
    """One term, or two, with the errors of their factors, that leave no more than `rounding` of an error (n, c).

    `first`: terms that come before others that explain it as well. Empty if none does.
    """
    unit = np.maximum(np.sqrt(np.mean(error**2, axis=0)), rounding)
    e = (error / unit).ravel()
    limit = 4.0 * np.sqrt(float(np.mean((rounding / unit) ** 2)) * e.size)
    largest = np.max([np.abs(x).max(axis=0) for x in terms.values()], axis=0)
    there = [term for term, x in terms.items() if (np.abs(x).max(axis=0) > ZERO * largest).any()]
    A = np.column_stack([(terms[term] / unit).ravel() for term in there])
    size = np.linalg.norm(A, axis=0)
    A = A / size
    b, explained = A.T @ e, pairs_explain(A, e)
    # of pairs that explain alike, single bodies come before sums of bodies
    pairs = np.argsort(-np.round(explained / max(float(e @ e), 1e-300), 9), axis=None, kind="stable")[:4]
    known = [there.index(term) for term in first if term in there]
    chosen = [(int(j),) for j in (*known, *np.argsort(-np.abs(b), kind="stable")[:4])]
    chosen += [(i, j) for i in known for j in known if i < j]  # type: ignore[misc]
    chosen += [divmod(int(k), len(there)) for k in pairs]  # type: ignore[misc]
    for places in map(list, chosen):
        c = np.linalg.lstsq(A[:, places], e, rcond=None)[0]
        if np.linalg.norm(e - A[:, places] @ c) <= min(limit, 0.01 * np.linalg.norm(e)):
            return {there[j]: float(x / size[j]) for j, x in zip(places, c, strict=True)}
    return {}


def _terms(k: PlacedBody, at: Pieces, V_dot: Array, phi_ddot: float) -> Iterator[tuple[str, float, Array]]:
    """Terms of one body, their factors: wrenches (6) of the left-hand side in its frame about its origin."""
    C, m, r = k.L[:3, :3], k.Theta[0, 0], vector(k.body.center_of_mass)
    O = axial(k.L[3:, :3] @ C.T)
    J = k.Theta[3:, 3:] - m * (r @ r * np.eye(3) - np.outer(r, r))
    v, w, a, alpha, O = (C.T @ x for x in (at.V[:3], at.V[3:], V_dot[:3], V_dot[3:], O))
    forces: dict[str, Array] = {
        "m v_dot": a,
        "m omega x v": np.cross(w, v),
        "m omega_dot x O": np.cross(alpha, O),
        "m omega_dot x r": np.cross(alpha, r),
        "m omega x (omega x O)": np.cross(w, np.cross(w, O)),
        "m omega x (omega x r)": np.cross(w, np.cross(w, r)),
    }
    moments: dict[str, Array] = {"J omega_dot": J @ alpha, "omega x J omega": np.cross(w, J @ w)}
    wrenches: dict[str, Array] = {}
    V = k.L.T @ at.V
    if isinstance(k.body, Flywheel):
        e, speed, turn = f[3:], k.phi_dot, k.Theta @ f
        forces |= {
            "m phi_ddot e x r": phi_ddot * np.cross(e, r),
            "m phi_dot omega x (e x r)": speed * np.cross(w, np.cross(e, r)),
            "m phi_dot^2 e x (e x r)": speed**2 * np.cross(e, np.cross(e, r)),
        }
        moments |= {
            "J e phi_ddot": phi_ddot * J @ e,
            "J phi_dot omega x e": speed * J @ np.cross(w, e),
            "phi_dot omega x J e": speed * np.cross(w, J @ e),
            "phi_dot e x J omega": speed * np.cross(e, J @ w),
            "phi_dot^2 e x J e": speed**2 * np.cross(e, J @ e),
        }
        wrenches |= {
            DRIVE: f * k.Theta[3, 3] * phi_ddot,  # before its twins in a torque, which would be wrong elsewhere as well
            "Phi Ls Theta_s f phi_dot": Phi(V) @ turn * speed,
            "Ls <e> Theta_s f phi_dot^2": spin @ turn * speed**2,
            "Ls <e> Theta_s Ls^T phi_dot V": spin @ k.Theta @ V * speed,
            "-Ls Theta_s <e> Ls^T phi_dot V": -k.Theta @ spin @ V * speed,
            "I_s phi_ddot": turn * phi_ddot,
        }
    zero = np.zeros(3)
    wrenches |= {name: force_at(m * x, r) for name, x in forces.items()}
    wrenches |= {name: np.concatenate([zero, x]) for name, x in moments.items()}
    wrenches["Phi Theta V"] = Phi(V) @ k.Theta @ V
    if k.Lambda.any():
        to_body = np.linalg.inv(k.L)
        p, h = np.split(k.Lambda @ at.V_r, 2)
        wrenches |= {
            "Lambda V_r_dot": to_body @ k.Lambda @ at.V_r_dot(V_dot),
            "omega x p of Lambda V_r": to_body @ np.concatenate([np.cross(at.V_r[3:], p), zero]),
            "v x p of Lambda V_r": to_body @ np.concatenate([zero, np.cross(at.V_r[:3], p)]),
            "omega x h of Lambda V_r": to_body @ np.concatenate([zero, np.cross(at.V_r[3:], h)]),
        }
    for kind, P in at.terms[k.body.name].items():
        if P.any():
            wrenches |= {
                kind: -P,
                f"force of {kind}": -np.concatenate([P[:3], zero]),
                f"moment of {kind}": -np.concatenate([zero, P[3:]]),
            }
    for name, wrench in wrenches.items():
        yield name, 2.0 if name == "m phi_dot omega x (e x r)" else 1.0, wrench


def axial(S: Array) -> Array:
    """The vector (3) of a matrix <a>."""
    return np.array([S[2, 1], S[0, 2], S[1, 0]])
