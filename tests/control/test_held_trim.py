"""Trim of held carriers: its matrix against a closed formula and harmonic balance, and what it does in the loop."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from export.held_servos import (
    ARM,
    FRICTION,
    HARMONICS,
    MASS,
    PERIOD,
    SPIN,
    WHOLE,
    hung,
    motion,
    pendulum,
    programme,
    servo,
)
from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.motion.required import RequiredMotion, read_motion
from mahovik.core.motion.servo import Trim, read_servo
from mahovik.core.stand import identities, loads
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.errors import ServoError, UsageError
from mahovik.out.export.servo import trim_message
from mahovik.proof.verify.servo.tables import MATRIX
from mahovik.proof.verify.servo.trim_matrix import trim_matrix
from mahovik.use.control.reference_motion import nodes, required_orbit, settled_state
from mahovik.use.control.trim import design_trim
from mahovik.use.plan.forward import course
from mahovik.use.plan.residual import Mechanics
from toolchain.quick import quick

HIGHEST = 10
"""Harmonics of the motion that unbalanced wheels make: all above rounding."""

HEAD = 'schema = 1\nsample_period = "1 ms"\nbandwidth = "20 Hz"\n'
TABLE = """
schema = 1
name = "table"
gravity = [0, 0, -9.81]
[carrier]
mass = 5.0
center_of_mass = [0.02, -0.01, 0.03]
inertia = [0.05, 0.06, 0.07]
inertia_about = "center_of_mass"
[suspension]
stiffness = [4000, 3000, 5000, 200, 250, 150]
damping = [40, 50, 60, 2, 3, 4]
[hold]
{hold}
position = [0.02, 0.01, -0.03]
angles = [0.2, 0.1, -0.3]
[[flywheel]]
name = "w0"
mass = 0.5
position = [0, 0.2, 0.1]
axis = [0.2, 0.3, 1]
zero = [1, 0, -0.2]
center_of_mass = [0, 0.004, 0]
inertia_about = "center_of_mass"
inertia = [1e-3, 6e-4, 6e-4]
[[flywheel]]
name = "w1"
mass = 0.4
position = [0.1, 0, 0.1]
axis = [1, 0, 0.4]
zero = [0, 1, 0]
center_of_mass = [0, 0.003, -0.003]
inertia_about = "center_of_mass"
inertia = [1e-3, 7e-4, 6e-4]
"""
HOLDS = {
    "hinge": ("axis = [1, -2, 0.5]\npivot = [0.05, 0, -0.1]", '["1"]'),
    "plane": ('freedoms = ["z", "x", "pitch"]\npivot = [0.05, 0, -0.1]', '["x", "pitch"]'),
    "rail": ("slide = [1, 1, 3]", '["1"]'),
}
Case = tuple[Stand, RequiredMotion, Programme]


def required(stand: Stand, period: float, **more: object) -> RequiredMotion:
    """A required motion by its harmonics."""
    given = {"schema": 1, "name": "move", "type": "periodic", "period": period, **more}
    return read_motion(json.dumps(given), stand)


def programme_of(stand: Stand, wanted: RequiredMotion, phi: Fourier, winding: tuple[int, ...]) -> Programme:
    """A programme of these angles, with the identities of the stand."""
    own, names = identities(stand), tuple(each.name for each in stand.flywheels)
    bias = np.zeros_like(wanted.mean)
    return Programme(
        stand.name, own.structure, own.physics, "move", names, True, wanted.span, bias, winding, phi,
    )  # fmt: skip


@cache
def table(name: str) -> Case:
    """A suspended stand that is held so, with unbalanced wheels that turn unevenly, and the motion that they make."""
    stand, period = loads(TABLE.format(hold=HOLDS[name][0])), 0.4
    assert stand.hold is not None
    begun = required(stand, period, harmonics=[{"k": 1, "cos": [0.0] * len(stand.hold.freedoms)}])
    phi = Fourier(np.array([0.3, 1.0]), np.array([[0.2, -0.1]]), np.array([[0.1, 0.15]]))
    driven = programme_of(stand, begun, phi, (1, -2))
    mechanics, count = Mechanics.of(stand), nodes(begun, driven, 12)
    orbit = required_orbit(mechanics, begun, driven, count)
    start = settled_state(mechanics, begun, driven, count)
    found = course(orbit.chart, orbit.drive, period / count, start, orbit.y, None).y[:-1, : orbit.chart.count]
    terms = np.fft.rfft(found + begun.mean, axis=0) / count
    harmonics = [
        {"k": k, "cos": (2.0 * terms[k].real).tolist(), "sin": (-2.0 * terms[k].imag).tolist()}
        for k in range(1, HIGHEST + 1)
    ]
    made = required(stand, period, mean=terms[0].real.tolist(), harmonics=harmonics)
    return stand, made, programme_of(stand, made, phi, (1, -2))


def trim_of(stand: Stand, keys: str) -> Trim:
    """A trim by its keys."""
    found = read_servo(f"{HEAD}[trim]\n{keys}\n", stand).trim
    assert found is not None
    return found


@pytest.mark.parametrize("name", quick(1, HOLDS))
def test_the_matrix_is_that_of_harmonic_balance(name: str) -> None:
    """The judge is the literal reference with multipliers, along the required motion."""
    case = table(name)
    trim = trim_of(case[0], f"coordinates = {HOLDS[name][1]}\nharmonics = 2\nsettling = 60\ngain = 0.3")
    expected, scale = trim_matrix(*case, trim)
    assert (np.abs(design_trim(*case, trim).matrix - expected) / scale).max() < MATRIX


def test_a_pendulum_answers_by_its_closed_formula() -> None:
    """(M g l - A w^2 + i c w) theta = J w^2 phi near the vertical; half of an error is taken back."""
    nothing = np.zeros((HARMONICS, 1))
    wanted = required(hung(), PERIOD, harmonics=[{"k": 1, "cos": [1e-6]}])
    programme_ = programme_of(hung(), wanted, Fourier(np.zeros(1), nothing, nothing), (0,))
    design = design_trim(hung(), wanted, programme_, trim_of(hung(), "harmonics = 3"))
    for k in (1, 2, 3):
        w = 2 * np.pi / PERIOD * k
        h = SPIN * w**2 / (MASS * 9.81 * ARM - WHOLE * w**2 + 1j * FRICTION * w)
        found = design.response[2 * k - 1 : 2 * k + 1, 2 * k - 1 : 2 * k + 1]
        assert found == pytest.approx(np.array([[h.real, h.imag], [-h.imag, h.real]]), rel=1e-8)
    assert design.unit == pytest.approx(np.sqrt(MASS / WHOLE))
    error = np.array([0, 1e-3, 2e-3, -1e-3, 0, 0, 5e-4])
    assert design.response @ design.matrix @ error == pytest.approx(0.5 * error, rel=1e-9, abs=1e-15)


def test_the_programme_of_the_swinging_pendulum_too() -> None:
    """Along a large swing, where harmonics couple."""
    case = (hung(), motion(hung()), programme(hung()))
    trim = trim_of(hung(), "harmonics = 3")
    expected, scale = trim_matrix(*case, trim)
    assert (np.abs(design_trim(*case, trim).matrix - expected) / scale).max() < MATRIX


def test_a_carrier_that_swings_for_ever_does_not_settle() -> None:
    with pytest.raises(
        UsageError,
        match=r"^trim: does not converge, errors grow by .* per window; use a `gain` below .*; nothing damps",
    ):
        design_trim(pendulum(), motion(), programme(), trim_of(pendulum(), "harmonics = 3"))


UNDAMPED = """
schema = 1
name = "hinge"
gravity = [0, 0, -9.81]
carrier = { mass = 2.0, inertia = [0.02, 0.03, 0.01] }
hold = { axis = [0, 1, 0], pivot = [0, 0, 0.12] }
[[flywheel]]
name = "w"
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 0.01
transverse_inertia = 0.006
"""


@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_an_undamped_trim_that_converges_is_told(damping: float) -> None:
    """A small swing much faster than the pendulum's own; its corrections leave less of it in each round."""
    stand = loads(UNDAMPED + f"[suspension]\nstiffness = [0, 0, 0, 0, 0.5, 0]\ndamping = [0, 0, 0, 0, {damping}, 0]\n")
    wanted, nothing = required(stand, 0.1, harmonics=[{"k": 1, "cos": [1e-3]}]), np.zeros((1, 1))
    made = design_trim(stand, wanted, programme_of(stand, wanted, Fourier(np.zeros(1), nothing, nothing), (0,)),
                       trim_of(stand, 'coordinates = ["pitch"]\nharmonics = 1'))  # fmt: skip
    assert made.undamped == (damping == 0.0) and made.radius < 1.0
    words = trim_message(made, stand)
    assert words.startswith("trim: 1 harmonic of pitch, 2 directions; ") and ("warning" in words) == made.undamped


@pytest.mark.parametrize(
    ("freedoms", "words"),
    [
        ((), "found a clamped carrier in"),
        ((FREEDOMS["roll"], FREEDOMS["pitch"], FREEDOMS["yaw"]), "found roll, pitch, yaw in"),
        ((Freedom("twist", twist=(0.0, 0.1, 0.0, 0.0, 1.0, 0.0)),), "found 1 (twist +0.1 v +1 q) in"),
        ((FREEDOMS["x"], FREEDOMS["yaw"]), "found x, yaw in"),
    ],
)
def test_what_has_no_number_a_freedom_is_refused_in_a_line(freedoms: tuple[Freedom, ...], words: str) -> None:
    stand = replace(pendulum(), hold=Hold(freedoms, (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    with pytest.raises(ServoError) as told:
        servo("[trim]\n", stand)
    text = str(told.value)
    assert text.startswith(f"hold.toml: trim: {words} [hold] of the stand file, expected freedoms that each have")
    assert text.endswith("remove [trim]") and "\n" not in text
    assert servo("trim = false\n", stand).trim is None


def test_coordinates_are_those_of_the_freedoms() -> None:
    assert servo("[trim]\n").trim is not None
    with pytest.raises(ServoError, match=r"trim\.?,? coordinates: unknown \"theta\""):
        servo('[trim]\ncoordinates = ["theta"]\n')
    case = table("plane")
    assert trim_of(case[0], 'coordinates = ["pitch", "z"]').coordinates == (0, 2)
