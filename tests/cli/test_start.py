"""A command imports what it needs, and nothing that takes long to start for others."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from cli.run import BENCH8

SLOW = ("sympy", "casadi", "scipy", "pint", "jinja2", "cffi", "numpy", "rich")
"""Slowest to import first."""

CODE = f"""
import json, sys
from mahovik.out.command_line import main
try:
    main()
except SystemExit:
    pass
print(json.dumps([name for name in {SLOW!r} if name in sys.modules]), file=sys.stderr)
"""

NOTHING: set[str] = set()
NUMBERS = {"numpy"}
CASES = {
    ("--help",): NOTHING,
    ("--version",): NOTHING,
    ("generate", "--help"): {"numpy"},
    ("generate", BENCH8, "-o", "bench8"): NUMBERS | {"jinja2", "rich"},
    ("verify", "--help"): {"numpy"},
    ("new", "--list"): {"numpy", "rich"},
    ("new", "demo3"): {"numpy", "rich"},
    ("check", BENCH8): NUMBERS | {"rich"},
    ("modes", "--help"): {"numpy"},
    ("check", BENCH8, "--json"): NUMBERS,
    ("eval", BENCH8, "--backend", "numpy"): NUMBERS,
    ("eval", BENCH8, "--backend", "casadi"): NUMBERS | {"casadi"},
    (("verify", BENCH8, "log")): NUMBERS | {"jinja2"},
    ("replay", BENCH8, "--log", "log"): NUMBERS | {"jinja2", "cffi"},
}
"""What of these a command may import."""


@pytest.mark.parametrize("arguments", CASES, ids=" ".join)
def test_a_command_imports_only_what_it_needs(arguments: tuple[str, ...], work_folder: Path) -> None:
    (work_folder / "log").write_text("")
    done = subprocess.run(
        [sys.executable, "-c", CODE, *arguments], input="", capture_output=True, text=True, check=False
    )
    assert "Traceback" not in done.stderr
    assert set(json.loads(done.stderr.splitlines()[-1])) <= CASES[arguments]
