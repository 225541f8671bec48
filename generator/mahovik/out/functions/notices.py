"""Progress and warnings of a function that works."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple


class MahovikWarning(UserWarning):
    """Something plausible but doubtful: a step that is long, a speed beyond a motor's."""


def warn(words: str) -> None:
    """Warn the caller of the Python interface; commands print it as a line."""
    warnings.warn(words, MahovikWarning, stacklevel=3)


class Progress(NamedTuple):
    """How far a function is: what it does, and how much of it is done, of `total`; None: it is not known."""

    words: str
    done: float | None = None
    total: float | None = None


OnProgress = Callable[[Progress], None]


def tell(progress: OnProgress | None, now: Progress) -> None:
    """Tell the caller how far a function is, if it has asked."""
    if progress is not None:
        progress(now)
