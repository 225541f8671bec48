"""Results as text in strict JSON, whose floats read back as the same bits."""

from __future__ import annotations

import json
import math
from typing import Any

from mahovik.errors import StateError


def encode(value: Any, name: str = "") -> str:
    """Strict JSON, floats with 17 significant digits, so that they read back as the same bits.

    StateError where a number is not finite, with the `name` of the member. Arrays are lists; a float is never written
    like an integer.
    """
    value = value.tolist() if hasattr(value, "tolist") else value  # of NumPy
    match value:
        case dict():
            return "{" + members(value) + "}"
        case list() | tuple():
            return "[" + ", ".join(encode(item, name) for item in value) + "]"
        case float() if not math.isfinite(value):
            raise StateError(f"{name}: not finite at this state" if name else "not finite at this state")
        case float():
            text = f"{value:.17g}"
            return text + ".0" if text.lstrip("-").isdigit() else text
    return json.dumps(value)


def members(value: dict[str, Any]) -> str:
    """Names and values of an object, without its braces. StateError as encode."""
    return ", ".join(f"{json.dumps(name)}: {encode(item, name)}" for name, item in value.items())
