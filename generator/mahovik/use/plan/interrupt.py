"""Ctrl-C in the middle of what must not end there: it is remembered."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def deferred(mark: Callable[[], None], *, again: bool) -> Iterator[None]:
    """Ctrl-C calls `mark` and all goes on; a second one ends it, where `again`. Only in the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def pressed(*_: object) -> None:
        mark()
        if again:
            signal.signal(signal.SIGINT, signal.default_int_handler)

    before = signal.signal(signal.SIGINT, pressed)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
