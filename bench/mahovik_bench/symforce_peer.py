"""C++ that SymForce generates of the literal equations, as contestants."""

from __future__ import annotations

from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.casadi_peer import BUILDS
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Peer
from mahovik_bench.pinocchio_peer import prefix

LARGEST = 12
"""Flywheels beyond which it takes more than the budget."""


def peers(case: Case) -> list[Peer]:
    """Forward only."""
    if case.N > LARGEST:
        return []
    folder, effort = generated("write_symforce", str(case.N))
    files = {"literal.h": (folder / "literal.h").read_text(encoding="utf-8")}
    files["adapter.cpp"] = (NATIVE / "symforce_peer.cpp").read_text(encoding="utf-8")
    include = f"-isystem{prefix() / 'eigen3'}"
    return [
        Peer(
            "symforce",
            build,
            ("forward",),
            Recipe("g++", ("-std=c++17", "-DNDEBUG", f"-DFLYWHEELS={case.N}", include, *flags), files),
            "",
            effort,
            counted=build == "-O2",
        )
        for build, flags in BUILDS.items()
    ]
