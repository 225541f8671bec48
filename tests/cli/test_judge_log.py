"""verify of a log: a good one passes whatever a serial terminal did to it, and nothing else does."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from cli.run import DEMO3, process, refused, run
from emit.selftests import generate_with_selftest, run_selftest
from mahovik.core.emit.generate import Generated
from mahovik.core.stand import identities, load
from mahovik.core.stand.model import Stand
from mahovik.proof.verify import selftest

SWEEP = 20


def functions() -> list[str]:
    """Public functions of demo3."""
    return [f.name for f in generate_with_selftest("demo3")[0].program.functions if f.public]


@pytest.fixture(scope="module", autouse=True)
def run_selftests_once() -> Iterator[None]:
    """The C of this machine is built and run once for each sweep."""
    original = selftest._hashes
    known: dict[tuple[str, int], Any] = {}

    def once(stand: Stand, made: Generated, sweep: int) -> Any:
        key = (made.program.precision.name, sweep)
        if key not in known:
            known[key] = original(stand, made, sweep)
        return known[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(selftest, "_hashes", once)
        patch.setattr(
            selftest,
            "generate_all",
            lambda stand, real, only: generate_with_selftest(stand.name, real)[0],
        )
        yield


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Output of a board with the C of demo3."""
    return board("double", tmp_path_factory.mktemp("board"))


def board(real: str, folder: Path) -> str:
    """Builds and runs the self-test of demo3."""
    status, text = run_selftest(
        generate_with_selftest("demo3", real)[1], "demo3", folder, "gcc", "-O2", f"-DDEMO3_SELFTEST_SWEEP={SWEEP}"
    )
    assert status == 0
    return str(text)


@pytest.fixture
def log(printed: str, tmp_path: Path) -> Path:
    path = tmp_path / "board.log"
    path.write_text(printed)
    return path


def rewritten(path: Path, text: str | bytes) -> str:
    """The path of the log with another text."""
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return str(path)


def test_a_good_log(log: Path) -> None:
    result = run("verify", DEMO3, str(log))
    hashes = identities(load(DEMO3))
    assert result.exit_code == 0
    assert result.output.startswith(f"PASS   {log}\n") and "checked: identities, " in result.output
    row = next(line.split() for line in result.output.splitlines() if line.startswith(" demo3 "))
    assert row == ["demo3", "double", hashes.structure, hashes.physics, str(len(functions())), str(SWEEP)]
    assert f"sweep of {SWEEP} states, double, by gcc" in result.output
    assert "not checked" not in result.output


@pytest.mark.parametrize(
    "spoil",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: f"\x00\xffU-Boot 2024\n~ boot: ok\n>>> run\n{text}>>> \nfailures 3\n\x1b[0m",
        lambda text: re.sub("^", "[00:00:01.250] ", text, flags=re.MULTILINE),
        lambda text: text.replace("sweep", "heap 1200\n  \nsweep"),
        lambda text: text.replace("\n", "  \t\n"),
        lambda text: text.rstrip("\n"),
        lambda text: text + text,
    ],
    ids=["CRLF", "CR", "junk around", "time stamps", "junk within", "spaces", "no last line end", "reset"],
)
def test_what_a_terminal_does_is_no_fault(spoil: Callable[[str], str], printed: str, log: Path) -> None:
    result = run("verify", DEMO3, rewritten(log, spoil(printed).encode("latin-1")))
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (r"structure \w+", "structure 00000000", "structure 00000000, the stand file has "),
        (r"physics \w+", "physics 00000000", "physics 00000000, the stand file has "),
        (r"selftest demo3", "selftest demo4", "stand demo4, the stand file has demo3"),
        (r"generator mahovik \S+", "generator mahovik 0.0.1", "made by mahovik 0.0.1, this is "),
        pytest.param(
            r"real double", "real float", "other bits in the sweep of 20 states: forward ", marks=pytest.mark.slow
        ),
        (
            r"coupled PASS cases 5 worst 0",
            "coupled FAIL cases 5 wrong 1 worst 9",
            "ulp: coupled FAIL cases 5 wrong 1 worst 9 ulp",
        ),
        (r"torque PASS.*\n", "", "no line PASS or FAIL of: torque"),
        (r"torque PASS", "torqqe PASS", "no line PASS or FAIL of: torque"),
        (
            r"torque PASS cases 5 worst 0",
            "torque PASS cases 5 worst 3",
            "expected PASS cases 5 worst 0 ulp: torque PASS cases 5 worst 3 ulp",
        ),
        (
            r"torque PASS cases 5 worst 0",
            "torque PASS cases 5 worst more than 1000000",
            "torque PASS cases 5 worst more than 1000000",
        ),
        (r"torque PASS cases 5", "torque PASS cases 5 wrong 1", "torque PASS cases 5 wrong 1"),
        (
            r"torque PASS cases 5 worst 0",
            "torque FAIL cases 5 wrong 1 worst more than 1000000",
            "torque FAIL cases 5 wrong 1 worst more than 1000000 ulp",
        ),
        (r"sweep 20\n", "sweep 99999999999\n", "sweep of 99999999999 states: at most 1000000 are judged"),
        (r"sweep 20\n", f"sweep {'9' * 5000}\n", "no line, the log is not whole: sweep"),
        (r"torque PASS cases 5", "torque PASS cases 4", "expected PASS cases 5 worst 0 ulp: torque PASS cases 4"),
        (r"(torque PASS.*\n)", r"\1torque PASS cases 5 worst 1 ulp\n", "two lines that differ: torque"),
        (r"sweep 20\n", "", "no line, the log is not whole: sweep"),
        pytest.param(
            r"sweep 20\n", "sweep 21\n", "other bits in the sweep of 21 states: forward", marks=pytest.mark.slow
        ),
        (r"\nmomentum \w{8}\n", "\n", "no hash of the sweep of: momentum"),
        (
            r"\nmomentum \w{8}\n",
            "\nmomentum 00000000\n",
            "other bits in the sweep of 20 states: momentum 00000000, here ",
        ),
        (r"failures 0", "failures 2", "failures 2, but 0 lines say FAIL"),
        (r"failures 0\n", "", "no line, the log is not whole: failures"),
    ],
)
def test_what_was_tampered_with_is_found(old: str, new: str, words: str, printed: str, log: Path) -> None:
    text, count = re.subn(old, new, printed, count=1)
    assert count == 1
    said = refused("verify", DEMO3, rewritten(log, text), status=1)
    assert words in said
    assert said.startswith(f"error: {log}: ")


def test_every_truncated_end_is_found(printed: str, log: Path) -> None:
    lines = printed.splitlines(keepends=True)
    for count in range(1, len(lines)):
        assert run("verify", DEMO3, rewritten(log, "".join(lines[:count]))).exit_code == 1, lines[count - 1]


@pytest.mark.slow
def test_without_a_compiler_a_sweep_is_not_judged(log: Path) -> None:
    done = process("verify", DEMO3, str(log), "--only", ",".join(functions()), PATH="")
    assert done.returncode == 1  # not everything that was asked for was checked
    assert f"not checked: sweep of {SWEEP} states, double: no C compiler here" in done.stdout


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_a_log_in_utf_16_is_told_so(encoding: str, printed: str, log: Path) -> None:
    words = refused("verify", DEMO3, rewritten(log, printed.encode(encoding)))
    assert words.startswith(f"error: {log}: is not plain text (UTF-16?): save it as UTF-8")


def test_the_verdict_as_json(printed: str) -> None:
    Path("board.log").write_text(printed)
    verdict = json.loads(run("verify", DEMO3, "board.log", "--json").stdout)
    assert [judged["functions"] for judged in verdict["runs"]] == [len(functions())]
    assert verdict["unchecked"] == []
    Path("board.log").write_text(printed.replace("PASS", "FAIL", 1))
    result = run("verify", DEMO3, "board.log", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["error"]
