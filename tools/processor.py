"""The processor that a tool measures on."""

from __future__ import annotations

import platform
from pathlib import Path


def processor() -> str:
    """Its name, as Linux has it; else the machine's kind."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())
