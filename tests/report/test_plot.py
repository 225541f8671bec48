"""Pictures of columns: what panels show; the same numbers give the same bytes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cli.run import run
from mahovik import stands
from mahovik.contract.quantities import RPM
from mahovik.out.plots import BINS, Line, Panel, column_panels, draw, envelope

T = np.linspace(0.0, 3.0, 31)
TIME = ("t", "s", T)


def shown(*columns: tuple[str, str, object], index: tuple[str, str, object] | None = TIME) -> dict[str, Panel]:
    return {panel.quantity: panel for panel in column_panels(index, columns)}


def test_a_run_has_speeds_in_rpm_and_angles_in_degrees() -> None:
    wheels = [("phi_dot w1", "rad/s", 10.0 * T), ("phi_dot w2", "rad/s", T), ("tau w1", "N m", 0.5 * T)]
    panels = shown(("x", "m", 1e-3 * T), ("y", "m", 0.0 * T), *wheels, ("phi w1", "rad", T), ("psi", "rad", T))
    assert list(panels) == ["place of O1, m", "speed of the flywheels, rpm", "drive torque, N m", "attitude, deg"]
    speeds = panels["speed of the flywheels, rpm"].lines
    assert [line.name for line in speeds] == ["w1", "w2"] and speeds[0].y[-1] == pytest.approx(30.0 * RPM)
    assert panels["attitude, deg"].lines[0].y[-1] == pytest.approx(np.degrees(3.0))


def test_what_is_required_is_dashed_in_the_colour_of_what_is_reached() -> None:
    (panel,) = shown(("x", "m", T), ("z", "m", 2 * T), ("required x", "m", T), ("required z", "m", T)).values()
    assert [line.dashed for line in panel.lines] == [False, False, True, True]
    assert [line.colour for line in panel.lines] == [0, 1, 0, 1]
    assert panel.lines[2].name == "x, required"


def test_of_a_held_run_what_moves_and_the_reaction_are_shown() -> None:
    zero, angle = 0.0 * T, 2.0 * np.pi * T  # three whole turns
    columns = [(f"v_{a}", "m/s", zero) for a in "xyz"]
    columns += [("qw", "", np.cos(angle / 2)), ("qx", "", zero), ("qy", "", np.sin(angle / 2)), ("qz", "", zero)]
    columns += [(f"hold.reaction.{a}", "N", T) for a in "xyz"] + [(f"hold.reaction.{a}", "N m", zero) for a in "kmn"]
    panels = shown(*columns)
    assert list(panels) == ["attitude as a rotation vector, in E0, deg", "reaction of the hold, in E1 about O1, N"]
    assert np.abs(next(iter(panels.values())).lines[1].y - np.degrees(angle)).max() < 1e-9
    held = shown(*columns, ("q pitch", "rad", angle), ("q_dot pitch", "rad/s", T))
    assert list(held) == [list(panels)[1], "freedoms, deg", "rates of the freedoms, rad/s"]
    follows = shown(("q pitch", "rad", angle), ("required pitch", "rad", angle))
    assert [line.name for line in follows["freedoms, deg"].lines] == ["pitch", "pitch, required"]


def test_other_columns_are_stems() -> None:
    index = ("frequency", "Hz", np.array([10.0, 20.0]))
    (panel,) = shown(("x", "N", np.array([1.0, 0.5])), index=index).values()
    assert panel.lines[0].x.tolist() == [10.0] * 3 + [20.0] * 3 and panel.abscissa == "frequency, Hz"
    assert panel.lines[0].y[:2].tolist() == [0.0, 1.0] and np.isnan(panel.lines[0].y[2])
    text = shown(("peak", "N", np.array([1.0, 2.0])), index=("flywheel", "", np.array(["a", "b"], dtype=object)))
    assert text["peak, N"].abscissa == "row"


def test_an_envelope_keeps_every_extreme() -> None:
    rng = np.random.default_rng(3)
    y = rng.normal(size=100_000)
    y[[12_345, 67_890]] = 9.0, -8.0
    y[500:510] = np.nan
    kept = envelope(y)
    assert len(kept) <= 3 * BINS + 2 and np.all(np.diff(kept) > 0)
    assert {0, len(y) - 1, 12_345, 67_890} <= set(kept.tolist()) and np.isnan(y[kept]).any()
    for part in np.array_split(np.arange(len(y)), BINS):
        low, high = int(part[0]), int(part[-1]) + 1
        inside = kept[(kept >= low) & (kept < high)]
        assert np.nanmax(y[inside]) == np.nanmax(y[low:high]) and np.nanmin(y[inside]) == np.nanmin(y[low:high])


def test_the_same_panels_give_the_same_bytes() -> None:
    panels = [Panel("y", (Line("a", T, T),)), Panel("log", (Line("b", T, T + 1.0),), log=True)]
    first = draw("title", panels, ".svg")
    assert first == draw("title", panels, ".svg") and first.startswith(b"<?xml") and b"dc:date" not in first
    assert draw("title", panels, ".png").startswith(b"\x89PNG")


def test_a_command_writes_its_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sweep = ("vibration", str(stands.path("shaker2")), "--speed", "all=100..200rpm", "--steps", "2", "--at", "carrier")
    assert run(*sweep, "-o", "r.svg").exit_code == 0
    Path("spin.toml").write_text("schema = 1\ndefault = { speed = 20 }\n", encoding="utf-8")
    motion = ("simulate", str(stands.path("demo3")), "--until", "0.02", "--regime", "spin.toml", "--backend", "scipy")
    assert run(*motion, "-o", "m.svg").exit_code == 0
    assert all(Path(name).read_bytes().startswith(b"<?xml") for name in ("r.svg", "m.svg"))
