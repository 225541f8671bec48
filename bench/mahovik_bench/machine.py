"""Machine of the measurement, without its name: processor, compilers, versions, load."""

from __future__ import annotations

import os
import platform
import re
from importlib import metadata
from pathlib import Path

from mahovik import __version__
from mahovik_bench.build import compiler_version

VECTORS = {"avx512f": "AVX-512", "avx2": "AVX2", "sse2": "SSE2"}
"""Widest first, by the words of Linux."""
PACKAGES = ("casadi", "pin", "cmeel-eigen", "mujoco", "sympy", "symforce", "numpy")


def _cpuinfo(field: str) -> str:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return ""
    found = re.search(rf"^{field}\s*: (.*)$", text, re.MULTILINE)
    return found[1].strip() if found else ""


def vectors() -> str:
    """The widest vectors of this processor."""
    flags = _cpuinfo("flags").split()
    return next((name for word, name in VECTORS.items() if word in flags), "none known")


def versions() -> dict[str, str]:
    """Versions of mahovik, compilers and installed packages of peers."""
    found = {"mahovik": __version__, "gcc": compiler_version("gcc"), "Python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found


def machine() -> dict[str, str]:
    """Processor and system."""
    family, model = _cpuinfo("cpu family"), _cpuinfo("model")
    return {
        "processor": f"{_cpuinfo('model name') or platform.machine()}, family {family}, model {model}",
        "vectors": vectors(),
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()} {platform.machine()}",
    }


def load() -> float:
    """Processes that run or want to, mean of the last minute."""
    return os.getloadavg()[0]
