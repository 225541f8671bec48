"""Judge of the steps: the motion of the literal reference, integrated; the order of both methods; the status COARSE."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from itertools import pairwise
from typing import Any, cast

import numpy as np

from mahovik.contract.limits import RESTING
from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.model import Quaternion, State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array, cross, quaternion_of, quaternion_rotation, skew_part
from mahovik.proof.reference.motion import coupled, forward
from mahovik.proof.reference.pieces import bodies_of
from mahovik.proof.verify.compare import Case, Rows

STATES = 2
"""States from which a motion starts; of `step`, the second has locked flywheels."""

RADIANS, SLIGHT = 0.25, 1e-6
"""Length of a motion: time in which the fastest of flywheels and carrier turns by this angle, and the hardest driven of
them, from rest, as well, and a vibration of the carrier. Part of it in which its accelerations change slightly."""

SHORTER = tuple(4.0**-k for k in range(9))
"""Parts of this time that are tried: on a short way no law has a kink, and no vibration is too fast for the steps."""

LONGER = (16.0, 4.0, *SHORTER[:3])
"""Likewise where the order is looked for: of a slow motion rounding hides it on a short way."""

STEPS, ORDER_STEPS = 32, {4: (2, 4, 8, 16), 2: (8, 16, 32, 64)}
"""Steps (order 4) of the compared motion, and those from whose differences each order is seen."""

TINY, TINY_STEPS = {"double": 2.0**-45, "float": 2.0**-16}, 64
"""Part of the time in which a state changes by some last places, and steps on this way: a carry keeps what they add."""

MIDPOINTS = (2, 4, 6, 8, 10)
"""Numbers of steps of the modified midpoint rule that are extrapolated: order 10."""

LARGE, STEADY, SMOOTH = 1e-3, 0.3, 0.1
"""Relative difference above which the steps are too long to show their order; by how much it differs between pairs
of them at most; and part of a difference that the reference differs by, with steps half as long, where there is no kink
of a law on the way."""

COARSE_EDGE, COARSE_ANSWERS = 1e-3, 2
"""Relative distance of a step from the bound of COARSE; answers that are judged on each side of it, for each order."""


def judge_steps(case: Case, rows: Rows) -> None:
    """Agreement of the motion by order 4, order of convergence of both methods; COARSE. With a carry agreement, also of
    changes of some last places.

    Every motion is judged over the first part of its time on which it agrees: a wrong equation agrees on none.
    """
    for carried in ("", ", with a carry"):
        _judge_motions(case, rows, carried)
    _judge_coarse(case, rows)


def _judge_motions(case: Case, rows: Rows, carried: str) -> None:
    """Rows of motions; `carried`: with a carry, in words."""
    agreement = rows.check(f"motion{carried}")
    orders = {}
    if case.real == "double" and not carried:  # in float rounding hides the order of the same program
        orders = {order: rows.check(f"order {order}, as seen", "order") for order in ORDER_STEPS}
    for number, (name, state) in enumerate(case.states):
        unseen = {order: check for order, check in orders.items() if not check.states}
        if number >= STATES and not unseen:
            break
        locked = case.lock_pattern(0) if number == 1 and rows.function == "step" else None
        motion = Motion(case, rows.function, state, locked, bool(carried))
        try:
            if number < STATES:
                agreement.note(_least(motion.error, agreement.limit), name)
            if number < STATES and carried:
                few = rows.check(f"last places{carried}")
                few.note(motion.error(TINY[case.real], TINY_STEPS, order=2), name)
            for order, check in unseen.items():
                off = _least(partial(motion.off_order, order), check.limit, LONGER)
                if off < math.inf:
                    check.note(off, name)
        except StateError as error:
            agreement.refuse(error, name)
    for check in orders.values():
        check.words = check.words if check.states else "rounding, or a law with |V|, hides the order"


def _least(judged: Callable[[float], float], limit: float, parts: Sequence[float] = SHORTER) -> float:
    """What is judged of the first part of the time where it is within its limit, or the least.

    Raises StateError: every part is refused, not only those whose steps are too long.
    """
    result, refusal = list[float](), StateError("no part of the time is tried")
    for part in parts:
        try:
            result.append(judged(part))
        except StateError as error:
            refusal = error
            continue
        if result[-1] <= limit:
            break
    if not result:
        raise refusal
    return min(result)


class Motion:
    """The motion from one state, by the program and by the reference: changes of O1, attitude, v, omega, phi, phi'."""

    def __init__(self, case: Case, function: str, state: State, locked: Array | None, carried: bool) -> None:
        self._case, self._function, self._locked = case, function, locked
        self.carried = carried
        self._driven, self._bodies = function.startswith("step_driven"), bodies_of(case.stand)
        self._arguments = case.backend.arguments(state)
        x = self._arguments["x"]
        names = ("position", "attitude", "V", *(("phi", "phi_dot") if case.count else ()))
        self._x = {name: case.nearest_numbers(x[name]) for name in names}
        self._state = replace(state, angles=None, quaternion=cast(Quaternion, tuple(self._x["attitude"].tolist())))
        self._flat = np.concatenate([x[1:] if name == "attitude" else x for name, x in self._x.items()])
        self._C = quaternion_rotation(*self._x["attitude"])
        self._start = np.concatenate([state.position, self._C.ravel(), state.V, state.phi, state.phi_dot])
        base, N = self._rates(np.zeros(len(self._start))), case.count
        turning = np.linalg.norm(state.V[3:]) + np.abs(self._start[18 + N :]).max(initial=0.0)
        driven = np.abs([*base[15:18], *base[18 + N :]]).max()  # rad/s2; a small wheel is driven hard
        measured = case.scales.want(state, "forward" if self._driven else "coupled")
        scales = {} if measured is None else measured.scales
        self._rounded = {name: np.max(scales.get(name, 0.0), initial=0.0) for name in ("V_dot", "phi_ddot")}
        fastest = max(turning, math.sqrt(0.5 * RADIANS * driven), 1e-3)
        # a power of two, so that a float has it and its parts exactly
        self.time = 2.0 ** math.floor(math.log2(RADIANS / max(fastest, self._vibration(base, SLIGHT / fastest))))

    def _vibration(self, base: Array, dt: float) -> float:
        """Angular frequency, rad/s, with which accelerations of the carrier change: of springs, stops and dampers."""
        with np.errstate(all="ignore"):
            jerk = (self._rates(dt * base) - base) / dt
        largest = max(np.linalg.norm(base[12:18]), RESTING * self._rounded["V_dot"], 1e-20)
        vibration = float(np.linalg.norm(jerk[12:18]) / largest)
        return vibration if math.isfinite(vibration) else 0.0

    def error(self, part: float, steps: int = STEPS, order: int = 4) -> float:
        """Difference of the changes in a part of the time, relative to the largest of each kind, of the worst number.

        What rounding takes from the state in each step may be lost, with a carry what it takes from that; but O1 of a
        held carrier is where its rounded attitude puts it.
        """
        expected, time = self._reference_change(part), part * self.time
        lost = steps * self._case.unit ** (2 if self.carried else 1)
        return self._relative(self._change(time / steps, steps, order) - expected, part, lost)

    def _relative(self, off: Array, part: float, lost: float = 0.0) -> float:
        """Difference of a change from that of the reference, as `error`."""
        expected, N, worst = self._reference_change(part), self._case.count, 0.0
        off[12 : 12 + N] -= 2 * math.pi * np.round(off[12 : 12 + N] / (2 * math.pi))
        hung = self._case.unit if self._case.stand.hold is not None else 0.0
        kinds = [("position", 0, 3), ("attitude", 3, 6), ("V_dot", 6, 9), ("V_dot", 9, 12)]
        kinds += [("phi", 12, 12 + N), ("phi_ddot", 12 + N, 12 + 2 * N)] if N else []
        for kind, first, last in kinds:
            size = max(np.abs(expected[first:last]).max(), part * self.time * self._rounded.get(kind, 0.0), 1e-20)
            state = max(np.abs(self._flat[first:last]).max(), 1.0)
            size += max(lost, hung if kind == "position" else 0.0) * state / self._case.limits.integration
            share = float(np.abs(off[first:last]).max() / size)
            worst = max(worst, math.inf if math.isnan(share) else share)
        return worst

    def off_order(self, order: int, part: float) -> float:
        """How far the power of the step with which differences fall is from the order; inf where it cannot be seen."""
        time = part * self.time
        changes = [self._change(time / steps, steps, order) for steps in ORDER_STEPS[order]]
        first, second, third = (self._relative(finer - coarser, part) for coarser, finer in pairwise(changes))
        places = ORDER_STEPS[order][-1] * self._case.unit * np.maximum(np.abs(self._flat), 1.0)
        if third <= max(self._case.limits.integration, self._relative(places, part)) or first > LARGE:
            return math.inf  # rounding of the state in each step
        finer = self._reference_change(part, 2)
        if self._relative(finer - self._reference_change(part), part) > SMOOTH * third:
            return math.inf  # a kink of a law on the way
        seen, again = math.log2(first / second), math.log2(second / third)
        return abs(again - order) if abs(again - seen) < STEADY else math.inf

    def _change(self, dt: float, steps: int, order: int) -> Array:
        """Change of the state over the motion by `steps` steps of the program. Raises StateError."""
        arguments = self._arguments | {"dt": dt, "order": order}
        if self.carried:
            arguments["carry"] = {"rounding": [0.0] * (13 + 2 * self._case.count)}
        if self._locked is not None:
            arguments["locked"] = [int(is_locked) for is_locked in self._locked]
        for _ in range(steps):
            results = self._case.call(self._function, arguments)
            arguments |= {"x": results["next"], "carry": results.get("carry")}
        change, first = {}, 0
        for name, start in self._x.items():
            change[name] = np.array(arguments["x"][name], dtype=np.float64) - start
            if self.carried:
                change[name] += np.array(arguments["carry"]["rounding"][first : first + len(start)])
            first += len(start)
        change["attitude"] = _turn(self._x["attitude"], change["attitude"])
        return np.concatenate(list(change.values()))

    @lru_cache(maxsize=16)  # noqa: B019 - a motion lives as long as its checks are made
    def _reference_change(self, part: float, finer: int = 1) -> Array:
        """Change of the state by the reference, by Gragg's extrapolation of the midpoint rule, of `finer` steps.

        Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9.
        """
        table: list[Array] = []
        with np.errstate(all="ignore"):  # of a way that is too long
            for row, count in enumerate(finer * n for n in MIDPOINTS):
                step, before = part * self.time / count, np.zeros(len(self._start))
                after = step * self._rates(before)
                for _ in range(count - 1):
                    before, after = after, before + 2.0 * step * self._rates(after)
                columns = [(after + before + step * self._rates(after)) / 2.0]
                for k in range(row):
                    ratio = (MIDPOINTS[row] / MIDPOINTS[row - 1 - k]) ** 2
                    columns.append(columns[k] + (columns[k] - table[k]) / (ratio - 1.0))
                table = columns
            z = table[-1]
            return np.concatenate([z[:3], skew_part(self._C.T @ z[3:12].reshape(3, 3)) / 2.0, z[12:]])

    def _rates(self, change: Array) -> Array:
        """d/dt of O1 in E0 (3), C (9), V (6), phi, phi' (N each), so far from the start: O1' = C v, C' = C <omega>."""
        y, N, case = self._start + change, self._case.count, self._case
        C, V = y[3:12].reshape(3, 3), y[12:18]
        state = replace(
            self._state, position=tuple(y[:3]), quaternion=cast(Quaternion, tuple(quaternion_of(C).tolist())),
            V=tuple(V), phi=tuple(y[18 : 18 + N]), phi_dot=tuple(y[18 + N :]),
        )  # fmt: skip
        at = reference.pieces(case.stand, state, self._bodies)
        if self._driven:
            phi_ddot = np.array(state.phi_ddot, dtype=np.float64)
            V_dot = forward(at, phi_ddot)
        else:
            locked = np.zeros(N, dtype=bool) if self._locked is None else self._locked
            V_dot, phi_ddot = coupled(at, np.array(state.tau), locked)
        return np.concatenate([C @ V[:3], (C @ cross(V[3:])).ravel(), V_dot, y[18 + N :], phi_ddot])


def _turn(q: Array, change: Array) -> Array:
    """Axis of the turn from q to q + change (3), times the sine of its angle: what is along q is no turn."""
    (a, *u), (b, *v) = q, change
    w = a * np.array(v) - b * np.array(u) - np.cross(u, v)
    s = q @ q + q @ change
    return np.asarray(2.0 * s * w / (s * s + w @ w))


def _judge_coarse(case: Case, rows: Rows) -> None:
    """COARSE if and only if dt times the fastest of |phi_dot| and |omega| exceeds the bound of the order.

    Every state is taken as it is, and with resting flywheels, where the carrier turns fastest.
    """
    check = rows.check("status COARSE", "exact")
    count = {(order, side, still): 0 for order in (2, 4) for side in (-1, 1) for still in (False, True)}
    for name, state in case.states:
        for (order, side, still), answers in count.items():
            speeds = np.zeros(case.count) if still else np.array(state.phi_dot, dtype=np.float64)
            fastest = max(float(np.linalg.norm(state.V[3:])), float(np.abs(speeds).max(initial=0.0)))
            if answers >= COARSE_ANSWERS or not fastest > 0.0:
                continue
            part = 1 + side * COARSE_EDGE
            arguments: dict[str, Any] = case.backend.arguments(state)
            arguments |= {"dt": float(BOUNDS[f"MAX_TURN_{order}"].value) / fastest * part, "order": order}
            arguments |= {"x": arguments["x"] | ({"phi_dot": tuple(speeds)} if case.count else {})}
            status, results = case.backend.call(rows.function, arguments)
            if status < 0:  # a stage of a long step may be out of range, and dt itself
                continue
            count[order, side, still] += 1
            length = float(np.linalg.norm(results["next"]["attitude"]))
            rows.check("attitude of unit length", "value").note(abs(length - 1.0), name)
            right = status == STATUS_VALUES["COARSE" if side > 0 else "OK"]
            check.demand(right, name, f"status {status_words(status)} at {part:g} of the bound of order {order}")
    missing = [f"order {order}" for (order, side, _), answers in count.items() if side > 0 and not answers]
    if check.states and missing:
        check.words = check.words or f"no step above the bound answered: {', '.join(dict.fromkeys(missing))}"
