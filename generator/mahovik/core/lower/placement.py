"""Where bodies and points sit in E1: axes from directions, and poses through the instrument that bears them."""

from __future__ import annotations

from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct


def frame_of_axes(lib: Library) -> Function:
    """Axes from two directions: e1 along `axis`, e2 along the component of `zero` perpendicular to it, e3 = e1 x e2."""
    axis = Argument("axis", Kind.REAL, (3,), purpose="any length")
    zero = Argument("zero", Kind.REAL, (3,), purpose="any length, not along axis")
    R = Argument("R", Kind.REAL, (9,), "out", purpose="columns are the axes, row by row")
    body = Body()
    bound = lib.limits["MAX_PARAMETER"].expression
    check_vector.put_into(body, lib, axis.place, bound)
    check_vector.put_into(body, lib, zero.place, bound)
    e1 = body.local("e1", (3,))
    e2 = body.local("e2", (3,))
    least = real(lib.thresholds.small_square)
    _unit(lib, body, axis.place, e1, "axis2", least)
    a, b = e1, zero.place
    length = body.let("zero2", b[0] * b[0] + b[1] * b[1] + b[2] * b[2])
    lib.guard(body, Not(length > least), "RANGE")
    along = body.let("along", a[0] * b[0] + a[1] * b[1] + a[2] * b[2], "of zero along the axis")
    across = body.local("across", (3,))
    for i in range(3):
        body.set(across[i], b[i] - along * a[i])
    _unit(lib, body, across, e2, "across2", real(lib.thresholds.parallel**2) * length)
    third = (e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2], e1[0] * e2[1] - e1[1] * e2[0])
    for i in range(3):
        body.set(R.place[3 * i], e1[i])
        body.set(R.place[3 * i + 1], e2[i])
        body.set(R.place[3 * i + 2], third[i])
    return body.checked_function(
        "frame_of_axes",
        "Rotation matrix whose first axis is along `axis`, the second along the part of `zero` across it.",
        (axis, zero, R),
    )


def _unit(lib: Library, body: Body, a: Place, out: Place, name: str, least: Expr) -> None:
    """out = a / |a|; RANGE where a has no direction: its square is not above `least`."""
    square = body.let(name, a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    lib.guard(body, Not(square > least), "RANGE")
    inverse = body.let(f"{name}_root", 1 / lib["sqrt"](square))
    for i in range(3):
        body.set(out[i], a[i] * inverse)


def place_flywheel(lib: Library) -> Function:
    """Origin and mounting axes of a flywheel in E1, through the instrument that carries it."""
    return _placement_function(
        lib, "place_flywheel", lib.layout.flywheel_parameters, "Origin and axes (at phi = 0) of a flywheel in E1."
    )


def place_point(lib: Library) -> Function:
    """Origin and axes of a point in E1, through the instrument that carries it."""
    return _placement_function(lib, "place_point", lib.layout.point_parameters, "Origin and axes of a point in E1.")


def _placement_function(lib: Library, name: str, struct: Struct, purpose: str) -> Function:
    p = Argument("parameters", lib.layout.parameters)
    w = Argument("w", struct)
    O = Argument("O", Kind.REAL, (3,), "out", "m", "Os in E1")
    R = Argument("R", Kind.REAL, (9,), "out", purpose="its axes in E1")
    body = Body()
    check_vector.put_into(body, lib, w.place.position, lib.limits["MAX_PARAMETER"].expression)
    lib.check(body, "frame_of_axes", w.place.axis, w.place.zero, R.place)
    body.copy_array(O.place, w.place.position)
    count = lib.layout.instruments
    if count:
        mount = w.place.mount
        lib.guard(body, Not(and_(mount >= -1, mount < integer(count))), "BAD_ARGUMENT")
        with body.when(mount >= 0):
            body.note("Ls = Lp L_s in p")
            q = p.place.instrument[mount]
            Rp = body.local("Rp", (9,), comment="axes of the instrument in E1")
            Rs = body.local("Rs", (9,), comment="own axes in the instrument")
            at = body.local("at", (3,))
            lib.check(body, "frame_of_axes", q.axis, q.zero, Rp)
            body.copy_array(Rs, R.place)
            for i in range(3):
                for j in range(3):
                    product = Rp[3 * i] * Rs[j] + Rp[3 * i + 1] * Rs[3 + j] + Rp[3 * i + 2] * Rs[6 + j]
                    body.set(R.place[3 * i + j], product)
            assign(body, list(at), derived_wrench.rotated(), {"C": Rp, "a": w.place.position})
            for i in range(3):
                body.set(O.place[i], q.position[i] + at[i])
    return body.checked_function(name, purpose, (p, w, O, R), statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"))
