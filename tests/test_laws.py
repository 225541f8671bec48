"""The laws keep their order: what a part of a law may import, and what loading the list of laws costs."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

from mahovik.contract.laws import BODY_LAWS, LAWS
from test_architecture import MODULES, PACKAGE, faults_by_file, imported

LAW_PARTS = {
    "__init__": (),
    "data": ("core.stand.model",),
    "schema": ("core.stand.fields", "core.stand.law", "core.stand.model", "core.stand.shapes", "core.stand.toml",
               "core.stand.units"),
    "random": ("core.stand.draw", "core.stand.model", "core.stand.state"),
    "text": ("core.stand.model",),
    "derive": ("core.derive.attitude", "core.derive.screw", "core.derive.symbols"),
    "lower": ("core.formula.derived", "core.lower.member", "core.lower.units", "core.lower.law",
              "core.lower.laws", "core.lower.library", "core.lower.symbolic", "core.program", "core.stand.model",
              "core.stand.structure"),
    "reference": ("core.stand.model", "core.stand.state", "errors", "proof.reference.array", "proof.reference.pose",
                  "proof.reference.rotation", "proof.reference.screw"),
    "rigorous": ("core.stand.model", "core.stand.state", "errors", "proof.rigorous.ball", "proof.rigorous.rotation",
                 "proof.rigorous.screw"),
    "second": ("core.stand.model", "core.stand.state", "errors", "proof.second.bodies", "proof.second.chart",
               "proof.second.potential", "proof.second.rotation"),
    "scale": ("core.stand.model", "core.stand.state", "proof.reference.array", "proof.reference.pose",
              "proof.verify.scales.parts"),
    "faults": ("core.stand.model", "core.stand.state", "proof.diagnose.edits", "proof.diagnose.fault",
               "proof.reference.array", "proof.reference.bodies", "proof.reference.pieces",
               "proof.reference.pose", "proof.reference.screw", "proof.reference.wrenches"),
    "plan": ("core.stand.model", "errors", "use.plan.array", "use.plan.residual.kinematics",
             "use.plan.residual.slopes", "use.plan.residual.spatial"),
    "mismatch": ("core.stand.model", "use.control.measurement"),
    "loads": ("core.stand.structure", "out.campaign.pose"),
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

    def imports_beyond(path: Path) -> list[str]:
        ours = [n for n in imported(path) if n.startswith("mahovik.")]
        return [n for n in ours if not any(n == v or n.startswith(f"{v}.") for v in vocabulary_of(path))]

    assert faults_by_file(sorted(PACKAGE.glob("laws/*/*.py")), imports_beyond) == {}


@pytest.mark.parametrize("law", [*BODY_LAWS, *LAWS])
def test_a_folder_has_the_whole_law(law: str) -> None:
    """A law is where a reader looks for it: in the C, for every referee, with scale, faults and planning."""
    there = {path.stem for path in (PACKAGE / "laws" / law).glob("*.py")}
    assert there >= {"lower", "reference", "second", "rigorous", "scale", "faults", "plan"}


FILES_WITH_WORD = {"buoyancy": 8, "leg": 10, "suspension": 10}
"""Files outside `laws/` that may have the name of a law in them, at most."""


def files_with(word: str, paths: Iterable[Path]) -> list[Path]:
    """The files that have a word in them, in capitals or not."""
    pattern = re.compile(rf"\b{word}\b", re.IGNORECASE)
    return [path for path in paths if pattern.search(path.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("law", FILES_WITH_WORD)
def test_what_a_law_is_stands_in_its_folder(law: str) -> None:
    """Stages iterate over the laws; outside its folder a law is named in words for people, if at all."""
    outside = [path for path in MODULES if path.relative_to(PACKAGE).parts[0] != "laws"]
    found = files_with(law, outside)
    assert len(found) <= FILES_WITH_WORD[law], found


def test_the_name_of_a_law_is_found(tmp_path: Path) -> None:
    """The name counts as a word of its own."""
    for name, text in (("a", "body.buoyancy"), ("b", "Buoyancy"), ("c", "flywheel_buoyancy = 1")):
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert {path.name for path in files_with("buoyancy", tmp_path.iterdir())} == {"a", "b"}


def test_every_folder_is_listed() -> None:
    """A law that no list has would never act."""
    assert {path.parent.name for path in PACKAGE.glob("laws/*/__init__.py")} == {*LAWS, *BODY_LAWS}


def test_listing_the_laws_loads_none_of_their_parts() -> None:
    """`check` stays quick: neither SymPy nor CasADi comes with the list."""
    code = "import sys, mahovik.contract.laws; assert not {'sympy', 'casadi', 'numpy'} & set(sys.modules), 'loaded'"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_check_loads_no_derivation() -> None:
    """Reading a stand file asks the laws for their schemas, which need no algebra."""
    code = (
        "import sys; from mahovik import stands; from mahovik.core.stand import load; load(stands.path('bench8'));"
        "assert not {'sympy', 'casadi'} & set(sys.modules), 'loaded'"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
