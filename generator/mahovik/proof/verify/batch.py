"""The batch C that lies in a folder: is it what this version generates for the stand?"""

from __future__ import annotations

from pathlib import Path

from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import Generated
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.verify.compare import Row

QUANTITY = "batch C = as generated, byte for byte"


def batch_row(stand: Stand, generated: Generated, folder: Path) -> Row | None:
    """The verdict on `<stand>_batch.h` and `<stand>_batch.c` in a folder, by their bytes; None where neither is there.

    `generated`: the C of the element type and lanes that lie there. Batches are of one lane and not fast: beside
    other C they fail.
    """
    paths = [folder / f"{stand.name}_batch.{kind}" for kind in ("h", "c")]
    if not any(path.is_file() for path in paths):
        return None
    row = Row("", QUANTITY, verdict="ok")
    try:
        expected = batch_files(stand, generated)
    except UsageError:
        row.verdict, row.reason = "FAILED", f"{paths[0].stem}: there is none of C with lanes, or fast: remove it"
        return row
    for path in paths:
        if not path.is_file():
            row.verdict, row.reason = "FAILED", f"{path.name} is missing: generate it again with --batch"
        elif path.read_bytes() != expected[path.name].encode("utf-8"):
            row.verdict = "FAILED"
            row.reason = f"{path.name} is not what this version generates: generate it again with --batch"
    return row
