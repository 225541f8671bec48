"""Faults planted in C by patterns."""

from __future__ import annotations

import re
from collections.abc import Callable


def changed(pattern: str, new: str, count: int = 1) -> Callable[[str], str]:
    """The source with a pattern replaced, which it must hold."""

    def change(text: str) -> str:
        text, found = re.subn(pattern, new, text, count=count)
        assert found
        return text

    return change
