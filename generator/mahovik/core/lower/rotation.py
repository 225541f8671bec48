"""Rotations: C of a quaternion, C a and C^T a."""

from __future__ import annotations

from mahovik.core.formula.derived import attitude as derived
from mahovik.core.lower.symbolic import formula
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Reals, argument, kernel, result
from mahovik.core.program.vector import cross, dot


def rotation() -> Function:
    """Rotation matrix of a quaternion of any length."""

    @kernel()
    def rotation(q: Reals = argument("quaternion, w first", 4), C: Reals = result("x0 = C x1, row by row", 9)) -> None:
        """Rotation matrix of a quaternion of any length: no square root is needed."""
        k = 2 / dot(q, q)
        C[:] = formula(derived.rotation_of_quaternion(), q=q, k=k)

    return rotation


@kernel(short=True)
def turn_back(
    q: Reals = argument("quaternion, w first", 4),
    a: Reals = argument("", 3),
    out: Reals = result("must not overlap a", 3),
) -> None:
    """C^T a of a quaternion of any length: no matrix is needed."""
    k = 2 / dot(q, q)
    t = -cross(a, q[1:4])
    out[:] = a + k * (-q[0] * t + cross(q[1:4], t))


@kernel()
def rotate_back(
    C: Reals = argument("", 9), a: Reals = argument("", 3), out: Reals = result("must not overlap a", 3)
) -> None:
    """C^T a: components from the outer axes to the rotated axes."""
    out[:] = C.T @ a


@kernel()
def rotate(
    C: Reals = argument("", 9), a: Reals = argument("", 3), out: Reals = result("must not overlap a", 3)
) -> None:
    """C a: from the turned axes to the outer ones."""
    out[:] = C @ a
