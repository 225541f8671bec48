"""Numbers of a stand file as a reader wrote them: "1.5 g mm", alone or within a list."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Any

WHOLE_TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""rad, with room for rounding."""


def text_with_unit(raw: Any) -> str | None:
    """The text of a number or a list that has a unit in the file: "1.5 g mm", "[1, 2, 3 mm]"; None without a unit."""
    if isinstance(raw, dict) and set(raw) == {"value", "unit"} and isinstance(raw["value"], int | Decimal | list):
        return f"{_text(raw['value'])} {raw['unit']}"
    if isinstance(raw, list):
        return _text(raw) if any(map(text_with_unit, raw)) else None
    return " ".join(raw.split()) if isinstance(raw, str) else None


def as_written(raw: Any, unit: str) -> str:
    """The text of a number or a list as it is in the file, in `unit`, SI, where it has no unit there."""
    return text_with_unit(raw) or f"{_text(raw)} {unit}"


def echo(raw: Any, value: float, unit: str) -> str | None:
    """The text of a number that has a unit in the file, and SI: "1.5 g mm (1.5e-06 kg m)"; None without a unit."""
    own = text_with_unit(raw)
    return None if own is None else f"{own} ({value:.6g} {unit})"


def list_item(raw: Any, index: int) -> Any:
    """An item of a list as it would stand alone: with the unit of the whole list, where that has one."""
    if isinstance(raw, dict):
        return {"value": raw["value"][index], "unit": raw["unit"]}
    return raw[index]


def _text(raw: Any) -> str:
    return f"[{', '.join(text_with_unit(item) or _text(item) for item in raw)}]" if isinstance(raw, list) else str(raw)


def beyond_a_turn(name: str, raw: Any) -> list[str]:
    """A warning, in a list, of an angle or a list of them without unit, in rad, that is beyond a whole turn."""
    values = raw if isinstance(raw, list) else [raw]
    if text_with_unit(raw) is not None or not any(abs(x) > WHOLE_TURN for x in values):
        return []
    return [f"{name}: {as_written(raw, 'rad')} is beyond a whole turn: degrees without their unit?"]
