"""How each flywheel's drive torque depends on the motion: its column of I and its bias, one by one or by blocks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import drive as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower import harmonics, lanes
from mahovik.core.lower.flywheels import COLUMNS, turn_of
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

_PURPOSE = "its drive torque at V* = 0, phi'' = 0."


def _couple(
    lib: Library,
    body: Body,
    turn: dict[str, Expr],
    columns: Mapping[str, Any],
    alike: Mapping[str, Any],
    column: Sequence[Place],
    bias: Place,
) -> None:
    """column = I_s, bias = the torque at V* = 0, phi'' = 0, of a row of these columns at s, c of `turn`."""
    binding = dict(turn)
    for name in ("two_c2", "two_s2"):
        binding[name] = body.let(name, translate(derived_rows.weights()[name], binding), _DOUBLE[name])
    everything: dict[str, Any] = {**binding, **columns}
    assign(body, column, derived_rows.columns().I, everything)
    mu_p, J_p = derived.phase_derivatives()
    assert list(mu_p) == list(derived_rows.columns().I[:3])
    body.note("dJ / dphi")
    slope = [body.let(f"J_p{i + 1}", translate(value, everything)) for i, value in enumerate(J_p)]
    everything |= {"J_p": slope, "mu_p": list(column)[:3], **alike}
    if lib.layout.flywheel_displaces:
        body.note("derivative of the displaced first moment")
        slopes = (columns["displaced_s"][i] * turn["c"] - columns["displaced_c"][i] * turn["s"] for i in range(3))
        everything["displaced_p"] = [body.let(f"displaced_p{i + 1}", slope) for i, slope in enumerate(slopes)]
    body.set(bias, translate(derived.bias_torque(lib.layout.flywheel_displaces), everything))


def _alike_arguments() -> tuple[Argument, ...]:
    """Quantities common to all flywheels: origin_acceleration = omega x v - g (3), spun: products of omega (6)."""
    return (
        Argument("origin_acceleration", Kind.REAL, (3,), unit="m/s2", purpose="omega x v, minus gravity"),
        Argument("spun", Kind.REAL, (6,), unit="rad2/s2", purpose="products of omega"),
        Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1"),
    )


def _columns(lib: Library) -> tuple[str, ...]:
    return (*COLUMNS, *(("displaced_c", "displaced_s") if lib.layout.flywheel_displaces else ()))


def couple(lib: Library) -> Function:
    """I_s and the bias torque of one flywheel."""
    row = Argument("row", lib.layout.row)
    s = Argument("s", Kind.REAL, purpose="sin phi")
    c = Argument("c", Kind.REAL, purpose="cos phi")
    alike = _alike_arguments()
    out = Argument("out", lib.layout.coupling, (), "out")
    body = Body()
    columns = {name: row.place.member(name) for name in _columns(lib)}
    turn: dict[str, Expr] = {"s": s.place, "c": c.place}
    _couple(lib, body, turn, columns, {a.name: a.place for a in alike}, list(out.place.I), out.place.bias)
    function = body.function(
        "couple", f"Column of I of one flywheel, and {_PURPOSE}", (row, s, c, *alike, out), equation="(9)"
    )
    return replace(function, copied=True)


def couple_block(lib: Library) -> Function:
    """I_s and the bias torques of a block."""
    out = Argument("out", lib.layout.lane_coupling, (), "out")
    shared = _block_arguments(lib)
    body = Body()
    with body.loop("k", lib.layout.lane_count) as k:
        _couple_lane(lib, body, shared, k, lanes.lane(out.place.I, k), out.place.bias[k])
    return body.function(
        "couple_block",
        f"Columns of I of a block of flywheels, and of each {_PURPOSE}",
        (*shared, out),
        equation="(9)",
    )


def balance_block(lib: Library) -> Function:
    """The drive torques of a block; for speed by harmonics, whose sums have other bits."""
    return _balance_by_harmonics(lib) if lib.layout.fast else _balance_by_columns(lib)


def _balance_by_columns(lib: Library) -> Function:
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2")
    phi_ddot = lanes.room_argument(lib, "phi_ddot", unit="rad/s2")
    total = lanes.room_argument(lib, "total", direction="out", unit="N m")
    shared = _block_arguments(lib)
    block, first = shared[0].place, shared[1].place
    body = Body()
    with body.loop("k", lib.layout.lane_count) as k:
        column, bias = body.local("column", (6,), comment="of I"), body.local("bias")
        _couple_lane(lib, body, shared, k, list(column), bias)
        spin = block.spin[k] * phi_ddot.place[first + k]
        body.set(total.place[first + k], along(list(column), V_dot.place) + spin + bias)
    return body.function(
        "balance_block",
        "Drive torques of a block of flywheels: I . V* + Theta_ff phi'' + bias.",
        (*shared, V_dot, phi_ddot, total),
    )


def _balance_by_harmonics(lib: Library) -> Function:
    acceleration = Argument("acceleration", Kind.REAL, (3,), unit="m/s2", purpose="of O1 in E1, minus gravity")
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2")
    phi_ddot = lanes.room_argument(lib, "phi_ddot", unit="rad/s2")
    total = lanes.room_argument(lib, "total", direction="out", unit="N m")
    block, first, sine, cosine, _, *alike = shared = _block_arguments(lib)
    body = Body()
    with body.loop("k", lib.layout.lane_count) as k:
        common = {"origin_acceleration": acceleration.place, "V_dot": V_dot.place, **{a.name: a.place for a in alike}}
        given = {**lanes.lane_columns(block.place, k, _columns(lib)), **common}
        of = _balance_by_harmonic(lib)
        body.note("what the harmonics multiply, and what none does: none of it waits for a sine")
        sums = {name: harmonics.add_up(of[name], given) for name in _HARMONICS}
        by = {name: body.let(f"by_{name}", value) for name, (_, value) in sums.items()}
        spin = block.place.spin[k] * phi_ddot.place[first.place + k]
        torque: Expr = body.let("constant", spin + harmonics.add_up(of[""], given)[1])
        turn: dict[str, Expr] = {
            "s": body.let("s", sine.place[first.place + k]),
            "c": body.let("c", cosine.place[first.place + k]),
        }
        for name in ("two_c2", "two_s2"):
            turn[name] = body.let(name, translate(derived_rows.weights()[name], turn), _DOUBLE[name])
        for name in reversed(_HARMONICS):
            part = by[name] * turn[name]
            torque = torque - part if sums[name][0] else torque + part
        body.set(total.place[first.place + k], torque)
    return body.function(
        "balance_block",
        "Drive torques of a block of flywheels: I . V* + Theta_ff phi'' + bias, each harmonic multiplied once.",
        (*shared[:4], acceleration, *alike, V_dot, phi_ddot, total),
    )


_HARMONICS = ("c", "s", "two_c2", "two_s2")


def _balance_by_harmonic(lib: Library) -> dict[str, list[harmonics.Term]]:
    """I . V* + bias, where the acceleration of O1 has v* already: it multiplies what v* does."""
    displaces = lib.layout.flywheel_displaces
    column = list(derived_rows.columns().I)
    mu_p, J_p = (list(slopes) for slopes in derived.phase_derivatives())
    assert mu_p == column[:3]
    inner = {
        f"{name}[{i}]": x
        for name, each in (("column", column), ("mu_p", mu_p), ("J_p", J_p))
        for i, x in enumerate(each)
    }
    if displaces:
        inner |= {
            f"displaced_p[{i}]": ("-", ("*", f"displaced_s[{i}]", "c"), ("*", f"displaced_c[{i}]", "s"))
            for i in range(3)
        }
    found = harmonics.by_harmonic(derived.bias_torque(displaces), inner, _HARMONICS)
    turning = harmonics.by_harmonic(derived_wrench.row_times("column", "V_dot"), inner, _HARMONICS)
    for name, products in turning.items():
        own = [term for term in products if not {"V_dot[0]", "V_dot[1]", "V_dot[2]"} & {*term[1]}]
        found[name] = own + found[name]
    return found


def _block_arguments(lib: Library) -> tuple[Argument, ...]:
    """Block, its first flywheel, sines and cosines, and what is common to all flywheels."""
    turns = lanes.room_argument(lib, "sine", "of the phases"), lanes.room_argument(lib, "cosine")
    return Argument("block", lib.layout.block), lanes.first_argument(), *turns, *_alike_arguments()


def _couple_lane(
    lib: Library, body: Body, shared: tuple[Argument, ...], k: Expr, column: Sequence[Place], bias: Place
) -> None:
    """I_s and the bias torque of lane k, for arguments of `_block_arguments`."""
    given = {a.name: a.place for a in shared}
    turn: dict[str, Expr] = {
        "s": body.let("s", given["sine"][given["first"] + k]),
        "c": body.let("c", given["cosine"][given["first"] + k]),
    }
    _couple(lib, body, turn, lanes.lane_columns(given["block"], k, _columns(lib)), given, column, bias)


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
    row = lanes.row_of(lib, body, table, s)
    named = {
        "row": row,
        **turn_of(seen.turns, s),
        "origin_acceleration": by.origin_acceleration,
        "spun": by.spun,
        "g": seen.g,
        "out": out,
    }
    body.call(lib["couple"], *lib.arguments_of("couple", **named))


def couple_blocks(
    lib: Library, body: Body, table: Place, b: Place, first: Expr, seen: Scene, by: Carried, out: Place
) -> None:
    """Couplings of block b."""
    body.call(
        lib["couple_block"], *lib.arguments_of("couple_block", out=out, **_bind_arguments(table, b, first, seen, by))
    )


def balance_blocks(
    lib: Library, body: Body, table: Place, seen: Scene, by: Carried, V_dot: Place, phi_ddot: Place, total: Place
) -> None:
    """Drive torques of all blocks, without those of the fluid."""
    common = {"V_dot": V_dot, "phi_ddot": phi_ddot, "total": total}
    if lib.layout.fast:
        about = "of O1, minus gravity" if lib.layout.weight else "of O1, in E1"
        acceleration = body.local("acceleration", (3,), comment=about)
        for i, target in enumerate(acceleration):
            body.set(target, by.origin_acceleration[i] + V_dot[i])
        common |= {"acceleration": acceleration}
    with lanes.blocks(lib, body) as (b, first):
        named = {**common, **_bind_arguments(table, b, first, seen, by)}
        body.call(lib["balance_block"], *lib.arguments_of("balance_block", **named))


def _bind_arguments(table: Place, b: Place, first: Expr, seen: Scene, by: Carried) -> dict[str, Any]:
    """Arguments of the functions of a block, by name."""
    sine, cosine = seen.turns
    named: dict[str, Any] = {"block": table.block[b], "first": first, "sine": sine, "cosine": cosine}
    return named | {"origin_acceleration": by.origin_acceleration, "spun": by.spun, "g": seen.g}


def along(column: Sequence[Expr], V_dot: Place | Sequence[Expr]) -> Expr:
    """I_s . V*."""
    return translate(derived_wrench.row_times("column", "V_dot"), {"column": column, "V_dot": V_dot})
