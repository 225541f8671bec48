"""Write the files of a design: its stand with the programme beside it, both or none."""

from __future__ import annotations

from pathlib import Path

from mahovik.core.motion.programme import programme_text
from mahovik.core.stand.write import dumps
from mahovik.proof.verify.files import write_all
from mahovik.use.design.outcome import Outcome


def save_design(found: Outcome, stand_path: Path, programme_path: Path, of: tuple[str, str]) -> None:
    """Write stand and programme into their folder; `of` names the input files. Raises UsageError."""
    assert found.stand is not None
    assert found.programme is not None
    head = (
        f"# Designed by `mahovik design` from {of[0]} for {of[1]}: relative residual {found.residual:.2g}.\n"
        f"# Its programme is {programme_path.name}.\n"
    )
    texts = {stand_path.name: head + dumps(found.stand), programme_path.name: programme_text(found.programme)}
    write_all(stand_path.parent, texts)
