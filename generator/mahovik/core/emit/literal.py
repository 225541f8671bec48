"""Numbers as C literals, exact and typed: the shortest decimal that reads back to the same bits, or hexadecimal."""

from __future__ import annotations

from typing import Any

from mahovik.core.program.types import Precision


def real_literal(value: float, precision: Precision) -> str:
    """`0.1`, in a float program `0.1F`. Raises ValueError for a number without a literal."""
    number = _round_to_type(value, precision)
    text = str(number)
    short = f"{float(number):.16e}".split("e")
    digits = short[0].rstrip("0").rstrip(".")
    if text.endswith(".0") and len(digits) + 4 < len(text):  # 1e6 instead of 1000000.0, the same number
        text = f"{digits}e{int(short[1])}"
    if "e" in text:
        digits, exponent = text.split("e")
        text = f"{digits if '.' in digits else digits + '.0'}e{int(exponent)}"
    elif "." not in text:
        text += ".0"
    return text + _suffix(precision)


def hex_literal(value: float, precision: Precision) -> str:
    """`0x1.8p+3`, in a float program `0x1.8p+3F`. Raises ValueError for a number without a literal."""
    head, exponent = float(_round_to_type(value, precision)).hex().split("p")
    if "." in head:
        head = head.rstrip("0").rstrip(".")
    return f"{head}p{exponent}{_suffix(precision)}"


def _round_to_type(value: float, precision: Precision) -> Any:
    number = precision.scalar(value)
    if not abs(float(number)) <= precision.largest:
        raise ValueError(f"{value!r} has no literal in {precision.name}")
    return number


def _suffix(precision: Precision) -> str:
    return "F" if precision.name == "float" else ""


def word_literal(value: int) -> str:
    """An unsigned literal: small ones decimal, the others hexadecimal."""
    return f"{value}u" if value < 1024 else f"0x{value:x}u"
