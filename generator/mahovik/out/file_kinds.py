"""What a file is, by its content: where a reader refuses one of another kind, the message says which it is."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from mahovik.core.stand.files import KINDS, content, parse_toml
from mahovik.core.stand.files import kind_of as kind_of_keys
from mahovik.errors import FileError, UsageError

_TABLE, _ZIP = "a table (CSV)", "a ZIP archive"

EXPECTED = {
    **KINDS, "state": "a state", "campaign": "a campaign file", "influence": "a file of influences", "fmu": "an FMU",
    "map": "a map of variables", "free": "a list of free numbers", "table": _TABLE, "data": "a file of measured data",
}  # fmt: skip
"""What a reader expects, in words."""

_FORMS = {"data": (_TABLE,), "fmu": (_ZIP,)}
"""What files of a kind may look like."""

_OF_STATES = {"position", "quaternion", "angles", "V", "phi", "phi_dot", "want"}

_BY_KEYS: dict[str, Callable[[Mapping[str, Any]], bool]] = {
    "campaign": lambda keys: "vary" in keys and bool(keys.keys() & {"samples", "quantity", "over"}),
    "map": lambda keys: isinstance(keys.get("state"), dict) and bool(keys.keys() & {"forward", "torque", "coupled"}),
    "influence": lambda keys: "A" in keys and bool(keys.keys() & {"B", "U", "ALPHA"}),
    "free": lambda keys: isinstance(keys.get("free"), list),
    "a manifest of generated C": lambda keys: str(keys.get("generator", "")).startswith("mahovik "),
    "what a command printed with --json": lambda keys: {"messages", "ok"} <= keys.keys(),
    "state": lambda keys: not keys.keys() & {"schema", "carrier"} and bool(keys.keys() & _OF_STATES),
}
"""How the keys of files that only commands read show what they are, the surest first."""

_BY_BEGINNING = {
    "<robot": "a URDF", "<mujoco": "an MJCF", "<sdf": "an SDF", "<?xml": "an XML file", "<!--": "an XML file",
    "PK": _ZIP, "\x7fELF": "a program", "ULog": "a flight log of PX4",
}  # fmt: skip


def kind_of(path: str | Path) -> str | None:
    """What a file is, in words; None where it cannot be read or nothing shows it."""
    try:
        text = content(Path(path)).decode("utf-8-sig", "replace")
    except (OSError, ValueError):
        return None
    for beginning, words in _BY_BEGINNING.items():
        if text.lstrip().startswith(beginning):
            return words
    for parse in (json.loads, parse_toml):
        with contextlib.suppress(ValueError, RecursionError):
            keys = parse(text)
            keys = keys if isinstance(keys, dict) else {}
            sure = (words for words, shows in _BY_KEYS.items() if shows(keys))
            kind = next(sure, None)
            return EXPECTED.get(kind, kind) if kind else KINDS.get(kind_of_keys(keys))
    head = text.partition("\n")[0]
    return _TABLE if "," in head and not head.lstrip().startswith(("{", "[", "#")) else None


@contextlib.contextmanager
def expecting(kind: str, *sources: Any) -> Iterator[None]:
    """Where the body refuses one of the sources that is a file of another kind, say which it is, in one line.

    kind  of EXPECTED

    Else a reader lists every key that it does not know. Sources that are no paths are left alone.
    """
    try:
        yield
    except (FileError, UsageError) as error:
        known = (None, EXPECTED[kind], *_FORMS.get(kind, ()))
        for source in sources:
            if isinstance(source, str | Path) and (other := kind_of(source)) not in known:
                line = f"{source}: is {other}, expected {EXPECTED[kind]}"
                raise (type(error)([line]) if isinstance(error, FileError) else UsageError(line)) from None
        raise
