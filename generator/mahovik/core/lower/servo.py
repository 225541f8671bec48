"""Servos on the rotors and the slow trim of a programme: what `core/emit/servo.py` prints.

One sample of the servos. With e, e' the errors of angle and speed (e within half a turn), f the filtered e', z the
integral: f += filter (e' - f), u = tau_ff + friction + angle e + speed f + z; tau is u inside limit and change;
z += integral e + back (tau - u), inside the limit: what a limit cuts off is taken from the integral (back-calculation,
Astrom and Hagglund, PID Controllers, 1995, section 3.5), so that it does not wind up.

The trim is an adaptive harmonic correction by measured motion of the carrier. A round is `settling` samples of waiting,
`window` samples over which the carrier's coordinates are multiplied with 1, cos k theta, sin k theta (synchronous
detection, theta = 2 pi phase), and one sample a flywheel in which its corrections lose matrix times error. So no sample
costs much more than another. Corrections are Fourier coefficients of each flywheel's angle; what is applied follows
them smoothly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mahovik.contract.quantities import BOUNDS, short
from mahovik.core import routines
from mahovik.core.lower import checks, coordinates
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import unit_square
from mahovik.core.lower.programme import MOST, check_phase, first_turn
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Program
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    OK,
    RANGE,
    Ints,
    Reals,
    argument,
    changed,
    inline,
    reals,
    result,
)
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.program.validate import validate
from mahovik.core.program.vector import dot

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


LIMITED = Status("LIMITED")

REACHED = 3.0
"""Ratio speed / coulomb_speed from which dry friction is whole."""

THETA = 4
"""Number of theta among the coordinates; its formula alone has a square root."""

ANGLES: dict[str, Any] = {
    "ship": ((3, 0), (-6, (0, 3)), (7, 8)),
    "aircraft": ((-6, 0), (3, (0, 6)), (-5, 4)),
    "euler": ((2, -5), ((6, 7), 8), (6, 7)),
}
"""Sine and cosine of psi, theta, phi, times the same number: a place in C, negative where that is negated, or two."""


def lower_servo(layout: Layout, form: ServoForm) -> Program:
    """Functions `servo_reset`, `servo_step`, and with a trim `trim_reset`, `trim_step`, `trim_coordinates`.

    A held carrier has its coordinates from `generalized` of the stand's C instead of `trim_coordinates`. They are the
    same for every stand with this number of flywheels.
    """
    lib, precision, trim = Library(layout), layout.precision, form.trim
    if trim is not None:
        lib.add(routines.sincos(precision))
    if trim is not None and trim.angles:
        if THETA in trim.coordinates:
            lib.add(routines.square_root(precision))
        lib.add(routines.atan2(precision))
        lib.add(coordinates.rotation())
    lib.add(routines.unwind(precision))
    lib.add(routines.wrap(precision, lib["unwound"]))
    lib.add(checks.within(lib))
    add_servo(lib, form)
    structs: tuple[Struct, ...] = (form.gains, form.state)
    counts: tuple[NamedCount, ...] = (layout.count,)
    if trim is not None:
        add_measure(lib, form, trim)
        add_trim(lib, form, trim)
        if not trim.held:
            add_coordinates(lib, trim)
        structs += (form.design, form.trim_state)
        counts += (trim.measured, trim.terms, form.unknowns, form.known)
    program = Program(layout.structure.name, precision, counts, structs, lib.functions)
    validate(program)
    return program


def add_servo(lib: Library, form: ServoForm) -> None:
    """Adds `servo_reset` and `servo_step`, and what they call."""
    n = form.count
    bad = "not 0: no good reading of this flywheel, whose phi and phi_dot are not looked at; null: all are good"

    @lib.kernel()
    def clamped(value: float = argument(), low: float = argument(), high: float = argument()) -> float:
        """The value inside low..high."""
        return low if value < low else high if value > high else value

    @lib.kernel()
    def dry(x: float = argument("speed / coulomb_speed")) -> float:
        """Share of the dry friction: tanh(x) to 0.024, by y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3."""
        y = clamped(x, -REACHED, REACHED)
        return y * (27 + y * y) / (27 + 9 * y * y)

    @lib.kernel(statuses=("OK",), public=True)
    def servo_reset(state: Any = result("nothing kept, no torque", struct=form.state)) -> Status:
        """Servos at rest: before the first sample, and whenever the drives were off."""
        for s in range(n):
            state.integral[s] = 0
            state.speed[s] = 0
            state.torque[s] = 0
        return OK

    @lib.kernel(
        statuses=("OK", "LIMITED", "NOT_FINITE", "RANGE"),
        notes=(
            "tau = tau_ff + friction + angle e + speed f + z, inside limit and change; e the error of the angle, "
            "within half a turn, f that of the speed, filtered, z the integral, which loses what the limits cut off. "
            "LIMITED: a torque was cut.",
            "A flywheel without a good reading continues with tau_ff, friction and z, as if its errors were zero; "
            "the others do not change.",
        ),
        public=True,
    )
    def servo_step(
        gains: Any = argument("as the generator made them", struct=form.gains),
        state: Any = changed("what servo_reset made", struct=form.state),
        phi_ref: Reals = argument("wanted angles", n, unit="rad"),
        phi_dot_ref: Reals = argument("wanted speeds", n, unit="rad/s"),
        tau_ff: Reals = argument("drive torques of the programme, or zero", n, unit="N m"),
        phi: Reals = argument("measured angles", n, unit="rad"),
        phi_dot: Reals = argument("measured speeds", n, unit="rad/s"),
        invalid: Ints = argument(bad, n, optional="zeros"),
        tau: Reals = result("what the motors are to give", n, unit="N m"),
    ) -> Status:
        """One sample of the servos of all flywheels."""
        angle = reals(n)  # measured; wanted where nothing good was
        speed = reals(n)  # likewise
        for s in range(n):
            good = invalid[s] == 0
            angle[s] = phi[s] if good else phi_ref[s]
            speed[s] = phi_dot[s] if good else phi_dot_ref[s]
        for values, most in (
            (phi_ref, "MAX_PHASE"),
            (phi_dot_ref, "MAX_SPEED"),
            (tau_ff, "MAX_WRENCH"),
            (angle, "MAX_PHASE"),
            (speed, "MAX_SPEED"),
            (state.integral, "MAX_WRENCH"),
            (state.torque, "MAX_WRENCH"),
        ):
            lib["within"](values, n, lib.limit(most))
        lib["within"](state.speed, n, 2 * lib.limit("MAX_SPEED"))
        cut: int = 0  # was any torque limited?
        for s in range(n):
            e = lib["wrapped"](phi_ref[s] - angle[s])
            slip = phi_dot_ref[s] - speed[s]
            state.speed[s] += gains.filter * (slip - state.speed[s])
            # Friction that the reference meets: no noise of the sensor comes into it.
            friction = gains.viscous[s] * phi_dot_ref[s] + gains.coulomb[s] * dry(
                gains.coulomb_rate[s] * phi_dot_ref[s]
            )
            u = tau_ff[s] + friction + gains.angle[s] * e + gains.speed[s] * state.speed[s] + state.integral[s]
            inside = clamped(u, -gains.limit[s], gains.limit[s])
            given = clamped(inside, state.torque[s] - gains.change[s], state.torque[s] + gains.change[s])
            cut = 1 if given < u or given > u else cut
            # The integral loses what the limits cut off.
            z = state.integral[s] + gains.integral[s] * e + gains.back[s] * (given - u)
            state.integral[s] = clamped(z, -gains.limit[s], gains.limit[s])
            state.torque[s] = given
            tau[s] = given
        if cut != 0:
            return LIMITED
        return OK


def add_measure(lib: Library, form: ServoForm, trim: TrimForm) -> None:
    """Adds what `trim_step` does in turn: basis, measuring, correcting one flywheel."""
    design: Any = argument(struct=form.design)
    terms: Any = trim.terms

    @lib.kernel()
    def trim_basis(
        phase: float = argument("in [0, 1)"),
        basis: Reals = result("1, cos theta, sin theta, cos 2 theta ...", trim.terms),
    ) -> None:
        """1, then cosine and sine of each harmonic of theta = 2 pi phase, by the sum of angles."""
        sine = reals()
        cosine = reals()
        first_turn(lib, phase, sine, cosine)
        basis[0] = 1
        basis[1] = cosine
        basis[2] = sine
        if trim.harmonics > 1:
            for k in range(1, trim.harmonics):
                places = (k + k - 1, k + k + 1)  # of the cosines of k and of k + 1
                basis[places[1]] = basis[places[0]] * cosine - basis[places[0] + 1] * sine
                basis[places[1] + 1] = basis[places[0] + 1] * cosine + basis[places[0]] * sine

    @lib.kernel()
    def trim_measure(
        design: Any = design,
        sample: int = argument(),
        basis: Reals = argument("", trim.terms),
        q: Reals = argument("", trim.measured),
        sum_: Reals = changed("", trim.measured, trim.terms),
    ) -> None:
        """Inside the window: what one sample adds; at its last sample the error."""
        if sample >= design.settling and sample < design.settling + design.window:
            for c in range(trim.measured):
                for i in range(trim.terms):
                    sum_[c][i] = (0 if sample == design.settling else sum_[c][i]) + q[c] * basis[i]
            if sample == design.settling + design.window - 1:  # what was measured, less what is wanted
                scale = 1 / float(design.window)
                for c in range(trim.measured):
                    for i in range(trim.terms):
                        mean = sum_[c][i] * scale
                        sum_[c][i] = (mean if i == 0 else 2 * mean) - design.target[c][i]

    @lib.kernel(statuses=("OK", "LIMITED"))
    def trim_correct(design: Any = design, s: int = argument(), state: Any = changed(struct=form.trim_state)) -> Status:
        """The corrections of one flywheel less matrix times error, inside the limit."""
        error, wanted = state.member("sum"), state.wanted[s]
        cut: int = 0
        for j in range(trim.terms):
            row = s * terms + j
            found: float = wanted[j]
            for c in range(trim.measured):
                for i in range(trim.terms):
                    found = found - design.matrix[row][c * terms + i] * error[c][i]
            inside = lib["clamped"](found, -design.limit, design.limit)
            cut = 1 if inside < found or inside > found else cut
            wanted[j] = inside
        if cut != 0:
            return LIMITED
        return OK


def add_trim(lib: Library, form: ServoForm, trim: TrimForm) -> None:
    """Adds `trim_reset` and `trim_step`."""
    n = form.count
    measured: Any = argument(
        "measured coordinates of the carrier" + (": `q` of generalized" if trim.held else ""),
        trim.measured,
        unit="m, rad",
    )

    @lib.kernel(statuses=("OK",), public=True)
    def trim_reset(state: Any = result("nothing measured, nothing corrected", struct=form.trim_state)) -> Status:
        """A trim without corrections."""
        state.sample = 0
        state.rounds = 0
        for c in range(trim.measured):
            for i in range(trim.terms):
                state.member("sum")[c][i] = 0
        for s in range(n):
            for i in range(trim.terms):
                state.wanted[s][i] = 0
                state.present[s][i] = 0
        return OK

    @lib.kernel(
        statuses=("OK", "LIMITED", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"),
        notes=(
            "A round: the carrier settles, its coordinates are measured over whole periods, their harmonics compared "
            "with the target, and the angles corrected through the constant matrix, one flywheel a sample. LIMITED: a "
            "correction reached its limit.",
        ),
        public=True,
    )
    def trim_step(
        design: Any = argument("as the generator made it", struct=form.design),
        state: Any = changed("what trim_reset made", struct=form.trim_state),
        phase: float = argument("of the programme's clock at this sample, in [0, 1)"),
        q: Reals = measured,
        phi: Reals = changed("wanted angles of the programme; corrected", n, unit="rad"),
        phi_dot: Reals = changed("wanted speeds; corrected", n, unit="rad/s"),
        tau: Reals = changed("feedforward; corrected", n, unit="N m"),
    ) -> Status:
        """One sample of the trim: measures the carrier, and corrects what the programme wants."""
        check_phase(lib, phase, True)
        lib["within"](q, trim.measured, lib.limit("MAX_POSITION"))
        for values, most in ((phi, "MAX_PHASE"), (phi_dot, "MAX_SPEED"), (tau, "MAX_WRENCH")):
            lib["within"](values, n, lib.limit(most))
        end = design.settling + design.window
        if not ((state.sample >= 0 and state.rounds >= 0) and state.sample < end + n):
            return BAD_ARGUMENT
        basis = reals(trim.terms)
        lib["trim_basis"](phase, basis)
        lib["trim_measure"](design, state.sample, basis, q, state.member("sum"))
        outcome: Status = OK
        if state.sample >= end:  # one flywheel a sample
            s = state.sample - end
            outcome = lib["trim_correct"](design, s, state)
        state.sample = state.sample + 1
        if not (state.sample < end + n):  # the next round
            state.sample = 0
            state.rounds = state.rounds + (1 if state.rounds < MOST else 0)
        for s in range(n):
            correct(trim, design, state.wanted[s], state.present[s], basis, s, phi, phi_dot, tau)
        return outcome


@inline
def correct(
    trim: TrimForm, design: Any, wanted: Reals, present: Reals, basis: Reals, s: int,
    phi: Reals, phi_dot: Reals, tau: Reals,
) -> None:  # fmt: skip
    """Adds the corrections of one flywheel to its angle, speed and torque."""
    for i in range(trim.terms):
        present[i] += design.smoothing * (wanted[i] - present[i])
    angle: float = present[0]
    rate: float = 0
    bend: float = 0
    for k in range(1, trim.harmonics + 1):
        at = k + k - 1
        turn = float(k) * design.omega
        cosine, sine = basis[at], basis[at + 1]
        value = present[at] * cosine + present[at + 1] * sine
        angle += value
        rate += turn * (present[at + 1] * cosine - present[at] * sine)
        bend = bend - turn * turn * value
    phi[s] += angle
    phi_dot[s] += rate
    tau[s] += design.inertia[s] * bend


def add_coordinates(lib: Library, trim: TrimForm) -> None:
    """Adds `trim_coordinates`: those measured of O1 in E0 and the angles of the stand's sequence."""
    sequence = ANGLES[lib.layout.structure.angles]

    @lib.kernel(
        notes=("At a singular attitude theta alone is right: psi and phi are what rounding leaves of them.",),
        public=True,
    )
    def trim_coordinates(
        position: Reals = argument("position of O1, in E0", 3, unit="m"),
        attitude: Reals = argument("unit quaternion, w first, to 1e-3", 4),
        q: Reals = result("measured coordinates of the carrier", trim.measured, unit="m, rad"),
    ) -> Status:
        """Coordinates of the carrier that the trim takes, from its pose."""
        lib["within"](position, 3, lib.limit("MAX_POSITION"))
        lib["within"](attitude, 4, 2)
        norm2 = dot(attitude, attitude)
        if not unit_square(norm2):
            return RANGE
        C = None
        if trim.angles:
            C = reals(9)  # row by row
            lib["rotation"](attitude, C)
        for i, number in enumerate(trim.coordinates):
            q[i] = position[number] if number < 3 else angle_of(lib, C, sequence[number - 3])
        return OK


def angle_of(lib: Library, C: Any, places: Any) -> Any:
    """An angle of a sequence by the elements of C that are products of two of their sines and cosines."""

    def part(place: Any) -> Any:
        if isinstance(place, int):
            return -C[-place] if place < 0 else C[place]
        i, j = place
        return lib["sqrt"](C[i] * C[i] + C[j] * C[j])

    return lib["atan2"](*map(part, places))
