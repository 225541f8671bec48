"""Every refusal of a stand file, with the message a user sees."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import loads
from mahovik.errors import StandError
from stand.test_hold import STAND, task
from stand.test_summary import FLOATING
from stand.test_written import FIN, LISTS, TEXT

CARRIER = """
[carrier]
mass = 3
inertia = [1, 1, 1]
"""
HEAD = 'schema = 1\nname = "s"\n'
BASE = HEAD + CARRIER
WHEEL = '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [0.02, 0.01, 0.01]\n'
SHEET = '[[flywheel]]\nname = "w1"\nmass = 1\nspin_inertia = 0.02\ntransverse_inertia = 0.011\n'


def mass(value: str) -> str:
    """A stand whose carrier has this mass."""
    return BASE.replace("mass = 3", f"mass = {value}")


def inertia(value: str) -> str:
    """A stand whose carrier has this inertia."""
    return BASE.replace("[1, 1, 1]", value)


def refusal(text: str) -> list[str]:
    with pytest.raises(StandError) as caught:
        loads(text, "s.toml")
    assert all("\n" not in problem for problem in caught.value.problems)
    return list(caught.value.problems)


CASES = [
    ('name = "s"' + CARRIER, "schema: required, but missing"),
    (BASE.replace("= 1", "= 2", 1), "schema: unknown version 2, this program reads schema 1"),
    (BASE.replace("= 1", "= 1.0", 1), "schema: expected a whole number, found 1.0"),
    (HEAD, "carrier: required, but missing"),
    (HEAD + "carrier = 3", "carrier: expected a table, found 3"),
    (BASE + '[flywheel]\nname = "w1"\nmass = 1', "flywheel: expected an array of tables, [[flywheel]], found a table"),
    (HEAD + "gravty = [0, 0, 1]\n" + CARRIER, 'unknown key "gravty", did you mean "gravity"?'),
    (
        BASE + WHEEL + ("added_mass = [1, 1, 1, 1, 1, 1]"),
        'flywheel "w1": unknown key "added_mass": that of a flywheel would turn with it; give it to the carrier '
        "or an instrument",
    ),
    (mass("true"), "carrier, mass: expected a mass (kg), found true"),
    (
        HEAD + 'angles = "xyz"' + CARRIER,
        'angles: expected "ship" (or "zyx"), "aircraft" ("yzx") or "euler" ("zxz"), found "xyz"',
    ),
    (
        BASE.replace("schema = 1", 'schema = 1\nphase_input = "resolver"', 1) + WHEEL,
        'phase_input: expected "angle" or "sincos", found "resolver"',
    ),
    (
        BASE.replace("schema = 1", 'schema = 1\nphase_input = "sincos"', 1),
        'phase_input: "sincos" says how phases are given, but there is no flywheel',
    ),
    (mass('"3 foo"'), 'carrier, mass: "foo" is not a known unit, expected a mass (kg)'),
    (mass('"3"'), 'carrier, mass: "3" has no unit, write the number without quotes for SI'),
    (
        inertia("[1, 1, 1, 0, 0, 0]"),
        "carrier, inertia: expected three rows of three numbers, or a diagonal of three, found 6 items",
    ),
    (mass('"much"'), 'carrier, mass: "much" is not a number with a unit, expected a mass (kg)'),
    (BASE.replace('"s"', '"class"'), 'name: "class" is a C++ keyword'),
    (mass("nan"), "carrier, mass: not finite: nan"),
    (mass("1e400"), "carrier, mass: not finite in double precision"),
    (mass("-3"), "carrier, mass: -3 kg is negative"),
    (BASE + "[[leg]]\nground = [0, 0, 1]\ncarrier = [0, 0, 0]\nlength = -1", "leg[0], length: -1 m is negative"),
    (
        inertia("[[1, 0.002, 0], [0.02, 1, 0], [0, 0, 1]]"),
        "carrier, inertia: not symmetric, [0][1] = 0.002 kg m^2 but [1][0] = 0.02 kg m^2",
    ),
    (
        inertia("[1, 1, 2.1]"),
        "carrier, inertia = [1, 1, 2.1] kg m^2: principal moments about the centre of mass break the triangle "
        "inequality, 1 + 1 < 2.1 kg m^2, expected the smaller two to add up to at least 2.1 kg m^2, such as 1 "
        "and 1.1",
    ),
    (
        inertia("[[1, 0.9, 0], [0.9, 1, 0], [0, 0, 1]]"),
        "carrier, inertia = [[1, 0.9, 0], [0.9, 1, 0], [0, 0, 1]] kg m^2: principal moments about the centre of "
        "mass break the triangle inequality, 0.1 + 1 < 1.9 kg m^2, expected the smaller two to add up to at "
        "least 1.9 kg m^2, such as 0.1 and 1.8",
    ),
    (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [0, 0.1, 0.1]',
        'flywheel "w1", inertia = [0, 0.1, 0.1] kg m^2: a flywheel needs inertia about its own axis, J11 at the '
        "origin is 0 kg m^2, expected above 0",
    ),
    (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1',
        'flywheel "w1", inertia: required, but missing (or spin_inertia and transverse_inertia)',
    ),
    (BASE + '[[flywheel]]\nname = "w1"\ninertia = [1, 1, 1]', 'flywheel "w1", mass: required, but missing'),
    (
        mass("1e300") + 'center_of_mass = [1e10, 0, 0]\ninertia_about = "center_of_mass"',
        "carrier, mass: 1e+300 kg is beyond the range of the emitted C, expected at most 1e+15 kg",
    ),
    (
        BASE + '[[flywheel]]\nname = "w1"\nmass = 1\nspin_inertia = 1',
        'flywheel "w1", transverse_inertia: required with spin_inertia, but missing; a thin disc has '
        "spin_inertia/2 = 0.5 kg m^2 across its axis: for a thin disc write transverse_inertia = 0.5",
    ),
    (
        BASE + SHEET.replace("mass = 1", "mass = 0") + 'unbalance = { static = "1 g cm" }',
        'flywheel "w1", unbalance, static: a flywheel of mass 0 cannot have a static unbalance',
    ),
    (
        BASE + SHEET + "unbalance = { static = 0.2 }",
        'flywheel "w1", spin_inertia = 0.02 kg m^2, transverse_inertia = 0.011 kg m^2: Theta is not positive '
        "semidefinite, a principal moment about the centre of mass is -0.029 kg m^2, expected none below 0",
    ),
    (BASE.replace('"s"', '"1s"'), 'name: "1s" is not a C identifier (letters, digits, _; no digit first)'),
    (BASE + WHEEL.replace("w1", "double"), 'flywheel "double", name: "double" is a C keyword'),
    (BASE + WHEEL + WHEEL, 'flywheel "w1", name: taken by a flywheel'),
    (BASE + '[[instrument]]\nname = "carrier"', 'instrument "carrier", name: taken by the carrier'),
    (
        BASE + '[[instrument]]\nname = "gyro"\n' + WHEEL + 'mount = "giro"',
        'flywheel "w1", mount: unknown "giro", did you mean "gyro"?',
    ),
    (
        BASE + WHEEL + '[[point]]\nname = "p"\nmount = "w1"',
        'point "p", mount: "w1" is a flywheel, expected "carrier" or an instrument',
    ),
    (mass("0"), "total mass is zero: there is no centre of mass"),
    (
        HEAD + "[carrier]\nmass = 1\ninertia = [0, 0, 0]",
        "mass matrix of the whole stand, scaled to unit diagonal, has a zero on its diagonal, or overflows, "
        "expected eigenvalues of at least 1e-12: some motion has no inertia",
    ),
]
OF_CARRIER = [
    ("wrench_input = 1", "wrench_input: expected true or false, found 1"),
    (
        'center_of_mass = { value = [1, "2 mm", 3], unit = "mm" }\ninertia_about = "origin"',
        'center_of_mass[1]: "2 mm" has a unit of its own inside a list in mm',
    ),
    (
        "center_of_mass = { value = [1, 2, 3] }",
        'center_of_mass: expected { value = ..., unit = "..." }, found a table of value',
    ),
    (
        'added_mass = { value = [1, 1, 1, 1, 1, 1], unit = "kg" }',
        "added_mass: a 6x6 mixes units (metres and radians), so one unit cannot be for all: write SI numbers",
    ),
    (
        'damping = { terms = [{ wrench = "Y", of = ["u", "r"], value = "1 N" }] }',
        'damping, terms[0], value: unit "N" does not fit, expected a derivative (N s^2/m/rad)',
    ),
    ("damping = { terms = 3 }", "damping, terms: expected a list, found 3"),
    (
        'inertia_about = "centre_of_mass"',
        'inertia_about: expected "origin" or "center_of_mass", found "centre_of_mass"',
    ),
    ("center_of_mass = 1", "center_of_mass: expected 3 numbers, found 1"),
    (
        "added_mass = [1, 1, 1, 1, 1]",
        "added_mass: expected six rows of six numbers, or a diagonal of six, found 5 items",
    ),
    (
        'damping = { terms = [{ wrench = "Y", of = ["u"], value = 1 }] }',
        'damping, terms[0], of: expected two factors such as ["r", "|v|"], found 1',
    ),
    (
        'damping = { terms = [{ wrench = "Y", of = ["u", "|s|"], value = 1 }] }',
        'damping, terms[0], of: expected one of u v w p q r, with or without bars, found "|s|"',
    ),
    (
        'damping = { terms = [{ wrench = "y", of = ["u", "v"], value = 1 }] }',
        'damping, terms[0], wrench: expected one of X Y Z K M N, found "y"',
    ),
    (
        "center_of_mass = [0, 0, 0.1]",
        'inertia_about: required where center_of_mass is not zero, expected "origin" or "center_of_mass"',
    ),
    (
        'center_of_mass = [1, 1, 0]\ninertia_about = "origin"',
        "inertia = [1, 1, 1] kg m^2: Theta is not positive semidefinite, a principal moment about the centre of "
        "mass is -5 kg m^2, expected none below 0",
    ),
    (
        f"added_mass = {[[2.0 if i == j else float(i == 0 and j == 5) for j in range(6)] for i in range(6)]}",
        "added_mass: not symmetric, [0][5] = 1.0 kg m but [5][0] = 0.0 kg m",
    ),
    ("added_mass = [1, 1, 1, 1, -0.5, 1]", "added_mass: not positive semidefinite, [4][4] = -0.5"),
    (
        f"added_mass = {[[float(i == j != 4) if {i, j} != {0, 4} else 1e-6 for j in range(6)] for i in range(6)]}",
        "added_mass: not positive semidefinite, [4][4] = 0 but [4][0] = 1e-06",
    ),
    (
        f"added_mass = {[[1.0 if i == j else 3.0 if {i, j} == {0, 4} else 0.0 for j in range(6)] for i in range(6)]}",
        "added_mass: not positive semidefinite, least eigenvalue at unit diagonal -2",
    ),
]
"""Further keys of the carrier, and the message about it."""

OF_WHEEL = [
    ('angles = ["3 rpm", 0]', 'angles[0]: unit "rpm" does not fit, expected an angle (rad)'),
    (
        'motor = { speed = "50 Hz" }',
        'motor, speed: unit "Hz" does not fit, expected an angular speed (rad/s), a frequency is not one: write '
        "rpm or rad/s",
    ),
    ('angles = ["3 dB", 0]', 'angles[0]: unit "dB" has an offset or is logarithmic, expected an angle (rad)'),
    ("angles = [1]", "angles: expected 2 or 3 numbers, found 1"),
    ("motor = { speed = 0 }", "motor, speed: 0 rad/s is not above 0"),
    ("encoder = { counts = 0 }", "encoder, counts: expected at least 1 count per turn, found 0"),
    (
        "angles = [0, 0]\naxis = [1, 0, 0]\nzero = [0, 1, 0]",
        "angles: given together with axis, zero: expected one or the other",
    ),
    *(
        (
            f"axis = [1, 0, 0]\n{key}",
            f"zero: required with axis (direction of the second axis at phi_s = 0) for its {what}, but missing",
        )
        for key, what in (
            ("wrench_input = true", "run-time wrench"),
            ('center_of_mass = [0, "1 mm", 0]\ninertia_about = "origin"', "centre of mass off the axis"),
            ("damping = { linear = [0, 1, 2, 0, 0, 0] }", "damping"),
            ("damping = { quadratic = [0, 1, 1, 0, 0, 0] }", "damping"),
            ("buoyancy = { displaced_mass = 1, center = [0, 0, 0.1] }", "buoyancy"),
        )
    ),
    ("zero = [1, 0, 0]", "axis: required with zero, but missing"),
    ("axis = [1, 2, 3]\nzero = [-2, -4, -6]", "zero: parallel to axis, expected another direction"),
    ("axis = [0, 0, 0]\nzero = [0, 1, 0]", "axis: [0, 0, 0] has no direction"),
    ("spin_inertia = 1", "inertia: given together with spin_inertia: expected one way or the other"),
]
"""Further keys of the flywheel w1, and the message about it."""

CASES += [(BASE + keys, f"carrier, {words}") for keys, words in OF_CARRIER]
CASES += [(BASE + WHEEL + keys, f'flywheel "w1", {words}') for keys, words in OF_WHEEL]


@pytest.mark.parametrize(("text", "expected"), CASES, ids=[words for _, words in CASES])
def test_each_problem_is_refused_in_words(text: str, expected: str) -> None:
    problems = refusal(text)
    assert [f"s.toml: {expected}"] == problems


def test_all_problems_are_reported_together() -> None:
    text = (
        HEAD
        + "gravty = 1\n[carrier]\nmass = -1\ninertia = [1, 1, 9]\ncentre = 1\n"
        + '[[instrument]]\nname = "gyro"\nmass = 1\ninertia = [1, 1, 9]\n'
        + '[[isolator]]\nname = "foot"\nposition = 1\nstiffness = [1, 1, 1]\n'
        + WHEEL.replace("mass = 1", 'mass = "1 m"')
        + WHEEL.replace("w1", "w2").replace("[0.02, 0.01, 0.01]", "[1, 1, 9]")
        + 'mount = "giro"\n'
    )
    expected = [
        's.toml: unknown key "gravty", did you mean "gravity"?',
        's.toml: isolator "foot", position: expected 3 numbers, found 1',
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


def test_an_item_that_cannot_be_read_does_not_hide_what_the_others_name() -> None:
    terms = ('{ wrench = "X", of = ["u", "a.speed"], value = 1 }', '{ wrench = "X", of = [], value = 1 }',
             '{ wrench = "X", of = ["b.speed"], value = 1 }')  # fmt: skip
    lines = refusal(BASE + f"control_derivatives = {{ terms = [{', '.join(terms)}] }}\n")
    assert len(lines) == 2 and "carrier, control_derivatives, terms[1], of: expected one to four factors" in lines[0]
    assert 'carrier, control_derivatives, terms, of: no "a.speed", "b.speed" on this body' in lines[1]


@pytest.mark.parametrize("key", ['center_of_mass = ["1 kg", 0, 0]', "inertia_abot = 3", "center_of_mas = [1, 0, 0]"])
def test_where_mass_properties_cannot_be_read_nothing_is_guessed_of_them(key: str) -> None:
    (line,) = refusal(BASE + WHEEL.replace("0.02, 0.01, 0.01", "0.05, 0.01, 0.01") + key + "\n")
    assert key.partition(" ")[0] in line


@pytest.mark.parametrize("text", ['hold = ["yaw"]\n', "hold = 3\n", '[[hold]]\nfreedoms = ["yaw"]\n'])
def test_a_hold_that_is_no_table_is_shown_one(text: str) -> None:
    (line,) = refusal(HEAD + text + CARRIER)
    assert 'expected one table, [hold] with a line such as freedoms = ["yaw"]' in line


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('freedoms = ["yaw", "x", "yaw"]', "yaw is given twice"),
        ('freedoms = ["jaw"]', 'unknown freedom "jaw", did you mean "yaw"?'),
        ('freedoms = "yaw"', "expected a list of names"),
        ("axis = [0, 0, 0]", "has no direction"),
        ("axis = [0, 0, 1]\nslide = [0, 0, 1]", "hold: found axis and slide of freedoms, axis"),
        ("pivot = [0, 0, 1]", "hold: found none of freedoms, axis"),
        ("slide = [0, 0, 1]\npivot = [0, 0, 1]", "pivot: given together with slide"),
        ("basis = [[1, 0, 0, 0, 0, 1], [2, 0, 0, 0, 0, 2]]", "row 1 follows from row 0"),
        ("basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 1e-13]]", "rows are nearly dependent, by masses and inertias"),
        ("basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 1e-3]]", "the difference of two rows in place of one"),
        ("basis = [[1, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0]]", "a row of zeros is no motion"),
        ("basis = [[1, 0, 0]]", "expected 6 numbers, found 3"),
        ("basis = []", "freedoms = [] is clamped"),
        ('freedom = ["yaw"]', "unknown key"),
        ('freedoms = ["yaw"]\n[task.t]\nrows = ["wx"]', "tasks of a carrier with [hold] are not there yet"),
    ],
)
def test_a_hold_that_is_none_is_refused_in_one_line(text: str, reason: str) -> None:
    (line,) = refusal(f"{BASE}{WHEEL}[hold]\n{text}\n")
    assert "hold" in line and reason in line


TASKS = [
    (
        task('[{ point = "telescop", rows = ["wy"] }]'),
        'task "sight", rows: unknown point "telescop", did you mean "telescope"?',
    ),
    (
        task('[{ point = "carrier", rows = ["wy"] }]'),
        'task "sight", rows: unknown point "carrier": rows of the carrier itself are those of O1, and stand without a '
        'point, rows = ["wx", ...]',
    ),
    (task('["wx", "w"]'), 'task "sight", rows[1]: unknown component "w", did you mean "wx"?'),
    (
        task('[{ point = "mast", rows = ["x", 3] }]'),
        'task "sight", rows[0]: rows[0]: unknown component "x", did you mean "vx"?',
    ),
    (task("[3]"), 'task "sight", rows[0]: expected one of vx, vy, vz, wx, wy, wz, found 3'),
    (task("[]"), 'task "sight", rows: expected a list of rows such as ["wx", "wy", "wz"], found an empty list'),
    (task('["wx", "vx", { point = "mast", rows = ["wx"] }, "vx"]'), 'task "sight", rows: vx is given twice'),
    (
        task('["wx", { point = "mast", rows = ["wy", "wx"] }]'),
        'task "sight", rows: mast.wx follows from wx at every state: rows of a task must be independent; '
        "leave one of them out",
    ),
    (
        task('["vx", { point = "mast", rows = ["vx"] }, "wy"]'),
        'task "sight", rows: wy follows from vx, mast.vx at every state: rows of a task must be independent; '
        "leave one of them out",
    ),
    (task('["wx"]', "int"), 'task "int": "int" is a C keyword'),
    (
        STAND.split("[[flywheel]]", maxsplit=1)[0] + '[task.a]\nrows = ["wx"]\n',
        "task: a task is what flywheels are to do, but there is no flywheel",
    ),
    (STAND.replace("[carrier]", "task = 3\n[carrier]"), "task: expected tables [task.NAME], found 3"),
    (
        STAND.replace("[carrier]", 'inverse_most = "3 rpm"\n[carrier]'),
        'inverse_most: unit "rpm" does not fit, expected an angular acceleration (rad/s^2)',
    ),
]


@pytest.mark.parametrize(("text", "expected"), TASKS, ids=[words for _, words in TASKS])
def test_a_wrong_task_is_refused(text: str, expected: str) -> None:
    assert f"s.toml: {expected}" in refusal(text)


@pytest.mark.parametrize("name", ["fast", "fast_point", "a_at", "work_3"])
def test_a_name_that_the_c_needs_is_refused(name: str) -> None:
    with pytest.raises(StandError, match="would make a name of the C that is taken"):
        loads(task('["wx"]', name))


WRITTEN = [
    ("0.05 g mm", "-3 g mm", "unbalance, static: -3 g mm (-3e-06 kg m) is negative"),
    ("6000 1/min", "0 rpm", "motor, speed: 0 rpm (0 rad/s) is not above 0"),
    ("11 kg-cm²", "-11 kg-cm²", "transverse_inertia: -11 kg-cm² (-0.0011 kg m^2) is negative"),
    ("value = 12000", "value = -12000", "carrier, mass: -12000 g (-12 kg) is negative"),
    ("1e-7", "-1e-7", "unbalance, dynamic: -1e-07 kg m^2 is negative"),
    ('"11 kg cm^2", 0.0012', '0.0012, "-11 kg cm^2"', "inertia[1]: -11 kg cm^2 (-0.0011 kg m^2) is negative"),
    ("0, 0.5, 11]", "0, 0.3, 11]", "[1][2] = 0.5 kg cm^2 (5e-05 kg m^2) but [2][1] = 0.3 kg cm^2 (3e-05 kg m^2)"),
    ('0, "0.0011', '"3 g cm^2", "0.0011', "[1][2] = 0 kg cm^2 (0 kg m^2) but [2][1] = 3 g cm^2 (3e-07 kg m^2)"),
]
"""Text of a number in TEXT or LISTS, another in its place, and the message about it."""


@pytest.mark.parametrize(("old", "new", "words"), WRITTEN)
def test_a_refused_number_is_shown_as_it_is_written(old: str, new: str, words: str) -> None:
    text = TEXT if old in TEXT else LISTS
    assert old in text and words in refusal(text.replace(old, new))[0]


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        (("124", "126", "1.5", "1.5"), "inertia: not symmetric, [0][1] = 0.124 kg m^2 but [1][0] = 0.126 kg m^2"),
        (("0", "001", "1.5", "1.5"), "inertia: not symmetric, [0][1] = 0.0 kg m^2 but [1][0] = 0.001 kg m^2"),
        (("124", "124", "1.53", "1.5"), "added_mass: not symmetric, [1][5] = 1.53 kg m but [5][1] = 1.5 kg m"),
    ],
)
def test_elements_that_differ_by_more_are_refused_as_they_are_written(numbers: tuple[str, ...], message: str) -> None:
    """The added mass may differ by 1e-3 sqrt(40 10) = 0.02 kg m."""
    assert message in refusal(FIN.format(*numbers, 0))[0]


@pytest.mark.parametrize("raw", ["9.81", "false", '"0"'])
def test_gravity_of_one_number_has_no_direction(raw: str) -> None:
    assert "gravity: expected 3 numbers" in refusal(f"gravity = {raw}\n{BASE}")[0]


def test_added_mass_with_the_signs_of_derivatives_is_refused_by_the_convention() -> None:
    """One negative number is a slip of another kind."""
    text = FLOATING.replace("added_mass = [1.272, 1.424, 3.736, 0.0378, 0.027, 0.0444]", "added_mass = {}")
    sign = "published derivatives (X_udot, ...) are negative, added mass is minus these; expected other signs"
    for diagonal, all_of_them in (("[-1.2, -1.4, -3.7, 0, -0.02, -0.04]", True), ("[1.2, -1.4, 3.7, 0, 0, 0]", False)):
        assert any(sign in line for line in refusal(text.replace("{}", diagonal))) == all_of_them


THIN = '[[flywheel]]\nname = "w1"\nmass = "120 g"\nspin_inertia = "450 g cm^2"\ntransverse_inertia = {}\n'
UNBALANCE = 'unbalance = { static = "30 g mm", dynamic = "200 g cm^2" }\n'


@pytest.mark.parametrize(
    ("unbalance", "least", "words"),
    [
        ("", "225", "spin_inertia/2 = 225 g cm^2 across its axis: for"),
        (UNBALANCE, "402.838", "= 225 g cm^2 across its axis, with this unbalance 402.838 g cm^2: for"),
    ],
)
def test_a_disc_thinner_than_any_is_told_the_least_transverse_inertia(unbalance: str, least: str, words: str) -> None:
    (line,) = refusal(BASE + THIN.format('"200 g cm^2"') + unbalance)
    assert "break the triangle inequality" in line and words in line
    advised = f'"{least} g cm^2"'
    assert line.endswith(f"for a thin disc write transverse_inertia = {advised}")
    loads(BASE + THIN.format(advised) + unbalance)
    assert refusal(BASE + THIN.format(f'"{0.9999 * float(least)} g cm^2"') + unbalance)
    (line,) = refusal(BASE + THIN.partition("transverse")[0] + unbalance)
    assert line.endswith(f"for a thin disc write transverse_inertia = {advised}")


def test_numbers_without_units_are_answered_by_such() -> None:
    sheet = THIN.replace('"450 g cm^2"', "0.000073")
    (line,) = refusal(BASE + sheet.format("2e-5"))
    assert "spin_inertia = 0.000073 kg m^2, transverse_inertia = 0.00002 kg m^2: " in line
    loads(BASE + sheet.format(line.rpartition(" = ")[2]))


@pytest.mark.parametrize(
    ("value", "shown", "sides"),
    [
        ('{ value = [120, 60, 40], unit = "g cm^2" }', "[120, 60, 40] g cm^2", "40 + 60 < 120 g cm^2"),
        ('["1200 g mm^2", "6 gcm2", 0]', "[1200 g mm^2, 6 gcm2, 0]", "0 + 600 < 1200 g mm^2"),
        ("[0.5, 0.5, 1.00000001]", "[0.5, 0.5, 1.00000001] kg m^2", "0.5 + 0.5 < 1.00000001 kg m^2"),
    ],
)
def test_moments_are_shown_in_the_unit_of_the_file(value: str, shown: str, sides: str) -> None:
    (line,) = refusal(inertia(value))
    assert line.startswith(f"s.toml: carrier, inertia = {shown}: principal moments ")
    assert f"inequality, {sides}, expected the smaller two to add up to at least " in line


def test_the_moments_that_a_message_names_are_those_of_a_body() -> None:
    """What stands after "such as", with the largest moment, is read without a refusal."""
    body = '{{ value = [{}, {}, {}], unit = "g cm^2" }}'
    (line,) = refusal(inertia(body.format(120, 60, 40)))
    assert line.endswith("at least 120 g cm^2, such as 40 and 80")
    loads(inertia(body.format(120, 80, 40)))
    assert refusal(inertia(body.format(120, 79.999, 40)))


@pytest.mark.parametrize(
    ("key", "answer"),
    [
        ('momentum = "0.4 N m s"', "it is spin_inertia times speed"),
        ('grade = "G 2.5"', "static unbalance is mass times G over speed"),
        ('unbalance = { grade = "G 2.5" }', "static unbalance is mass times G over speed"),
        ('angular_momentum = "0.4 N m s"', "it is spin_inertia times speed"),
        ('balance_grade = "G 2.5"', "static unbalance is mass times G over speed"),
        ('working_moment = "30 kg cm"', "twice the static one"),
        ('workmoment = "30 kg cm"', "twice the static one"),
        ('mass_moment = "30 kg cm"', "twice the static one"),
        ('unbalance = { moment = "30 kg cm" }', "twice the static one"),
    ],
)
def test_keys_that_people_write_are_answered(key: str, answer: str) -> None:
    (line,) = refusal(BASE + SHEET + key)
    assert "unknown key" in line
    assert answer in line


@pytest.mark.parametrize("axis", [(0, 0, 1), (-3, 0.2, 0.1), (1, 1, 0)])
def test_a_round_flywheel_needs_no_zero(axis: tuple[float, ...]) -> None:
    more = f"axis = {list(axis)}\ndamping = {{ linear = [0.1, 1, 1, 1e-3, 2, 2] }}\n"
    wheel = loads(BASE + SHEET + more).flywheels[0]
    other = loads(BASE + SHEET + more + "zero = [0.3, 0.2, 0.9]").flywheels[0]
    spin, direction = (np.array(x) / np.linalg.norm(x) for x in (axis, wheel.mounting.zero))
    assert abs(spin @ direction) < 0.9
    assert replace(wheel, mounting=other.mounting) == other


def test_flat_discs_and_rods_are_bodies_and_shapes_are_not_known() -> None:
    assert loads(inertia("[0.5, 0.5, 1.0000000004]")).carrier.inertia[2][2] == 1.0000000004
    rod = WHEEL.replace("[0.02, 0.01, 0.01]", "[0.02, 0, 0.02]")
    assert loads(BASE + rod).flywheels[0].inertia[1][1] == 0.0
    (line,) = refusal(BASE + THIN.format('"300 g cm^2"') + 'shape = "thin disc"\n')
    assert 'unknown key "shape": a flywheel has numbers in the place of a shape' in line
    (line,) = refusal(BASE + THIN.format('["900 g cm^2", "1 g cm^2"]'))
    assert "break the triangle inequality" in line and "thin disc" not in line  # longer than any
