"""Instructions of a call, counted exactly by callgrind: the same in every run of one binary."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from mahovik.errors import ToolchainError
from mahovik_bench.build import Built, tool
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Peer
from mahovik_bench.works import WORKS

HEADER = Path("/usr/include/valgrind/callgrind.h")


def available() -> bool:
    """Is there a valgrind with its header?"""
    return shutil.which("valgrind") is not None and HEADER.is_file()


def instructions(peer: Peer, built: Built, case: Case) -> dict[str, int]:
    """Instructions a work at the case's first state. Raises ToolchainError where callgrind cannot run the peer."""
    symbols = [WORKS[name].symbol for name in peer.works]
    with tempfile.TemporaryDirectory(prefix="mahovik-") as folder:
        flat = Path(folder) / "input"
        flat.write_bytes(case.flat[0].tobytes())
        out = Path(folder) / "counts"
        options = ["--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}"]
        program = [str(tool("count.c", "-ldl")), str(built.library), peer.model, str(flat), *symbols]
        done = subprocess.run(["valgrind", *options, *program], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            said = done.stderr.strip().splitlines()
            raise ToolchainError(f"callgrind of {peer.name}: {said[-1] if said else done.returncode}")
        dumps = dict(read(path.read_text(encoding="utf-8")) for path in sorted(Path(folder).glob("counts.*")))
    return {name: dumps[WORKS[name].symbol] - dumps["nothing"] for name in peer.works}


def read(dump: str) -> tuple[str, int]:
    """Function of a callgrind dump, and its instructions."""
    trigger = re.search(r"^desc: Trigger: Client Request: (\w+)$", dump, re.MULTILINE)
    total = re.search(r"^(?:summary|totals): (\d+)", dump, re.MULTILINE)
    return (trigger[1] if trigger else "", int(total[1]) if total else 0)
