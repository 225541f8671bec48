"""Judges of functions whose answer is a value: an equation of the literal reference, with its measured scale."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.core.lower.values import parameters_of
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.numbers import StandNumbers
from mahovik.core.stand.read import read
from mahovik.core.stand.state import State, rest_state
from mahovik.core.stand.toml import parse
from mahovik.core.stand.write import dumps
from mahovik.errors import StandError, StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.coordinates import check_attitude, kinematic_matrix, kinematic_matrix_rate, pose_of
from mahovik.proof.reference.motion import coupled
from mahovik.proof.reference.regressor import identify_step, slopes
from mahovik.proof.reference.rotation import C1, attitude, quaternion_rotation
from mahovik.proof.reference.screw import block_diagonal, twists
from mahovik.proof.second import Second
from mahovik.proof.second.evaluate import Derivatives
from mahovik.proof.verify.backends import turns
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.functions.case import Case, Rows
from mahovik.proof.verify.scales import Equation, turning
from mahovik.proof.verify.states import Request

ATTITUDES = 12
"""Attitudes and coordinates tried, some of them after several turns."""

OTHER_STANDS = 3
"""Stands with other parameters that are tried."""

JACOBIAN_STATES, LOCKED_STATES = 4, 1
"""States at which a Jacobian is judged, and with locks: each pattern needs a derivative of its own."""

DEVIATION, NOISE, FORGET = 1e-3, 0.1, 0.1
"""kg m: deviation of the unbalances before a sample; noise, a part of what these make of a channel; `forget`."""


@dataclass(frozen=True)
class Trial:
    """One call of a function: name, state that the equation is evaluated at, arguments, equation.

    read  the quantities of the equation from the results
    """

    name: str
    state: State
    given: Mapping[str, Any]
    equation: Equation
    read: Callable[[Mapping[str, Any]], Mapping[str, Any]] = dict


def trial_checks(case: Case, function: str, trials: Callable[[Case], Iterator[Trial]], suffix: str = "") -> list[Check]:
    """A check for each quantity of the trials."""
    rows = Rows(case.limits, case.scales, function)
    for trial in trials(case):
        try:
            found = trial.read(case.call(function, trial.given))
        except StateError as error:
            rows.check("answer").refuse(error, trial.name)
            continue
        rows.compare(trial.name, trial.state, trial.equation, found, suffix)
    return list(rows.checks.values())


def state_trials(case: Case, equation: Equation) -> Iterator[Trial]:
    """An equation at every state, with the state as arguments."""
    for name, state in case.states:
        yield Trial(name, state, case.backend.arguments(state), equation)


def trials_of_given_sines(case: Case, function: str) -> Iterator[Trial]:
    """A function that answers a want, with the sines and cosines of the phases; it need not look at the phases."""

    def equation(stand: Stand, state: State, at: reference.Pieces) -> Values:
        return reference.evaluate(stand, state, (function,), at, case.scales.cuts)

    for name, state in case.states:
        given = case.backend.arguments(state) | turns(state)
        given["x"] = given["x"] | {"phi": [0.0] * case.count}

        def read(found: Mapping[str, Any], given: Mapping[str, Any] = given) -> Mapping[str, Any]:
            return case.backend.with_reaction(given, dict(found)) if function in ("forward", "coupled") else found

        yield Trial(name, state, given, equation, read)


def locked_trials(case: Case) -> Iterator[Trial]:
    """`coupled` with some flywheels locked."""
    for number, (name, state) in enumerate(case.states):
        locked = case.lock_pattern(number)

        def equation(stand: Stand, state: State, at: reference.Pieces, locked: Array = locked) -> Values:
            V_dot, phi_ddot = coupled(at, vector(state.tau), locked)
            return {"V_dot": V_dot, "phi_ddot": phi_ddot}

        yield Trial(name, state, case.backend.arguments(state) | {"locked": [int(x) for x in locked]}, equation)


def estimate_trials(case: Case) -> Iterator[Trial]:
    """The factored step of recursive least squares against the literal covariance form, from random estimates."""
    n = 2 * case.count
    for number, (name, state) in enumerate(case.states):
        rng = case.random(number)
        given = {
            "unbalance": case.nearest_numbers(DEVIATION * rng.normal(size=n)).tolist(),
            "variance": case.nearest_numbers(DEVIATION**2 * rng.uniform(0.5, 1.5, n)).tolist(),
            "factor": case.nearest_numbers(0.3 * rng.normal(size=n * (n - 1) // 2)).tolist(),
            "largest": 1.0,
        }
        H, u, P = slopes(case.stand, state), np.array(given["unbalance"]), covariance(given)
        noise = case.nearest_numbers(NOISE * np.sqrt(np.diag(H @ P @ H.T)))

        def equation(stand: Stand, near: State, _: Any, noise: Array = noise, u: Array = u, P: Array = P) -> Values:
            return dict(zip(("unbalance", "covariance"), identify_step(stand, near, noise, FORGET, u, P), strict=True))

        inputs = {**case.backend.arguments(state), "noise": noise.tolist(), "forget": FORGET, "estimate": given}
        yield Trial(name, state, inputs, equation, lambda found: {
            "unbalance": found["estimate"]["unbalance"], "covariance": covariance(found["estimate"])
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
            lambda found: {"C": quaternion_rotation(*found["attitude"])},
        )  # fmt: skip


def coordinate_trials(case: Case) -> Iterator[Trial]:
    """Pose, V = A q' and V* = A q'' + D q' of (10), of a held carrier those of its freedoms; phases are kept."""
    rng = case.random(2)
    sizes = {}
    if case.stand.hold is not None:
        takes = case.backend.program.function("state_from_coordinates").arguments
        sizes = {a.name: int(a.shape[0]) for a in takes if a.name.startswith(("q", "orientation"))}
    table = case.backend.arguments(rest_state(case.stand))["table"]
    for name, state in _attitudes(case):
        kept = {key: case.nearest_numbers(rng.normal(size=case.count)).tolist() for key in ("phi", "phi_dot")}
        x = {"position": [0.0] * 3, "attitude": [1.0, 0.0, 0.0, 0.0], "V": [0.0] * 6} | (kept if case.count else {})
        if case.stand.hold is None:
            drawn = [case.nearest_numbers(rng.normal(size=size)).tolist() for size in (3, 6, 6)]
            own = {"position": drawn[0], "q_dot": drawn[1], "q_ddot": drawn[2], "angles": list(_angles_of(state))}
            at = replace(state, position=tuple(drawn[0]), V=tuple(drawn[1]), V_dot=tuple(drawn[2]))
            equation: Equation = _free_coordinates
        else:
            own = {key: case.nearest_numbers(rng.normal(size=size)) for key, size in sizes.items()}
            if "orientation" in own:
                own["orientation"] = case.nearest_numbers(own["orientation"] / np.linalg.norm(own["orientation"]))
            own = {key: each.tolist() for key, each in own.items()}
            turned = tuple(own["orientation"]) if "orientation" in own else None
            at = replace(
                state, angles=None, quaternion=turned, demand=tuple(own.get("q", ())), u=tuple(own["q_dot"]),
                u_dot=tuple(own["q_ddot"]),
            )  # fmt: skip
            equation = _held_coordinates

        def read(found: Mapping[str, Any], kept: dict[str, Any] = kept) -> Mapping[str, Any]:
            x = found["x"]
            same = not case.count or all(list(x[key]) == kept[key] for key in kept)
            pose = {"position": x["position"], "C": quaternion_rotation(*x["attitude"]), "V": x["V"]}
            return pose | {"V_dot": found["V_dot"], "phases kept": same}

        yield Trial(name, at, {**own, "table": table, "x": x}, equation, read)


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
    return {"position": at.position, "C": at.C, "V": at.V, "V_dot": at.V_dot, "phases kept": True}


def _attitudes(case: Case) -> Iterator[tuple[str, State]]:
    """States at rest with angles as the element type has them."""
    rng = case.random(1)
    for number in range(ATTITUDES):
        angles = case.nearest_numbers(rng.uniform(-math.pi, math.pi, 3) * (20.0 if number % 4 == 3 else 1.0))
        yield f"attitude {number}", replace(rest_state(case.stand), angles=_vector(angles), quaternion=None)


def _angles_of(state: State) -> Vec3:
    return state.angles or (0.0, 0.0, 0.0)


def _vector(a: Any) -> Vec3:
    x, y, z = (float(each) for each in a)
    return x, y, z


def other_parameters(case: Case, function: str) -> list[Check]:
    """Wants of stands with other parameters, by the tables that `prepare` and `prepare_mounts` make of them."""
    asked = ("mounts",) if function == "prepare_mounts" else ("matrices", "momentum", "forward", "torque", "points")
    known = case.backend.wants_of(case.backend.complete.program)
    check = Check(function, "answers, with other parameters", case.limits.value)
    for number in range(OTHER_STANDS):
        other = _with_other_parameters(case.stand, case.random(200 + number))
        judge = Judge(other, case.limits)
        try:
            given = {"parameters": parameters_of(other, case.backend.layout), "table": case.backend.table()}
            table = {"table": case.call("prepare", given)["table"]}
            if function == "prepare_mounts":
                table["mounting"] = case.call("prepare_mounts", given)["mounting"]
        except StandError:  # beyond the range of parameters
            continue
        except StateError as error:
            check.refuse(error, f"stand {number + 1}")
            continue
        for name, state in case.states[number::OTHER_STANDS]:
            for want in (want for want in asked if want in known):
                found = case.backend.answer(want, state, case.backend.arguments(state) | table)
                judge.compare(Request(f"{name} of stand {number + 1}", state, (want,)), want, found)
        for each in judge.checks():
            check.note(each.value, f"{each.state}, {each.quantity}", each.words)
    return [check]


def _with_other_parameters(stand: Stand, rng: np.random.Generator) -> Stand:
    """The stand with other masses, inertias and centres of mass, its flywheels, instruments and points elsewhere.

    As physical as the stand: mass and inertia grow together, and centres of mass come nearer to the origin.
    """
    file = StandNumbers(stand, parse(dumps(stand)))
    grown = {body.name: rng.uniform(1.01, 1.05) for body in stand.bodies}
    moved, values = {point.name for point in stand.points} | grown.keys() - {stand.carrier.name}, {}
    for number in file:
        key = number.path.removeprefix(f"{number.body}.").partition(".")[0].partition("[")[0]
        if number.body in grown and key in ("mass", "inertia", "center_of_mass"):
            values[number] = number.value * (grown[number.body] if key != "center_of_mass" else rng.uniform(0.95, 0.99))
        elif number.body in moved and key in ("position", "angles", "axis", "zero"):
            values[number] = number.value + rng.uniform(-0.05, 0.05)
    return read(file.with_values(values), stand.name, physics=False)


def mount_checks(case: Case, function: str) -> list[Check]:
    """Mount wrenches by the second derivation: element 4 is tau, and all six move the carrier as the flywheels do.

    Carrier and instruments alone, with the reactions of the mounts as wrenches on the carrier, must have the V* of the
    whole stand: Lagrange's equations of the stand without flywheels know nothing of what mounts bear.
    """
    torque = Check(function, "element 4, tau of the second", case.limits.value, floor=case.limits.floor)
    motion = Check(function, "V_dot under the reactions", case.limits.value, floor=case.limits.floor)
    bare = replace(case.stand, flywheels=(), points=())
    second = Second(bare)
    for name, state in case.states:
        try:
            V_dot = case.call("forward", case.backend.arguments(state))["V_dot"]
            u_dot: tuple[float, ...] = ()
            if case.stand.hold is not None:
                u_dot = tuple(np.linalg.lstsq(twists(case.stand.hold), np.array(V_dot), rcond=None)[0].tolist())
            moving = replace(state, V_dot=tuple(V_dot), u_dot=u_dot)
            found = case.call("mounts", case.backend.arguments(moving))["mount_wrench"]
        except StateError as error:
            torque.refuse(error, name)
            continue
        wrenches, own = np.array(found, dtype=np.float64).reshape(-1, 6), case.scales.want(moving, "torque")
        forward = case.scales.want(state, "forward")
        if own is None or forward is None:
            continue
        try:
            tau = case.second.evaluate(moving, ("torque",))["tau"]
            torque.compare(wrenches[:, 3], tau, own.scales["tau"] + turning(case.scales.at(moving))[:, 3], name)
            alone = _without_flywheels(moving, case.scales.at(moving), wrenches, bare)
            if not case.stand.carrier.mass or np.linalg.eigvalsh(reference.pieces(bare, alone).K)[0] <= 0.0:
                raise StateError("the mass matrix of the stand without flywheels is not positive definite")
            found = second.evaluate(alone, ("forward",))["V_dot"]
            motion.compare(V_dot, found, forward.scales["V_dot"], name)
        except StateError as error:  # such as that of a carrier without inertia
            motion.skip(f"its judge refused: {error}", name)
    return [torque, motion]


def _without_flywheels(state: State, at: reference.Pieces, wrenches: Array, bare: Stand) -> State:
    """The state of carrier and instruments alone, under the reactions of the mounts."""
    reaction = np.array(state.wrench.get("carrier", (0.0,) * 6))
    for s, wrench in zip(at.flywheels, wrenches, strict=True):
        reaction = reaction - s.L @ block_diagonal(C1(s.phi)).T @ wrench  # from the axes of Es at phi = 0
    names = {body.name for body in bare.bodies}
    own = {body: wrench for body, wrench in state.wrench.items() if body in names}
    own["carrier"] = cast(Vec6, tuple(reaction.tolist()))
    return replace(state, phi=(), phi_dot=(), phi_ddot=(), tau=(), wrench=MappingProxyType(own))


def jacobian_checks(case: Case, function: str) -> list[Check]:
    """All matrices of `forward_jacobian` or `coupled_jacobian` by automatic differentiation of the second derivation.

    The scale is that of the acceleration over the size of what it is differentiated by.
    """
    want = function.removesuffix("_jacobian")
    names = FUNCTIONS[function].gives if case.count else ("V_dot_V",)
    if case.stand.hold is not None:  # u stands in place of V
        names = tuple(re.sub("_V$", "_u", re.sub("^V_dot", "u_dot", name)) for name in names)
    by = tuple(dict.fromkeys(re.sub("^(V_dot|u_dot|phi_ddot)_", "", name) for name in names))
    plain = Check(function, "derivatives", case.limits.derivative, floor=case.limits.floor)
    with_locks = Check(function, "derivatives, with locks", case.limits.derivative, floor=case.limits.floor)
    none = np.zeros(case.count, dtype=bool)
    derivatives = Derivatives(case.second, want, by)
    trials = [(plain, derivatives, none, *each) for each in case.states[:JACOBIAN_STATES]]
    if want == "coupled":
        for number, each in enumerate(case.states[:LOCKED_STATES]):
            locked = case.lock_pattern(number)
            trials.append((with_locks, Derivatives(case.second, want, by, list(locked)), locked, *each))
    for check, judge, locked, name, state in trials:
        try:
            found = case.call(function, case.backend.arguments(state) | {"locked": [int(x) for x in locked]})
        except StateError as error:
            check.refuse(error, name)
            continue
        measured = case.scales.want(state, want if case.count else "forward")
        try:
            expected = judge.evaluate(state)
        except StateError as error:
            check.skip(f"its judge refused: {error}", name)
            continue
        if measured is None:
            continue
        sizes = _sizes(case, state)
        for quantity in names:
            value, given = _parts(quantity, by)
            scale = np.divide.outer(measured.scales[value], sizes[given])
            check.compare(found[quantity], expected[quantity], scale, f"{name}, {quantity}")
    return [plain, with_locks] if want == "coupled" else [plain]


def _parts(quantity: str, by: tuple[str, ...]) -> tuple[str, str]:
    """The value and what it is differentiated by: V_dot and phi_dot of `V_dot_phi_dot`."""
    given = max((each for each in by if quantity.endswith(f"_{each}")), key=len)
    return quantity.removesuffix(f"_{given}"), given


def _sizes(case: Case, state: State) -> dict[str, Array]:
    """Size of what is differentiated by: the largest |v|, |omega|, of the freedoms of one kind, |phi'| ..."""
    N, sizes = case.count, {"V": np.repeat([np.abs(state.V[:3]).max(), np.abs(state.V[3:]).max()], 3)}
    if case.stand.hold is not None:
        kinds = [freedom.kind for freedom in case.stand.hold.freedoms]
        largest = {kind: max(abs(u) for u, own in zip(state.u, kinds, strict=True) if own == kind) for kind in kinds}
        sizes["u"] = np.array([largest[kind] for kind in kinds])
    most = {key: np.abs(getattr(state, key)).max(initial=1e-9) for key in ("phi_dot", "phi_ddot", "tau")}
    return sizes | {"phi": np.ones(N)} | {key: np.full(N, size) for key, size in most.items()}
