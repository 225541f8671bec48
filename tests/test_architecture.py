"""The house keeps its order: who may import whom, where C is spelt, how long a file may be."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]
PACKAGE = REPOSITORY / "generator" / "mahovik"
TEMPLATES = REPOSITORY / "templates"
MODULES = sorted(PACKAGE.rglob("*.py"))
SOURCES = sorted([*MODULES, *(REPOSITORY / "tests").rglob("*.py"), *(REPOSITORY / "tools").rglob("*.py")])

STAGES = (
    ("__main__",),
    ("out.cli",),
    ("out.report",),
    ("out.export",),
    ("out.foreign",),
    ("out.api",),
    ("use.study",),
    ("use.design",),
    ("use.control",),
    ("use.plan",),
    ("use.simulate",),
    ("proof.evidence",),
    ("proof.diagnose",),
    ("proof.cost",),
    ("proof.verify",),
    ("proof.reference", "proof.rigorous", "proof.second"),
    ("core.toolchain",),
    ("core.emit",),
    ("core.lower",),
    ("core.formula",),
    ("core.derive",),
    ("core.routines",),
    ("core.program",),
    ("core.motion",),
    ("core.stand",),
    ("stands",),
    ("contract", "errors", "laws", "nearest"),
    ("mahovik",),
)
"""From the top of the house down; names on one floor never import one another. `mahovik` is the package itself."""

WINGS = ("core", "proof", "use", "out")
"""Folders of stages, each with one purpose; what it is stands in its `__init__`."""

FRONT_DOOR = {"mahovik": {"out.api", "errors", "core.stand"}}
"""`import mahovik` offers what these have, and loads it when it is asked for: the only imports that point up."""

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
stage itself. Every part may import the law's own `data`; `faults` its `reference` as well."""

FLOOR = {name: floor for floor, names in enumerate(STAGES) for name in names}
FLOOR |= {f"laws.{part}": -1 for part in LAW_PARTS}  # loaded by name, so that no stage imports one

ONLY = {
    "proof.reference": {"contract", "laws", "errors", "core.stand", "numpy"},
    "proof.rigorous": {"contract", "laws", "errors", "core.stand", "flint"},
    "core.lower": {
        "contract",
        "core.routines",
        "core.formula",
        "core.derive",
        "core.program",
        "core.stand",
        "errors",
        "laws",
        "numpy",
    },
    "core.formula": {"core.derive", "errors", "sympy"},
    "core.derive": {"errors", "sympy"},
    "core.program": {"contract", "errors", "numpy"},
    "core.routines": {"contract", "errors", "core.program", "mpmath", "numpy"},
    "contract": set(),
    "errors": set(),
    "laws": set(),
    "nearest": set(),
}  # fmt: skip
"""Where the house is stricter still: all that a stage may import, besides the standard library and itself."""


def name_of(path: Path) -> str:
    """How a file is called in a report of this test."""
    return path.relative_to(REPOSITORY).as_posix()


def stage_of(path: Path) -> str:
    """The stage a module belongs to."""
    parts = path.relative_to(PACKAGE).parts
    if parts[0] == "laws" and len(parts) == 3:
        return f"laws.{path.stem}"
    if parts[0] in WINGS:
        return f"{parts[0]}.{parts[1]}" if len(parts) > 2 else "mahovik"
    return "mahovik" if parts[0] == "__init__.py" else parts[0].removesuffix(".py")


def tree_of(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def imported(path: Path) -> Iterator[str]:
    """Dotted names that a module imports, in functions and for types too, and those it imports by a string."""
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)}: relative import"
            assert node.module is not None
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            function = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if function in ("import_module", "__import__"):
                yield str(node.args[0].value)


def target(name: str) -> str:
    """Stage or third-party package of a dotted name; "" for the standard library."""
    parts = name.split(".")
    if parts[0] != "mahovik":
        return "" if parts[0] in sys.stdlib_module_names else parts[0]
    name = ".".join(parts[1:3]) if len(parts) > 2 and parts[1] in WINGS else ".".join(parts[1:2])
    if len(parts) > 3 and parts[1] == "laws":
        name = f"laws.{parts[3]}"
    return name if name in FLOOR else "mahovik"


def strings(path: Path) -> Iterator[tuple[int, str]]:
    """String constants with their lines, docstrings left out."""
    tree = tree_of(path)
    documentation = {
        id(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documentation:
            yield node.lineno, node.value


def each(paths: Iterable[Path], wrong: Callable[[Path], object]) -> dict[str, object]:
    """What is wrong, by file."""
    return {name_of(path): found for path in paths if (found := wrong(path))}


def of(stage: str) -> list[Path]:
    """The modules of a stage."""
    return [path for path in MODULES if stage_of(path) == stage]


stages = pytest.mark.parametrize("stage", sorted(FLOOR))


def test_every_module_has_a_floor() -> None:
    """A new stage takes its place in the list above."""
    assert {stage_of(path) for path in MODULES} <= set(FLOOR)


@stages
def test_imports_point_down(stage: str) -> None:
    """A stage imports lower stages only; those of one floor never one another."""

    def upward(path: Path) -> list[str]:
        known = {stage} | FRONT_DOOR.get(stage, set())
        return [n for n in imported(path) if (t := target(n)) in FLOOR and t not in known and FLOOR[t] <= FLOOR[stage]]

    if not stage.startswith("laws."):
        assert each(of(stage), upward) == {}


def vocabulary_of(path: Path) -> tuple[str, ...]:
    """Dotted names that the part of a law may import of the package."""
    own = f"mahovik.laws.{path.parent.name}"
    also = (f"{own}.reference",) if path.stem == "faults" else ()
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


@pytest.mark.parametrize("stage", ONLY)
def test_strict_stages_import_only_what_they_may(stage: str) -> None:
    """References and derivations share nothing but the stand; what is lowered comes from the derivation."""
    allowed = ONLY[stage] | {stage, "", "mahovik"}
    assert of(stage)
    assert each(of(stage), lambda path: [n for n in imported(path) if target(n) not in allowed]) == {}


def test_lowering_knows_no_symbols() -> None:
    """It asks for formulas; of the derivation itself it knows the order of numbers, so that it can do without SymPy."""

    def symbols(path: Path) -> list[str]:
        return [
            n for n in imported(path) if n.startswith("mahovik.core.derive") and "mahovik.core.derive.order." not in n
        ]

    assert each(of("core.lower"), symbols) == {}


C_SYNTAX = re.compile(
    r"#\s*(include|define|if|ifdef|ifndef|endif)\b|(^|\s)/\*(\s|$)|(^|\s)\*/(\s|$)|\btypedef\s+(struct|enum|double|float|int)\b"
    r"|\bstatic\s+(const|inline|\w+\s*\()|(?<![,\w])[a-z_]{2,}->[a-z_]|\bstruct\s+\w+\s*\{|\bu?int(8|16|32|64)_t\b"
    r"|\bfor\s*\(|\w\s*;\s*\}|\bvoid\b\s*[*)(]"
)
KNOWS_C = ("core.emit", "core.toolchain")
"""emit/ prints C; toolchain/ calls it, so that it reads the emitted header."""
READS_C = ("generator/mahovik/proof/verify/c_backend.py",)
"""Judges C that others hold: finds the identities in its header."""


@pytest.mark.parametrize("stage", sorted(set(FLOOR) - set(KNOWS_C)))
def test_only_emit_spells_C(stage: str) -> None:
    """Nothing above or below the printer knows C syntax."""
    paths = [path for path in of(stage) if name_of(path) not in READS_C]
    assert each(paths, lambda path: [found for found in strings(path) if C_SYNTAX.search(found[1])]) == {}


def test_files_can_be_read_at_once() -> None:
    """Under 400 lines."""

    def too_long(path: Path) -> bool:
        return len(path.read_text(encoding="utf-8").splitlines()) >= 400

    assert each([*SOURCES, *sorted(TEMPLATES.rglob("*.j2"))], too_long) == {}


ABSOLUTE = re.compile(r"^(file://)?/(work|home|usr|tmp|etc|root|opt|var|Users|mnt)\b|^[A-Z]:\\")


def test_no_absolute_paths() -> None:
    """What runs here runs anywhere. A test may name a bare root such as the folder for temporary files."""

    def absolute(path: Path) -> list[tuple[int, str]]:
        found = [(line, text) for line, text in strings(path) if ABSOLUTE.search(text)]
        return [(line, text) for line, text in found if path.is_relative_to(PACKAGE) or text.count("/") > 1]

    assert each(SOURCES, absolute) == {}


VAGUE = re.compile(r"utils?|helpers?|misc|common|stuff|manager")


@stages
def test_names_say_what_is_meant(stage: str) -> None:
    """No module, function or class is a drawer for everything."""

    def vague(path: Path) -> list[str]:
        defined = [n.name for n in ast.walk(tree_of(path)) if isinstance(n, ast.FunctionDef | ast.ClassDef)]
        return [n for n in [path.stem, *defined] if VAGUE.fullmatch(n.lower())]

    assert each(of(stage), vague) == {}


@stages
def test_public_functions_and_classes_are_documented(stage: str) -> None:
    """Every module, and every public function and class of it, says what it is."""

    def silent(path: Path) -> list[str]:
        tree = tree_of(path)
        public = [n for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef) and not n.name.startswith("_")]
        found = [n.name for n in public if not ast.get_docstring(n)]
        return found if ast.get_docstring(tree) else ["the module", *found]

    assert each(of(stage), silent) == {}


TAG = re.compile(r"\[[%=](.*?)[%=]\]", re.DOTALL)


def test_templates_print_and_do_not_think() -> None:
    """No products, quotients, differences or comparisons of size in a template; strings are left out."""

    def thoughts(path: Path) -> list[str]:
        tags = [re.sub(r"\"[^\"]*\"|'[^']*'", "", tag) for tag in TAG.findall(path.read_text(encoding="utf-8"))]
        return [tag for tag in tags if re.search(r"[*/<>]|\s-\s|^-?\s*(set|macro)\b", tag)]

    assert each(sorted(TEMPLATES.rglob("*.j2")), thoughts) == {}


@pytest.mark.parametrize(
    "text", ["#include <math.h>", "static const double x", "stand->row", "for (i = 0;", "return x; }", "/* a */"]
)
def test_C_is_recognised(text: str) -> None:
    """The pattern above can find something."""
    assert C_SYNTAX.search(text)


@pytest.mark.parametrize("text", ["k,kij->ij", "nkij,bj->bnk", ";}", "kg m^2/s", "a -> b"])
def test_what_is_not_C_is_left_alone(text: str) -> None:
    """Einstein sums, units and prose."""
    assert not C_SYNTAX.search(text)


def test_floors_are_told_apart() -> None:
    """Names of imports lead to stages."""
    assert target("mahovik.proof.reference.evaluate.evaluate") == "proof.reference"
    assert target("mahovik.core.routines") == "core.routines"
    assert target("mahovik.__version__") == "mahovik"
    assert target("numpy.typing") == "numpy"
    assert target("collections.abc") == ""
