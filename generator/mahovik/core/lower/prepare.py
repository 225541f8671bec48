"""prepare: the table of a stand from masses, centres of mass, inertias and mountings. The generator runs it too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.formula.derived import carrying as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower import hold
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, Status, integer, real, unequal
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def carry(lib: Library) -> Function:
    """One harmonic of Theta(phi) to E1 about O1: L0 Theta L0^T, and the moment part of L0 Theta f."""
    m = Argument("m", Kind.REAL, unit="kg", purpose="mass; 0 for harmonics 1 and 2")
    b = Argument("b", Kind.REAL, (3,), unit="kg m", purpose="first moment in mounting axes")
    J_own = Argument("J", Kind.REAL, (6,), unit="kg m2", purpose="about the body's origin")
    O = Argument("O", Kind.REAL, (3,), unit="m", purpose="the body's origin in E1")
    R = Argument("R", Kind.REAL, (9,), purpose="its axes in E1")
    mu = Argument("mu", Kind.REAL, (3,), "out", "kg m", "first moment about O1")
    J = Argument("J1", Kind.REAL, (6,), "out", "kg m2", "about O1")
    spins = Argument("spins", Kind.INT, purpose="0: t is not wanted")
    t = Argument("t", Kind.REAL, (3,), "out", "kg m2", "moment part of I for a spin about the first axis")
    body = Body()
    b1 = body.local("b1", (3,), comment="R b")
    RJ = body.local("RJ", (9,), comment="R J")
    Jr = body.local("Jr", (6,), comment="R J R^T")
    assign(body, list(b1), derived_wrench.rotated(), {"C": R.place, "a": b.place})
    first, second = derived.rotated_tensor()
    assign(body, list(RJ), first, {"R": R.place, "J": J_own.place})
    assign(body, list(Jr), second, {"R": R.place, "RJ": RJ})
    body.note("T Theta T^T: about O1")
    moved_mu, moved_J = derived.shifted_inertia()
    binding: dict[str, Any] = {"m": m.place, "b": b1, "J": Jr, "O": O.place, "mu": mu.place}
    assign(body, list(mu.place), moved_mu, binding)
    assign(body, list(J.place), moved_J, binding)
    axis = [R.place[0], R.place[3], R.place[6]]
    moment = derived.spin_momentum()
    with body.when(unequal(spins.place, integer(0))):
        assign(body, list(t.place), moment, binding | {"axis": axis})
    return Function(
        "carry",
        "Carries one harmonic of a spatial inertia from a body's frame to E1 about O1.",
        (m, b, J_own, O, R, mu, J, spins, t),
        body.statements,
        equation="(2)",
    )


@dataclass
class _Totals:
    """Places where the constant parts are summed up."""

    mass: Place
    mu: Place
    J: Place
    weight_mass: Place | None
    displaced: Place | None


def prepare(lib: Library) -> Function:
    """The whole table except the laws of the wrenches."""
    layout = lib.layout
    parameters = Argument("parameters", layout.parameters, purpose="masses, inertias, mountings")
    table = Argument(
        "table",
        layout.table,
        (),
        "inout",
        purpose="start with a copy of the default; its laws (gravity, damping, ...) are kept",
    )
    p, out = parameters.place, table.place
    body = Body()
    lib.check(body, "check_parameters", p)
    body.note("all checks passed: from here on the table is written and nothing can fail")
    totals = _start(layout, body)
    body.note("carrier: its frame is E1")
    origin = body.local("O", (3,), comment="origin of a body in E1")
    R = body.local("R", (9,), comment="axes of a body in E1")
    b = body.local("b", (3,), comment="first moment in the body's frame")
    mu = body.local("mu", (3,))
    J1 = body.local("J1", (6,))
    t = body.local("t", (3,))
    work = _Work(lib, body, totals, origin, R, b, mu, J1, t)
    identity = (1, 0, 0, 0, 1, 0, 0, 0, 1)
    for i in range(3):
        body.set(origin[i], real(0))
    for i in range(9):
        body.set(R[i], real(identity[i]))
    work.fill_fixed_body(p.carrier)
    if layout.instruments:
        _instruments(lib, work, p)
    if layout.flywheels:
        _flywheels(lib, work, p, out)
    if layout.added_mass:
        body.call(lib["translation_block"], p, totals.mass, out.A, out.A_inv)
        for i in range(3):
            for j in range(3):
                body.set(out.G[3 * i + j], p.added_mass[i + 3][j])
        for k, (i, j) in enumerate(SYMMETRIC):
            body.add(totals.J[k], p.added_mass[i + 3][j + 3])
    body.set(out.mass, totals.mass)
    body.set(out.mass_inverse, 1 / totals.mass)
    body.copy_array(out.first_moment, totals.mu)
    body.copy_array(out.inertia, totals.J)
    if layout.along:
        hold.prepare_constant.put_into(body, lib, out)
    if totals.weight_mass is not None and totals.displaced is not None:
        body.set(out.weight_mass, totals.weight_mass)
        body.copy_array(out.displaced_moment, totals.displaced)
    if layout.own:
        _frames(lib, work, p, out)
    if layout.sensors:
        _sensors(lib, work, p, out)
    body.ret(Status("OK"))
    return Function(
        "prepare",
        "Makes the table of a stand from masses, centres of mass, inertias and mountings.",
        (parameters, table),
        body.statements,
        equation="(2)",
        returns=Kind.STATUS,
        statuses=lib["check_parameters"].statuses,
        notes=(
            "The generator makes the default table by the same operations: the default parameters give its bits.",
            "Also returns RANGE if a mass is negative or an axis has no direction.",
            "NOT_POSITIVE_DEFINITE: no such body exists. Moments of inertia about the centre of mass are "
            "negative or break the triangle inequality"
            + (", added mass that is not symmetric and positive semidefinite" if layout.added_mass else "")
            + f" (to {lib.thresholds.unphysical:g} of the largest element)"
            + ("; a flywheel without spin inertia" if layout.flywheels else "")
            + "; no mass at all.",
        ),
        public=True,
    )


def _start(layout: Layout, body: Body) -> _Totals:
    mass = body.local("mass")
    mu = body.local("first_moment", (3,))
    J = body.local("inertia", (6,))
    body.set(mass, real(0))
    for element in (*mu, *J):
        body.set(element, real(0))
    if not layout.displaces:
        return _Totals(mass, mu, J, None, None)
    weight_mass = body.local("weight_mass")
    displaced = body.local("displaced", (3,))
    body.set(weight_mass, real(0))
    for element in displaced:
        body.set(element, real(0))
    return _Totals(mass, mu, J, weight_mass, displaced)


@dataclass
class _Work:
    """Scratch variables of prepare, and the steps common to all bodies."""

    lib: Library
    body: Body
    totals: _Totals
    origin: Place
    R: Place
    b: Place
    mu: Place
    J1: Place
    t: Place

    def first_moment(self, b: Place) -> None:
        """b = m rc."""
        for i in range(3):
            self.body.set(self.b[i], b.mass * b.center_of_mass[i])

    def add(self, mass: Expr) -> None:
        """Adds mu, J1 to the constant part."""
        self.body.add(self.totals.mass, mass)
        for i in range(3):
            self.body.add(self.totals.mu[i], self.mu[i])
        for i in range(6):
            self.body.add(self.totals.J[i], self.J1[i])

    def fill_fixed_body(self, b: Place) -> None:
        """A body that does not turn: origin and R are set."""
        self.first_moment(b)
        args = (b.mass, self.b, b.inertia, self.origin, self.R, self.mu, self.J1, integer(0), self.t)
        self.body.call(self.lib["carry"], *args)
        self.add(b.mass)
        self.fill_displaced_mass(b, None)

    def fill_displaced_mass(self, b: Place, row: Place | None) -> None:
        """Displaced mass and its first moment about O1; the turning part of a flywheel's goes to its row."""
        if self.totals.weight_mass is None or self.totals.displaced is None:
            return
        if row is not None and not self.lib.layout.flywheel_displaces:
            self.body.add(self.totals.weight_mass, b.mass)
            return
        body, R, center = self.body, self.R, b.displaced_center
        body.add(self.totals.weight_mass, b.mass - b.displaced_mass)
        for i in range(3):
            turning = R[3 * i + 1] * center[1] + R[3 * i + 2] * center[2]
            along = R[3 * i] * center[0]
            if row is None:
                body.add(self.totals.displaced[i], b.displaced_mass * (self.origin[i] + (along + turning)))
                continue
            body.add(self.totals.displaced[i], b.displaced_mass * (self.origin[i] + along))
            back = R[3 * i + 2] * center[1] - R[3 * i + 1] * center[2]
            body.set(row.displaced_c[i], b.displaced_mass * turning)
            body.set(row.displaced_s[i], b.displaced_mass * back)

    def place_instrument(self, q: Place) -> None:
        """origin and R of an instrument."""
        self.body.call(self.lib["frame_of_axes"], q.axis, q.zero, self.R)
        self.body.copy_array(self.origin, q.position)


def _instruments(lib: Library, work: _Work, p: Place) -> None:
    body = work.body
    body.note("instruments")
    with body.loop("k", lib.layout.instruments) as k:
        q = p.instrument[k]
        work.place_instrument(q)
        work.fill_fixed_body(q.body)


def _flywheels(lib: Library, work: _Work, p: Place, out: Place) -> None:
    """Every flywheel: its constant part to the totals, its harmonics to its row."""
    body = work.body
    body.note("flywheels: constant part to the totals, harmonics to the row")
    with body.loop("s", lib.layout.count) as s:
        w = p.flywheel[s]
        row = out.flywheel[s]
        _place(lib, body, p, w, work)
        work.first_moment(w.body)
        parts = derived.harmonics()
        binding = {"b": work.b, "J": w.body.inertia, "m": w.body.mass}
        half = body.local("bh", (3,), comment="first moment of one harmonic, in mounting axes")
        Jh = body.local("Jh", (6,), comment="its inertia")
        for name, mu, J, t in (
            ("0", work.mu, work.J1, row.t_0),
            ("c", row.mu_c, row.J_c, row.t_c),
            ("s", row.mu_s, row.J_s, row.t_s),
            ("2c", work.mu, row.J_2c, work.t),
            ("2s", work.mu, row.J_2s, work.t),
        ):
            part = parts[name]
            body.note(f"harmonic {name} of Theta(phi)")
            assign(body, list(half), part.b, binding)
            assign(body, list(Jh), part.J, binding)
            mass: Expr = w.body.mass if name == "0" else real(0)
            spins = integer(0 if t is work.t else 1)
            body.call(lib["carry"], mass, half, Jh, work.origin, work.R, mu, J, spins, t)
            if name == "0":
                work.add(w.body.mass)
        body.set(row.spin, w.body.inertia[0])
        body.set(row.spin_inv, 1 / w.body.inertia[0])
        body.set(row.spin_root_inv, 1 / lib["sqrt"](w.body.inertia[0]))
        work.fill_displaced_mass(w.body, row)
        if lib.layout.along:
            hold.prepare_row.put_into(body, lib, out, row)


def _place(lib: Library, body: Body, p: Place, w: Place, work: _Work, function: str = "place_flywheel") -> None:
    named = {"parameters": p, "w": w, "O": work.origin, "R": work.R}
    body.call(lib[function], *lib.arguments_of(function, **named))


def _sensors(lib: Library, work: _Work, p: Place, out: Place) -> None:
    """Poses of instruments, then points."""
    layout, body = lib.layout, work.body
    body.note("poses of instruments and points")
    if layout.instruments:
        with body.loop("k", layout.instruments) as k:
            work.place_instrument(p.instrument[k])
            body.copy_array(out.sensor[k].origin, work.origin)
            body.copy_array(out.sensor[k].axes, work.R)
    if layout.structure.points:
        with body.loop("k", len(layout.structure.points)) as k:
            _place(lib, body, p, p.point[k], work, "place_point")
            sensor = out.sensor[k + layout.instruments] if layout.instruments else out.sensor[k]
            body.copy_array(sensor.origin, work.origin)
            body.copy_array(sensor.axes, work.R)


def _frames(lib: Library, work: _Work, p: Place, out: Place) -> None:
    """Poses of the bodies that have wrenches in their own frame."""
    layout, body = lib.layout, work.body
    body.note("frames of the bodies with wrenches of their own")
    with body.loop("k", len(layout.own)) as k:
        frame = out.frame[k]
        if layout.own_turning:
            with body.when(frame.flywheel >= 0):
                _place(lib, body, p, p.flywheel[frame.flywheel], work)
        if layout.own_fixed:
            with body.when(frame.instrument >= 0):
                work.place_instrument(p.instrument[frame.instrument])
        body.copy_array(frame.origin, work.origin)
        body.copy_array(frame.axes, work.R)
