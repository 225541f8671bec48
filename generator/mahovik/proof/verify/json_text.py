"""Results as text in strict JSON, whose floats read back as the same bits."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from mahovik.errors import StateError


def encode(value: Any, name: str = "") -> str:
    """Strict JSON, floats with 17 significant digits, so that they read back as the same bits.

    StateError where a number is not finite, with the `name` of the member. Arrays are lists; a float is never written
    like an integer.
    """
    match value:
        case dict():
            return "{" + members(value) + "}"
        case np.ndarray():
            return encode(value.tolist(), name)
        case list() | tuple():
            return "[" + ", ".join(encode(each, name) for each in value) + "]"
        case float() | np.floating():
            if not math.isfinite(value):
                raise StateError(f"{name}: not finite at this state" if name else "not finite at this state")
            text = f"{float(value):.17g}"
            return text + ".0" if text.lstrip("-").isdigit() else text
        case np.integer():
            return str(int(value))
    return json.dumps(value, allow_nan=False)


def members(value: dict[str, Any]) -> str:
    """Names and values of an object, without its braces. StateError as encode."""
    return ", ".join(f"{json.dumps(name)}: {encode(each, name)}" for name, each in value.items())
