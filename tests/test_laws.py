"""The laws keep their order: what a part of a law may import, and what loading the list of laws costs."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest

from mahovik.contract.laws import BODY_LAWS, LAWS
from test_architecture import MODULES, PACKAGE, faults_by_file, imported, imports_between, module_name

LAW_PARTS = {
    "__init__": (),
    "data": ("core.stand",),
    "schema": ("core.stand",),
    "random": ("core.stand",),
    "text": ("core.stand",),
    "units": ("core.stand",),
    "steps": ("core.stand",),
    "derive": ("core.derive",),
    "lower": ("core.stand", "core.program", "core.formula", "core.lower"),
    "reference": ("core.stand", "errors", "proof.reference"),
    "rigorous": ("core.stand", "errors", "proof.rigorous"),
    "second": ("core.stand", "errors", "proof.second"),
    "scale": ("core.stand", "proof.reference", "proof.verify"),
    "faults": ("core.stand", "proof.reference", "proof.diagnose"),
    "terms": ("core.stand", "proof.reference", "proof.diagnose"),
    "actuator": ("core.stand",),
    "plan": ("core.stand", "errors", "use.plan"),
    "mismatch": ("core.stand", "use.control"),
    "regressor": ("core.stand", "use.regressor"),
    "loads": ("core.stand", "out.campaign"),
    "strips": ("core.stand",),
    "report": ("core.stand", "out.report"),
}
"""Parts of a law: the stage that asks for each comes last, before it those whose words the stage itself uses. Every
part may import the law's own `data`; `faults` and `terms` its `reference`,
`lower` its `derive`, `lower` and `plan` the `strips` of a quadrature, `schema` and `text` its `units` as well."""


def imports_of_package() -> dict[str, set[str]]:
    """Modules of the package that each of its modules imports."""
    return imports_between({module_name(path): imported(path) for path in MODULES})


def iterating(graph: Mapping[str, set[str]]) -> set[str]:
    """Modules that ask the lists of laws, and those that import such a module, themselves or through others."""
    found = {module for module, others in graph.items() if "mahovik.contract.laws" in others}
    while more := {module for module, others in graph.items() if others & found} - found:
        found |= more
    return found


def beyond_vocabulary(path: Path, graph: Mapping[str, set[str]]) -> set[str]:
    """Imports of a law's part that lie in no stage of its own, or reach a module that iterates over the laws."""
    own = f"mahovik.laws.{path.parent.name}"
    more = {
        "faults": ("reference",),
        "terms": ("reference",),
        "lower": ("derive", "strips"),
        "plan": ("strips",),
        "schema": ("units",),
        "text": ("units",),
    }
    parts = ("data", *more.get(path.stem, ()))
    stages = tuple(f"mahovik.{stage}." for stage in LAW_PARTS[path.stem])
    imports = graph[module_name(path)] - {f"{own}.{part}" for part in parts}
    return {name for name in imports if not f"{name}.".startswith(stages)} | imports & iterating(graph)


def test_parts_of_laws_import_the_vocabulary_of_their_stage_only() -> None:
    """A part imports nothing that iterates over the laws, itself or through others: what it imports are the words in
    which its stage asks, and the part can be read without the stage."""
    graph = imports_of_package()
    assert faults_by_file(sorted(PACKAGE.glob("laws/*/*.py")), lambda path: beyond_vocabulary(path, graph)) == {}


@pytest.mark.parametrize(
    ("part", "module", "found"),
    [
        ("reference", "mahovik.proof.reference.assembly", True),  # through the wrenches, which iterate
        ("reference", "mahovik.proof.reference.screw", False),
        ("reference", "mahovik.proof.rigorous.screw", True),
        ("lower", "mahovik.core.lower.library", True),
        ("lower", "mahovik.core.lower.function_set", False),
        ("lower", "mahovik.laws.leg.derive", False),
        ("rigorous", "mahovik.laws.leg.reference", True),
        ("plan", "mahovik.laws.weight.data", True),
    ],
)
def test_an_import_beyond_the_vocabulary_is_found(part: str, module: str, found: bool) -> None:
    """A module that iterates, the words of another stage, another part of the law, another law."""
    graph = imports_of_package()
    path = PACKAGE / "laws" / "leg" / f"{part}.py"
    graph[module_name(path)] = {module}
    assert beyond_vocabulary(path, graph) == ({module} if found else set())


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
