"""Units without pint, whose registry takes half a second to start: usual ones exactly, and spellings of data sheets.

Spellings that pint does not read as products, such as `gcm²`, `g-cm^2` and `oz-in`, are tried only where the spelling
itself is no unit of the dimension of the key, so none that is one changes its value.
"""

from __future__ import annotations

import re
from fractions import Fraction

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
    if unit == "gm":
        return ', did you mean "g" or "g m"?'
    product = as_product(unit)
    if dimension.startswith("N m") and _GRAMS.search(product):
        force = _GRAMS.sub(r"\1f \2", product)
        return f', did you mean "{force}"?'
    return ""
