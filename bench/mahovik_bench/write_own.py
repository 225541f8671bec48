"""Writes mahovik's C of a case: python -m mahovik_bench.write_own FOLDER N [batch]."""

from __future__ import annotations

import sys
from pathlib import Path

from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate_all
from mahovik_bench.cases import case


def main() -> None:
    """The files of `generate`, with `batch` those of batches too, nothing else."""
    folder, N = Path(sys.argv[1]), int(sys.argv[2])
    stand = case(N).stand
    generated = generate_all(stand)
    batch = batch_files(stand, generated) if "batch" in sys.argv[3:] else {}
    for name, text in {**generated.files, **batch}.items():
        (folder / name).write_text(text, encoding="ascii")


if __name__ == "__main__":
    main()
