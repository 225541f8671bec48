"""Checks of parameters, before prepare writes anything.

A body can exist if and only if its second moments about the centre of mass, int(x x^T) dm, are positive semidefinite.
With J the inertia about the origin they are P = tr(J)/2 E - J - m c c^T. Their eigenvalues are (J1 + J2 - J3)/2 and so
on, with the principal moments about the centre of mass: so this one condition is the triangle inequality, in any axes,
and with it J >= 0. Added mass itself must be positive semidefinite.

Semidefinite to a tolerance: P + t |J| E and Lambda + t diag(Lambda) are positive definite, t of `thresholds`. The stand
file is refused from half of that on, so whatever it takes is taken here, in float as well.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.derive import SYMMETRIC
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import POSITIVE, factored, invert_symmetric
from mahovik.core.program.expression import Status, real
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import (
    NOT_POSITIVE_DEFINITE,
    OK,
    RANGE,
    Reals,
    argument,
    kernel,
    reals,
    result,
)
from mahovik.core.program.types import Struct
from mahovik.core.program.vector import dot
from mahovik.core.routines import ldl


def check_body(lib: Library, struct: Struct) -> Function:
    """Check of mass properties: can a body have them? `check_body` or `check_dry_body`, by the struct."""
    scalars = [field.name for field in struct.fields if not field.shape]
    arrays = [field.name for field in struct.fields if field.shape]
    bound = lib.limit("MAX_PARAMETER")

    @kernel(f"check_{struct.name}", statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE"))
    def check_body(body: Any = argument(struct=struct)) -> Status:
        """Are the mass properties finite and physically possible?"""
        masses = reals(len(scalars))
        masses[:] = [body.member(name) for name in scalars]
        lib["within"](masses, len(scalars), bound)
        for name in arrays:
            lib["within"](body.member(name), len(body.member(name)), bound)
        for name in scalars:
            if body.member(name) < 0:
                return RANGE
        return lib["check_inertia"](body.mass, body.center_of_mass, body.inertia)

    return check_body


def add_check_inertia(lib: Library) -> None:
    """Adds the check that second moments about the centre of mass are positive semidefinite."""
    tolerance = lib.thresholds.unphysical
    none = lib.layout.precision.smallest / tolerance  # of a point mass, or of a body so small that t |J| underflows

    @lib.kernel(statuses=POSITIVE)
    def check_inertia(
        mass: float = argument("not negative", unit="kg"),
        c: Reals = argument("centre of mass", 3, unit="m"),
        J: Reals = argument("about the origin: 11 22 33 12 13 23", 6, unit="kg m2"),
    ) -> Status:
        """Can a body have this inertia? Its second moments about the centre of mass are positive semidefinite."""
        size: float = 0.0  # largest element of J
        for k in range(6):
            size = abs(J[k]) if abs(J[k]) > size else size
        b = mass * c
        # P = tr(J)/2 E - J - m c c^T + t |J| E
        P = reals(6)
        P[:] = [
            0.5 * (J[1] + J[2] - J[0]) - b[0] * c[0] + tolerance * size,
            0.5 * (J[2] + J[0] - J[1]) - b[1] * c[1] + tolerance * size,
            0.5 * (J[0] + J[1] - J[2]) - b[2] * c[2] + tolerance * size,
            -J[3] - b[0] * c[1],
            -J[4] - b[0] * c[2],
            -J[5] - b[1] * c[2],
        ]
        # a point mass at the origin has no inertia, nor has a body so small that its tolerance underflows
        if size + (abs(b[0] * c[0]) + abs(b[1] * c[1]) + abs(b[2] * c[2])) > none:
            factored(P, lib.layout.precision.smallest)
        return OK


def add_added_mass(lib: Library) -> None:
    """Adds the check of added mass, and the constant block of K with its inverse."""
    tolerance = lib.thresholds.unphysical

    @lib.kernel(statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE"))
    def check_added_mass(
        added_mass: Reals = argument("of carrier and instruments, about O1 in E1", 6, 6),
    ) -> Status:
        """Is the added mass finite, symmetric to the bit and positive semidefinite?"""
        m = added_mass
        shifted = reals(6, 6)  # Lambda + t diag(Lambda), then its factors
        for i in range(6):
            lib["within"](m[i], 6, lib.limit("MAX_PARAMETER"))
        for i in range(6):
            for j in range(i):
                if m[i][j] < m[j][i] or m[i][j] > m[j][i]:
                    return NOT_POSITIVE_DEFINITE
        # rows of zeros (directions without added mass) are left out
        for i in range(6):
            for j in range(6):
                if (m[i][j] < 0 or m[i][j] > 0) and not (m[i][i] > 0):
                    return NOT_POSITIVE_DEFINITE
                shifted[i][j] = m[i][j]
            shifted[i][i] = m[i][i] + tolerance * m[i][i] if m[i][i] > 0 else 1.0
        ldl.factor(shifted, 6, lambda _: real(0), True)
        return OK

    @lib.kernel(equation="(2)", statuses=POSITIVE)
    def translation_block(
        parameters: Any = argument(struct=lib.layout.parameters),
        mass: float = argument(unit="kg"),
        A: Reals = result("", 6, unit="kg"),
        A_inv: Reals = result("", 6, unit="1/kg"),
    ) -> Status:
        """Constant translational block of K with added mass, A = m E + Lambda_11, and its inverse."""
        Lambda = parameters.added_mass
        A[:] = [mass + Lambda[i][j] if i == j else Lambda[i][j] for i, j in SYMMETRIC]
        invert_symmetric(lib, A, A_inv)
        return OK


def add_check_parameters(lib: Library) -> None:
    """Adds the check of all parameters, before anything is written."""
    layout, bound, least = lib.layout, lib.limit("MAX_PARAMETER"), lib.thresholds.least
    points = len(layout.structure.points)
    mounts = ("BAD_ARGUMENT",) if layout.instruments and (layout.flywheels or points) else ()

    @lib.kernel(statuses=("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE", *mounts))
    def check_parameters(parameters: Any = argument(struct=layout.parameters)) -> Status:
        """Are the parameters finite and in range, the axes nonzero, and the bodies physically possible?"""
        p = parameters
        mass = reals()
        size = reals()  # largest moment of inertia in the equations: it must not overflow
        if layout.flywheels or points:
            O = reals(3)
        if layout.instruments or layout.flywheels or points:
            R = reals(9)
        lib["check_body"](p.carrier)
        mass = p.carrier.mass
        size = trace(p.carrier.inertia)
        if layout.instruments:
            for k in range(layout.instruments):
                q = p.instrument[k]
                lib["check_body"](q.body)
                check_vector(lib, q.position, bound)
                lib["frame_of_axes"](q.axis, q.zero, R)
                mass += q.body.mass
                size += trace(q.body.inertia) + q.body.mass * dot(q.position, q.position)
        if layout.flywheels:
            for s in range(layout.count):
                w = p.flywheel[s]
                lib[f"check_{layout.flywheel_body.name}"](w.body)
                if not (w.body.inertia[0] >= least):
                    return NOT_POSITIVE_DEFINITE
                lib["place_flywheel"](p, w, O, R)
                mass += w.body.mass
                size += trace(w.body.inertia) + w.body.mass * dot(O, O)
        if points:
            for k in range(points):
                lib["place_point"](p, p.point[k], O, R)
        if not (mass >= least):
            return NOT_POSITIVE_DEFINITE
        if not (size <= lib.thresholds.inertia):
            return RANGE
        if layout.added_mass:
            A = reals(6)
            A_inv = reals(6)
            lib["check_added_mass"](p.added_mass)
            lib["translation_block"](p, mass, A, A_inv)
        return OK


def trace(J: Any) -> Any:
    """J11 + J22 + J33."""
    return J[0] + J[1] + J[2]
