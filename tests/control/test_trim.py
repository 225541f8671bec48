"""Trim of free and held carriers: its model against closed formulas, periodic motion and harmonic balance."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from control.following import design, servo
from export import held_servos
from export.held_servos import ARM, FRICTION, HARMONICS, MASS, PERIOD, SPIN, WHOLE, hung, pendulum
from export.held_servos import servo as held_servo
from mahovik.core.motion.functions import Fourier
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Trim, read_servo
from mahovik.core.stand import loads
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.errors import ServoError, UsageError
from mahovik.out.export.servo import trim_message
from mahovik.use.control.trim import Orbit, TrimDesign, design_trim, nodes, required_orbit, settled_state
from mahovik.use.numeric.course import course
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import drive
from toolchain.quick import quick
from verify.programme.programmes import shaker

TERMS = 5
STEP = 1e-4


def corrected(programme: Programme, term: int, size: float) -> Programme:
    """The programme with a correction of the second flywheel: mean, cos, sin, cos 2, sin 2."""
    assert isinstance(programme.course, Fourier)
    coefficients = np.zeros((TERMS, 2))
    coefficients[term, 1] = size
    cos, sin = np.zeros((2, 2)), np.zeros((2, 2))
    cos[: len(programme.course.cos)], sin[: len(programme.course.sin)] = programme.course.cos, programme.course.sin
    mean = programme.course.mean + coefficients[0]
    return programme.with_course(Fourier(mean, cos + coefficients[1::2], sin + coefficients[2::2]))


def heave(orbit: Orbit, mechanics: Mechanics, programme: Programme, start: np.ndarray) -> np.ndarray:
    """Mean, cos, sin, cos 2, sin 2 of z in the motion that begins so, by the whole equations."""
    accelerations = drive(mechanics, *programme.at(orbit.t))
    y = course(orbit.chart, accelerations, orbit.t[1], start, orbit.y, None).y[:-1]
    z = orbit.chart.twists(y).O1[:, 2]
    a = 2 * np.pi * np.arange(len(z)) / len(z)
    waves = [np.ones(len(z)) / 2, np.cos(a), np.sin(a), np.cos(2 * a), np.sin(2 * a)]
    return np.array([2.0 / len(z) * (wave @ z) for wave in waves])


@pytest.mark.parametrize("term", quick(3, range(TERMS)))
def test_response_is_the_derivative_of_the_settled_motion(term: int) -> None:
    stand, motion, programme = shaker()
    mechanics = Mechanics.of(stand)
    count = nodes(motion, programme, 2)
    orbit = required_orbit(mechanics, motion, programme, count)
    ends = []
    for sign in (1, -1):
        other = corrected(programme, term, sign * STEP)
        ends.append(heave(orbit, mechanics, other, settled_state(mechanics, motion, other, count)))
    expected = (ends[0] - ends[1]) / (2.0 * STEP)
    measured = design().response[:, TERMS + term]
    assert np.abs(measured - expected).max() < 1e-5 * np.abs(design().response).max()


def trimmed(gain: float, settling: int, averaging: int) -> TrimDesign:
    """Design of a trim by the heave alone."""
    trim = servo(trim=True).trim
    assert trim is not None
    stand, motion, programme = shaker()
    return design_trim(stand, motion, programme, replace(trim, gain=gain, settling=settling, averaging=averaging))


def test_a_settled_trim_leaves_what_its_gain_leaves() -> None:
    """The longer the carrier settles, the nearer is the radius to 1 - gain."""
    radii = [trimmed(0.6, settling, 10).radius for settling in (10, 50, 200)]
    assert radii[0] > radii[1] > radii[2]
    assert radii[2] == pytest.approx(0.4, abs=1e-3)


def test_a_trim_that_does_not_converge_is_refused() -> None:
    with pytest.raises(UsageError, match="does not converge"):
        trimmed(1.0, 0, 1)


def test_corrections_take_the_error_away_and_leave_the_mean() -> None:
    servo = design()
    E = np.array([7.0, 1.0, -2.0, 0.5, 0.3]) * 1e-5
    left = E - servo.response @ (servo.matrix @ E) / servo.trim.gain
    assert np.abs(left[1:]).max() < 1e-12
    assert not np.any(servo.matrix[:, 0])


HEAD = 'schema = 1\nsample_period = "1 ms"\nbandwidth = "20 Hz"\n'


def required(stand: Stand, period: float, **more: object) -> RequiredMotion:
    """A required motion by its harmonics."""
    document = {"schema": 1, "name": "move", "type": "periodic", "period": period, **more}
    return read_motion(json.dumps(document), stand)


def programme_of(stand: Stand, wanted: RequiredMotion, phi: Fourier, winding: tuple[int, ...]) -> Programme:
    """A programme of these angles, with the identities of the stand."""
    return Programme.of(stand, "move", wanted.span, np.zeros_like(wanted.mean), winding, phi)


def trim_of(stand: Stand, keys: str) -> Trim:
    """A trim by its keys."""
    trim = read_servo(f"{HEAD}[trim]\n{keys}\n", stand).trim
    assert trim is not None
    return trim


def test_a_pendulum_answers_by_its_closed_formula() -> None:
    """(M g l - A w^2 + i c w) theta = J w^2 phi near the vertical; half of an error is taken back."""
    nothing = np.zeros((HARMONICS, 1))
    wanted = required(hung(), PERIOD, harmonics=[{"k": 1, "cos": [1e-6]}])
    programme_ = programme_of(hung(), wanted, Fourier(np.zeros(1), nothing, nothing), (0,))
    design = design_trim(hung(), wanted, programme_, trim_of(hung(), "harmonics = 3"))
    for k in (1, 2, 3):
        w = 2 * np.pi / PERIOD * k
        h = SPIN * w**2 / (MASS * 9.81 * ARM - WHOLE * w**2 + 1j * FRICTION * w)
        block = design.response[2 * k - 1 : 2 * k + 1, 2 * k - 1 : 2 * k + 1]
        assert block == pytest.approx(np.array([[h.real, h.imag], [-h.imag, h.real]]), rel=1e-8)
    assert design.unit == pytest.approx(np.sqrt(MASS / WHOLE))
    error = np.array([0, 1e-3, 2e-3, -1e-3, 0, 0, 5e-4])
    assert design.response @ design.matrix @ error == pytest.approx(0.5 * error, rel=1e-9, abs=1e-15)


def test_a_carrier_that_swings_for_ever_does_not_settle() -> None:
    with pytest.raises(
        UsageError,
        match=r"^trim: does not converge, errors grow by .* per window; use a `gain` below .*; nothing damps",
    ):
        design_trim(pendulum(), held_servos.motion(), held_servos.programme(), trim_of(pendulum(), "harmonics = 3"))


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
        held_servo("[trim]\n", stand)
    text = str(told.value)
    assert text.startswith(f"hold.toml: trim: {words} [hold] of the stand file, expected freedoms that each have")
    assert text.endswith("remove [trim]") and "\n" not in text
    assert held_servo("trim = false\n", stand).trim is None
