"""What comparison of answers cannot see: the reader of stand files, and text of a delivered folder."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from mahovik.contract.limits import DOUBLE, LIMITS
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import as_text, manifest
from mahovik.core.stand import Stand, dumps, load, loads
from mahovik.proof.second.reading import differences
from mahovik.proof.verify.files import check_file, check_options, check_texts
from mahovik.stands import path
from strategies import stands

DEMO = load(path("demo3"))
DATA_SHEET = """
schema = 1
name = "sheet"
[carrier]
mass = "12000 g"
center_of_mass = ["10 mm", 0, 0.02]
inertia = { value = [0.4, 0.5, 0.6], unit = "kg m^2" }
inertia_about = "center_of_mass"
added_mass = [[3, 0, 0, 0, 0.2, 0], [0, 4, 0, -0.1, 0, 0.3], [0, 0, 5, 0, 0, 0],
              [0, -0.1, 0, 0.02, 0, 0], [0.2, 0, 0, 0, 0.03, 0], [0, 0.3, 0, 0, 0, 0.04]]
[[instrument]]
name = "arm"
position = { value = [100, -50, 20], unit = "mm" }
angles = ["20 deg", 0.3, "-40 deg"]
mass = 2.0
center_of_mass = ["3 cm", "1 cm", 0]
inertia = [[0.02, 0.001, 0], [0.001, 0.03, -0.002], [0, -0.002, 0.04]]
inertia_about = "origin"
added_mass = [0, 0, 0, 0.01, 0.02, 0.03]
[[flywheel]]
name = "sheet"
mount = "arm"
position = [0.1, 0.2, -0.3]
axis = [1, 2, 3]
zero = [0, 1, 0.5]
mass = 0.8
spin_inertia = "16 kg cm^2"
transverse_inertia = ["9 kg cm²", 0.00095]
unbalance = { static = "0.5 gcm", static_at = "30 deg", dynamic = "2 g cm^2", dynamic_at = "1 turn" }
[[flywheel]]
name = "disc"
angles = ["0.1 turn", "12 arcmin", 0.7]
mass = "2 lb"
spin_inertia = "5 oz in^2"
transverse_inertia = "2.6 oz in^2"
unbalance = { static = "3 g mm", static_at = 2.0, dynamic = "1e-7 kg m^2", dynamic_at = "200 deg" }
[[point]]
name = "sensor"
mount = "arm"
position = [0.01, 0, 0]
angles = [0.1, 0.2, 0.3]
"""


def test_every_form_of_a_data_sheet_is_read_twice() -> None:
    """The same file is read by `core/stand` and by the second reading: faults are planted in both."""
    faults = differences(loads(DATA_SHEET), tomllib.loads(DATA_SHEET))
    assert max(faults.values()) <= DOUBLE.value, faults
    assert {"sheet inertia", "disc centre of mass", "arm axes", "sensor position", "added mass"} <= faults.keys()


@pytest.mark.parametrize("name", ["bench8", "auv6", "remus6", "sat4"])
def test_an_example_is_read_twice(name: str) -> None:
    assert check_file(load(path(name)), tomllib.loads(path(name).read_text())).verdict == "ok"


@given(stands())
def test_any_stand_is_read_twice(stand: Stand) -> None:
    assert check_file(stand, tomllib.loads(dumps(stand))).verdict == "ok"


def test_a_number_that_was_read_otherwise_fails() -> None:
    (w1, *rest), document = DEMO.flywheels, tomllib.loads(path("demo3").read_text())
    (x, y, z), fails = w1.center_of_mass, []
    for wrong in (replace(w1, center_of_mass=(x, y, z + 1e-9)), replace(w1, mass=w1.mass * (1 + 1e-9))):
        row = check_file(replace(DEMO, flywheels=(wrong, *rest)), document)
        fails.append(f"{row.verdict} {row.words.partition(':')[0]}")
    assert fails == ["FAILED w1 centre of mass", "FAILED w1 mass"]
    assert check_file(DEMO, None).verdict == "not compared"
    document["carrier"]["mass"] = "3 stone"
    assert check_file(DEMO, document).words == 'the second reading does not know the unit "stone"'


MOTORS = """
schema = 1
name = "motors"
inverse_most = "200 rpm/s"
carrier = { mass = 1, inertia = [1, 1, 1] }
task.turn = { rows = ["wx"] }
task.sight = { rows = [{ point = "telescope", rows = ["wy", "wz"] }, "vx"] }
point = [{ name = "telescope", position = [0.1, 0, 0.2] }]
"""
MOTORS += "".join(
    f'[[flywheel]]\nname = "w{k}"\nmass = 1\ninertia = [1, 1, 1]\nmotor = {{ {motor} }}\n{more}\n'
    for k, (motor, more) in enumerate([
        ('torque = "20 mN m", speed = "6000 rpm", coulomb = 1e-4', ""),
        ('torque_speed = { value = [[0, 20], [50, 5]], unit = ["rpm", "mN m"] }, viscous = 1e-5', "inverse_weight = 2"),
        ("viscous = 1e-5", ""),
    ])
)  # fmt: skip


@pytest.mark.parametrize("real", ["double", "float"])
def test_default_options_are_those_of_the_file(real: str) -> None:
    """Motors by limits and by a curve, one that is nowhere limited, rows of a point; a number that is wrong fails."""
    made, document, limits = generate_all(loads(MOTORS), real), tomllib.loads(MOTORS), LIMITS[real]
    options: Any = made.values.options
    largest = float(made.program.precision.largest)
    assert check_options(options, document, limits, largest).verdict == "ok"
    for name, value in options.items():
        wrong = options | {name: (np.array(value) * 0.9 + 0.01).tolist()}
        assert check_options(wrong, document, limits, largest).words.startswith(f"{name}:")
    row = check_options({"use_sight": [1, 1]}, document, limits, largest)
    assert row.words == "use_sight: shape [2], expected [3]"


def test_text_that_differs_is_named_with_its_functions(tmp_path: Path) -> None:
    made = generate_all(DEMO)
    files = {name: text for name, text in made.files.items() if name.startswith("demo3.")}
    whole = {**files, "manifest.json": manifest(DEMO, "double", files)}

    def row(edit: str = "", **changed: str) -> tuple[str, str]:
        for name, text in (whole | changed).items():
            old, new = edit.split(" -> ") if name == "demo3.c" and edit else ("", "")
            (tmp_path / name).write_text(text.replace(old, new) if old else text, newline="\n")
        (check,) = check_texts(DEMO, made, tmp_path)
        return check.verdict, check.words

    by_hand = "edited by hand after mahovik"
    assert row() == ("ok", "")
    assert row("\n -> \r\n") == ("ok", "")
    verdict, words = row("excess = DEMO3_EXCESSIVE -> excess = DEMO3_OK")
    assert verdict == "not compared"
    assert words.startswith(by_hand)
    assert "wrote it: excessive (internal, of inverse); demo3.c, line " in words
    assert words.endswith(": found `excess = DEMO3_OK;`, expected `excess = DEMO3_EXCESSIVE;`")
    assert row("0.0 ->  0.0 ")[1].count(" and ") >= 1  # more than are listed are counted
    other = files["demo3.c"].replace("motion of", "motion, of")
    listed = json.loads(manifest(DEMO, "double", files | {"demo3.c": other})) | {"generator": "mahovik 0.0.1"}
    words = row(**{"demo3.c": other, "manifest.json": as_text(listed)})[1]
    assert words == "of mahovik 0.0.1: demo3.c outside of functions"
    words = row(**{"demo3.h": files["demo3.h"].replace("DEMO3_LARGEST            1", "DEMO3_LARGEST            2")})[1]
    assert "within (internal, of forward, " in words and "; demo3.h outside of functions; demo3.h, line " in words
    assert row(**{"demo3.h": files["demo3.h"] + "\n"})[1].endswith("found ``, expected `end of the file`")
    (tmp_path / "manifest.json").unlink()
    assert "manifest.json is missing" in check_texts(DEMO, made, tmp_path)[0].words


def test_every_listed_file_is_seen_and_what_nothing_judges_must_be_as_generated(tmp_path: Path) -> None:
    made = generate_all(DEMO, only=())
    for name, text in delivery(DEMO, additions=("batch", "encoder")).items():
        (tmp_path / name).write_text(text, newline="\n")

    def rows() -> list[str]:
        return [f"{row.verdict} {row.words}".strip() for row in check_texts(DEMO, made, tmp_path)]

    assert rows() == ["ok", "ok", "ok"]
    encoder, page = tmp_path / "mahovik_encoder.c", tmp_path / "README.md"
    encoder.write_text(encoder.read_text().replace("dt > 0.0F", "dt >= 0.0F"))
    page.write_text(page.read_text() + "\n")
    (tmp_path / "demo3_batch.h").unlink()
    text, batch, encoders = rows()
    assert text.startswith("not compared edited by hand after mahovik")
    assert "wrote it: speed_of_counts_float; README.md; mahovik_encoder.c, line " in text
    encoder.write_text(delivery(DEMO, additions=("batch", "encoder"))[encoder.name], newline="\n")
    origin = tmp_path / "manifest.json"
    assert "README.md, line " in rows()[0]
    page.write_text(page.read_text()[:-1])
    origin.write_text(origin.read_text().replace('"real": "double"', '"real": "float"'))
    assert rows()[0].endswith('manifest.json, line 7: found `"real": "float",`, expected `"real": "double",`')
    assert batch == "FAILED demo3_batch.h is missing: generate the batch C again"
    again = "generate the encoder C again"
    assert encoders == f"FAILED mahovik_encoder.c is not what this version generates: {again}"
