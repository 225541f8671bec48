"""mounts: the whole wrench of the mount on each flywheel, and the table that it needs beside the stand's."""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import carrying as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, scene
from mahovik.core.lower.library import Library
from mahovik.core.lower.wrenches import flywheel_wrenches
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import OK, Reals, argument, body, changed, inline, kernel, reals, result
from mahovik.core.program.vector import cross, symmetric


def turned_twist(U: Any, c: Any, s: Any) -> list[Any]:
    """[C1]^T of six numbers: from the axes at phi = 0 to those of the flywheel, which turn."""
    return [x for a, b, d in (U[0:3], U[3:6]) for x in (a, b * c + d * s, d * c - b * s)]


@inline
def subtract_weight(lib: Library, mount: Any, s: Any, c: Any, g: Any, W: Any) -> None:
    """Weight and Archimedes force of the flywheel in Es: (m g, b x g) less the displaced fluid's."""
    g_mounting = reals(3)  # gravity in mounting axes
    g_s = reals(3)  # gravity in Es
    g_mounting[:] = mount.axes.T @ g
    g_s[:] = turned_twist([*g_mounting, *g_mounting], c, s)[0:3]
    numbers = {"g": g_s, "m": mount.mass, "mu": mount.first_moment}
    if lib.layout.flywheel_displaces:
        displaced = {"weight_mass": mount.mass - mount.displaced_mass, "displaced_moment": mount.displaced_moment}
        numbers = numbers | displaced
    W += formula(derived.weight_reaction(lib.layout.flywheel_displaces), **numbers)


def add_mounts(lib: Library) -> None:
    """Adds the wrench of the mount on one flywheel, and those on all."""
    layout = lib.layout

    @lib.kernel()
    def carry_twist(
        mount: Any = argument(struct=layout.mount),
        V: Reals = argument("", 6),
        U: Reals = result("in mounting axes at Os", 6),
    ) -> None:
        """L^T V: a twist carried to Os, in mounting axes."""
        velocity: Reals = -cross(mount.origin, V[3:6]) + V[0:3]  # velocity of Os
        U[0:3] = mount.axes.T @ velocity
        U[3:6] = mount.axes.T @ V[3:6]

    @lib.kernel()
    def mount_wrench(
        mount: Any = argument(struct=layout.mount),
        s: float = argument("sin phi"),
        c: float = argument("cos phi"),
        phi_dot: float = argument(unit="rad/s"),
        phi_ddot: float = argument(unit="rad/s2"),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("", 6),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        W: Reals = changed(
            "in: -P_s, its own external wrench, in Es; out: wrench of the mount, in mounting axes about Os",
            6,
            unit="N, N m",
        ),
    ) -> None:
        """Wrench of the mount on one flywheel: diag(C1, C1) (Theta V_s_dot + Phi(V_s) Z_s - P_s)."""
        m, b, J = mount.mass, mount.first_moment, mount.inertia
        U = reals(6)  # twist of the mount at Os
        turned = reals(6)  # in Es
        turned_dot = reals(6)
        V_s = reals(6)  # twist of the flywheel, in Es
        V_s_dot = reals(6)
        Z_s = reals(6)  # its momentum screw
        carry_twist(mount, V, U)
        turned[:] = turned_twist(U, c, s)
        carry_twist(mount, V_dot, U)
        turned_dot[:] = turned_twist(U, c, s)
        V_s[:] = [*turned[0:3], turned[3] + phi_dot, *turned[4:6]]
        V_s_dot[0] = turned_dot[0]
        V_s_dot[1] = phi_dot * turned[2] + turned_dot[1]
        V_s_dot[2] = turned_dot[2] - phi_dot * turned[1]
        V_s_dot[3] = phi_ddot + turned_dot[3]
        V_s_dot[4] = phi_dot * turned[5] + turned_dot[4]
        V_s_dot[5] = turned_dot[5] - phi_dot * turned[4]
        v, omega, v_dot, omega_dot, p, h = V_s[0:3], V_s[3:6], V_s_dot[0:3], V_s_dot[3:6], Z_s[0:3], Z_s[3:6]
        Z_s[0:3] = v * m + cross(omega, b)
        Z_s[3:6] = symmetric(J) @ omega - cross(v, b)
        W[0:3] += cross(omega, p) + v_dot * m + cross(omega_dot, b)
        W[3:6] += symmetric(J) @ omega_dot + cross(v, p) + cross(omega, h) - cross(v_dot, b)
        if layout.weight:
            subtract_weight(lib, mount, s, c, g, W)
        in_Es: Reals = W  # in Es
        W[:] = [x for a, b, d in (in_Es[0:3], in_Es[3:6]) for x in (a, b * c - d * s, b * s + d * c)]

    purpose = (
        "of the mount on each flywheel, six numbers each, about Os in the axes of Es at phi = 0; the fourth is tau"
    )

    @lib.kernel(statuses=STATE_STATUSES, public=True)
    def mounts(
        table: Any = lib.table,
        mounting: Any = argument("made once by prepare_mounts", struct=layout.mount_table),
        x: Any = lib.x,
        V_dot: Reals = argument("derivative of the components of V", 6, unit="m/s2, rad/s2"),
        phi_ddot: Reals = lib.phi_ddot,
        wrench: Any = lib.flywheel_wrench,
        mount_wrench: Any = result(purpose, 6 * int(layout.count), unit="N, N m"),
    ) -> Status:
        """Wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure."""
        check_inputs(lib, table, x, phi_ddot, wrench)
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        seen = scene(lib, table, x)
        flywheel_wrenches(lib, table, x, seen, wrench)
        W = reals(6)
        sine, cosine = seen.turns
        for s in range(layout.count):
            W[:] = [0 if seen.own is None else -seen.own[s * 6 + k] for k in range(6)]
            lib["mount_wrench"](
                mounting.flywheel[s], sine[s], cosine[s], x.phi_dot[s], phi_ddot[s], x.V, V_dot, seen.g, W
            )
            for j in range(6):
                mount_wrench[s * 6 + j] = W[j]
        return OK


def prepare_mounts(lib: Library) -> Function:
    """The table of mounts."""
    layout = lib.layout

    @kernel(statuses=lib["check_parameters"].statuses, public=True)
    def prepare_mounts(
        parameters: Any = argument("masses, inertias, mountings", struct=layout.parameters),
        mounting: Any = result("table for the function mounts", struct=layout.mount_table),
    ) -> Status:
        """Makes the second table, which the function mounts needs."""
        lib["check_parameters"](parameters)
        for s in range(layout.count):
            w, m = parameters.flywheel[s], mounting.flywheel[s]
            m.mass = w.body.mass
            m.first_moment[:] = w.body.mass * w.body.center_of_mass
            m.inertia[:] = w.body.inertia
            body().do(lib["place_flywheel"](parameters, w, m.origin, m.axes))  # its inputs have been checked
            if layout.flywheel_displaces:
                m.displaced_mass = w.body.displaced_mass
                m.displaced_moment[:] = w.body.displaced_mass * w.body.displaced_center
        return OK

    return prepare_mounts
