"""mahovik's own C as contestants; python -m mahovik_bench.own FOLDER N [batch] writes it."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from mahovik.contract.functions import BATCH_FUNCTIONS
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate_all
from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.cases import Case, case
from mahovik_bench.contestant import Peer

WORKS = ("forward", "coupled", "torque", "step", "inverse", "inverse_fast", "forward_jacobian", "coupled_jacobian")


@dataclass(frozen=True)
class Build:
    """How the C is compiled; `counted`: by callgrind as well."""

    name: str
    flags: tuple[str, ...]
    counted: bool = False


SCALAR = Build("-O2", ("-O2", "-ffp-contract=off"), counted=True)
"""What firmware is built with; callgrind counts it."""
BUILDS = (
    SCALAR,
    Build("-O3 native", ("-O3", "-march=native", "-ffp-contract=off")),
    Build("-O3 native fma", ("-O3", "-march=native", "-ffp-contract=fast")),
)
BATCH = Build("batch native", ("-O3", "-march=native", "-ffp-contract=off"))
"""States side by side: few enough per call that records stay in the first cache."""
STATES = 64


def peers(of: Case) -> list[Peer]:
    """A contestant a build."""
    return [*(peer(of, build) for build in BUILDS), _batch(of)]


def peer(of: Case, build: Build) -> Peer:
    """One state in a call."""
    name = of.stand.name
    folder, effort = generated("own", str(of.N))
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}.[ch]"))}
    files["own_peer.c"] = (NATIVE / "own_peer.c").read_text(encoding="utf-8")
    flags = ("-std=c99", f"-DSTAND={name}", f'-DHEADER="{name}.h"', f"-DFLYWHEELS={of.N}", *build.flags)
    recipe = Recipe("gcc", flags, files, (f"{name}.c",))
    return Peer("mahovik", build.name, WORKS, recipe, "", effort, counted=build.counted)


def _batch(of: Case) -> Peer:
    """Many states in a call."""
    name = of.stand.name
    folder, effort = generated("own", str(of.N), "batch")
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}*.[ch]"))}
    files["batch_peer.c"] = (NATIVE / "batch_peer.c").read_text(encoding="utf-8")
    shape = (f"-DSTAND={name}", f'-DHEADER="{name}_batch.h"', f"-DFLYWHEELS={of.N}", f"-DSTATES={STATES}")
    recipe = Recipe("gcc", ("-std=c99", *shape, *BATCH.flags), files, (f"{name}_batch.c",))
    return Peer("mahovik", BATCH.name, BATCH_FUNCTIONS, recipe, "", effort, states=STATES)


def main() -> None:
    """The files of `generate`, with `batch` those of batches too, nothing else."""
    folder, N = Path(sys.argv[1]), int(sys.argv[2])
    stand = case(N).stand
    made = generate_all(stand)
    batch = batch_files(stand, made) if "batch" in sys.argv[3:] else {}
    for name, text in {**made.files, **batch}.items():
        (folder / name).write_text(text, encoding="ascii")


if __name__ == "__main__":
    main()
