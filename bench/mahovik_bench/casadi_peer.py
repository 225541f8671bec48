"""C that CasADi generates of the literal equations, and of a table of harmonics found by hand, as contestants."""

from __future__ import annotations

import json
import os

from mahovik_bench.build import NATIVE, Recipe, generated
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Peer

FORMS = {
    "naive": ("forward",),
    "ldl": ("forward", "coupled", "torque"),
    "torque": ("torque",),
    "jacobian": ("forward_jacobian",),
    "table": ("forward", "coupled", "torque"),
}
"""Works of each form. `torque` is one of `ldl`, alone: for numbers of flywheels at which the others take long."""
BUILDS = {"-O2": ("-O2",), "-O3 native": ("-O3", "-march=native")}
USUAL = {"naive": range(13), "ldl": range(13), "torque": range(13, 65), "jacobian": range(3), "table": range(65)}
"""Flywheels for which compiling fits into the budget."""
PATIENT = {**USUAL, "ldl": range(65), "torque": range(0)}
"""Flywheels for `full --patient`: compiling a library takes a quarter of an hour and more."""


def peers(case: Case) -> list[Peer]:
    """Each form by each build."""
    allowed = PATIENT if os.environ.get("MAHOVIK_BENCH_PATIENT") else USUAL
    adapter = (NATIVE / "casadi_peer.c").read_text(encoding="utf-8")
    cases = []
    for form, works in FORMS.items():
        if case.N not in allowed[form]:
            continue
        folder, effort = generated("write_casadi", str(case.N), form)
        facts = json.loads((folder / "facts.json").read_text(encoding="utf-8"))
        sizes = (f"-DWORK_SIZE={facts['work'] + 1}", f"-DARGUMENTS={facts['arguments'] + 1}")
        text = adapter + "".join(f"WORK({work})\n" for work in works)
        files = {"casadi.c": (folder / "casadi.c").read_text(encoding="utf-8"), "adapter.c": text}
        shown = "ldl" if form == "torque" else form
        for build, flags in BUILDS.items():
            recipe = Recipe("gcc", (*sizes, f"-DFLYWHEELS={case.N}", *flags), files, ("casadi.c",), ("-lm",))
            cases.append(Peer("casadi", f"{shown} {build}", works, recipe, "", effort, counted=build == "-O2"))
    return cases
