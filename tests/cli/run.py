"""The command line in this process and in its own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from mahovik.out.command_line import main
from mahovik.stands import path

BENCH8, DEMO3, AUV6 = (str(path(name)) for name in ("bench8", "demo3", "auv6"))

BRICK = """
schema = 1
name = "brick"
gravity = [0, 0, 9.81]
[carrier]
mass = 4.0
center_of_mass = [0.01, -0.02, 0.03]
inertia = [0.2, 0.3, 0.4]
inertia_about = "center_of_mass"
"""
"""A rigid body without flywheels, as the text of a stand file."""


PROGRAM = "import sys; sys.argv[0] = 'mahovik'; from mahovik.out.command_line import main; main()"


def run(*arguments: str, stdin: str | bytes = "") -> Result:
    """Run the command in this process. An exception that is no exit is a traceback: it is raised."""
    result = CliRunner().invoke(main, list(arguments), input=stdin)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert "Traceback" not in result.output
    return result


def refused(*arguments: str, status: int = 2, stdin: str | bytes = "") -> str:
    """Text on standard error; nothing is on standard output."""
    result = run(*arguments, stdin=stdin)
    assert result.exit_code == status, result.output
    return result.stderr


def process(*arguments: str, stdin: str = "", cwd: Path | None = None, **env: str) -> subprocess.CompletedProcess[str]:
    """Run the command in its own process, like a user."""
    options: dict[str, Any] = {"capture_output": True, "text": True, "cwd": cwd, "timeout": 120}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        input=stdin,
        check=False,
        env={**os.environ, **env},
        **options,
    )
    assert "Traceback" not in done.stderr
    return done
