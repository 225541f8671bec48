"""The example stands with their motions, as planning gets them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import mahovik.stands
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.use.plan.problem import Problem

STANDS = Path(mahovik.stands.__file__).parent


@cache
def example(stand: str, motion: str | None = None) -> tuple[Stand, RequiredMotion]:
    """A stand and a motion that stands beside it."""
    found = load(STANDS / f"{stand}.toml")
    return found, load_motion(STANDS / f"{motion or stand}.motion.json", found)


def problem(stand: str, motion: str | None = None, **changed: Any) -> Problem:
    """The planning problem of an example, with fields of the motion changed."""
    found, required = example(stand, motion)
    return Problem.of(found, replace(required, **changed))
