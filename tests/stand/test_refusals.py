"""Every refusal of a stand file, with the message a user sees."""

from __future__ import annotations

import pytest

from mahovik.core.stand import loads
from mahovik.errors import StandError

CARRIER = """
[carrier]
mass = 3
inertia = [1, 1, 1]
"""
HEAD = 'schema = 1\nname = "s"\n'
BASE = HEAD + CARRIER
WHEEL = '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [0.02, 0.01, 0.01]\n'
SHEET = '[[flywheel]]\nname = "w1"\nmass = 1\nspin_inertia = 0.02\ntransverse_inertia = 0.011\n'


def refusal(text: str) -> list[str]:
    with pytest.raises(StandError) as caught:
        loads(text, "s.toml")
    assert all("\n" not in problem for problem in caught.value.problems)
    return list(caught.value.problems)


CASES = {
    # keys and types
    "schema missing": ('name = "s"' + CARRIER, "schema: required, but missing"),
    "schema 2": (BASE.replace("= 1", "= 2", 1), "schema: unknown version 2, this program reads schema 1"),
    "schema 1.0": (BASE.replace("= 1", "= 1.0", 1), "schema: expected a whole number, found 1.0"),
    "schema true": (BASE.replace("= 1", "= true", 1), "schema: expected a whole number, found true"),
    "name missing": ("schema = 1" + CARRIER, "name: required, but missing"),
    "carrier missing": (HEAD, "carrier: required, but missing"),
    "carrier not a table": (HEAD + "carrier = 3", "carrier: expected a table, found 3"),
    "flywheel a table": (
        BASE + '[flywheel]\nname = "w1"\nmass = 1',
        "flywheel: expected an array of tables, [[flywheel]], found a table",
    ),
    "unknown key at the top": (
        HEAD + "gravty = [0, 0, 1]\n" + CARRIER,
        'unknown key "gravty", did you mean "gravity"?',
    ),
    "unknown key in a body": (BASE + "masss = 1", 'carrier: unknown key "masss", did you mean "mass"?'),
    "unknown key deep": (
        BASE + '[[carrier.damping.terms]]\nwrench = "Y"\nof = ["u", "r"]\nvalue = 1\nvalu = 2',
        'carrier, damping, terms[0]: unknown key "valu", did you mean "value"?',
    ),
    "added mass of a flywheel": (
        BASE + WHEEL + "added_mass = [1, 1, 1, 1, 1, 1]",
        'flywheel "w1": unknown key "added_mass": that of a flywheel would turn with it; give it to the carrier or an '
        "instrument",
    ),
    "bool is no number": (BASE.replace("mass = 3", "mass = true"), "carrier, mass: expected a mass (kg), found true"),
    "date is no number": (
        BASE.replace("mass = 3", "mass = 2024-01-01"),
        "carrier, mass: expected a mass (kg), found a date",
    ),
    "angles unknown": (
        HEAD + 'angles = "xyz"' + CARRIER,
        'angles: expected "ship" (or "zyx"), "aircraft" ("yzx") or "euler" ("zxz"), found "xyz"',
    ),
    "phase_input unknown": (
        BASE.replace("schema = 1", 'schema = 1\nphase_input = "resolver"', 1) + WHEEL,
        'phase_input: expected "angle" or "sincos", found "resolver"',
    ),
    "phase_input without flywheels": (
        BASE.replace("schema = 1", 'schema = 1\nphase_input = "sincos"', 1),
        'phase_input: "sincos" says how phases are given, but there is no flywheel',
    ),
    "wrench_input a number": (BASE + "wrench_input = 1", "carrier, wrench_input: expected true or false, found 1"),
    # units
    "wrong dimension": (
        BASE.replace("mass = 3", 'mass = "3 mm"'),
        'carrier, mass: unit "mm" does not fit, expected a mass (kg)',
    ),
    "length for an angle": (
        BASE + WHEEL + 'angles = ["3 m", 0]',
        'flywheel "w1", angles[0]: unit "m" does not fit, expected an angle (rad)',
    ),
    "rpm for an angle": (
        BASE + WHEEL + 'angles = ["3 rpm", 0]',
        'flywheel "w1", angles[0]: unit "rpm" does not fit, expected an angle (rad)',
    ),
    "mm/m for an angle": (
        BASE + WHEEL + 'angles = [0, "3 mm/m"]',
        'flywheel "w1", angles[1]: unit "mm/m" does not fit, expected an angle (rad)',
    ),
    "hertz for a speed": (
        BASE + WHEEL + 'motor = { speed = "50 Hz" }',
        'flywheel "w1", motor, speed: unit "Hz" does not fit, expected an angular speed (rad/s), '
        "a frequency is not one: write rpm or rad/s",
    ),
    "unknown unit": (
        BASE.replace("mass = 3", 'mass = "3 foo"'),
        'carrier, mass: "foo" is not a known unit, expected a mass (kg)',
    ),
    "no unit in a string": (
        BASE.replace("mass = 3", 'mass = "3"'),
        'carrier, mass: "3" has no unit, write the number without quotes for SI',
    ),
    "no number in a string": (
        BASE.replace("mass = 3", 'mass = "much"'),
        'carrier, mass: "much" is not a number with a unit, expected a mass (kg)',
    ),
    "decibel": (
        BASE + WHEEL + 'angles = ["3 dB", 0]',
        'flywheel "w1", angles[0]: unit "dB" has an offset or is logarithmic, expected an angle (rad)',
    ),
    "two units": (
        BASE + 'center_of_mass = { value = [1, "2 mm", 3], unit = "mm" }\ninertia_about = "origin"',
        'carrier, center_of_mass[1]: "2 mm" has a unit of its own inside a list in mm',
    ),
    "value without unit": (
        BASE + "center_of_mass = { value = [1, 2, 3] }",
        'carrier, center_of_mass: expected { value = ..., unit = "..." }, found a table of value',
    ),
    "one unit for a 6x6": (
        BASE + 'added_mass = { value = [1, 1, 1, 1, 1, 1], unit = "kg" }',
        "carrier, added_mass: a 6x6 mixes units (metres and radians), so one unit cannot be for all: write SI numbers",
    ),
    "unit of another block": (
        BASE + 'added_mass = ["1 kg", "1 kg", "1 kg", "1 kg", 1, 1]',
        'carrier, added_mass[3]: unit "kg" does not fit, expected an added inertia (kg m^2)',
    ),
    "unit of a derivative": (
        BASE + 'damping = { terms = [{ wrench = "Y", of = ["u", "r"], value = "1 N" }] }',
        'carrier, damping, terms[0], value: unit "N" does not fit, expected a hydrodynamic derivative (N s^2/m/rad)',
    ),
    # shapes
    "two numbers": (BASE + "center_of_mass = [1, 2]", "carrier, center_of_mass: expected 3 numbers, found 2"),
    "a number for a vector": (BASE + "center_of_mass = 1", "carrier, center_of_mass: expected 3 numbers, found 1"),
    "short row": (
        BASE.replace("[1, 1, 1]", "[[1, 0, 0], [0, 1], [0, 0, 1]]"),
        "carrier, inertia[1]: expected 3 numbers, found 2",
    ),
    "inertia of six": (
        BASE.replace("[1, 1, 1]", "[1, 1, 1, 0, 0, 0]"),
        "carrier, inertia: expected three rows of three numbers, or a diagonal of three, found 6 items",
    ),
    "5x6": (
        BASE + "added_mass = [1, 1, 1, 1, 1]",
        "carrier, added_mass: expected six rows of six numbers, or a diagonal of six, found 5 items",
    ),
    "one angle": (BASE + WHEEL + "angles = [1]", 'flywheel "w1", angles: expected 2 or 3 numbers, found 1'),
    "three factors": (
        BASE + 'damping = { terms = [{ wrench = "Y", of = ["u"], value = 1 }] }',
        'carrier, damping, terms[0], of: expected two factors such as ["r", "|v|"], found 1',
    ),
    "unknown factor": (
        BASE + 'damping = { terms = [{ wrench = "Y", of = ["u", "|s|"], value = 1 }] }',
        'carrier, damping, terms[0], of: expected one of u v w p q r, with or without bars, found "|s|"',
    ),
    "unknown wrench": (
        BASE + 'damping = { terms = [{ wrench = "y", of = ["u", "v"], value = 1 }] }',
        'carrier, damping, terms[0], wrench: expected one of X Y Z K M N, found "y"',
    ),
    "terms not a list": (BASE + "damping = { terms = 3 }", "carrier, damping, terms: expected a list, found 3"),
    # numbers
    "nan": (BASE.replace("mass = 3", "mass = nan"), "carrier, mass: not finite: nan"),
    "infinite": (BASE.replace("[1, 1, 1]", "[1, inf, 1]"), "carrier, inertia[1]: not finite: infinity"),
    "beyond double": (BASE.replace("mass = 3", "mass = 1e400"), "carrier, mass: not finite in double precision"),
    "beyond any exponent": (
        BASE.replace("mass = 3", "mass = 1e99999999999999999999"),
        "carrier, mass: not finite: infinity",
    ),
    "negative mass": (BASE.replace("mass = 3", "mass = -3"), "carrier, mass: -3 kg is negative"),
    "negative displaced mass": (
        BASE + "buoyancy = { displaced_mass = -1 }",
        "carrier, buoyancy, displaced_mass: -1 kg is negative",
    ),
    "no-load speed zero": (
        BASE + WHEEL + "motor = { speed = 0 }",
        'flywheel "w1", motor, speed: 0 rad/s is not above 0',
    ),
    "no counts": (
        BASE + WHEEL + "encoder = { counts = 0 }",
        'flywheel "w1", encoder, counts: expected at least 1 count per turn, found 0',
    ),
    "half a count": (
        BASE + WHEEL + "encoder = { counts = 0.5 }",
        'flywheel "w1", encoder, counts: expected a whole number, found 0.5',
    ),
    "negative length of a leg": (
        BASE + "[[leg]]\nground = [0, 0, 1]\ncarrier = [0, 0, 0]\nlength = -1",
        "leg[0], length: -1 m is negative",
    ),
    "negative stiffness of a leg": (
        BASE + "[[leg]]\nground = [0, 0, 1]\ncarrier = [0, 0, 0]\nlength = 1\nstiffness = -4",
        "leg[0], stiffness: -4 N/m is negative",
    ),
    # bodies
    "inertia not symmetric": (
        BASE.replace("[1, 1, 1]", "[[1, 0.002, 0], [0.02, 1, 0], [0, 0, 1]]"),
        "carrier, inertia: not symmetric, [0][1] = 0.002 kg m^2 but [1][0] = 0.02 kg m^2",
    ),
    "inertia_about missing": (
        BASE + "center_of_mass = [0, 0, 0.1]",
        'carrier, inertia_about: required where center_of_mass is not zero, expected "origin" or "center_of_mass"',
    ),
    "inertia_about unknown": (
        BASE + 'inertia_about = "centre_of_mass"',
        'carrier, inertia_about: expected "origin" or "center_of_mass", found "centre_of_mass"',
    ),
    "Theta not semidefinite": (
        BASE + 'center_of_mass = [1, 1, 0]\ninertia_about = "origin"',
        "carrier, inertia = [1, 1, 1] kg m^2: Theta is not positive semidefinite, "
        "a principal moment about the centre of mass is -5 kg m^2, expected none below 0",
    ),
    "negative moment": (
        BASE.replace("[1, 1, 1]", "[1, 1, -0.5]"),
        "carrier, inertia = [1, 1, -0.5] kg m^2: Theta is not positive semidefinite, "
        "a principal moment about the centre of mass is -0.5 kg m^2, expected none below 0",
    ),
    "triangle inequality": (
        BASE.replace("[1, 1, 1]", "[1, 1, 2.1]"),
        "carrier, inertia = [1, 1, 2.1] kg m^2: principal moments about the centre of mass break the triangle "
        "inequality, 1 + 1 < 2.1 kg m^2, expected the smaller two to add up to at least 2.1 kg m^2, such as 1 and 1.1",
    ),
    "triangle inequality by products": (
        BASE.replace("[1, 1, 1]", "[[1, 0.9, 0], [0.9, 1, 0], [0, 0, 1]]"),
        "carrier, inertia = [[1, 0.9, 0], [0.9, 1, 0], [0, 0, 1]] kg m^2: principal moments about the centre of mass "
        "break the triangle inequality, 0.1 + 1 < 1.9 kg m^2, expected the smaller two to add up to at least "
        "1.9 kg m^2, such as 0.1 and 1.8",
    ),
    "flywheel without spin inertia": (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [0, 0.1, 0.1]',
        'flywheel "w1", inertia = [0, 0.1, 0.1] kg m^2: a flywheel needs inertia about its own axis, '
        "J11 at the origin is 0 kg m^2, expected above 0",
    ),
    "flywheel without inertia": (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1',
        'flywheel "w1", inertia: required, but missing (or spin_inertia and transverse_inertia)',
    ),
    "flywheel without mass": (
        BASE + '[[flywheel]]\nname = "w1"\ninertia = [1, 1, 1]',
        'flywheel "w1", mass: required, but missing',
    ),
    "added mass not symmetric": (
        BASE + f"added_mass = {[[2.0 if i == j else float(i == 0 and j == 5) for j in range(6)] for i in range(6)]}",
        "carrier, added_mass: not symmetric, [0][5] = 1.0 kg m but [5][0] = 0.0 kg m",
    ),
    "added mass negative": (
        BASE + "added_mass = [1, 1, 1, 1, -0.5, 1]",
        "carrier, added_mass: not positive semidefinite, [4][4] = -0.5",
    ),
    "added mass of a row without its diagonal": (
        BASE
        + f"added_mass = {[[float(i == j != 4) if {i, j} != {0, 4} else 1e-6 for j in range(6)] for i in range(6)]}",
        "carrier, added_mass: not positive semidefinite, [4][4] = 0 but [4][0] = 1e-06",
    ),
    "added mass indefinite": (
        BASE
        + f"added_mass = {[[1.0 if i == j else 3.0 if {i, j} == {0, 4} else 0.0 for j in range(6)] for i in range(6)]}",
        "carrier, added_mass: not positive semidefinite, least eigenvalue at unit diagonal -2",
    ),
    "mass beyond the range": (
        BASE.replace("mass = 3", "mass = 1e300") + 'center_of_mass = [1e10, 0, 0]\ninertia_about = "center_of_mass"',
        "carrier, mass: 1e+300 kg is beyond the range of the emitted C, expected at most 1e+15 kg",
    ),
    # mounting, data sheets
    "angles and axis": (
        BASE + WHEEL + "angles = [0, 0]\naxis = [1, 0, 0]\nzero = [0, 1, 0]",
        'flywheel "w1", angles: given together with axis, zero: expected one or the other',
    ),
    "axis without zero": (
        BASE + WHEEL + "axis = [1, 0, 0]",
        'flywheel "w1", zero: required with axis (direction of the second axis at phi_s = 0), but missing',
    ),
    "zero without axis": (BASE + WHEEL + "zero = [1, 0, 0]", 'flywheel "w1", axis: required with zero, but missing'),
    "zero parallel to axis": (
        BASE + WHEEL + "axis = [1, 2, 3]\nzero = [-2, -4, -6]",
        'flywheel "w1", zero: parallel to axis, expected another direction',
    ),
    "axis of no direction": (
        BASE + WHEEL + "axis = [0, 0, 0]\nzero = [0, 1, 0]",
        'flywheel "w1", axis: [0, 0, 0] has no direction',
    ),
    "data sheet with inertia": (
        BASE + WHEEL + "spin_inertia = 1",
        'flywheel "w1", inertia: given together with spin_inertia: expected one way or the other',
    ),
    "data sheet without transverse": (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1\nspin_inertia = 1',
        'flywheel "w1", transverse_inertia: required with spin_inertia, but missing; a thin disc has spin_inertia/2 = '
        "0.5 kg m^2 across its axis: for a thin disc write transverse_inertia = 0.5",
    ),
    "unbalance with center_of_mass": (
        BASE + SHEET + "center_of_mass = [0, 0, 0]",
        'flywheel "w1", center_of_mass: given together with spin_inertia, transverse_inertia: '
        "expected one way or the other",
    ),
    "unbalance of no mass": (
        BASE + SHEET.replace("mass = 1", "mass = 0") + 'unbalance = { static = "1 g cm" }',
        'flywheel "w1", unbalance, static: a flywheel of mass 0 cannot have a static unbalance',
    ),
    "unbalance beyond the body": (
        BASE + SHEET + "unbalance = { static = 0.2 }",
        'flywheel "w1", spin_inertia = 0.02 kg m^2, transverse_inertia = 0.011 kg m^2: Theta is not positive '
        "semidefinite, a principal moment about the centre of mass is -0.029 kg m^2, expected none below 0",
    ),
    # names
    "not an identifier": (
        BASE.replace('"s"', '"1s"'),
        'name: "1s" is not a C identifier (letters, digits, _; no digit first)',
    ),
    "not ASCII": (BASE.replace('"s"', '"ш"'), 'name: "ш" is not a C identifier (letters, digits, _; no digit first)'),
    "C keyword": (BASE + WHEEL.replace("w1", "double"), 'flywheel "double", name: "double" is a C keyword'),
    "C++ keyword": (BASE.replace('"s"', '"class"'), 'name: "class" is a C++ keyword'),
    "same name twice": (BASE + WHEEL + WHEEL, 'flywheel "w1", name: taken by a flywheel'),
    "point named as a body": (BASE + WHEEL + '[[point]]\nname = "w1"', 'point "w1", name: taken by a flywheel'),
    "carrier is taken": (BASE + '[[instrument]]\nname = "carrier"', 'instrument "carrier", name: taken by the carrier'),
    "unknown mount": (
        BASE + '[[instrument]]\nname = "gyro"\n' + WHEEL + 'mount = "giro"',
        'flywheel "w1", mount: unknown "giro", did you mean "gyro"?',
    ),
    "mount on a flywheel": (
        BASE + WHEEL + '[[point]]\nname = "p"\nmount = "w1"',
        'point "p", mount: "w1" is a flywheel, expected "carrier" or an instrument',
    ),
    # the whole
    "no mass at all": (BASE.replace("mass = 3", "mass = 0"), "total mass is zero: there is no centre of mass"),
    "a motion without inertia": (
        HEAD + "[carrier]\nmass = 1\ninertia = [0, 0, 0]",
        "mass matrix of the whole stand, scaled to unit diagonal, has a zero on its diagonal, or overflows, "
        "expected eigenvalues of at least 1e-12: some motion has no inertia",
    ),
}


@pytest.mark.parametrize(("text", "expected"), CASES.values(), ids=CASES.keys())
def test_each_problem_is_refused_in_words(text: str, expected: str) -> None:
    problems = refusal(text)
    assert [f"s.toml: {expected}"] == problems


def test_all_problems_are_reported_together() -> None:
    text = (
        HEAD
        + "gravty = 1\n[carrier]\nmass = -1\ninertia = [1, 1, 9]\ncentre = 1\n"
        + '[[instrument]]\nname = "gyro"\nmass = 1\ninertia = [1, 1, 9]\n'
        + WHEEL.replace("mass = 1", 'mass = "1 m"')
        + WHEEL.replace("w1", "w2").replace("[0.02, 0.01, 0.01]", "[1, 1, 9]")
        + 'mount = "giro"\n'
    )
    expected = [
        's.toml: unknown key "gravty", did you mean "gravity"?',
        "s.toml: carrier, mass: -1 kg is negative",
        's.toml: carrier: unknown key "centre", did you mean "center_of_mass"?',
        's.toml: flywheel "w1", mass: unit "m" does not fit, expected a mass (kg)',
        's.toml: flywheel "w2", mount: unknown "giro", did you mean "gyro"?',
        's.toml: instrument "gyro", inertia = [1, 1, 9] kg m^2: principal moments about the centre of mass break '
        "the triangle inequality, 1 + 1 < 9 kg m^2, expected the smaller two to add up to at least 9 kg m^2, "
        "such as 1 and 8",
        's.toml: flywheel "w2", inertia = [1, 1, 9] kg m^2: principal moments about the centre of mass break '
        "the triangle inequality, 1 + 1 < 9 kg m^2, expected the smaller two to add up to at least 9 kg m^2, "
        "such as 1 and 8",
    ]
    assert expected == refusal(text)


def test_a_key_that_cannot_be_read_does_not_hide_what_is_unphysical() -> None:
    flat = WHEEL.replace("0.02, 0.01, 0.01", "0.05, 0.01, 0.01")
    lines = refusal(BASE + flat + 'position = ["1 kg", 0, 0]\nmotr = { torque = 1 }\n')
    assert len(lines) == 3
    assert any("position[0]" in line for line in lines)
    assert any('unknown key "motr"' in line for line in lines)
    assert any("break the triangle inequality" in line for line in lines)


@pytest.mark.parametrize("key", ['center_of_mass = ["1 kg", 0, 0]', "inertia_abot = 3", "center_of_mas = [1, 0, 0]"])
def test_where_mass_properties_cannot_be_read_nothing_is_guessed_of_them(key: str) -> None:
    (line,) = refusal(BASE + WHEEL.replace("0.02, 0.01, 0.01", "0.05, 0.01, 0.01") + key + "\n")
    assert key.partition(" ")[0] in line


def test_directions_are_parallel_below_an_angle_of_1e_9_rad() -> None:
    text = BASE + WHEEL + "axis = [3, 0, 0]\nzero = [-2, {}, 0]\n"
    assert loads(text.format(2 * 1.05e-9)).flywheels
    (line,) = refusal(text.format(2 * 0.95e-9))
    assert "zero: parallel to axis" in line
