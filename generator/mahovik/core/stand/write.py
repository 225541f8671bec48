"""Stand -> stand file in SI, every float with all its digits: reading it back gives the same Stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from types import MappingProxyType
from typing import Any

from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.laws import carrier_laws, mounted_laws
from mahovik.core.stand.model import Header, Stand
from mahovik.core.stand.toml import text_of

_NONE: Mapping[str, Sequence[str]] = MappingProxyType({})


def document_of(stand: Stand) -> dict[str, Any]:
    """The keys of a stand file, in SI."""
    header = Header(**{f.name: getattr(stand, f.name) for f in fields(Header)})
    laws = [law for kind in carrier_laws() if (law := stand.law(kind)) is not None]
    held = {law.key: [item.as_keys() for item in law.items] for law in laws if isinstance(law, HeldLaw)}
    document = {"schema": 1, **header.as_keys()}
    tables: dict[str, Any] = {}
    for law in (law for law in laws if law.key not in held):
        if law.item is not None:
            document |= law.as_keys()
        tables |= law.as_tables()
    if stand.profile is not None:
        document["stream_profile"] = stand.profile.as_keys()
    document |= {"carrier": stand.carrier.as_keys(), **tables}
    if stand.hold is not None:
        document["hold"] = stand.hold.as_keys() | held
    document |= {
        "instrument": [instrument.as_keys() for instrument in stand.instruments],
        "flywheel": [flywheel.as_keys() for flywheel in stand.flywheels],
        "point": [point.as_keys() for point in stand.points],
    }
    for kind in mounted_laws():
        document[kind.key] = [
            {"mount": body.name, **item.as_keys()} for _, body, law in kind.of(stand) for item in law.items
        ]
    document["task"] = {task.name: task.as_keys() for task in stand.tasks}
    return {key: value for key, value in document.items() if value not in ([], {})}


def dumps(stand: Stand, comments: Mapping[str, Sequence[str]] = _NONE) -> str:
    """The stand as TOML text. `loads(dumps(stand)) == stand`, except all-zero parts, which are absent.

    `comments`: lines over the table of a body or point, by its name.
    """
    return text_of(document_of(stand), comments)
