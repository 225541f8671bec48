"""Results as text in strict JSON, whose floats read back as the same bits."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from mahovik.errors import StateError


def encode(value: Any) -> str:
    """Strict JSON, floats with 17 significant digits, so that they read back as the same bits.

    StateError where a number is not finite. Arrays are lists; a float is never written like an integer.
    """
    match value:
        case dict():
            return "{" + members(value) + "}"
        case np.ndarray():
            return encode(value.tolist())
        case list() | tuple():
            return "[" + ", ".join(encode(each) for each in value) + "]"
        case float() | np.floating():
            return _float(float(value))
        case np.integer():
            return str(int(value))
    return json.dumps(value, allow_nan=False)


def members(value: dict[str, Any]) -> str:
    """Names and values of an object, without its braces. StateError, with the name, as encode."""
    return ", ".join(f"{json.dumps(name)}: {_member(name, each)}" for name, each in value.items())


def _member(name: str, value: Any) -> str:
    try:
        return encode(value)
    except StateError as error:
        reason = str(error)
    raise StateError(reason if ":" in reason else f"{name}: {reason}")


def _float(x: float) -> str:
    if not math.isfinite(x):
        raise StateError("not finite at this state")
    text = f"{x:.17g}"
    return text + ".0" if text.lstrip("-").isdigit() else text
