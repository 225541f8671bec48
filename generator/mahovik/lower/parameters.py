"""What can be wrong with parameters, found before prepare writes anything."""

from __future__ import annotations

from mahovik.derive import carrier as derived_carrier
from mahovik.derive.symbols import SYMMETRIC
from mahovik.lower.library import Library
from mahovik.lower.symbolic import translate
from mahovik.program.build import Body
from mahovik.program.expression import Not, Status, both
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind, Struct


def check_body(lib: Library, struct: Struct) -> Function:
    """Mass properties finite, and the mass not negative; `check_body` or `check_dry_body`, by the struct."""
    buoyant = struct.field("displaced_mass") is not None
    b = Argument("body", struct)
    body = Body()
    lib.begin(body)
    bound = lib.limits["MAX_PARAMETER"].expression
    scalars = [b.place.mass] + ([b.place.displaced_mass] if buoyant else [])
    arrays = [b.place.center_of_mass, b.place.inertia] + ([b.place.displaced_center] if buoyant else [])
    masses = body.local("masses", (len(scalars),))
    for target, value in zip(masses, scalars, strict=True):
        body.set(target, value)
    lib.check(body, "within", masses, len(scalars), bound)
    for array in arrays:
        lib.check(body, "within", array, len(array), bound)
    lib.guard(body, b.place.mass < 0, "RANGE")
    body.ret(Status("OK"))
    return Function(
        f"check_{struct.name}",
        "Are the mass properties finite and the mass not negative?",
        (b,),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE"),
    )


def translation_block(lib: Library) -> Function:
    """A = m E + Lambda_11 and its inverse."""
    p = Argument("parameters", lib.layout.parameters)
    mass = Argument("mass", Kind.REAL, unit="kg")
    A = Argument("A", Kind.REAL, (6,), "out", "kg")
    inverse = Argument("A_inv", Kind.REAL, (6,), "out", "1/kg")
    body = Body()
    for k, (i, j) in enumerate(SYMMETRIC):
        own = p.place.added_mass[i][j]
        body.set(A.place[k], mass.place + own if i == j else own)
    adjugate, determinant = derived_carrier.inverse_of_symmetric()
    names = ("11", "22", "33", "12", "13", "23")
    cofactor = [body.let(f"c{n}", translate(e, {"A": A.place})) for n, e in zip(names, adjugate, strict=True)]
    d = body.let("det", translate(determinant, {"A": A.place, "cofactor": cofactor}))
    positive = both(both(A.place[0] > 0, cofactor[2] > 0), d > 0)
    lib.guard(body, Not(positive), "NOT_POSITIVE_DEFINITE")
    r = body.let("r", 1 / d)
    for k in range(6):
        body.set(inverse.place[k], cofactor[k] * r)
    body.ret(Status("OK"))
    return Function(
        "translation_block",
        "Constant translational block of K with added mass, A = m E + Lambda_11, and its inverse.",
        (p, mass, A, inverse),
        body.statements,
        equation="(2)",
        returns=Kind.STATUS,
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def check_parameters(lib: Library) -> Function:
    """Everything that can be wrong with parameters, before anything is written."""
    layout = lib.layout
    parameters = Argument("parameters", layout.parameters)
    p = parameters.place
    bound = lib.limits["MAX_PARAMETER"].expression
    body = Body()
    lib.begin(body)
    total = body.local("mass")
    points = len(layout.structure.points)
    if layout.flywheels or points:
        O = body.local("O", (3,))
    if layout.instruments or layout.flywheels or points:
        R = body.local("R", (9,))
    lib.check(body, "check_body", p.carrier)
    body.set(total, p.carrier.mass)
    if layout.instruments:
        with body.loop("k", layout.instruments) as k:
            q = p.instrument[k]
            lib.check(body, "check_body", q.body)
            lib.check(body, "within", q.position, 3, bound)
            lib.check(body, "frame_of_axes", q.axis, q.zero, R)
            body.add(total, q.body.mass)
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            w = p.flywheel[s]
            lib.check(body, f"check_{layout.flywheel_body.name}", w.body)
            lib.guard(body, Not(w.body.inertia[0] > 0), "NOT_POSITIVE_DEFINITE")
            named = {"parameters": p, "w": w, "O": O, "R": R}
            lib.check(body, "place_flywheel", *lib.passed("place_flywheel", **named))
            body.add(total, w.body.mass)
    if points:
        with body.loop("k", points) as k:
            named = {"parameters": p, "w": p.point[k], "O": O, "R": R}
            lib.check(body, "place_point", *lib.passed("place_point", **named))
    lib.guard(body, Not(total > 0), "NOT_POSITIVE_DEFINITE")
    if layout.added_mass:
        A = body.local("A", (6,))
        inverse = body.local("A_inv", (6,))
        with body.loop("i", 6) as i:
            lib.check(body, "within", p.added_mass[i], 6, bound)
        lib.check(body, "translation_block", p, total, A, inverse)
    body.ret(Status("OK"))
    mounts = ("BAD_ARGUMENT",) if layout.instruments and (layout.flywheels or points) else ()
    return Function(
        "check_parameters",
        "Are the parameters finite, in range, their axes directions, and the masses positive?",
        (parameters,),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE", *mounts),
    )
