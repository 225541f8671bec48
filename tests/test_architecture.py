"""The house keeps its order: who may import whom, where C is spelt, how long a file may be."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]
PACKAGE = REPOSITORY / "generator" / "mahovik"
TEMPLATES = REPOSITORY / "templates"
MODULES = sorted(PACKAGE.rglob("*.py"))
SOURCES = sorted([*MODULES, *(REPOSITORY / "tests").rglob("*.py"), *(REPOSITORY / "tools").rglob("*.py")])

STAGES = (
    ("laws",),
    ("__main__",),
    ("out.cli",),
    ("out.identify",),
    ("out.campaign",),
    ("out.functions",),
    ("out.report",),
    ("out.export",),
    ("out.foreign",),
    ("out.api",),
    ("use.balance",),
    ("use.study",),
    ("use.design",),
    ("use.control",),
    ("use.plan",),
    ("use.simulate",),
    ("use.measured",),
    ("use.regressor",),
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
    ("writing",),
    ("contract", "errors", "nearest"),
    ("mahovik",),
)
"""From the top of the house down; names on one floor never import one another. `mahovik` is the package itself.

The laws are on top: each part of one imports the vocabulary of its stage, and stages load parts by name alone.
"""

WINGS = ("core", "proof", "use", "out")
"""Folders of stages, each with one purpose; what it is stands in its `__init__`."""

FLOOR = {name: floor for floor, names in enumerate(STAGES) for name in names}
FLOOR |= {f"laws.{path.stem}": FLOOR["laws"] for path in PACKAGE.glob("laws/*/*.py")}  # test_laws: what each imports

ONLY = {
    "proof.reference": {"contract", "errors", "core.stand", "numpy"},
    "proof.rigorous": {"contract", "errors", "core.stand", "flint"},
    "core.lower": {
        "contract",
        "core.routines",
        "core.formula",
        "core.derive",
        "core.program",
        "core.stand",
        "errors",
        "numpy",
    },
    "core.formula": {"core.derive", "errors", "sympy", "writing"},
    "core.derive": {"errors", "sympy"},
    "core.program": {"contract", "errors", "numpy"},
    "core.routines": {"contract", "errors", "core.program", "mpmath", "numpy"},
    "contract": set(),
    "errors": set(),
    "nearest": set(),
    "writing": {"errors"},
}  # fmt: skip
"""Where the house is stricter still: all that a stage may import, besides the standard library and itself."""


def name_of(path: Path) -> str:
    """Name of a file in a report of this test."""
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


@cache
def imported(path: Path) -> tuple[str, ...]:
    """Dotted names that a module imports, in functions and for types too, and those it imports by a string."""
    return tuple(_imported(path))


def _imported(path: Path) -> Iterator[str]:
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


def faults_by_file(paths: Iterable[Path], wrong: Callable[[Path], object]) -> dict[str, object]:
    """Faults by file."""
    return {name_of(path): found for path in paths if (found := wrong(path))}


def modules_of(stage: str) -> list[Path]:
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
        return [n for n in imported(path) if (t := target(n)) in FLOOR and t != stage and FLOOR[t] <= FLOOR[stage]]

    if not stage.startswith("laws."):
        assert faults_by_file(modules_of(stage), upward) == {}


def test_a_stage_that_imports_a_law_is_found() -> None:
    """Below the laws is every stage, so that no import of theirs may name one."""
    assert {FLOOR[target(f"mahovik.laws.leg.{part}")] for part in ("data", "reference", "report")} == {0}
    assert all(floor > 0 for stage, floor in FLOOR.items() if not stage.startswith("laws"))


def module_name(path: Path) -> str:
    """Dotted name of a module; that of a package is its folder's."""
    return ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")


def imports_between(modules: Mapping[str, Iterable[str]]) -> dict[str, set[str]]:
    """Modules that each module imports, from the dotted names that it imports."""

    def module_of(name: str) -> str:
        while name and name not in modules:
            name = name.rpartition(".")[0]
        return name

    return {module: {module_of(name) for name in names} - {"", module} for module, names in modules.items()}


def circle(graph: Mapping[str, set[str]]) -> list[str]:
    """A circle of imports, the module where it closes first and last; empty if there is none."""
    done: set[str] = set()

    def search(route: list[str]) -> list[str]:
        for module in sorted(graph[route[-1]] - done):
            if module in route:
                return [*route[route.index(module) :], module]
            if found := search([*route, module]):
                return found
        done.add(route[-1])
        return []

    return next((found for module in graph if module not in done and (found := search([module]))), [])


def test_no_circles_of_imports() -> None:
    """No module imports itself through others; imports in functions and for types alone count."""
    assert circle(imports_between({module_name(path): imported(path) for path in MODULES})) == []


def test_a_circle_of_imports_is_found(tmp_path: Path) -> None:
    """One that closes through a name of a package, an import for types and an import in a function."""
    texts = {
        "mahovik.a": "from mahovik.b import value",
        "mahovik.b": "if TYPE_CHECKING:\n    from mahovik.c.d import Thing",
        "mahovik.c": "from mahovik.c.d import Thing",
        "mahovik.c.d": "def f():\n    import mahovik.a",
    }
    graph = {}
    for name, text in texts.items():
        path = tmp_path / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        graph[name] = imported(path)
    assert circle(imports_between(graph)) == ["mahovik.a", "mahovik.b", "mahovik.c.d", "mahovik.a"]
    assert circle(imports_between(graph | {"mahovik.c.d": []})) == []


def with_folder_as_one(folder: str, graph: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """The graph of imports with all modules below a folder as one node of its name."""

    def node(module: str) -> str:
        return folder if module == folder or module.startswith(f"{folder}.") else module

    merged: dict[str, set[str]] = {}
    for module, others in graph.items():
        merged.setdefault(node(module), set()).update(node(other) for other in others)
    return {module: others - {module} for module, others in merged.items()}


def test_no_circles_through_a_folder() -> None:
    """A folder, also inside a stage, imports nothing that imports it: it can be read after what it uses, as a whole."""
    graph = imports_between({module_name(path): imported(path) for path in MODULES})
    folders = sorted({module_name(path.parent / "__init__.py") for path in MODULES})
    found = {folder: circle(with_folder_as_one(folder, graph)) for folder in folders}
    assert {folder: route for folder, route in found.items() if route} == {}


def test_a_circle_through_a_folder_is_found() -> None:
    """No module imports itself, but the folder `parts` imports `table`, which imports `parts`."""
    graph = {"table": {"parts.unit"}, "parts.unit": set(), "parts.list": {"table", "parts.unit"}}
    assert circle(graph) == []
    assert circle(with_folder_as_one("parts", graph)) == ["table", "parts", "table"]
    apart = {"table": {"unit"}, "unit": set(), "parts.list": {"table", "unit"}}
    assert circle(with_folder_as_one("parts", apart)) == []


@pytest.mark.parametrize("stage", ONLY)
def test_strict_stages_import_only_what_they_may(stage: str) -> None:
    """References and derivations share nothing but the stand; what is lowered comes from the derivation."""
    allowed = ONLY[stage] | {stage, "", "mahovik"}
    assert modules_of(stage)
    assert faults_by_file(modules_of(stage), lambda path: [n for n in imported(path) if target(n) not in allowed]) == {}


def test_lowering_knows_no_symbols() -> None:
    """It asks for formulas; of the derivation itself it knows the order of numbers, so that it can do without SymPy."""

    def symbols(path: Path) -> list[str]:
        return [
            n for n in imported(path) if n.startswith("mahovik.core.derive") and "mahovik.core.derive.order." not in n
        ]

    assert faults_by_file(modules_of("core.lower"), symbols) == {}


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
    paths = [path for path in modules_of(stage) if name_of(path) not in READS_C]
    assert faults_by_file(paths, lambda path: [found for found in strings(path) if C_SYNTAX.search(found[1])]) == {}


def test_files_can_be_read_at_once() -> None:
    """At most 800 lines."""

    def too_long(path: Path) -> bool:
        return len(path.read_text(encoding="utf-8").splitlines()) > 800

    assert faults_by_file([*SOURCES, *sorted(TEMPLATES.rglob("*.j2"))], too_long) == {}


ROOTS = r"/(work|home|usr|tmp|etc|root|opt|var|Users|mnt)\b"
ABSOLUTE = re.compile(rf"^(file://)?{ROOTS}|^[A-Z]:\\")
ANYWHERE = re.compile(rf"{ROOTS}|[A-Z]:\\")


def test_no_absolute_paths() -> None:
    """What runs here runs anywhere. A test may name a bare root such as the folder for temporary files."""

    def absolute(path: Path) -> list[tuple[int, str]]:
        if not ANYWHERE.search(path.read_text(encoding="utf-8")):
            return []  # most files, and reading their syntax takes seconds
        found = [(line, text) for line, text in strings(path) if ABSOLUTE.search(text)]
        return [(line, text) for line, text in found if path.is_relative_to(PACKAGE) or text.count("/") > 1]

    assert faults_by_file(SOURCES, absolute) == {}


VAGUE = re.compile(r"utils?|helpers?|misc|common|stuff|manager")


@stages
def test_names_say_what_is_meant(stage: str) -> None:
    """No module, function or class is a drawer for everything."""

    def vague(path: Path) -> list[str]:
        defined = [n.name for n in ast.walk(tree_of(path)) if isinstance(n, ast.FunctionDef | ast.ClassDef)]
        return [n for n in [path.stem, *defined] if VAGUE.fullmatch(n.lower())]

    assert faults_by_file(modules_of(stage), vague) == {}


@stages
def test_public_functions_and_classes_are_documented(stage: str) -> None:
    """Every module, and every public function and class of it, says what it is."""

    def silent(path: Path) -> list[str]:
        tree = tree_of(path)
        public = [n for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef) and not n.name.startswith("_")]
        found = [n.name for n in public if not ast.get_docstring(n)]
        return found if ast.get_docstring(tree) else ["the module", *found]

    assert faults_by_file(modules_of(stage), silent) == {}


TAG = re.compile(r"\[[%=](.*?)[%=]\]", re.DOTALL)


def test_templates_print_and_do_not_think() -> None:
    """No products, quotients, differences or comparisons of size in a template; strings are left out."""

    def thoughts(path: Path) -> list[str]:
        tags = [re.sub(r"\"[^\"]*\"|'[^']*'", "", tag) for tag in TAG.findall(path.read_text(encoding="utf-8"))]
        return [tag for tag in tags if re.search(r"[*/<>]|\s-\s|^-?\s*(set|macro)\b", tag)]

    assert faults_by_file(sorted(TEMPLATES.rglob("*.j2")), thoughts) == {}


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
