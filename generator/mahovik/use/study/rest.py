"""Static equilibrium: the pose in which a stand with flywheels at rest stays, if there is one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import closing_words, freedom_words, is_closed, twists
from mahovik.core.stand.laws import carrier_laws
from mahovik.core.stand.model import Quaternion, Stand, State, Vec3, Vec6
from mahovik.errors import CheckError, StateError
from mahovik.proof.reference import Pieces, pieces
from mahovik.proof.reference.algebra import attitude, carrier_rotation, rotation_vector
from mahovik.proof.reference.pieces import bodies_of, stream_at
from mahovik.use.simulate.held import displacement, home, move

Array = NDArray[np.float64]

TWIST = ("x", "y", "z", "rx", "ry", "rz")
"""Parts of a small twist."""

AT_REST = 1e-12
"""m/s2, rad/s2: largest component of V_dot in equilibrium, or rounding if that is larger."""

FREE = 1e-8
"""Part of the largest stiffness (both per unit of mass) below which a direction counts as free."""

MOST = 200  # most iterations; some tens are usual
_PUSHES = (0.05, -0.05, 0.5)  # m or rad
_TURN, _SHIFT = 0.3, 0.1  # rad, m: limit of a step
_FAR = 1e12  # beyond the limit of a step
_DIFFERENCE = 1e-5  # m, rad: step of the differences for the stiffness
_TO_HOME, _AT_HOME = 30, 1e-12  # most steps along free directions towards the home pose; m, rad: the last one
_REACH = 1e7  # m: beyond any position that the C takes


@dataclass(frozen=True)
class Rest:
    """The equilibrium: its state, remaining acceleration, free directions, stability, natural frequencies.

    `free`: twists in E1, m and rad; about an axis of length 1, with the shift per rad, or a shift of length 1.

    `unstable`: the stiffness has a negative direction, so the stand would leave this pose. `frequencies`: Hz, rising,
    of undamped motions with flywheels locked; 0 along free directions.
    """

    state: State
    V_dot: Vec6
    free: tuple[Vec6, ...]
    unstable: bool
    frequencies: tuple[float, ...] = ()

    def words(self) -> list[str]:
        """Pose, free directions, stability and natural frequencies, in sentences."""
        w, *vector = self.state.quaternion or (1.0, 0.0, 0.0, 0.0)
        turn = 2.0 * math.degrees(math.atan2(math.hypot(*vector), w))
        place = ", ".join(f"{round(x, 9) + 0.0:.9g}" for x in self.state.position)
        left = f"V_dot {max(map(abs, self.V_dot)):.2g} remains"
        result = [f"rest pose: O1 at ({place}) m in E0, turned by {turn:.6g} deg; {left}"]
        if self.free:
            directions = (twist_words(twist, 6) for twist in self.free)
            result.append(f"free directions, m and rad in E1: {'; '.join(directions)}")
        if self.unstable:
            result.append("warning: unstable, the stand would leave this pose")
        elif any(self.frequencies):
            frequencies = ", ".join(f"{f:.5g}" for f in self.frequencies)
            result.append(f"natural frequencies, flywheels locked, Hz: {frequencies}")
        return result


def twist_words(twist: Sequence[float], digits: int) -> str:
    """The parts of a small twist that are not zero to some decimals, by name."""
    parts = ((name, round(x, digits)) for name, x in zip(TWIST, twist, strict=True))
    return ", ".join(f"{name} {x:.6g}" for name, x in parts if x)


def sag(stand: Stand, state: State) -> Array | None:
    """How far isolators sag (6; m, rad in E1) from where they are unloaded; None without isolators."""
    suspension: Any = next((law for law in stand.laws if getattr(law, "isolators", ())), None)
    if suspension is None:
        return None
    C = carrier_rotation(stand, state)
    turned = attitude(stand.angles, *suspension.angles).T @ C
    return np.concatenate([C.T @ np.subtract(state.position, suspension.position), rotation_vector(turned)])


def rest(stand: Stand, phi: Sequence[float] | None = None) -> Rest:
    """Equilibrium of `stand` with flywheels held at the phases `phi` (N, rad; default 0), nearest to q = 0.

    No run-time wrench acts. Free directions stay at zero. The quaternion of its state has w >= 0. Raises CheckError:
    there is none, or it is outside of the profile of the stream, within which the search itself need not stay.
    """
    state = home(stand)
    if phi is not None:
        state = replace(state, phi=tuple(float(x) for x in phi))
    if stand.hold is not None and not is_closed(stand.hold):
        reason = "the freedoms of [hold] are not a closed set, so that its poses have more coordinates than these"
        raise CheckError(f"{stand.name}: no rest pose: {reason}; {closing_words(stand.hold)}")
    if stand.hold is not None and not stand.hold.freedoms:
        return Rest(with_least_turn(state), (0.0,) * 6, (), False)
    try:
        search = _Search(everywhere(stand), state)
        result = search.nearest(search.run())
        stream_at(stand, result.state.position)
        return result
    except (StateError, np.linalg.LinAlgError) as error:
        raise CheckError(f"{stand.name}: no rest pose: the search for it failed: {error}") from None


def everywhere(stand: Stand) -> Stand:
    """The stand in a stream that beyond the stations of its profile is that of the nearest one, as inside a step."""
    profile = stand.profile
    if profile is None:
        return stand
    depth = (profile.depth[0] - _REACH, *profile.depth, profile.depth[-1] + _REACH)
    velocity = (profile.velocity[0], *profile.velocity, profile.velocity[-1])
    return replace(stand, profile=replace(profile, depth=depth, velocity=velocity))


def accuracy(stand: Stand, state: State) -> Array:
    """Largest V_dot (6; m/s2, rad/s2) that counts as none in an equilibrium at `state`, which has a quaternion."""
    search = _Search(everywhere(stand), state)
    return search.tolerance(search.at(state))


class _Search:
    """Pseudo-transient continuation in coordinates in which the mass matrix is the unit matrix.

    Steps of the implicit Euler method on dx/dT = wrench, (1/h + S) dx = wrench, with S the stiffness; h grows as the
    wrench falls, until they are steps of Newton's method. So it follows the stand to a stable pose.
    """

    def __init__(self, stand: Stand, state: State) -> None:
        self.stand = stand
        self.bodies = bodies_of(stand)
        self.state = state
        self.stops = any(law.has_kinks for law in stand.laws)
        self.home = state
        S = twists(stand.hold)
        root = np.linalg.cholesky(S.T @ pieces(stand, state).K @ S)  # G; K depends only on the phases
        self.scale = np.linalg.inv(root) @ S.T
        self.steps = [column * (_DIFFERENCE / np.abs(column).max()) for column in self.scale]

    def run(self) -> Rest:
        """The equilibrium; an unstable one only if pushes lead to no other. Raises CheckError."""
        if self.stand.hold is None and not any(law.short(self.stand) for law in carrier_laws() if law.carries_weight):
            at = self.at(self.state)  # no wrench here depends on the position: the force in E0 is constant
            if np.any(np.abs(self.acceleration(at))[:3] > self.tolerance(at)[:3]) and not self.is_balanced(at):
                raise CheckError(self.reason(at))
        rest_pose = self.first()
        for size in _PUSHES if rest_pose.unstable else ():
            self.state = self.push(size)
            try:
                other = self.settle(leave=True)
            except CheckError:
                break
            if not other.unstable:
                return other
            self.state = rest_pose.state
        return rest_pose

    def nearest(self, rest_pose: Rest) -> Rest:
        """The equilibrium nearest to home, among those that free directions of a held carrier join to `found`.

        There the displacement from home has no part along them: a ball joint is tilted and not turned.
        """
        for _ in range(_TO_HOME if self.stand.hold is not None and rest_pose.free else 0):
            self.state, free = rest_pose.state, np.array(rest_pose.free).T
            C = self.at(self.state).C
            off = self.shares(displacement(self.home, C, self.state), free)
            if np.abs(off).max() <= _AT_HOME:
                break
            slope = np.column_stack([self.shares(self.home_slope(C, direction), free) for direction in free.T])
            least = 1e-8 * np.eye(len(off))  # turned by 180 degrees, all of them are as near
            self.state = self.displace(C, limit_step(-free @ np.linalg.solve(slope.T @ slope + least, slope.T @ off)))
            try:
                rest_pose = self.settle(leave=False)
            except CheckError:  # what joins them ends here
                break
        return rest_pose

    def home_slope(self, C: Array, free: Array) -> Array:
        """Change of the displacement from home (6) by a twist along a free direction."""
        ends = [move(self.state, C, sign * _DIFFERENCE * free) for sign in (1.0, -1.0)]
        forward, backward = (displacement(self.home, carrier_rotation(self.stand, end), end) for end in ends)
        return np.asarray((forward - backward) / (2 * _DIFFERENCE))

    def first(self) -> Rest:
        """The equilibrium reached from the start: a stable one, else any. Raises CheckError."""
        start = self.state
        try:
            return self.settle(leave=True)
        except CheckError:
            self.state = start
            return self.settle(leave=False)

    def settle(self, leave: bool) -> Rest:
        """The equilibrium reached from the present state; `leave`: not one that it would leave. Raises CheckError."""
        h, last, stuck, loose_before, carried = 0.0, math.inf, 0, math.inf, True
        for _ in range(MOST):
            at = self.at(self.state)
            V_dot, S, pull = self.acceleration(at), self.stiffness(at.C), self.scale @ (at.F - at.bias)
            _, sizes, rows = np.linalg.svd(S)
            soft = sizes <= FREE * sizes[0]
            if np.all(np.abs(V_dot) <= self.tolerance(at)):
                return self.result(V_dot, S, rows[soft])
            norm = float(np.linalg.norm(pull))
            loose = float(np.abs(np.linalg.svd(S)[0][:, soft].T @ pull).max(initial=0.0))  # not balanced by stiffness
            carried = loose <= 1e-9 * (1.0 + norm)
            stuck = stuck + 1 if not carried and math.isclose(loose, loose_before, rel_tol=1e-3) else 0
            loose_before = loose
            if sizes[0] == 0.0 and self.stops:  # on to the next stop
                self.state = self.displace(at.C, limit_step(self.scale.T @ pull * _FAR))
                continue
            if sizes[0] == 0.0 or (stuck > 12 and not self.stops):
                break
            h = 2.0 / sizes[0] if h == 0.0 else min(h * max(0.3, min(last / norm, 4.0)), 1e12 / sizes[0])
            last = norm
            least = float(np.linalg.eigvals(S).real.min())
            if leave and least < -FREE * sizes[0]:
                h = 0.5 / -least  # doubles the distance; more would lead back to the pose it must leave
            step = self.scale.T @ np.linalg.solve(np.eye(len(S)) / h + S, pull)
            if carried and np.abs(step).max() < 1e-3:
                step = self.scale.T @ np.linalg.lstsq(S, pull, rcond=FREE)[0]
            if carried:
                free = self.scale.T @ rows[soft].T
                step = step - free @ self.shares(step, free)
            self.state = self.displace(at.C, limit_step(step))
        at = self.at(self.state)
        if carried:
            most = np.abs(self.acceleration(at)).max()
            raise CheckError(f"{self.stand.name}: no rest pose found: V_dot is still {most:.3g} after {MOST} steps")
        raise CheckError(self.reason(at))

    def push(self, size: float) -> State:
        """The state pushed along its most negative stiffness, by `size` (m or rad)."""
        C = self.at(self.state).C
        values, vectors = np.linalg.eig(self.stiffness(C))
        direction = self.scale.T @ np.real(vectors[:, int(np.argmin(values.real))])
        return self.displace(C, size / np.abs(direction).max() * direction)

    def displace(self, C: Array, step: Array) -> State:
        """The present state displaced by a small twist in E1 (6); of a held carrier along what its hold allows."""
        if self.stand.hold is not None:
            return move(self.state, C, step)
        turned = move(self.state, C, np.concatenate([np.zeros(3), step[3:]]))
        return replace(turned, position=cast(Vec3, _tuple(np.array(self.state.position) + C @ step[:3])))

    def shares(self, step: Array, free: Array) -> Array:
        """Parts of a step (6) along free directions (6, f): without them shifts are least, then rotations.

        Of a held carrier these are the shifts and rotations of its freedoms: wherever its pivot is, O1 may move.
        """
        S = twists(self.stand.hold)
        turning = np.linalg.norm(S[3:], axis=0)
        sizes = np.where(turning > 0.0, turning, 1e3 * np.linalg.norm(S[:3], axis=0))
        weights = sizes[:, None] * np.linalg.pinv(S)
        return np.asarray(np.linalg.lstsq(weights @ free, weights @ step, rcond=None)[0])

    def is_balanced(self, at: Pieces) -> bool:
        """Whether the force on the whole stand is zero, to rounding."""
        bodies: tuple[Any, ...] = (*at.fixed, *at.flywheels)
        sizes = sum(np.linalg.norm(w[:3]) for k in bodies for w in at.terms[k.body.name].values())
        return bool(np.linalg.norm((at.F - at.bias)[:3]) <= 1e-14 * sizes)

    def at(self, state: State) -> Pieces:
        """The pieces of the equations at a state."""
        return pieces(self.stand, state, self.bodies)

    def acceleration(self, at: Pieces) -> Array:
        """V_dot (6) by (8) with flywheels held."""
        return np.asarray(self.scale.T @ (self.scale @ (at.F - at.bias)))

    def tolerance(self, at: Pieces) -> Array:
        """Largest V_dot in equilibrium (6): AT_REST, or rounding of the balancing wrenches."""
        bodies: tuple[Any, ...] = (*at.fixed, *at.flywheels)
        sizes = np.zeros(6)
        for k in bodies:
            for wrench in at.terms[k.body.name].values():
                sizes += np.abs(k.L) @ np.abs(wrench)
        if self.stops:  # a stiff one makes much of the last digit of its depth
            from mahovik.proof.verify.scales import Scales

            measured = Scales(self.stand).measure(self.state, lambda _, __, at: {"F": at.F})
            sizes = np.maximum(sizes, measured.scales["F"])
        rounding = 32 * np.finfo(float).eps * (np.abs(self.scale.T @ self.scale) @ sizes)
        return np.asarray(np.maximum(AT_REST, rounding))

    def stiffness(self, C: Array) -> Array:
        """Minus the derivative of the wrench by the pose (6x6, 1/s2) of attitude C, both scaled by the mass matrix."""
        columns: list[Array] = []
        for step, whole in zip(self.steps, self.scale, strict=True):
            forward, backward = (self.wrench(self.displace(C, sign * step), C) for sign in (1.0, -1.0))
            scaled = self.scale @ (backward - forward) / 2
            columns.append(scaled * float(np.abs(whole).max() / _DIFFERENCE))
        return np.column_stack(columns)

    def wrench(self, state: State, C: Array) -> Array:
        """Force in the axes C, so that a constant force does not change with attitude; moment in E1.

        Of a held carrier both in E1, where S is constant.
        """
        at = self.at(state)
        total = at.F - at.bias
        if self.stand.hold is not None:
            return np.asarray(total)
        return np.concatenate([C.T @ at.C @ total[:3], total[3:]])

    def result(self, V_dot: Array, S: Array, soft: Array) -> Rest:
        """The result at the present state; `soft`: its free directions (rows), scaled."""
        free = tuple(cast(Vec6, _tuple(unit_twist(row))) for row in reduced_basis(soft @ self.scale))
        values = np.linalg.eigvals(S)
        least = -max(FREE * float(np.abs(values).max()), 1e-9)
        squares = np.where(values.real < -least, 0.0, values.real)
        frequencies = _tuple(np.sort(np.sqrt(squares)) / (2 * math.pi))
        unstable = bool(values.real.min() < least)
        return Rest(with_least_turn(self.state), cast(Vec6, _tuple(V_dot)), free, unstable, frequencies)

    def reason(self, at: Pieces) -> str:
        """Message: why there is no equilibrium."""
        total = at.F - at.bias
        force, moment = at.C @ total[:3], total[3:]
        size, turning = float(np.linalg.norm(force)), float(np.linalg.norm(moment))
        if self.stand.hold is not None:
            along = twists(self.stand.hold).T @ total
            names, worst = freedom_words(self.stand.hold), int(np.argmax(np.abs(along)))
            what = f"nothing carries {along[worst]:.6g} (N or N m) along the freedom {names[worst]}"
            return f"{self.stand.name}: no rest pose: {what}"
        if size > 0.0 and np.abs(self.acceleration(at)[:3]).max() > AT_REST:
            what = f"nothing carries a force of {size:.6g} N along ({_direction(force)}) in E0"
        else:
            what = f"nothing carries a moment of {turning:.6g} N m about ({_direction(moment)}) in E1"
        return f"{self.stand.name}: no rest pose: {what}"


def with_least_turn(state: State) -> State:
    """The state with the quaternion of its attitude that has w >= 0: of a turn by at most 180 degrees."""
    q = state.quaternion
    return replace(state, quaternion=cast(Quaternion, _tuple(-np.array(q)))) if q and q[0] < 0.0 else state


def reduced_basis(rows: Array, digits: int = 6) -> Array:
    """Another basis of the same space: each vector has a component 1 where the others have 0, in order."""
    rows = rows.copy()
    done = 0
    for column in range(rows.shape[1]):
        if done == len(rows):
            break
        pivot = done + int(np.argmax(np.abs(rows[done:, column])))
        if abs(rows[pivot, column]) <= 1e-6 * np.abs(rows[pivot]).max():
            continue
        rows[[done, pivot]] = rows[[pivot, done]]
        rows[done] /= rows[done, column]
        left = [i for i in range(len(rows)) if i != done]
        rows[left] -= rows[left, column][:, None] * rows[done]
        done += 1
    return np.asarray(np.round(rows, digits) + 0.0)


def unit_twist(twist: Array) -> Array:
    """The twist with a rotation of length 1, its shift per rad; without rotation, a shift of length 1."""
    turning = float(np.linalg.norm(twist[3:]))
    return np.asarray(twist / (turning or float(np.linalg.norm(twist))))


def limit_step(step: Array) -> Array:
    """The step, shortened if its rotation or shift is too large."""
    longest = max(float(np.abs(step[:3]).max()) / _SHIFT, float(np.abs(step[3:]).max()) / _TURN, 1.0)
    return step / longest


def _direction(vector: Array) -> str:
    return ", ".join(f"{x:.4g}" for x in np.round(vector / np.linalg.norm(vector), 9) + 0.0)


def _tuple(values: Array) -> tuple[float, ...]:
    return tuple(float(x) + 0.0 for x in values)  # no negative zeros
