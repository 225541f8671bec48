"""Progress: on terminals only, after a second, gone at the end."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from cli.terminal import on_terminal
from mahovik.out.notices import PATIENCE

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
