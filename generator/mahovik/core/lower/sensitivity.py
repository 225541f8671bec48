"""Parts of the Jacobians: derivatives of the wrenches by the twist, and of one flywheel's part by its phase."""

from __future__ import annotations

from typing import Any

from mahovik.core.derive.order import WEIGHTS
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import sensitivity as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.flywheels import columns_of, named_turns, places_of
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.tangent import Seed, Tangents
from mahovik.core.program.types import Kind


def add_tangents(lib: Library) -> None:
    """Derivatives of the wrench (7) by the twist, and of the flywheels' own wrenches by their phases and speeds."""
    tangents = Tangents(lib)
    if "external" in lib:
        inputs = [name for name in ("V", "x.V") if name.split(".")[0] in lib.taken("external")]
        if inputs:
            tangents.change("external", {"V": inputs})
    if lib.layout.own_turning:
        tangents.derivative("own_wrench", "phi", _turning(lib["own_wrench"]))
    if lib.layout.own_turning and lib.layout.own_damped:
        tangents.derivative("own_wrench", "phi_dot", {"x.phi_dot": lambda _: real(1)})


def _turning(function: Function) -> dict[str, Seed]:
    """Derivatives of sines and cosines by their phase."""
    places = {a.name: a.place for a in function.arguments}

    def of(name: str, place: Place) -> Place:
        (index,) = place.operands
        return places[name][index]

    return {"sine": lambda sine: of("cosine", sine), "cosine": lambda cosine: -of("sine", cosine)}


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
    turns, wrench = lib.turn_arguments(), lib.wrench_arguments()
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
    if "external_by_V" in lib and "d_F" in lib.taken("external_by_V"):
        with body.loop("j", 6) as j:
            change = body.local("change", (6,), comment="unit twist")
            F = body.local("F", (6,), comment="change of the wrench")
            own = body.local("own", (6 * max(1, int(layout.count)),), comment="and of the flywheels' own")
            with body.loop("i", 6) as i:
                body.set(change[i], real(0))
            body.set(change[j], real(1))
            named: dict[str, Any] = {"table": table.place, "x": x.place, "V": V.place, "C": C.place, "d_V": change}
            named |= named_turns(places_of(turns)) | {w.name: w.place for w in wrench} | {"d_F": F, "d_own": own}
            body.call(lib["external_by_V"], *lib.arguments_of("external_by_V", **named))
            with body.loop("i", 6) as i:
                body.add(out.place[i * integer(6) + j], F[i])
            if "d_own" in lib.taken("external_by_V"):
                with body.loop("s", layout.count) as s:
                    body.set(axial.place[s * integer(6) + j], own[s * integer(6) + 3])
    return body.function(
        "twist_slope",
        "Derivative of F - Phi Z - K* V by the twist.",
        (table, x, *turns, V, Z, m, C, *wrench, out, axial),
        equation="(8)",
    )
