"""mahovik's own C as contestants."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.contract.functions import BATCH_FUNCTIONS
from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.cases import Case
from mahovik_bench.peer import Peer

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


def peers(case: Case) -> list[Peer]:
    """A contestant a build."""
    return [*(peer(case, build) for build in BUILDS), _batch(case)]


def peer(case: Case, build: Build) -> Peer:
    """One state in a call."""
    name = case.stand.name
    folder, effort = generated("write_own", str(case.N))
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}.[ch]"))}
    files["own_peer.c"] = (NATIVE / "own_peer.c").read_text(encoding="utf-8")
    flags = ("-std=c99", f"-DSTAND={name}", f'-DHEADER="{name}.h"', f"-DFLYWHEELS={case.N}", *build.flags)
    recipe = Recipe("gcc", flags, files, (f"{name}.c",))
    return Peer("mahovik", build.name, WORKS, recipe, "", effort, counted=build.counted)


def _batch(case: Case) -> Peer:
    """Many states in a call."""
    name = case.stand.name
    folder, effort = generated("write_own", str(case.N), "batch")
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}*.[ch]"))}
    files["batch_peer.c"] = (NATIVE / "batch_peer.c").read_text(encoding="utf-8")
    shape = (f"-DSTAND={name}", f'-DHEADER="{name}_batch.h"', f"-DFLYWHEELS={case.N}", f"-DSTATES={STATES}")
    recipe = Recipe("gcc", ("-std=c99", *shape, *BATCH.flags), files, (f"{name}_batch.c",))
    return Peer("mahovik", BATCH.name, BATCH_FUNCTIONS, recipe, "", effort, states=STATES)
