"""Where bodies and points sit in E1: axes from directions, and poses through the instrument that bears them."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import BAD_ARGUMENT, OK, RANGE, Reals, argument, inline, let, reals, result
from mahovik.core.program.types import Struct
from mahovik.core.program.vector import cross, dot


def add_frame_of_axes(lib: Library) -> None:
    """Adds axes from two directions: e1 along `axis`, e2 along the part of `zero` across it, e3 = e1 x e2."""
    bound, least = lib.limit("MAX_PARAMETER"), lib.thresholds.small_square

    @inline
    def unit(a: Reals, out: Reals, name: str, least: Any) -> Any:
        """out = a / |a|; RANGE where a has no direction: its square is not above `least`."""
        square = let(name, dot(a, a))
        if not (square > least):
            return RANGE
        inverse = let(f"{name}_root", 1 / lib["sqrt"](square))
        out[:] = a * inverse
        return None

    @lib.kernel()
    def frame_of_axes(
        axis: Reals = argument("any length", 3),
        zero: Reals = argument("any length, not along axis", 3),
        R: Reals = result("columns are the axes, row by row", 9),
    ) -> Status:
        """Rotation matrix whose first axis is along `axis`, the second along the part of `zero` across it."""
        check_vector(lib, axis, bound)
        check_vector(lib, zero, bound)
        e1 = reals(3)
        e2 = reals(3)
        unit(axis, e1, "axis2", least)
        zero2 = dot(zero, zero)
        if not (zero2 > least):
            return RANGE
        along = dot(e1, zero)  # of zero along the axis
        across = reals(3)
        across[:] = zero - along * e1
        unit(across, e2, "across2", lib.thresholds.parallel**2 * zero2)
        for i in list(range(3)):
            R[3 * i : 3 * i + 3] = [e1[i], e2[i], cross(e1, e2)[i]]
        return OK


def add_placement(lib: Library, name: str, struct: Struct, purpose: str) -> None:
    """Adds origin and axes of a flywheel or point in E1, through the instrument that carries it."""
    count = lib.layout.instruments

    @lib.kernel(name, statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"), purpose=purpose)
    def place(
        parameters: Any = argument(struct=lib.layout.parameters),
        w: Any = argument(struct=struct),
        O: Reals = result("Os in E1", 3, unit="m"),
        R: Reals = result("its axes in E1", 9),
    ) -> Status:
        """Origin and axes."""
        check_vector(lib, w.position, lib.limit("MAX_PARAMETER"))
        lib["frame_of_axes"](w.axis, w.zero, R)
        O[:] = w.position
        if count:
            if not (w.mount >= -1 and w.mount < count):
                return BAD_ARGUMENT
            if w.mount >= 0:
                # Ls = Lp L_s in p
                p = parameters.instrument[w.mount]
                Rp = reals(9)  # axes of the instrument in E1
                Rs = reals(9)  # own axes in the instrument
                at = reals(3)
                lib["frame_of_axes"](p.axis, p.zero, Rp)
                Rs[:] = R
                R[:] = (Rp.square @ Rs.square).flat
                at[:] = Rp @ w.position
                O[:] = p.position + at
        return OK
