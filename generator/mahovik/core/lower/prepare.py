"""prepare: the table of a stand from masses, centres of mass, inertias and mountings. The generator runs it too.

Parameters are checked before anything is written. A body can exist if and only if its second moments about the centre
of mass, int(x x^T) dm, are positive semidefinite. With J the inertia about the origin they are P = tr(J)/2 E - J -
m c c^T. Their eigenvalues are (J1 + J2 - J3)/2 and so on, with the principal moments about the centre of mass: so this
one condition is the triangle inequality, in any axes, and with it J >= 0. Added mass itself must be positive
semidefinite.

Semidefinite to a tolerance: P + t |J| E and Lambda + t diag(Lambda) are positive definite, t of `thresholds`. The stand
file is refused from half of that on, so whatever it takes is taken here, in float as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.contract.quantities import short
from mahovik.core.derive import SYMMETRIC
from mahovik.core.formula.derived import carrying as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower import hold
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import POSITIVE, factored, invert_symmetric
from mahovik.core.program.expression import Status, real
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    NOT_POSITIVE_DEFINITE,
    OK,
    RANGE,
    Reals,
    argument,
    body,
    changed,
    inline,
    kernel,
    let,
    reals,
    result,
)
from mahovik.core.program.types import Struct
from mahovik.core.program.vector import cross, dot
from mahovik.core.routines import ldl


@dataclass(frozen=True)
class Work:
    """Locals of prepare: sums of the constant parts, and scratch of one body; see their comments there."""

    mass: Any
    first_moment: Any
    inertia: Any
    weight_mass: Any
    displaced: Any
    O: Any
    R: Any
    b: Any
    mu: Any
    J1: Any
    t: Any


def add_carry(lib: Library) -> None:
    """Adds one harmonic of Theta(phi) to E1 about O1: L0 Theta L0^T, and the moment part of L0 Theta f."""

    @lib.kernel(equation="(2)")
    def carry(
        m: float = argument("mass; 0 for harmonics 1 and 2", unit="kg"),
        b: Reals = argument("first moment in mounting axes", 3, unit="kg m"),
        J: Reals = argument("about the body's origin", 6, unit="kg m2"),
        O: Reals = argument("the body's origin in E1", 3, unit="m"),
        R: Reals = argument("its axes in E1", 9),
        mu: Reals = result("first moment about O1", 3, unit="kg m"),
        J1: Reals = result("about O1", 6, unit="kg m2"),
        spins: int = argument("0: t is not wanted"),
        t: Reals = result("moment part of I for a spin about the first axis", 3, unit="kg m2"),
    ) -> None:
        """Carries one harmonic of a spatial inertia from a body's frame to E1 about O1."""
        b1 = reals(3)  # R b
        RJ = reals(9)  # R J
        Jr = reals(6)  # R J R^T
        b1[:] = R @ b
        first, second = derived.rotated_tensor()
        RJ[:] = formula(first, R=R, J=J)
        Jr[:] = formula(second, R=R, RJ=RJ)
        # T Theta T^T: about O1
        moved_mu, moved_J = derived.shifted_inertia()
        mu[:] = formula(moved_mu, m=m, b=b1, O=O)
        J1[:] = formula(moved_J, m=m, b=b1, J=Jr, O=O, mu=mu)
        if spins != 0:
            t[:] = formula(derived.spin_momentum(), b=b1, J=Jr, O=O, axis=R[0::3])


@inline
def fill_fixed_body(lib: Library, work: Any, part: Any) -> None:
    """A body that does not turn: its origin and axes are set."""
    work.b[:] = part.mass * part.center_of_mass
    lib["carry"](part.mass, work.b, part.inertia, work.O, work.R, work.mu, work.J1, 0, work.t)
    add_to_sums(work, part.mass)
    fill_displaced_mass(lib, work, part, None)


@inline
def add_to_sums(work: Any, mass: Any) -> None:
    """Adds mu, J1 to the constant part."""
    work.mass += mass
    work.first_moment += work.mu
    work.inertia += work.J1


@inline
def fill_displaced_mass(lib: Library, work: Any, part: Any, row: Any) -> None:
    """Displaced mass and its first moment about O1; the turning part of a flywheel's goes to its row."""
    if not lib.layout.displaces:
        return
    if row is not None and not lib.layout.flywheel_displaces:
        work.weight_mass += part.mass
        return
    O, R, center, displaced_mass = work.O, work.R, part.displaced_center, part.displaced_mass
    work.weight_mass += part.mass - displaced_mass
    for i in list(range(3)):
        if row is None:
            work.displaced[i] += displaced_mass * (
                O[i] + (R[3 * i] * center[0] + (R[3 * i + 1] * center[1] + R[3 * i + 2] * center[2]))
            )
        else:
            work.displaced[i] += displaced_mass * (O[i] + R[3 * i] * center[0])
            row.displaced_c[i] = displaced_mass * (R[3 * i + 1] * center[1] + R[3 * i + 2] * center[2])
            row.displaced_s[i] = displaced_mass * (R[3 * i + 2] * center[1] - R[3 * i + 1] * center[2])


@inline
def place_instrument(lib: Library, work: Any, instrument: Any) -> None:
    """Origin and axes of an instrument, whose numbers have been checked."""
    body().do(lib["frame_of_axes"](instrument.axis, instrument.zero, work.R))
    work.O[:] = instrument.position


def place(lib: Library, work: Any, parameters: Any, part: Any, function: str = "place_flywheel") -> None:
    """Origin and axes of a flywheel or point, whose numbers have been checked."""
    body().do(lib[function](parameters, part, work.O, work.R))


@inline
def prepare_flywheels(lib: Library, work: Any, parameters: Any, table: Any) -> None:
    """Every flywheel: its constant part to the totals, its harmonics to its row."""
    # flywheels: constant part to the totals, harmonics to the row
    for s in range(lib.layout.count):
        w, row = parameters.flywheel[s], table.flywheel[s]
        place(lib, work, parameters, w)
        work.b[:] = w.body.mass * w.body.center_of_mass
        bh = reals(3)  # first moment of one harmonic, in mounting axes
        Jh = reals(6)  # its inertia
        for name, mu, J, t in (
            ("0", work.mu, work.J1, row.t_0),
            ("c", row.mu_c, row.J_c, row.t_c),
            ("s", row.mu_s, row.J_s, row.t_s),
            ("2c", work.mu, row.J_2c, work.t),
            ("2s", work.mu, row.J_2s, work.t),
        ):
            part = derived.harmonics()[name]
            body().note(f"harmonic {name} of Theta(phi)")
            bh[:] = formula(part.b, b=work.b, J=w.body.inertia, m=w.body.mass)
            Jh[:] = formula(part.J, b=work.b, J=w.body.inertia, m=w.body.mass)
            mass, spins = w.body.mass if name == "0" else 0, 0 if t is work.t else 1
            lib["carry"](mass, bh, Jh, work.O, work.R, mu, J, spins, t)
            if name == "0":
                add_to_sums(work, w.body.mass)
        row.spin = w.body.inertia[0]
        row.spin_inv = 1 / w.body.inertia[0]
        row.spin_root_inv = 1 / lib["sqrt"](w.body.inertia[0])
        fill_displaced_mass(lib, work, w.body, row)
        if lib.layout.along:
            hold.prepare_row(lib, table, row)


@inline
def prepare_poses(lib: Library, work: Any, parameters: Any, table: Any) -> None:
    """Frames of the bodies that have wrenches in them; poses of instruments, then points."""
    layout = lib.layout
    if layout.local_bodies:
        # frames of the bodies with wrenches of their own
        for k in range(len(layout.local_bodies)):
            frame = table.frame[k]
            if layout.local_turning and frame.flywheel >= 0:
                place(lib, work, parameters, parameters.flywheel[frame.flywheel])
            if layout.local_fixed and frame.instrument >= 0:
                place_instrument(lib, work, parameters.instrument[frame.instrument])
            frame.origin[:] = work.O
            frame.axes[:] = work.R
    if layout.sensors:
        # poses of instruments and points
        if layout.instruments:
            for k in range(layout.instruments):
                place_instrument(lib, work, parameters.instrument[k])
                table.sensor[k].origin[:] = work.O
                table.sensor[k].axes[:] = work.R
        if layout.structure.points:
            for k in range(len(layout.structure.points)):
                place(lib, work, parameters, parameters.point[k], "place_point")
                sensor = table.sensor[k + layout.instruments]
                sensor.origin[:] = work.O
                sensor.axes[:] = work.R


def add_prepare(lib: Library) -> None:
    """Adds the whole table except the laws of the wrenches."""
    layout = lib.layout
    notes = (
        "The generator makes the default table by the same operations: the default parameters give its bits.",
        "Also returns RANGE if a mass is negative or an axis has no direction.",
        "NOT_POSITIVE_DEFINITE: no such body exists. Moments of inertia about the centre of mass are "
        "negative or break the triangle inequality"
        + (", added mass that is not symmetric and positive semidefinite" if layout.added_mass else "")
        + f" (to {short(lib.thresholds.unphysical)} of the largest element)"
        + ("; a flywheel without spin inertia" if layout.flywheels else "")
        + "; no mass at all.",
    )
    kept = "start with a copy of the default; its laws (gravity, damping, ...) are kept"

    @lib.kernel(equation="(2)", statuses=lib["check_parameters"].statuses, notes=notes, public=True)
    def prepare(
        parameters: Any = argument("masses, inertias, mountings", struct=layout.parameters),
        table: Any = changed(kept, struct=layout.table),
    ) -> Status:
        """Makes the table of a stand from masses, centres of mass, inertias and mountings."""
        lib["check_parameters"](parameters)
        # all checks passed: from here on the table is written and nothing can fail
        mass = reals()
        first_moment = reals(3)
        inertia = reals(6)
        mass = 0
        first_moment[:] = [0] * 3
        inertia[:] = [0] * 6
        weight_mass, displaced = None, None
        if layout.displaces:
            weight_mass = reals()
            displaced = reals(3)
            weight_mass = 0
            displaced[:] = [0] * 3
        # carrier: its frame is E1
        O = reals(3)  # origin of a body in E1
        R = reals(9)  # axes of a body in E1
        b = reals(3)  # first moment in the body's frame
        mu = reals(3)
        J1 = reals(6)
        t = reals(3)
        work = Work(mass, first_moment, inertia, weight_mass, displaced, O, R, b, mu, J1, t)
        O[:] = [0] * 3
        R[:] = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        fill_fixed_body(lib, work, parameters.carrier)
        if layout.instruments:
            # instruments
            for k in range(layout.instruments):
                place_instrument(lib, work, parameters.instrument[k])
                fill_fixed_body(lib, work, parameters.instrument[k].body)
        if layout.flywheels:
            prepare_flywheels(lib, work, parameters, table)
        if layout.added_mass:
            added = parameters.added_mass
            body().do(lib["translation_block"](parameters, mass, table.A, table.A_inv))
            table.G[:] = [added[i + 3][j] for i in range(3) for j in range(3)]
            if layout.stream:
                table.Lambda_11[:] = [added[i][j] for i, j in SYMMETRIC]
            inertia += [added[i + 3][j + 3] for i, j in SYMMETRIC]
        table.mass = mass
        table.mass_inverse = 1 / mass
        table.first_moment[:] = first_moment
        table.inertia[:] = inertia
        if layout.along:
            hold.prepare_constant(lib, table)
        if layout.displaces:
            table.weight_mass = weight_mass
            table.displaced_moment[:] = displaced
        prepare_poses(lib, work, parameters, table)
        return OK


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
        unit(across, e2, "across2", lib.thresholds.parallel_square * zero2)
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


# -- checks of parameters, before anything is written ------------------------------------------------------------------


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
