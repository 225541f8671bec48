"""Judges of functions whose answer is a value: an equation of the literal reference, with its measured scale.

`wrap` is judged by exact angles, and pi with fifty digits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.quantities import BOUNDS, SINGULAR_BELOW, limits_of
from mahovik.contract.status import status_words
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.lower.values import parameters_of
from mahovik.core.stand.model import Stand, State, Vec3, Vec6, rest_state
from mahovik.core.stand.numbers import StandNumbers, exact
from mahovik.core.stand.stand_file import document_of, read
from mahovik.errors import StandError, StateError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import (
    C1,
    Array,
    Values,
    attitude,
    block_diagonal,
    quaternion_rotation,
    twists,
    vector,
)
from mahovik.proof.reference.coordinates import check_attitude, kinematic_matrix, kinematic_matrix_rate, pose_of
from mahovik.proof.reference.evaluate import answer_regressor, identify_step, slopes
from mahovik.proof.reference.motion import coupled
from mahovik.proof.second import Second
from mahovik.proof.second.system import Derivatives
from mahovik.proof.verify.backends import turns
from mahovik.proof.verify.compare import FAR_SIDES, Case, Rows, same_bits
from mahovik.proof.verify.scales import Equation, Scales, turning
from mahovik.proof.verify.states import Request

ATTITUDES = 12
"""Attitudes and coordinates tried, some of them after several turns."""

OTHER_STANDS, BODIES = 3, 6
"""Stands with other parameters that are tried, and bodies that are just possible and just not."""

JACOBIAN_STATES, LOCKED_STATES = 4, 1
"""States at which a Jacobian is judged, and with locks: each pattern needs a derivative of its own."""

DEVIATION, NOISE, FORGET = 1e-3, 0.1, 0.1
"""kg m: deviation of the unbalances before a sample; noise, a part of what these make of a component; `forget`."""


TURN = 2 * Fraction("3.1415926535897932384626433832795028841971693993751")
"""2 pi; the angles are rounded to 17 digits, and have at most eight before the point."""

PROMISE = 2.5
"""Promised error, in units in the last place of 1: 5e-16 rad in double."""


@dataclass(frozen=True)
class Trial:
    """One call of a function: name, state that the equation is evaluated at, arguments, equation.

    read  the quantities of the equation from the results
    """

    name: str
    state: State
    arguments: Mapping[str, Any]
    equation: Equation
    read: Callable[[Mapping[str, Any]], Mapping[str, Any]] = dict


def judge_trials(case: Case, rows: Rows, trials: Callable[[Case], Iterator[Trial]], suffix: str = "") -> None:
    """A check for each quantity of the trials."""
    for trial in trials(case):
        try:
            answer = trial.read(case.call(rows.function, trial.arguments))
        except StateError as error:
            rows.check("answer").refuse(error, trial.name)
            continue
        rows.compare(trial.name, trial.state, trial.equation, answer, suffix)


def regressor_trials(case: Case) -> Iterator[Trial]:
    """The columns of every body."""
    for name, state in case.states:
        yield Trial(
            name, state, case.backend.arguments(state), lambda stand, near, at: answer_regressor(at, stand, near)
        )


def trials_with_sines(case: Case, function: str) -> Iterator[Trial]:
    """A function that answers a want, with the sines and cosines of the phases; it need not look at the phases."""

    def equation(stand: Stand, state: State, at: reference.Pieces) -> Values:
        return reference.evaluate(stand, state, (function,), at, case.scales.cuts)

    for name, state in case.states:
        arguments = case.backend.arguments(state)
        by_sines = arguments | turns(state) | {"x": arguments["x"] | {"phi": [0.0] * case.count}}

        def read(motion: Mapping[str, Any], arguments: Mapping[str, Any] = arguments) -> Mapping[str, Any]:
            """The motion, and of a held carrier its reaction, whose function takes no sines."""
            return case.backend.with_reaction(arguments, dict(motion)) if function in ("forward", "coupled") else motion

        yield Trial(name, state, by_sines, equation, read)


def locked_trials(case: Case) -> Iterator[Trial]:
    """`coupled` with some flywheels locked."""
    for number, (name, state) in enumerate(case.states):
        locked = case.lock_pattern(number)

        def equation(stand: Stand, state: State, at: reference.Pieces, locked: Array = locked) -> Values:
            V_dot, phi_ddot = coupled(at, vector(state.tau), locked)
            return {"V_dot": V_dot, "phi_ddot": phi_ddot}

        yield Trial(name, state, case.backend.arguments(state) | {"locked": [int(x) for x in locked]}, equation)


def estimate_trials(case: Case) -> Iterator[Trial]:
    """The factored step of recursive least squares against the literal covariance form, from random estimates.

    Some variances reach the largest as they grow, and some components of V_dot are not used.
    """
    n = 2 * case.count
    for number, (name, state) in enumerate(case.states):
        rng, largest = case.random(number), float(case.nearest_numbers(DEVIATION**2))
        prior = {
            "unbalance": case.nearest_numbers(DEVIATION * rng.normal(size=n)).tolist(),
            "variance": case.nearest_numbers(largest * rng.uniform(0.5, 1.0, n)).tolist(),
            "factor": case.nearest_numbers(0.3 * rng.normal(size=n * (n - 1) // 2)).tolist(),
            "largest": largest,
        }
        grown = np.minimum(largest, (1.0 + FORGET) * np.array(prior["variance"]))
        H, u, P = (
            slopes(case.scales.at(state), state),
            np.array(prior["unbalance"]),
            covariance({**prior, "variance": grown}),
        )
        noise = case.nearest_numbers(NOISE * np.sqrt(np.diag(H @ P @ H.T)))
        noise[number % 7 :: 7] = 0.0

        def equation(
            _: Stand, near: State, at: reference.Pieces, noise: Array = noise, u: Array = u, P: Array = P
        ) -> Values:
            return dict(zip(("unbalance", "covariance"), identify_step(at, near, noise, u, P), strict=True))

        inputs = {**case.backend.arguments(state), "noise": noise.tolist(), "forget": FORGET, "estimate": prior}
        yield Trial(name, state, inputs, equation, lambda results: {
            "unbalance": results["estimate"]["unbalance"], "covariance": covariance(results["estimate"])
        })  # fmt: skip


def covariance(estimate: Any) -> Array:
    """U D U^T of an estimate of the C."""
    variance = np.array(estimate["variance"], dtype=np.float64)
    U = np.eye(len(variance))
    rows, columns = np.tril_indices(len(variance), -1)  # column by column above the diagonal
    U[columns, rows] = np.array(estimate["factor"], dtype=np.float64)
    return np.asarray((U * variance) @ U.T)


def quaternion_trials(case: Case) -> Iterator[Trial]:
    """C of the quaternion against the product of the elementary rotations."""
    for name, state in _attitudes(case):
        yield Trial(
            name, state, {"angles": list(_angles_of(state))},
            lambda stand, near, _: {"C": attitude(stand.angles, *_angles_of(near))},
            lambda results: {"C": quaternion_rotation(*results["attitude"])},
        )  # fmt: skip


def coordinate_trials(case: Case) -> Iterator[Trial]:
    """Pose, V = A q' and V* = A q'' + D q' of (10), of a held carrier those of its freedoms; phases are kept."""
    rng, hold = case.random(2), case.stand.hold
    takes = case.backend.program.function("state_from_coordinates").arguments
    sizes = {a.name: int(a.shape[0]) for a in takes if a.name in ("position", "q", "orientation", "q_dot", "q_ddot")}
    table = case.backend.arguments(rest_state(case.stand))["table"]
    for name, state in _attitudes(case):
        kept = {key: case.normal(rng, case.count) for key in ("phi", "phi_dot")} if case.count else {}
        x = {"position": [0.0] * 3, "attitude": [1.0, 0.0, 0.0, 0.0], "V": [0.0] * 6} | kept
        q = {key: case.normal(rng, size) for key, size in sizes.items()}
        if "orientation" in q:
            q["orientation"] = case.nearest_numbers(q["orientation"] / np.linalg.norm(q["orientation"])).tolist()
        rates = tuple(q["q_dot"]), tuple(q["q_ddot"])
        if hold is None:
            at = replace(state, position=_vector(q["position"]), V=rates[0], V_dot=rates[1])
        else:
            turned = tuple(q["orientation"]) if "orientation" in q else None
            at = replace(
                state, angles=None, quaternion=turned, demand=tuple(q.get("q", ())), u=rates[0], u_dot=rates[1]
            )

        def read(result: Mapping[str, Any], kept: dict[str, Any] = kept) -> Mapping[str, Any]:
            x = result["x"]
            pose = {"position": x["position"], "C": quaternion_rotation(*x["attitude"]), "V": x["V"]}
            same = all(list(x[key]) == value for key, value in kept.items())
            return pose | {"V_dot": result["V_dot"], "phases kept": same}

        arguments = {**q, "angles": list(_angles_of(state)), "table": table, "x": x}
        yield Trial(name, at, arguments, _free_coordinates if hold is None else _held_coordinates, read)


def judge_coordinates(case: Case, rows: Rows) -> None:
    """Coordinates by (10); of a free carrier angles that are just singular, and just not, there and back."""
    judge_trials(case, rows, coordinate_trials)
    first = next(coordinate_trials(case)).arguments
    singular = 0.0 if case.stand.angles == "euler" else math.pi / 2.0
    for part in FAR_SIDES if case.stand.hold is None else ():
        angles = case.nearest_numbers([0.3, singular - part * SINGULAR_BELOW, 0.2]).tolist()
        back = case.backend.arguments(replace(rest_state(case.stand), angles=_vector(angles), quaternion=None))
        for function, arguments in ((rows.function, {**first, "angles": angles}), ("generalized", back)):
            if function in case.public:
                status = status_words(case.backend.call(function, arguments)[0])
                is_right = (status == "SINGULAR_ATTITUDE") == (part < 1.0)
                rows.demand("SINGULAR_ATTITUDE at its bound", is_right, f"{function} at {part:g} of it", status)


def _free_coordinates(stand: Stand, state: State, _: Any) -> Values:
    """Pose and motion for q' in place of V and q'' in place of V_dot. Raises StateError."""
    angles, q_dot, q_ddot = vector(_angles_of(state)), vector(state.V), vector(state.V_dot)
    check_attitude(stand.angles, angles)
    A, D = kinematic_matrix(stand.angles, angles), kinematic_matrix_rate(stand.angles, angles, q_dot[3:])
    pose = {"position": vector(state.position), "C": attitude(stand.angles, *angles), "V": A @ q_dot}
    return pose | {"V_dot": A @ q_ddot + D @ q_dot, "phases kept": True}


def _held_coordinates(stand: Stand, state: State, _: Any) -> Values:
    """Pose and motion for q in place of the demand, q' in place of u and q'' in place of u_dot."""
    assert stand.hold is not None
    turned = None if state.quaternion is None else vector(state.quaternion)
    at = pose_of(stand.hold, stand.angles, vector(state.demand), turned, vector(state.u), vector(state.u_dot))
    return vars(at) | {"phases kept": True}


def _attitudes(case: Case) -> Iterator[tuple[str, State]]:
    """States at rest with angles as the element type has them."""
    rng = case.random(1)
    for number in range(ATTITUDES):
        angles = case.nearest_numbers(rng.uniform(-math.pi, math.pi, 3) * (20.0 if number % 4 == 3 else 1.0))
        yield f"attitude {number}", replace(rest_state(case.stand), angles=_vector(angles), quaternion=None)


def _angles_of(state: State) -> Vec3:
    return state.angles or (0.0, 0.0, 0.0)


def _vector(numbers: Any) -> Vec3:
    x, y, z = map(float, numbers)
    return x, y, z


def judge_other_parameters(case: Case, rows: Rows) -> None:
    """Wants of stands with other parameters, by the tables that `prepare` and `prepare_mounts` make of them."""
    mounts = rows.function == "prepare_mounts"
    asked = ("mounts",) if mounts else ("matrices", "momentum", "forward", "torque", "points")
    known = case.backend.wants_of(case.backend.complete.program)
    check = rows.check("other parameters")
    if not mounts:
        _judge_bodies(case, rows)
    for number in range(OTHER_STANDS):
        other = _with_other_parameters(case.stand, case.random(200 + number))
        scales = Scales(other, case.real)
        judged = {want: Rows(case.limits, scales, want) for want in asked if want in known}
        try:
            arguments = {"parameters": parameters_of(other, case.backend.layout), "table": case.backend.table()}
            table = {"table": case.call("prepare", arguments)["table"]}
            if mounts:
                table["mounting"] = case.call("prepare_mounts", arguments)["mounting"]
        except StandError as error:  # beyond the range of parameters
            check.skip(str(error), f"stand {number + 1}")
            continue
        except StateError as error:
            check.refuse(error, f"stand {number + 1}")
            continue
        for name, state in case.states[number::OTHER_STANDS]:
            for want, of_want in judged.items():
                answer = case.backend.answer(want, state, case.backend.arguments(state) | table)
                of_want.compare_want(Request(f"{name} of stand {number + 1}", state, (want,)), answer)
        for one in (one for of_want in judged.values() for one in of_want.checks()):
            check.note(one.value, f"{one.state}, {one.quantity}", one.words)


def _judge_bodies(case: Case, rows: Rows) -> None:
    """`prepare` takes bodies and added masses that are possible but for less than the tolerance, and no others.

    The second moments of a body about its centre of mass, int x x^T dm, are least along a random direction: there they
    are negative by a part of the tolerance. So is the least eigenvalue of an added mass, made one on its diagonal.
    """
    layout, tolerance = case.backend.layout, THRESHOLDS[case.real].unphysical
    default, table = parameters_of(case.stand, layout), case.backend.table()
    made = case.call("prepare", {"parameters": case.backend.library.default("default_parameters"), "table": table})
    rows.demand("default table", same_bits(made["table"], table), "default parameters", "not that of the parameters")
    for number in range(BODIES):
        rng = case.random(300 + number)
        mass, c, axes = rng.uniform(1.0, 9.0), rng.normal(size=3), np.linalg.qr(rng.normal(size=(3, 3)))[0]
        for part in FAR_SIDES:
            due, size = "NOT_POSITIVE_DEFINITE" if part > 1.0 else "OK", 0.0
            for _ in range(2):  # the tolerance is that of the largest element
                S = (axes * [1.0, 2.0, -part * tolerance * size]) @ axes.T + mass * np.outer(c, c)
                J = np.trace(S) * np.eye(3) - S
                size = float(np.abs(J).max())
            numbers = {"mass": mass, "center_of_mass": c, "inertia": J[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]}
            parameters = {**default, "carrier": default["carrier"] | numbers}
            tried = dict[str, tuple[Any, str]]()
            if case.count:
                first, *rest = default["flywheel"]
                if number % 2:
                    parameters = {**default, "flywheel": [{**first, "body": first["body"] | numbers}, *rest]}
                for what, place, status in _at_the_edge_of_places(case, first, part):
                    tried[what] = {**default, "flywheel": [first | place, *rest]}, status
            tried["body"] = parameters, due
            if layout.added_mass:
                F = rng.normal(size=(6, 5))
                gram = F @ F.T
                unit = gram / np.sqrt(np.outer(np.diag(gram), np.diag(gram)))
                added = (1.0 + part * tolerance) * unit - part * tolerance * np.eye(6)
                tried["added mass"] = {**default, "added_mass": (added + added.T) / 2.0}, due
            for what, (values, expected) in tried.items():
                status = status_words(case.backend.call("prepare", {"parameters": values, "table": table})[0])
                name = f"{what} {number + 1} at {part:g} of the tolerance"
                rows.demand("impossible bodies", status == expected, name, f"{status}, due {expected}")


def _at_the_edge_of_places(case: Case, wheel: Mapping[str, Any], part: float) -> Iterator[tuple[str, Any, str]]:
    """Numbers of a flywheel's place that are just refused and just not, with the status that is due.

    `zero` as near along the axis, and a flywheel as far away as the sum of inertias allows: in double the heaviest
    may be anywhere.
    """
    thresholds, axis = THRESHOLDS[case.real], np.array(wheel["axis"])
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    zero = axis / np.linalg.norm(axis) + part * thresholds.parallel * across / np.linalg.norm(across)
    yield "zero along the axis", {"zero": zero}, "OK" if part > 1.0 else "RANGE"
    far = math.sqrt(part * thresholds.inertia / max(wheel["body"]["mass"], thresholds.least))
    most, body = BOUNDS["MAX_PARAMETER"].at(case.real), wheel["body"]
    if far < most:
        yield "distance", {"position": [far, 0.0, 0.0]}, "RANGE" if part > 1.0 else "OK"
    else:
        heaviest = body | {"mass": most / 2.0, "center_of_mass": [0.0] * 3}
        yield "distance of the heaviest", {"position": [most / 2.0, 0.0, 0.0], "body": heaviest}, "OK"


def _with_other_parameters(stand: Stand, rng: np.random.Generator) -> Stand:
    """The stand with other masses, inertias and centres of mass, its flywheels, instruments and points elsewhere.

    As physical as the stand: mass and inertia grow together, and centres of mass come nearer to the origin.
    """
    file = StandNumbers(stand, exact(document_of(stand)))
    grown = {body.name: rng.uniform(1.01, 1.05) for body in stand.bodies}
    moved, values = {point.name for point in stand.points} | grown.keys() - {stand.carrier.name}, {}
    for number in file:
        key = number.path.removeprefix(f"{number.body}.").partition(".")[0].partition("[")[0]
        if number.body in grown and key in ("mass", "inertia", "center_of_mass"):
            values[number] = number.value * (grown[number.body] if key != "center_of_mass" else rng.uniform(0.95, 0.99))
        elif number.body in moved and key in ("position", "angles", "axis", "zero"):
            values[number] = number.value + rng.uniform(-0.05, 0.05)
    other = read(file.with_values(values), stand.name, physics=False)
    return replace(other, laws=stand.laws)  # isolators would balance the other weight; `prepare` keeps what they are


def judge_mounts(case: Case, rows: Rows) -> None:
    """Mount wrenches by the second derivation: element 4 is tau, and all six move the carrier as the flywheels do.

    Carrier and instruments alone, with the reactions of the mounts as wrenches on the carrier, must have the V* of the
    whole stand: Lagrange's equations of the stand without flywheels know nothing of what mounts bear.
    """
    moment, motion = rows.check("element 4, tau of the second"), rows.check("V_dot under the reactions")
    bare = replace(case.stand, flywheels=(), points=())
    second = Second(bare)
    for name, state in case.states:
        try:
            V_dot = case.call("forward", case.backend.arguments(state))["V_dot"]
            u_dot: tuple[float, ...] = ()
            if case.stand.hold is not None:
                u_dot = tuple(np.linalg.lstsq(twists(case.stand.hold), np.array(V_dot), rcond=None)[0].tolist())
            moving = replace(state, V_dot=tuple(V_dot), u_dot=u_dot)
            mount_wrench = case.call("mounts", case.backend.arguments(moving))["mount_wrench"]
        except StateError as error:
            moment.refuse(error, name)
            continue
        wrenches, torque = np.array(mount_wrench, dtype=np.float64).reshape(-1, 6), case.scales.want(moving, "torque")
        forward = case.scales.want(state, "forward")
        if torque is None or forward is None:
            moment.skip("the reference has no answer", name)
            continue
        try:
            tau = case.second.evaluate(moving, ("torque",))["tau"]
            moment.compare(wrenches[:, 3], tau, torque.scales["tau"] + turning(case.scales.at(moving))[:, 3], name)
            alone = _without_flywheels(moving, case.scales.at(moving), wrenches, bare)
            if not case.stand.carrier.mass or np.linalg.eigvalsh(reference.pieces(bare, alone).K)[0] <= 0.0:
                raise StateError("the mass matrix of the stand without flywheels is not positive definite")
            motion.compare(V_dot, second.evaluate(alone, ("forward",))["V_dot"], forward.scales["V_dot"], name)
        except StateError as error:  # such as that of a carrier without inertia
            motion.skip(f"its judge refused: {error}", name)


def _without_flywheels(state: State, at: reference.Pieces, wrenches: Array, bare: Stand) -> State:
    """The state of carrier and instruments alone, under the reactions of the mounts."""
    reaction = np.array(state.wrench.get("carrier", (0.0,) * 6))
    for s, wrench in zip(at.flywheels, wrenches, strict=True):
        reaction = reaction - s.L @ block_diagonal(C1(s.phi)).T @ wrench  # from the axes of Es at phi = 0
    names = {body.name for body in bare.bodies}
    remaining = {body: wrench for body, wrench in state.wrench.items() if body in names}
    remaining["carrier"] = cast(Vec6, tuple(reaction.tolist()))
    return replace(state, phi=(), phi_dot=(), phi_ddot=(), tau=(), wrench=MappingProxyType(remaining))


def judge_jacobian(case: Case, rows: Rows) -> None:
    """All matrices of `forward_jacobian` or `coupled_jacobian` by automatic differentiation of the second derivation.

    The scale is that of the acceleration over the size of what it is differentiated by.
    """
    want = rows.function.removesuffix("_jacobian")
    names = FUNCTIONS[rows.function].gives if case.count else ("V_dot_V",)
    if case.stand.hold is not None:  # u stands in place of V
        names = tuple(re.sub("_V$", "_u", re.sub("^V_dot", "u_dot", name)) for name in names)
    parts = {name: re.fullmatch("(V_dot|u_dot|phi_ddot)_(.*)", name) for name in names}
    pairs = {name: match.groups() for name, match in parts.items() if match}
    by = tuple(dict.fromkeys(by_what for _, by_what in pairs.values()))
    patterns = {"derivatives": [(np.zeros(case.count, dtype=bool), case.states[:JACOBIAN_STATES])]}
    if want == "coupled":
        locked_states = enumerate(case.states[:LOCKED_STATES])
        patterns["derivatives, with locks"] = [
            (case.lock_pattern(k), [locked_state]) for k, locked_state in locked_states
        ]
    for quantity, trials in patterns.items():
        check = rows.check(quantity)
        for locked, states in trials:
            judge = Derivatives(case.second, want, by, list(locked) if locked.any() else ())
            for name, state in states:
                try:
                    answer = case.call(rows.function, case.backend.arguments(state) | {"locked": [*map(int, locked)]})
                except StateError as error:
                    check.refuse(error, name)
                    continue
                try:
                    expected = judge.evaluate(state)
                except StateError as error:
                    check.skip(f"its judge refused: {error}", name)
                    continue
                measured, sizes = case.scales.want(state, want if case.count else "forward"), _sizes(case, state)
                if measured is None:
                    check.skip("the reference has no answer", name)
                    continue
                for matrix, (value, by_what) in pairs.items():
                    scale = np.divide.outer(measured.scales[value], sizes[by_what])
                    check.compare(answer[matrix], expected[matrix], scale, f"{name}, {matrix}")


def _sizes(case: Case, state: State) -> dict[str, Array]:
    """Size of what is differentiated by: the largest |v|, |omega|, of the freedoms of one kind, |phi'| ..."""
    N, sizes = case.count, {"V": np.repeat([np.abs(state.V[:3]).max(), np.abs(state.V[3:]).max()], 3)}
    if case.stand.hold is not None:
        kinds = [freedom.kind for freedom in case.stand.hold.freedoms]
        largest = {
            kind: max(abs(u) for u, other in zip(state.u, kinds, strict=True) if other == kind) for kind in kinds
        }
        sizes["u"] = np.array([largest[kind] for kind in kinds])
    most = {key: np.abs(getattr(state, key)).max(initial=1e-9) for key in ("phi_dot", "phi_ddot", "tau")}
    return sizes | {"phi": np.ones(N)} | {key: np.full(N, size) for key, size in most.items()}


def judge_wrap(case: Case, rows: Rows) -> None:
    """An angle, but for whole turns, within half a turn."""
    check = rows.check("phi, of the promised error")
    for phi in _angles(case, case.random(len(rows.function))):
        (wrapped,) = case.call(rows.function, {"phi": phi}).values()
        off = Fraction(wrapped) - Fraction(phi)
        off -= TURN * round(off / TURN)
        beyond = max(0.0, abs(wrapped) - math.pi * (1 + case.unit))
        check.note((abs(float(off)) + beyond) / (PROMISE * case.unit), f"{rows.function} of {phi}")


def _angles(case: Case, rng: np.random.Generator) -> list[float]:
    """Angles in the range, among them odd multiples of pi: there the nearest number of turns hangs on rounding."""
    (most,) = limits_of("phi", case.real)
    edges = (2 * rng.integers(-100, 100, 100) + 1) * math.pi
    angles = [0.0, math.pi, -math.pi, most, -most, *edges, *rng.uniform(-most, most, 200), *rng.normal(size=50)]
    result: list[float] = np.clip(case.nearest_numbers(angles), -most, most).tolist()
    return result
