"""The start of a run from a file: a state as `eval` reads it, or what `mahovik rest --json` prints."""

from __future__ import annotations

from pathlib import Path

from mahovik.errors import StateError, UsageError
from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.verify.states import read_object, read_request


def load(path: Path, stand: Stand) -> State:
    """The state in a JSON file. Raises UsageError."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise UsageError(f"{path.name}: not UTF-8 text: {error}") from None
    try:
        found = read_object(text)
        inner = found.get("state")
        state = dict(inner) if isinstance(inner, dict) else found
        return read_request(stand, {**state, "want": ["forward"]}).state
    except StateError as error:
        raise UsageError(f"{path.name}: {error}") from None
