"""Lets Python compile and keep the modules that commands import, by running some commands.

python tools/compile_modules.py

Python keeps them beside their sources where the environment does not forbid it, PYTHONDONTWRITEBYTECODE.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile

from mahovik.stands import path

STAND = str(path("bench8"))

COMMANDS = (
    ("check", STAND),
    ("eval", STAND, "--backend", "numpy"),
    ("generate", STAND, "-o", "bench8"),
)


def main() -> None:
    """Run them, in a folder that is removed. Exit status 1 where one fails, which says why."""
    with tempfile.TemporaryDirectory() as scratch:
        for command in COMMANDS:
            quiet = subprocess.DEVNULL
            whole = [sys.executable, "-m", "mahovik", *command]
            subprocess.run(whole, cwd=scratch, stdin=quiet, stdout=quiet, check=True)


if __name__ == "__main__":
    main()
