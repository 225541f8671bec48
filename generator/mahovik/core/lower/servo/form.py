"""Features that decide the text of a servo's C, and its structs. Fields that a servo does not use are omitted."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mahovik.contract.quantities import BOUNDS, short
from mahovik.core.program.types import Field, Kind, NamedCount, Struct

REAL, INT = Kind.REAL, Kind.INT

NO_LIMIT = short(BOUNDS["MAX_WRENCH"].value)
"""Torque, N m, that means no limit, in comments."""


@dataclass(frozen=True)
class TrimForm:
    """Measured coordinates by number, and the highest harmonic, 1 or more.

    They are among x, y, z, psi, theta, phi. Of a held carrier they are those of its freedoms, which `generalized` of
    the stand's C gives.
    """

    coordinates: tuple[int, ...]
    harmonics: int
    held: bool = False

    @property
    def angles(self) -> bool:
        """Are angles of a free carrier among them?"""
        return not self.held and max(self.coordinates) >= 3

    @cached_property
    def measured(self) -> NamedCount:
        """Coordinates."""
        return NamedCount("TRIM_COORDINATES", len(self.coordinates), "measured coordinates of the carrier")

    @cached_property
    def terms(self) -> NamedCount:
        """Mean, then cosine and sine of each harmonic."""
        return NamedCount("TRIM_TERMS", 2 * self.harmonics + 1, "mean, then cosine and sine of each harmonic")


@dataclass(frozen=True)
class ServoForm:
    """`count`: flywheels. `trim`: None without."""

    count: NamedCount
    trim: TrimForm | None = None

    @cached_property
    def gains(self) -> Struct:
        """Gains that the generator computes from the wanted bandwidth."""
        n = (self.count,)
        fields = (
            Field("angle", REAL, n, "N m/rad", "torque by the error of the angle"),
            Field("speed", REAL, n, "N m s/rad", "torque by the error of the speed"),
            Field("integral", REAL, n, "N m/rad", "of the angle's error, a sample; 0: none"),
            Field("back", REAL, n, "", "part of what a limit cuts off that the integral loses, a sample: 0 to 1"),
            Field("filter", REAL, (), "", "part of the speed's error taken over a sample; 1: all, no filter"),
            Field("limit", REAL, n, "N m", f"largest torque; {NO_LIMIT}: none"),
            Field("change", REAL, n, "N m", f"largest change of a torque, a sample; {NO_LIMIT}: none"),
            Field("viscous", REAL, n, "N m s/rad", "friction that is made up for"),
            Field("coulomb", REAL, n, "N m", "likewise"),
            Field("coulomb_rate", REAL, n, "s/rad", "1 / speed at which it is nearly whole; 0: none"),
            Field("lead", REAL, (), "", "part of the period by which the feedforward is taken ahead, in [0, 1)"),
        )
        return Struct("servo_gains", "Gains of the servos, each number a flywheel.", fields)

    @cached_property
    def state(self) -> Struct:
        """State of a servo."""
        n = (self.count,)
        fields = (
            Field("integral", REAL, n, "N m", "torque of the integral"),
            Field("speed", REAL, n, "rad/s", "error of the speed, filtered"),
            Field("torque", REAL, n, "N m", "what was given last"),
        )
        return Struct("servo_state", "What the servos keep from sample to sample.", fields)

    @cached_property
    def design(self) -> Struct:
        """The trim's constants."""
        trim = self._trim
        fields = (
            Field("settling", INT, (), "", "samples that the carrier has to settle"),
            Field("window", INT, (), "", "samples over which is measured: whole periods"),
            Field("smoothing", REAL, (), "", "part of a correction taken over a sample, 0 to 1"),
            Field("limit", REAL, (), "rad", "largest magnitude of a corrected coefficient"),
            Field("omega", REAL, (), "rad/s", "2 pi / period"),
            Field("inertia", REAL, (self.count,), "kg m2", "of each flywheel about its axis: torque of a correction"),
            Field("target", REAL, (trim.measured, trim.terms), "m, rad", "what the carrier is to do"),
            Field(
                "matrix", REAL, (self.unknowns, self.known), "rad/m, rad/rad",
                "correction of each coefficient, all of one flywheel together, by the errors, all of one coordinate "
                "together",
            ),
        )  # fmt: skip
        return Struct("trim_design", "How a trim measures and corrects.", fields)

    @cached_property
    def trim_state(self) -> Struct:
        """State of a trim."""
        trim = self._trim
        fields = (
            Field("sample", INT, (), "", "samples of the settling and the window that have passed"),
            Field("sum", REAL, (trim.measured, trim.terms), "m, rad", "of what is measured; then its error"),
            Field("wanted", REAL, (self.count, trim.terms), "rad", "corrections"),
            Field("present", REAL, (self.count, trim.terms), "rad", "corrections, smoothed: what is applied"),
            Field("rounds", INT, (), "", "corrections so far; stops at the largest int"),
        )
        return Struct("trim_state", "What a trim keeps from sample to sample.", fields)

    @cached_property
    def unknowns(self) -> NamedCount:
        """Rows of the trim's matrix."""
        return NamedCount(
            "TRIM_UNKNOWNS", int(self.count) * int(self._trim.terms), "corrected coefficients: N TRIM_TERMS"
        )

    @cached_property
    def known(self) -> NamedCount:
        """Columns of the trim's matrix."""
        trim = self._trim
        words = "measured coefficients: TRIM_COORDINATES TRIM_TERMS"
        return NamedCount("TRIM_MEASURED", int(trim.measured) * int(trim.terms), words)

    @property
    def _trim(self) -> TrimForm:
        assert self.trim is not None
        return self.trim
