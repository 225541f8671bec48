"""The total external wrench F of (7) in E1 about O1, with those kinds only that the stand has."""

from __future__ import annotations

from typing import Any

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.formula.derived import carrying as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower.checks import check_number
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.layout import run_time_inputs
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Expr, Status
from mahovik.core.program.kernel import OK, Reals, argument, body, changed, inline, reals, result
from mahovik.core.program.vector import Vector, cross


def add_laws(lib: Library) -> None:
    """Adds the functions of the laws that the stand has."""
    for body_law in parts("program", BodyProgram, BODY_LAWS):
        if body_law.bodies(lib.layout.structure):
            body_law.add_functions(lib)
    if lib.layout.local_bodies:
        add_own_wrench(lib)
    for law in lib.layout.law_tables:
        law.add_functions(lib)


def add_external(lib: Library, rows: tuple[int, ...] = tuple(range(6))) -> None:
    """Adds F of (7) from checked inputs; `rows`: `external_along`, as far as these components of it need."""
    layout, along = lib.layout, len(rows) < 6
    laws, checked = layout.law_tables, "check_actuators" in lib
    refuses = any(law.refuses for law in laws)
    own_wrenches_of_all: Any = result(
        "wrenches of the flywheels of their own, six numbers each, in Es about Os", 6 * int(layout.count), unit="N, N m"
    )
    kinds = [*layout.body_laws, *(law.words for law in laws), *(["run-time wrenches"] if layout.inputs else [])]
    purpose = f"Total external wrench of {', '.join(kinds) or 'no kind at all'}, from checked inputs"

    @lib.kernel(
        "external_along" if along else "external",
        equation="(7)",
        statuses=("OK", "NOT_FINITE", "RANGE") if checked else ("OK", "RANGE") if refuses else (),
        purpose=f"{purpose}; right are F[i], i = {', '.join(map(str, rows))}, alone." if along else f"{purpose}.",
    )
    def external(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        sum_: Any = argument("their mu gives the moment of the weight", struct=layout.sums),
        C: Any = argument("attitude of the carrier", 9),
        V: Reals = argument("twist relative to the fluid", 6),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        wrench: Any = lib.wrench,
        F: Any = result("in E1 about O1", 6, unit="N, N m"),
        own: Any = own_wrenches_of_all,
    ) -> Any:
        """Total external wrench."""
        if checked:
            lib["check_actuators"](table)
        if not (layout.held and layout.weight):
            F[:] = [0] * 6
        if layout.weight:
            weigh(lib, table, (sine, cosine), sum_, g, F, rows)
        if layout.carrier_damped:
            damp(lib, table, table.damper, V, F)
        if 0 in layout.structure.wrench_inputs:
            F += wrench[0:6]
        if layout.local_bodies:
            local_wrenches(lib, table, x, (sine, cosine), V, wrench, F, own)
        for law in laws:
            law.act(lib, table, x, C, F, along=along)


@inline
def local_wrenches(lib: Library, table: Any, x: Any, turns: Any, V: Reals, wrench: Any, F: Reals, own: Any) -> None:
    """Adds the wrenches of all bodies that have some in their own frame to F; of the flywheels also to `own`."""
    if lib.layout.local_turning:
        for i in range(6 * int(lib.layout.count)):
            own[i] = 0
    for k in range(len(lib.layout.local_bodies)):
        lib["own_wrench"](table, table.frame[k], x, *turns, V, wrench, F, own)


@inline
def flywheel_wrenches(lib: Library, table: Any, x: Any, seen: Any, wrench: Any) -> None:
    """Set the flywheels' own wrenches in `seen`, where they have such; `wrench`: `flywheel_wrench`."""
    if seen.own is not None:
        scratch = reals(6)  # wrench on the carrier, not used here
        scratch[:] = [0] * 6
        run_time = wrench
        if lib.layout.local_inputs and run_time is None:
            none = reals(6 * len(lib.layout.inputs))  # wrenches on bodies that are no flywheels
            for i in range(len(none)):
                none[i] = 0
            run_time = none
        local_wrenches(lib, table, x, seen.turns, seen.V_r, run_time, scratch, seen.own)


@inline
def weigh(lib: Library, table: Any, turns: Any, sums: Any, g: Reals, F: Reals, rows: Any) -> None:
    """Weight of every body at its mass centre, less the Archimedes force; of a held carrier F begins with it."""
    layout = lib.layout
    numbers = {"g": g, "mu": sums.mu, "m": table.mass}
    if layout.displaces:
        numbers = numbers | {"weight_mass": table.weight_mass, "displaced_moment": table.displaced_moment}
    if layout.flywheel_displaces:
        displaced: Reals = table.displaced_moment  # first moment of displaced fluid at the phases
        for s in range(layout.count):
            row = table.flywheel[s]
            displaced += row.displaced_c * turns[1][s] + row.displaced_s * turns[0][s]
        numbers = numbers | {"displaced_moment": displaced}
    # weight of all bodies: its line of action moves with the flywheels
    if layout.held:
        F[:] = [x if i in rows else 0 for i, x in enumerate(formula(derived.weight(layout.displaces), **numbers))]
    else:
        F += formula(derived.weight(layout.displaces), **numbers)


def damp(lib: Library, table: Any, damper: Any, V: Any, P: Any) -> None:
    """Adds the damping of a body by its twist to P."""
    for law in parts("program", BodyProgram, BODY_LAWS):
        if law.function in lib:
            body().do(lib[law.function](*lib.arguments_of(law.function, table=table, damper=damper, V=V, P=P)))


def turned_axes(R: Any, c: Expr, s: Expr) -> Vector:
    """R C1(phi): axes of a flywheel in E1, nine numbers."""
    rows = [R[3 * i : 3 * i + 3] for i in range(3)]
    return Vector(x for a, b, d in rows for x in (a, b * c + d * s, d * c - b * s))


def add_own_wrench(lib: Library) -> None:
    """Adds the wrench of one instrument or flywheel that acts in its own frame."""
    layout = lib.layout
    own_result: Any = result(
        "wrenches of the flywheels of their own, six numbers each, in Es about Os", 6 * int(layout.count), unit="N, N m"
    )

    @lib.kernel(equation="(7)")
    def own_wrench(
        table: Any = lib.table,
        frame: Any = argument(struct=layout.frame),
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        V: Reals = argument("twist of the carrier relative to the fluid", 6),
        wrench: Any = lib.wrench,
        F: Reals = changed("in E1 about O1; this wrench is added to it", 6, unit="N, N m"),
        own: Any = own_result,
    ) -> None:
        """Adds the wrench that acts on one instrument or flywheel in its own frame."""
        axes = reals(9)  # axes of the body in E1
        P = reals(6)  # in the body's own frame
        axes[:] = frame.axes
        P[:] = [0] * 6
        if layout.local_turning and frame.flywheel >= 0:
            s = sine[frame.flywheel]
            c = cosine[frame.flywheel]
            axes[:] = turned_axes(frame.axes, c, s)
        if layout.local_damped:
            velocity = reals(3)  # of the body's origin, in E1
            twist = reals(6)  # of the body, in its own frame
            velocity[:] = -cross(frame.origin, V[3:6]) + V[0:3]
            twist[0:3] = axes.T @ velocity
            twist[3:6] = axes.T @ V[3:6]
            if layout.local_turning and frame.flywheel >= 0:
                twist[3] += x.phi_dot[frame.flywheel]  # L^T V + f phi_dot
            damp(lib, table, frame.damper, twist, P)
        if layout.local_inputs and frame.wrench >= 0:
            for i in range(6):
                P[i] += wrench[frame.wrench * 6 + i]
        if layout.local_turning and frame.flywheel >= 0:
            for i in range(6):
                own[frame.flywheel * 6 + i] = P[i]
        force = reals(3)  # in E1
        moment = reals(3)  # in E1, about the body's origin
        force[:] = axes @ P[0:3]
        moment[:] = axes @ P[3:6]
        F[0:3] += force
        F[3:6] += cross(frame.origin, force) + moment


def add_check_actuators(lib: Library) -> None:
    """Adds `check_actuators`, where the stand has such inputs: NOT_FINITE or RANGE where one is none or too large."""
    inputs = run_time_inputs(lib.layout.structure)
    if not inputs:
        return

    @lib.kernel(purpose=f"Are {', '.join(actuator.words for actuator in inputs)} finite and in their ranges?")
    def check_actuators(table: Any = lib.table) -> Status:
        """Are inputs of laws in their ranges?"""
        for actuator in inputs:
            for k in range(actuator.count):
                check_number(lib, table.member(actuator.array)[k].member(actuator.member), lib.limit(actuator.limit))
        return OK
