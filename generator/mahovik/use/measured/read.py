"""Files of measured data as recordings of a stand."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from mahovik.core.stand.model import Stand
from mahovik.use.measured.recording import Recording


def read_recordings(paths: Iterable[Path], stand: Stand) -> tuple[Recording, ...]:
    """The runs of some files of measured data, matched to a stand. Raises DataError."""
    raise NotImplementedError
