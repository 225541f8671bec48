"""The laws keep their order: what a part of a law may import, and what loading the list of laws costs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from test_architecture import PACKAGE, each, imported

LAW_PARTS = {
    "__init__": (),
    "data": ("core.stand.model",),
    "schema": ("core.stand.fields", "core.stand.law", "core.stand.model", "core.stand.shapes", "core.stand.toml",
               "core.stand.units"),
    "random": ("core.stand.draw", "core.stand.model", "core.stand.state"),
    "text": ("core.stand.model",),
    "derive": ("core.derive.attitude", "core.derive.screw", "core.derive.symbols"),
    "lower": ("core.formula.derived", "core.lower.fmu.member", "core.lower.fmu.units", "core.lower.law",
              "core.lower.laws", "core.lower.library", "core.lower.symbolic", "core.program", "core.stand.model",
              "core.stand.structure"),
    "reference": ("core.stand.model", "core.stand.state", "errors", "proof.reference.array", "proof.reference.pose",
                  "proof.reference.rotation", "proof.reference.screw"),
    "rigorous": ("core.stand.model", "core.stand.state", "errors", "proof.rigorous.ball", "proof.rigorous.rotation",
                 "proof.rigorous.screw"),
    "second": ("core.stand.model", "core.stand.state", "errors", "proof.second.chart", "proof.second.rotation"),
    "scale": ("core.stand.model", "core.stand.state", "proof.reference.array", "proof.reference.pose",
              "proof.verify.scales.parts"),
    "faults": ("core.stand.model", "core.stand.state", "proof.diagnose.law_fault", "proof.reference.array",
               "proof.reference.pose"),
    "plan": ("core.stand.model", "errors", "use.plan.array", "use.plan.residual.kinematics",
             "use.plan.residual.slopes", "use.plan.residual.spatial"),
    "mismatch": ("core.stand.model", "use.control.measurement"),
    "report": ("core.stand.model", "out.report.stand.markup", "out.report.stand.tie"),
}  # fmt: skip
"""Parts of a law, and all that each may import of the package: the vocabulary of the stage that asks for it, never the
stage itself. Every part may import the law's own `data`; `faults` its `reference` and `lower` its `derive` as well."""


def vocabulary_of(path: Path) -> tuple[str, ...]:
    """Dotted names that the part of a law may import of the package."""
    own = f"mahovik.laws.{path.parent.name}"
    also = {"faults": (f"{own}.reference",), "lower": (f"{own}.derive",)}.get(path.stem, ())
    return (f"{own}.data", *also, *(f"mahovik.{name}" for name in LAW_PARTS[path.stem]))


def test_parts_of_laws_import_the_vocabulary_of_their_stage_only() -> None:
    """A law knows the words in which a stage asks, never the stage: it could not be read without it otherwise."""

    def beyond(path: Path) -> list[str]:
        ours = [n for n in imported(path) if n.startswith("mahovik.")]
        return [n for n in ours if not any(n == v or n.startswith(f"{v}.") for v in vocabulary_of(path))]

    assert each(sorted(PACKAGE.glob("laws/*/*.py")), beyond) == {}


def test_listing_the_laws_loads_none_of_their_parts() -> None:
    """`check` stays quick: neither SymPy nor CasADi comes with the list."""
    code = "import sys, mahovik.laws; assert not {'sympy', 'casadi', 'numpy'} & set(sys.modules), 'loaded'"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_check_loads_no_derivation() -> None:
    """Reading a stand file asks the laws for their schemas, which need no algebra."""
    code = (
        "import sys; from mahovik import stands; from mahovik.core.stand import load; load(stands.path('bench8'));"
        "assert not {'sympy', 'casadi'} & set(sys.modules), 'loaded'"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
