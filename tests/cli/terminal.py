"""A command on a terminal of a given size: what a user sees, escape sequences and all."""

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
