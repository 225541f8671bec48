"""`Result`: a mapping of columns with units in every form, and what stands beside them."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.out.result import SHOWN, Axis, Column, Result, column


def orders(**more: Any) -> Result:
    return Result(
        "orders of rig",
        (
            column("wheel", "", ["w1", "w2"]),
            column("frequency", "Hz", [10.0, None]),
            column("amplitude", "m", [[1e-3, 2e-3, 0.0], [0.0, 3e-5, 1e-4]], "xyz"),
            column("phase", "1", np.array([1 + 2j, 3j])),
        ),
        meta={
            "largest": 0.002, "names": ["a", "b"], "hidden": [1.0] * 9, "counted": 3,
            "inner": Result("inside", (column("speed", "rad/s", [np.pi * 10], shown="rpm"),)),
        },
        units={"largest": "m"},
        messages=["warning: coarse"],
        **more,
    )  # fmt: skip


def test_it_is_a_mapping_of_columns_and_entries() -> None:
    result = orders()
    assert list(result) == ["wheel", "frequency", "amplitude", "phase", *result.meta] and len(result) == len(
        list(result)
    )
    assert result["amplitude"].shape == (2, 3) and result["names"] == ["a", "b"] and "wheel" in result and result
    assert dict(result)["largest"] == 0.002 and result.count == 2
    with pytest.raises(mahovik.InputError, match="'frequenc': no such column or entry, did you mean \"frequency\""):
        result["frequenc"]
    assert result.get("frequenc") is None and result.get("counted", 0) == 3
    assert repr(Result("", meta={"files": ["a"]})) == "<Result of ['files']>"
    with pytest.raises(ValueError, match="two columns or entries have one name"):
        Result("", (column("names", "", ["a"]),), meta={"names": 1})


def test_json_has_rows_columns_or_an_object_a_row() -> None:
    rows = json.loads(orders(rows="orders").to_json())
    first = {"wheel": "w1", "frequency": 10.0, "amplitude": [1e-3, 2e-3, 0.0], "phase": [1.0, 2.0]}
    assert rows["orders"][0] == first and rows["orders"][1]["frequency"] is None
    assert rows["units"] == {"frequency": "Hz", "amplitude": "m", "phase": "1", "largest": "m"}
    assert (rows["ok"], rows["messages"], rows["inner"]) == (True, ["warning: coarse"], [{"speed": np.pi * 10}])
    keyed = json.loads(orders(rows="orders", index="wheel").to_json())["orders"]
    assert list(keyed) == ["w1", "w2"] and keyed["w1"]["frequency"] == 10.0 and "wheel" not in keyed["w1"]
    columns = json.loads(orders(ok=False).to_json())
    assert columns["wheel"] == ["w1", "w2"] and columns["ok"] is False


def test_people_see_units_that_fit_and_not_what_is_left_out() -> None:
    text = orders(details=("phase",)).text()
    assert "amplitude x, mm   amplitude y, mm" in text and "phase" not in text and "hidden" not in text
    assert "largest: 2 mm" in text and "names: a, b" in text and "counted: 3" in text
    assert "speed, rpm" in text and "300" in text and text.rstrip().endswith("warning: coarse")
    html = orders()._repr_html_()
    assert html.count("<table>") == 2 and "w2" in html and "speed, rpm" in html
    long = Result("run", (column("t", "s", np.arange(1000.0)),))
    assert len(long.text().splitlines()) < SHOWN + 6 and "\n  ...\n" in long.text() and "999" in long.text()
    assert max(map(len, orders().text(40).splitlines())) <= 40


@pytest.mark.parametrize(
    ("values", "unit", "head", "shown"),
    [
        ([1.5e-6, 0.0], "kg m", "x, g mm", [1.5, 0.0]),
        ([5e-8, 1e-9], "kg m", "x, mg mm", [50.0, 1.0]),
        ([500.0], "kg m", "x, kg m", [500.0]),
        ([2.8e-4, 1.6e-4], "kg m2", "x, kg cm2", [2.8, 1.6]),
        ([-3e-6], "N m", "x, uN m", [-3.0]),
        ([2e5, 1.0], "N", "x, kN", [200.0, 0.001]),
        ([np.pi], "rad", "x, deg", [180.0]),
    ],
)
def test_figures_are_in_a_unit_that_fits(values: list[float], unit: str, head: str, shown: list[float]) -> None:
    lines = Result("", (column("x", unit, values),)).text().splitlines()
    assert lines[1].strip() == head and [float(line) for line in lines[3:] if line] == pytest.approx(shown)


def test_rounding_beside_a_vector_is_shown_as_zero_and_kept_in_json() -> None:
    """A vector in a table and a list beside it; small vectors and missing parts stay."""
    rows = [[1.0, 3e-17, 0.5], [2e-17, 1e-20, np.nan]]
    result = Result("", (column("x", "rad/s2", rows, "abc"),), meta={"rms": [1.0, 1e-19]})
    cells = [line.split() for line in result.text().splitlines()]
    assert cells[3:5] == [["1", "0", "0.5"], ["2e-17", "1e-20", "-"]] and ["rms:", "1", "0"] in cells
    assert json.loads(result.to_json())["x"][0][1] == 3e-17


def test_it_is_saved_by_the_end_of_the_name(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    result = orders()
    for suffix in (".csv", ".json", ".parquet"):
        result.save(tmp_path / f"a{suffix}")
    head, *rows = csv.reader((tmp_path / "a.csv").read_text().splitlines())
    assert head[:3] == ["wheel", "frequency [Hz]", "amplitude x [m]"] and float(rows[0][2]) == 1e-3
    assert json.loads((tmp_path / "a.json").read_text())["largest"] == 0.002
    frame = pandas.read_parquet(tmp_path / "a.parquet")
    assert frame["amplitude y"].tolist() == [2e-3, 3e-5]
    assert [name.partition(" [")[0] for name in head] == list(frame.columns), "a complex number is two columns"
    none = Result("2 states", meta={"answers": [{"V_dot": [0.0]}]})
    for use in (lambda: none.save(tmp_path / "b.csv"), none.to_pandas):
        with pytest.raises(mahovik.UsageError, match="2 states: has no table"):
            use()
    assert not (tmp_path / "b.csv").exists()
    with pytest.raises(mahovik.UsageError, match=r"expected a name that ends in \.csv or"):
        result.save(tmp_path / "a.txt")


def test_frames_and_datasets_keep_units() -> None:
    pytest.importorskip("xarray")
    result = orders(index="wheel")
    frame, dataset = result.to_pandas(), result.to_xarray()
    assert frame.attrs["units"]["amplitude z"] == "m" and frame.loc["w2", "amplitude z"] == 1e-4
    assert dataset["amplitude"].attrs["units"] == "m" and dataset["amplitude"].dims == ("wheel", "amplitude part")
    assert dataset["frequency"].sel(wheel="w1") == 10.0


def test_answers_of_all_functions_are_datasets() -> None:
    """Each array under its name, with its shape: also where an axis and an array have one name, as twists of points."""
    pytest.importorskip("xarray")
    model, zero = mahovik.build(mahovik.example("sat4")), [0.0, 0.0, 0.0]
    arguments: dict[str, dict[str, Any]] = {"inverse": {"V_dot": zero * 2}, "generalized": {"angles": zero}}
    answered = [name for name in model.functions["function"] if not name.startswith(("step", "torque_for"))]
    answers = [getattr(model, name)(model.states(2), **arguments.get(name, {})) for name in answered]
    answers.append(model.inverse(model.states(2), task="pointing", demand=zero))
    answers.append(model.torque_for(model.states(2), "pointing", zero))
    for result in answers:
        dataset = result.to_xarray()
        assert {one.name: one.values.shape for one in result.columns} == {x: dataset[x].shape for x in dataset}
    assert {"points", "matrices", "mounts", "momentum"} <= set(answered)


def test_it_is_drawn_on_new_axes_or_given_ones(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    from matplotlib import pyplot

    result = Result("run", (column("t", "s", [0.0, 1.0]), Column("height", "m", np.array([1.0, 2.0]))), index="t")
    (axes,) = result.plot()
    assert axes.get_xlabel() == "t, s" and axes.get_title(loc="left") == "height, m" and len(axes.lines) == 1
    _, ax = pyplot.subplots()
    assert result.plot(ax) is ax and ax.lines
    with pytest.raises(mahovik.UsageError, match="2 axes are given, but run has 1 panels"):
        result.plot([ax, ax])
    moments = Column("step", "", np.arange(3))
    wide = Result("K", (moments, Column("K", "kg", np.ones((3, 6, 8)), (Axis("wrench"), Axis("twist")))))
    with pytest.raises(mahovik.UsageError, match=r"49 columns are too many .* result\.take"):
        wide.plot()
    for numbers in ([], [column("mass", "kg", [1.0])]):  # over the numbers of rows there is nothing to see
        with pytest.raises(mahovik.UsageError, match="names: no picture shows it, expected"):
            Result("names", [column("name", "", ["a"]), *numbers], index="name").plot()
    for name in ("a.svg", "b.svg", "c.png"):
        result.save(tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    pyplot.close("all")


def test_samples_of_a_motion_are_a_table_with_a_row_a_moment(tmp_path: Path) -> None:
    """Columns: the number of the sample, then those of one run; each component of a twist has its own unit."""
    model = mahovik.build(mahovik.example("demo3"))
    tables = model.tables({"carrier.mass": np.array([9.0, 10.0])})
    result = model.simulate(2e-3, regime={"default": {"speed": 100.0}}, dt=1e-3, every=1e-3, tables=tables)
    frame, alone = result.to_pandas(), model.simulate(2e-3, regime={"default": {"speed": 100.0}}, dt=1e-3, every=1e-3)
    assert frame.index.names == ["sample", "t"] and len(frame) == 6
    assert list(frame.columns) == list(alone.to_pandas().columns)
    assert np.array_equal(frame["position x"].to_numpy().reshape(2, 3), result["position", slice(None), 0])
    assert [frame.attrs["units"][f"V {letter}"] for letter in "uvwpqr"] == ["m/s"] * 3 + ["rad/s"] * 3
    result.save(tmp_path / "motion.csv")
    head, *rows = csv.reader((tmp_path / "motion.csv").read_text(encoding="utf-8").splitlines())
    assert head[:3] == ["sample", "t [s]", "position x [m]"] and [row[0] for row in rows] == list("000111")
    with pytest.raises(mahovik.UsageError, match="regime: expected a path or a mapping, found function"):
        model.simulate(1e-3, regime=lambda t: 0.0)  # type: ignore[arg-type]
