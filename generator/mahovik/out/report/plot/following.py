"""Panels of a run that follows a programme: required and achieved motion at its end, and the error all along."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mahovik.out.report.plot.panel import Array, Panel, family

SHOWN = 300
"""Samples at the end of a run in which one sees the motion itself."""

PARTS = (("O1, mm", ("x", "y", "z"), "m"), ("attitude, mrad", ("psi", "theta", "phi"), "rad"))


def follows(columns: Mapping[str, Array]) -> bool:
    """Does the run have what was required?"""
    names = (f"{kind}{name} [{unit}]" for _, names, unit in PARTS for name in names for kind in ("", "required_"))
    return all(name in columns for name in names)


def end(columns: Mapping[str, Array]) -> dict[str, Array]:
    """The last samples of all columns."""
    return {name: values[-SHOWN:] for name, values in columns.items()}


def panels(columns: Mapping[str, Array]) -> list[Panel]:
    """Motion about its mean over the last samples, with what is required; errors about their mean at the end."""
    t = columns["t [s]"]
    last = slice(max(0, len(t) - SHOWN), len(t))
    motion, errors = [], []
    for quantity, names, unit in PARTS:
        achieved, required = (
            1e3 * np.stack([columns[f"{kind}{name} [{unit}]"] for name in names], axis=1) for kind in ("", "required_")
        )
        about, mean = achieved[last].mean(axis=0), required[last].mean(axis=0)
        lines = family(names, t[last], achieved[last] - about)
        wanted = family(["", "", ""], t[last], required[last] - mean, dashed=True)
        motion.append(Panel(f"{quantity}, about the mean, at the end; dashed: required", (*lines, *wanted)))
        errors.append(
            Panel(
                f"error of {quantity}, about its mean at the end", family(names, t, achieved - required - about + mean)
            )
        )
    return [*motion, *errors]
