"""mounts: the whole wrench of the mount on each flywheel, and the table that it needs beside the stand's."""

from __future__ import annotations

from typing import Any

from mahovik.contract.laws import part
from mahovik.core.formula.derived import drive as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.flywheels import turn_of
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    check_inputs,
    relative_rate,
    scene,
)
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.lower.wrenches import flywheel_wrenches
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def carry_twist(lib: Library) -> Function:
    """L0^T of a twist or its rate: of the carrier, in mounting axes at Os."""
    mount = Argument("mount", lib.layout.mount)
    V = Argument("V", Kind.REAL, (6,))
    U = Argument("U", Kind.REAL, (6,), "out", purpose="in mounting axes at Os")
    body = Body()
    velocity = body.local("velocity", (3,), comment="velocity of Os")
    assign(body, list(velocity), derived_wrench.twist_at(), parts_of_twist(V.place) | {"O": mount.place.origin})
    back = derived_wrench.rotated_back()
    assign(body, list(U.place)[:3], back, {"C": mount.place.axes, "a": velocity})
    assign(body, list(U.place)[3:], back, {"C": mount.place.axes, "a": list(V.place)[3:]})
    return body.function("carry_twist", "L^T V: a twist carried to Os, in mounting axes.", (mount, V, U))


def mount_wrench(lib: Library) -> Function:
    """Wrench of the mount on one flywheel."""
    layout = lib.layout
    mount = Argument("mount", layout.mount)
    s = Argument("s", Kind.REAL, purpose="sin phi")
    c = Argument("c", Kind.REAL, purpose="cos phi")
    phi_dot = Argument("phi_dot", Kind.REAL, unit="rad/s")
    phi_ddot = Argument("phi_ddot", Kind.REAL, unit="rad/s2")
    V = Argument("V", Kind.REAL, (6,))
    V_dot = Argument("V_dot", Kind.REAL, (6,))
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    W = Argument(
        "W",
        Kind.REAL,
        (6,),
        "inout",
        "N, N m",
        "in: -P_s, its own external wrench, in Es; out: wrench of the mount, in mounting axes about Os",
    )
    body = Body()
    m = mount.place
    U = body.local("U", (6,), comment="twist of the mount at Os")
    turned = body.local("turned", (6,), comment="in Es")
    turned_dot = body.local("turned_dot", (6,))
    V_s = body.local("V_s", (6,), comment="twist of the flywheel, in Es")
    V_s_dot = body.local("V_s_dot", (6,))
    Z_s = body.local("Z_s", (6,), comment="its momentum screw")
    phase: dict[str, Any] = {"s": s.place, "c": c.place}
    body.call(lib["carry_twist"], m, V.place, U)
    assign(body, list(turned), derived.turned_twist(), phase | {"U": U})
    body.call(lib["carry_twist"], m, V_dot.place, U)
    assign(body, list(turned_dot), derived.turned_twist(), phase | {"U": U})
    for i in range(6):
        body.set(V_s[i], turned[i] + phi_dot.place if i == 3 else turned[i])
    rates = {"turned": turned, "turned_dot": turned_dot, "phi_dot": phi_dot.place, "phi_ddot": phi_ddot.place}
    assign(body, list(V_s_dot), derived.own_twist_rate(), rates)
    bound = {"m": m.mass, "b": m.first_moment, "J": m.inertia, "V_s": V_s, "V_s_dot": V_s_dot, "Z_s": Z_s}
    assign(body, list(Z_s), derived.own_momentum(), bound)
    assign(body, list(W.place), derived.own_rate(), bound, add=True)
    if layout.weight:
        _subtract_weight(lib, body, m, phase, g.place, W.place)
    own = body.local("own", (6,), comment="in Es")
    body.copy_array(own, W.place)
    assign(body, list(W.place), derived.turned_forward(), phase | {"W": own})
    return body.function(
        "mount_wrench",
        "Wrench of the mount on one flywheel: diag(C1, C1) (Theta V_s* + Phi(V_s) Z_s - P_s).",
        (mount, s, c, phi_dot, phi_ddot, V, V_dot, g, W),
    )


def _subtract_weight(lib: Library, body: Body, m: Place, phase: dict[str, Any], g: Place, W: Place) -> None:
    """Weight and Archimedes force of the flywheel in Es: (m g, b x g) less the displaced fluid's."""
    gm = body.local("g_mounting", (3,), comment="gravity in mounting axes")
    gs = body.local("g_s", (3,), comment="gravity in Es")
    assign(body, list(gm), derived_wrench.rotated_back(), {"C": m.axes, "a": g})
    six: list[Expr] = [*gm, real(0), real(0), real(0)]
    assign(body, list(gs), derived.turned_twist()[:3, :], phase | {"U": six})
    buoyant = lib.layout.flywheel_displaces
    bound: dict[str, Any] = {"g": gs, "m": m.mass, "mu": m.first_moment}
    if buoyant:
        bound |= {"weight_mass": m.mass - m.displaced_mass, "displaced_moment": m.displaced_moment}
    part("weight", "lower").subtract_weight(body, buoyant, bound, W)


def mounts(lib: Library) -> Function:
    """Wrenches of the mounts on all flywheels."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    mounting = Argument("mounting", layout.mount_table, purpose="made once by prepare_mounts")
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="derivative of the components of V")
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.flywheel_wrench_arguments()
    purpose = (
        "of the mount on each flywheel, six numbers each, about Os in the axes of Es at phi = 0; the fourth is tau"
    )
    out = Argument("mount_wrench", Kind.REAL, (6 * int(layout.count),), "out", "N, N m", purpose)
    body = Body()
    check_inputs(lib, body, table, x, phi_ddot, wrench)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    seen = scene(lib, body, table.place, x.place)
    moving = relative_rate(body, x.place, V_dot.place, seen.stream)
    flywheel_wrenches(lib, body, table.place, x.place, seen, wrench)
    W = body.local("W", (6,))
    with body.loop("s", layout.count) as s:
        for k in range(6):
            body.set(W[k], real(0) if seen.own is None else -seen.own[s * integer(6) + k])
        turn = turn_of(seen.turns, s)
        named: dict[str, Any] = {
            "mount": mounting.place.flywheel[s],
            **turn,
            "phi_dot": x.place.phi_dot[s],
            "V": seen.V,
            "W": W,
        }
        named |= {"phi_ddot": phi_ddot[0].place[s], "V_dot": moving, "g": seen.g}
        body.call(lib["mount_wrench"], *lib.arguments_of("mount_wrench", **named))
        with body.loop("j", 6) as j:
            body.set(out.place[s * integer(6) + j], W[j])
    return body.checked_function(
        "mounts",
        "Wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure.",
        (table, mounting, x, V_dot, *phi_ddot, *wrench, out),
        statuses=STATE_STATUSES,
        public=True,
    )


def prepare_mounts(lib: Library) -> Function:
    """The table of mounts."""
    layout = lib.layout
    parameters = Argument("parameters", layout.parameters, purpose="masses, inertias, mountings")
    mounting = Argument("mounting", layout.mount_table, (), "out", purpose="table for the function mounts")
    p, body = parameters.place, Body()
    lib.check(body, "check_parameters", p)
    with body.loop("s", layout.count) as s:
        w, m = p.flywheel[s], mounting.place.flywheel[s]
        body.set(m.mass, w.body.mass)
        for i in range(3):
            body.set(m.first_moment[i], w.body.mass * w.body.center_of_mass[i])
        body.copy_array(m.inertia, w.body.inertia)
        named = {"parameters": p, "w": w, "O": m.origin, "R": m.axes}
        body.call(lib["place_flywheel"], *lib.arguments_of("place_flywheel", **named))
        if layout.flywheel_displaces:
            body.set(m.displaced_mass, w.body.displaced_mass)
            for i in range(3):
                body.set(m.displaced_moment[i], w.body.displaced_mass * w.body.displaced_center[i])
    return body.checked_function(
        "prepare_mounts",
        "Makes the second table, which the function mounts needs.",
        (parameters, mounting),
        statuses=lib["check_parameters"].statuses,
        public=True,
    )
