"""Pinocchio's C++ headers as contestants."""

from __future__ import annotations

import sys
from pathlib import Path

from mahovik.core.stand.masses import inertia_about_center, pose
from mahovik_bench.build import CACHE, NATIVE, Recipe
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Peer

DEFINITIONS = (
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
    "-DNDEBUG",
)
"""Definitions of Pinocchio's CMake target; asserts are off, as in a release."""
ISAS = {"native": ("-march=native",), "v3": ("-march=x86-64-v3",)}


def prefix() -> Path:
    """Where `pin` has its headers. Raises FileNotFoundError where they are not installed, Eigen's among them."""
    for folder in sys.path:
        include = Path(folder) / "cmeel.prefix" / "include"
        if (include / "pinocchio").is_dir() and (include / "eigen3").is_dir():
            return include
    raise FileNotFoundError("pinocchio and eigen3 headers: pip install pin cmeel-eigen cmeel-boost")


def peers(case: Case) -> list[Peer]:
    """Timed for this processor; counted for AVX2, since callgrind knows no AVX-512."""
    include = prefix()
    model = CACHE / f"{case.stand.name}.bodies"
    CACHE.mkdir(parents=True, exist_ok=True)
    lines = [str(case.N + 1)]
    for body in case.stand.bodies:
        position, axes = pose(case.stand, body)
        numbers = (
            *axes.ravel(), *position, body.mass, *body.center_of_mass, *inertia_about_center(body).ravel(),
        )  # fmt: skip
        lines.append(" ".join(repr(float(x)) for x in numbers))
    model.write_text("\n".join(lines) + "\n", encoding="ascii")
    files = {"adapter.cpp": (NATIVE / "pinocchio_peer.cpp").read_text(encoding="utf-8")}
    works = ("forward", "coupled", "torque", "coupled_jacobian")
    cases = []
    for isa, counted in (("native", False), ("v3", True)):
        flags = ("-std=c++17", "-O3", *ISAS[isa], *DEFINITIONS, f"-isystem{include}", f"-isystem{include / 'eigen3'}")
        recipe = Recipe("g++", flags, files, link=("-Wl,--no-undefined",))
        cases.append(Peer("pinocchio", f"-O3 {isa}", works, recipe, str(model), counted=counted, timed=not counted))
    return cases
