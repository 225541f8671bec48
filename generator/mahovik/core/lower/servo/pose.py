"""Coordinates of the carrier from its pose: what a trim measures."""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

THETA = 4
"""Number of theta among the coordinates; its formula alone has a square root."""


def coordinates(lib: Library, form: ServoForm) -> Function:
    """`trim_coordinates(position, attitude, q)`: of O1 in E0 and the angles of the stand's sequence, those measured."""
    assert form.trim is not None
    position = Argument("position", Kind.REAL, (3,), unit="m", purpose="position of O1, in E0")
    attitude = Argument("attitude", Kind.REAL, (4,), purpose="unit quaternion, w first, to 1e-3")
    q = Argument("q", Kind.REAL, (form.trim.measured,), "out", "m, rad", "measured coordinates of the carrier")
    a = attitude.place
    body = Body()
    lib.check(body, "within", position.place, 3, lib.limits["MAX_POSITION"].expression)
    lib.check(body, "within", a, 4, real(2))
    norm = body.let("norm2", a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3])
    lib.check_unit(body, norm)
    chosen = form.trim.coordinates
    C = body.local("C", (9,), comment="row by row") if form.trim.angles else a
    if form.trim.angles:
        body.call(lib["rotation"], a, C)
    for i, number in enumerate(chosen):
        own = position.place[number] if number < 3 else _angle(lib, lib.layout.structure.angles, C, number)
        body.set(q.place[i], own)
    return body.checked_function(
        "trim_coordinates",
        "Coordinates of the carrier that the trim takes, from its pose.",
        (position, attitude, q),
        notes=("At a singular attitude theta alone is right: psi and phi are what rounding leaves of them.",),
        public=True,
    )


def _angle(lib: Library, sequence: str, C: Place, number: int) -> Expr:
    """psi, theta or phi (number 3, 4, 5) by the elements of C that are products of two of their sines and cosines."""

    def length(a: Expr, b: Expr) -> Expr:
        return lib["sqrt"](a * a + b * b)

    def pair() -> tuple[Expr, Expr]:
        match sequence, number:
            case "ship", 3:  # C3(psi) C2(theta) C1(phi)
                return C[3], C[0]
            case "ship", 4:
                return -C[6], length(C[0], C[3])
            case "ship", 5:
                return C[7], C[8]
            case "aircraft", 3:  # C2(psi) C3(theta) C1(phi)
                return -C[6], C[0]
            case "aircraft", 4:
                return C[3], length(C[0], C[6])
            case "aircraft", 5:
                return -C[5], C[4]
            case _, 3:  # euler: C3(psi) C1(theta) C3(phi)
                return C[2], -C[5]
            case _, 4:
                return length(C[6], C[7]), C[8]
            case _:
                return C[6], C[7]

    return lib["atan2"](*pair())
