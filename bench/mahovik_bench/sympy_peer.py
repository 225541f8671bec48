"""C that SymPy generates of the literal equations, as contestants."""

from __future__ import annotations

from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.casadi_peer import BUILDS
from mahovik_bench.cases import Case
from mahovik_bench.peer import Peer

LARGEST = 4
"""Flywheels beyond which SymPy takes more than the budget."""


def peers(case: Case) -> list[Peer]:
    """Forward only."""
    if case.N > LARGEST:
        return []
    folder, effort = generated("write_sympy", str(case.N))
    files = {"literal.c": (folder / "literal.c").read_text(encoding="utf-8")}
    files["adapter.c"] = (NATIVE / "sympy_peer.c").read_text(encoding="utf-8")
    return [
        Peer(
            "sympy",
            build,
            ("forward",),
            Recipe("gcc", (f"-DFLYWHEELS={case.N}", *flags), files, ("literal.c",), ("-lm",)),
            "",
            effort,
            counted=build == "-O2",
        )
        for build, flags in BUILDS.items()
    ]
