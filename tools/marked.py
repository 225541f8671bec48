"""What a tool writes into a page, between its marks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path


def put(page: Path, begin: str, end: str, lines: Sequence[str]) -> None:
    """Puts lines in place of what stands between the marks `begin` and `end` of a page."""
    before, rest = page.read_text(encoding="utf-8").split(begin)
    after = rest.split(end)[1]
    page.write_text("\n".join([before + begin, *lines, end + after]), encoding="utf-8", newline="\n")
