"""Columns that the error of a program's equations is explained by, at many states, of three kinds.

Products of velocities, accelerations, phases and attitude that the equations are sums of. Terms as vectors, body by
body, of Newton and Euler, of (8) as printed, and every wrench of (7): one is dozens of products.
Coefficients of the laws of carrier and instruments, component by component: numbers that a law's fields declare with an
error of measurement, of which the wrench is a polynomial of the second degree at most.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations_with_replacement
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.declare import Declared, Spread
from mahovik.core.stand.hold import FREEDOMS, freedom_labels, freedom_names, wrenches
from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Flywheel, Stand, State
from mahovik.proof.diagnose.causes import pairs_explain
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import C1, Array, Phi, Pose, T, block_diagonal, f, force_at, spin, twists, vector
from mahovik.proof.reference.evaluate import body_wrenches
from mahovik.proof.reference.pieces import CarrierReference, LawParts, LawTerm, PlacedBody, body_wrench

LEAST = 1e-12
"""Length below which a direction is none."""


@dataclass(frozen=True, eq=False)
class Frame:
    """Speeds that products are made of, and equations that are taken of the wrench on the carrier.

    letters     names of k speeds: letters of SNAME, or u_1, u_2, ... of freedoms without a name
    speeds      (k x 6) the speeds are this times V_r
    freedoms    (k x m) the speeds at V = S, that is at each freedom's u = 1
    components  c names of equations: letters of SNAME, or the number of a freedom without a name
    rows        (6 x c) equations = rows^T of a wrench on the carrier, in E1 about O1
    """

    letters: tuple[str, ...]
    speeds: Array
    freedoms: Array
    components: tuple[str, ...]
    rows: Array


def frame_of(stand: Stand, equations: str = "free") -> Frame:
    """Speeds and equations along what is `free`; or `all` six equations about the pivot, or what is `blocked` of them.

    In a stream the speeds are all six of the pivot, relative to the fluid.
    """
    hold, six = stand.hold, np.eye(6)
    if hold is None:
        return Frame(TWIST_LETTERS, six, six, WRENCH_LETTERS, six)
    S, W, names = twists(hold), wrenches(hold), freedom_names(hold)
    to_O1: Array = np.asarray(
        np.linalg.inv(T(vector(hold.pivot)).T), dtype=np.float64
    )  # V of a twist of the frame at the pivot with the axes of E1
    places = [list(FREEDOMS).index(name) if name in FREEDOMS else None for name in names]
    if any(stand.stream or ()) or stand.profile is not None:
        letters, speeds = tuple[str, ...](TWIST_LETTERS), np.asarray(np.linalg.inv(to_O1), dtype=np.float64)
    else:
        order = sorted(range(len(names)), key=lambda k: places[k] or 0)
        letters = tuple(f"u_{names[k]}" if (i := places[k]) is None else TWIST_LETTERS[i] for k in order)
        speeds = W[:, order].T
    if equations == "free":
        components = tuple(n if i is None else WRENCH_LETTERS[i] for n, i in zip(names, places, strict=True))
        return Frame(letters, speeds, speeds @ S, components, S)
    rows: Array = to_O1 if equations == "all" else (six - S @ W.T) @ to_O1
    there = [k for k in range(6) if np.linalg.norm(rows[:, k]) > LEAST]
    return Frame(letters, speeds, speeds @ S, tuple(WRENCH_LETTERS[k] for k in there), rows[:, there])


def frame_in_words(stand: Stand) -> tuple[str, str]:
    """The point that moments are about; and equations and speeds of a held carrier, "" of one without freedoms."""
    if stand.hold is None:
        return "O1", ""
    point, frame = "the pivot" if any(stand.hold.pivot) else "O1", frame_of(stand)
    if not stand.hold.freedoms:
        return point, ""
    labels = zip(frame.components, freedom_labels(stand.hold), strict=True)
    equations = "equations of what is free: " + ", ".join(f"{name} along {what}" for name, what in labels)
    if len(frame.letters) != len(frame.components):
        return point, f"{equations}; speeds are those of the pivot relative to the fluid"
    letters = (frame.letters[int(np.argmax(column))] for column in frame.freedoms.T)
    return point, f"{equations}; speeds: {', '.join(letters)}"


@dataclass(frozen=True, eq=False)
class Products:
    """Names of m products, their values (n, m), and which have the derivative of a velocity as a factor (m)."""

    names: tuple[str, ...]
    values: Array
    accelerate: NDArray[np.bool_]


def products(frame: Frame, states: Sequence[State], at: Sequence[Pieces], of_momentum: bool = False) -> Products:
    """All products at states, `at` their pieces: bilinear in velocities, linear in accelerations and attitude, with
    harmonics of phases; `of_momentum`: linear in velocities and stream."""
    wheels = [body.name for body in at[0].bodies.flywheels.bodies]
    phi, phi_dot, phi_ddot = (
        np.array([getattr(s, key) for s in states]).reshape(len(states), len(wheels)).T
        for key in ("phi", "phi_dot", "phi_ddot")
    )
    V = dict(zip(frame.letters, frame.speeds @ np.array([p.V_r for p in at]).T, strict=True))
    V_r_dot = np.array([p.V_r_dot(vector(s.V_dot)) for p, s in zip(at, states, strict=True)])
    V_dot = dict(zip((f"{a}_dot" for a in frame.letters), frame.speeds @ V_r_dot.T, strict=True))
    speeds = {f"{name}.speed": x for name, x in zip(wheels, phi_dot, strict=True)}
    waves = {"": np.ones(len(states))}
    for name, x in zip(wheels, phi, strict=True):
        for multiple in ("", "2 "):
            waves[f"cos {multiple}{name}"], waves[f"sin {multiple}{name}"] = (
                function((2 if multiple else 1) * x) for function in (np.cos, np.sin)
            )
    if of_momentum:
        stream = dict(zip(("stream_x", "stream_y", "stream_z"), np.array([p.u for p in at]).T, strict=True))
        return _products(_times_waves(V | speeds | (stream if any(x.any() for x in stream.values()) else {}), waves))
    g = np.array([p.gravity for p in at]).T
    size = np.linalg.norm(g, axis=0)
    down = dict(zip(("g_x", "g_y", "g_z"), g / size, strict=True)) if size.all() else {}
    two = {f"{a} {b}": V[a] * V[b] for a, b in combinations_with_replacement(frame.letters, 2)}
    table = {"1": waves[""]} | {wave: x for wave, x in waves.items() if wave} | V
    table |= {f"|{a}| {b}": np.abs(V[a]) * V[b] for a in V for b in V}
    table |= _times_waves(two | down | V_dot, waves) | speeds
    for (name, x), rate in zip(speeds.items(), phi_ddot, strict=True):
        wheel = name.removesuffix(".speed")
        of_wheel = {wave: value for wave, value in waves.items() if not wave or wave.split(" ", 1)[1] in
                    (wheel, f"2 {wheel}")}  # fmt: skip
        table |= _times_waves({f"{a} {name}": V[a] * x for a in V} | {f"{name} {name}": x * x}, of_wheel)
        table |= _times_waves(
            {f"{wheel}.acceleration": rate}, waves
        )  # of other flywheels as well: an index may be wrong
    return _products(table, V_dot)


def _times_waves(factors: Mapping[str, Array], waves: Mapping[str, Array]) -> dict[str, Array]:
    """Each factor times each harmonic."""
    return {f"{name} {wave}".strip(): x * y for wave, y in waves.items() for name, x in factors.items()}


def _products(table: Mapping[str, Array], rates: Mapping[str, Array] | None = None) -> Products:
    accelerate = np.array([name.split(" ")[0] in (rates or {}) for name in table])
    return Products(tuple(table), np.column_stack(list(table.values())), accelerate)


def count_products(stand: Stand) -> int:
    """How many products there are for a stand."""
    k, N = len(frame_of(stand).letters), len(stand.flywheels)
    waves, down = 1 + 4 * N, 3 if any(stand.gravity) else 0
    return waves + k + k**2 + waves * (k * (k + 1) // 2 + down + k) + N * (1 + 5 * (k + 1) + waves)


# -- terms of bodies ---------------------------------------------------------------------------------------------------

ROWS = 40
"""States by which they are looked for."""

DRIVE = "J11 phi_ddot of the drive alone"
"""The spin inertia as the drive feels it: an armature that does not turn with the rotor's frame is a part of it."""

RIGHT: Mapping[str, float] = {"m phi_dot omega x (e x r)": 2.0, "I_s (e . omega_dot)": 0.0}
"""Factors of terms in the right equations that are not 1; the last is there where phi_ddot is taken as absolute."""

BEYOND = 10.0
"""A component is wrong whose error is more than its rounding times this."""

ZERO, SIMPLE = 1e-9, 1e-6
"""Part of the largest term of a component below which another is rounding; rounding of twice a simple factor."""

LIKELY = 16
"""Terms, and pairs of them, that are tried: those that explain most."""

FLYWHEELS, ALL = "flywheels", "all bodies"
"""Names of sums of terms over bodies."""

Term = tuple[str, str, float]
"""Bodies that have it; the term on the left-hand side, see TERMS_OF_BODIES; its factor in the right equations."""

TERMS_OF_BODIES = "J is about the body's mass centre, J_O about its origin; r is from there to that, e the spin axis"
"""What stands in terms of bodies."""


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
    for together, names in ((FLYWHEELS, wheels), (ALL, set(at[0].terms))):
        for _, name, factor in dict.fromkeys((together, *key[1:]) for key in single):
            parts = [x for (body, *term), x in single.items() if term == [name, factor] and body in names]
            bodies = {body for body, *term in single if term == [name, factor]}
            if len(parts) > 1 and not (together == ALL and bodies <= wheels):
                sums[together, name, factor] = np.sum(parts, axis=0)
    return single | sums


@dataclass(frozen=True)
class Explanation:
    """A few terms that explain an error.

    factors  errors of their factors; those with which a factor is 0, 1 or -1 where rounding does not tell another
    left     part of the error that they leave, 0 to 1; 0 where this is rounding
    """

    factors: Mapping[Term, float]
    left: float


def is_wrong(error: Array, checked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mask of the components (c) in which an error over rounding (n, c) is more: at most rows, or at a checked one."""
    return np.asarray(
        (np.sqrt(np.mean(error[~checked] ** 2, axis=0)) > BEYOND) | (np.abs(error[checked]) > 1.0).any(axis=0)
    )


def _is_simple(factor: float) -> bool:
    """Whether a program may have this factor by a mistake: -1, 0, 1/2, ..."""
    return abs(2.0 * factor - round(2.0 * factor)) <= SIMPLE


def snapped(factor: float, unsure: float) -> float:
    """0, 1 or -1 in place of a factor that is this, but for its rounding."""
    return next((x for x in (0.0, 1.0, -1.0) if abs(factor - x) <= max(unsure, ZERO)), factor)


def explain(
    error: Array, terms: Mapping[Term, Array], noise: Array, checked: NDArray[np.bool_], first: Sequence[Term] = ()
) -> Explanation | None:
    """The fewest terms that explain an error (n, c): one, two, or one in each body; None where none do.

    noise    rounding (n, c) of a right program; checked: rows (n) of which no number may be off by more
    first    terms that come before others that explain it as well; so do those with a simple factor
    """
    largest = np.max([np.abs(x).max(axis=0) for x in terms.values()], axis=0)
    there = [term for term, x in terms.items() if (np.abs(x).max(axis=0) > ZERO * largest).any()]
    e, A = (error / noise).ravel(), np.column_stack([(terms[term] / noise).ravel() for term in there])
    size, wrong = np.linalg.norm(A, axis=0), is_wrong(error / noise, checked)
    A = A / size
    likely = np.argsort(-np.abs(A.T @ e), kind="stable")[:LIKELY].tolist()
    # of pairs that explain alike, single bodies come before sums of bodies
    explained = np.round(pairs_explain(A, e) / max(float(e @ e), 1e-300), 9)
    pairs = np.argsort(-explained, axis=None, kind="stable")[:LIKELY].tolist()
    known = [there.index(term) for term in first if term in there]
    of_wheels = [there[j][1:] for j in likely if there[j][0] == FLYWHEELS and (ALL, *there[j][1:]) not in terms]
    of_each = [[i for i, (body, *term) in enumerate(there) if body != FLYWHEELS and term == [*x]] for x in of_wheels]
    chosen = [*([j] for j in (*known, *likely)), *([i, j] for i in known for j in known if i < j)]
    chosen += [*(list(divmod(k, len(there))) for k in pairs), *of_each]
    ranks, explanations = list[tuple[Any, ...]](), list[Explanation]()
    for places in chosen:
        c = np.linalg.lstsq(A[:, places], e, rcond=None)[0]
        left = (e - A[:, places] @ c).reshape(error.shape)
        # apart, or the rounding of right components would excuse what is left of the wrong ones
        rest = [float(np.sqrt(np.mean(left[np.ix_(~checked, at)] ** 2))) for at in (wrong, ~wrong) if at.any()]
        share = float(np.linalg.norm(left[:, wrong]) / np.linalg.norm((error / noise)[:, wrong]))
        if max(rest) > 4.0 or share > 0.01:
            continue
        unsure = np.linalg.norm(np.linalg.pinv(A[:, places]), axis=1) * max(1.0, *rest)
        factors = {
            there[j]: snapped(there[j][2] + float(x), float(dx)) - there[j][2]
            for j, x, dx in zip(places, c / size[places], unsure / size[places], strict=True)
        }
        beyond = bool((np.abs(left[checked]) > 1.0).any())
        intricate = sum(not _is_simple(term[2] + x) for term, x in factors.items())
        ranks.append((beyond, len(places), not {*places} <= {*known}, intricate, len(ranks)))
        explanations.append(Explanation(factors, share if beyond else 0.0))
    return explanations[ranks.index(min(ranks))] if ranks else None


def _terms(k: PlacedBody, at: Pieces, V_dot: Array, phi_ddot: float) -> Iterator[tuple[str, float, Array]]:
    """Terms of one body, their factors: wrenches (6) of the left-hand side in its frame about its origin."""
    C, m, r = k.L[:3, :3], k.Theta[0, 0], vector(k.body.center_of_mass)
    O = axial(k.L[3:, :3] @ C.T)
    J_O = k.Theta[3:, 3:]
    inertias = {"J": J_O - m * (r @ r * np.eye(3) - np.outer(r, r)), "J_O": J_O}
    v, w, a, alpha, O = (C.T @ x for x in (at.V[:3], at.V[3:], V_dot[:3], V_dot[3:], O))
    forces: dict[str, Array] = {
        "m v_dot": a,
        "m omega x v": np.cross(w, v),
        "m omega_dot x O": np.cross(alpha, O),
        "m omega_dot x r": np.cross(alpha, r),
        "m omega x (omega x O)": np.cross(w, np.cross(w, O)),
        "m omega x (omega x r)": np.cross(w, np.cross(w, r)),
    }
    moments = {f"{J} omega_dot": x @ alpha for J, x in inertias.items()}
    moments |= {f"omega x {J} omega": np.cross(w, x @ w) for J, x in inertias.items()}
    wrenches: dict[str, Array] = {}
    V = k.L.T @ at.V
    if isinstance(k.body, Flywheel):
        e, speed, turn = f[3:], k.phi_dot, k.Theta @ f
        forces |= {
            "m phi_ddot e x r": phi_ddot * np.cross(e, r),
            "m phi_dot omega x (e x r)": speed * np.cross(w, np.cross(e, r)),
            "m phi_dot^2 e x (e x r)": speed**2 * np.cross(e, np.cross(e, r)),
        }
        for J, x in inertias.items():
            moments |= {
                f"{J} e phi_ddot": phi_ddot * x @ e,
                f"{J} phi_dot omega x e": speed * x @ np.cross(w, e),
                f"phi_dot omega x {J} e": speed * np.cross(w, x @ e),
                f"phi_dot e x {J} omega": speed * np.cross(e, x @ w),
                f"phi_dot^2 e x {J} e": speed**2 * np.cross(e, x @ e),
                f"Omega x {J} Omega": np.cross(w + speed * e, x @ (w + speed * e)),
            }
        wrenches |= {
            DRIVE: f * k.Theta[3, 3] * phi_ddot,  # before its twins in a torque, which would be wrong elsewhere as well
            "J11 e phi_ddot": f * k.Theta[3, 3] * phi_ddot,
            "Phi Ls Theta_s f phi_dot": Phi(V) @ turn * speed,
            "Ls <e> Theta_s f phi_dot^2": spin @ turn * speed**2,
            "Ls <e> Theta_s Ls^T phi_dot V": spin @ k.Theta @ V * speed,
            "-Ls Theta_s <e> Ls^T phi_dot V": -k.Theta @ spin @ V * speed,
            "I_s phi_ddot": turn * phi_ddot,
            "Theta_s (0, omega x e) phi_dot": k.Theta[:, 3:] @ np.cross(w, e) * speed,
            "I_s (e . omega_dot)": turn * float(e @ alpha),
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
            "Phi Lambda V_r": to_body @ Phi(at.V_r) @ k.Lambda @ at.V_r,
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
        yield name, RIGHT.get(name, 1.0), wrench


def axial(S: Array) -> Array:
    """The vector (3) of a matrix <a>."""
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


# -- coefficients of laws ----------------------------------------------------------------------------------------------

SEEN = 6
"""States by which it is seen whether a wrench is a polynomial of a number."""

ALIKE = 1e-10
"""Sine of the angle between columns below which they are one; part of a wrench that is rounding of its differences."""


_Change = Callable[[Any, float], Any]
"""A law with another value of one of its numbers."""


class Law:
    """A law at n states: transfer L (6x6) of the wrenches of its body, coarse parts if it has any, coefficients."""

    def __init__(
        self, laws: Sequence[Any], path: str, wrench: Callable[[int, Any], Array], L: Array, coarse: Iterable[LawTerm]
    ) -> None:
        self.L, self.coarse, self.path = L, list(coarse), path
        self._of = laws, path, wrench

    @cached_property
    def coefficients(self) -> list[LawTerm]:
        """Terms of its coefficients: made when they are asked for, as the law is evaluated for each."""
        return list(coefficients(*self._of))

    def terms(self, detail: int) -> list[LawTerm]:
        """Its parts of one detail; its coefficients, if there are none."""
        return [term for term in self.coarse if term.detail == detail] or self.coefficients


def laws_at(stand: Stand, states: Sequence[State], at: Sequence[Pieces]) -> list[Law]:
    """All laws of a stand at n states: those between E0 and the carrier, then those of each body."""
    laws, of_carrier = list[Law](), cast(tuple[Any, ...], stand.laws)
    poses = [Pose(axial(p.L1[3:, :3] @ p.C.T), p.C, p.V) for p in at]
    between = parts("reference", CarrierReference)
    coarse = {part.law: part.terms for part in parts("faults", LawParts, BODY_LAWS)}

    def on_carrier(i: int, law: Any) -> Array:
        alone = replace(stand, laws=(law,))
        return sum((body_wrench(x.wrenches(alone, states[i], poses[i])) for x in between), np.zeros(6))

    for law in of_carrier:
        path = f"hold.{law.key}" if isinstance(law, HeldLaw) else law.key
        laws.append(Law([law] * len(at), path, on_carrier, np.eye(6), ()))
    for s, k in enumerate(at[0].bodies.placed()):
        bodies, V_r = [p.bodies.bodies[s] for p in at], np.array([k.twist(p.V_r) for p in at])

        def on_body(i: int, law: Any, bodies: Any = bodies, V_r: Array = V_r) -> Array:
            alone = replace(bodies[i], laws=(law,))
            return body_wrench(body_wrenches(alone, np.zeros(3), V_r[i]))

        of_body: Any = () if isinstance(k.body, Flywheel) else k.body.laws
        for law in of_body:
            kind = type(law)
            terms = coarse[kind](bodies, V_r) if kind in coarse else ()
            laws.append(Law([b.law(kind) for b in bodies], f"{k.body.name}.{law.key}", on_body, k.L, terms))
    return laws


def coefficients(laws: Sequence[Any], path: str, wrench: Callable[[int, Any], Array]) -> Iterator[LawTerm]:
    """Terms of the coefficients of a law as it is at n states, under a path; `wrench`: of another law at a state."""
    right = np.array([wrench(i, law) for i, law in enumerate(laws)])
    for name, value, largest, changed in _numbers(laws[0], path):
        step = largest or 1.0

        def wrenches(k: int, of: int, change: _Change = changed, value: float = value, step: float = step) -> Array:
            return np.array([wrench(i, change(law, value + k * step)) for i, law in enumerate(laws[:of])])

        P0, P1, P2, P3 = right[:SEEN], *(wrenches(k, SEEN) for k in (1, 2, 3))
        small = ALIKE * float(np.abs(P3).max())
        if np.abs(P3 - 3.0 * P2 + 3.0 * P1 - P0).max() > small:
            continue
        linear = np.abs(P2 - 2.0 * P1 + P0).max() <= small
        P1 = wrenches(1, len(laws))
        square = 0.0 if linear else (wrenches(2, len(laws)) - 2.0 * P1 + right) / (2.0 * step**2)
        yield LawTerm(0, name, name, value, (P1 - right) / step - square * (2.0 * value + step))
        if not linear:
            yield LawTerm(0, f"{name}^2", name, value**2, np.asarray(square))


def _numbers(of: Any, path: str) -> Iterator[tuple[str, float, float, _Change]]:
    """Each number with an error: its path, value, the largest of its list, and what gives it another value."""
    if isinstance(of, float):
        yield path, of, abs(of), lambda _, x: x
    elif isinstance(of, tuple):
        largest = float(np.abs(of).max(initial=0.0)) if not any(isinstance(x, Declared) for x in of) else 0.0
        for i, part in enumerate(of):
            below = getattr(part, "name", f"{path}[{i}]")
            for name, value, size, change in _numbers(part, below):
                yield name, value, max(size, largest), _in_place(i, change)
    elif isinstance(of, Declared):
        for key in of.annotations():
            part = getattr(of, key)
            tables = isinstance(part, tuple) and any(isinstance(x, Declared) for x in part)
            if tables or key in of.marked(Spread):
                below = path if getattr(of, "item", None) else f"{path}.{key}"
                for name, value, size, change in _numbers(part, below):
                    yield name, value, size, _in_field(key, change)


def _in_place(i: int, change: _Change) -> _Change:
    return lambda whole, x: (*whole[:i], change(whole[i], x), *whole[i + 1 :])


def _in_field(key: str, change: _Change) -> _Change:
    return lambda whole, x: replace(whole, **{key: change(getattr(whole, key), x)})


def law_columns(laws: Sequence[Law], row: Array) -> Iterator[list[LawTerm]]:
    """Columns of the component that `row` (6) takes of the wrench: coarse parts of each law; then finer ones."""
    finest = max((term.detail for law in laws for term in law.coarse), default=-1) + 1
    for detail in range(finest + 1 if laws else 0):
        there = ((law.L, term) for law in laws for term in law.terms(detail))
        yield _merge([replace(term, wrench=term.wrench @ (row @ L)) for L, term in there])


def like_product(laws: Sequence[Law], row: Array, product: Array) -> Iterator[LawTerm]:
    """Coefficients that are there and whose column is a product at all states, with their factors in it as values."""
    for law in laws:
        for term in law.coefficients:
            column = term.wrench @ (row @ law.L)
            ratio = float(product @ column) / float(product @ product)
            if ratio * term.value and np.linalg.norm(column - ratio * product) <= ALIKE * np.linalg.norm(column):
                yield replace(term, value=ratio * term.value)


def _merge(columns: Sequence[LawTerm]) -> list[LawTerm]:
    """Without columns that are zero; columns that are proportional at all states are one, with all their names."""
    largest = max((float(np.linalg.norm(x.wrench)) for x in columns), default=0.0)
    kept: list[LawTerm] = []
    for column in columns:
        b = column.wrench
        if np.linalg.norm(b) <= ALIKE * largest:
            continue
        for i, other in enumerate(kept):
            a = other.wrench
            ratio = float(a @ b) / float(a @ a)
            if np.linalg.norm(b - ratio * a) <= ALIKE * np.linalg.norm(b):
                there = [x for x in (other, column) if x.value]  # of those that the right equations have
                if there:
                    words, path = (" or ".join(getattr(x, key) for x in there) for key in ("term", "coefficient"))
                    value = other.value + ratio * column.value
                    kept[i] = replace(other, term=words, coefficient=path, value=value)
                break
        else:
            kept.append(column)
    return kept
