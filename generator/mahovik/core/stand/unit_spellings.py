"""Spellings of units on data sheets that pint does not read as products, such as `gcm²`, `g-cm^2` and `oz-in`.

These readings are tried only where the spelling itself is no unit of the dimension of the key, so none that is one
changes its value.
"""

from __future__ import annotations

import re

_SIGNS = str.maketrans({"⋅": "*", "⁻": "-", **{sign: str(digit) for digit, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}})
_PER_MINUTE = frozenset(("1/min", "r/min", "min^-1", "min-1", "/min"))
_HYPHEN = re.compile(r"(?<=[A-Za-zµμ\d])-(?=[A-Za-zµμ])")
_JOINED = re.compile(
    r"(?<![A-Za-zµμ])(?:(g|mg)(mm|cm)|(kg|[mcukµμ]?N)(mm|cm|m)|(ozf?|lbf?)(in|ft))(?![A-Za-zµμ])"
)  # not gm: gram, or gram metre
_WEIGHT = re.compile(r"\b(oz|lb)\b")
_GRAMS = re.compile(r"\b(k?g) (mm|cm|m)")


def readings(unit: str) -> list[str]:
    """What `unit` may mean, as pint reads it, most literal first; the dimension of the key decides among them.

    A hyphen between words is a product. Ounces and pounds are masses, and forces where a mass does not fit; revolutions
    may be left out of `1/min`.
    """
    plain = unit.translate(_SIGNS)
    found = ["rpm"] if plain.replace(" ", "") in _PER_MINUTE else []
    product = as_product(unit)
    found += [product, _WEIGHT.sub(r"\1f", product)]
    return [each for k, each in enumerate(found) if each != unit and each not in found[:k]]


def as_product(unit: str) -> str:
    """`unit` with spaces between its factors: `g cm2` of `gcm²` and of `g-cm2`."""
    return _JOINED.sub(lambda match: " ".join(filter(None, match.groups())), _HYPHEN.sub(" ", unit.translate(_SIGNS)))


def hint(unit: str, dimension: str) -> str:
    """End of the message on a unit with no reading that fits a key of `dimension`, in SI; empty if there is none."""
    if unit == "gm":
        return ', did you mean "g" or "g m"?'
    product = as_product(unit)
    if dimension.startswith("N m") and _GRAMS.search(product):
        force = _GRAMS.sub(r"\1f \2", product)
        return f', did you mean "{force}"?'
    return ""
