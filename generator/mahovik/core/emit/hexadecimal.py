"""Numbers as hexadecimal C99 literals: exact, and read by every compiler to the same bits."""

from __future__ import annotations

from mahovik.core.program.types import Precision


def hex_literal(value: float, precision: Precision) -> str:
    """`0x1.8p+3`, in a float program `0x1.8p+3F`. Raises ValueError for what has no literal."""
    number = float(precision.scalar(value))
    if not abs(number) <= precision.largest:
        raise ValueError(f"{value!r} has no literal in {precision.name}")
    head, exponent = number.hex().split("p")
    if "." in head:
        head = head.rstrip("0").rstrip(".")
    return f"{head}p{exponent}{'F' if precision.name == 'float' else ''}"
