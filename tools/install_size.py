"""Time and disk that an install takes, in a fresh clone: writes docs/results/install.md and a sentence of README.md.

python tools/install_size.py

Minutes: `pip install ".[report]"` in a new environment, then `make demo` and `make setup-test`, each as a user runs it,
with whatever pip has downloaded before.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import campaign
from kept import Campaign, Columns, Figures

TABLE = Columns({"command": "`{}`", "environment": "`{}`", "s": "{:.0f}", "MB": "{:.0f}"}, 2)
INSTALL, DEMO, TESTS = 'pip install ".[report]"', "make demo", "make setup-test"


def disk(folder: Path) -> float:
    """Disk that a folder takes, MB."""
    files = (Path(root) / name for root, folders, names in os.walk(folder) for name in (*folders, *names))
    return sum(each.lstat().st_blocks * 512 for each in files) / 1e6


def seconds(command: Sequence[str], folder: Path) -> float:
    """Wall-clock seconds of a command in a folder, as a user's shell would run it. Raises CalledProcessError."""
    env = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
    begin = time.perf_counter()
    subprocess.run(command, cwd=folder, env=env, check=True, stdin=subprocess.DEVNULL)
    return time.perf_counter() - begin


def measure() -> list[dict[str, Any]]:
    """One row for each command; the last adds to what the one before it has installed."""
    base = getattr(sys, "_base_executable", sys.executable)
    with tempfile.TemporaryDirectory() as scratch:
        clone, own = Path(scratch) / "mahovik", Path(scratch) / "own"
        subprocess.run(["git", "clone", "-q", campaign.ROOT, clone], check=True)
        seconds([base, "-m", "venv", str(own)], clone)
        rows = [(INSTALL, "own", seconds([str(own / "bin" / "pip"), "install", "-q", ".[report]"], clone), disk(own))]
        for command in (DEMO, TESTS):
            spent = seconds([*command.split(), f"PYTHON={base}"], clone)
            rows.append((command, ".venv", spent, disk(clone / ".venv")))
    return TABLE.rows(rows)


def about(x: float) -> str:
    """A number with its leading digit, and the second one after a 1."""
    return f"{float(f'{x:.1e}' if f'{x:e}'.startswith('1') else f'{x:.0e}'):g}"


def page(found: Figures) -> str:
    """The table."""
    return (
        f"On {found['processor']}, {found['cores']} cores, Python {found['python']}; processes that wanted to run "
        f"meanwhile, on average: {found['load']:.1f}. The last command adds to the environment of the one before; "
        f"times include downloads of what was not in pip's cache.\n\n{TABLE.text(found['rows'])}"
    )


def sentence(found: Figures) -> str:
    """Sizes and times in a sentence, for who wants to know beforehand."""
    rows = {row["command"]: row for row in found["rows"]}
    size = {command: f"about {about(row['MB'] / 1000)} GB" for command, row in rows.items()}
    return (
        f"`pip install` takes about {about(rows[INSTALL]['s'])} s and {size[INSTALL]} of disk, `make demo` about "
        f"{about(rows[DEMO]['s'])} s and {size[DEMO]}; with what `make test` adds it is {size[TESTS]} "
        "([measured](docs/results/install.md))."
    )


CAMPAIGN = Campaign(
    "install",
    campaign.Block("docs/results/install.md", "install"),
    page,
    also=((campaign.Block("README.md", "install: tools/install_size.py"), sentence),),
)


def main() -> None:
    """Measure, keep, render the pages."""
    campaign.parser(__doc__).parse_args()
    rows = measure()
    CAMPAIGN.keep(
        {
            "processor": campaign.processor(),
            "cores": campaign.cores(),
            "python": platform.python_version(),
            "load": os.getloadavg()[2],
            "rows": rows,
        }
    )


if __name__ == "__main__":
    main()
