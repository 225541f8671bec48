"""Checks before any search, in less than a second: motions that no programme of these flywheels can make.

Flywheels give no mean wrench over a period, so the surroundings must carry the weight at some mean pose. Wrenches that
flywheels cannot give: directions out of their span, first moments beyond their unbalance (force is the second
derivative of sum m_s rho_s(phi_s), so total unbalance bounds the amplitude), and reach inside bounds.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from mahovik.core.stand.coordinates import coordinates_of
from mahovik.use.numeric import Array, PrescribedMotion, prescribe
from mahovik.use.plan.held import amount, slide_directions, wrench_of
from mahovik.use.plan.mean_pose import MeanPose, mean_pose
from mahovik.use.plan.problem import Problem, uniform

Reason = Literal["MEAN_WRENCH", "SPAN", "FIRST_MOMENT", "BOUND_REACH", "SEARCH", "SINGULAR_ATTITUDE"]


@dataclass(frozen=True)
class Refusal:
    """No programme exists: the message names direction, need, available amount, and what would help."""

    reason: Reason
    words: str


@dataclass
class Preflight:
    """The mean pose, a refusal or None, and warnings.

    bias   (6; m, rad): where the surroundings carry the mean wrench
    reach  used share of the first-moment limit
    hint   why a search may find nothing, in a list: worth a line only if it does
    """

    bias: Array
    refusal: Refusal | None = None
    warnings: list[str] = field(default_factory=list)
    reach: float = 0.0
    hint: tuple[str, ...] = ()


AXES = ("x", "y", "z")


def direction(u: Array) -> str:
    """A direction (3) in words: the name of an axis, else its numbers."""
    u = u / np.linalg.norm(u)
    k = int(np.argmax(np.abs(u)))
    if abs(u[k]) > 0.999:
        return AXES[k]
    return "(" + ", ".join(f"{x:.2f}" for x in np.round(u * np.sign(u[k]), 2) + 0.0) + ")"


def _largest_moment(problem: Problem) -> float:
    """Largest moment that the weights of unbalanced flywheels give, N m."""
    return float(problem.mechanics.tables.unbalance.sum() * np.linalg.norm(problem.stand.gravity))


def _uncarried_part(problem: Problem, pose: MeanPose) -> str | None:
    """`force` or `moment` that nothing carries at the mean pose; None: all is carried."""
    force, moment = (np.concatenate(each)[None] for each in ((pose.wrench[:3], _ZERO), (_ZERO, pose.wrench[3:])))
    if problem.norm.relative(force) > problem.tolerance:
        return "force"
    turning = float(np.linalg.norm(pose.wrench[3:]))
    return (
        "moment" if turning > _largest_moment(problem) and problem.norm.relative(moment) > problem.tolerance else None
    )


def _advice(problem: Problem) -> str:
    """Advice if only means that are held are in the way; else empty."""
    if problem.free.all():
        return ""
    everywhere = mean_pose(replace(problem, free=np.ones(len(problem.free), dtype=bool)))
    uncarried = _uncarried_part if problem.stand.hold is None else _uncarried_freedom
    if uncarried(problem, everywhere) is not None:
        return ""
    given = np.array(problem.motion.free_mean, dtype=bool)
    said = []
    for key, held in (("`free_mean`", np.logical_not(given)), ("a bound 0 of `bias`", given > problem.free)):
        own = coordinates_of(problem.stand).in_words
        names = ", ".join(name for name, is_held in zip(own, held, strict=True) if is_held)
        said += [f"{key} holds the mean of {names}"] if names else []
    return f"{' and '.join(said)}: free it, so that the mean pose may shift to where the surroundings carry the wrench"


_ZERO = np.zeros(3)
_TILT = 0.1
"""rad: a larger mean tilt causes a warning."""
_TELLING = 1e-3
"""rad: angles larger than this are named in the warning."""


def check_mean_wrench(problem: Problem, pose: MeanPose, found: Preflight) -> None:
    """Refuses a mean force beyond rounding, and a mean moment that weights of unbalance cannot give.

    A remainder counts if it alone would be a relative residual that is not accepted. Flywheels with damping may have a
    mean wrench: then nothing is refused.
    """
    if any(problem.mechanics.tables.damping):
        return
    if problem.stand.hold is not None:
        _check_along_freedoms(problem, pose, found)
        return
    force, moment = pose.wrench[:3], pose.wrench[3:]
    able = _largest_moment(problem)
    left = _uncarried_part(problem, pose)
    if left == "force":
        size = float(np.linalg.norm(force))
        found.refusal = Refusal(
            "MEAN_WRENCH",
            f"a mean force of {size:.4g} N along {direction(force)} has no support: flywheels give no mean "
            f"force over a period; {_advice(problem) or 'a suspension, legs or buoyancy that balance it would help'}",
        )
    elif left == "moment":
        turning = float(np.linalg.norm(moment))
        found.refusal = Refusal(
            "MEAN_WRENCH",
            f"a mean moment of {turning:.4g} N m along {direction(moment)} has no support: weights of "
            f"unbalanced flywheels give at most {able:.3g} N m; "
            f"{_advice(problem) or 'a suspension that is stiff in rotation would help'}",
        )
    _warn_of_tilt(problem, pose, found)


def _uncarried_freedom(problem: Problem, pose: MeanPose) -> int | None:
    """The freedom along which most is left at the mean pose that nothing carries; None: all is carried."""
    units = coordinates_of(problem.stand).unit_names
    worst, found = problem.tolerance, None
    for k, value in enumerate(pose.wrench.tolist()):
        one = np.zeros(len(pose.wrench))
        one[k] = value
        share = problem.norm.relative(wrench_of(problem.stand, one)[None])
        by_weights = units[k] != "m" and abs(value) <= _largest_moment(problem)
        if share > worst and not by_weights:
            worst, found = share, k
    return found


def _check_along_freedoms(problem: Problem, pose: MeanPose, found: Preflight) -> None:
    """Refuses a mean force or moment along a freedom of a held carrier, by its name."""
    k = _uncarried_freedom(problem, pose)
    if k is not None:
        what = amount(coordinates_of(problem.stand), k, abs(float(pose.wrench[k])))
        helps = _advice(problem) or "a suspension, a leg or a stop that balances it would help"
        found.refusal = Refusal(
            "MEAN_WRENCH", f"{what} has no support in the mean: flywheels give none over a period; {helps}"
        )
    _warn_of_tilt(problem, pose, found)


def _warn_of_tilt(problem: Problem, pose: MeanPose, found: Preflight) -> None:
    """Warns of a mean pose that is turned far."""
    own = coordinates_of(problem.stand)
    pairs = zip(own.names, own.unit_names, pose.bias.tolist(), strict=True)
    tilts = {name: value for name, unit, value in pairs if unit == "rad"}
    if tilts and max(abs(x) for x in tilts.values()) > _TILT:
        words = ", ".join(f"{name} {x:.3g} rad" for name, x in tilts.items() if abs(x) > _TELLING)
        found.warnings.append(f"the mean pose is tilted to carry the mean wrench: {words}")


_RANK = 1e-7
"""Part of the largest singular value: a smaller column of I or dI/dphi counts as zero."""
_OUTSIDE = 1e-3
"""Largest accepted part of the required wrench outside the span."""


def check_span(problem: Problem, P: Array, found: Preflight) -> None:
    """Refuses where more than 1e-3 of the required P (M, 6) is outside the span of I_s(phi), dI_s/dphi at all phi.

    All of these are sums of the harmonics of I_s; scaled by K0^-1/2 and to one length each.
    """
    rows = problem.rows_count
    if 0 < problem.N < rows:
        found.warnings.append(f"{problem.N} flywheels: only special motions have a programme; {rows} or more give any")
    root = problem.norm.root
    columns = problem.mechanics.tables.coupling.reshape(-1, 6) @ root.T
    varying = (P - P.mean(axis=0)) @ root.T
    size = float(np.linalg.norm(varying, axis=1).max())
    if size <= 1e-9 * problem.norm.demand:
        return
    outside = varying
    if columns.size:
        _, sigma, Vt = np.linalg.svd(columns, full_matrices=False)
        kept = Vt[sigma > _RANK * sigma[0]]
        outside = varying - (varying @ kept.T) @ kept
    share = float(np.linalg.norm(outside, axis=1).max()) / size
    if share <= _OUTSIDE or found.refusal is not None:
        return
    if problem.stand.hold is not None:
        found.refusal = Refusal("SPAN", _span_words_along(problem, outside, share))
        return
    found.refusal = Refusal(
        "SPAN", _span_words(np.linalg.solve(root, outside.T).T, np.linalg.solve(root, varying.T).T, share)
    )


def _span_words_along(problem: Problem, outside: Array, share: float) -> str:
    """Message of a held carrier: along which freedom, how much of it, what would help. outside (M, m), scaled."""
    own = coordinates_of(problem.stand)
    scaled = problem.norm.root @ wrench_of(problem.stand, np.eye(own.count)).T
    missing = np.abs(np.linalg.solve(scaled, outside.T)).max(axis=1)
    k = int(np.argmax(np.abs(outside).max(axis=0)))
    helps = {
        "m": f"unbalanced flywheels whose axes are not along {own.names[k]}",
        "rad": f"flywheels with a part of their axes along that of {own.names[k]}, or unbalanced ones off it,",
        "": "flywheels that act along it",
    }[own.unit_names[k]]
    return (
        f"{amount(own, k, float(missing[k]))} is required, which these flywheels cannot give at any angles or "
        f"speeds ({100 * share:.2g} % of the required wrench is outside their span); {helps} would help"
    )


def _span_words(outside: Array, needed: Array, share: float) -> str:
    """Message: which direction, how much of it, what would help."""
    parts = []
    for kind, rows, unit in (("force", slice(0, 3), "N"), ("moment", slice(3, 6), "N m")):
        part, whole = outside[:, rows], needed[:, rows]
        peak = float(np.linalg.norm(part, axis=1).max())
        if peak > _OUTSIDE * float(np.linalg.norm(whole, axis=1).max()) and peak > 0.0:
            u = np.linalg.svd(part, full_matrices=False)[2][0]
            parts.append(
                (peak / max(float(np.linalg.norm(whole, axis=1).max()), 1e-300), kind, direction(u), peak, unit)
            )
    parts.sort(reverse=True)
    _, kind, way, peak, unit = parts[0]
    helps = {
        "force": f"unbalanced flywheels whose axes are perpendicular to {way} would help",
        "moment": f"flywheels with axes along {way}, or unbalanced ones off the axis, would help",
    }
    return (
        f"a {kind} along {way} of {peak:.3g} {unit} is required, which these flywheels cannot give at any angles or "
        f"speeds ({100 * share:.2g} % of the required wrench is outside their span); {helps[kind]}"
    )


_DIRECTIONS = 400
_SLACK = 1.01
"""Margin: the carrier turns a little under the flywheels, and the mean pose may move."""
_NEAR, _NEAR_OF_SIX = 0.5, 0.15
"""Shares of the limit beyond which a search often fails, for more flywheels than six and for six."""


def check_first_moment(problem: Problem, force: Array, C: Array, found: Preflight) -> None:
    """Refuses where half the range of u . G exceeds sum mu_s sqrt(1 - (u . e_s)^2) in some direction u.

    force (M, 3; N) in E0 at uniform times: required from the flywheels with centres of mass on their axes; its second
    integral is G, kg m. C (M, 3, 3): attitude. The condition is necessary, not sufficient.
    """
    tables = problem.mechanics.tables
    ways = slide_directions(problem.stand)
    if ways is not None:
        force = force @ ways @ ways.T
    varying = np.hstack([force - force.mean(axis=0), np.zeros_like(force)])
    if not varying.any() or problem.norm.relative(varying) <= problem.tolerance:
        return
    G = second_integral(force, problem.motion.span)
    need, have, way = reach(G, C @ tables.axis.T, tables.unbalance, ways)
    found.reach = need / have if have > 0.0 else np.inf
    near = _NEAR if problem.N - problem.rows_count > 0 else _NEAR_OF_SIX
    if found.reach > _SLACK:
        where = direction(way)
        found.refusal = found.refusal or Refusal(
            "FIRST_MOMENT",
            f"along {where} the motion needs a first moment of +-{need:.3g} kg m from the flywheels; "
            f"their total unbalance perpendicular to it is {have:.3g} kg m, at any speed; "
            f"possible with {100 / found.reach:.2g} % of this amplitude, or with {found.reach:.3g} times the unbalance",
        )
    elif found.reach > near:
        needed = f"{100 * found.reach:.0f} % of the unbalance is needed along {direction(way)}"
        found.hint = (f"{needed}; a search often fails above {100 * near:.0f} % with {problem.N} flywheels",)


def second_integral(force: Array, period: float) -> Array:
    """Twice integrated over a `period`, s, by Fourier series (M, ...), its mean and that of `force` removed."""
    spectrum = np.fft.rfft(force, axis=0)
    k = np.arange(len(spectrum), dtype=np.float64)
    k[0] = np.inf
    spectrum /= -((2.0 * np.pi / period * k) ** 2)[:, None]
    return np.fft.irfft(spectrum, len(force), axis=0)


def reach(G: Array, axes: Array, unbalance: Array, ways: Array | None = None) -> tuple[float, float, Array]:
    """Need and available amount (kg m) in the direction with the largest ratio; axes (M, 3, N) in E0.

    ways  (3, k), orthonormal: the only directions that count, where a hold takes the force along others
    """
    rng = np.random.default_rng(0)
    principal = np.linalg.svd(G, full_matrices=False)[2]
    candidates = np.vstack([np.eye(3), rng.normal(size=(_DIRECTIONS, 3)), principal, _widest(G)])
    if ways is not None:
        candidates = candidates @ ways @ ways.T
        candidates = candidates[np.linalg.norm(candidates, axis=1) > 1e-9 * np.abs(candidates).max()]
    candidates /= np.linalg.norm(candidates, axis=1, keepdims=True)
    along = G @ candidates.T
    need = (along.max(axis=0) - along.min(axis=0)) / 2.0
    need[need <= _RANK * need.max()] = 0.0  # rounding, along axes where there is no unbalance at all
    some = axes[:: max(1, len(axes) // 16)]
    across = np.sqrt(np.maximum(1.0 - (candidates @ some) ** 2, 0.0))  # (m, ways, N)
    have = (across.max(axis=0) * unbalance).sum(axis=1)
    worst = int(np.argmax(need / np.maximum(have, 1e-300)))
    return float(need[worst]), float(have[worst]), np.asarray(candidates[worst])


def _widest(G: Array) -> Array:
    """Directions (n, 3) of the largest differences of G."""
    some = G[:: max(1, len(G) // 64)]
    apart = (some[:, None] - some[None, :]).reshape(-1, 3)
    sizes = np.linalg.norm(apart, axis=1)
    return np.asarray(apart[np.argsort(sizes)[-20:]] + 1e-300)


def check_bound_reach(problem: Problem, at: PrescribedMotion, found: Preflight) -> None:
    """Refuses where y . (P - mean P) exceeds what flywheels can give along a wrench direction y at their bounds.

    Along y a flywheel gives at most |y . I_s| a_s + |y . I'_s| w_s^2 + |y . C_s| w_s + |y . A_s| of (12), each the
    largest over its angle. The check needs bounds of both speed and acceleration.
    """
    bounds = problem.motion.bounds
    if bounds.speed is None or bounds.acceleration is None or problem.N == 0 or found.refusal is not None:
        return
    w, a = np.array(bounds.speed), np.array(bounds.acceleration)
    P = at.locked_wrench()
    varying = P - P.mean(axis=0)
    held = problem.stand.hold is not None
    candidates = list(problem.mechanics.freedoms.T)
    if not held:
        candidates += [np.concatenate([u, np.zeros(3)]) for u in np.linalg.svd(varying[:, :3], full_matrices=False)[2]]
        candidates += [np.concatenate([np.zeros(3), u]) for u in np.linalg.svd(varying[:, 3:], full_matrices=False)[2]]
    worst, words = 1.0, ""
    for k, y in enumerate(candidates):
        need = float(np.abs(varying @ y).max())
        have = float(
            (_largest(problem.mechanics.coupling, y) * a + _largest(problem.mechanics.coupling_slope, y) * w**2).sum()
        )
        have += float((_largest(at.moving, y) * w + _largest(at.fixed[1:], y)).sum())
        if need > worst * have and need > 1e-9 * problem.norm.demand:
            kind, unit = _kind_of(y)
            what = f"a {kind} along {direction(y[:3] if kind == 'force' else y[3:])} of {need:.3g} {unit}"
            if held:
                what, unit = amount(coordinates_of(problem.stand), k, need), ""
            worst, words = need / max(have, 1e-300), _bound_words(what, unit, need, have)
    if words:
        found.refusal = Refusal("BOUND_REACH", words)


def _largest(harmonics: Array, y: Array) -> Array:
    """Largest |y . sum_h h(phi) x_h| over angles and times (N), of harmonics (5 or 4, 7, M, N): a bound of it."""
    along = np.einsum("himn,i->hmn", harmonics[:, :6], y)
    if len(along) == 4:
        along = np.concatenate([np.zeros_like(along[:1]), along])
    first, second = np.hypot(along[1], along[2]), np.hypot(along[3], along[4])
    return np.asarray((np.abs(along[0]) + first + second).max(axis=0))


def _kind_of(y: Array) -> tuple[str, str]:
    """Whether a direction of wrenches is of forces or moments, and the unit."""
    return ("force", "N") if np.any(y[:3]) else ("moment", "N m")


def _bound_words(what: str, unit: str, need: float, have: float) -> str:
    most = f"{have:.3g} {unit}".rstrip()
    return (
        f"{what} is required, flywheels inside the bounds of speed and acceleration give at most {most}; that is "
        f"{need / max(have, 1e-300):.2g} times too little: raise these bounds, the unbalance or the number of "
        "flywheels, or make the motion smaller"
    )


def preflight(problem: Problem) -> Preflight:
    """Mean wrench, span, first moment, reach inside bounds; the first that fails is the refusal."""
    motion = problem.motion
    t = uniform(motion.span, max(128, 16 * problem.highest))
    course = motion.at(t)
    found = Preflight(np.zeros(problem.rows_count))
    pose = mean_pose(problem)
    found.bias = pose.bias
    if problem.has_kinks:
        found.warnings.append(f"damping by |V| has kinks: a relative residual up to {problem.tolerance:g} is accepted")
    if motion.periodic:
        check_mean_wrench(problem, pose, found)
    at = prescribe(problem.mechanics, course, found.bias)
    P = at.locked_wrench()
    check_span(problem, P, found)
    if motion.periodic and not any(problem.mechanics.tables.damping):
        C = problem.mechanics.frame.pose(course.q + found.bias)[0]
        check_first_moment(problem, (C @ P[:, :3, None])[:, :, 0], C, found)
    check_bound_reach(problem, at, found)
    return found
