"""Numbers of a stand file in SI, exactly: a value is rational until it is rounded, once, to a float.

So `"1.1 mm"` is the same float as `0.0011`, and no identity or generated file depends on how a unit was spelled.
pint is imported only where a unit is not a usual one: its registry takes half a second to start.
"""

from __future__ import annotations

import math
import re
from contextlib import suppress
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cache
from typing import Any, cast

import numpy as np

from mahovik.core.stand.columns import Column
from mahovik.nearest import nearest_name


@dataclass(frozen=True)
class Dimension:
    """Dimension of a key: in words for messages, and its SI unit as pint reads it ("" for a plain number).

    Radians count: an angle takes degrees but no `mm/m`, a speed takes rpm but no Hz (50 Hz is not 50 rad/s).
    Elsewhere `rad` may be left out, as in N m for N m/rad; `radians` are further powers of it that mean the same.
    """

    words: str
    si: str
    radians: tuple[int, ...] = ()


MASS = Dimension("a mass", "kg")
LENGTH = Dimension("a length", "m")
ANGLE = Dimension("an angle", "rad")
TIME = Dimension("a time", "s")
INERTIA = Dimension("a moment of inertia", "kg m^2")
VELOCITY = Dimension("a velocity", "m/s")
ACCELERATION = Dimension("an acceleration", "m/s^2")
SPEED = Dimension("an angular speed", "rad/s")
ANGULAR_ACCELERATION = Dimension("an angular acceleration", "rad/s^2")
FORCE = Dimension("a force", "N")
TORQUE = Dimension("a torque", "N m")
STIFFNESS = Dimension("a stiffness", "N/m")
LINEAR_DAMPING = Dimension("a damping", "N s/m")
STATIC_UNBALANCE = Dimension("a static unbalance", "kg m")
DYNAMIC_UNBALANCE = Dimension("a dynamic unbalance", "kg m^2")
TORQUE_CONSTANT = Dimension("a torque constant", "N m/A", radians=(-1,))  # V s/rad is the same unit
RESISTANCE = Dimension("a resistance", "ohm")
VOLTAGE = Dimension("a voltage", "V")
VISCOUS = Dimension("a viscous friction", "N m s/rad")
PLAIN = Dimension("a plain number", "")


class QuantityError(ValueError):
    """A value cannot be read as the quantity of its key; the text says what was found and what was expected."""


_QUANTITY = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\d.])\s*(.*)", re.DOTALL)
_FACTOR = re.compile(
    r"\s*(?P<sign>[*/]?)\s*"
    r"(?:1(?!\w)|(?:(?P<name>[A-Za-zµμΩ°%]+)|\((?P<group>[^()]+)\))(?:\^?(?P<power>-?[1-9]))?)(?![\d.^])"
)
_LONGEST = 60
"""Characters of a unit."""
_MAX_EXPONENT = 400  # beyond the range of a double either way: no need for an integer of a million digits


def number(raw: Any, dimension: Dimension, unit: str | None = None) -> float:
    """One number of the file in SI. `unit`: the unit stated for a whole list; else SI, or the string's own.

    `raw` is what TOML holds: int, Decimal (of a float literal), a string with unit, or `{ value, unit }`; or a column.
    Raises QuantityError.
    """
    if isinstance(raw, dict):
        value, unit = split_value_unit(raw, unit)
        return number(value, dimension, unit)
    if isinstance(raw, str):
        match = _QUANTITY.fullmatch(raw.strip())
        if match is None:
            raise QuantityError(f"{show(raw)} is not a number with a unit, expected {_expectation(dimension)}")
        if unit is not None:
            raise QuantityError(f"{show(raw)} has a unit of its own inside a list in {unit}")
        if not match[2]:
            raise QuantityError(f"{show(raw)} has no unit, write the number without quotes for SI")
        return _round(_exact(Decimal(match[1])) * factor(match[2], dimension))
    if isinstance(raw, Column):
        return cast(float, _column(raw, dimension, unit))
    if isinstance(raw, bool) or not isinstance(raw, int | Decimal):
        raise QuantityError(f"expected {_expectation(dimension)}, found {show(raw)}")
    if unit is None:
        return _round(_exact(raw))
    return _round(_exact(raw) * factor(unit, dimension))


def _column(raw: Column, dimension: Dimension, unit: str | None) -> Column:
    """The numbers of many samples in SI, each rounded as one number is."""
    if not raw.finite():
        raise QuantityError("not finite")
    if unit is None:
        return cast(Column, raw + 0.0)
    scale = factor(unit, dimension)
    return raw.map(lambda values: np.array([_scale(x, scale) for x in values.tolist()]))


def _scale(x: float, scale: Fraction) -> float:
    return _round(Fraction(Decimal(repr(x))) * scale) if math.isfinite(x) else x


def split_value_unit(raw: dict[str, Any], outer: str | None) -> tuple[Any, str]:
    """Value and unit of `{ value = ..., unit = "mm" }`; `outer` is the unit of an enclosing one, refused."""
    if set(raw) != {"value", "unit"} or not isinstance(raw["unit"], str):
        raise QuantityError(
            f'expected {{ value = ..., unit = "..." }}, found a table of {", ".join(sorted(raw)) or "nothing"}'
        )
    if outer is not None:
        raise QuantityError(f"has a unit of its own inside a list in {outer}")
    return raw["value"], raw["unit"]


def unit_of(raw: Any) -> str | None:
    """The unit of a valid quantity, of a list the first that one of its numbers has; None without a unit."""
    if isinstance(raw, dict):
        return str(raw["unit"])
    if isinstance(raw, list):
        return next(filter(None, map(unit_of, raw)), None)
    match = _QUANTITY.fullmatch(raw.strip()) if isinstance(raw, str) else None
    return None if match is None else match[2]


def last_digit(raw: Any, dimension: Dimension) -> float:
    """One unit of the last printed digit of a valid number of the file, in SI; 0 of a column of samples."""
    if isinstance(raw, dict):
        return number({"value": _last_digit(raw["value"]), "unit": raw["unit"]}, dimension)
    if isinstance(raw, str) and (match := _QUANTITY.fullmatch(raw.strip())) is not None:
        return number(f"{_last_digit(Decimal(match[1]))} {match[2]}", dimension)
    return number(_last_digit(raw), dimension) if isinstance(raw, int | Decimal) else 0.0


def _last_digit(written: int | Decimal) -> Decimal:
    exponent = Decimal(written).as_tuple().exponent
    return Decimal(1).scaleb(int(exponent))


@cache
def factor(unit: str, dimension: Dimension) -> Fraction:
    """How many SI units of `dimension` one `unit` is, exactly (pi to 50 digits). Raises QuantityError."""
    if GRAMS_OR_GRAINS.search(unit):
        raise QuantityError(f'unit {show(unit)}: "gr" may be grams or grains, write g or grain')
    try:
        return _literal_factor(unit, dimension)
    except QuantityError as error:
        for reading in readings(unit):
            with suppress(QuantityError):
                return _literal_factor(reading, dimension)
        raise QuantityError(_refusal(str(error), unit, dimension)) from None


def _refusal(literal: str, unit: str, dimension: Dimension) -> str:
    """The message on a unit without a fitting reading; `literal` is the one on the unit as it is spelt."""
    more = hint(unit, dimension.si) or _advice(unit, dimension, "is not a known unit" in literal)
    product = as_product(unit)
    if product != unit:
        with suppress(QuantityError):
            _root(product)
            return f'unit {show(unit)}, read as "{product}", does not fit, expected {_expectation(dimension)}{more}'
    expected = "" if "expected" in literal else f", expected {_expectation(dimension)}"
    return f"{literal}{expected}{more}"


def _advice(unit: str, dimension: Dimension, unknown: bool) -> str:
    """End of the message with the unit that may be meant by an `unknown` one, or by one of another dimension; or ""."""
    for respelling in respellings(unit):
        if _fits(respelling, dimension):
            return f', did you mean "{respelling}"?'
    if not unknown:
        return ""
    near = nearest_name(unit, [name for name in NAMES if _fits(name, dimension)])
    return "" if near is None else f', did you mean "{near}"?'


def _fits(unit: str, dimension: Dimension) -> bool:
    with suppress(QuantityError):
        _literal_factor(unit, dimension)
        return True
    return False


def _literal_factor(unit: str, dimension: Dimension) -> Fraction:
    ours, our_powers = _root(dimension.si)
    theirs, their_powers = _root(unit)
    radians, our_radians = their_powers.get("radian", 0), our_powers.get("radian", 0)
    same = _without_radian(their_powers) == _without_radian(our_powers)
    fitting = (our_radians,) if dimension in (ANGLE, SPEED) else (our_radians, 0, *dimension.radians)
    if not same or radians not in fitting:
        frequency = ", a frequency is not one: write rpm or rad/s" if dimension == SPEED and same else ""
        raise QuantityError(f"unit {show(unit)} does not fit, expected {_expectation(dimension)}{frequency}")
    return theirs / ours


def show(raw: Any) -> str:
    """A value of the file as a message shows it: short, as TOML writes it."""
    if raw is None or isinstance(raw, bool):
        return {None: "null", True: "true", False: "false"}[raw]
    if isinstance(raw, str):
        return '"' + _short(raw).replace("\n", "\\n") + '"'
    if isinstance(raw, dict):
        return "a table"
    if isinstance(raw, list):
        return f"a list of {len(raw)}"
    if isinstance(raw, int) and raw.bit_length() > 1000:  # Python itself refuses to print the longest
        return f"an integer of {raw.bit_length()} bits"
    return _short(str(raw)) if isinstance(raw, int | float | Decimal) else f"a {type(raw).__name__}"


def _short(text: str) -> str:
    return text if len(text) <= 40 else text[:37] + "..."


def _expectation(dimension: Dimension) -> str:
    return f"{dimension.words} ({dimension.si})" if dimension.si else dimension.words


def _exact(raw: int | Decimal) -> Fraction:
    if isinstance(raw, Decimal):
        if not raw.is_finite():
            raise QuantityError(f"not finite: {str(raw).lower()}")
        if raw.adjusted() > _MAX_EXPONENT:
            raise QuantityError(f"not finite in double precision: {show(raw)}")
        if raw.adjusted() < -_MAX_EXPONENT:
            return Fraction(0)
    return Fraction(raw)


def _round(exact: Fraction) -> float:
    try:
        rounded = float(exact)
    except OverflowError:
        rounded = math.inf
    if math.isinf(rounded):
        raise QuantityError("not finite in double precision")
    return rounded + 0.0  # -0.0 becomes 0.0: the same stand has the same bits


def _without_radian(powers: dict[str, int]) -> dict[str, int]:
    return {name: power for name, power in powers.items() if name != "radian"}


@cache
def _root(unit: str) -> tuple[Fraction, dict[str, int]]:
    """Exact factor and powers of pint's root units (gram, meter, second, radian, ...) of a unit.

    It is read here, not by pint, which evaluates `9^9^9`: names and groups of names in brackets, each with at most one
    power of one digit; `/` divides by the next of them.
    """
    scale, powers, place = Fraction(1), dict[str, int](), 0
    text = unit.replace("²", "2").replace("³", "3").replace("·", "*").strip()
    while place < len(text):
        match = _FACTOR.match(text, place)
        if match is None or (place == 0 and match["sign"]) or len(text) > _LONGEST:
            raise QuantityError(f"{show(unit)} is not a unit, expected names with whole powers such as kg m^2/s")
        place, power = match.end(), int(match["power"] or 1) * (-1 if match["sign"] == "/" else 1)
        factor, roots = _root_of_name(match["name"]) if match["name"] else _root(match["group"] or "")
        scale *= factor**power
        for root, times in roots.items():
            powers[root] = powers.get(root, 0) + times * power
    return scale, {root: power for root, power in powers.items() if power}


@cache
def _root_of_name(name: str) -> tuple[Fraction, dict[str, int]]:
    """`_root` of one name."""
    if name in UNITS:
        return UNITS[name]
    registry = _registry()
    try:
        parsed = registry.parse_units(name)
        plain = all(registry._units[registry.get_name(unit)].is_multiplicative for unit in parsed._units)
        scale, root = registry.get_root_units(parsed)
    except Exception as error:  # pint raises its own, and whatever its tokenizer and evaluator do
        raise QuantityError(f"{show(name)} is not a known unit") from error
    if not plain:
        raise QuantityError(f"unit {show(name)} has an offset or is logarithmic")
    powers = dict(root._units.items())
    if not all(float(power).is_integer() for power in powers.values()):  # pint's gauss has one by definition
        raise QuantityError(f"unit {show(name)} does not fit")
    return Fraction(scale), {unit: int(power) for unit, power in powers.items()}


@cache
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry(non_int_type=Fraction)
    # as data sheets of motors and wheels write them
    for definition in (
        "@alias turn = rev = tr",
        "@alias rpm = RPM",
        "@alias pound = lbm",
        "newton_meter = newton * meter = Nm",
        "newton_meter_second = newton * meter * second = Nms",
    ):
        registry.define(definition)
    return registry


# -- usual units exactly, and spellings of data sheets -----------------------------------------------------------------
#
# Spellings that pint does not read as products, such as `gcm²`, `g-cm^2` and `oz-in`, are tried only where the spelling
# itself is no unit of the dimension of the key, so none that is one changes its value.

PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)
"""Pi with 50 digits, as in pint."""

_KILO, _MILLI, _CENTI, _MICRO = Fraction(1000), Fraction(1, 1000), Fraction(1, 100), Fraction(1, 10**6)

UNITS: dict[str, tuple[Fraction, dict[str, int]]] = {
    "g": (Fraction(1), {"gram": 1}),
    "kg": (_KILO, {"gram": 1}),
    "m": (Fraction(1), {"meter": 1}),
    "cm": (_CENTI, {"meter": 1}),
    "mm": (_MILLI, {"meter": 1}),
    "um": (_MICRO, {"meter": 1}),
    "s": (Fraction(1), {"second": 1}),
    "ms": (_MILLI, {"second": 1}),
    "us": (_MICRO, {"second": 1}),
    "rad": (Fraction(1), {"radian": 1}),
    "deg": (PI / 180, {"radian": 1}),
    "mrad": (_MILLI, {"radian": 1}),
    "urad": (_MICRO, {"radian": 1}),
    "arcmin": (PI / 10800, {"radian": 1}),
    "arcsec": (PI / 648000, {"radian": 1}),
    "Hz": (Fraction(1), {"second": -1}),
    "rpm": (PI / 30, {"radian": 1, "second": -1}),
    "N": (_KILO, {"gram": 1, "meter": 1, "second": -2}),
    "mN": (Fraction(1), {"gram": 1, "meter": 1, "second": -2}),
    "A": (Fraction(1), {"ampere": 1}),
    "V": (_KILO, {"gram": 1, "meter": 2, "second": -3, "ampere": -1}),
    "ohm": (_KILO, {"gram": 1, "meter": 2, "second": -3, "ampere": -2}),
}
"""Factor and powers of pint's root units."""


_SIGNS = str.maketrans({"⋅": "*", "⁻": "-", **{sign: str(digit) for digit, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}})
_PER_MINUTE = frozenset(("1/min", "r/min", "U/min", "min^-1", "min-1", "/min"))
_HYPHEN = re.compile(r"(?<=[A-Za-zµμ\d])-(?=[A-Za-zµμ])")
_JOINED = re.compile(
    r"(?<![A-Za-zµμ])(?:(g|mg)(mm|cm)|(kg|[mcukµμ]?N)(mm|cm|m)|(ozf?|lbf?)(in|ft))(?![A-Za-zµμ])"
)  # not gm: gram, or gram metre
_WORD = re.compile(r"[A-Za-zµμΩ]+")
_WORDS = {
    word: unit
    for unit, words in {
        "kg": "kilo kilos kgs kgr kilogramm kilogramme kilogrammes",
        "g": "gm gms gs gramm gramme grammes",
        "m": "meter meters metre metres mtr mtrs",
        "mm": "mms",
        "cm": "cms",
        "s": "second seconds",
        "deg": "degree degrees grad grads",
        "rpm": "u/min upm",
        "N": "n newton newtons",
        "mN": "mn",
        "N m": "nm",
        "mN m": "mnm",
        "N cm": "ncm",
        "A": "a amp amps ampere amperes",
        "V": "v volt volts",
        "ohm": "r",
        "Hz": "hz",
        "T": "t tesla",
        "mT": "mt",
        "uT": "ut",
    }.items()
    for word in words.split()
}
"""Units that words and spellings, in lower case, may mean where they do not fit: `kilos` are kiloseconds for pint."""

GAUSS = {"g": "1e-4", "gs": "1e-4", "gauss": "1e-4", "mg": "1e-7", "kg": "0.1"}
"""Tesla of one of these, in lower case: the gauss of pint is that of another system of units."""

NAMES = (
    *("kg", "g", "m", "cm", "mm", "s", "ms", "us", "rad", "deg", "rpm", "N", "mN", "A", "V", "ohm", "T", "mT", "uT"),
    *("kilogram", "gram", "meter", "centimeter", "millimeter", "second", "millisecond", "radian", "degree", "newton"),
    *("volt", "ampere", "tesla", "N m", "kg m^2", "g cm^2", "kg cm^2"),
)
"""Units to suggest for a misspelt one."""

GRAMS_OR_GRAINS = re.compile(r"\bgr\b")
"""A spelling of two masses: 20 gr are 20 g for most people, and 1.3 g for pint."""

_WEIGHT = re.compile(r"\b(oz|lb)\b")
_GRAMS = re.compile(r"\b(k?g) (mm|cm|m)")


def readings(unit: str) -> list[str]:
    """What `unit` may mean, as pint reads it, most literal first; the dimension of the key decides among them.

    A hyphen between words is a product. Ounces and pounds are masses, and forces where a mass does not fit; revolutions
    may be left out of `1/min`.
    """
    plain = unit.translate(_SIGNS)
    result = ["rpm"] if plain.replace(" ", "") in _PER_MINUTE else []
    if plain.lower() == "cpm":  # cycles per minute: of a shaft, or of what it shakes
        result = ["rpm", "1/min"]
    product = as_product(unit)
    result += [product, _WEIGHT.sub(r"\1f", product)]
    return [spelling for k, spelling in enumerate(result) if spelling != unit and spelling not in result[:k]]


def as_product(unit: str) -> str:
    """`unit` with spaces between its factors: `g cm2` of `gcm²` and of `g-cm2`."""
    return _JOINED.sub(lambda match: " ".join(filter(None, match.groups())), _HYPHEN.sub(" ", unit.translate(_SIGNS)))


def respellings(unit: str) -> list[str]:
    """Units that may be meant by one that does not fit: usual words and another case, of each factor."""
    words = _WORD.sub(lambda match: _WORDS.get(match.group().lower(), match.group().lower()), unit)
    result = [_WORDS.get(unit.lower(), words), words, unit.lower()]
    return [spelling for k, spelling in enumerate(result) if spelling != unit and spelling not in result[:k]]


def hint(unit: str, dimension: str) -> str:
    """End of the message on a unit with no reading that fits a key of `dimension`, in SI; empty if there is none."""
    if dimension == "T" and unit.lower() in GAUSS:
        return f", 1 {unit} is {GAUSS[unit.lower()]} T"
    if dimension == "m/s^2" and unit == "g":
        return ", 1 g is 9.80665 m/s^2"
    if unit == "gm":
        return ', did you mean "g" or "g m"?'
    product = as_product(unit)
    if dimension.startswith("N m") and _GRAMS.search(product):
        force = _GRAMS.sub(r"\1f \2", product)
        return f', did you mean "{force}"?'
    return ""
