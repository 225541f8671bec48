"""A regime: for each flywheel one law, for some bodies a wrench; and what both give at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np

from mahovik.core.motion.laws import Array, Constant, Law, Motion, RunUp, Torque, TorqueTable, WrenchTable
from mahovik.core.motion.motor import drive, steepness
from mahovik.core.stand.model import Motor, Vec6


@dataclass(frozen=True)
class FlywheelRegime:
    """One flywheel of a regime. `phase`, `speed`: at t = 0; None where the start decides."""

    name: str
    law: Law
    phase: float | None = None
    speed: float | None = None

    @property
    def by_torque(self) -> bool:
        """Is its torque given, and not its speed?"""
        return isinstance(self.law, Torque | RunUp | TorqueTable)


@dataclass(frozen=True)
class Regime:
    """Laws of all flywheels in the stand's order, and wrenches by body."""

    name: str
    flywheels: tuple[FlywheelRegime, ...]
    wrenches: Mapping[str, WrenchTable]

    @cached_property
    def by_torque(self) -> bool:
        """Is any flywheel driven by torque?"""
        return any(each.by_torque for each in self.flywheels)

    @cached_property
    def has_speed_law(self) -> tuple[bool, ...]:
        """Flywheels whose speed is given."""
        return tuple(not each.by_torque for each in self.flywheels)

    @cached_property
    def mixes_speed_and_torque(self) -> bool:
        """Does a given speed vary beside flywheels that are driven by torque?"""
        varying = any(not (each.by_torque or isinstance(each.law, Constant)) for each in self.flywheels)
        return varying and self.by_torque

    def motion(self, t: Array) -> Motion:
        """phi from t = 0, phi', phi'' of all flywheels (times x N); of one driven by torque: zero."""
        found = np.zeros((3, len(t), len(self.flywheels)))
        for s, each in enumerate(self.flywheels):
            if not isinstance(each.law, Torque | RunUp | TorqueTable):
                found[:, :, s] = each.law.motion(t)
        return found[0], found[1], found[2]

    def torques(self, t: float, speeds: Array, motors: tuple[Motor | None, ...]) -> list[float]:
        """Drive torques (N, N m) that the motors give at a time and speeds; zero where the speed is given."""
        found = [0.0] * len(self.flywheels)
        for s, each in enumerate(self.flywheels):
            if isinstance(each.law, Torque | RunUp | TorqueTable):
                speed = float(speeds[s])
                found[s] = drive(motors[s], each.law.command(t, speed), speed)
        return found

    def steepness(self, low: Array, high: Array, motors: tuple[Motor | None, ...]) -> Array:
        """Largest change of each drive torque by its speed, between two speeds (rad/s), N m s; zero of given speeds."""
        found = np.zeros(len(self.flywheels))
        for s, each in enumerate(self.flywheels):
            if isinstance(each.law, Torque | RunUp | TorqueTable):
                ends = float(low[s]), float(high[s])
                found[s] = steepness(motors[s], each.law.steepness(*ends), *ends)
        return found

    def wrench(self, t: float) -> dict[str, Vec6]:
        """Run-time wrenches by body at a time."""
        return {body: cast(Vec6, table.at(t)) for body, table in self.wrenches.items()}

    def breaks(self, until: float) -> list[float]:
        """Times inside (0, until) at which some law is not smooth, ascending."""
        laws = [each.law.breaks for each in self.flywheels] + [w.breaks for w in self.wrenches.values()]
        return sorted({t for times in laws for t in times if 0.0 < t < until})
