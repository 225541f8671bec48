"""`[over]` of a campaign file: over what each sample is computed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import model_validator

from mahovik.core.motion.document import choice, short_integer
from mahovik.core.stand.fields import Table, refuse, scalar, text, validator
from mahovik.core.stand.units import TIME, QuantityError, show

Kind = Literal["regime", "speeds", "programme", "states"]

KINDS: Mapping[Kind, tuple[str, ...]] = {
    "regime": ("until", "dt", "every", "order", "start"),
    "speeds": ("phases",),
    "programme": ("motion", "servo", "periods", "table", "begin", "dt", "every", "order"),
    "states": (),
}
"""Kinds of run by the key that chooses them, and the further keys of each."""

REQUIRED: Mapping[Kind, tuple[str, ...]] = {"regime": ("until",), "programme": ("motion",)}

DT, EVERY, ORDER = 1e-4, 1e-3, 4
"""s, s: those of `simulate`."""


def _file_or_table(raw: Any) -> Any:
    if not isinstance(raw, str | dict):
        raise QuantityError(f"expected the name of a file, or a table with its keys, found {show(raw)}")
    return raw


def _mapping(raw: Any) -> dict[str, Any]:
    if not isinstance(raw, dict):
        raise QuantityError(f"expected a table of flywheels, found {show(raw)}")
    return raw


def _order(raw: Any) -> int:
    if short_integer(raw) not in (2, 4):
        raise QuantityError(f"{raw}: expected 4 or 2")
    return int(raw)


def _count(raw: Any) -> int:
    if short_integer(raw) < 1:
        raise QuantityError(f"{raw}: expected a number from 1")
    return int(raw)


Seconds = Annotated[float | None, scalar(TIME, above=0.0)]
FileOrTable = Annotated[Any, validator(_file_or_table)]
ByFlywheel = Annotated[dict[str, Any] | None, validator(_mapping)]


class OverTable(Table):
    """`[over]`: exactly one of `regime`, `speeds`, `programme`, `states`, and the keys that it takes."""

    regime: FileOrTable = None
    speeds: ByFlywheel = None
    programme: Annotated[str | None, validator(text)] = None
    states: Annotated[str | None, validator(text)] = None
    until: Seconds = None
    dt: Seconds = None
    every: Seconds = None
    order: Annotated[int | None, validator(_order)] = None
    start: FileOrTable = None
    phases: ByFlywheel = None
    motion: Annotated[str | None, validator(text)] = None
    servo: Annotated[str | None, validator(text)] = None
    periods: Annotated[int | None, validator(_count)] = None
    table: Annotated[int | None, validator(_count)] = None
    begin: Annotated[str | None, choice("settled", "programme", "rest")] = None

    @property
    def kind(self) -> Kind:
        """Kind of the run."""
        return next(kind for kind in KINDS if kind in self.model_fields_set)

    @model_validator(mode="after")
    def _one_kind(self) -> OverTable:
        given = [kind for kind in KINDS if kind in self.model_fields_set]
        if len(given) != 1:
            found = " and ".join(given) if given else "none"
            raise refuse(f"expected exactly one of {', '.join(KINDS)}, found {found}")
        kind = given[0]
        for key in sorted(self.model_fields_set - {kind, *KINDS[kind]}):
            allowed = f"expected {', '.join(KINDS[kind])}" if KINDS[kind] else "it takes no other keys"
            raise refuse(f"not allowed with `{kind}`; {allowed}", key)
        for key in REQUIRED.get(kind, ()):
            if key not in self.model_fields_set:
                raise refuse(f"required with `{kind}`, but missing", key)
        return self
