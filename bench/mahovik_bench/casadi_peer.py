"""C that CasADi generates of the literal equations, as contestants."""

from __future__ import annotations

import json

from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.cases import Case
from mahovik_bench.peer import Peer

FORMS = {
    "naive": ("forward",),
    "ldl": ("forward", "coupled", "torque"),
    "jacobian": ("forward_jacobian",),
}
DEFINES = {"naive": (), "ldl": ("-DALL_WORKS",), "jacobian": ()}
BUILDS = {"-O2": ("-O2",), "-O3 native": ("-O3", "-march=native")}
LARGEST = {"naive": 12, "ldl": 12, "jacobian": 2}
"""Flywheels beyond which compiling takes more than the budget."""


def peers(case: Case) -> list[Peer]:
    """Each form by each build."""
    adapter = (NATIVE / "casadi_peer.c").read_text(encoding="utf-8")
    found = []
    for form, works in FORMS.items():
        if LARGEST[form] < case.N:
            continue
        folder, effort = generated("write_casadi", str(case.N), form)
        facts = json.loads((folder / "facts.json").read_text(encoding="utf-8"))
        sizes = (f"-DWORK_SIZE={facts['work'] + 1}", f"-DARGUMENTS={facts['arguments'] + 1}")
        text = adapter.replace("WORK(forward)", "WORK(forward_jacobian)") if form == "jacobian" else adapter
        files = {"casadi.c": (folder / "casadi.c").read_text(encoding="utf-8"), "adapter.c": text}
        for build, flags in BUILDS.items():
            recipe = Recipe(
                "gcc", (*sizes, *DEFINES[form], f"-DFLYWHEELS={case.N}", *flags), files, ("casadi.c",), ("-lm",)
            )
            found.append(Peer("casadi", f"{form} {build}", works, recipe, "", effort, counted=build == "-O2"))
    return found
