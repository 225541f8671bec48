"""A programme from nodes: quintic Hermite interpolation of the angles, Lagrange's of the drive torques.

Between two nodes a quintic polynomial has the angle, rate and second derivative of both (h the step, u in [0, 1]):
phi = p0 + v0 u + a0/2 u^2 + c3 u^3 + c4 u^4 + c5 u^5, v = h phi_dot, a = h^2 phi_ddot, with d = p1 - p0 - v0 - a0/2,
e = v1 - v0 - a0, g = a1 - a0: c3 = 10 d - 4 e + g/2, c4 = -15 d + 7 e - g, c5 = 6 d - 3 e + g/2. Speed and acceleration
are its derivatives: the three belong together. A torque is the polynomial through the six nodes about the place.
"""

from __future__ import annotations

from math import prod

from mahovik.core.lower.library import Library
from mahovik.core.lower.programme.form import Form
from mahovik.core.lower.programme.place import Spot, check_phase, phase_argument, phase_of_winding, spot
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert, Expr, Place, integer, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

POINTS = 6
"""Nodes that a torque is interpolated from."""


def quintic(lib: Library, form: Form) -> Function:
    """`..._course(table, phase, phi, phi_dot, phi_ddot, tau)` of a quintic table."""
    table, phase = Argument("table", form.table), phase_argument(form.cyclic)
    outputs = output_arguments(form)
    phi, phi_dot, phi_ddot = (a.place for a in outputs[:3])
    body = Body()
    check_phase(lib, body, phase.place, form.cyclic)
    at = spot(lib, body, phase.place, form.rows, form.cyclic)
    one = integer(1)
    after = body.let("after", (at.j + one) % integer(form.rows) if form.cyclic else at.j + one)
    t, u = table.place, at.u
    first, last = t.node[at.j], t.node[after]
    with body.loop("s", form.count) as s:
        body.note("The quintic that has angle, rate and second derivative of both nodes.")
        v0 = body.let("v0", t.step * first.phi_dot[s])
        a0 = body.let("a0", t.step * t.step * first.phi_ddot[s])
        v1 = body.let("v1", t.step * last.phi_dot[s])
        d = body.let("d", _beyond(lib, body, form, (first.phi[s], last.phi[s]), (v0, v1)) - a0 * 0.5)
        e = body.let("e", (v1 - v0) - a0)
        g = body.let("g", t.step * t.step * last.phi_ddot[s] - a0)
        c3 = body.let("c3", real(10) * d - real(4) * e + g * 0.5)
        c4 = body.let("c4", real(7) * e - real(15) * d - g)
        c5 = body.let("c5", real(6) * d - real(3) * e + g * 0.5)
        angle = first.phi[s] + u * (v0 + u * (a0 * 0.5 + u * (c3 + u * (c4 + u * c5))))
        speed = (v0 + u * (a0 + u * (real(3) * c3 + u * (real(4) * c4 + u * (real(5) * c5))))) * t.rate
        if form.cyclic:
            angle = phase_of_winding(lib, body, t.winding[s], at, form.rows) + t.mean[s] + angle
            speed = t.speed[s] + speed
        body.set(phi[s], lib["wrapped"](angle))
        body.set(phi_dot[s], speed)
        second = a0 + u * (real(6) * c3 + u * (real(12) * c4 + u * (real(20) * c5)))
        body.set(phi_ddot[s], second * (t.rate * t.rate))
    if form.torque:
        _torques(body, form, t, at, outputs[3].place)
    return body.checked_function(
        f"{form.prefix}course",
        "Angles, speeds and accelerations of all flywheels from a table of nodes.",
        (table, phase, *outputs),
    )


def output_arguments(form: Form) -> tuple[Argument, ...]:
    """Output arguments of every table."""
    n = (form.count,)
    found = [
        Argument("phi", Kind.REAL, n, "out", "rad", "angles, within half a turn of zero to rounding"),
        Argument("phi_dot", Kind.REAL, n, "out", "rad/s", "speeds"),
        Argument("phi_ddot", Kind.REAL, n, "out", "rad/s2", "accelerations"),
    ]
    if form.torque:
        of = "a carrier that is free on the way" if form.part else "the prescribed motion"
        found.append(Argument("tau", Kind.REAL, n, "out", "N m", f"drive torques of {of}"))
    return tuple(found)


def _beyond(lib: Library, body: Body, form: Form, phi: tuple[Expr, Expr], v: tuple[Expr, Expr]) -> Expr:
    """p1 - p0 - v0. The angles of a finite table are without whole turns: the mean of both speeds says how many."""
    rise = phi[1] - phi[0]
    if form.cyclic:
        return rise - v[0]
    expected = body.let("expected", (v[0] + v[1]) * 0.5)
    return lib["wrapped"](rise - expected) + (v[1] - v[0]) * 0.5


def _torques(body: Body, form: Form, table: Place, at: Spot, tau: Place) -> None:
    """tau from six nodes: their weights, then their sums."""
    body.note("Drive torque: the polynomial through six nodes; w is the place among them.")
    weight = body.local("weight", (POINTS,))
    if form.cyclic:
        start = body.let("start", at.j + integer(form.rows - 2))
        w = body.let("w", at.u + real(2))
    else:
        highest = integer(form.rows + 1 - POINTS)
        low = body.let("low", select(at.j < 2, integer(0), at.j - integer(2)))
        start = body.let("start", select(low > highest, highest, low))
        w = body.let("w", Convert(at.j - start, Kind.REAL) + at.u)
    for n in range(POINTS):
        value: Expr = real(1.0 / prod(n - m for m in range(POINTS) if m != n))
        for m in range(POINTS):
            if m != n:
                value = value * (w - real(m) if m else w)
        body.set(weight[n], value)
    with body.loop("s", form.count) as s:
        body.set(tau[s], real(0))
    with body.loop("i", POINTS) as i:
        row = body.let("row", (start + i) % integer(form.rows) if form.cyclic else start + i)
        with body.loop("s", form.count) as s:
            body.add(tau[s], weight[i] * table.node[row].tau[s])
