"""Terminals and pipes: colours, width, what a command shows there, and its line of progress."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from cli.run import AUV6, DEMO3
from mahovik.out.notices import PATIENCE
from mahovik.stands import path
from toolchain.quick import quick

SAT4 = str(path("sat4"))
TABLES = {
    "check": ("check", AUV6),
    "modes": ("modes", SAT4),
    "judge": ("judge", DEMO3, "--with", "cat", "--states", "2"),
}


def words(seen: TerminalOutput) -> str:
    """All that is said, whatever the width: without blanks and lines of boxes."""
    return re.sub(r"[\s─-]", "", "\n".join(seen.lines))


@pytest.mark.parametrize("columns", quick(1, [40, 80]))
@pytest.mark.parametrize("arguments", TABLES.values(), ids=TABLES)
def test_no_line_is_longer_than_the_terminal(arguments: tuple[str, ...], columns: int) -> None:
    seen = on_terminal(*arguments, columns=columns, piped=False)
    complaints = [line for line in seen.lines if line.startswith(("error:", "warning:"))]
    assert all(len(line.rstrip()) <= columns for line in seen.lines if line not in complaints)


def test_a_narrow_terminal_folds_and_never_cuts() -> None:
    narrow, wide = (on_terminal("check", DEMO3, columns=columns) for columns in (40, 200))
    assert "…" not in narrow.screen
    assert sorted(words(narrow)) == sorted(words(wide))


@pytest.mark.parametrize(
    ("env", "coloured"),
    quick(
        2,
        [
            ({}, True),
            ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False),
            ({"NO_COLOR": "1"}, False),
            ({"TERM": "dumb"}, False),
        ],
    ),
)
def test_colours_on_a_terminal(env: dict[str, Any], coloured: bool) -> None:
    """The warning of auv6 is yellow."""
    seen = on_terminal("check", AUV6, **env)
    assert "warning:" in seen.screen
    assert seen.colours == coloured


RUN = "from mahovik.__main__ import run; run()"


@dataclass(frozen=True)
class TerminalOutput:
    """All that was written to the terminal, and what went to standard output where that was a pipe."""

    status: int
    screen: str
    piped: str

    @property
    def colours(self) -> bool:
        """Whether anything was coloured."""
        return re.search(r"\x1b\[(?:\d+;)*(?:3\d|4\d|9\d)(?:;\d+)*m", self.screen + self.piped) is not None

    @property
    def lines(self) -> list[str]:
        """Text on the screen at the end, without escape sequences and lines that were cleared."""
        text = re.sub(r"[^\n]*\n\x1b\[\?25h\r\x1b\[1A\x1b\[2K|[^\n]*\r\x1b\[2K", "", self.screen.replace("\r\n", "\n"))
        return re.sub(r"\x1b\[[?\d;]*[A-Za-z]", "", text).splitlines()


def on_terminal(
    *arguments: str, columns: int = 80, piped: bool = False, code: str = RUN, cwd: Path | None = None, **env: str
) -> TerminalOutput:
    """Runs the command line (or `code`) on a terminal; `piped`: standard error alone is one."""
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    hidden = ("NO_COLOR", "FORCE_COLOR", "COLUMNS", "LINES", "PYTEST_CURRENT_TEST")
    environment = {k: v for k, v in os.environ.items() if k not in hidden} | {"TERM": "xterm-256color"} | env
    process = subprocess.Popen(
        [sys.executable, "-c", code, *arguments],
        stdin=follower,
        stdout=subprocess.PIPE if piped else follower,
        stderr=follower,
        env=environment,
        cwd=cwd,
    )
    os.close(follower)
    screen = b""
    while True:
        try:
            part = os.read(leader, 65536)
        except OSError:  # the last of its users is gone
            break
        if not part:
            break
        screen += part
    output, _ = process.communicate(timeout=60)
    os.close(leader)
    return TerminalOutput(process.returncode, screen.decode(), (output or b"").decode())


WORK = """
import sys, time
from mahovik.out.notices import Progress
from mahovik.out.notices import progress
words = "verify bench8 with a name that is too long for the narrowest of terminals"
with progress(words) as show:
    for k in range(20):
        time.sleep(0.1)
        show(Progress(words, k + 1, 20) if sys.argv[1] == "known" else Progress(words))
print("result")
"""


@pytest.mark.slow
@pytest.mark.parametrize("columns", [40, 80])
@pytest.mark.parametrize("kind", ["known", "unknown"])
def test_a_line_that_fits_and_is_gone_at_the_end(kind: str, columns: int) -> None:
    seen = on_terminal(kind, code=WORK, columns=columns)
    assert seen.lines == ["result"]
    drawn = re.findall(r"(?:^|\x1b\[2K|\x1b\[\?25l)([^\r]+)(?=\r\x1b\[2K)", seen.screen)
    plain = [re.sub(r"\x1b\[[?\d;]*[A-Za-z]", "", line) for line in drawn]
    assert len(plain) > 2
    assert max(map(len, plain)) <= columns
    assert ("left" in plain[-1]) == (kind == "known")  # nothing false where nobody knows the end
    assert ("20/20" if kind == "known" else "0:0") in plain[-1].replace("19/20", "20/20")
    assert ("━" in plain[-1]) == (columns == 80)


def test_results_in_a_pipe_stay_what_they_are() -> None:
    seen = on_terminal("known", code=WORK, piped=True)
    assert seen.piped == "result\n"
    assert "/20" in seen.screen


def test_nothing_in_a_pipe() -> None:
    done = subprocess.run(
        [sys.executable, "-c", WORK, "known"],
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"FORCE_COLOR": "1"},
    )
    assert (done.stdout, done.stderr) == ("result\n", "")


def test_nothing_before_a_second() -> None:
    short = WORK.replace("time.sleep(0.1)", f"time.sleep({PATIENCE / 40})")
    assert on_terminal("known", code=short).screen == "result\r\n"
