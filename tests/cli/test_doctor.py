"""mahovik doctor."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import run
from mahovik.core.toolchain.targets import TARGETS


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
