"""mahovik's own C as contestants."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.contract.functions import BATCHED
from mahovik.core.emit.generate import host_lanes
from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.cases import Case
from mahovik_bench.peer import Peer

WORKS = ("forward", "coupled", "torque", "step", "inverse", "inverse_fast", "forward_jacobian", "coupled_jacobian")


@dataclass(frozen=True)
class Build:
    """How the C is made. `lanes`: of the generator; None: the host's number for this N."""

    name: str
    flags: tuple[str, ...]
    lanes: int | None = None
    counted: bool = False


SCALAR = Build("-O2", ("-O2", "-ffp-contract=off"), lanes=1, counted=True)
"""What firmware is built with; callgrind counts it."""
LANES = Build("lanes native", ("-O3", "-march=native", "-ffp-contract=off"))
"""Flywheels across the lanes of the host's vectors."""
BUILDS = (
    SCALAR,
    Build("-O3 native", ("-O3", "-march=native", "-ffp-contract=off"), lanes=1),
    Build("-O3 native fma", ("-O3", "-march=native", "-ffp-contract=fast"), lanes=1),
    LANES,
    Build("8 lanes native", ("-O3", "-march=native", "-ffp-contract=off"), lanes=8),
    Build("lanes native fma", ("-O3", "-march=native", "-ffp-contract=fast")),
)


BATCH = Build("batch native", ("-O3", "-march=native", "-ffp-contract=off"), lanes=1)
"""States side by side: few enough per call that records stay in the first cache."""
STATES = 64


def lanes(build: Build, N: int) -> int:
    """The argument of the generator."""
    return host_lanes(N) if build.lanes is None else build.lanes


def peers(case: Case) -> list[Peer]:
    """A contestant a build."""
    return [*(peer(case, build) for build in BUILDS), _batch(case)]


def peer(case: Case, build: Build) -> Peer:
    """One state in a call."""
    name = case.stand.name
    folder, effort = generated("write_own", str(case.N), str(lanes(build, case.N)))
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}.[ch]"))}
    files["own_peer.c"] = (NATIVE / "own_peer.c").read_text(encoding="utf-8")
    flags = ("-std=c99", f"-DSTAND={name}", f'-DHEADER="{name}.h"', f"-DFLYWHEELS={case.N}", *build.flags)
    recipe = Recipe("gcc", flags, files, (f"{name}.c",))
    return Peer("mahovik", build.name, WORKS, recipe, "", effort, counted=build.counted)


def _batch(case: Case) -> Peer:
    """Many states in a call."""
    name = case.stand.name
    folder, effort = generated("write_own", str(case.N), str(lanes(BATCH, case.N)), "batch")
    files = {path.name: path.read_text(encoding="ascii") for path in sorted(folder.glob(f"{name}*.[ch]"))}
    files["batch_peer.c"] = (NATIVE / "batch_peer.c").read_text(encoding="utf-8")
    shape = (f"-DSTAND={name}", f'-DHEADER="{name}_batch.h"', f"-DFLYWHEELS={case.N}", f"-DSTATES={STATES}")
    recipe = Recipe("gcc", ("-std=c99", *shape, *BATCH.flags), files, (f"{name}_batch.c",))
    return Peer("mahovik", BATCH.name, BATCHED, recipe, "", effort, states=STATES)
