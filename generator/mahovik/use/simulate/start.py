"""The start of a run from a file: a state as read by `eval`, or the output of `mahovik rest --json`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError, UsageError
from mahovik.nearest import meant
from mahovik.proof.verify.states import KEYS as ALL
from mahovik.proof.verify.states import read_object, read_request, refuse_duplicates

KEYS = ("id", "position", "angles", "quaternion", "V", "phi", "phi_dot")
"""Keys of a state that a start may have."""

REST_KEYS = ("name", "state", "V_dot", "free", "unstable")
"""Keys printed by `mahovik rest --json`."""


HINT = "; the regime gives torques and wrenches"


def load(path: Path, stand: Stand, keys: tuple[str, ...] = KEYS, hint: str = HINT) -> State:
    """The state in a JSON file; `keys` are allowed. Raises UsageError; `hint`: why no others."""
    try:
        text = content(path).decode("utf-8-sig")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise UsageError(f"{path.name}: not UTF-8 text: {error}") from None
    try:
        found = read_object(text)
        refuse_duplicates(found)
        if "state" in found:
            _known(found, REST_KEYS, "")
            found = found["state"]
            if not isinstance(found, dict):
                raise StateError("state: expected an object")
            refuse_duplicates(found)
        _known(found, keys, hint)
        return read_request(stand, {**found, "want": ["forward"]}).state
    except StateError as error:
        raise UsageError(f"{path.name}: {error}") from None


def _known(found: dict[str, Any], keys: tuple[str, ...], hint: str) -> None:
    for key in found:
        if key not in keys:
            if key in ALL:
                raise StateError(f'"{key}" is not part of a start, expected some of {", ".join(keys)}{hint}')
            raise StateError(f'unknown key "{key}"{meant(key, keys)}')
