"""The files of a design: its stand, whole or not at all, and the programme beside it."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from mahovik.design.outcome import Outcome
from mahovik.errors import UsageError
from mahovik.motion.programme import save_programme
from mahovik.stand.write import dumps


def save_design(found: Outcome, stand_path: Path, programme_path: Path, of: tuple[str, str]) -> None:
    """Writes stand and programme; `of` names the files that it was made of. Raises UsageError."""
    assert found.stand is not None
    assert found.programme is not None
    head = (
        f"# Designed by `mahovik design` from {of[0]} for {of[1]}: relative residual {found.residual:.2g}.\n"
        f"# Its programme is {programme_path.name}.\n"
    )
    draft: str | None = None
    try:
        handle, draft = tempfile.mkstemp(prefix=f".{stand_path.name}.", dir=stand_path.absolute().parent)
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(head + dumps(found.stand))
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(draft, 0o666 & ~mask)  # as an ordinary new file
        save_programme(found.programme, programme_path)
        os.replace(draft, stand_path)
        draft = None
    except OSError as error:
        raise UsageError(f"{stand_path}: cannot be written: {error.strerror or error}") from None
    finally:
        if draft is not None:
            Path(draft).unlink(missing_ok=True)
