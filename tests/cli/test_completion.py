"""What a shell completes."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("mahovik veri", ["plain,verify"]),
        ("mahovik generate --rea", ["plain,--real"]),
        ("mahovik generate --real ", ["plain,double", "plain,float"]),
    ],
)
def test_what_is_completed(words: str, expected: list[str]) -> None:
    """Completion is driven by the variables that the bash script sets."""
    typed = words.split(" ")
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys; sys.argv[0] = 'mahovik'; from mahovik.out.command_line import main; main()",
        ],
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
    assert done.stdout.splitlines() == expected, done.stderr
