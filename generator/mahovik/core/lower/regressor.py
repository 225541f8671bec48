"""regressor: what (8) and the drive torques take of each mass, first moment and moment of inertia."""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import point as derived_point
from mahovik.core.formula.derived import regressor as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.flywheels import turn_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, relative_rate, scene
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, magnitude
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def add_all(lib: Library) -> None:
    """Add the function with its internal ones."""
    lib.add(body_columns())
    if lib.layout.added_mass:
        lib.add(added_mass_columns())
    lib.add(proper_acceleration(lib))
    if lib.layout.flywheels:
        lib.add(flywheel_columns(lib))
    lib.add(regressor(lib))


def body_columns() -> Function:
    """Columns of one body in its own frame."""
    d = Argument("d", Kind.REAL, (3,), purpose="proper acceleration of its origin")
    a = Argument("a", Kind.REAL, (3,), purpose="angular acceleration")
    w = Argument("w", Kind.REAL, (3,), purpose="angular velocity")
    Y = Argument("Y", Kind.REAL, (6, 10), "out", purpose="wrench by mass, first moment, J 11 22 33 12 13 23")
    body = Body()
    columns = derived.body_columns()
    for i in range(6):
        assign(body, list(Y.place[i]), columns[i, :], {"d": d.place, "a": a.place, "w": w.place})
    return body.function("body_columns", "Wrench of one body by its ten parameters, in its own frame.", (d, a, w, Y))


def added_mass_columns() -> Function:
    """Columns of the added mass."""
    V = Argument("V", Kind.REAL, (6,), purpose="relative to the stream")
    V_dot = Argument("V_dot", Kind.REAL, (6,), purpose="likewise")
    Y = Argument("Y", Kind.REAL, (6, 21), "out", purpose="wrench by the upper half of the added mass, row by row")
    body = Body()
    columns = derived.added_mass_columns()
    own, rate = list(V.place), list(V_dot.place)
    bound = {"v": own[:3], "w": own[3:], "d": rate[:3], "a": rate[3:]}
    for i in range(6):
        assign(body, list(Y.place[i]), columns[i, :], bound)
    return body.function("added_mass_columns", "Wrench by the 21 numbers of the added mass.", (V, V_dot, Y))


def proper_acceleration(lib: Library) -> Function:
    """Acceleration of a point of the carrier, less gravity."""
    O = Argument("O", Kind.REAL, (3,), purpose="the point, in E1")
    V = Argument("V", Kind.REAL, (6,))
    V_dot = Argument("V_dot", Kind.REAL, (6,))
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    d = Argument("d", Kind.REAL, (3,), "out", purpose="in E1")
    body = Body()
    rates = list(V_dot.place)
    bound: dict[str, Any] = parts_of_twist(V.place) | {"O": O.place, "v_dot": rates[:3], "omega_dot": rates[3:]}
    velocity = body.local("velocity", (3,))
    assign(body, list(velocity), derived_wrench.twist_at(), bound)
    assign(
        body,
        list(d.place),
        derived_point.specific_force(lib.layout.weight),
        bound | {"velocity": velocity, "g": g.place},
    )
    return body.function("proper_acceleration", "Acceleration of a point of E1, less gravity.", (O, V, V_dot, g, d))


def flywheel_arguments(lib: Library) -> tuple[Argument, ...]:
    """What columns of a flywheel depend on: its mount, its phase and rates, motion of the carrier, gravity."""
    return (
        Argument("mount", lib.layout.mount),
        Argument("s", Kind.REAL, purpose="sin phi"),
        Argument("c", Kind.REAL, purpose="cos phi"),
        Argument("phi_dot", Kind.REAL, unit="rad/s"),
        Argument("phi_ddot", Kind.REAL, unit="rad/s2"),
        Argument("V", Kind.REAL, (6,)),
        Argument("V_dot", Kind.REAL, (6,)),
        Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1"),
    )


def flywheel_columns(lib: Library) -> Function:
    """Columns of one flywheel: on the carrier, and on its own drive."""
    mount, s, c, phi_dot, phi_ddot, V, V_dot, g = flywheel_arguments(lib)
    Y = Argument("Y", Kind.REAL, (6, 10), "out", purpose="in E1 about O1")
    drive = Argument("drive", Kind.REAL, (10,), "out", purpose="of its drive torque")
    body = Body()
    m = mount.place
    N = body.local("N", (9,), comment="its axes in E1")
    assign(body, list(N), derived.turned_axes(), {"R": m.axes, "c": c.place, "s": s.place})
    d = _proper(lib, body, m.origin, V.place, V_dot.place, g.place)
    own = {name: body.local(f"{name}_s", (3,), comment=text) for name, text in _OWN.items()}
    turned = {name: body.local(f"{name}_turned", (3,)) for name in ("w", "a")}
    back = derived_wrench.rotated_back()
    assign(body, list(own["d"]), back, {"C": N, "a": d})
    assign(body, list(turned["w"]), back, {"C": N, "a": list(V.place)[3:]})
    assign(body, list(turned["a"]), back, {"C": N, "a": list(V_dot.place)[3:]})
    bound: dict[str, Any] = {**turned, "phi_dot": phi_dot.place, "phi_ddot": phi_ddot.place}
    assign(body, list(own["w"]), derived.flywheel_velocity(), bound)
    assign(body, list(own["a"]), derived.flywheel_acceleration(), bound)
    inside = body.local("inside", (6, 10), comment="in Es")
    body.call(lib["body_columns"], own["d"], own["a"], own["w"], inside)
    forward, moment = derived_wrench.rotated(), derived_wrench.moment_of_force()
    with body.loop("k", 10) as k:
        column = [inside[i][k] for i in range(6)]
        out = [Y.place[i][k] for i in range(6)]
        assign(body, out[:3], forward, {"C": N, "a": column[:3]})
        assign(body, out[3:], forward, {"C": N, "a": column[3:]})
        assign(body, out[3:], moment, {"O": m.origin, "f": out[:3]}, add=True)
        body.set(drive.place[k], column[3])
    return body.function(
        "flywheel_columns",
        "Wrench on the carrier and drive torque by the ten parameters of one flywheel.",
        (mount, s, c, phi_dot, phi_ddot, V, V_dot, g, Y, drive),
    )


_OWN = {"d": "in Es: proper acceleration of Os", "a": "angular acceleration", "w": "angular velocity"}


def _proper(lib: Library, body: Body, O: Place, V: Place, V_dot: Place, g: Place) -> Place:
    d = body.local("d", (3,), comment="proper acceleration of its origin, in E1")
    named = {"O": O, "V": V, "V_dot": V_dot, "g": g, "d": d}
    body.call(lib["proper_acceleration"], *lib.arguments_of("proper_acceleration", **named))
    return d


def regressor(lib: Library) -> Function:
    """All columns at a state and a motion."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    mounting = Argument("mounting", layout.mount_table, purpose="made once by prepare_mounts; only its places are used")
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="derivative of the components of V")
    phi_ddot = lib.phi_ddot_arguments()
    out = Argument("out", layout.regressor_result, (), "out", purpose="columns")
    body = Body()
    check_inputs(lib, body, table, x, phi_ddot)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    seen = scene(lib, body, table.place, x.place)
    result = out.place
    _carrier(lib, body, x.place.V, V_dot.place, seen.g, result)
    relative = relative_rate(body, x.place, V_dot.place, seen.stream)
    if layout.added_mass:
        body.call(lib["added_mass_columns"], seen.V, relative, result.Y_added_mass)
    for i in range(6):
        body.set(result.Y_linear[i], seen.V[i])
        body.set(result.Y_quadratic[i], seen.V[i] * magnitude(seen.V[i]))
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            named: dict[str, Any] = {
                "mount": mounting.place.flywheel[s],
                **turn_of(seen.turns, s),
                "phi_dot": x.place.phi_dot[s],
                "phi_ddot": phi_ddot[0].place[s],
                "V": x.place.V,
                "V_dot": V_dot.place,
                "g": seen.g,
                "Y": result.Y_flywheel[s],
                "drive": result.Y_drive[s],
            }
            body.call(lib["flywheel_columns"], *lib.arguments_of("flywheel_columns", **named))
    return body.checked_function(
        "regressor",
        "What (8) and the drive torques take of each mass, first moment and moment of inertia: they are linear in all.",
        (table, *((mounting,) if layout.flywheels else ()), x, V_dot, *phi_ddot, out),
        statuses=STATE_STATUSES,
        notes=(
            "The sum of columns times parameters is F of the laws that have no columns, and tau plus what these laws "
            "do about the spin axis. The carrier's columns are those of all that is fixed in E1, instruments among it.",
        ),
        public=True,
    )


def _carrier(lib: Library, body: Body, V: Place, V_dot: Place, g: Place | None, result: Place) -> None:
    """Columns of the carrier: its frame is E1, and its origin O1."""
    d = body.local("d", (3,), comment="proper acceleration of O1")
    rates = list(V_dot)
    bound: dict[str, Any] = parts_of_twist(V) | {"v_dot": rates[:3], "g": g}
    assign(body, list(d), derived.origin_acceleration(lib.layout.weight), bound)
    a, w = (body.local(name, (3,)) for name in ("a", "w"))
    for i in range(3):
        body.set(a[i], rates[3 + i])
        body.set(w[i], V[3 + i])
    body.call(lib["body_columns"], d, a, w, result.Y_carrier)
