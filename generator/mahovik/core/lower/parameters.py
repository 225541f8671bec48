"""Checks of parameters, before prepare writes anything.

A body can exist if and only if its second moments about the centre of mass, int(x x^T) dm, are positive semidefinite.
With J the inertia about the origin they are P = tr(J)/2 E - J - m c c^T. Their eigenvalues are (J1 + J2 - J3)/2 and so
on, with the principal moments about the centre of mass: so this one condition is the triangle inequality, in any axes,
and with it J >= 0. Added mass itself must be positive semidefinite.

Semidefinite to a tolerance: P + t |J| E and Lambda + t diag(Lambda) are positive definite, t of `thresholds`. The stand
file is refused from half of that on, so whatever it takes is taken here, in float as well. The factors are L D L^T,
which need no root and are backward stable where the matrix is definite (Higham 2002, chapter 10).
"""

from __future__ import annotations

from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.formula.derived import carrier as derived_carrier
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, magnitude, or_, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct


def check_body(lib: Library, struct: Struct) -> Function:
    """Check of mass properties: can a body have them? `check_body` or `check_dry_body`, by the struct."""
    b = Argument("body", struct)
    body = Body()
    bound = lib.limits["MAX_PARAMETER"].expression
    members = [(getattr(b.place, field.name), bool(field.shape)) for field in struct.fields]
    scalars = [place for place, is_array in members if not is_array]
    arrays = [place for place, is_array in members if is_array]
    masses = body.local("masses", (len(scalars),))
    for target, value in zip(masses, scalars, strict=True):
        body.set(target, value)
    lib.check(body, "within", masses, len(scalars), bound)
    for array in arrays:
        lib.check(body, "within", array, len(array), bound)
    for mass in scalars:
        lib.guard(body, mass < 0, "RANGE")
    body.ret(lib["check_inertia"](b.place.mass, b.place.center_of_mass, b.place.inertia))
    return Function(
        f"check_{struct.name}",
        "Are the mass properties finite and physically possible?",
        (b,),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE"),
    )


def check_inertia(lib: Library) -> Function:
    """Second moments about the centre of mass, positive semidefinite."""
    mass = Argument("mass", Kind.REAL, unit="kg", purpose="not negative")
    center = Argument("c", Kind.REAL, (3,), unit="m", purpose="centre of mass")
    inertia = Argument("J", Kind.REAL, (6,), unit="kg m2", purpose="about the origin: 11 22 33 12 13 23")
    J, c = inertia.place, center.place
    tolerance = lib.thresholds.unphysical
    body = Body()
    size = body.local("size", comment="largest element of J")
    body.set(size, real(0))
    with body.loop("k", 6) as element:
        body.set(size, select(magnitude(J[element]) > size, magnitude(J[element]), size))
    offset = [body.let(f"b{k + 1}", mass.place * c[k]) for k in range(3)]
    body.note("P = tr(J)/2 E - J - m c c^T + t |J| E")
    P: dict[tuple[int, int], Expr] = {}
    for k, (i, j) in enumerate(SYMMETRIC):
        about_origin = real(0.5) * (J[(i + 1) % 3] + J[(i + 2) % 3] - J[i]) if i == j else -J[k]
        moment = about_origin - offset[i] * c[j]
        P[j, i] = body.let(f"P{i + 1}{j + 1}", moment + real(tolerance) * size if i == j else moment)
    body.note("a point mass at the origin has no inertia, nor has a body so small that its tolerance underflows")
    none = real(lib.layout.precision.smallest / tolerance)
    largest = magnitude(offset[0] * c[0]) + magnitude(offset[1] * c[1]) + magnitude(offset[2] * c[2])
    with body.when(size + largest > none):
        lib.guard(body, Not(P[0, 0] > 0), "NOT_POSITIVE_DEFINITE")
        l21 = body.let("l21", P[1, 0] / P[0, 0])
        l31 = body.let("l31", P[2, 0] / P[0, 0])
        d2 = body.let("d2", P[1, 1] - l21 * P[1, 0])
        lib.guard(body, Not(d2 > 0), "NOT_POSITIVE_DEFINITE")
        rest = body.let("p32", P[2, 1] - l31 * P[1, 0])
        d3 = body.let("d3", P[2, 2] - l31 * P[2, 0] - rest / d2 * rest)
        lib.guard(body, Not(d3 > 0), "NOT_POSITIVE_DEFINITE")
    return body.checked_function(
        "check_inertia",
        "Are the second moments about the centre of mass positive semidefinite? Then a body can have this inertia.",
        (mass, center, inertia),
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def check_added_mass(lib: Library) -> Function:
    """Added mass symmetric, and positive semidefinite."""
    added = Argument("added_mass", Kind.REAL, (6, 6), purpose="of carrier and instruments, about O1 in E1")
    m = added.place
    body = Body()
    factor = body.local("factor", (6, 6), comment="L below the diagonal, D on it")
    with body.loop("i", 6) as i:
        lib.check(body, "within", m[i], 6, lib.limits["MAX_PARAMETER"].expression)
    with body.loop("i", 6) as i, body.loop("j", i) as j:
        lib.guard(body, or_(m[i][j] < m[j][i], m[i][j] > m[j][i]), "NOT_POSITIVE_DEFINITE")
    body.note("rows of zeros (directions without added mass) are left out")
    with body.loop("i", 6) as i:
        with body.loop("j", 6) as j:
            touched = or_(m[i][j] < 0, m[i][j] > 0)
            lib.guard(body, and_(touched, Not(m[i][i] > 0)), "NOT_POSITIVE_DEFINITE")
        diagonal = body.local("diagonal")
        body.set(diagonal, m[i][i] + real(lib.thresholds.unphysical) * m[i][i])
        with body.loop("j", i) as j:
            entry = body.local("entry", comment="L_ij D_j")
            body.set(entry, m[i][j])
            with body.loop("k", j) as k:
                body.add(entry, -(factor[i][k] * factor[k][k] * factor[j][k]))
            body.set(factor[i][j], entry / factor[j][j])
            body.add(diagonal, -(factor[i][j] * entry))
        with body.when(m[i][i] > 0):
            lib.guard(body, Not(diagonal > 0), "NOT_POSITIVE_DEFINITE")
        body.set(factor[i][i], select(m[i][i] > 0, diagonal, real(1)))
    return body.checked_function(
        "check_added_mass",
        "Is the added mass finite, symmetric to the bit and positive semidefinite?",
        (added,),
        statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE"),
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
    whole = and_(d >= lib.layout.precision.smallest, d <= lib.limits["LARGEST"].expression)
    positive = and_(and_(A.place[0] > 0, cofactor[2] > 0), whole)
    lib.guard(body, Not(positive), "NOT_POSITIVE_DEFINITE")
    r = body.let("r", 1 / d)
    for k in range(6):
        body.set(inverse.place[k], cofactor[k] * r)
    return body.checked_function(
        "translation_block",
        "Constant translational block of K with added mass, A = m E + Lambda_11, and its inverse.",
        (p, mass, A, inverse),
        equation="(2)",
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def check_parameters(lib: Library) -> Function:
    """Check of all parameters, before anything is written."""
    layout = lib.layout
    parameters = Argument("parameters", layout.parameters)
    p = parameters.place
    bound = lib.limits["MAX_PARAMETER"].expression
    body = Body()
    total = body.local("mass")
    size = body.local(
        "size", comment="largest moment of inertia that products in the equations can reach; it must not overflow"
    )
    points = len(layout.structure.points)
    if layout.flywheels or points:
        O = body.local("O", (3,))
    if layout.instruments or layout.flywheels or points:
        R = body.local("R", (9,))
    lib.check(body, "check_body", p.carrier)
    body.set(total, p.carrier.mass)
    body.set(size, _trace(p.carrier.inertia))
    if layout.instruments:
        with body.loop("k", layout.instruments) as k:
            q = p.instrument[k]
            lib.check(body, "check_body", q.body)
            check_vector.put_into(body, lib, q.position, bound)
            lib.check(body, "frame_of_axes", q.axis, q.zero, R)
            body.add(total, q.body.mass)
            body.add(size, _trace(q.body.inertia) + q.body.mass * _square(q.position))
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            w = p.flywheel[s]
            lib.check(body, f"check_{layout.flywheel_body.name}", w.body)
            lib.guard(body, Not(w.body.inertia[0] >= real(lib.thresholds.least)), "NOT_POSITIVE_DEFINITE")
            named = {"parameters": p, "w": w, "O": O, "R": R}
            lib.check(body, "place_flywheel", *lib.arguments_of("place_flywheel", **named))
            body.add(total, w.body.mass)
            body.add(size, _trace(w.body.inertia) + w.body.mass * _square(O))
    if points:
        with body.loop("k", points) as k:
            named = {"parameters": p, "w": p.point[k], "O": O, "R": R}
            lib.check(body, "place_point", *lib.arguments_of("place_point", **named))
    lib.guard(body, Not(total >= real(lib.thresholds.least)), "NOT_POSITIVE_DEFINITE")
    lib.guard(body, Not(size <= lib.thresholds.inertia), "RANGE")
    if layout.added_mass:
        A = body.local("A", (6,))
        inverse = body.local("A_inv", (6,))
        lib.check(body, "check_added_mass", p.added_mass)
        lib.check(body, "translation_block", p, total, A, inverse)
    mounts = ("BAD_ARGUMENT",) if layout.instruments and (layout.flywheels or points) else ()
    return body.checked_function(
        "check_parameters",
        "Are the parameters finite and in range, the axes nonzero, and the bodies physically possible?",
        (parameters,),
        statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE", *mounts),
    )


def _trace(J: Place) -> Expr:
    """J11 + J22 + J33."""
    return J[0] + J[1] + J[2]


def _square(a: Place) -> Expr:
    """a . a."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]
