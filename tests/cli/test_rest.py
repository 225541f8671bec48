"""What starts from rest."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import run

TURNS = """schema = 1
name = "box"
gravity = [0, 0, -9.81]
[carrier]
mass = "100 kg"
inertia = [3.0, 4.0, 5.0]
buoyancy = { displaced_mass = "100 kg", center = [0, 0, "-50 mm"] }
damping = { linear = [50, 50, 50, 5, 5, 5] }
[[flywheel]]
name = "w"
mass = 1e-9
spin_inertia = 1e-9
transverse_inertia = 1e-9
buoyancy = { displaced_mass = 1e-9 }
"""


@pytest.mark.parametrize(
    "command",
    [
        ("modes",),
        ("simulate", "--until", "0.02", "--every", "0.01", "-o", "a.csv", "--backend", "scipy"),
        ("vibration", "--speed", "w=600rpm", "--at", "carrier"),
    ],
)
def test_what_starts_from_a_turned_rest_pose_says_so(
    command: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The centre of buoyancy is below the centre of mass, so that the box hangs upside down; above it, it does not."""
    line = "warning: starts from rest, turned by 180 deg from E0: see mahovik check"
    name, *options = command
    monkeypatch.chdir(tmp_path)
    for text, warned in ((TURNS, True), (TURNS.replace('"-50 mm"', '"50 mm"'), False)):
        (tmp_path / "box.toml").write_text(text)
        done = run(name, "box.toml", *options)
        assert done.exit_code == 0, done.stderr
        assert done.stderr.splitlines().count(line) == warned
        for file in tmp_path.glob("a.*"):
            file.unlink()
