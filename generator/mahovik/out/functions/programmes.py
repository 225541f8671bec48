"""`verify_programme`: whether a programme makes the carrier move as required."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mahovik.core.motion.motion_file import motion_of_slew
from mahovik.core.motion.programme import Programme as CoreProgramme
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import (
    Keys,
    StandGiven,
    motion_of,
    programme_of,
)
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell

if TYPE_CHECKING:
    from mahovik.proof.verify.check import Check

MotionGiven = RequiredMotion | Keys | str | Path
ProgrammeGiven = CoreProgramme | Keys | str | Path


def _of_course(motion: RequiredMotion | Slew, programme: CoreProgramme) -> RequiredMotion:
    """The motion; of a slew, with the course that the programme keeps."""
    return motion_of_slew(motion, programme) if isinstance(motion, Slew) else motion


class Verdict(Table):
    """Verdict on a programme: a row per item, with what was found and what is accepted; `passed` if all are right."""

    index = "item"

    def __init__(self, stand: CoreStand, motion: RequiredMotion, findings: Sequence[Check]) -> None:
        self.stand, self.motion, self.findings = stand, motion, tuple(findings)

    @property
    def columns(self) -> tuple[Column, ...]:
        return (
            Column("item", "", np.array([item.quantity for item in self.findings], dtype=object)),
            Column("found", "", np.array([item.value for item in self.findings])),
            Column("accepted", "", np.array([item.limit for item in self.findings])),
            Column("passed", "", np.array([not item.failed for item in self.findings])),
            Column("words", "", np.array([item.words for item in self.findings], dtype=object)),
        )

    @property
    def passed(self) -> bool:
        """Whether every item is right."""
        return not any(item.failed for item in self.findings)

    def __repr__(self) -> str:
        failed = [item.quantity for item in self.findings if item.failed]
        return f"<Verdict on {self.motion.name}: {'passed' if self.passed else 'refused, ' + ', '.join(failed)}>"


def verify_programme(
    stand: StandGiven,
    motion: MotionGiven | Slew,
    programme: ProgrammeGiven,
    *,
    tolerance: float | None = None,
    against: str | Path | None = None,
    name: str = "programme",
    progress: OnProgress | None = None,
) -> Verdict:
    """Verify that a programme makes the carrier move as required, by the literal reference alone.

    tolerance  of the relative residual; None: 1e-6, with damping of V|V| 1e-5
    against    folder of the C that `generate --programme` wrote: each of its functions is judged too; `name`: of that C

    Raises StandError, MotionError, ProgrammeError, ToolchainError.
    """
    from mahovik.proof.verify.programme.verification import ProgrammeCase
    from mahovik.proof.verify.programme.verification import verify_programme as judged

    own = Stand.of(stand)
    found = programme_of(programme)
    required = _of_course(motion, found) if isinstance(motion, Slew) else motion_of(motion, own, found)
    tell(progress, Progress("by the reference"))
    findings = judged(own, required, found, tolerance=tolerance)
    if against is not None and not all(item.failed for item in findings):
        from mahovik.proof.verify.exported import verify_compiled

        findings += verify_compiled(own, ProgrammeCase.of(own, required, found, tolerance), Path(against), name)
    return Verdict(own, required, findings)
