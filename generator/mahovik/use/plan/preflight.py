"""Checks before any search, in less than a second: motions that no programme of these flywheels can make.

Flywheels give no mean wrench over a period, so the surroundings must carry the weight at some mean pose, found with
axisymmetric flywheels; of a held carrier the wrench along its freedoms counts, at its home pose. Wrenches that
flywheels cannot give: directions out of their span, first moments beyond their unbalance (force is the second
derivative of sum m_s rho_s(phi_s), so total unbalance bounds the amplitude), and reach inside bounds. What is
missing is a force or a moment along a direction, or what acts along a freedom of a held carrier.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.masses import transfer
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.frame import Frame, Twists, in_E1
from mahovik.use.numeric.residual import PrescribedMotion, prescribe
from mahovik.use.numeric.se3 import Array
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


# -- the mean pose

_STEPS = 60
_TIMES = 32
_DIFFERENCE = 1e-6
_LONGEST = {"m": 0.05, "rad": 0.2, "": 0.2}
"""Longest step of a coordinate, by its unit."""
_MOMENT = 10.0
"""1/m: a moment counts as at 0.1 m."""
_FREE = 1e-6
"""Part of the largest singular value below which a direction is free; differences leave 1e-8."""


class MeanPose(NamedTuple):
    """The bias with the least mean wrench, and the remaining wrench.

    wrench   (6; N, N m): remaining mean over the period, in E0 axes, moment about O1
    """

    bias: Array
    wrench: Array


def mean_pose(problem: Problem) -> MeanPose:
    """Damped Newton over the free components of the bias, with axisymmetric flywheels; free directions stay."""
    t = uniform(problem.motion.span, _TIMES)
    course = problem.motion.at(t)
    free = np.flatnonzero(problem.free)
    coordinates = coordinates_of(problem.stand)
    root = np.array([_MOMENT if unit == "rad" else 1.0 for unit in coordinates.unit_names])
    longest = np.array([_LONGEST[unit] for unit in coordinates.unit_names])
    bias = np.zeros(coordinates.count)

    def remaining_wrench(at: Array) -> Array:
        return mean_wrench(problem, course, at)

    result = remaining_wrench(bias)
    for _ in range(_STEPS):
        if not len(free) or np.linalg.norm(result) <= 1e-13 * _force_size(problem):
            break
        J = np.empty((len(bias), len(free)))
        for k, component in enumerate(free):
            step = np.zeros(len(bias))
            step[component] = _DIFFERENCE
            J[:, k] = root * (remaining_wrench(bias + step) - remaining_wrench(bias - step)) / (2 * _DIFFERENCE)
        step = np.zeros(len(bias))
        step[free] = -np.linalg.lstsq(J, root * result, rcond=_FREE)[0]
        step *= min(1.0, float(np.min(longest / np.maximum(np.abs(step), 1e-300))))
        for _ in range(12):
            there = remaining_wrench(bias + step)
            if np.linalg.norm(root * there) < np.linalg.norm(root * result):
                break
            step = step / 4
        else:
            break
        bias, result = bias + step, there
    return MeanPose(bias, result)


def mean_wrench(problem: Problem, course: Course, bias: Array) -> Array:
    """Mean over the times of the whole external wrench (6; N, N m), forces and moments about O1 in E0 axes.

    Of a held carrier: along its freedoms (m), at the home pose.
    """
    mechanics = problem.mechanics
    at = mechanics.frame.twists(course._replace(q=course.q + bias))
    F = mechanics.base.wrench(at)
    gravity = in_E1(at.C, problem.stand.gravity)
    F = F + gravity @ mechanics.tables.weight[0].sum(axis=0).T
    if problem.stand.hold is not None:
        return mean_along_freedoms(problem.stand, at, F)
    parts = [(at.C @ F[:, k : k + 3, None])[:, :, 0].mean(axis=0) for k in (0, 3)]
    return np.concatenate(parts)


def _force_size(problem: Problem) -> float:
    """Weight of everything, or a force of similar meaning if there is none, N."""
    mass = float(problem.mechanics.mean_inertia[0, 0])
    return max(mass * float(np.linalg.norm(problem.stand.gravity)), 1e-6 * mass)


UNITS = {"m": ("force", "N"), "rad": ("moment", "N m"), "": ("wrench", "")}
"""What acts along a coordinate of a unit, and its own unit."""


def mean_along_freedoms(stand: Stand, at: Twists, F: Array) -> Array:
    """Mean (m) of wrenches F (M, 6) in E1 about O1 along the freedoms, counted in the home pose.

    There the freedoms stay as they are, so that over a period the momentum along them has no change.
    """
    hold = stand.hold
    assert hold is not None
    S = freedom_twists(hold)
    C0, O0 = (part[0] for part in Frame.of(stand).pose(np.zeros((1, S.shape[1]))))
    result = np.zeros(6)
    for C, O1, wrench in zip(at.C, at.O1, F, strict=True):
        result += transfer(C0.T @ (O1 - O0), C0.T @ C) @ wrench
    return np.asarray(S.T @ result / len(F))


def wrench_of(stand: Stand, along: Array) -> Array:
    """A wrench (..., 6) of what acts along the freedoms (..., m) and nowhere else."""
    assert stand.hold is not None
    return np.asarray(along @ wrenches(stand.hold).T)


def slide_directions(stand: Stand) -> Array | None:
    """Directions (3, k) in E0 along which the momentum of a held carrier is free; None of a free one: all."""
    hold = stand.hold
    if hold is None:
        return None
    C0 = Frame.of(stand).pose(np.zeros((1, len(hold.freedoms))))[0][0]
    slides = [np.array(freedom.direction) for freedom in hold.freedoms if freedom.kind == "slide"]
    return np.asarray(C0 @ np.array([direction / np.linalg.norm(direction) for direction in slides]).reshape(-1, 3).T)


# -- checks

AXES = ("x", "y", "z")


def direction(u: Array) -> str:
    """A direction (3) in words: the name of an axis, else its numbers."""
    u = u / np.linalg.norm(u)
    k = int(np.argmax(np.abs(u)))
    if abs(u[k]) > 0.999:
        return AXES[k]
    return "(" + ", ".join(f"{x:.2f}" for x in np.round(u * np.sign(u[k]), 2) + 0.0) + ")"


class Part(NamedTuple):
    """Wrenches of one kind: all forces, all moments, or of a held carrier those along one freedom.

    basis  (6, k): wrenches in E1 about O1 of its k numbers; name: of the freedom, or None
    """

    kind: str
    unit: str
    basis: Array
    name: str | None = None

    def direction_words(self, x: Array) -> str:
        """Direction of numbers (k), in words."""
        return self.name or direction(x)

    def words(self, x: Array, size: float | None = None) -> str:
        """Numbers (k) as an amount along a direction; `size` in place of their own."""
        size = float(np.linalg.norm(x)) if size is None else size
        return f"a {self.kind} along {self.direction_words(x)} of {size:.4g} {self.unit}".rstrip()


def parts_of(problem: Problem) -> list[Part]:
    """The parts of the wrenches that count, whose numbers are together the rows of (12)."""
    if problem.stand.hold is None:
        return [Part("force", "N", np.eye(6)[:, :3]), Part("moment", "N m", np.eye(6)[:, 3:])]
    coordinates = coordinates_of(problem.stand)
    columns = wrench_of(problem.stand, np.eye(coordinates.count)).T
    return [
        Part(*UNITS[coordinates.unit_names[k]], columns[:, k, None], coordinates.in_words[k])
        for k in range(coordinates.count)
    ]


def split(parts: list[Part], numbers: Array) -> list[Array]:
    """Numbers (..., rows) of each part."""
    return np.split(numbers, np.cumsum([part.basis.shape[1] for part in parts])[:-1], axis=-1)


def _uncarried(problem: Problem, pose: MeanPose) -> tuple[Part, Array] | None:
    """The part of the mean wrench that nothing carries, where this is most; None: all is carried.

    A remainder counts if it alone would be a relative residual that is not accepted, and if the weights of unbalanced
    flywheels cannot give it.
    """
    parts, worst, uncarried = parts_of(problem), problem.tolerance, None
    for part, x in zip(parts, split(parts, pose.wrench), strict=True):
        share = problem.norm.relative((part.basis @ x)[None])
        by_weights = part.kind != "force" and float(np.linalg.norm(x)) <= _largest_moment(problem)
        if share > worst and not by_weights:
            worst, uncarried = share, (part, x)
    return uncarried


def _largest_moment(problem: Problem) -> float:
    """Largest moment that the weights of unbalanced flywheels give, N m."""
    return float(problem.mechanics.tables.unbalance.sum() * np.linalg.norm(problem.stand.gravity))


def _advice(problem: Problem) -> str:
    """What would carry the mean wrench: a mean that is held, were it free, or the surroundings."""
    everywhere = replace(problem, free=np.ones(len(problem.free), dtype=bool))
    if problem.free.all() or _uncarried(everywhere, mean_pose(everywhere)) is not None:
        return "a suspension, legs or buoyancy that balance it would help"
    may_move, names = np.array(problem.motion.free_mean, dtype=bool), coordinates_of(problem.stand).in_words
    said = []
    for key, held in (("`free_mean`", np.logical_not(may_move)), ("a bound 0 of `bias`", may_move > problem.free)):
        which = ", ".join(name for name, is_held in zip(names, held, strict=True) if is_held)
        said += [f"{key} holds the mean of {which}"] if which else []
    return f"{' and '.join(said)}: free it, so that the mean pose may shift to where the surroundings carry the wrench"


_TILT = 0.1
"""rad: a larger mean tilt causes a warning."""
_TELLING = 1e-3
"""rad: angles larger than this are named in the warning."""


def check_mean_wrench(problem: Problem, pose: MeanPose, preflight: Preflight) -> None:
    """Refuses a mean wrench that nothing carries, and warns of a mean pose that is turned far.

    Flywheels with damping may have a mean wrench: then nothing is refused.
    """
    if any(problem.mechanics.tables.damping):
        return
    left = _uncarried(problem, pose)
    if left is not None:
        part, x = left
        why = "has no support in the mean: flywheels give none over a period"
        preflight.refusal = Refusal("MEAN_WRENCH", f"{part.words(x)} {why}; {_advice(problem)}")
    coordinates = coordinates_of(problem.stand)
    pairs = zip(coordinates.names, coordinates.unit_names, pose.bias.tolist(), strict=True)
    tilts = {name: value for name, unit, value in pairs if unit == "rad"}
    if max(map(abs, tilts.values()), default=0.0) > _TILT:
        words = ", ".join(f"{name} {x:.3g} rad" for name, x in tilts.items() if abs(x) > _TELLING)
        preflight.warnings.append(f"the mean pose is tilted to carry the mean wrench: {words}")


_RANK = 1e-7
"""Part of the largest singular value: a smaller column of I or dI/dphi counts as zero."""
_OUTSIDE = 1e-3
"""Largest accepted part of the required wrench outside the span."""
_HELPS = {
    "force": "unbalanced flywheels whose axes are not along {0} would help",
    "moment": "flywheels with a part of their axes along {0}, or unbalanced ones off it, would help",
    "wrench": "flywheels that act along {0} would help",
}


def check_span(problem: Problem, P: Array, preflight: Preflight) -> None:
    """Refuses where more than 1e-3 of the required P (M, 6) is outside the span of I_s(phi), dI_s/dphi at all phi.

    All of these are sums of the harmonics of I_s; scaled by K0^-1/2 and to one length each.
    """
    rows = problem.rows_count
    if 0 < problem.N < rows:
        preflight.warnings.append(
            f"{problem.N} flywheels: only special motions have a programme; {rows} or more give any"
        )
    root = problem.norm.root
    columns = problem.mechanics.tables.coupling.reshape(-1, 6) @ root.T
    outside = varying = (P - P.mean(axis=0)) @ root.T
    size = float(np.linalg.norm(varying, axis=1).max())
    if size <= 1e-9 * problem.norm.demand or preflight.refusal is not None:
        return
    if columns.size:
        _, sigma, Vt = np.linalg.svd(columns, full_matrices=False)
        kept = Vt[sigma > _RANK * sigma[0]]
        outside = varying - (varying @ kept.T) @ kept
    share = float(np.linalg.norm(outside, axis=1).max()) / size
    if share <= _OUTSIDE:
        return
    parts = parts_of(problem)
    scaled = root @ np.hstack([part.basis for part in parts])
    missing = split(parts, np.linalg.solve(scaled, outside.T).T)
    shares = [problem.norm.relative(x @ part.basis.T) for part, x in zip(parts, missing, strict=True)]
    part, x = parts[k := int(np.argmax(shares))], missing[k]
    way = np.linalg.svd(x, full_matrices=False)[2][0]
    what = part.words(way, float(np.linalg.norm(x, axis=1).max()))
    preflight.refusal = Refusal(
        "SPAN",
        f"{what} is required, which these flywheels cannot give at any angles or speeds ({100 * share:.3g} % of the "
        f"required wrench is outside their span); {_HELPS[part.kind].format(part.direction_words(way))}",
    )


_DIRECTIONS = 400
_SLACK = 1.01
"""Margin: the carrier turns a little under the flywheels, and the mean pose may move."""
_NEAR, _NEAR_OF_SIX = 0.5, 0.15
"""Shares of the limit beyond which a search often fails, for more flywheels than six and for six."""


def check_first_moment(problem: Problem, force: Array, C: Array, preflight: Preflight) -> None:
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
    preflight.reach = need / have if have > 0.0 else np.inf
    near = _NEAR if problem.N - problem.rows_count > 0 else _NEAR_OF_SIX
    if preflight.reach > _SLACK:
        where = direction(way)
        preflight.refusal = preflight.refusal or Refusal(
            "FIRST_MOMENT",
            f"along {where} the motion needs a first moment of +-{need:.3g} kg m from the flywheels; "
            f"their total unbalance perpendicular to it is {have:.3g} kg m, at any speed; "
            f"possible with {100 / preflight.reach:.3g} % of this amplitude, or with {preflight.reach:.3g} times "
            "the unbalance",
        )
    elif preflight.reach > near:
        needed = f"{100 * preflight.reach:.0f} % of the unbalance is needed along {direction(way)}"
        preflight.hint = (f"{needed}; a search often fails above {100 * near:.0f} % with {problem.N} flywheels",)


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


def check_bound_reach(problem: Problem, at: PrescribedMotion, preflight: Preflight) -> None:
    """Refuses where y . (P - mean P) exceeds what flywheels can give along a wrench direction y at their bounds.

    Along y a flywheel gives at most |y . I_s| a_s + |y . I'_s| w_s^2 + |y . C_s| w_s + |y . A_s| of (12), each the
    largest over its angle. The check needs bounds of both speed and acceleration.
    """
    bounds = problem.motion.bounds
    if bounds.speed is None or bounds.acceleration is None or problem.N == 0 or preflight.refusal is not None:
        return
    w, a = np.array(bounds.speed), np.array(bounds.acceleration)
    P = at.locked_wrench()
    varying = P - P.mean(axis=0)
    worst = 1.0
    for part in parts_of(problem):
        for way in np.linalg.svd(varying @ part.basis, full_matrices=False)[2]:
            y = part.basis @ way
            need = float(np.abs(varying @ y).max())
            give = _largest(problem.mechanics.coupling, y) * a + _largest(problem.mechanics.coupling_slope, y) * w**2
            have = float((give + _largest(at.moving, y) * w + _largest(at.fixed[1:], y)).sum())
            if need > worst * have and need > 1e-9 * problem.norm.demand:
                worst = need / max(have, 1e-300)
                preflight.refusal = Refusal(
                    "BOUND_REACH",
                    f"{part.words(way, need)} is required, flywheels inside the bounds of speed and acceleration give "
                    f"at most {have:.3g} {part.unit}; that is {worst:.2g} times too little: raise these bounds, the "
                    "unbalance or the number of flywheels, or make the motion smaller",
                )


def _largest(harmonics: Array, y: Array) -> Array:
    """Largest |y . sum_h h(phi) x_h| over angles and times (N), of harmonics (5 or 4, 7, M, N): a bound of it."""
    along = np.einsum("himn,i->hmn", harmonics[:, :6], y)
    if len(along) == 4:
        along = np.concatenate([np.zeros_like(along[:1]), along])
    first, second = np.hypot(along[1], along[2]), np.hypot(along[3], along[4])
    return np.asarray((np.abs(along[0]) + first + second).max(axis=0))


def preflight(problem: Problem) -> Preflight:
    """Mean wrench, span, first moment, reach inside bounds; the first that fails is the refusal."""
    motion = problem.motion
    t = uniform(motion.span, max(128, 16 * problem.highest))
    course = motion.at(t)
    result = Preflight(np.zeros(problem.rows_count))
    pose = mean_pose(problem)
    result.bias = pose.bias
    if problem.has_kinks:
        result.warnings.append(f"damping by |V| has kinks: a relative residual up to {problem.tolerance:g} is accepted")
    if motion.periodic:
        check_mean_wrench(problem, pose, result)
    at = prescribe(problem.mechanics, course, result.bias)
    P = at.locked_wrench()
    check_span(problem, P, result)
    if motion.periodic and not any(problem.mechanics.tables.damping):
        C = problem.mechanics.frame.pose(course.q + result.bias)[0]
        check_first_moment(problem, (C @ P[:, :3, None])[:, :, 0], C, result)
    check_bound_reach(problem, at, result)
    return result
