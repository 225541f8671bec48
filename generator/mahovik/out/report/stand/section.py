"""A section of the report."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Section:
    """One section: `anchor` is its id in the page, `html` trusted markup in which all text is escaped already.

    failures   what it shows as failed, a line each: the page says so at its top, and the command's status is 1
    summary    what the head of the page says of it, in a few words; "" for nothing
    """

    anchor: str
    title: str
    html: str
    failures: tuple[str, ...] = ()
    summary: str = ""
