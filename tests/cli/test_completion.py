"""mahovik completion."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from cli.run import refused, run


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_is_told_whom_to_ask(shell: str) -> None:
    result = run("completion", shell)
    assert result.exit_code == 0
    assert f"_MAHOVIK_COMPLETE={shell}_complete" in result.output
    whom = {"bash": "_completion mahovik", "zsh": "#compdef mahovik", "fish": "--command mahovik"}
    assert whom[shell] in result.output


def test_an_unknown_shell_is_refused() -> None:
    assert "'tcsh' is not one of 'bash', 'zsh', 'fish'" in refused("completion", "tcsh")


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("mahovik veri", ["plain,verify", "plain,verify-programme"]),
        ("mahovik new be", ["plain,bench8"]),
        ("mahovik generate --rea", ["plain,--real"]),
        ("mahovik generate --real ", ["plain,double", "plain,float"]),
    ],
)
def test_what_is_completed(words: str, found: list[str]) -> None:
    """Completion is driven by the variables that the bash script sets."""
    typed = words.split(" ")
    done = subprocess.run(
        [sys.executable, "-c", "import sys; sys.argv[0] = 'mahovik'; from mahovik.out.cli import main; main()"],
        env={
            **os.environ,
            "_MAHOVIK_COMPLETE": "bash_complete",
            "COMP_WORDS": words,
            "COMP_CWORD": str(len(typed) - 1),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.splitlines() == found, done.stderr
