"""Judges of the steps: the literal reference integrated, the order of convergence, and the status COARSE."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from typing import Any

import numpy as np

from mahovik.contract import laws
from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import bodies_of
from mahovik.proof.reference.hold import acceleration, accelerations
from mahovik.proof.reference.rotation import Pose, carrier_rotation, quaternion_rotation
from mahovik.proof.reference.screw import cross
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case

SHORT_STEPS = {"double": 10_000, "float": 100_000}
"""Short steps of order 2 in a motion that 32 steps follow: in float most increments are below the last place."""

COARSE_EDGE, COARSE_ANSWERS = 1e-3, 2
"""Relative distance of a step from the bound of COARSE; answers that are judged on each side of it, for each order."""

STATES = 2
"""States from which a motion starts, and more where none of these is compared; of `step`, the second has locked
flywheels."""

RADIANS = 0.25
"""Length of a motion: time in which the fastest of rotation, vibration and decay turns by this angle, and the hardest
driven of flywheels and carrier, from rest, as well."""

SHORTER = (1.0, 1 / 4, 1 / 16, 1 / 64)
"""Parts of this time that are compared: the first on whose way no law has a kink."""

ORDER_OVER = (1.0, 1 / 4, 4.0)
"""Likewise the multiples of this time over which the order is looked for, longer ones where rounding hides it."""

FINE, COARSE = (32, 64, 128), {4: (2, 4, 8), 2: (8, 16, 32)}
"""Steps of the compared motion (order 4; more only where fewer do not suffice: no error of the equations falls with
them), and those from which the order is seen."""

LARGE = 1e-3
"""Relative error above which the steps are too long to show their order."""

Rates = Callable[[Array], Array]

MIDPOINTS = (2, 4, 6, 8, 10, 12)
"""Numbers of steps of the modified midpoint rule that are extrapolated: order 12, exact for half of RADIANS."""


def extrapolated_step(rates: Rates, y: Array, time: float) -> Array:
    """y after a time (s), by Gragg's extrapolation of the modified midpoint rule.

    Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9.
    """
    table: list[Array] = []
    for row, count in enumerate(MIDPOINTS):
        step, before = time / count, y
        after = y + step * rates(y)
        for _ in range(count - 1):
            before, after = after, before + 2.0 * step * rates(after)
        found = [(after + before + step * rates(after)) / 2.0]
        for k in range(row):
            ratio = (count / MIDPOINTS[row - 1 - k]) ** 2
            found.append(found[k] + (found[k] - table[k]) / (ratio - 1.0))
        table = found
    return table[-1]


def quaternion_of(C: Array) -> tuple[float, float, float, float]:
    """Unit quaternion, w first, of a rotation (3x3): the largest eigenvector of Bar-Itzhack's matrix."""
    (a, b, c), (d, e, f), (g, h, i) = C
    largest = np.linalg.eigh([
        [a + e + i, h - f, c - g, d - b],
        [h - f, a - e - i, b + d, c + g],
        [c - g, b + d, e - a - i, f + h],
        [d - b, c + g, f + h, i - a - e],
    ])[1][:, -1]  # fmt: skip
    w, x, y, z = (float(each) for each in largest)
    return w, x, y, z


def step_checks(case: Case, function: str) -> Iterator[Check]:
    """Agreement of the motion by order 4, and the order of convergence of both methods."""
    agreement = Check(function, "state at the end of a motion", case.limits.integration)
    sought = COARSE if case.real == "double" else ()  # in float rounding hides the order of the same program
    orders = {order: Check(function, f"order {order}: order seen", case.limits.order) for order in sought}
    seen: dict[int, tuple[float, str]] = {}
    for number, (name, state) in enumerate(case.states):
        if number >= STATES and agreement.states:
            break
        locked = case.lock_pattern(0) if function == "step" and number == 1 else None
        motion = Motion(case, function, state, locked)
        try:
            off = motion.first(SHORTER, motion.least_error)
            if off is not None:
                agreement.note(off, name)
            for order in set(sought) - set(seen):
                found = motion.first(ORDER_OVER, partial(motion.observed_order, order))
                if found is not None:
                    seen[order] = found, name
        except StateError as error:
            agreement.refuse(error, name)
    yield agreement
    for order, row in orders.items():
        if order in seen:
            row.note(abs(seen[order][0] - order), seen[order][1], f"{seen[order][0]:.2f}")
        else:
            row.words = "rounding, or a law with |V|, hides the order"
        yield row
    yield _coarse(case, function)


class Motion:
    """Motions from one state, by the program and by the reference, over the same time."""

    def __init__(self, case: Case, function: str, state: State, locked: Array | None) -> None:
        self._case, self._function, self._state, self._locked = case, function, state, locked
        self._bodies = bodies_of(case.stand)
        self._start = _flat(state, carrier_rotation(case.stand, state))
        # a power of two, so that a float has it and its halves exactly
        self.time = 2.0 ** math.floor(math.log2(RADIANS / self._rate()))
        self._dragged = any(law.has_kinks for body in case.stand.bodies for law in body.laws)
        self._smooth = not self._dragged and not self._branches(self._start).size
        self._kink_within = math.inf  # s: shortest time known to have a kink

    def first(self, parts: Sequence[float], judged: Callable[[float], float | None]) -> float | None:
        """What `judged` says of the first time (s) that has no kink on its way and an answer; None where none has."""
        for part in parts:
            time = part * self.time
            if time >= self._kink_within:
                continue
            if self._has_kink(time):
                self._kink_within = time
                continue
            found = judged(time)
            if found is not None:
                return found
        return None

    @lru_cache(maxsize=16)  # noqa: B019 - a motion lives as long as its rows are made
    def _reference_states(self, time: float) -> tuple[Array, Array]:
        """States of the reference on the way (a column each), and the size of each number's group."""
        # many where a kink is looked for on the way
        count = max(2 if self._smooth else 16, math.ceil(2.0 * time / self.time))
        way = [self._start]
        for _ in range(count):
            way.append(extrapolated_step(self._rates, way[-1], time / count))
        return np.array(way).T, _group_sizes(self._start, way[-1] - self._start, self._case.count)

    def _has_kink(self, time: float) -> bool:
        """Whether a component of some body's twist relative to the fluid changes sign, where |V| has a kink, or a law
        passes to another branch."""
        if self._smooth:
            return False
        branches = np.array([self._branches(y) for y in self._reference_states(time)[0].T])
        return bool(np.any(branches != branches[0]))

    def _branches(self, y: Array) -> Array:
        """Signs of the twists where a drag has kinks, and the branches of the laws on the carrier that have some."""
        C = y[3:12].reshape(3, 3)
        state, at = self._at(y, C), Pose(y[:3], C, y[12:18])
        found = [
            law.branches(self._case.stand, state, at) for law in laws.parts("reference") if hasattr(law, "branches")
        ]
        return np.concatenate([np.zeros(0), *found, *([np.sign(self._twists(y))] if self._dragged else [])])

    def _twists(self, y: Array) -> Array:
        """Twists of all bodies relative to the fluid, one after the other, each in its own frame."""
        at = reference.pieces(self._case.stand, self._at(y, y[3:12].reshape(3, 3)), self._bodies)
        return at.bodies.twists(at.V_r).ravel()

    def error(self, order: int, steps: int, time: float) -> float:
        """Difference of the two ends, relative to the state and its change, of the worst component."""
        case = self._case
        given = case.backend.arguments(self._state) | {"dt": time / steps, "order": order}
        if self._locked is not None:
            given["locked"] = [int(x) for x in self._locked]
        x, given["carry"] = given["x"], {"rounding": [0.0] * case.numbers}
        for _ in range(steps):
            results = case.call(self._function, given | {"x": x})
            x, given["carry"] = results["next"], results.get("carry")
        return self.difference(x, time)

    def difference(self, x: Mapping[str, Any], time: float) -> float:
        """Difference of a state from that of the reference after a time, likewise."""
        case, (way, sizes) = self._case, self._reference_states(time)
        found = [x["position"], quaternion_rotation(*x["attitude"]).ravel(), x["V"]]
        off = np.concatenate([*found, x.get("phi", []), x.get("phi_dot", [])]) - way[:, -1]
        turned = slice(18, 18 + case.count)
        off[turned] = np.remainder(off[turned] + math.pi, 2 * math.pi) - math.pi
        return float(np.max(np.abs(off) / sizes))

    def least_error(self, time: float) -> float:
        """Difference of the two ends by order 4, with as many steps as it needs."""
        off = math.inf
        for steps in FINE:
            off = self.error(4, steps, time)
            if off <= self._case.limits.integration:
                break
        return off

    def observed_order(self, order: int, time: float) -> float | None:
        """The power of the step with which errors fall; None where they are hidden by rounding, or far from small, or
        where so slow a motion takes steps that the C refuses.
        """
        if time / COARSE[order][0] > BOUNDS["MAX_STEP"].value:
            return None
        errors = [self.error(order, n, time) for n in COARSE[order]]
        if errors[-1] < 1e4 * self._case.unit or errors[0] > LARGE:
            return None
        return math.log2(errors[-2] / errors[-1])

    def _rates(self, y: Array) -> Array:
        """d/dt of O1 in E0 (3), C (9), V (6), phi, phi' (N each): O1' = C v, C' = C <omega>."""
        N = self._case.count
        C, V = y[3:12].reshape(3, 3), y[12:18]
        state = self._at(y, C)
        at = reference.pieces(self._case.stand, state, self._bodies)
        if not self._function.startswith("step_driven"):
            locked = np.zeros(N, dtype=bool) if self._locked is None else self._locked
            V_dot, phi_ddot = accelerations(at, self._case.stand, np.array(state.tau), locked)
        else:
            phi_ddot = np.array(state.phi_ddot, dtype=np.float64)
            V_dot = acceleration(at, self._case.stand, phi_ddot)
        return np.concatenate([C @ V[:3], (C @ cross(V[3:])).ravel(), V_dot, y[18 + N :], phi_ddot])

    def _at(self, y: Array, C: Array) -> State:
        """The state at y."""
        N, start = self._case.count, self._state
        w, x, y_, z = quaternion_of(C)
        given: dict[str, Any] = {
            "position": tuple(y[:3]), "angles": None, "quaternion": (w, x, y_, z), "V": tuple(y[12:18]),
            "phi": tuple(y[18 : 18 + N]), "phi_dot": tuple(y[18 + N :]),
        }  # fmt: skip
        return State(**given, phi_ddot=start.phi_ddot, V_dot=start.V_dot, tau=start.tau, wrench=start.wrench)

    def _rate(self) -> float:
        """The fastest rate (1/s): of turning, of the eigenvalues of the linearised motion, and of turning from rest."""
        y, N = self._start, self._case.count
        base = self._rates(y)
        steps = 1e-6 * np.maximum(np.abs(y), 1e-2)
        columns = [(self._rates(y + step * e) - base) / step for step, e in zip(steps, np.eye(len(y)), strict=True)]
        fastest = float(np.abs(np.linalg.eigvals(np.column_stack(columns))).max())
        turning = float(np.linalg.norm(y[15:18])) + float(np.abs(y[18 + N :]).max(initial=0.0))
        driven = float(np.abs([*base[15:18], *base[18 + N :]]).max())  # rad/s2; a small wheel is driven hard
        return max(fastest, turning, math.sqrt(0.5 * RADIANS * driven), 1e-3)


def _flat(state: State, C: Array) -> Array:
    """O1 (3), C (9), V (6), phi, phi' (N each) of a state."""
    return np.concatenate([state.position, C.ravel(), state.V, state.phi, state.phi_dot])


def _group_sizes(start: Array, change: Array, N: int) -> Array:
    """Size of each number's group (position, attitude, v, omega, phases, speeds) and of the group's change."""
    sizes = []
    for first, last in ((0, 3), (3, 12), (12, 15), (15, 18), (18, 18 + N), (18 + N, 18 + 2 * N)):
        part = np.abs(start[first:last]).max(initial=0.0) + np.abs(change[first:last]).max(initial=0.0)
        floor = 1.0 if (first, last) in ((3, 12), (18, 18 + N)) else 1e-9
        sizes += [max(part, floor)] * (last - first)
    return np.array(sizes)


def carried_checks(case: Case, function: str) -> Iterator[Check]:
    """Agreement of a motion in some steps of order 4, and in a great number of short steps of order 2."""
    few = Check(function, "state at the end of a motion", case.limits.integration)
    many = Check(function, "likewise, in very many steps", case.limits.short_steps)
    for name, state in case.states:
        if few.states and many.states:
            break
        motion = Motion(case, function, state, None)
        try:
            off = motion.first(SHORTER, motion.least_error)
            if off is not None:
                few.note(off, name)
            off = motion.first(SHORTER, partial(_error_of_short_steps, case, function, motion, state))
            if off is not None:
                many.note(off, name)
        except StateError as error:
            few.refuse(error, name)
    yield few
    yield many
    yield _coarse(case, function)


def _error_of_short_steps(case: Case, function: str, motion: Motion, state: State, time: float) -> float:
    """Difference of the ends of a motion in very many steps."""
    return motion.difference(end_of_steps(case.backend, function, state, time, SHORT_STEPS[case.real]), time)


def end_of_steps(
    backend: CBackend, function: str, state: State, time: float, steps: int, order: int = 2
) -> dict[str, Any]:
    """The state after equal steps, called in place: a state is not read between them. Raises StateError."""
    ffi, name = backend.library.ffi, backend.program.name
    given = backend.arguments(state)
    x = ffi.new(f"{name}_state *", given["x"])
    known: dict[str, Any] = {
        "table": given["table"],
        "x": x,
        "tau": ffi.new(f"{name}_real[]", [*given["tau"], 0.0]),
        "phi_ddot": ffi.new(f"{name}_real[]", [*given["phi_ddot"], 0.0]),
        "wrench": ffi.new(f"{name}_real[]", [*given["wrench"], 0.0]),
        "locked": ffi.new("int[]", len(state.phi) + 1),
        "dt": time / steps,
        "order": order,
        "carry": ffi.new(f"{name}_step_carry *"),
        "next": x,
    }
    arguments = [known[a.name] for a in backend.program.function(function).arguments]
    call = backend.library.function(function)
    for _ in range(steps):
        status = call(*arguments)
        if status < 0:
            raise StateError(f"{function} refused with status {status_words(status)}")
    return {f.name: np.array(list(getattr(x, f.name)), dtype=np.float64) for f in backend.layout.state.fields}


def _coarse(case: Case, function: str) -> Check:
    """COARSE if and only if dt times the fastest of |phi_dot| and |omega| exceeds the bound of the order.

    Every state is taken as it is, and with resting flywheels, where the carrier turns fastest.
    """
    row = Check(function, "status COARSE", 0.0)
    count = {(order, side, still): 0 for order in (2, 4) for side in (-1, 1) for still in (False, True)}
    for name, state in case.states:
        for (order, side, still), answers in count.items():
            if answers >= COARSE_ANSWERS:
                continue
            given = case.backend.arguments(state)
            speeds = np.zeros(case.count) if still else np.array(state.phi_dot, dtype=np.float64)
            fastest = max(float(np.linalg.norm(state.V[3:])), float(np.abs(speeds).max(initial=0.0)))
            if not fastest > 0.0:
                continue
            dt = float(BOUNDS[f"MAX_TURN_{order}"].value) / fastest * (1 + side * COARSE_EDGE)
            x = given["x"] | ({"phi_dot": tuple(speeds)} if case.count else {})
            carry = {"rounding": [0.0] * case.numbers}
            status, _ = case.backend.call(function, given | {"x": x, "dt": dt, "order": order, "carry": carry})
            if status < 0:  # a stage of a long step may be out of range, and dt itself
                continue
            count[order, side, still] += 1
            wrong = status != (STATUS_VALUES["COARSE"] if side > 0 else STATUS_VALUES["OK"])
            words = f"status {status_words(status)} at {1 + side * COARSE_EDGE:g} of the bound of order {order}"
            row.demand(not wrong, name, words)
    missing = [f"order {order}" for (order, side, _), answers in count.items() if side > 0 and not answers]
    if row.states and missing:
        row.words = row.words or f"no step above the bound answered: {', '.join(dict.fromkeys(missing))}"
    return row
