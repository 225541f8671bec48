"""How each flywheel's drive torque depends on the motion: its column of I and its bias."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import drive as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.flywheels import columns_of, turn_of
from mahovik.core.lower.forward import Scene
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

_DOUBLE = {"two_c2": "twice the cosine and sine of the double phase", "two_s2": ""}


def couple(lib: Library) -> Function:
    """I_s, and the torque at V* = 0, phi'' = 0, of one flywheel.

    Common to all flywheels: origin_acceleration = omega x v - g (3), spun: products of omega (6).
    """
    row = Argument("row", lib.layout.row)
    s = Argument("s", Kind.REAL, purpose="sin phi")
    c = Argument("c", Kind.REAL, purpose="cos phi")
    alike = (
        Argument("origin_acceleration", Kind.REAL, (3,), unit="m/s2", purpose="omega x v, minus gravity"),
        Argument("spun", Kind.REAL, (6,), unit="rad2/s2", purpose="products of omega"),
        Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1"),
    )
    out = Argument("out", lib.layout.coupling, (), "out")
    column = list(out.place.I)
    body = Body()
    binding: dict[str, Any] = {"s": s.place, "c": c.place}
    for name in ("two_c2", "two_s2"):
        binding[name] = body.let(name, translate(derived_rows.weights()[name], binding), _DOUBLE[name])
    binding |= columns_of(row.place)
    assign(body, column, derived_rows.columns().I, binding)
    mu_p, J_p = derived.phase_derivatives()
    assert list(mu_p) == list(derived_rows.columns().I[:3])
    body.note("dJ / dphi")
    slope = [body.let(f"J_p{i + 1}", translate(value, binding)) for i, value in enumerate(J_p)]
    binding |= {"J_p": slope, "mu_p": column[:3], **{a.name: a.place for a in alike}}
    if lib.layout.flywheel_displaces:
        body.note("derivative of the displaced first moment")
        displaced_c, displaced_s = row.place.displaced_c, row.place.displaced_s
        slopes = (displaced_s[i] * c.place - displaced_c[i] * s.place for i in range(3))
        binding["displaced_p"] = [body.let(f"displaced_p{i + 1}", slope) for i, slope in enumerate(slopes)]
    body.set(out.place.bias, translate(derived.bias_torque(lib.layout.flywheel_displaces), binding))
    function = body.function(
        "couple",
        "Column of I of one flywheel, and its drive torque at V* = 0, phi'' = 0.",
        (row, s, c, *alike, out),
        equation="(9)",
    )
    return replace(function, copied=True)


@dataclass(frozen=True)
class Carried:
    """Quantities common to all flywheels: origin_acceleration = omega x v - g (3), spun: products of omega (6)."""

    origin_acceleration: Place
    spun: Place


def declare_common_terms(lib: Library, body: Body, seen: Scene) -> Carried:
    """Both, into locals."""
    origin_acceleration = body.local(
        "origin_acceleration",
        (3,),
        comment="acceleration of O1 at V* = 0, minus gravity" if lib.layout.weight else "omega x v",
    )
    bound = parts_of_twist(seen.V) | ({"g": seen.g} if seen.g is not None else {})
    assign(body, list(origin_acceleration), derived.origin_acceleration(lib.layout.weight), bound)
    spun = body.local("spun", (6,), comment="six numbers: J . spun = -omega . J omega / 2 for every inertia J")
    assign(body, list(spun), derived.spin_products(), bound)
    return Carried(origin_acceleration, spun)


def couple_flywheel(lib: Library, body: Body, table: Place, s: Place, seen: Scene, by: Carried, out: Place) -> None:
    """I_s and the bias torque of flywheel s into `out`."""
    named = {
        "row": table.flywheel[s],
        **turn_of(seen.turns, s),
        "origin_acceleration": by.origin_acceleration,
        "spun": by.spun,
        "g": seen.g,
        "out": out,
    }
    body.call(lib["couple"], *lib.arguments_of("couple", **named))


def along(column: Sequence[Expr], V_dot: Place | Sequence[Expr]) -> Expr:
    """I_s . V*."""
    return translate(derived_wrench.row_times(), {"row": column, "column": V_dot})
