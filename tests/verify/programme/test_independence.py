"""What verifies shares nothing with what plans: the reference, the files, SciPy."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik.proof.verify import programme
from test_architecture import imported, name_of, target

ALLOWED = {"", "mahovik", "proof.reference", "core.motion", "core.stand", "errors", "numpy", "scipy"}
COMPILED = {"programme_c": {"core.toolchain"}}
"""One module loads the C that it judges; it is handed all else."""

MODULES = sorted(Path(programme.__file__).parent.glob("*.py"))


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_it_imports_the_reference_only(path: Path) -> None:
    own = [name for name in imported(path) if not name.startswith("mahovik.proof.verify.programme")]
    assert {target(name) for name in own} <= ALLOWED | COMPILED.get(path.stem, set())
