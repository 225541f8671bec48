"""Free numbers: keys, default bounds, and one line with the expected value for every wrong input."""

from __future__ import annotations

import numpy as np
import pytest

from design.test_design import FREE, freedom, shaker
from mahovik.core.stand import load
from mahovik.errors import DesignError
from mahovik.stands import path
from mahovik.use.design import freedom_of_keys
from mahovik.use.design.freedom import PARTS
from mahovik.use.design.read import read_freedom


def test_keys_free_all_flywheels() -> None:
    """With bounds by default; unbalance takes its direction along."""
    found = freedom_of_keys("position, unbalance,speed,phase", shaker())
    freed = {key for key, part in PARTS.items() if found.free[:, part].all()}
    assert freed == {"position", "unbalance", "unbalance_at"}
    assert (found.least[:, :3] == -0.07).all()
    assert np.allclose(found.most[:, 5], 4e-3, rtol=1e-12)
    assert found.speeds == (-2, -1, 0, 1, 2)
    assert found.phase
    assert found.limits.distance == pytest.approx(0.5 * np.hypot(np.hypot(0.05, 0.13), 0.01))
    assert freedom_of_keys("number", shaker()).number == (1, 2)


def test_a_file_in_units() -> None:
    """Bounds in SI; later tables win; held is held."""
    later = '[[free]]\nflywheels = ["right"]\nposition = { min = [0, 0, 0], max = ["1 mm", 0, 0] }\n'
    found = read_freedom(FREE + later, shaker())
    assert tuple(found.most[0, :3]) == (0.08, 0.08, 0.08)
    assert tuple(found.most[1, :3]) == (0.001, 0.0, 0.0)
    assert found.most[0, 3] == pytest.approx(np.radians(20))
    assert found.limits.distance == 0.1
    assert found.quality == 1e-9
    assert not found.free[:, 7:].any()
    assert (found.least[:, 7] == 0.5).all()


WRONG = [
    ("schema = 1", "schema = 2", "schema: expected 1, found 2"),
    ("harmonics = 1", "harmonic = 1", 'unknown key "harmonic", did you mean "harmonics"?'),
    ("harmonics = 1", "harmonics = 9", "harmonics: 9: expected 0 to 8"),
    ("quality = 1e-9", "number = [2, 1]", "number: least 2 is above most 1"),
    ("quality = 1e-9", "number = [1, 3]", "number: 3 flywheels, but the stand has 2"),
    ("quality = 1e-9", "phase = 1", "phase: expected true or false, found 1"),
    ("speed = [-1, 1]", "speed = []", "speed: expected turns per period to choose from"),
    ("quality = 1e-9", "number = 2", "number: expected least and most, as [2, 4], found 2"),
    ("[[free]]", "[[free]]\nmass = { min = 2, max = 1 }", "mass: min 2 is above max 1 kg"),
    ("[[free]]", "[[free]]\nmass = { min = 2 }", "max: required, but missing"),
    ("[[free]]", "[[free]]\nmass = 3", "mass: expected true, false or { min = .., max = .. }, found 3"),
    ("[limits]", '[[group]]\nflywheels = ["left", "right"]\nsame = ["w"]\n[limits]', 'same: unknown key "w"'),
    ("[[free]]", '[[free]]\nflywheels = ["lefd"]', 'flywheels: unknown "lefd", did you mean "left"?'),
    ("[[free]]", "[[free]]\nmass = { min = 0, max = 1 }", "mass: min 0: expected a minimum above 0"),
    ("min = 0,", "min = -1,", "unbalance: min -1 is negative"),
    ("min = 0,", 'min = "1 kg",', 'unbalance, min: unit "kg" does not fit'),
    ("[limits]", "[limits]\ntotal_mass = 0.1", "total_mass: 0.1 kg is below the sum of the least, 1"),
    ('"100 mm"', "-1", "distance: -1 m is negative"),
    ("[limits]", '[[group]]\nflywheels = ["left"]\n[limits]', "a group needs two or more flywheels, found 1"),
    ("[limits]", '[[group]]\nflywheels = ["left", "right"]\n[limits]', "expected `same`, `mirror` or both"),
    ("[limits]", '[[group]]\nflywheels = ["left", "right"]\nmirror = "w"\n[limits]', "expected one of x, y, z"),
]


@pytest.mark.parametrize("old,new,words", WRONG, ids=[str(k) for k in range(len(WRONG))])
def test_wrong_input_is_one_line(old: str, new: str, words: str) -> None:
    """It names the file, the key, and what was expected."""
    with pytest.raises(DesignError) as caught:
        freedom(**{old: new})
    (line,) = caught.value.problems
    assert line.startswith("free: ")
    assert words in line


@pytest.mark.parametrize(
    "keys,words",
    [("positon", 'did you mean "position"?'), ("", "unknown key"), ("position,,angles", "unknown key")],
)
def test_wrong_keys(keys: str, words: str) -> None:
    """Keys given with --free."""
    with pytest.raises(DesignError, match="--free") as caught:
        freedom_of_keys(keys, shaker())
    assert words in str(caught.value)


def test_balanced_flywheels_have_no_unbalance_to_change() -> None:
    """Bounds by default would be zero to zero."""
    with pytest.raises(DesignError, match=r"give \{ min = \.\., max = \.\. \}"):
        freedom_of_keys("unbalance", load(path("demo3")))


def test_nothing_free_is_refused() -> None:
    """There would be nothing to choose."""
    with pytest.raises(DesignError, match="nothing is free"):
        read_freedom("schema = 1", shaker())
