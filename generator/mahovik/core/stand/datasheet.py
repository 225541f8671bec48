"""Flywheels as data sheets give them: mountings by angles or axes, moments of inertia and unbalance.

Static unbalance U_s = mass r at angle a from axis 2: center_of_mass = r (0, cos a, sin a).
Dynamic unbalance U_d at angle b: J12 = -U_d cos b, J13 = -U_d sin b, J23 = 0. All at the flywheel's origin.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_HALF_EVEN, Decimal
from typing import Annotated, Any, ClassVar

from mahovik.core.stand import units
from mahovik.core.stand.columns import polar
from mahovik.core.stand.declare import Note
from mahovik.core.stand.fields import (
    Direction,
    Mat3,
    Vec3,
    as_written,
    list_item,
    parallel,
    require_bounds,
    scalar,
    validator,
    vector,
)
from mahovik.core.stand.tables import Table
from mahovik.core.stand.units import INERTIA, QuantityError, factor, number, unit_of


@dataclass(frozen=True)
class MountingAngles:
    """Mounting of a flywheel by angles: C3(psi) C2(theta) C1(zero + phi_s)."""

    psi: float
    theta: float
    zero: float


@dataclass(frozen=True)
class MountingAxes:
    """Mounting of a flywheel by directions in the mount's frame, of any length.

    `axis`: spin axis (first axis of Es); `zero`: its part across the axis is the second axis of Es at phi_s = 0.
    """

    axis: Vec3
    zero: Vec3


_GRADE = "static unbalance is mass times G over speed: G 2.5 at 3000 rpm of 2 kg is static = 2 * 2.5e-3 / 314.16 kg m"
_STATIC = "unbalance = { static = ... } has it; a catalogue's working moment is twice the static one"


class UnbalanceTable(Table):
    """`unbalance` of a flywheel.

    static      mass times distance `r` of the centre of mass from the axis
    static_at   its angle `a` from axis 2: `center_of_mass = r (0, cos a, sin a)`
    dynamic     amount `U_d` of the products of inertia
    dynamic_at  its angle `b`: `J12 = -U_d cos b`, `J13 = -U_d sin b`, `J23 = 0`
    """

    static: Annotated[float, scalar(units.STATIC_UNBALANCE, least=0.0)] = 0.0
    static_at: Annotated[float, scalar(units.ANGLE)] = 0.0
    dynamic: Annotated[float, scalar(units.DYNAMIC_UNBALANCE, least=0.0)] = 0.0
    dynamic_at: Annotated[float, scalar(units.ANGLE)] = 0.0

    instead: ClassVar[Mapping[str, str]] = {"grade": _GRADE} | dict.fromkeys(("moment", "working_moment"), _STATIC)


def _spin_angles(raw: Any) -> tuple[float, ...]:
    return vector(raw, (2, 3), units.ANGLE)


def _transverse(raw: Any) -> tuple[float, ...]:
    """One number for both transverse axes, or two."""
    if not isinstance(raw["value"] if isinstance(raw, dict) and "value" in raw else raw, list):
        return (require_bounds(number(raw, units.INERTIA), units.INERTIA.si, least=0.0, raw=raw),) * 2
    pair = vector(raw, (2,), units.INERTIA)
    for i, value in enumerate(pair):
        try:
            require_bounds(value, units.INERTIA.si, least=0.0, raw=list_item(raw, i))
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None
    return pair


class FlywheelForm(Table):
    """Keys of a flywheel that are none of its data: they say its mounting, its centre of mass and its inertia.

    angles              `[psi_s, theta_s]` of `C3 C2 C1(phi_s)`, or `[psi_s, theta_s, phi0]`, where `phi_s` is counted
                        from `phi0`
    axis                in place of `angles`: spin axis in the frame of the mount
    zero                with `axis`: its part across the axis is the second axis at `phi_s = 0`; may be left out where
                        mass, inertia and wrenches are the same at every phase
    inertia             as of any body; or in place of it and of `center_of_mass` the next three keys
    spin_inertia        `J11` about the origin
    transverse_inertia  `J22`, or `[J22, J33]`, about the origin; on average at least `spin_inertia/2`, that of a disc
    unbalance           static and dynamic unbalance
    """

    angles: Annotated[tuple[float, ...], validator(_spin_angles, units.ANGLE, shape="2 or 3 numbers")] | None = None
    axis: Direction | None = None
    zero: Direction | None = None
    spin_inertia: Annotated[float, scalar(units.INERTIA, least=0.0)] | None = None
    transverse_inertia: (
        Annotated[tuple[float, ...], validator(_transverse, units.INERTIA, shape="1 or 2 numbers")] | None
    ) = None
    unbalance: UnbalanceTable | None = None

    instead: ClassVar[Mapping[str, str]] = {
        "shape": "a flywheel has numbers in the place of a shape, spin_inertia and transverse_inertia; "
        "for a thin disc transverse_inertia = spin_inertia/2",
        "added_mass": "that of a flywheel would turn with it; give it to the carrier or an instrument",
        "dynamic_unbalance": "unbalance = { dynamic = ... } has it",
        **dict.fromkeys(
            ("momentum", "angular_momentum"),
            "it is spin_inertia times speed: 0.4 N m s at 6000 rpm is spin_inertia = 0.4 / 628.32 kg m^2",
        ),
        **dict.fromkeys(("grade", "balance_grade"), f"{_GRADE}, in unbalance = {{ static = ... }}"),
        **dict.fromkeys(("static_unbalance", "static_moment", "mass_moment", "working_moment"), _STATIC),
    }

    def mounting(self, note: Note, depends: Callable[[], str]) -> MountingAngles | MountingAxes | None:
        """The mounting; None where it is not known, which is noted. `depends`: what depends on the phase; "", nothing.

        Where nothing does and the file has no `zero`, it is the first axis of the mount, or the second where `axis` is
        nearer than 26 degrees to the first.
        """
        if self.axis is None and self.zero is None:
            psi, theta, *zero = self.angles or (0.0, 0.0)
            return MountingAngles(psi, theta, zero[0] if zero else 0.0)
        if self.angles is not None:
            note("angles", "given together with axis, zero: expected one or the other")
        elif self.axis is None:
            note("axis", "required with zero, but missing")
        elif self.zero is None:
            if not (what := depends()):
                x, y, z = self.axis
                along_first = x * x > 0.8 * (x * x + y * y + z * z)
                return MountingAxes(self.axis, (0.0, 1.0, 0.0) if along_first else (1.0, 0.0, 0.0))
            note("zero", f"required with axis (direction of the second axis at phi_s = 0) for {what}, but missing")
        elif parallel(self.axis, self.zero):
            note("zero", "parallel to axis, expected another direction")
        else:
            return MountingAxes(self.axis, self.zero)
        return None

    def masses(self: Any, note: Note, moments: Moments) -> dict[str, Any] | None:
        """Centre of mass and inertia by the data sheet; {}: given as such; None where not known, which is noted."""
        sheet = [key for key in ("spin_inertia", "transverse_inertia", "unbalance") if getattr(self, key) is not None]
        if not sheet:
            if self.inertia is not None:
                return {}
            note("inertia", "required, but missing (or spin_inertia and transverse_inertia)")
            return None
        mixed = [key for key in ("center_of_mass", "inertia", "inertia_about") if key in self.present]
        if mixed:
            note(mixed[0], f"given together with {', '.join(sheet)}: expected one way or the other")
            return None
        if self.spin_inertia is None or self.transverse_inertia is None:
            missing = "spin_inertia" if self.spin_inertia is None else "transverse_inertia"
            note(missing, f"required with {', '.join(sheet)}, but missing{thin_disc(self, moments)}")
            return None
        if self.mass == 0.0 and self.unbalance is not None and self.unbalance.static != 0.0:
            note("unbalance", "static", "a flywheel of mass 0 cannot have a static unbalance")
            return None
        return {
            "center_of_mass": center_of_mass(self.mass, self.unbalance),
            "inertia": inertia(self.spin_inertia, self.transverse_inertia, self.unbalance),
            "inertia_about": "origin",
        }


def center_of_mass(mass: float, unbalance: UnbalanceTable | None) -> Vec3:
    """Centre of mass, m, of a flywheel of `mass` > 0 with this static unbalance."""
    if unbalance is None or unbalance.static == 0.0:
        return (0.0, 0.0, 0.0)
    y, z = polar(unbalance.static, unbalance.static_at, mass)
    return (0.0, y, z)


def inertia(spin: float, transverse: tuple[float, ...], unbalance: UnbalanceTable | None) -> Mat3:
    """Inertia tensor about the origin, kg m2, with this dynamic unbalance."""
    j12, j13 = (0.0, 0.0)
    if unbalance is not None and unbalance.dynamic != 0.0:
        j12, j13 = polar(-unbalance.dynamic, unbalance.dynamic_at, 1.0)
    return ((spin, j12, j13), (j12, transverse[0], 0.0), (j13, 0.0, transverse[1]))


def least_transverse(mass: float, spin: float, unbalance: UnbalanceTable | None) -> float | None:
    """An equal transverse inertia, kg m2, with which a body of this spin inertia and unbalance can be: a thin disc's.

    `spin/2` without dynamic unbalance. None where the static unbalance alone needs more spin inertia.
    """
    static, dynamic = (0.0, 0.0) if unbalance is None else (unbalance.static, unbalance.dynamic)
    thickness = spin / 2 - (static * static / mass if mass > 0.0 else 0.0)  # second moment of mass across the axis
    if dynamic == 0.0:
        return spin / 2 if thickness >= 0.0 else None
    return spin / 2 + dynamic * dynamic / thickness if thickness > 0.0 else None


def thin_disc(form: Any, moments: Moments) -> str:
    """What to write where a data sheet's transverse inertia is missing or below that of a thin disc; else ""."""
    if form.spin_inertia is None:
        return ""
    spin, least = form.spin_inertia, least_transverse(form.mass, form.spin_inertia, form.unbalance)
    if least is None or not math.isfinite(least):
        return ""
    half = spin / 2
    more = "" if least == half else f", with this unbalance {moments.at_least(least)} {moments.unit}"
    advice = (
        f"spin_inertia/2 = {moments.at_least(half)} {moments.unit} across its axis{more}: "
        f"for a thin disc write transverse_inertia = {moments.value(least)}"
    )
    if form.transverse_inertia is None:
        return f"; a thin disc has {advice}"
    is_less = sum(form.transverse_inertia) / len(form.transverse_inertia) < least
    return f"no disc has less than {advice}" if is_less else ""


# -- moments of inertia in messages: as the file gives them, and others in the same unit -------------------------------

KEYS = ("inertia", "spin_inertia", "transverse_inertia")
"""Keys of a body that hold moments of inertia about axes."""

_LONGEST = 300
_EXACT, _SHOWN, _ALL = 12, 6, 17  # digits: what a conversion leaves right; of a message; of a double


@dataclass(frozen=True)
class Moments:
    """How messages show moments of inertia of one body.

    place  the keys with what the file has there, `inertia = [120, 60, 40] g cm^2`; `inertia` where there is no file,
           or very much
    unit   unit of the last of them; SI where they have none
    plain  whether the file gives them without unit
    """

    place: str = "inertia"
    unit: str = INERTIA.si
    plain: bool = True

    def number(self, moment: float, digits: int = _SHOWN) -> str:
        """A moment in kg m2 as a number in the unit."""
        return f"{float(self._in_unit(moment, digits)):.{digits}g}"

    def at_least(self, moment: float) -> str:
        """A moment in kg m2 above 0 as a number in the unit, with six digits, not below it."""
        exact = self._in_unit(moment, _EXACT)
        return f"{float(exact.quantize(Decimal(1).scaleb(exact.adjusted() - _SHOWN + 1), ROUND_CEILING)):g}"

    def value(self, moment: float) -> str:
        """The moment as a value of a stand file: `"225 g cm^2"`, or `2.25e-05` where the file has no units."""
        return self.at_least(moment) if self.plain else f'"{self.at_least(moment)} {self.unit}"'

    def _in_unit(self, moment: float, digits: int) -> Decimal:
        """A moment in the unit, rounded to `digits`."""
        size = factor(self.unit, INERTIA)
        exact = Decimal(repr(float(moment))) * size.denominator / size.numerator
        return exact.quantize(Decimal(1).scaleb(exact.adjusted() - digits + 1), ROUND_HALF_EVEN) if exact else exact

    def broken_inequality(self, a: float, b: float, c: float) -> str:
        """The triangle inequality that principal moments break, a <= b <= c."""
        # as few digits as show that it is broken
        for digits in (_SHOWN, 9, _EXACT, _ALL):
            one, two, most = (self._in_unit(moment, digits) for moment in (a, b, c))
            if one + two < most:
                break
        return f"{self.number(a, digits)} + {self.number(b, digits)} < {self.number(c, digits)} {self.unit}"

    def condition(self, a: float, c: float) -> str:
        """The demand on the smaller two of three principal moments, the least of them `a`, the largest `c`."""
        least = max(a, 0.0)
        return (
            f"expected the smaller two to add up to at least {self.at_least(c)} {self.unit}, "
            f"such as {self.number(least)} and {self.at_least(c - least)}"
        )


def moments_of(raw: Mapping[str, Any]) -> Moments:
    """Moments of inertia of a valid table of a body, as it stands in the file."""
    typed = {key: raw[key] for key in KEYS if key in raw}
    moments = [unit for unit in map(unit_of, typed.values()) if unit]
    place = ", ".join(f"{key} = {as_written(value, INERTIA.si)}" for key, value in typed.items())
    return Moments(
        place if place and len(place) <= _LONGEST else KEYS[0], moments[-1] if moments else INERTIA.si, not moments
    )
