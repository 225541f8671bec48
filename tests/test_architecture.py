"""The house keeps its order where `lint-imports` and ruff cannot see it: C, templates, paths, data of the laws."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest

from mahovik.contract.laws import BODY_LAWS, LAWS

REPOSITORY = Path(__file__).resolve().parents[1]
PACKAGE = REPOSITORY / "generator" / "mahovik"
MODULES = sorted(PACKAGE.rglob("*.py"))
SOURCES = sorted([*MODULES, *(REPOSITORY / "tests").rglob("*.py"), *(REPOSITORY / "tools").rglob("*.py")])
TEMPLATES = sorted((REPOSITORY / "templates").rglob("*.j2"))


def strings(path: Path) -> Iterator[str]:
    """String constants of a module, docstrings left out."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))))
    documentation = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documentation:
            yield node.value


def faults_by_file(paths: Iterable[Path], wrong: Callable[[Path], object]) -> dict[str, object]:
    """Faults by file."""
    return {path.relative_to(REPOSITORY).as_posix(): fault for path in paths if (fault := wrong(path))}


C_SYNTAX = re.compile(
    r"#\s*(include|define|if|ifdef|ifndef|endif)\b|(^|\s)/\*(\s|$)|(^|\s)\*/(\s|$)|\btypedef\s+(struct|enum|double|float|int)\b"
    r"|\bstatic\s+(const|inline|\w+\s*\()|(?<![,\w])[a-z_]{2,}->[a-z_]|\bstruct\s+\w+\s*\{|\bu?int(8|16|32|64)_t\b"
    r"|\bfor\s*\(|\w\s*;\s*\}|\bvoid\b\s*[*)(]"
)
KNOWS_C = ("core/emit", "core/toolchain", "proof/verify/c_backend.py", "proof/verify/files.py")
"""The printer of C, what calls compilers, and what reads the C of a folder that somebody holds."""


def test_only_emit_spells_C() -> None:
    paths = [path for path in MODULES if not path.relative_to(PACKAGE).as_posix().startswith(KNOWS_C)]
    assert faults_by_file(paths, lambda path: [text for text in strings(path) if C_SYNTAX.search(text)]) == {}
    for text in ("#include <math.h>", "static const double x", "stand->row", "for (i = 0;", "return x; }", "/* a */"):
        assert C_SYNTAX.search(text)


def test_files_can_be_read_at_once() -> None:
    """A file has at most 800 lines."""
    lines = {path: path.read_text(encoding="utf-8").count("\n") for path in (*SOURCES, *TEMPLATES)}
    assert [path for path, count in lines.items() if count > 800] == []


ROOTS = r"/(work|home|usr|tmp|etc|root|opt|var|Users|mnt)\b"


def test_no_absolute_paths() -> None:
    """A test may name a bare root such as the folder for temporary files."""

    def absolute(path: Path) -> list[str]:
        if not re.search(rf"{ROOTS}|[A-Z]:\\", path.read_text(encoding="utf-8")):
            return []  # most files, and reading their syntax takes seconds
        texts = [text for text in strings(path) if re.match(rf"(file://)?{ROOTS}|[A-Z]:\\", text)]
        return [text for text in texts if path.is_relative_to(PACKAGE) or text.count("/") > 1]

    assert faults_by_file(SOURCES, absolute) == {}


def test_the_top_folder_has_no_outputs_of_a_run() -> None:
    known = {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "Makefile", "README.md"}
    known |= {".gitignore", "constraints.txt", "pyproject.toml"}
    listed = subprocess.run(["git", "ls-files"], cwd=REPOSITORY, capture_output=True, text=True, check=True).stdout
    assert {name for name in listed.splitlines() if "/" not in name} <= known


def test_faults_to_plant_find_their_text() -> None:
    listed = tomllib.loads((REPOSITORY / "tests" / "faults.toml").read_text(encoding="utf-8"))
    faults = [fault for kind in listed.values() for fault in kind]
    assert [f["fault"] for f in faults if (REPOSITORY / f["file"]).read_text("utf-8").count(f["before"]) != 1] == []


def test_templates_print_and_do_not_think() -> None:
    """No products, quotients, differences, comparisons of size or variables in a template; strings are left out."""

    def thoughts(path: Path) -> list[str]:
        tags = re.findall(r"\[[%=](.*?)[%=]\]", path.read_text(encoding="utf-8"), re.DOTALL)
        tags = [re.sub(r"\"[^\"]*\"|'[^']*'", "", tag) for tag in tags]
        return [tag for tag in tags if re.search(r"[*/<>]|\s-\s|^-?\s*(set|macro)\b", tag)]

    assert faults_by_file(TEMPLATES, thoughts) == {}


ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.MatMult, ast.Pow, ast.Mod, ast.FloorDiv)
SHARED = [PACKAGE / f"{name}.py" for name in ("contract/functions", "contract/laws", "core/stand/model", "errors")]
"""All that more than one derivation imports, by the contract `raw-data` of pyproject.toml, but `law` of the laws."""


def arithmetic(text: str) -> list[int]:
    """Lines with arithmetic; tuples repeated or joined are none, nor are places in a list."""
    tree = ast.parse(text)
    places = {id(n) for s in ast.walk(tree) if isinstance(s, ast.Slice) for n in ast.walk(s)}
    operations = [n for n in ast.walk(tree) if isinstance(n, ast.BinOp) and id(n) not in places]
    return [n.lineno for n in operations if isinstance(n.op, ARITHMETIC) and not isinstance(n.left, ast.Tuple)]


def test_what_derivations_share_computes_nothing() -> None:
    """A helper that two derivations shared would hide its own error from all comparisons."""
    assert faults_by_file(SHARED, lambda path: arithmetic(path.read_text(encoding="utf-8"))) == {}
    numeric = re.compile(r"^(import|from) (numpy|sympy|casadi|flint)", re.MULTILINE)
    assert faults_by_file(SHARED, lambda path: numeric.findall(path.read_text(encoding="utf-8"))) == {}
    for law in PACKAGE.glob("laws/*/law.py"):
        functions = [node for node in ast.walk(ast.parse(law.read_text())) if isinstance(node, ast.FunctionDef)]
        computing = {
            function.name
            for function in functions
            if arithmetic(ast.unparse(function)) or "np." in ast.unparse(function)
        }
        for part in ("reference", "energy"):
            if (path := law.with_stem(part)).is_file():
                nodes = list(ast.walk(ast.parse(path.read_text())))
                named = {n.attr for n in nodes if isinstance(n, ast.Attribute)}
                named |= {alias.name for n in nodes if isinstance(n, ast.ImportFrom) for alias in n.names}
                assert not computing & named, path
    for path in (
        p for folder in ("core/derive", "proof/reference", "proof/second") for p in PACKAGE.glob(f"{folder}/*.py")
    ):
        imports = [n for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.ImportFrom)]
        of_model = [alias.name for n in imports if n.module == "mahovik.core.stand.model" for alias in n.names]
        assert all(name[0].isupper() for name in of_model), path  # classes and constants of raw data
    assert arithmetic("def moved(J, m, r):\n    return J + m * (r @ r)\n") == [2, 2, 2]


def test_a_folder_has_the_whole_law_and_every_folder_is_listed() -> None:
    """A law that no list has would never act. The reference has the weight of all bodies at once, in Theta (g, 0)."""
    folders = {path.parent.name: path.parent for path in PACKAGE.glob("laws/*/__init__.py")}
    assert set(folders) == {*LAWS, *BODY_LAWS}
    for folder in folders.values():
        parts = {path.stem for path in folder.glob("*.py")}
        assert parts >= {"energy", *(["reference"] if folder.name != "weight" else [])}, folder.name


@pytest.mark.parametrize(
    ("code", "unwanted"),
    [
        ("import mahovik.contract.laws", ["sympy", "casadi", "numpy"]),
        (
            "from mahovik import stands; from mahovik.core.stand import load; load(stands.path('bench8'))",
            ["sympy", "casadi"],
        ),
    ],
)
def test_reading_a_stand_loads_no_algebra(code: str, unwanted: list[str]) -> None:
    """`check` stays quick: the list of laws and their schemas come without their derivations."""
    code += f"; import sys; assert not set({unwanted}) & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
