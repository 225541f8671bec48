"""A second reading of the stand file: masses, their centres, inertia, added mass, mountings, sums of isolators, motors.

All derivations begin with the numbers that `core/stand` has read, so that a wrong sign there is the same in all of
them. This one reads the file's tables itself, by other ways: units by a table of its own; an unbalance as a complex
number; inertia by the second moments of mass, S = int r r^T dm, with J = tr(S) E - S; attitudes by three arms that
turn one after the other. What a file may hold is checked elsewhere: a file that `core/stand` refuses is not read here.
"""

from __future__ import annotations

import cmath
import math
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand, Vec3
from mahovik.proof.second.body import Array, by_angles, rotation_vector
from mahovik.proof.second.system import added_mass, columns, places, twists

Table = Mapping[str, Any]
"""A table as `tomllib` gives it; numbers may be Decimals."""

UNITS = {
    "m": 1.0, "in": 0.0254, "ft": 0.3048, "inch": 0.0254,
    "g": 1e-3, "t": 1e3, "oz": 0.028349523125, "lb": 0.45359237,
    "s": 1.0, "min": 60.0, "N": 1.0,
    "rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180, "degree": math.pi / 180, "degrees": math.pi / 180,
    "turn": 2 * math.pi, "rev": 2 * math.pi, "tr": 2 * math.pi,
    "rpm": math.pi / 30, "RPM": math.pi / 30, "cpm": math.pi / 30, "lbm": 0.45359237,
    "arcmin": math.pi / 10800, "arcsec": math.pi / 648000,
}  # fmt: skip
"""SI value of one of each."""

PREFIXES = {"k": 1e3, "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "n": 1e-9}

DIGITS = str.maketrans("²³·⋅", "23**")


class UnknownUnitError(ValueError):
    """A unit that this reading does not know; the text is the unit."""


class BodyNumbers(NamedTuple):
    """A body's mass (kg), centre of mass (3; m) in its own frame, and inertia about it (3x3; kg m2), on its axes."""

    mass: float
    center_of_mass: Array
    inertia: Array


class Reading(NamedTuple):
    """What the file has: bodies and places by name, in the file's order, and the added mass of all (6x6), about O1.

    A place is an origin (3; m, from O1) and axes (3x3, columns), in E1; a flywheel's at phi_s = 0.
    """

    bodies: dict[str, BodyNumbers]
    places: dict[str, tuple[Array, Array]]
    added_mass: Array


def load_tables(path: Path) -> Table:
    """The tables of a stand file."""
    return tomllib.loads(path.read_text(encoding="utf-8-sig"))


def read(document: Table) -> Reading:
    """The reading of a stand file's tables. Raises UnknownUnitError."""
    carrier, instruments, flywheels = document["carrier"], document.get("instrument", []), document.get("flywheel", [])
    at = {"carrier": (np.zeros(3), np.eye(3))}
    for table in (*instruments, *flywheels, *document.get("point", [])):
        origin, axes = at[table.get("mount", "carrier")]
        at[table["name"]] = origin + axes @ _numbers(table.get("position", [0, 0, 0])), axes @ _axes(table)
    masses = {"carrier": _body(carrier)} | {table["name"]: _body(table) for table in (*instruments, *flywheels)}
    fluid = [_symmetric(table["added_mass"], 6) for table in (carrier, *instruments) if "added_mass" in table]
    return Reading(masses, at, sum(fluid, np.zeros((6, 6))))


def _body(table: Table) -> BodyNumbers:
    mass, c = _si(table.get("mass", 0)), _numbers(table.get("center_of_mass", [0, 0, 0]))
    if "spin_inertia" in table:
        static, dynamic = (_phasor(table.get("unbalance", {}), kind) for kind in ("static", "dynamic"))
        across = table["transverse_inertia"]
        pair = isinstance(across, list) or (isinstance(across, dict) and isinstance(across["value"], list))
        J = np.diag([_si(table["spin_inertia"]), *(_numbers(across) if pair else [_si(across)] * 2)])
        c = np.array([0.0, static.real, static.imag]) / (mass or 1.0)
        S = _second_moments(J)
        # int x y and int x z: the products of inertia are their negatives
        S[0, 1:] = S[1:, 0] = dynamic.real, dynamic.imag
    else:
        S = _second_moments(_symmetric(table.get("inertia", [0, 0, 0]), 3))
    if table.get("inertia_about") == "center_of_mass":
        return BodyNumbers(mass, c, np.trace(S) * np.eye(3) - S)
    central = S - mass * np.outer(c, c)
    return BodyNumbers(mass, c, np.trace(central) * np.eye(3) - central)


def _second_moments(J: Array) -> Array:
    """S (3x3; kg m2) of a tensor of inertia about the same point."""
    return np.asarray(np.trace(J) / 2 * np.eye(3) - J)


def _phasor(unbalance: Table, kind: str) -> complex:
    """Unbalance as y + i z: its amount, at its angle from the second axis."""
    return cmath.rect(_si(unbalance.get(kind, 0)), _si(unbalance.get(f"{kind}_at", 0)))


def _axes(table: Table) -> Array:
    """Axes (3x3, columns) in the mount's frame."""
    if "axis" in table:
        spin = _numbers(table["axis"])
        steep = abs(spin[0]) > math.sqrt(0.8) * np.linalg.norm(spin)
        zero = _numbers(table.get("zero", [0, 1, 0] if steep else [1, 0, 0]))
        third = np.cross(spin / np.linalg.norm(spin), zero / np.linalg.norm(zero))
        return np.column_stack([arm / np.linalg.norm(arm) for arm in (spin, np.cross(third, spin), third)])
    arms = np.eye(3)
    for angle, number in zip(_numbers(table.get("angles", [0, 0])), (2, 1, 0), strict=False):
        k, (c, s) = arms[:, [number]], (math.cos(angle), math.sin(angle))
        arms = c * arms + s * np.cross(k, arms, axis=0) + (1 - c) * k @ (k.T @ arms)
    return arms


def _symmetric(raw: Any, size: int) -> Array:
    """A matrix by its rows, or by its diagonal; the mean of elements that differ as they were rounded."""
    rows, unit = (raw["value"], raw["unit"]) if isinstance(raw, dict) else (raw, None)
    if not any(isinstance(row, list | dict) and not _is_number(row) for row in rows):
        return np.diag(_numbers(rows, unit))
    matrix = np.array([_numbers(row, unit) for row in rows])
    assert matrix.shape == (size, size)
    return np.asarray((matrix + matrix.T) / 2)


def _is_number(raw: Any) -> bool:
    return isinstance(raw, dict) and not isinstance(raw["value"], list)


def _numbers(raw: Any, unit: str | None = None) -> Array:
    """A list of numbers, with a unit each or one for all."""
    values, unit = (raw["value"], raw["unit"]) if isinstance(raw, dict) else (raw, unit)
    return np.array([_si(value, unit) for value in values])


def _si(raw: Any, unit: str | None = None) -> float:
    """One number: plain, `"2 g cm"`, or `{ value = 2, unit = "g cm" }`."""
    if isinstance(raw, dict):
        return _si(raw["value"], raw["unit"])
    if isinstance(raw, str):
        value, unit = re.fullmatch(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*)", raw.strip(), re.DOTALL).groups()  # type: ignore[union-attr]
        return float(value) * _factor(unit)
    return float(raw) * (1.0 if unit is None else _factor(unit))


def _factor(unit: str) -> float:
    """SI value of one such unit: `g cm`, `kg*m^2`, `gcm²`, `1/s`."""
    product, text = 1.0, unit.translate(DIGITS)
    for sign, name, power in re.findall(r"([*/]?)\s*([A-Za-zµμ°]+|1)\s*\^?(-?\d*)", text):
        product *= _name(name, unit) ** ((-1 if sign == "/" else 1) * int(power or 1))
    if re.sub(r"([*/]?)\s*([A-Za-zµμ°]+|1)\s*\^?(-?\d*)\s*", "", text):
        raise UnknownUnitError(unit)
    return product


def _name(name: str, unit: str) -> float:
    """SI value of one name, or of two that are joined."""
    if name == "1":
        return 1.0
    if name in UNITS:
        return UNITS[name]
    if name[0] in PREFIXES and name[1:] in ("m", "g", "N", "s", "rad"):
        return PREFIXES[name[0]] * UNITS[name[1:]]
    for first in ("kg", "mg", "g", "mN", "N", "oz", "lb"):
        if name.startswith(first) and name != first:
            return _name(first, unit) * _name(name.removeprefix(first), unit)
    raise UnknownUnitError(unit)


def differences(stand: Stand, document: Table) -> dict[str, float]:
    """Relative differences of a stand's numbers from the second reading of its file, by body and quantity.

    Lengths are over the largest of the stand, centres of mass over their own, inertia over its largest element and
    that of its transfer. Raises UnknownUnitError.
    """
    file, at, fluid = read(document), places(stand), added_mass(stand)
    if [*file.places] != [*dict.fromkeys((*file.bodies, *at))] or [*file.bodies] != [b.name for b in stand.bodies]:
        return {"bodies": math.inf}
    reach = max(float(np.abs(origin).max()) for origin, _ in at.values())
    result = {}
    for name, (origin, axes) in at.items():
        result[f"{name} position"] = _relative(origin, file.places[name][0], reach)
        result[f"{name} axes"] = _relative(axes, file.places[name][1], 1.0)
    for (name, body), column in zip(file.bodies.items(), columns(stand).T, strict=True):
        mass, c, J = column[12], column[13:16], column[16:].reshape(3, 3)
        result[f"{name} mass"] = _relative(mass, body.mass, mass)
        result[f"{name} centre of mass"] = _relative(c, body.center_of_mass, np.abs(c).max())
        result[f"{name} inertia"] = _relative(J, body.inertia, np.abs(J).max() + mass * float(c @ c))
    Lambda = np.zeros((6, 6)) if fluid is None else fluid
    result["added mass"] = _relative(Lambda, file.added_mass, np.abs(Lambda).max())
    return result | (_isolators(stand, document, file) if "isolator" in document else {})


def default_options(document: Table, largest: float, near_singular: float) -> dict[str, Array]:
    """Members of the default options of the C by the file's flywheels; `largest` stands for no limit.

    A motor that nothing limits is none: `inverse_most` then bounds the acceleration, and friction does not count.
    """
    wheels = document.get("flywheel", [])
    motors = [wheel.get("motor", {}) for wheel in wheels]
    motors = [motor if motor.keys() & {"torque", "speed", "torque_speed"} else {} for motor in motors]
    curves = [_curve(motor["torque_speed"]) if "torque_speed" in motor else [[0.0, largest]] for motor in motors]
    points = max(map(len, curves), default=0)
    padded = np.array([[*curve, *curve[-1:] * (points - len(curve))] for curve in curves])

    def of_motors(key: str, absent: float) -> Array:
        return np.array([_si(motor.get(key, absent)) for motor in motors])

    none, zero = np.full(len(wheels), largest), np.zeros(len(wheels))
    return {
        "weight": np.array([_si(wheel.get("inverse_weight", 1)) for wheel in wheels]),
        "limit": none,
        "most": np.array([largest if motor else _si(document.get("inverse_most", 1e4)) for motor in motors]),
        "motor_torque": of_motors("torque", largest),
        "motor_speed": of_motors("speed", largest),
        "motor_curve_speed": padded[..., 0],
        "motor_curve_torque": padded[..., 1],
        "motor_viscous": of_motors("viscous", 0.0),
        "motor_coulomb": of_motors("coulomb", 0.0),
        "motor_coulomb_speed": np.array([_si(motor.get("coulomb_speed", 0.1)) if motor else 1.0 for motor in motors]),
        "motor_power": none,
        "target_speed": zero,
        "near_singular": np.array(near_singular),
        **{name: np.array(0.0) for name in ("damping", "target_rate", "avoid_speed", "keep_direction")},
        **{f"use_{name}": np.ones(_count(task["rows"])) for name, task in document.get("task", {}).items()},
    }


def _count(rows: Any) -> int:
    """Components that the rows of a task demand: those of a point are a table with rows of its own."""
    return sum(1 if isinstance(row, str) else len(row["rows"]) for row in rows)


def _curve(raw: Any) -> list[list[float]]:
    """Speed and torque of the points of a curve; of one from speed 0 on also those of the other sense."""
    pairs, units = (raw["value"], raw["unit"]) if isinstance(raw, dict) else (raw, (None, None))
    points = [[_si(x, unit) for x, unit in zip(pair, units, strict=True)] for pair in pairs]
    other_sense = [[-speed, torque] for speed, torque in points[::-1] if speed > 0.0]
    return points if points[0][0] < 0.0 else other_sense + points


def _isolators(stand: Stand, document: Table, file: Reading) -> dict[str, float]:
    """Relative differences of a suspension from its isolators.

    Energy and power of each are sums over its axes a: k (a (v + w x r))^2 for a twist (v, w). So each axis has the row
    (a, r x a), and all of them the stiffness R^T k R. Weight is the force at a mean centre of mass of a body.
    """
    law: Any = next(law for law in stand.laws if law.key == "suspension")
    rows, k, ratios, dampings = [], [], [], []
    for table in document["isolator"]:
        for axis in _axes(table).T:
            rows.append(np.concatenate([axis, np.cross(_numbers(table["position"]), axis)]))
        k += list(_numbers(table["stiffness"]))
        dampings += list(_numbers(table.get("damping", [0, 0, 0])))
        ratios += [_si(table.get("ratio", 0)) + _si(table.get("loss", 0)) / 2] * 3
    R, springs = np.array(rows), np.array(k)
    C, at = np.eye(3), np.zeros(3)
    if stand.hold is not None:  # the pose of the file is then that of the hold
        C, at = _attitude(stand, stand.hold.angles), np.array(stand.hold.position)
    g = C.T @ np.array(stand.gravity)
    weight = np.zeros(6)
    for body in stand.bodies:
        origin, axes = file.places[body.name]
        spins = np.diag([1.0, 0.0, 0.0]) if body.name in {flywheel.name for flywheel in stand.flywheels} else np.eye(3)
        numbers = file.bodies[body.name]
        for mass, c in [(numbers.mass, numbers.center_of_mass), *((-m, np.array(c)) for m, c in body.displaced)]:
            weight += mass * np.concatenate([g, np.cross(origin + axes @ spins @ c, g)])
    S = twists(stand.hold)
    K = R.T @ (springs[:, None] * R)
    x = S @ np.linalg.pinv(S.T @ K @ S, rcond=1e-13, hermitian=True) @ S.T @ weight
    lift = springs * (R @ x) * (R[:, :3] @ g)
    borne = np.repeat(lift.reshape(-1, 3).sum(axis=1), 3) / max(float(g @ g), 1e-300)
    c = np.array(dampings) + 2 * np.array(ratios) * np.sqrt(springs * np.maximum(borne, 0.0))
    D = R.T @ (c[:, None] * R)
    isolators = {"stiffness": (law.stiffness, K), "damping": (law.damping, D)}
    if "preload" in document.get("suspension", {}):
        turned = rotation_vector(_attitude(stand, law.angles).T @ C)
        off = np.concatenate([C.T @ (at - np.array(law.position)), turned])
        isolators["equilibrium"] = (S.T @ K @ off, S.T @ weight)
    return {
        f"suspension {name}": _relative(np.array(a), b, np.abs(b).max(initial=0.0))
        for name, (a, b) in isolators.items()
    }


def _attitude(stand: Stand, angles: Vec3) -> Array:
    """Attitude (3x3) by angles of the stand's sequence."""
    return np.asarray(by_angles(stand.angles, ca.DM(angles)).full())


def _relative(value: Any, expected: Any, scale: float) -> float:
    off = float(np.max(np.abs(value - expected)))
    return off / scale if scale else math.inf if off else 0.0
