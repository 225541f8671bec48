"""Parts of the Jacobians: derivatives of the wrenches by the twist, and of one flywheel's part by its phase."""

from __future__ import annotations

from typing import Any

from mahovik.contract.laws import of_bodies
from mahovik.core.derive.order import WEIGHTS
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import sensitivity as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.flywheels import columns_of, sine_and_cosine
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def own_slope(lib: Library) -> Function:
    """Change of one body's own wrench with the carrier's twist, and with its own phase and speed."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    frame = Argument("frame", layout.frame)
    V = Argument("V", Kind.REAL, (6,), purpose="twist of the carrier relative to the fluid")
    V_change = Argument("V_change", Kind.REAL, (6,), purpose="change of that twist")
    turn_by = Argument("turn_by", Kind.REAL, purpose="change of its phase")
    speed_by = Argument("speed_by", Kind.REAL, purpose="change of its speed")
    wrench = lib.wrench_arguments()
    F = Argument("F", Kind.REAL, (6,), "out", purpose="change of its wrench, in E1 about O1")
    axial = Argument("axial", Kind.REAL, (1,), "out", purpose="change of its moment about the spin axis")
    body = Body()
    axes = body.local("axes", (9,), comment="axes of the body in E1")
    twist = body.local("twist", (6,), comment="of the body, in its own frame")
    change = body.local("change", (6,), comment="of that twist")
    P = body.local("P", (6,), comment="own wrench, in its own frame")
    P_change = body.local("P_change", (6,))
    body.copy_array(axes, frame.place.axes)
    if layout.own_turning:
        with body.when(frame.place.flywheel >= 0):
            turn = sine_and_cosine(lib, body, x.place.phi[frame.place.flywheel])
            assign(body, list(axes), derived_wrench.turned_axes(), turn | {"R": frame.place.axes})
    for element in (*P, *P_change):
        body.set(element, real(0))
    _to_body(body, axes, frame.place.origin, V.place, twist, "velocity")
    _to_body(body, axes, frame.place.origin, V_change.place, change, "velocity_change")
    if layout.own_turning:
        with body.when(frame.place.flywheel >= 0):
            body.note("- [<e>] L^T V: the axes turn with the phase")
            for first, second in ((1, 2), (4, 5)):
                body.add(change[first], turn_by.place * twist[second])
                body.add(change[second], -(turn_by.place * twist[first]))
            body.add(twist[3], x.place.phi_dot[frame.place.flywheel], "L^T V + f phi'")
            body.add(change[3], speed_by.place)
    if layout.own_damped:
        named = {"table": table.place, "damper": frame.place.damper, "V": twist, "P": P}
        slopes = named | {"change": change, "P": P_change}
        for name, slope in of_bodies("lower", "BY_TWIST"):
            if name in lib:
                body.call(lib[name], *lib.arguments_of(name, **named))
                body.call(lib[slope], *lib.arguments_of(slope, **slopes))
    if layout.own_inputs:
        with body.when(frame.place.wrench >= 0), body.loop("i", 6) as i:
            body.add(P[i], wrench[0].place[frame.place.wrench * integer(6) + i])
    body.set(axial.place[0], P_change[3])
    if layout.own_turning:
        body.note("[<e>] P: the wrench turns with the phase")
        for first, second in ((1, 2), (4, 5)):
            body.add(P_change[first], -(turn_by.place * P[second]))
            body.add(P_change[second], turn_by.place * P[first])
    six = list(F.place)
    rotated = derived_wrench.rotated()
    assign(body, six[:3], rotated, {"C": axes, "a": list(P_change)[:3]})
    moment = body.local("moment", (3,))
    assign(body, list(moment), rotated, {"C": axes, "a": list(P_change)[3:]})
    arm = derived_wrench.moment_of_force()
    for k in range(3):
        bound = {"O": frame.place.origin, "f": six[:3]}
        body.set(six[3 + k], moment[k] + translate(arm[k], bound))
    return body.function(
        "own_slope",
        "Change of the own wrench of an instrument or flywheel with the carrier's twist and its own phase and speed.",
        (table, frame, x, V, V_change, turn_by, speed_by, *wrench, F, axial),
        equation="(7)",
    )


def _to_body(body: Body, axes: Place, origin: Place, V: Place, out: Place, name: str) -> None:
    """L^T V."""
    six = list(V)
    velocity = body.local(name, (3,), comment="of the body's origin, in E1")
    assign(body, list(velocity), derived_wrench.twist_at(), {"v": six[:3], "omega": six[3:], "O": origin})
    back = derived_wrench.rotated_back()
    assign(body, list(out)[:3], back, {"C": axes, "a": velocity})
    assign(body, list(out)[3:], back, {"C": axes, "a": six[3:]})


def row_slope(lib: Library) -> Function:
    """Change of F - Phi Z - K_dot V - (a, g) - K V* that a change of one row's weights makes."""
    layout = lib.layout
    row = Argument("row", layout.row)
    weights = Argument("weight", Kind.REAL, (len(WEIGHTS),), purpose="changes of " + ", ".join(WEIGHTS))
    V = Argument("V", Kind.REAL, (6,))
    V_dot = Argument("V_dot", Kind.REAL, (6,))
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    out = Argument("out", Kind.REAL, (6,), "out")
    body = Body()
    changed = body.local("change", (), layout.sums, "change of the sums")
    Z = body.local("Z", (6,), comment="change of the momentum screw")
    binding: dict[str, Any] = {name: weights.place[k] for k, name in enumerate(WEIGHTS)}
    binding |= columns_of(row.place)
    parts = derived_rows.sums()
    for field in layout.sums.fields:
        assign(body, list(changed.member(field.name)), getattr(parts, field.name), binding)
    z, rates = list(Z), list(V_dot.place)
    bound: dict[str, Any] = {f.name: changed.member(f.name) for f in layout.sums.fields}
    bound |= parts_of_twist(V.place) | {"p": z[:3], "h": z[3:], "v_dot": rates[:3], "omega_dot": rates[3:]}
    bound["g"] = g.place
    assign(body, z, derived.momentum(), bound)
    assign(body, list(out.place), derived.remainder(layout.weight), bound)
    if layout.flywheel_displaces:
        body.note("buoyancy is opposite to the weight")
        sunk = body.local("sunk", (3,))
        for i in range(3):
            c, s = binding["c"], binding["s"]
            body.set(sunk[i], row.place.displaced_c[i] * c + row.place.displaced_s[i] * s)
        arm = derived_wrench.moment_of_force()
        for k in range(3):
            body.add(out.place[3 + k], -translate(arm[k], {"O": sunk, "f": g.place}))
    return body.function(
        "row_slope",
        "Change of F - Phi Z - K* V - (a, g) - K V* with the harmonic weights of one flywheel.",
        (row, weights, V, V_dot, g, out),
        equation="(8)",
    )


def set_weights(body: Body, changes: Place, by: dict[str, Any], given: dict[str, Expr]) -> None:
    """Changes of the weights into an array, in the order of WEIGHTS."""
    assign(body, list(changes), [by[name] for name in WEIGHTS], given)


def twist_slope(lib: Library) -> Function:
    """d(F - Phi Z - K_dot V)/dV: 6 x 6, row by row."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V = Argument("V", Kind.REAL, (6,), purpose="twist relative to the fluid")
    Z = Argument("Z", Kind.REAL, (6,))
    m = Argument("m", layout.matrices, purpose="its M = Phi K + K_dot")
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    wrench = lib.wrench_arguments()
    out = Argument("slope", Kind.REAL, (36,), "out", purpose="row by row")
    axial = Argument(
        "axial",
        Kind.REAL,
        (6 * max(1, int(layout.count)),),
        "out",
        purpose="derivatives of the flywheels' own axial moments, flywheel by flywheel",
    )
    body = Body()
    z = list(Z.place)
    assign(body, list(out.place), derived.momentum_by_twist(), {"p": z[:3], "h": z[3:]})
    with body.loop("i", 6) as i, body.loop("j", 6) as j:
        body.add(out.place[i * integer(6) + j], -m.place.M[i][j])
    if layout.own_turning:
        with body.loop("i", 6 * int(layout.count)) as i:
            body.set(axial.place[i], real(0))
    for law in lib.layout.law_tables:
        law.constant_slope(lib, body, table.place, out.place)
    if layout.carrier_damped or layout.own_damped or any(law.per_twist for law in lib.layout.law_tables):
        with body.loop("j", 6) as j:
            change = body.local("change", (6,), comment="unit twist")
            F = body.local("F", (6,), comment="change of the wrench")
            with body.loop("i", 6) as i:
                body.set(change[i], real(0))
                body.set(F[i], real(0))
            body.set(change[j], real(1))
            everything: dict[str, Any] = {"table": table.place, "x": x.place, "V": V.place, "C": C.place, "F": F}
            everything |= {"change": change, "V_change": change, "turn_by": real(0), "speed_by": real(0)}
            everything |= {w.name: w.place for w in wrench}
            _add_slopes(lib, body, everything, axial.place, j)
            with body.loop("i", 6) as i:
                body.add(out.place[i * integer(6) + j], F[i])
    return body.function(
        "twist_slope",
        "Derivative of F - Phi Z - K* V by the twist.",
        (table, x, V, Z, m, C, *wrench, out, axial),
        equation="(8)",
    )


def _add_slopes(lib: Library, body: Body, everything: dict[str, Any], axial: Place, j: Place) -> None:
    """Adds the changes of all wrenches with one unit twist to F."""
    layout, table, F = lib.layout, everything["table"], everything["F"]
    if layout.carrier_damped:
        named = everything | {"damper": table.damper, "P": F}
        for _, slope in of_bodies("lower", "BY_TWIST"):
            if slope in lib:
                body.call(lib[slope], *lib.arguments_of(slope, **named))
    if layout.own_damped:
        with body.loop("k", len(layout.own)) as k:
            part = body.local("part", (6,))
            about = body.local("about", (1,))
            named = everything | {"frame": table.frame[k], "F": part, "axial": about}
            body.call(lib["own_slope"], *lib.arguments_of("own_slope", **named))
            with body.loop("i", 6) as i:
                body.add(F[i], part[i])
            if layout.own_turning:
                with body.when(table.frame[k].flywheel >= 0):
                    body.set(axial[table.frame[k].flywheel * integer(6) + j], about[0])
    for law in lib.layout.law_tables:
        law.slope(lib, body, table, everything["x"], everything["C"], everything["change"], F)
