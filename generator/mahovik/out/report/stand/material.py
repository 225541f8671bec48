"""Common input of all sections of a report."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.out.report.stand.run import Run


@dataclass(frozen=True, eq=False)
class Material:
    """A stand with the other inputs of the report. Files are named without folders: `..._file`, "" if not given.

    state, state_words   at which matrices are shown, and which state that is, in words
    run          of this stand; None: none was given
    programme, motion    of this stand; a motion goes with a programme
    costs        figures of `mahovik cost` for this stand, a target each, as its JSON holds them; none were given: ()
    cost_file    its name
    targets      of `--targets`: processors on which the self-test is run now; "" for none
    """

    stand: Stand
    state: State
    state_words: str
    stand_file: str = ""
    run: Run | None = None
    programme: Programme | None = None
    programme_file: str = ""
    motion: RequiredMotion | None = None
    motion_file: str = ""
    costs: tuple[Mapping[str, Any], ...] = ()
    cost_file: str = ""
    targets: str = ""
