"""The numbers of a stand as the program's data: parameters, and the table that `prepare` makes of them.

Everything that is not a plain copy goes through the interpreter with our own sincos and sqrt, so that the numbers
are the same on every machine and those that firmware computes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core import routines
from mahovik.core.derive import SYMMETRIC
from mahovik.core.formula.derived import carrying, formula
from mahovik.core.lower import stream
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.limits import thresholds
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.kernel import Reals, argument, kernel, local, result
from mahovik.core.program.types import DOUBLE, Field, Kind, Struct, leaves, member
from mahovik.core.stand.columns import Column
from mahovik.core.stand.hold import carried_point, twist_columns
from mahovik.core.stand.model import Body, Flywheel, MountingAngles, Point, Stand
from mahovik.core.stand.motor import UNLIMITED
from mahovik.errors import StandError


def conversions() -> Program:
    """What only the generator needs: axes of a mounting by angles, inertia about the origin; double in any case."""
    sincos = routines.sincos(DOUBLE)
    return Program("conversions", DOUBLE, (), (), (sincos, _axes_of_angles(sincos), _about_origin))


def _axes_of_angles(sincos: Function) -> Function:
    first, second = carrying.mounting_axes()

    @kernel()
    def axes_of_angles(
        angles: Reals = argument("", 3), axis: Reals = result("", 3), zero: Reals = result("", 3)
    ) -> None:
        """First and second column of C3(psi) C2(theta) C1(phi)."""
        known = dict[str, Any]()
        for i, name in enumerate(("psi", "theta", "phi")):
            known.update({part: local(part) for part in (f"s_{name}", f"c_{name}")})
            sincos(angles[i], known[f"s_{name}"], known[f"c_{name}"])
        axis[:] = formula(first, **known)
        zero[:] = formula(second, **known)

    return axes_of_angles


@kernel("about_origin")
def _about_origin(
    mass: float = argument(),
    rc: Reals = argument("", 3),
    central: Reals = argument("", 6),
    J: Reals = result("", 6),
) -> None:
    """J about the frame's origin from that about the centre of mass."""
    b: Reals = mass * rc
    J[:] = formula(carrying.central_to_origin(), J=central, b=b, rc=rc)


def parameters_of(stand: Stand, layout: Layout) -> dict[str, Any]:
    """Input of `prepare`: masses, inertias, mountings. Raises StandError where a number is out of range."""
    convert = Interpreter(conversions()).run
    instruments = [p.name for p in stand.instruments]

    def body_of(b: Body) -> dict[str, Any]:
        inertia = [b.inertia[i][j] for i, j in SYMMETRIC]
        if b.inertia_about == "center_of_mass":
            properties = {"mass": b.mass, "rc": b.center_of_mass, "central": inertia}
            inertia = convert("about_origin", properties)[1]["J"]
        numbers = {"mass": b.mass, "center_of_mass": list(b.center_of_mass), "inertia": inertia}
        dry = isinstance(b, Flywheel) and not layout.flywheel_displaces
        if layout.displaces and not dry:
            mass, center = next(iter(b.displaced), (0.0, (0.0, 0.0, 0.0)))
            numbers |= {"displaced_mass": mass, "displaced_center": list(center)}
        return numbers

    def axes_of(*angles: float) -> dict[str, Any]:
        return convert("axes_of_angles", {"angles": angles})[1]

    def mounted(part: Flywheel | Point) -> dict[str, int]:
        """Number of the instrument that it is mounted on, -1 for the carrier; nothing where there are none."""
        known = part.mount in instruments
        return {"mount": instruments.index(part.mount) if known else -1} if instruments else {}

    def flywheel(s: Flywheel) -> dict[str, Any]:
        at = s.mounting
        if isinstance(at, MountingAngles):
            axes = axes_of(at.psi, at.theta, at.zero)
        else:
            axes = {"axis": list(at.axis), "zero": list(at.zero)}
        return {"body": body_of(s), "position": list(s.position), **axes, **mounted(s)}

    numbers: dict[str, Any] = {"carrier": body_of(stand.carrier)}
    if layout.added_mass:
        of_bodies = (stand.carrier.added_mass, *(p.added_mass for p in stand.instruments))
        added = [matrix for matrix in of_bodies if matrix is not None]
        numbers["added_mass"] = [[sum(matrix[i][j] for matrix in added) for j in range(6)] for i in range(6)]
    if stand.instruments:
        numbers["instrument"] = [
            {"body": body_of(p), "position": list(p.position), **axes_of(*p.angles)} for p in stand.instruments
        ]
    if stand.flywheels:
        numbers["flywheel"] = list(map(flywheel, stand.flywheels))
    if stand.points:
        numbers["point"] = [{"position": list(p.position), **axes_of(*p.angles), **mounted(p)} for p in stand.points]
    _check_range(stand, layout, "parameters", numbers)
    return numbers


def _check_range(stand: Stand, layout: Layout, name: str, value: Any) -> None:
    """StandError where a number could make products overflow in the element type."""
    largest, precision = thresholds(layout.precision).table, layout.precision.name
    if isinstance(value, dict):
        for key, element in value.items():
            _check_range(stand, layout, f"{name}.{key}", element)
    elif isinstance(value, list | tuple):
        for number, element in enumerate(value):
            _check_range(stand, layout, f"{name}[{number}]", element)
    elif isinstance(value, float | Column) and not bool(abs(value) <= largest):
        raise StandError([f"stand {stand.name}: {name} is {value:.6g}, expected at most {largest:g} in {precision}"])


def laws_of(stand: Stand, layout: Layout, program: Interpreter) -> Any:
    """A table whose laws are filled in, the rest zero. Raises StandError where a number is out of range."""
    rows: dict[str, list[dict[str, Any]]] = {}

    def damper_of(body: Body) -> dict[str, Any]:
        """One damper; the rows that it has in arrays of the table are appended to `rows`, by name of the array."""
        members: dict[str, Any] = {}
        for law in parts("program", BodyProgram, BODY_LAWS):
            members |= law.damper_values(body, layout.damper, rows)
        return members

    table = program.new(layout.table)
    laws: dict[str, Any] = {}
    if layout.weight:
        laws["gravity"] = list(stand.gravity)
    if stand.stream is not None:
        laws["stream"] = list(stand.stream)
    if stand.profile is not None:
        laws[stream.NAME] = stream.values(stand.profile)
    if stand.hold is not None:
        pivot, sliding = carried_point(stand.hold)
        laws |= {"pivot": list(pivot), "sliding": [x for row in sliding for x in row]}
        if layout.freedoms:
            laws["S"] = [list(row) for row in zip(*twist_columns(stand.hold), strict=True)]
        if layout.coordinates:
            attitude = program.run("quaternion", {"angles": stand.hold.angles})[1]["attitude"]
            laws |= {"home_position": list(stand.hold.position), "home_attitude": attitude}
    if layout.carrier_damped:
        laws["damper"] = damper_of(stand.carrier)
    for k, local_body in enumerate(layout.local_bodies):
        frame = table.frame[k]
        for name, value in (
            ("flywheel", local_body.flywheel),
            ("instrument", local_body.instrument),
            ("wrench", local_body.input),
        ):
            if layout.frame.field(name) is not None:
                setattr(frame, name, value)
        if layout.local_damped:
            body = stand.bodies[local_body.index]
            damper = damper_of(body)
            _check_range(stand, layout, f"{body.name}.damping", damper)
            frame.damper = program.fill_storage(layout.damper, damper)
    laws |= rows
    for law in layout.law_tables:
        laws |= law.values(stand, program.run)
    for name, value in laws.items():
        field = layout.table.field(name)
        assert field is not None
        _check_range(stand, layout, name, value)
        setattr(table, name, program.fill_storage(field.type, value, field.shape))
    return table


class Values:
    """Parameters and table of one stand, from the interpreter of its program."""

    def __init__(self, stand: Stand, layout: Layout, program: Program) -> None:
        self._layout = layout
        self._stand = stand
        self.interpreter = Interpreter(program)
        self.parameters = parameters_of(stand, layout)
        self.table = self._table()
        self.mounting = self._mounting() if layout.flywheels else None
        self.options = self._options() if layout.flywheels else None

    def _table(self) -> dict[str, Any]:
        """prepare on the laws of the stand file. Raises StandError where it refuses the parameters."""
        inputs = {"parameters": self.parameters, "table": laws_of(self._stand, self._layout, self.interpreter)}
        status, outputs = self.interpreter.run("prepare", inputs)
        if status != STATUS_VALUES["OK"]:
            name = status_words(status)
            where = f"stand {self._stand.name}: its masses and inertias are refused by prepare"
            raise StandError([f"{where} in {self._layout.precision.name}: {name}"])
        table: dict[str, Any] = outputs["table"]
        return table

    def _options(self) -> dict[str, Any]:
        """Options of inverse by default: weights and motors of the stand file, no limits, no damping."""
        flywheels = self._stand.flywheels
        largest = self._layout.precision.largest
        return {
            "weight": [s.inverse_weight for s in flywheels],
            "limit": [largest] * len(flywheels),
            **_abilities(self._stand, largest),
            **_curves(self._stand, self._layout.motor_points, largest),
            "near_singular": thresholds(self._layout.precision).near_singular,
            "damping": 0.0,
            **{f"use_{task.name}": [1] * len(task.rows) for task in self._stand.tasks},
            **(_torque_options(len(flywheels), largest) if self._stand.tasks else {}),
        }

    def _mounting(self) -> dict[str, Any]:
        """prepare_mounts on the same parameters."""
        mounting: dict[str, Any] = self.interpreter.run("prepare_mounts", {"parameters": self.parameters})[1][
            "mounting"
        ]
        return mounting


def _abilities(stand: Stand, none: float) -> dict[str, list[float]]:
    """Options of inverse that say what each flywheel has; `none` stands for no limit.

    A flywheel whose motor has a torque or a speed is judged by these, any other by `inverse_most`.
    """
    motors = [s.motor if s.motor and s.motor.is_limited else None for s in stand.flywheels]
    return {
        "most": [stand.inverse_most if motor is None else none for motor in motors],
        "motor_torque": [none if motor is None or motor.torque is None else motor.torque for motor in motors],
        "motor_speed": [none if motor is None or motor.speed is None else motor.speed for motor in motors],
        "motor_viscous": [0.0 if motor is None else motor.viscous for motor in motors],
        "motor_coulomb": [0.0 if motor is None else motor.coulomb for motor in motors],
        "motor_coulomb_speed": [1.0 if motor is None else motor.coulomb_speed for motor in motors],
    }


def _curves(stand: Stand, points: int, none: float) -> dict[str, Any]:
    """Options of inverse with the curves of motors: one of fewer points ends with the last of them again and again."""
    motors = [s.motor or UNLIMITED for s in stand.flywheels]
    curves = [list(motor.limit) if motor.torque_speed else [(0.0, none)] for motor in motors]
    padded = [curve + curve[-1:] * (points - len(curve)) for curve in curves]
    names = ("motor_curve_speed", "motor_curve_torque") if points else ()
    return {name: [[point[i] for point in curve] for curve in padded] for i, name in enumerate(names)}


def _torque_options(count: int, none: float) -> dict[str, Any]:
    """Options of torque_for besides: no limit of power, least torque, least error."""
    return {
        "motor_power": [none] * count,
        "target_speed": [0.0] * count,
        "target_rate": 0.0,
        "avoid_speed": 0.0,
        "keep_direction": 0,
    }


_PLACED = ("origin", "axes")
"""Members of a frame that `prepare` computes."""


def law_struct(layout: Layout) -> Struct:
    """The members of a table that `prepare` leaves as they are: laws, and what its frames belong to."""
    kept: list[Field] = []
    frames = layout.table.field("frame")
    if frames is not None:
        assert isinstance(frames.type, Struct)
        inner = tuple(f for f in frames.type.fields if f.name not in _PLACED)
        kept.append(replace(frames, type=Struct(frames.type.name, frames.type.purpose, inner)))
    return Struct(layout.table.name, layout.table.purpose, (*kept, *layout.laws))


def reals(struct: Struct, value: Any) -> Iterator[Any]:
    """Every real of a struct, given as dicts or records, depth first."""
    return (x for kind, x in leaves(struct, (), value) if kind is Kind.REAL)


def columns(struct: Struct, value: Any, varied: Iterator[NDArray[Any] | None], n: int) -> dict[str, Any]:
    """The members of a struct by name, of n samples: arrays with the samples last, lists of structs.

    `value`: that of the first sample; `varied`: in the order of `reals`, the numbers of all samples, or None.
    """
    return {f.name: _columns(f.type, member(value, f.name), len(f.shape), varied, n) for f in struct.fields}


def _columns(type_: Kind | Struct, value: Any, depth: int, varied: Iterator[NDArray[Any] | None], n: int) -> Any:
    if depth:
        elements = [_columns(type_, element, depth - 1, varied, n) for element in value]
        return np.stack(elements) if elements and type_ is Kind.REAL else elements
    if isinstance(type_, Struct):
        return columns(type_, value, varied, n)
    if type_ is not Kind.REAL:
        return value
    numbers = next(varied)
    return np.full(n, float(value)) if numbers is None else numbers


def variant(stand: Stand, layout: Layout, program: Interpreter) -> tuple[dict[str, Any], Any, list[Any]]:
    """Parameters of a stand, a table with its laws, and the reals of both: numbers or columns.

    Raises StandError where a number is out of range.
    """
    parameters, table = parameters_of(stand, layout), laws_of(stand, layout, program)
    return parameters, table, [*reals(layout.parameters, parameters), *reals(law_struct(layout), table)]
