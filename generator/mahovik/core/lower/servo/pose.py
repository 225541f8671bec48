"""Coordinates of the carrier from its pose: what a trim measures."""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def coordinates(lib: Library, form: ServoForm) -> Function:
    """`trim_coordinates(position, attitude, q)`: of O1 in E0 and the angles of the stand's sequence, those measured."""
    assert form.trim is not None
    position = Argument("position", Kind.REAL, (3,), unit="m", purpose="position of O1, in E0")
    attitude = Argument("attitude", Kind.REAL, (4,), purpose="unit quaternion, w first, to 1e-3")
    q = Argument("q", Kind.REAL, (form.trim.measured,), "out", "m, rad", "measured coordinates of the carrier")
    a = attitude.place
    body = Body()
    lib.begin(body)
    lib.check(body, "within", position.place, 3, lib.limits["MAX_POSITION"].expression)
    lib.check(body, "within", a, 4, real(2))
    norm = body.let("norm2", a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3])
    lib.check_unit(body, norm)
    chosen = form.trim.coordinates
    if form.trim.angles:
        C = body.local("C", (9,), comment="row by row")
        body.call(lib["rotation"], a, C)
        angles = _angles(lib, lib.layout.structure.angles, C)
    for i, number in enumerate(chosen):
        body.set(q.place[i], position.place[number] if number < 3 else angles[number - 3])
    return body.checked(
        "trim_coordinates",
        "Coordinates of the carrier that the trim takes, from its pose.",
        (position, attitude, q),
        notes=("Angles of a singular attitude are some that give this attitude.",),
        public=True,
    )


def _angles(lib: Library, sequence: str, C: Place) -> tuple[Expr, Expr, Expr]:
    """psi, theta, phi by the elements of C that are products of two of their sines and cosines."""

    def angle(y: Expr, x: Expr) -> Expr:
        return call(lib["atan2"], y, x)

    def length(x: Expr, y: Expr) -> Expr:
        return call(lib["sqrt"], x * x + y * y)

    if sequence == "ship":  # C3(psi) C2(theta) C1(phi)
        return angle(C[3], C[0]), angle(-C[6], length(C[0], C[3])), angle(C[7], C[8])
    if sequence == "aircraft":  # C2(psi) C3(theta) C1(phi)
        return angle(-C[6], C[0]), angle(C[3], length(C[0], C[6])), angle(-C[5], C[4])
    return angle(C[2], -C[5]), angle(length(C[6], C[7]), C[8]), angle(C[6], C[7])  # C3(psi) C1(theta) C3(phi)
