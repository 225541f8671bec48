"""Pictures: what panels show, and that the command writes them; the same input gives the same bytes."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from mahovik import stands
from mahovik.contract.quantities import RPM
from mahovik.core.motion.programme import RunUpTable, Samples, save_programme
from mahovik.core.motion.required.model import Bounds
from mahovik.core.stand import load
from mahovik.out.cli import main
from mahovik.out.report.plot import response as orders
from mahovik.out.report.plot import run, waterfall
from mahovik.out.report.plot.draw import draw, draw_panel
from mahovik.out.report.plot.panel import Line, Mark, Panel, border
from mahovik.out.report.plot.programme import panels
from mahovik.out.report.plot.tags import spread, tag_ends, tag_lines
from mahovik.use.study.response.speeds import read_speeds
from mahovik.use.study.response.sweep import sweep
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


def test_speeds_are_the_windings() -> None:
    stand, motion, found = shaker()
    speeds = by_quantity(panels(found, stand, motion), "speed").lines
    assert [line.name for line in speeds] == [s.name for s in stand.flywheels]
    for line, turns in zip(speeds, found.winding, strict=True):
        assert np.allclose(line.y, 60 * turns / found.span)


def test_bounds_are_shown_where_they_matter() -> None:
    stand, motion, found = shaker()
    fast = replace(motion, bounds=Bounds(speed=(130.0, 130.0)))
    assert [line.y[0] for line in by_quantity(panels(found, stand, fast), "speed").lines[2:]] == [
        130.0 * RPM,
        -130.0 * RPM,
    ]
    loose = by_quantity(panels(found, stand, replace(motion, bounds=Bounds(speed=(1e4, 1e4)))), "speed")
    assert len(loose.lines) == 2 and loose.note == "bound: 95493"


def test_run_ups_have_a_panel_of_their_own() -> None:
    _, _, found = shaker()
    rest = np.zeros((2, 2))
    table = RunUpTable(1.0, Samples(np.array([0.0, 1.0]), rest, np.array([[0.0, 0.0], [100.0, -100.0]]), rest))
    panel = by_quantity(panels(replace(found, runup=table)), "run-up")
    assert panel.lines[0].y[-1] == pytest.approx(100.0 * RPM)


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


def test_a_run_that_follows_is_shown_at_its_end_and_its_error_all_along() -> None:
    t = np.arange(1000) * 1e-3
    wave = 1e-3 * np.sin(20 * np.pi * t)
    columns = {"t [s]": t, "tau w1 [N m]": wave, "omega_x [rad/s]": wave}
    for name, unit in (("x", "m"), ("y", "m"), ("z", "m"), ("psi", "rad"), ("theta", "rad"), ("phi", "rad")):
        columns |= {f"{name} [{unit}]": 1.1 * wave, f"required_{name} [{unit}]": wave}
    shown = run.panels(columns)
    for word in ("O1", "attitude", "carrier", "drive torque"):
        assert by_quantity(shown, word).lines[0].x[0] == t[-run.LAST_SAMPLES]
    error = by_quantity(shown, "error of O1").lines[0]
    assert len(error.x) == 1000 and np.abs(error.y).max() == pytest.approx(0.1, rel=0.01)


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


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", 'expected a column "t [s]" and rows'),
        ("t [s],x [m]\n", 'expected a column "t [s]" and rows'),
        ("t [s],x [m]\n0.0,a\n", "no run of `mahovik simulate`"),
        ("t [s],x [m]\n0.0\n", "no run of `mahovik simulate`"),
    ],
)
def test_what_is_no_run_is_refused(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text(text)
    found = plot("--run", tmp_path / "run.csv", "-o", tmp_path / "run.svg")
    assert found.exit_code == 2 and words in found.output and not (tmp_path / "run.svg").exists()


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


def test_many_flywheels_stay_apart() -> None:
    t = np.linspace(0.0, 1.0, 5)
    lines = tuple(Line(f"w{i}", t, t * i, i) for i in range(24))
    assert draw("many", [Panel("speed", lines)], ".svg").count(b"<path") > 24


def test_a_tag_stands_at_the_end_of_its_line_and_is_not_in_the_legend() -> None:
    """One line ends at the right edge, one at the top, one is nowhere in the frame."""
    x = np.linspace(0.0, 1.0, 5)

    def paths(tag: str, factor: float) -> int:
        line = Line("", x, factor * x + (9.0 if factor > 9.0 else 0.0), tag=tag)
        return draw("orders", [Panel("f", (line,), span=(0.0, 1.0), top=2.0)], ".svg").count(b"<use")

    for factor in (1.0, 4.0):
        assert paths("1 x w1", factor) > paths("", factor)
    assert paths("1 x w1", 10.0) == paths("", 10.0)


def test_marks_stretches_and_borders_are_drawn() -> None:
    x = np.linspace(1.0, 10.0, 5)
    plain = Panel("f", (Line("a", x, x),))
    rich = replace(plain, marks=(Mark(2.0, 2.0, "meets"),), shaded=((3.0, 4.0),), log_abscissa=True)
    bare = draw("t", [plain], ".svg")
    assert draw("t", [rich], ".svg") != bare
    for change in ({"marks": rich.marks}, {"shaded": rich.shaded}, {"log_abscissa": True}):
        assert draw("t", [replace(plain, **change)], ".svg") != bare
    assert border("limit", 5.0, 1.0, 10.0).x.tolist() == [5.0, 5.0]


def test_readings_of_points_have_panels() -> None:
    t = np.linspace(0.0, 1.0, 4)
    columns = {"t [s]": t} | {f"force_{a} p{k} [m/s2]": k * t for k in range(9) for a in "xyz"}
    shown = [panel for panel in run.panels(columns) if panel.quantity.startswith("specific force")]
    assert [panel.quantity for panel in shown] == [f"specific force at p{k}, m/s2" for k in range(run.MOST)]
    assert shown[-1].note == "and 3 more points in the run" and shown[2].lines[1].y[-1] == 2.0


def test_long_names_of_orders_are_cut() -> None:
    assert orders._short("1 x w1, w2, w3, w4 = 2 x w5, w6") == "1 x w1 .. w4 = 2 x w5, w6"
    assert orders._first("2 x w1, w2 = 1 x w3") == "2 x w1"


def test_tags_of_lines_stay_apart() -> None:
    """Orders that leave the frame near one another have tags at different places along their lines."""
    figures = import_module("matplotlib.figure")
    axes = figures.Figure(figsize=(5.0, 3.0)).add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set(xlim=(0.0, 600.0), ylim=(0.0, 20.0))
    x = np.linspace(0.0, 600.0, 61)
    lines = [Line("", x, k * x / 60.0, None, tag=f"{k} x wheel") for k in (1.0, 1.9, 2.0, 2.1, 2.2)]
    rooms = tag_lines(axes, lines, "#777777")
    assert len(rooms) == len(lines)
    assert not any(a.meets(b) for i, a in enumerate(rooms) for b in rooms[:i])


def test_tags_outside_the_frame_stand_at_the_ends_of_their_own_lines() -> None:
    """Above the frame or at its right, in the order of the lines, no line of the frame across them."""
    figures = import_module("matplotlib.figure")
    axes = figures.Figure(figsize=(5.0, 3.0)).add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set(xlim=(0.0, 600.0), ylim=(0.0, 20.0))
    x = np.linspace(0.0, 600.0, 61)
    orders_of = (1.0, 1.9, 2.0, 3.0, 5.0)
    lines = [Line("", x, k * x / 60.0, None, tag=f"{k:g} x wheel") for k in orders_of]
    rooms, above = tag_ends(axes, lines, "#777777")
    width, height = 0.8 * 5.0 * 72.0, 0.8 * 3.0 * 72.0
    assert len(rooms) == len(lines) and above > 10.0
    assert not any(a.meets(b) for i, a in enumerate(rooms) for b in rooms[:i])
    assert all(room.left > width or room.low > height for room in rooms)
    ends = {words.get_text(): np.array(words.xy) * [width, height] for words in axes.texts}
    for k in orders_of:
        end = (width, height * k / 2.0) if k <= 2.0 else (width * 2.0 / k, height)
        assert ends[f"{k:g} x wheel"] == pytest.approx(end, rel=1e-9)


def test_rooms_are_spread_no_further_than_needed() -> None:
    assert spread([10.0, 50.0], [20.0, 20.0]) == [10.0, 50.0]
    assert spread([10.0, 12.0, 90.0], [20.0, 20.0, 30.0], 100.0) == [10.0, 30.0, 85.0]
    assert spread([95.0, 96.0], [20.0, 20.0], 100.0) == [70.0, 90.0]


@pytest.mark.parametrize(("low", "high"), [(1e-5, 0.09), (1e-4, 2.0), (0.01, 1.0), (10.0, 1e4), (10.0, 1e6)])
def test_an_axis_writes_all_its_numbers_in_one_way(low: float, high: float) -> None:
    axes = import_module("matplotlib.figure").Figure().add_subplot()
    draw_panel(axes, Panel("q", (Line("a", np.array([1.0, 2.0]), np.array([low, high]), 0),), log=True))
    begin, end = axes.get_ylim()
    labels = [axes.yaxis.get_major_formatter()(x) for x in axes.yaxis.get_major_locator()() if begin <= x <= end]
    assert len(labels) > 1
    assert len({"10" in each and each.isascii() is False for each in labels}) == 1


def test_a_map_of_levels_stands_beside_the_waterfall() -> None:
    """Cells hold the largest amplitude of their speed and frequency; the scale begins at the floor."""
    stand = load(stands.path("bench8"))
    asked = read_speeds(stand, ("w1=100..600rpm",))
    found = sweep(stand, asked, 3, "carrier", quantity="acceleration")
    shown = orders.panels(found)
    assert [panel.beside for panel in shown] == [False, True, False, True]
    waterfall, levels = shown[2], shown[3].levels
    assert waterfall.abscissa == shown[3].abscissa == "frequency, Hz" and levels is not None
    assert levels.value.shape == (len(levels.y) - 1, len(levels.x) - 1) == (3, orders.CELLS)
    for row, step in zip(levels.value, found.steps, strict=True):
        assert np.nanmax(row) == step.sizes[1:].max()
    assert np.nanmin(levels.value) > levels.least and levels.quantity == "acceleration, m/s2"
    assert draw("bench8", shown, ".png").startswith(b"\x89PNG")
