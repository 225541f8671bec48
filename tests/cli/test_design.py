"""mahovik design: the files, the table, JSON, refusals, exit statuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.motion.programme import load_programme
from mahovik.core.stand import load
from mahovik.stands import path

SHAKER2 = str(path("shaker2"))
MOTION = str(Path(SHAKER2).with_name("shaker2.motion.json"))
FREE = """
schema = 1
speed = [-1, 1]
harmonics = 0
quality = 1e-9
[[free]]
unbalance = { min = 0, max = "%s kg mm" }
[cost]
unbalance = 0
"""


def free_file(tmp_path: Path, most: str = "3") -> str:
    """A file of what is free: the unbalances."""
    file = tmp_path / "free.toml"
    file.write_text(FREE % most, encoding="utf-8")
    return str(file)


def test_stand_and_programme_are_written(tmp_path: Path) -> None:
    """Both are read back, of each other; the table says what changed; nothing else is left in the folder."""
    out = tmp_path / "out.toml"
    given = ("design", SHAKER2, "--motion", MOTION, "--free", free_file(tmp_path), "-o", str(out))
    result = run(*given)
    assert result.exit_code == 0, result.output
    assert result.stdout.endswith("\nOK\n")
    assert "total unbalance 4000 -> 2079 g mm" in result.stdout
    assert "unbalance_at" in result.stdout
    stand, programme = load(out), load_programme(out.with_suffix(".json"))
    assert programme.stand == stand.name
    assert programme.report["verified"] is True
    assert out.read_text(encoding="utf-8").startswith(
        "# Designed by `mahovik design` from shaker2.toml for shaker2.motion"
    )
    assert sorted(p.name for p in tmp_path.iterdir()) == ["free.toml", "out.json", "out.toml"]


def test_what_no_design_can_do_writes_nothing(tmp_path: Path) -> None:
    """One line, status 2."""
    out = tmp_path / "out.toml"
    said = refused("design", SHAKER2, "--motion", MOTION, "--free", free_file(tmp_path, "0.9"), "-o", str(out))
    assert said.startswith("error: motion shaker2_z: no design does this: along z")
    assert len(said.splitlines()) == 1
    assert not out.exists()


def test_nothing_found_says_what_was_tried(tmp_path: Path) -> None:
    """Status 1: cut before the first start."""
    out = tmp_path / "out.toml"
    result = run("design", SHAKER2, "--motion", MOTION, "--free", free_file(tmp_path), "-o", str(out), "--time", "1e-4")
    assert result.exit_code == 1
    assert result.stdout == "NO_DESIGN\n"
    assert "cut by time" in result.stderr
    assert "give it more time" in result.stderr
    assert "inf" not in result.stderr
    assert not out.exists()


@pytest.mark.parametrize(
    "options,words",
    [
        (("--free", "positon"), 'unknown key "positon", did you mean "position"?'),
        (("--free", "none.toml"), "none.toml: no such file"),
        (("--free", "position", "-o", "out.json"), "expected a name that ends in .toml"),
        (("--free", "position", "-o", "/proc/out.toml"), "cannot be written"),
        (("--free", "position", "-o", "/proc/out.toml"), "/proc/out.toml: cannot be written"),
        (("--free", "position", "-o", SHAKER2), "is read by this command"),
        (("--free", "position", "--time", "0"), "--time"),
        (("--free", "position", "--pareto", "1"), "--pareto"),
    ],
)
def test_options_that_mean_nothing(options: tuple[str, ...], words: str) -> None:
    """Status 2, what was expected."""
    assert words in refused("design", SHAKER2, "--motion", MOTION, "-o", "out.toml", *options)


def test_balanced_flywheels_have_no_unbalance_to_change() -> None:
    """Bounds by default would be zero to zero."""
    motion = str(Path(DEMO3).with_name("demo3.motion.json"))
    said = refused("design", DEMO3, "--motion", motion, "--free", "unbalance", "-o", "out.toml")
    assert "give { min = .., max = .. }" in said
