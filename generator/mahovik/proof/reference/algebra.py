"""Numbers, arrays and linear solves of the reference; twists, wrenches and their transfer; rotations. Angles in rad.

The equations hold for whatever stands in for a number: a float, or an object that brings its own arithmetic and the
functions below, such as the balls of `proof/verify/rigorous.py`, which come in arrays of objects. So no equation calls
`math`, writes numbers into zeros, or makes a float of a number. A screw has its linear part first, about the origin of
the frame; <a>, Phi(V) and T(O) - E are linear: each is written down once, for unit vectors, and combined from these.
A rotation C is active: [e1] = [e0] C, so x0 = C x1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from collections.abc import Sequence as Numbers
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Flywheel, Freedom, Hold, MountingAngles, Sequence, Stand, State

Array = NDArray[np.float64]

Values = dict[str, Any]
"""Results by the names of the contract: arrays, floats; a status is a string, a rank an int."""


def vector(numbers: Numbers[Any]) -> Array:
    """Numbers of a stand or state, nested as they are, as an array."""
    result = np.array(numbers)
    return result if result.dtype.kind in "fO" else result.astype(np.float64)


def stack(vectors: Numbers[Array], *shape: int) -> Array:
    """Arrays of a shape one after the other (n x shape); there may be none."""
    return vector(vectors).reshape(len(vectors), *shape)


def times(A: Array, x: Array) -> Array:
    """A x of every matrix (n x m x k) and every vector (n x k): n x m."""
    return np.asarray((A @ x[..., None])[..., 0])


def transpose(A: Array) -> Array:
    """A^T of every matrix (n x m x k)."""
    return np.swapaxes(A, -1, -2)


def _function(of_floats: Callable[..., Any], name: str) -> Callable[..., Any]:
    """A function of floats, or of an array of one; of other numbers the one that their type has under the name."""

    def function(*numbers: Any) -> Any:
        for x in numbers:
            if isinstance(x, np.ndarray):
                return vector(list(map(function if x.dtype == object else of_floats, x.tolist())))
            if not isinstance(x, float | int):
                return getattr(type(x), name)(*numbers)
        return of_floats(*numbers)

    return function


sin = _function(math.sin, "sin")
cos = _function(math.cos, "cos")
exp = _function(math.exp, "exp")
sqrt = _function(math.sqrt, "sqrt")
hypot = _function(math.hypot, "hypot")
arctan2 = _function(math.atan2, "arctan2")
larger = _function(max, "larger")
smaller = _function(min, "smaller")
with_sign = _function(math.copysign, "with_sign")  # of a size and of the number that has the sign
pi_like = _function(lambda _: math.pi, "pi_like")  # pi, as a number like another
estimate = _function(float, "estimate")  # a float nearby, to choose among formulas that are all right
angle_over_sine = _function(lambda s, c: math.atan2(s, c) / s if s else 1.0 / c, "angle_over_sine")  # atan2(s, c)/s


def solve(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) regular, b (n or nxm). Rows and columns are scaled first: units mix metres and radians."""
    if object in (S.dtype, b.dtype):
        return _solve_exactly(S, b)
    rows = 1.0 / np.max(np.abs(S), axis=1)
    columns = 1.0 / np.max(np.abs(S * rows[:, None]), axis=0)
    return np.asarray((columns * np.linalg.solve(rows[:, None] * S * columns, (rows * b.T).T).T).T, dtype=np.float64)


def solve_symmetric(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) symmetric and regular, b (n). Scaled to a unit diagonal first, rows as columns.

    A row of small numbers, such as that of a flywheel beside a carrier of 1e12 kg, then stays small: scaled up on its
    own it would become a pivot, and with it the error of its numbers the error of all.
    """
    if not len(b):
        return b
    if object in (S.dtype, b.dtype):
        return _solve_exactly(S, b)
    scale = 1.0 / np.sqrt(np.abs(np.diag(S)))
    return np.asarray(scale * np.linalg.solve(S * np.outer(scale, scale), scale * b), dtype=np.float64)


def _solve_exactly(S: Array, b: Array) -> Array:
    """x of S x = b, by the solver of the number type (balls)."""
    kind = next(type(x) for x in (*S.flat, *b.flat) if not isinstance(x, float | int))
    result: Array = kind.solve(S, b)
    return result


# -- twists and wrenches -----------------------------------------------------------------------------------------------

E, E6 = np.eye(3), np.eye(6)
zero = np.zeros((3, 3))
e1 = E[0]
f = np.concatenate([zero[0], e1])  # every flywheel spins about its own first axis


def blocks(A: Array, B: Array, C: Array, D: Array) -> Array:
    """[[A, B], [C, D]] (6x6) of four 3x3. As np.block, which takes ten times as long."""
    statements: Array = np.empty((6, 6), np.result_type(A, B, C, D))
    statements[:3, :3], statements[:3, 3:], statements[3:, :3], statements[3:, 3:] = A, B, C, D
    return statements


def block_diagonal(C: Array) -> Array:
    """[C] = diag(C, C) (6x6) of C (3x3), or of each of many."""
    result: Array = np.zeros((*C.shape[:-2], 6, 6), C.dtype)
    result[..., :3, :3] = result[..., 3:, 3:] = C
    return result


def _linear(matrix: Callable[[Array], Array], n: int) -> Array:
    """Rows by which the numbers of a vector (n) count in its matrix, which is read row by row."""
    return np.array([matrix(unit).ravel() for unit in np.eye(n)])


_CROSS = _linear(lambda a: np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]), 3)


def cross(a: Array) -> Array:
    """<a> (3x3) of a (3), or of each of many: <a> b = a x b."""
    return (a @ _CROSS).reshape(*a.shape, 3)


_PHI = _linear(lambda V: blocks(cross(V[3:]), zero, cross(V[:3]), cross(V[3:])), 6)
_T = _linear(lambda O: blocks(zero, zero, cross(O), zero), 3)


def Phi(V: Array) -> Array:
    """Phi(V) (6x6) of a twist V = (v, omega), or of each of many: [[<omega>, 0], [<v>, <omega>]], in (4), (8), (9)."""
    return (V @ _PHI).reshape(*V.shape, 6)


def T(O: Array) -> Array:
    """T = [[E, 0], [<O>, E]] (6x6): carries a wrench from O (3, m, in the parent) to the parent's origin."""
    return E6 + (O @ _T).reshape(6, 6)


def wrench_to_parent(O: Array, C: Array) -> Array:
    """L = T [C] (6x6): carries wrenches and momenta from child to parent; L^T twists from parent to child.

    O (3, m) is the child's origin in the parent, C (3x3) the child's axes: x_parent = O + C x_child.
    """
    return T(O) @ block_diagonal(C)


def force_at(force: Array, point: Array) -> Array:
    """Wrench (6; N, N m) about the origin of a force (3, N) that acts at a point (3, m) of the same frame."""
    return np.concatenate([force, cross(point) @ force])


spin = block_diagonal(cross(e1))  # [<e>] of (5), (6), (9): Ls* = Ls [<e>] phi_s'


def unit(freedom: Freedom) -> Array:
    """Direction of a freedom (3), of length 1."""
    d = vector(freedom.direction)
    d = d / np.max(np.abs(d))
    return np.asarray(d / np.sqrt(d @ d))


def twists(hold: Hold | None) -> Array:
    """S (6 x m) of V = S u, constant in E1: a frame at the pivot r has the twist L^T V of the carrier, L = T(r).

    A turn is (0; axis) of that frame, so V = T(-r)^T (0; axis); a slide is (direction; 0) of any frame. A free carrier
    has S = E.
    """
    if hold is None:
        return E6
    to_O1, still = T(-vector(hold.pivot)).T, zero[0]
    columns = []
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            columns.append(vector(freedom.twist))
        else:
            parts = (unit(freedom), still) if freedom.kind == "slide" else (still, unit(freedom))
            columns.append(to_O1 @ np.concatenate(parts))
    return stack(columns, 6).T


# -- rotations ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Pose:
    """What a law of `laws/` between E0 and the carrier depends on.

    O1 (3, m) in E0, C (3x3): x0 = C x1, and the twist V (6; m/s, rad/s) of E1 relative to E0.
    """

    O1: Array
    C: Array
    V: Array


def about(e: Array) -> Callable[[Any], Array]:
    """Rotation (3x3) about an axis e of length 1 by an angle: x becomes e (e.x) + cos (x - e (e.x)) + sin e x x.

    Of an array of angles one rotation each.
    """
    along, turned, times = np.outer(e, e), cross(e), np.multiply.outer
    across = E - along
    return lambda angle: np.asarray(along + times(cos(angle), across) + times(sin(angle), turned))


ELEMENTARY = C1, C2, C3 = about(E[0]), about(E[1]), about(E[2])

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes that psi, theta, phi turn about, 0..2."""


def attitude(sequence: Sequence, psi: float, theta: float, phi: float) -> Array:
    """C (3x3), angles in rad: ship C3(psi) C2(theta) C1(phi), aircraft C2(psi) C3(theta) C1(phi), Euler C3 C1 C3."""
    first, second, third = (ELEMENTARY[axis] for axis in AXES[sequence])
    return first(psi) @ second(theta) @ third(phi)


def quaternion_rotation(w: float, x: float, y: float, z: float) -> Array:
    """C (3x3) of a quaternion, w first. Its length is 1 to rounding only: what counts is its direction."""
    C = np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    return C / (w * w + x * x + y * y + z * z)


def carrier_rotation(stand: Stand, state: State) -> Array:
    """C (3x3) of the carrier: of its angles or its quaternion; of neither: aligned with E0."""
    if state.quaternion is not None:
        return quaternion_rotation(*state.quaternion)
    if state.angles is not None:
        return attitude(stand.angles, *state.angles)
    return np.eye(3)


def fixed_rotation(psi: float, theta: float, phi: float) -> Array:
    """C (3x3) of an instrument or a point in its mount, angles in rad: always C3(psi) C2(theta) C1(phi)."""
    return C3(psi) @ C2(theta) @ C1(phi)


def flywheel_mounting(flywheel: Flywheel) -> Array:
    """Cs (3x3) at phase zero: C3(psi_s) C2(theta_s) C1(zero), or by axes.

    By axes: the first column is along `axis`, the second along the part of `zero` across it. At the phase phi it is
    Cs C1(phi): that is C1(zero + phi) without the rounding of this sum, 1e-9 where phi is 1e7.
    """
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return C3(mounting.psi) @ C2(mounting.theta) @ C1(mounting.zero)
    axis, zero = vector(mounting.axis), vector(mounting.zero)
    first = axis / hypot(*axis)
    across = zero - first * (first @ zero)
    second = across / hypot(*across)
    return np.column_stack([first, second, cross(first) @ second])


def skew_part(C: Array) -> Array:
    """a (3) of C - C^T = <a>: twice the sine of the angle times the axis."""
    return np.array([C[2, 1] - C[1, 2], C[0, 2] - C[2, 0], C[1, 0] - C[0, 1]])


def quaternion_of(C: Array) -> Array:
    """q (4), w first and not negative, of a rotation C (3x3): the row of 4 q q^T of the largest component.

    4 q q^T = E + [[trace, a^T], [a, C + C^T - trace E]], C - C^T = <a>. That row loses no digits at 0 nor at pi.
    """
    a, trace = skew_part(C), C[0, 0] + C[1, 1] + C[2, 2]
    rows = np.empty((4, 4), C.dtype)
    rows[0, 0], rows[0, 1:], rows[1:, 0], rows[1:, 1:] = 1 + trace, a, a, C + C.T + (1 - trace) * E
    row = rows[int(np.argmax([estimate(rows[i, i]) for i in range(4)]))]
    q = row / hypot(*row)
    return np.asarray(-q if q[0] < 0 else q)


def rotation_vector(C: Array) -> Array:
    """Rotation vector (3, rad, length <= pi) of C (3x3): axis times angle, the same in both frames."""
    q = quaternion_of(C)
    return np.asarray(2.0 * angle_over_sine(hypot(*q[1:]), q[0]) * q[1:])
