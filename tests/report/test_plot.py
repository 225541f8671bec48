"""Pictures: what panels show, and that the command writes them; the same input gives the same bytes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from mahovik import stands
from mahovik.contract.quantities import RPM
from mahovik.core.motion.programme import save_programme
from mahovik.out.command_line import main
from mahovik.out.report.plot import run, waterfall
from mahovik.out.report.plot.panel import Panel
from mahovik.out.report.plot.programme import panels
from verify.programme.programmes import shaker

SPIN = next(path for path in stands.motions("shaker2") if "spin" in path.name)
WITH = [str(stands.path("shaker2")), "--motion", str(SPIN)]


def plot(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["plot", *map(str, arguments)])


@pytest.fixture
def programme(tmp_path: Path) -> Path:
    path = tmp_path / "p.json"
    save_programme(shaker()[2], path)
    return path


def by_quantity(found: list[Panel], word: str) -> Panel:
    (panel,) = (panel for panel in found if panel.quantity.startswith(word))
    return panel


def test_a_right_programme_achieves_what_is_required() -> None:
    stand, motion, found = shaker()
    shown = panels(found, stand, motion)
    for word in ("O1", "attitude"):
        lines = by_quantity(shown, word).lines
        for line, wanted in zip(lines[:3], lines[3:], strict=True):
            assert not line.dashed and wanted.dashed and line.colour == wanted.colour
            assert np.allclose(line.y, wanted.y, atol=1e-5)
    z = by_quantity(shown, "O1").lines[2].y
    assert z.max() == pytest.approx(0.577162538232, rel=1e-6)  # mm, by the motion file
    residual = by_quantity(shown, "residual")
    assert residual.log and residual.lines[0].y.max() < residual.lines[1].y[0]


@pytest.mark.slow
def test_the_command_writes_pictures(programme: Path, tmp_path: Path) -> None:
    assert plot(*WITH, "--programme", programme, "-o", tmp_path / "a.png").exit_code == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    for name in ("a.svg", "b.svg"):
        assert plot("--programme", programme, "-o", tmp_path / name).exit_code == 0
    first = (tmp_path / "a.svg").read_bytes()
    assert first.startswith(b"<?xml") and b"dc:date" not in first
    assert (tmp_path / "b.svg").read_bytes() == first


def test_a_run_is_drawn(tmp_path: Path) -> None:
    rows = [[0.1 * i, 1e-3 * i, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0 * i, 0.5] for i in range(5)]
    head = "t [s],x [m],y [m],z [m],qw,qx,qy,qz,phi_dot w1 [rad/s],tau w1 [N m]"
    path = tmp_path / "run.csv"
    path.write_text("\n".join([head, *(",".join(map(repr, row)) for row in rows)]) + "\n")
    shown = run.panels(run.read(path))
    assert by_quantity(shown, "O1").lines[0].y[-1] == pytest.approx(4.0)  # mm
    assert by_quantity(shown, "speed").lines[0].y[-1] == pytest.approx(40.0 * RPM)
    assert {line.name for panel in shown for line in panel.lines} >= {"x", "y", "z", "w1"}
    assert plot("--run", path, "-o", tmp_path / "run.png").exit_code == 0


def test_of_a_held_run_what_moves_and_the_reaction_are_shown() -> None:
    t = np.linspace(0.0, 3.0, 31)
    zero, angle = 0.0 * t, 2.0 * np.pi * t  # three whole turns
    columns = {"t [s]": t} | {f"{a} [m]": zero for a in "xyz"} | {f"v_{a} [m/s]": zero for a in "xyz"}
    columns |= {"qw": np.cos(angle / 2), "qx": zero, "qy": np.sin(angle / 2), "qz": zero}
    columns |= {f"hold.reaction.{a} [N]": zero + 5.0 for a in "xyz"}
    columns |= {f"hold.reaction.{a} [N m]": zero + 1e-17 for a in "kmn"}
    shown = run.panels(columns)
    assert [panel.quantity.partition(",")[0] for panel in shown] == ["turn", "force of the hold"]
    turn = by_quantity(shown, "turn, deg").lines[1].y
    assert np.abs(turn - np.degrees(angle)).max() < 1e-9
    free = {name: values for name, values in columns.items() if not name.startswith("hold")}
    assert [panel.quantity.partition(",")[0] for panel in run.panels(free)] == ["O1", "turn", "carrier"]


def test_a_waterfall_follows_the_speed_and_has_the_amplitude() -> None:
    t = np.linspace(0.0, 3.999, 4000)
    speed = 20.0 * np.pi * (1.0 + t)  # 10 Hz to 50 Hz
    phase = 20.0 * np.pi * (t + t**2 / 2)
    columns = {"t [s]": t, "hold.reaction.x [N]": 9.81 + 3.0 * np.cos(phase), "phi_dot w1 [rad/s]": speed}
    lines, levels = waterfall.panels(columns, "hold.reaction.x")
    assert levels.levels is not None and levels.levels.quantity == "hold.reaction.x, N"
    value, edges = levels.levels.value, levels.levels.x
    assert value.shape == (len(levels.levels.y) - 1, len(edges) - 1)
    turning = levels.lines[0]
    for row, (hertz, time) in enumerate(zip(turning.x, turning.y, strict=True)):
        assert hertz == pytest.approx(10.0 * (1.0 + time))
        k = int(np.nanargmax(value[row]))
        assert edges[k] - 2.0 <= hertz <= edges[k + 1] + 2.0  # a spectrum is 4 Hz wide
    assert 1.5 < np.nanmax(value) <= 3.0  # smeared over the 2.5 Hz by which the speed rises in a stretch
    assert len(lines.lines) == waterfall.CASCADE
    steady = waterfall.panels(columns | {"hold.reaction.x [N]": 3.0 * np.cos(80.0 * np.pi * t)}, "hold.reaction.x [N]")
    assert steady[1].levels is not None and np.nanmax(steady[1].levels.value) == pytest.approx(3.0, rel=1e-3)


@pytest.mark.parametrize(
    ("rows", "name", "words"),
    [
        (300, "hold.reaction.y", 'no column "hold.reaction.y", did you mean'),
        (300, "t", 'no column "t"'),
        (30, "hold.reaction.x", "30 rows, expected at least 256"),
        (-300, "hold.reaction.x", "not evenly spaced"),
    ],
)
def test_what_has_no_waterfall_is_refused(rows: int, name: str, words: str, tmp_path: Path) -> None:
    times = [0.1 * i + (0.01 if rows < 0 and i > 100 else 0.0) for i in range(abs(rows))]
    path = tmp_path / "run.csv"
    path.write_text("t [s],hold.reaction.x [N]\n" + "".join(f"{t},1.0\n" for t in times))
    found = plot("--run", path, "--waterfall", name, "-o", tmp_path / "w.svg")
    assert found.exit_code == 2 and words in " ".join(found.output.split()), found.output
    assert not (tmp_path / "w.svg").exists()


def test_wrong_use_is_refused(programme: Path, tmp_path: Path) -> None:
    other = [str(stands.path("demo3")), "--motion", str(stands.motions("demo3")[0])]
    for arguments, words in (
        (["--programme", programme, "-o", tmp_path / "a.pdf"], ".svg or .png"),
        (["--programme", programme, *WITH[:1], "-o", tmp_path / "a.svg"], "give both or neither"),
        (["--programme", tmp_path / "none.json", "-o", tmp_path / "a.svg"], "none.json"),
        (["--run", tmp_path / "none.csv", "-o", tmp_path / "a.svg"], "cannot be read"),
        (["--run", programme, "-o", tmp_path / "a.svg"], "expected a Parquet file, or a name that ends in .csv"),
        (["--programme", programme, "--waterfall", "x", "-o", tmp_path / "a.svg"], "--waterfall: only of a run"),
    ):
        found = plot(*arguments)
        assert found.exit_code == 2 and words in found.output, found.output
    assert not (tmp_path / "a.svg").exists()
    found = plot(*other, "--programme", programme, "-o", tmp_path / "a.svg")
    assert found.exit_code == 1 and "programme of another stand" in found.output
    assert not (tmp_path / "a.svg").exists()
