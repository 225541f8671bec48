"""Conditions that make a body and a whole stand physical; its own code, shared with no derivation.

The mass matrix of all (6 + N) motions, scaled to unit diagonal, has a least eigenvalue over all phases. It is singular
exactly where its Schur complement (flywheels eliminated) is: a 6x6 that is a constant plus one term a flywheel, each of
its own phase only. For a fixed direction x every phase can then be minimised by itself, and for fixed phases x is an
eigenvector; the two in turn go down, from many starts, fast at any N. The answer is the eigenvalue of the full matrix
at the worst phases found.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand.columns import Column, numbers, values_of
from mahovik.core.stand.datasheet import Moments
from mahovik.core.stand.hold import twists
from mahovik.core.stand.laws import body_laws
from mahovik.core.stand.masses import (
    cross,
    inertia_about_center,
    inertia_about_origin,
    mount_of,
    placement,
    transfer,
)
from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Stand
from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import INERTIA

Array = NDArray[np.float64]

LEAST_EIGENVALUE = 1e-12  # docs/limits.md, The definiteness check
RELATIVE = 1e-9  # a flat disc, rounded, is a body

MOST_CONDITION = 5e5
"""Largest condition of S^T D S of a basis: a double has ten digits left, where two rows differ by a 350th."""


LARGEST = BOUNDS["MAX_PARAMETER"].value
"""SI; mass properties and lengths up to here are taken by the emitted C (MAX_PARAMETER)."""


UNITS = {"mass": "kg", "center_of_mass": "m", "inertia": INERTIA.si, "position": "m"}
"""SI units of what `check_size` looks at; the rest mixes units."""


def check_size(body: Body, where: str, problems: Problems, moments: Moments | None = None) -> bool:
    """Note a number of a body that is beyond what the emitted C takes. Whether all are within."""
    shown = moments or Moments()
    numbers: dict[str, object] = {"mass": body.mass, "center_of_mass": body.center_of_mass, "inertia": body.inertia}
    for kind in body_laws():
        numbers |= {key: getattr(law, key) for key in kind.limited if (law := body.law(kind)) is not None}
    if isinstance(body, Instrument | Flywheel):
        numbers["position"] = body.position
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        numbers["added_mass"] = body.added_mass
    for key, value in numbers.items():
        largest = float(np.abs(np.array(value)).max())
        if largest > LARGEST:
            unit = UNITS.get(key, "in SI")
            problems.add(
                where,
                shown.place if key == "inertia" else key,
                f"{largest:.6g} {unit} is beyond the range of the emitted C, expected at most {LARGEST:g} {unit}",
            )
            return False
    return True


def check_body(body: Body, where: str, problems: Problems, moments: Moments | None = None, advice: str = "") -> None:
    """Note what is unphysical in one body.

    moments  how the messages show moments of inertia; None: in SI
    advice   what is expected if the triangle inequality is broken; "": two moments that would keep it
    """
    shown = moments or Moments()
    if not check_size(body, where, problems, shown):
        return
    central, at_origin = inertia_about_center(body), inertia_about_origin(body)
    scale = max(float(np.abs(np.array(body.inertia)).max()), float(np.abs(central).max()))
    if scale > 0.0:
        a, b, c = np.linalg.eigvalsh(central / scale) * scale
        if a < -RELATIVE * scale:
            problems.add(
                where,
                shown.place,
                "Theta is not positive semidefinite, a principal moment about the centre of mass is "
                f"{shown.number(a)} {shown.unit}, expected none below 0",
            )
        elif a + b < c - RELATIVE * scale:
            problems.add(
                where,
                shown.place,
                "principal moments about the centre of mass break the triangle inequality, "
                f"{shown.broken_inequality(a, b, c)}{f'; {advice}' if advice else f', {shown.condition(a, c)}'}",
            )
    for kind in body_laws():
        if (law := body.law(kind)) is not None and (problem := law.problem(body)) is not None:
            problems.add(where, *problem)
    if isinstance(body, Flywheel) and not at_origin[0, 0] > 0.0:
        problems.add(
            where,
            shown.place,
            "a flywheel needs inertia about its own axis, "
            f"J11 at the origin is {shown.number(at_origin[0, 0])} {shown.unit}, expected above 0",
        )
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        _check_added_mass(np.array(body.added_mass), where, problems)


def _check_added_mass(added: Array, where: str, problems: Problems) -> None:
    diagonal = np.diag(added)
    if (diagonal < 0).any():
        i = int(np.argmin(diagonal))
        sign = ""
        if (diagonal <= 0).all():
            sign = ": published derivatives (X_udot, ...) are negative, added mass is minus these; expected other signs"
        problems.add(where, "added_mass", f"not positive semidefinite, [{i}][{i}] = {diagonal[i]:.6g}{sign}")
        return
    for i, j in zip(*np.nonzero(added), strict=True):
        if not diagonal[i] > 0:
            reason = f"not positive semidefinite, [{i}][{i}] = 0 but [{i}][{j}] = {added[i, j]:.6g}"
            problems.add(where, "added_mass", reason)
            return
    # unit diagonal first: kg and kg m2 have no common size
    root = np.where(diagonal > 0, np.sqrt(diagonal), 1.0)
    least = np.linalg.eigvalsh(added / root[:, None] / root[None, :])[0]
    if least < -RELATIVE:
        problems.add(where, "added_mass", f"not positive semidefinite, least eigenvalue at unit diagonal {least:.6g}")


def check_stand(stand: Stand, problems: Problems) -> None:
    """Note what is unphysical in the stand as a whole; every body has passed `check_body`."""
    if not sum(body.mass for body in stand.bodies) > 0.0:
        problems.add("total mass is zero: there is no centre of mass")
        return
    with np.errstate(all="ignore"):  # numbers near the ends of double precision
        if _moved_everywhere(stand, 1, _FAR)[0]:
            _check_basis(stand, problems)
            return
        try:
            least, phases = least_eigenvalue(stand)
        except np.linalg.LinAlgError:
            least, phases = -np.inf, ()
    if least >= LEAST_EIGENVALUE:
        _check_basis(stand, problems)
        return
    if np.isfinite(least):
        at = ", ".join(f"{f.name} = {phi:.4g}" for f, phi in zip(stand.flywheels, phases, strict=True))
        defect = f"the eigenvalue {least:.3g}{' at phases ' + at if at else ''}"
    else:
        defect = "a zero on its diagonal, or overflows"
    problems.add(
        f"mass matrix of the whole stand, scaled to unit diagonal, has {defect}, "
        f"expected eigenvalues of at least {LEAST_EIGENVALUE:g}: some motion has no inertia"
    )


def _check_basis(stand: Stand, problems: Problems) -> None:
    """Note rows of a basis that are so nearly dependent that digits of the motion would be lost."""
    if stand.hold is None or all(freedom.kind != "twist" for freedom in stand.hold.freedoms):
        return
    with np.errstate(all="ignore"):
        condition = condition_of_twists(stand, twists(stand.hold))
    if condition > MOST_CONDITION:
        shown = f"condition {condition:.2g}" if np.isfinite(condition) else "a condition that no double can tell"
        problems.add(
            "hold",
            "basis",
            f"rows are nearly dependent, by masses and inertias as units they have {shown}, expected at most "
            f"{MOST_CONDITION:g}: say the same motions by rows that differ more, such as by the difference of two rows "
            "in place of one of them",
        )


# -- least eigenvalue of the mass matrix of the whole stand ------------------------------------------------------------

_STARTS = 32
_ROUNDS = 20
_POLISH_COUNT = 6
_STEPS = 10
_GRID = 32
_SEED = 1986


def least_eigenvalue(stand: Stand) -> tuple[float, tuple[float, ...]]:
    """Least eigenvalue found, and the phases (rad) where; -inf where a diagonal element is zero or not finite.

    Where a diagonal element nearly vanishes at some phase, scaling to unit diagonal there would hide it: the
    eigenvalue is taken with the diagonal's mean over the phases as well, and the lesser of the two is returned.
    """
    constant, rotors = _fixed_inertia(stand), _Rotors(stand)
    mean = constant + rotors.mean
    diagonal = np.diag(mean)
    at_zero = (0.0,) * len(stand.flywheels)
    if not (diagonal > 0).all() or not np.isfinite(mean).all():
        return -np.inf, at_zero
    scale = 1.0 / np.sqrt(diagonal)
    candidates: list[Array] = [np.zeros(len(stand.flywheels))]
    if stand.flywheels:
        scaling = scale[:, None] * scale[None, :]
        harmonics = rotors.schur * scaling
        if not np.isfinite(harmonics).all():
            return -np.inf, at_zero
        starts = _alternate(constant * scaling, harmonics)
        candidates += list(_polish(constant * scaling, rotors, scale, starts))
    values = [_eigenvalue(constant, rotors, phases, scale) for phases in candidates]
    worst = int(np.argmin(values))
    return values[worst], tuple(float(x) for x in np.mod(candidates[worst], 2 * np.pi))


def condition_of_twists(stand: Stand, S: Array) -> float:
    """Condition of S^T D S, scaled to unit diagonal, D the diagonal of K averaged over phases; inf: hidden by rounding.

    S (6xm): twists of O1 in E1. Whoever solves for a motion along them loses as many digits. What a far centre of mass
    couples is not counted: it is the stand's, whichever twists say the same motions.
    """
    along = (S.T * np.diag(_fixed_inertia(stand) + _Rotors(stand).mean)) @ S
    diagonal = np.diag(along)
    if not (diagonal > 0).all() or not np.isfinite(along).all():
        return np.inf
    values = np.linalg.eigvalsh(along / np.sqrt(np.outer(diagonal, diagonal)))
    return float(values[-1] / values[0]) if values[0] > 1e-15 else np.inf


def _alternate(constant: Array, harmonics: Array) -> Array:
    """Phases (starts, N) of the lowest Schur complements; `harmonics` (N, 5, 6, 6) of 1, cos, sin, cos 2, sin 2."""
    rng = np.random.default_rng(_SEED)
    x = rng.normal(size=(_STARTS, 6))
    grid: Array = np.arange(_GRID, dtype=np.float64) * (2 * np.pi / _GRID)
    table, flat = _basis(grid), harmonics.reshape(-1, 36)
    for _ in range(_ROUNDS):
        quadratic = ((x[:, :, None] * x[:, None, :]).reshape(-1, 36) @ flat.T).reshape(len(x), -1, 5)
        phases = grid[np.argmin(quadratic @ table.T, axis=-1)]
        for _ in range(3):
            phases = phases - _newton_step(quadratic, phases)
        terms = (_basis(phases).reshape(len(x), -1) @ flat).reshape(-1, 6, 6)
        values, vectors = np.linalg.eigh(constant + terms)
        x = vectors[:, :, 0]
    order = np.argsort(values[:, 0])
    return np.asarray(phases[order[:_POLISH_COUNT]], dtype=np.float64)


def _polish(constant: Array, rotors: _Rotors, scale: Array, phases: Array) -> Array:
    """Gauss-Newton on |W_s R^T(phi_s) L^T x|^2: where the least value is zero, alternation only creeps to it.

    The residuals are linear in x, so each step is again an eigenvector, of the sum projected off the phases' columns.
    """
    W, down = rotors.root, np.swapaxes(rotors.mount, 1, 2) * scale
    values, x = _lowest(constant, _residual(W, down, phases, 0))
    for _ in range(_STEPS):
        rows, slopes = _residual(W, down, phases, 0), _residual(W, down, phases, 1)
        a = np.einsum("bnij,bj->bni", slopes, x)
        square = np.einsum("bni,bni->bn", a, a)
        inverse = np.divide(1.0, square, out=np.zeros_like(square), where=square > 1e-12)
        along = np.einsum("bni,bnij->bnj", a, rows) * np.sqrt(inverse)[..., None]
        projected = np.einsum("bnki,bnkj->bij", rows, rows) - np.einsum("bni,bnj->bij", along, along)
        y = np.linalg.eigh(constant + projected)[1][:, :, 0]
        step = np.einsum("bni,bnij,bj->bn", a, rows, y, optimize=True) * inverse
        step *= np.sign(np.einsum("bi,bi->b", x, y))[:, None]
        trial = phases - np.clip(step, -0.5, 0.5)
        trial_values, trial_x = _lowest(constant, _residual(W, down, trial, 0))
        better = trial_values < values
        phases = np.where(better[:, None], trial, phases)
        x = np.where(better[:, None], trial_x, x)
        values = np.where(better, trial_values, values)
    return phases


def _residual(W: Array, down: Array, phases: Array, derivative: int) -> Array:
    """W_s R^T(phi_s) L^T (starts, N, 6, 6), or its derivative by the phase."""
    return np.asarray(W @ np.swapaxes(_turns(phases, derivative), -1, -2) @ down, dtype=np.float64)


def _turns(phases: Array, derivative: int = 0) -> Array:
    """diag(C1, C1) of each phase (..., 6, 6), or its derivative by the phase."""
    c, s = np.cos(phases), np.sin(phases)
    turns = np.zeros((*phases.shape, 6, 6))
    if derivative:
        c, s = -s, c
    for block in (0, 3):
        turns[..., block, block] = 0.0 if derivative else 1.0
        turns[..., block + 1, block + 1] = turns[..., block + 2, block + 2] = c
        turns[..., block + 1, block + 2], turns[..., block + 2, block + 1] = -s, s
    return turns


def _lowest(constant: Array, rows: Array) -> tuple[Array, Array]:
    values, vectors = np.linalg.eigh(constant + np.einsum("bnki,bnkj->bij", rows, rows))
    return values[:, 0], vectors[:, :, 0]


def _basis(phases: Array) -> Array:
    columns = [np.ones_like(phases), np.cos(phases), np.sin(phases), np.cos(2 * phases), np.sin(2 * phases)]
    return np.stack(columns, axis=-1)


def _newton_step(q: Array, phases: Array) -> Array:
    """Newton step to the minimum of a trigonometric polynomial, at most a grid cell; zero where it is flat."""
    c, s = np.cos(phases), np.sin(phases)
    c2, s2 = (c - s) * (c + s), 2 * s * c
    slope = -q[..., 1] * s + q[..., 2] * c - 2 * q[..., 3] * s2 + 2 * q[..., 4] * c2
    bend = -q[..., 1] * c - q[..., 2] * s - 4 * q[..., 3] * c2 - 4 * q[..., 4] * s2
    step = np.divide(slope, bend, out=np.zeros_like(slope), where=bend > 1e-300)
    return np.asarray(np.clip(step, -2 * np.pi / _GRID, 2 * np.pi / _GRID))


def _eigenvalue(constant: Array, rotors: _Rotors, phases: Array, mean_scale: Array) -> float:
    """Least eigenvalue of the full matrix at these phases, at unit diagonal and at unit mean diagonal."""
    full = np.zeros((6 + len(phases), 6 + len(phases)))
    L, Theta = rotors.mount @ _turns(phases), rotors.Theta
    full[:6, :6] = constant + (L @ Theta @ np.swapaxes(L, -1, -2)).sum(axis=0)
    full[:6, 6:] = (L @ Theta[:, :, 3:4])[:, :, 0].T
    full[6:, :6] = full[:6, 6:].T
    full[range(6, len(full)), range(6, len(full))] = Theta[:, 3, 3]
    diagonal = np.diag(full)
    if not (diagonal > 0).all() or not np.isfinite(full).all():
        return -np.inf
    by_diagonal = 1.0 / np.sqrt(diagonal)
    scales = (by_diagonal, np.concatenate([mean_scale, by_diagonal[6:]]))
    return min(_least(full * scale[:, None] * scale[None, :]) for scale in scales)


def _least(scaled: Array) -> float:
    """Least eigenvalue of [[A, B], [B^T, E]], A 6x6: it is that of [[A, R^T], [R, E]] with B^T = Q R, or 1."""
    if len(scaled) <= 12:
        return float(np.linalg.eigvalsh(scaled)[0])
    R: Array = np.asarray(np.linalg.qr(scaled[6:, :6], mode="r"), dtype=np.float64)
    small = np.block([[scaled[:6, :6], R.T], [R, np.eye(6)]])
    return min(1.0, float(np.linalg.eigvalsh(small)[0]))


class _Rotors:
    """The N flywheels, along the first axis: transfer from the frame at phi_s = 0 to E1, spatial inertia, harmonics."""

    def __init__(self, stand: Stand) -> None:
        outer = {instrument.name: transfer(*placement(instrument)) for instrument in stand.instruments}
        mounts = [outer.get(s.mount, np.eye(6)) @ transfer(*placement(s)) for s in stand.flywheels]
        self.mount = np.array(mounts).reshape(-1, 6, 6)
        self.Theta = np.array([_spatial(s) for s in stand.flywheels]).reshape(-1, 6, 6)
        row, diagonal = self.Theta[:, 3], np.diagonal(self.Theta, axis1=1, axis2=2)
        free = self.Theta - (row / row[:, 3:4])[:, :, None] * row[:, None, :]
        size = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
        values, vectors = np.linalg.eigh(free / size[:, :, None] / size[:, None, :])
        # root^T root = free
        self.root = np.sqrt(np.maximum(values, 0.0))[:, :, None] * np.swapaxes(vectors, 1, 2) * size[:, None, :]
        L = self.mount[:, None] @ _SAMPLES
        down = np.swapaxes(L, -1, -2)
        self.mean: Array = (L @ self.Theta[:, None] @ down).mean(axis=1).sum(axis=0)
        # five equidistant samples determine harmonics 0, 1, 2 exactly
        sampled = (L @ free[:, None] @ down).reshape(-1, 5, 36)
        self.schur = np.linalg.solve(_basis(_FIFTHS), sampled).reshape(-1, 5, 6, 6)


_FIFTHS: Array = np.arange(5, dtype=np.float64) * (2 * np.pi / 5)
_SAMPLES = _turns(_FIFTHS)


def _fixed_inertia(stand: Stand) -> Array:
    total = _spatial(stand.carrier)
    for instrument in stand.instruments:
        L = transfer(*placement(instrument))
        total = total + L @ _spatial(instrument) @ L.T
    for added in (stand.carrier.added_mass, *(instrument.added_mass for instrument in stand.instruments)):
        if added is not None:
            total = total + np.array(added)
    return total


def _spatial(body: Carrier | Instrument | Flywheel) -> Array:
    first = body.mass * cross(np.array(body.center_of_mass))
    return np.block([[body.mass * np.eye(3), -first], [first, inertia_about_origin(body)]])


# -- many samples of one stand: arrays, no eigenvalues -----------------------------------------------------------------

Flags = NDArray[np.bool_]

_FIXED = 1000 * LEAST_EIGENVALUE

_FAR = 100 * RELATIVE
"""Far above what `check_body` lets bodies lack, of which `doubtful_samples` allows less."""


def doubtful_samples(stand: Stand, n: int) -> Flags:
    """Samples, of a stand with columns, that are not surely in order.

    A test that is sufficient, not necessary: what it doubts, `check_stand` decides, on the stand of that sample alone.

    Bodies: second moments about the centre of mass, P = tr(J)/2 E - J, are positive semidefinite, to less than what
    `check_body` allows. Stands: the Schur complement S of the mass matrix, flywheels eliminated, is at least the
    inertia of the carrier; scaled by a bound of the diagonal it is above `_FIXED`. Then the mass matrix at unit
    diagonal is above `_FIXED` / 50: with x = (u, w), x^T M x = u^T S u + |w + B^T u|^2, where |B|^2 <= 18, as
    nonnegative harmonics up to the second are at most three times their mean.
    """
    sure = np.ones(n, dtype=np.bool_)
    with np.errstate(all="ignore"):
        varied = [body for body in stand.bodies if _vary(body)]
        for body in varied:
            sure &= _possible(body, n)
        if varied:
            sure &= _moved_everywhere(stand, n)
    if stand.tasks and any(isinstance(x, Column) for x in _places_of_tasks(stand)):
        sure[:] = False
    return ~sure


def _vary(value: Any) -> bool:
    return any(isinstance(x, Column) for x in numbers(value))


def _places_of_tasks(stand: Stand) -> Iterator[Any]:
    """Numbers of where the rows of tasks are: whether these go together, only `task` says."""
    named = {row.of for task in stand.tasks for row in task.rows}
    yield from (x for body in stand.instruments for x in numbers((body.position, body.angles)))
    yield from (x for p in stand.points if p.name in named for x in numbers((p.position, p.angles)))


def _samples(value: Any, n: int) -> Array:
    """Numbers of all samples (n), vectors (n, 3) or matrices (n, 3, 3)."""
    if isinstance(value, tuple | list):
        return np.stack([_samples(entry, n) for entry in value], axis=1)
    return values_of(value, n)


def _possible(body: Body, n: int) -> Flags:
    sure = np.ones(n, dtype=np.bool_)
    for x in numbers(body):
        sure &= np.abs(values_of(x, n)) <= LARGEST
    J, central, scale = _tensors(body, n)
    half = np.trace(central, axis1=1, axis2=2) / 2 + 0.4 * RELATIVE * scale
    sure &= (scale == 0.0) | _definite(half[:, None, None] * np.eye(3) - central)
    if isinstance(body, Flywheel):
        sure &= (J[:, 0, 0] > RELATIVE * scale) & (scale > 0.0)
    if isinstance(body, Carrier | Instrument) and _vary(body.added_mass):
        added = _samples(body.added_mass, n)
        kept = np.flatnonzero(added.any(axis=(0, 2)))  # rows without any number are left out
        sure &= _definite((added * (1.0 + 0.4 * RELATIVE * np.eye(6)))[:, kept][:, :, kept])
    return sure


def _tensors(body: Body, n: int) -> tuple[Array, Array, Array]:
    """Inertia about the origin (n, 3, 3), about the centre of mass, and the size of both (n)."""
    m, c, typed = _samples(body.mass, n), _samples(body.center_of_mass, n), _samples(body.inertia, n)
    outer = c[:, :, None] * c[:, None, :]
    shift = m[:, None, None] * (np.trace(outer, axis1=1, axis2=2)[:, None, None] * np.eye(3) - outer)
    about_center = body.inertia_about == "center_of_mass"
    J, central = (typed + shift, typed) if about_center else (typed, typed - shift)
    return J, central, np.maximum(np.abs(typed).max(axis=(1, 2)), np.abs(central).max(axis=(1, 2)))


def _definite(matrices: Array) -> Flags:
    """Are symmetric matrices (n, k, k) positive definite? By the pivots of elimination."""
    sure = np.ones(len(matrices), dtype=np.bool_)
    for i in range(matrices.shape[1]):
        pivot = matrices[:, i, i]
        sure &= pivot > 0.0
        matrices = matrices - matrices[:, :, i, None] * matrices[:, None, i] / pivot[:, None, None]
    return sure


def _moved_everywhere(stand: Stand, n: int, least: float = _FIXED) -> Flags:
    """Has every motion of the carrier inertia by the carrier alone, for all phases? `least`: a share of the whole."""
    diagonal = np.zeros((n, 6))
    for body in stand.bodies:
        m, (_, central, _) = _samples(body.mass, n), _tensors(body, n)
        mount = mount_of(stand, body) if isinstance(body, Flywheel) else None
        places = (getattr(placed, "position", (0.0,) * 3) for placed in (body, mount))
        reach = sum(np.linalg.norm(_samples(place, n), axis=1) for place in (body.center_of_mass, *places))
        moment = np.abs(np.diagonal(central, axis1=1, axis2=2)).sum(axis=1) + m * reach**2
        diagonal += np.repeat(np.stack([m, moment], axis=1), 3, axis=1)
        if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
            diagonal += np.abs(np.diagonal(_samples(body.added_mass, n), axis1=1, axis2=2))
    scale = 1.0 / np.sqrt(diagonal)
    m, c = _samples(stand.carrier.mass, n), _samples(stand.carrier.center_of_mass, n)
    theta = np.zeros((n, 6, 6))
    theta[:, :3, :3] = m[:, None, None] * np.eye(3)
    theta[:, 3:, :3] = m[:, None, None] * np.cross(np.eye(3), c[:, None, :])
    theta[:, :3, 3:] = np.swapaxes(theta[:, 3:, :3], 1, 2)
    theta[:, 3:, 3:] = _tensors(stand.carrier, n)[0]
    return _definite(theta * scale[:, :, None] * scale[:, None, :] - least * np.eye(6))
