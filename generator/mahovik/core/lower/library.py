"""The functions of a program while it is being built: each after those it calls."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.layout import Layout
from mahovik.core.program.call import Argument
from mahovik.core.program.types import Kind


class Library(FunctionSet):
    """The functions of a stand's program, with the arguments that they share."""

    layout: Layout

    @property
    def sine(self) -> Any:
        """Sines of the phases, as internal functions take them; none without flywheels."""
        return self._of_flywheels("sine", "", "sines of the phases")

    @property
    def cosine(self) -> Any:
        """Cosines of the phases, likewise."""
        return self._of_flywheels("cosine", "", "cosines")

    @property
    def phi_ddot(self) -> Any:
        """Accelerations of the flywheels, where there are any."""
        return self._of_flywheels("phi_ddot", "rad/s2", "flywheel accelerations")

    def _of_flywheels(self, name: str, unit: str, purpose: str) -> Argument | None:
        """One number a flywheel, where there are any."""
        count = self.layout.count
        return Argument(name, Kind.REAL, (count,), unit=unit, purpose=purpose) if self.layout.flywheels else None

    @property
    def wrench(self) -> Any:
        """Run-time wrenches, flat: six numbers a body; where the stand asks for them."""
        if not self.layout.inputs:
            return None
        names = ", ".join(self.layout.inputs)
        purpose = f"run-time wrenches, six numbers a body ({names}), in its own frame about its origin"
        return Argument("wrench", Kind.REAL, (6 * len(self.layout.inputs),), unit="N, N m", purpose=purpose)

    @property
    def flywheel_wrench(self) -> Any:
        """Run-time wrenches where a flywheel takes one, for functions on which no other body's has an effect."""
        if not self.layout.flywheel_input:
            return None
        return replace(self.wrench, purpose=self.wrench.purpose + "; those of flywheels alone act")

    @property
    def u_dot(self) -> Any:
        """Rates of the freedoms, which `forward` and `coupled` of a held carrier with freedoms give besides."""
        m = self.layout.freedoms
        return Argument("u_dot", Kind.REAL, (m,), "out", "SI", "rates of the freedoms") if m else None

    @property
    def sums(self) -> Argument:
        """Sums over all bodies."""
        return Argument("sum", self.layout.sums)

    def turn_arguments(self) -> tuple[Argument, ...]:
        """Sines and cosines of the phases from encoders, or none: `phase_input = "sincos"`."""
        if not self.layout.sine_input:
            return ()
        sines = "sines of the phases; null: sines and cosines of the phases of x"
        cosines = "cosines of the phases, or null; each (sine, cosine) within 1e-3 of unit length"
        return tuple(
            Argument(name, Kind.REAL, (self.layout.count,), purpose=purpose, optional="missing")
            for name, purpose in (("sine", sines), ("cosine", cosines))
        )

    def locked_argument(self) -> Argument:
        """Argument: flywheels that a lock holds."""
        purpose = "not 0: a lock holds phi_ddot = 0, whatever its tau; null: no lock"
        return Argument("locked", Kind.INT, (self.layout.count,), purpose=purpose, optional="zeros")
