"""Progress: on terminals only, after a second, gone at the end."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from cli.terminal import on_terminal
from mahovik.out.progress import PATIENCE, Stage

WORK = """
import sys, time
from mahovik.out.progress import progress
steps, unknown = sys.argv[1] == "known", sys.argv[2:]
with progress("verify bench8 with a name that is too long for the narrowest of terminals", 20 if steps else None) as s:
    for k in range(20):
        time.sleep(0.1)
        s.at(k + 1)
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
    assert re.search(r"\d(\.\d+)? /s", plain[-1])
    assert ("━" in plain[-1]) == (kind == "known" and columns == 80)


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


def test_remaining_time_is_of_the_steps_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("mahovik.out.progress.time.monotonic", lambda: now[0])
    stage = Stage("verify", 101)
    now[0] = 10.0  # a compiler ran
    stage.at(1)
    assert stage.rate is None
    now[0] = 15.0
    stage.at(51)
    assert stage.rate == pytest.approx(10.0)
    assert stage.words == "51/101  10 /s  0:05 left"
    now[0] = 16.0  # the next step is not there yet
    assert stage.words == "51/101  10 /s  0:04 left"
    search = Stage("searching")
    now[0] = 90.0
    assert search.words == "1:14"
    run = Stage("simulate", 4.0, "s")
    run.at(0.0)
    now[0] = 92.0
    run.at(1.0)
    assert run.words == "1 s/4 s  0.5 s/s  0:06 left"
