"""Figures of an identification: of each number, and of each channel."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Parameter:
    """An estimated number in SI, its standard error (NaN where it has none), and its value in the stand file."""

    path: str
    value: float
    unit: str
    standard_error: float
    before: float


@dataclass(frozen=True)
class ChannelFit:
    """One channel: rms of what is left, SI; share of the rms of the data, NaN if these are constant; offset, SI."""

    unit: str
    residual: float
    share: float
    offset: float
