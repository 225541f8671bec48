"""`mahovik evidence`: verdicts, exit status, a folder that is whole or not there, a page that stands alone."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import mahovik.proof.evidence as all_pieces
from mahovik import __version__
from mahovik.core.stand import load
from mahovik.core.stand.structure import identities
from mahovik.errors import UsageError
from mahovik.out.command_line import main
from mahovik.proof.evidence import PIECES, Subject, Verdict, check, conclusion, failures
from mahovik.stands import path
from report.reports import ABLE, BAD, DEMO3, GOOD, collected, piece, read
from toolchain.quick import quick
from toolchain.tools import require

NAMED = {piece.name: piece for piece in PIECES}


def command(monkeypatch: pytest.MonkeyPatch, pieces: tuple[object, ...], *arguments: str) -> Result:
    """The command with other pieces."""
    monkeypatch.setattr(all_pieces, "PIECES", pieces)
    monkeypatch.delenv("CI", raising=False)
    return CliRunner().invoke(main, ["evidence", *arguments])


def test_the_folder_is_whole_and_sealed(tmp_path: Path) -> None:
    """C, stand file, raw output, page, summary; sums that `sha256sum` takes, and a change is seen."""
    folder = tmp_path / "out"
    collected(folder, [GOOD, BAD, ABLE])
    names = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    wanted = {"index.html", "evidence.json", "SHA256SUMS", "demo3.toml", "c/demo3.c", "c/manifest.json"}
    assert wanted | {"raw/good/output.txt"} <= names
    assert (folder / "demo3.toml").read_bytes() == Path(DEMO3).read_bytes()
    assert list(tmp_path.iterdir()) == [folder]
    assert check(folder) == []
    require("sha256sum", "coreutils")
    done = subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=folder, capture_output=True, check=False)
    assert (done.returncode, done.stdout + done.stderr) == (0, b"")
    (folder / "raw" / "good" / "output.txt").write_text("better\n")
    (folder / "c" / "demo3.h").unlink()
    (folder / "demo3.toml").unlink()
    (folder / "demo3.toml").symlink_to(DEMO3)  # the same text, but not what was written
    (folder / "more.txt").write_text("")
    lines = [line.replace(str(folder), "") for line in check(folder)]
    changed = ["/demo3.toml: was changed", "/raw/good/output.txt: was changed"]
    assert lines == ["/c/demo3.h: is missing", *changed, "/more.txt: is not listed"]


def test_verdicts_are_summed_up(tmp_path: Path) -> None:
    """A failure fails; a missing tool fails only where that is asked; what is left out never runs."""
    unwanted = piece("unwanted", "exit 1")
    outcomes = collected(tmp_path / "out", [GOOD, BAD, ABLE, unwanted], wanted={"good", "bad", "able"})
    assert [outcome.verdict for outcome in outcomes] == [
        Verdict.PASSED,
        Verdict.FAILED,
        Verdict.MISSING,
        Verdict.LEFT_OUT,
    ]
    assert failures(outcomes) == ["bad"]
    assert failures(outcomes, strict=True) == ["bad", "able"]
    assert conclusion(outcomes) == (
        "1 of 2 pieces passed; FAILED: bad; not run: tool missing: able; left out by option: unwanted"
    )
    summary = json.loads((tmp_path / "out" / "evidence.json").read_text())
    assert [entry["verdict"] for entry in summary["pieces"]] == [outcome.verdict.value for outcome in outcomes]
    assert summary["structure"] == identities(load(DEMO3)).structure


@pytest.mark.slow
@pytest.mark.parametrize("stop", [KeyboardInterrupt(), RuntimeError("a bug")])
def test_an_interrupted_run_leaves_nothing(tmp_path: Path, stop: BaseException) -> None:
    """Nothing is left beside the place either; what was there stays as it was."""

    def say(name: str, what: str) -> None:
        if (name, what) == ("good", ""):
            raise stop

    with pytest.raises(type(stop)):
        collected(tmp_path / "out", [GOOD, BAD], say=say)
    assert list(tmp_path.iterdir()) == []
    collected(tmp_path / "out", [GOOD])
    before = (tmp_path / "out" / "SHA256SUMS").read_text()
    with pytest.raises(type(stop)):
        collected(tmp_path / "out", [BAD, GOOD], say=say)
    assert (tmp_path / "out" / "SHA256SUMS").read_text() == before
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]
    assert check(tmp_path / "out") == []


@pytest.mark.parametrize("what", quick(2, ["foreign", "changed", "other stand", "added", "file", "link"]))
def test_what_is_somebody_elses_is_refused(tmp_path: Path, what: str) -> None:
    """It is refused before anything is run, and nothing is touched."""
    folder = tmp_path / "out"
    if what == "foreign":
        folder.mkdir()
        (folder / "letter.txt").write_text("dear reader\n")
    elif what == "file":
        folder.write_text("dear reader\n")
    elif what == "link":
        (tmp_path / "elsewhere").mkdir()
        folder.symlink_to(tmp_path / "elsewhere")
    else:
        collected(folder, [GOOD])
        if what == "other stand":
            text = (folder / "evidence.json").read_text()
            (folder / "evidence.json").write_text(text.replace('"stand": "demo3"', '"stand": "demo4"'))
        elif what == "added":
            (folder / "letter.txt").write_text("dear reader\n")
        else:
            (folder / "index.html").write_text("all is well\n")
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(UsageError, match="nothing was written"):
        collected(folder, [piece("unrun", f"touch {tmp_path}/run")])
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_the_page_stands_alone(tmp_path: Path) -> None:
    """Well-formed, no script, every address is a place on it or a file of the folder; no date; markup is escaped."""
    hostile = piece("hostile", "echo >a.txt", notes=("<script>alert(1)</script> & `<b>`",), kept=("a.txt",))
    collected(tmp_path / "out", [GOOD, BAD, ABLE, hostile])
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    parsed = read(page)
    assert parsed.wrong == []
    assert not re.search(r"<(script|link|img|iframe|b)\b", page)
    assert not re.search(r"https?:|url\(|@import", page)
    ids = {value for _, key, value in parsed.attributes if key == "id"}
    for address in (value for _, key, value in parsed.attributes if key in ("src", "href")):
        assert address[1:] in ids if address.startswith("#") else (tmp_path / "out" / address).is_file()
    hashes = identities(load(DEMO3))
    for text in (
        hashes.structure,
        hashes.physics,
        f"mahovik {__version__}",
        "apt-get install no-such-tool",
        "<span>again</span> <span>a-difference;</span>",
    ):
        assert text in page
    assert not re.search(r"\b(19|20)\d\d-\d\d-\d\d\b", page)
    assert str(tmp_path) not in page


def test_exit_status_and_options(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """1 for a failure, and in CI for a missing tool; 2 for a name that is no piece."""
    place = ["-o", str(tmp_path / "out")]
    assert command(monkeypatch, (GOOD, ABLE), DEMO3, *place).exit_code == 0
    done = command(monkeypatch, (GOOD, BAD), DEMO3, *place)
    assert done.exit_code == 1 and "bad: failed, or not run because a tool is missing" in done.stdout
    done = command(monkeypatch, (ABLE,), DEMO3, *place)
    assert done.exit_code == 1 and "no piece was run; not run: tool missing: able" in done.stdout
    assert "no piece was run, so nothing is shown: install what the page names" in done.stdout
    assert command(monkeypatch, (GOOD, BAD), DEMO3, *place, "--only", "good").exit_code == 0
    assert command(monkeypatch, (GOOD, BAD), "--check", str(tmp_path / "out")).exit_code == 0
    (tmp_path / "out" / "demo3.toml").write_text("")
    done = command(monkeypatch, (GOOD, BAD), "--check", str(tmp_path / "out"))
    assert (done.exit_code, done.stderr.splitlines()) == (1, [f"error: {tmp_path / 'out' / 'demo3.toml'}: was changed"])
    assert command(monkeypatch, (GOOD, BAD), DEMO3, "-o", str(tmp_path / "new"), "--only", "goood").exit_code == 2
    assert not (tmp_path / "new").exists()
    assert command(monkeypatch, (GOOD,)).exit_code == 2
    assert command(monkeypatch, (GOOD,), "--check", str(tmp_path)).exit_code == 2
    monkeypatch.setattr(all_pieces, "PIECES", (GOOD, ABLE))
    strict = CliRunner().invoke(main, ["evidence", DEMO3, "-o", str(tmp_path / "ci")], env={"CI": "true"})
    assert strict.exit_code == 1


@pytest.mark.slow
@pytest.mark.parametrize(("real", "more"), [("double", []), ("float", ["--only", "delivery,selftest,warnings"])])
def test_demo3_passes(tmp_path: Path, real: str, more: list[str]) -> None:
    """All of it in double, most of it in float, by a process of its own; nothing tells where it was made."""
    for tool, package in (("clang", "clang"), ("cppcheck", "cppcheck"), ("frama-c", "frama-c-base")):
        require(tool, package)
    words = ["evidence", str(path("demo3")), "-o", "out", "--real", real, *more]
    done = subprocess.run(
        [sys.executable, "-m", "mahovik", *words], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert check(tmp_path / "out") == []
    for file in (tmp_path / "out").rglob("*"):
        if file.is_file():
            text = file.read_text(encoding="utf-8", errors="replace")
            assert str(tmp_path) not in text, file
            assert "mahovik-" not in text or "mahovik-dev" in text, file


def test_a_piece_is_its_command(tmp_path: Path) -> None:
    """Its output is kept, its exit status is the verdict, and what it writes is not part of the evidence."""
    first = "mahovik check demo3.toml >/dev/null && mkdir more && echo 1 >more/a.txt && echo $PWD; "
    right = replace(GOOD, command=lambda _: f"{first} test -f demo3.toml", kept=("more/*",))
    wrong = replace(right, name="wrong", command=lambda _: f"{first} test -d demo3.toml")
    outcomes = collected(tmp_path / "out", [right, wrong])
    assert [outcome.verdict for outcome in outcomes] == [Verdict.PASSED, Verdict.FAILED]
    assert outcomes[0].files == {"output.txt": b"good\n", "a.txt": b"1\n"}
    assert not (tmp_path / "out" / "more").exists()


def test_the_judges_have_nothing_to_judge(tmp_path: Path) -> None:
    stand = load(DEMO3)
    weightless = replace(stand, carrier=replace(stand.carrier, mass=0.0), instruments=(), flywheels=())
    subject = Subject(weightless, "double", tmp_path, tmp_path)
    assert NAMED["judges"].idle(subject) == "no body of the stand has a mass"
    assert "double" in NAMED["judges"].idle(replace(subject, real="float"))


def test_own_evidence_is_replaced(tmp_path: Path) -> None:
    """The old folder is replaced as a whole: nothing of it is left."""
    collected(tmp_path / "out", [GOOD])
    collected(tmp_path / "out", [BAD])
    assert not (tmp_path / "out" / "raw" / "good").exists()
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]
