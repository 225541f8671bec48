"""mahovik design: the files, the table, JSON, refusals, exit statuses."""

from __future__ import annotations

from pathlib import Path

from cli.run import run
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
