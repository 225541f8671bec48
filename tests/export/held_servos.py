"""A pendulum that hangs, a programme of it by its closed formula, and the servos that follow."""

from __future__ import annotations

import json
from functools import cache

import numpy as np

from mahovik.core.motion.functions import Fourier
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand
from mahovik.out.export.servo import ExportedServo, export_servo

SPIN, WHOLE, ARM, MASS = 0.013, 0.04, 0.1, 1.5
"""kg m2 of the wheel about its axis and of everything about the pivot; m, kg of everything: of its mass centre."""

FRICTION = 0.02
"""N m s/rad, of the hinge that has some."""

SWAY, PERIOD, HARMONICS = 0.3, 1.0, 9

HEAD = 'schema = 1\nname = "hold"\nsample_period = "1 ms"\nlatency = "1300 us"\nbandwidth = "20 Hz"\n'


PENDULUM = f"""
schema = 1
name = "hinge"
gravity = [0, 0, -9.81]
[carrier]
mass = 1.0
center_of_mass = [0, 0, {-ARM * MASS}]
inertia = [0.03, {WHOLE - SPIN}, 0.01]
inertia_about = "origin"
[hold]
freedoms = ["pitch"]
[[flywheel]]
name = "w"
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = {MASS - 1.0}
spin_inertia = {SPIN}
transverse_inertia = 0.007
"""
"""A body on a hinge along y of E1 through O1, with a balanced wheel on the same axis, and its weight below."""


@cache
def pendulum() -> Stand:
    """The stand of PENDULUM."""
    return loads(PENDULUM)


@cache
def hung() -> Stand:
    """The pendulum with viscous friction of the hinge, so that it settles."""
    friction = f"[[hold.friction]]\nviscous = {FRICTION}\n"
    return loads(PENDULUM.replace("[[flywheel]]", friction + "[[flywheel]]"))


@cache
def motion(stand: Stand | None = None) -> RequiredMotion:
    """theta = SWAY cos(2 pi t / PERIOD)."""
    document = {"schema": 1, "name": "sway", "type": "periodic", "period": PERIOD, "winding": "rock"}
    return read_motion(
        json.dumps({**document, "harmonics": [{"k": 1, "cos": [SWAY]}]}), stand or pendulum(), "sway.json"
    )


@cache
def programme(stand: Stand | None = None) -> Programme:
    """WHOLE theta'' + c theta' + SPIN phi'' = -MASS g ARM sin theta, integrated twice harmonic by harmonic."""
    omega = 2 * np.pi / PERIOD
    theta = SWAY * np.cos(2 * np.pi * np.arange(64) / 64)
    phi_ddot = (WHOLE * omega**2 * theta - MASS * 9.81 * ARM * np.sin(theta)) / SPIN
    k = np.arange(1, HARMONICS + 1)
    cos = -2 * np.fft.rfft(phi_ddot).real[k] / 64 / (k * omega) ** 2
    held = stand or pendulum()
    sin = np.zeros((HARMONICS, 1))
    sin[0] = -(FRICTION if held == hung() else 0.0) * SWAY / (omega * SPIN)
    course = Fourier(np.zeros(1), cos[:, None], sin)
    return Programme.of(held, "sway", PERIOD, np.zeros(1), (0,), course)


def servo(text: str = "", stand: Stand | None = None) -> Servo:
    """Servo at 1 kHz, with a delay of more than a sample."""
    return read_servo(HEAD + text, stand or pendulum(), "hold.toml")


@cache
def exported(real: str = "double") -> ExportedServo:
    """Servos that follow the programme, with its torques."""
    return export_servo(pendulum(), programme(), motion(), servo('integral = "2 Hz"\n'), real)
