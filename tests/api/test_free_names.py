"""Names that `import mahovik` may offer as functions are bound by no import of a submodule."""

from __future__ import annotations

import subprocess
import sys

import pytest

FREE = ("simulate", "plan", "verify", "design", "report")

IMPORT_ALL = """
import importlib, pkgutil, sys
import mahovik
for module in pkgutil.walk_packages(mahovik.__path__, "mahovik."):
    try:
        importlib.import_module(module.name)
    except ModuleNotFoundError as error:  # packages of an extra
        assert not (error.name or "").startswith("mahovik"), error
print(sum(name.startswith("mahovik.") for name in sys.modules), *sorted(vars(mahovik)))
"""


@pytest.mark.slow
def test_no_submodule_takes_a_name_that_a_function_may_have() -> None:
    command = [sys.executable, "-c", IMPORT_ALL]
    count, *bound = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    assert int(count) > 300
    assert {"core", "proof", "use", "out"} <= set(bound)
    assert not set(FREE) & set(bound)
