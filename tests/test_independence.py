"""The derivations are independent: none imports another, and what two of them share computes nothing.

A helper that two derivations shared would hide its own error from all comparisons. So the modules that more than one
derivation imports are listed here one by one, and each is shown to hold no arithmetic.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest

from test_architecture import MODULES, PACKAGE, imported, stage_of

DERIVATIONS = ("derive", "reference", "rigorous", "second")
"""Names of the four, as stages and as parts of laws."""

SHARED = {
    "mahovik.contract.functions",
    "mahovik.contract.laws",
    "mahovik.core.stand.model",
    "mahovik.core.stand.state",
    "mahovik.errors",
}
"""Names of wants, raw data, errors, and the list of laws; the `data` of each law as well."""


def derivation_of(path: Path) -> str:
    """The derivation that a module belongs to; "" for any other module."""
    name = stage_of(path).rpartition(".")[2]
    return name if name in DERIVATIONS else ""


def module_of(path: Path) -> str:
    """Dotted name of a module."""
    return ".".join(path.with_suffix("").relative_to(PACKAGE.parent).parts).removesuffix(".__init__")


OURS = {module_of(path): path for path in MODULES}


def module_in(name: str, modules: Mapping[str, Path]) -> str:
    """The module of a dotted name, which may be that of something in it; "" where it is none of them."""
    return next((n for n in (name, name.rpartition(".")[0]) if n in modules), "")


def reached(path: Path, modules: Mapping[str, Path]) -> set[str]:
    """The modules of the package that a module imports, directly or through others; SHARED ones are not followed."""
    found: set[str] = set()
    ahead = [path]
    while ahead:
        for name in imported(ahead.pop()):
            module = module_in(name, modules)
            if module and module not in found:
                found.add(module)
                if module not in SHARED:
                    ahead.append(modules[module])
    return found


def is_data(module: str) -> bool:
    """Whether a module is the raw data of a law."""
    parts = module.split(".")
    return parts[:2] == ["mahovik", "laws"] and parts[3:] == ["data"]


def shared_beyond_data(paths: Iterable[tuple[str, Path]], modules: Mapping[str, Path]) -> dict[str, set[str]]:
    """Modules beyond the raw data that more than one derivation reaches, with those derivations."""
    users: dict[str, set[str]] = {}
    for derivation, path in paths:
        for module in reached(path, modules) | {module_of(path) if path.is_relative_to(PACKAGE) else path.stem}:
            users.setdefault(module, set()).add(derivation)
    return {m: d for m, d in users.items() if len(d) > 1 and m not in SHARED and not is_data(m)}


def own() -> list[tuple[str, Path]]:
    """Every module of a derivation."""
    return [(name, path) for path in MODULES if (name := derivation_of(path))]


def test_derivations_share_raw_data_only() -> None:
    assert {name for name, _ in own()} == set(DERIVATIONS)
    assert shared_beyond_data(own(), OURS) == {}


ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.MatMult, ast.Pow, ast.Mod, ast.FloorDiv)


def computes(path: Path) -> list[int]:
    """Lines with arithmetic; tuples repeated or joined are none, nor are places in a list."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    places = {id(n) for s in ast.walk(tree) if isinstance(s, ast.Slice) for n in ast.walk(s)}
    found = [n for n in ast.walk(tree) if isinstance(n, ast.BinOp) and id(n) not in places]
    return [n.lineno for n in found if isinstance(n.op, ARITHMETIC) and not isinstance(n.left, ast.Tuple)]


@pytest.mark.parametrize("module", sorted({m for m in OURS if is_data(m)} | SHARED))
def test_what_they_share_computes_nothing(module: str) -> None:
    assert computes(OURS[module]) == []
    assert not any(name.split(".")[0] in ("numpy", "sympy", "casadi", "flint") for name in imported(OURS[module]))


STEINER = """
def moved(inertia, mass, r):
    return inertia + mass * (r @ r) - mass * r * r
"""


def planted(folder: Path, source: str) -> dict[str, set[str]]:
    """Finding of the check for two derivations that import the same function."""
    helper = folder / "parallel_axes.py"
    helper.write_text(STEINER, encoding="utf-8")
    modules = dict(OURS) | {f"mahovik.laws.{law}.parallel_axes": helper for law in ("leg", "buoyancy")}
    files = []
    for derivation in ("reference", "second"):
        path = folder / f"planted_{derivation}.py"
        path.write_text(source, encoding="utf-8")
        files.append((derivation, path))
    return shared_beyond_data([*own(), *files], modules)


@pytest.mark.parametrize(
    "source",
    [
        "from mahovik.laws.leg.parallel_axes import moved\n",
        "from mahovik.laws.buoyancy.parallel_axes import moved\n",
        "from mahovik.core.stand.physical import inertia_about_origin\n",
        "def inertia(body):\n    from mahovik.core.stand import physical\n    return physical\n",
        "from mahovik.core.stand.definite import placement\n",
        "from mahovik.laws.leg.scale import scale\n",
        "from mahovik.laws.damping.plan import twist_law\n",
    ],
)
def test_a_planted_helper_is_found(tmp_path: Path, source: str) -> None:
    """One function of parallel axes behind two derivations, in a law's folder or where the stand is checked."""
    assert planted(tmp_path, source)


@pytest.mark.parametrize("law", ["leg", "damping"])
def test_a_derivation_that_imports_another_is_found(law: str, tmp_path: Path) -> None:
    """Also through a third module, of a law on the carrier or of one on bodies."""
    path = tmp_path / "planted.py"
    path.write_text(f"from mahovik.laws.{law}.faults import FAULTS\n", encoding="utf-8")
    assert f"mahovik.laws.{law}.reference" in shared_beyond_data([*own(), ("second", path)], OURS)


def test_arithmetic_is_recognised(tmp_path: Path) -> None:
    path = tmp_path / "planted.py"
    path.write_text(STEINER, encoding="utf-8")
    assert computes(path) == [3, 3, 3, 3, 3, 3]
