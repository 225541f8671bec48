"""The commands as functions: results with names, units and arrays; equal to what the commands print."""

from __future__ import annotations

import json
import math
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import run
from mahovik import stands
from mahovik.core.stand import Stand
from mahovik.core.stand.random import BARE, random_stand
from mahovik.out.functions import following
from mahovik.out.functions.table import Column, Table
from mahovik.out.report.plot.shares import shares

SHAKER2 = str(stands.path("shaker2"))
SPIN = str(Path(SHAKER2).parent / "shaker2_spin.motion.json")


@cache
def shaker() -> Any:
    return mahovik.example("shaker2")


@cache
def planned() -> Any:
    return mahovik.plan(shaker(), SPIN)


@cache
def results() -> dict[str, Table]:
    """One result of each function that needs no compiler for longer than a second."""
    made = planned().programme
    return {
        "simulate": mahovik.simulate(shaker(), 0.01, regime={"default": {"speed": "100 rpm"}}, backend="scipy"),
        "response": mahovik.response(shaker(), {"left": "0..600rpm", "right": "-1*left"}, "carrier", steps=3),
        "jitter": mahovik.jitter(shaker(), {"left": "0..600rpm", "right": "-100rpm"}, "carrier", steps=3),
        "rest": mahovik.rest(shaker()),
        "modes": mahovik.modes(shaker()),
        "linearize": mahovik.linearize(shaker()),
        "plan": planned(),
        "programme": made,
        "verify_programme": mahovik.verify_programme(shaker(), SPIN, made),
        "generate": mahovik.generate(shaker()),
    }


NAMES = (
    "simulate", "response", "jitter", "rest", "modes", "linearize", "plan", "programme", "verify_programme", "generate",
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_a_result_has_columns_with_units_in_every_form(name: str) -> None:
    found = results()[name]
    frame, dataset = found.to_pandas(), found.to_xarray()
    assert found.names == tuple(column.name for column in found.columns) and len(set(found.names)) == len(found.names)
    assert len(frame) == len(found)
    for column in found.columns:
        assert np.array_equal(found[column.name], column.values, equal_nan=column.values.dtype.kind in "fc")
        held = frame.index if column.name == found.index else frame[column.name]
        assert len(held) == len(column.values)
    assert frame.attrs["units"] == found.units
    if name != "linearize":  # its dataset holds the four matrices
        for column in found.columns:
            assert column.name in dataset and (
                dataset[column.name].attrs.get("units", "") == column.unit or column.name == found.index
            )
    html = found._repr_html_()
    assert html.count("<table>") == 1 and all(column.name in html for column in found.columns[:2])
    assert repr(found).startswith("<") and "\n" not in repr(found)


def test_speeds_are_a_mapping_texts_or_one_text() -> None:
    given = ({"left": "600 rpm", "right": "-1*left"}, ["left=600rpm", "right=-1*left"], "all=600rpm")
    mapping, texts, one = (mahovik.response(shaker(), speeds, "carrier").sweep.steps[0].turning for speeds in given)
    assert mapping == texts
    assert one.speeds == (mapping.speeds[0],) * 2


def test_an_unknown_column_is_named() -> None:
    with pytest.raises(mahovik.InputError, match="no such column, did you mean"):
        results()["simulate"]["phi_dot leftt"]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_result_is_drawn_on_new_axes_or_given_ones(name: str) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    found = results()[name]
    axes = found.plot()
    assert axes and all(each.get_title("left") or each.lines or each.collections for each in axes)
    _, own = pyplot.subplots()
    assert found.plot(own) == [own] and (own.lines or own.collections)
    _, many = pyplot.subplots(len(axes) + 1)
    with pytest.raises(mahovik.UsageError, match="panels to draw"):
        found.plot(many)
    pyplot.close("all")


def test_a_verdict_is_drawn_as_shares_of_what_is_accepted() -> None:
    """Rows with nothing but zero, or without a number, have no line; 1 is the limit."""
    panel = shares("found", {"a": np.array([1e-13, 0.0, np.nan, 3.0]), "b": np.full(4, 1e-13)}, np.full(4, 1e-12))
    a, b, accepted = panel.lines
    assert np.flatnonzero(np.isfinite(a.y[1::3])).tolist() == [0, 3]
    assert a.y[1::3][[0, 3]] == pytest.approx([0.1, 3e12]) and b.y[1::3] == pytest.approx(np.full(4, 0.1))
    assert accepted.y.tolist() == [1.0, 1.0] and accepted.dashed and panel.log


def test_a_table_without_rows_of_numbers_has_no_picture() -> None:
    class Names(Table):
        columns = (Column("name", "", np.array(["a", "b"], dtype=object)),)

    found = mahovik.balance({"A": ["1@0"], "ALPHA": [["1@0"]]})
    assert len(found._panels()) == len(found.names) - 1  # the planes are counted
    with pytest.raises(mahovik.UsageError, match="no rows of numbers"):
        Names().plot()


def test_a_simulation_goes_on_from_a_state_and_tells_its_progress() -> None:
    told: list[mahovik.Progress] = []
    start = {"position": [0, 0, 0.001], "phi_dot": [10.0, 0.0]}
    found = mahovik.simulate(shaker(), 0.005, start=start, backend="scipy", progress=told.append)
    assert found["z"][0] == 0.001 and found["phi_dot left"][0] == 10.0 and found.t[-1] == 0.005
    assert told[-1].done == told[-1].total == 0.005


def test_warnings_are_those_of_python() -> None:
    with pytest.warns(mahovik.MahovikWarning, match="a flywheel turns"):
        mahovik.simulate(shaker(), 1e-3, regime={"default": {"speed": "9000 rpm"}}, dt=1e-3, backend="scipy")


def test_the_same_figures_as_the_commands() -> None:
    printed = json.loads(run("rest", SHAKER2, "--json").stdout)
    assert printed == json.loads(json.dumps(mahovik.rest(SHAKER2).to_dict()))
    printed = json.loads(run("modes", SHAKER2, "--json").stdout)
    assert [each["frequency"] for each in printed["modes"]] == results()["modes"]["frequency"].tolist()
    asked = ("--speed", "left=0..600rpm", "--speed", "right=-1*left", "--at", "carrier", "--steps", "3")
    printed = json.loads(run("response", SHAKER2, *asked, "--json").stdout)
    rms = [[0.0 if x is None else x for x in row] for row in printed["rms"]]
    found = results()["response"]
    assert np.allclose(rms, np.stack([found[f"rms {axis}"] for axis in "xyz"], axis=1), rtol=1e-15, atol=0)


def test_a_generated_folder_is_that_of_the_command(tmp_path: Path) -> None:
    made = mahovik.generate(shaker(), tmp_path / "a")
    run("generate", SHAKER2, "-o", str(tmp_path / "b"))
    here, there = (
        {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        for folder in (tmp_path / "a", tmp_path / "b")
    )
    assert here.pop("provenance.json") != there.pop("provenance.json")  # the hash of the file, where there is one
    assert here == there
    assert set(made.files) == here.keys()


def test_a_plan_without_a_programme_says_why() -> None:
    rigid = random_stand(np.random.default_rng(1), 3, BARE, "rigid")
    motion = {"name": "up", "type": "periodic", "period": 0.1,
              "harmonics": [{"k": 1, "cos": [1, 0, 0, 0, 0, 0], "sin": [0] * 6}]}  # fmt: skip
    found = mahovik.plan(rigid, motion)
    assert found.status == "NO_PROGRAM" and found.words and len(found) == 0
    with pytest.raises(mahovik.UsageError, match="NO_PROGRAM"):
        _ = found.programme
    with pytest.raises(mahovik.UsageError, match="NO_PROGRAM"):
        mahovik.verify_programme(rigid, motion, found)


def test_a_programme_is_saved_and_judged(tmp_path: Path) -> None:
    made = planned().programme
    made.save(tmp_path / "p.json")
    verdict = mahovik.verify_programme(SHAKER2, SPIN, tmp_path / "p.json")
    assert verdict.passed and verdict["item"].tolist() == results()["verify_programme"]["item"].tolist()
    of_plan = mahovik.verify_programme(SHAKER2, SPIN, planned())
    assert of_plan["found"].tolist() == results()["verify_programme"]["found"].tolist()
    phi, phi_dot, _ = made.at([0.0, made.programme.span])
    assert np.allclose(phi_dot[0], phi_dot[1])
    assert phi.shape == (2, 2)


@pytest.mark.slow
def test_ctrl_c_keeps_what_there_is() -> None:
    def stop(now: mahovik.Progress) -> None:
        if now.done is not None and now.done > 0.003:
            raise KeyboardInterrupt

    found = mahovik.simulate(shaker(), 0.01, start={"phi_dot": [10.0, 0.0]}, backend="scipy", progress=stop)
    assert found.interrupted and found.stopped is not None and 0.003 < found.t[-1] < 0.01


@pytest.mark.slow
def test_c_is_judged_and_a_page_made(tmp_path: Path) -> None:
    found = mahovik.verify(shaker(), states=5)
    assert found.passed and "forward" in found["want"]
    assert found.to_dict()["passed"] is True
    assert all(each.lines for each in found.plot())
    page = mahovik.report(shaker())
    page.save(tmp_path / "report.html")
    assert unescape(page._repr_html_().split('"')[1]) == page.html  # as a notebook shows it
    assert not page.failures and (tmp_path / "report.html").read_text(encoding="utf-8") == page.html


@pytest.mark.slow
def test_servos_follow_a_programme(tmp_path: Path) -> None:
    servo = tmp_path / "s.toml"
    servo.write_text('schema = 1\nsample_period = "0.5 ms"\nbandwidth = "60 Hz"\nlatency = "700 us"\n')
    found = mahovik.follow(shaker(), SPIN, planned().programme, servo, periods=12, causes=False, backend="scipy")
    assert found.share < 0.2 and len(found) == 6
    assert len(found.motion) > 1000 and not found.interrupted


@pytest.mark.parametrize(
    ("mismatch", "words"),
    [
        ("1", "1: expected per cent with"),
        ("-1%", "-1%: expected 0% or"),
        (-0.1, "-0.1: expected 0 or"),
        (None, "None: exp"),
    ],
)
def test_a_mismatch_that_is_no_share_is_refused(mismatch: Any, words: str) -> None:
    with pytest.raises(mahovik.UsageError, match=f"^--mismatch {words}"):
        mahovik.follow(shaker(), SPIN, "programme.json", "servo.toml", mismatch=mismatch)


def test_a_mismatch_is_a_share_or_a_text() -> None:
    assert following.share_of("1%") == following.share_of(0.01) == following.share_of(" 1.0 %") == 0.01


@pytest.mark.slow
def test_a_point_becomes_quiet() -> None:
    found = mahovik.quiet(mahovik.example("sat4"), "acc1", (20.0, 200.0), speeds=[200.0, 210.0, 220.0, 230.0],
                          backend=None, seconds=5.0)  # fmt: skip
    assert found.reduction >= 1.0 and found.speeds.shape == (4,)
    assert "schema = 1" in found.regime and "quaternion" in found.start


def test_stands_of_other_code_are_taken() -> None:
    plain: Stand = random_stand(np.random.default_rng(2), 1, BARE, "plain")
    assert mahovik.modes(plain, {"quaternion": [1, 0, 0, 0]}).stand == mahovik.Stand.of(plain)


REFUSED: list[tuple[str, str, dict[str, Any], str]] = [
    ("response", "sat4", {"steps": 0}, "steps 0: expected a whole number from 2 to 100000"),
    ("response", "sat4", {"steps": 2.5}, "steps 2.5: expected a whole number"),
    ("response", "sat4", {"band": (30.0, 10.0)}, "band 30..10 Hz: expected two frequencies, the lower first"),
    ("response", "sat4", {"band": (math.nan, 10.0)}, "band nan..10 Hz: expected two frequencies"),
    ("response", "sat4", {"band": (10.0,)}, "band 10 Hz: expected two frequencies"),
    ("response", "sat4", {"speeds": [1, 2]}, "speeds: 1 in a list, expected texts"),
    ("response", "sat4", {"go_on": lambda done: False}, "response of sat4: go_on ended it before the first speed"),
    ("jitter", "sat4", {"steps": -3}, "steps -3: expected a whole number from 2 to 100000"),
    ("jitter", "sat4", {"speeds": {"all": 100.0}, "order": 0}, "order 0: expected a whole number from 1 to 20"),
    ("jitter", "sat4", {"exact": True, "go_on": lambda done: False}, "jitter of sat4: go_on ended it before"),
    ("quiet", "sat4", {"band": (200.0, 20.0)}, "band 200..20 Hz: expected two frequencies, the lower first"),
    ("quiet", "sat4", {"avoid": [(3.0, 1.0)]}, "avoid 3..1 Hz: expected two frequencies, the lower first"),
    ("quiet", "sat4", {"seed": -1}, "seed -1: expected a whole number of at least 0"),
    ("quiet", "sat4", {"momentum": (0, 0)}, "momentum: 2 numbers, expected 3"),
    ("quiet", "sat4", {"axes": ((1, 2, 3),)}, "axes: [1, 2, 3], expected directions of three numbers and length 1"),
    ("verify", "demo3", {"states": 0}, "states 0: expected a whole number of at least 1"),
    ("verify", "demo3", {"real": "half"}, "real: unknown 'half', expected one of double, float"),
    ("verify", "demo3", {"seed": -1}, "seed -1: expected a whole number of at least 0"),
    ("verify", "demo3", {"judges": True, "states": 0}, "states 0: expected a whole number of at least 1"),
    ("plan", "demo3", {"keep": 0}, "keep 0: expected a whole number from 1 to 99"),
    ("plan", "demo3", {"method": "x"}, 'method: unknown "x", expected one of fourier, ocp'),
    ("plan", "demo3", {"winding": (1.5, 0, 0)}, "expected any, spin, rock or 3 whole numbers"),
    ("judge", "demo3", {"states": 0}, "states 0: expected a whole number of at least 1"),
    ("judge", "demo3", {"tolerance": math.nan}, "tolerance nan: expected a number above 0"),
    ("judge", "demo3", {"timeout": 0}, "timeout 0: expected a number above 0"),
    ("judge", "demo3", {"want": ["forwards"]}, 'want: unknown "forwards", did you mean "forward"?'),
    ("excite", "sat4", {"harmonics": 1.5}, "harmonics 1.5: expected a whole number from 0 to 20"),
    ("excite", "sat4", {"seed": -1}, "seed -1: expected a whole number of at least 0"),
]
USUAL: dict[str, dict[str, Any]] = {
    "response": {"speeds": {"all": "100..3000rpm"}, "at": "acc1"},
    "jitter": {"speeds": {"all": "100..3000rpm"}, "at": "acc1"},
    "quiet": {"point": "acc1", "band": (20.0, 200.0), "momentum": (0.0, 0.0, 1.0), "backend": None},
    "plan": {"motion": stands.path("demo3").with_suffix(".motion.json")},
    "judge": {"command": "false"},
}


@pytest.mark.parametrize(("function", "stand", "given", "words"), REFUSED)
def test_values_without_meaning_are_refused_by_the_name_of_the_argument(
    function: str, stand: str, given: dict[str, Any], words: str
) -> None:
    with pytest.raises(mahovik.MahovikError) as caught:
        getattr(mahovik, function)(stands.path(stand), **USUAL.get(function, {}) | given)
    assert words in str(caught.value)


def test_modes_that_are_all_free_have_no_frequencies_in_a_line() -> None:
    assert repr(mahovik.modes(stands.path("sat4"))) == "<Modes of sat4: 6 free>"
    assert repr(mahovik.modes(stands.path("shaker2"))).endswith("3.129, 3.524, 3.613 Hz>")
