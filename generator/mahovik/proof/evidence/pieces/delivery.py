"""The C in the folder is what the generator makes of the stand file, in another process, with nothing kept."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import mahovik
from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged


def _command(subject: Subject) -> str:
    return f"mahovik generate {subject.stand_file} -o c{subject.option} --check --no-cache"


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.emit.manifest import digest

    tell("generate again")
    words = _command(subject).split()
    package = str(Path(mahovik.__file__).resolve().parent.parent)
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH"))))
    # another seed of hashes: an order that depends on it would show
    environment = os.environ | {"PYTHONPATH": path, "PYTHONHASHSEED": "20260"}
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=subject.folder, env=environment, capture_output=True, text=True, check=False
    )
    files = sorted(subject.c.iterdir())
    rows = tuple((f"c/{each.name}", digest(each.read_bytes())) for each in files)
    good = done.returncode == 0
    figure = f"{len(files)} files, byte for byte" if good else "the C is not what the stand file gives"
    said = done.stdout + done.stderr
    notes = () if good else tuple(said.splitlines())
    tools = (f"mahovik {mahovik.__version__}", f"Python {sys.version.split()[0]}")
    return Outcome(judged(good), figure, tools, Table(("file", "SHA-256"), rows), notes, {"output.txt": said})


PIECE = Piece(
    name="delivery",
    title="The C is what the stand file gives",
    shows=(
        "The folder `c/` was generated from the stand file beside it, and again by another process that derived every "
        "formula again: the same bytes. All other pieces are about these files."
    ),
    limits="That the stand file describes the real machine: masses, mountings, unbalances are taken as it has them.",
    command=_command,
    run=_run,
)
