"""The second derivation is independent: it imports nothing of the others."""

import ast
from pathlib import Path

import pytest

import mahovik.proof.second

FILES = sorted(Path(mahovik.proof.second.__file__).parent.glob("**/*.py"))
STANDARD = {"__future__", "collections", "dataclasses", "functools", "math", "typing"}
ALLOWED = ("mahovik.errors", "mahovik.core.stand", "mahovik.proof.second")


def imported(path):
    """Names of all modules that a file imports, anywhere in it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: relative import"
            yield from ([f"mahovik.{a.name}" for a in node.names] if node.module == "mahovik" else [node.module])


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_only_casadi_numpy_and_the_stand_are_imported(path):
    modules = list(imported(path))
    assert modules
    for module in modules:
        top = module.split(".")[0]
        ours = any(module == name or module.startswith(name + ".") for name in ALLOWED)
        assert ours or top in {"casadi", "numpy"} or top in STANDARD, module
    assert "mahovik.core.stand.random" not in modules


def test_nothing_is_imported_in_a_way_that_ast_does_not_see():
    for path in FILES:
        text = path.read_text(encoding="utf-8")
        assert "importlib" not in text and "__import__" not in text, path.name
