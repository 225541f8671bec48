"""The text of the fuzz harness: every public function is in it."""

from __future__ import annotations

import re

from cli.run import DEMO3
from mahovik.core.stand import load
from mahovik.core.toolchain.checks import fuzz_project


def test_every_public_function_is_fuzzed() -> None:
    """The recorder's functions are included, and a new function is included without further work."""
    texts = fuzz_project(load(DEMO3), "double")
    header = texts["demo3.h"] + texts["verification/demo3_recorder.h"]
    declared = re.findall(r"^demo3_status (demo3_\w+)\(", header, re.MULTILINE)
    assert len(declared) > 20
    assert [name for name in declared if f"{name}(" not in texts["demo3_fuzz.c"]] == []
