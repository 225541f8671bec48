"""mahovik doctor."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import run
from mahovik.core.toolchain.targets import TARGETS


def tool(folder: Path, name: str, script: str) -> None:
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    path.chmod(0o755)


@pytest.fixture
def alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that is all of PATH; what runs in it finds sh by its full name."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    return tmp_path


def test_a_machine_without_anything_is_told_what_to_install(alone: Path) -> None:
    result = run("doctor", "--json")
    assert result.exit_code == 1
    found = {each["what"]: each for each in json.loads(result.output)}
    assert found["C compiler"] == {
        "what": "C compiler", "serves": "verify, simulate", "found": "", "install": "apt-get install gcc libc6-dev",
    }  # fmt: skip
    assert found["qemu-system-arm"]["install"] == f"apt-get install {' '.join(TARGETS['m7'].packages)}"
    assert not any(each["found"] for each in found.values() if not each["what"].startswith("extra"))


def test_what_is_there_says_its_version_and_what_does_not_start_is_missing(alone: Path) -> None:
    tool(alone, "cc", "echo 'cc 99.1'; echo more")
    tool(alone, "clang", "echo broken; exit 1")
    result = run("doctor", "--json")
    assert result.exit_code == 0
    found = {each["what"]: each["found"] for each in json.loads(result.output)}
    assert found["C compiler"] == "cc 99.1"
    assert found["clang"] == ""
