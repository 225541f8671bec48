"""Arguments and results of functions: symbol, unit, axes, accepted range, ordinary range, how tests draw them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum

RPM = 30 / math.pi
"""1 rad/s in rpm."""


@dataclass(frozen=True)
class Bound:
    """A bound on the magnitude of an input, a named constant of the emitted C. `single`: in float, where it differs."""

    name: str
    value: float
    unit: str
    comment: str
    single: float | None = None

    def at(self, real: str) -> float:
        """The bound for an element type, "double" or "float"."""
        return self.single if real == "float" and self.single is not None else self.value


BOUNDS = {
    bound.name: bound
    for bound in (
        Bound("MAX_POSITION", 1e6, "m", "each component of the position of O1"),
        Bound("MAX_VELOCITY", 1e4, "m/s", "each component of v"),
        Bound("MAX_SPEED", 1e5, "rad/s", "each component of omega, each phi_dot"),
        Bound("MAX_PHASE", 1e7, "rad", "each phase and attitude angle", single=1e3),
        Bound("MAX_ACCELERATION", 1e9, "rad/s2", "each phi_ddot"),
        Bound("MAX_WRENCH", 1e9, "N, N m", "each component of a run-time wrench"),
        Bound("MAX_STEP", 10.0, "s", "a time step"),
        Bound("MAX_PARAMETER", 1e15, "SI", "each mass, length and moment of inertia"),
        Bound("MAX_WEIGHT", 1e6, "", "the weight of a flywheel in inverse; at least its inverse"),
        Bound("MAX_DEFLECTION", 1.5, "rad", "the deflection of a fin"),
        Bound("MAX_ROUNDING", 1.0, "SI", "each number of a carry"),
        Bound("MAX_TURN_4", 1.0, "rad", "turn in a step of order 4; beyond: COARSE"),
        Bound("MAX_TURN_2", 0.1, "rad", "turn in a step of order 2; beyond: COARSE"),
    )
}
"""Bounds by name. Phases in float: it has no digits left for large angles, wrap them first."""


class Draw(Enum):
    """How the self-test and the fuzz harness draw an input."""

    REALS = "reals in +-largest: 24 bits, exactly scaled"
    FLAGS = "integers: one in four is 1, the others 0"
    ATTITUDE = "the square of a quaternion of small integers, divided by its length: one rounding"
    TURNS = "sines, and with them cosines: the square of a complex number of small integers, by its length"
    ORDER = "2 or 4"
    STEP = "a constant"
    FACTOR = "1 + a real in +-largest"
    POWER = "largest times a power of two, up to 2^31"
    SHARE = "a real from 0 to 1"
    NEVER = "not drawn by itself"


@dataclass(frozen=True)
class Quantity:
    """A quantity by its symbol, which is its name in C, Python and `eval`.

    unit      SI; of the linear and of the angular half where they differ
    axes      the frame of its components, or what they stand beside
    count     numbers of one state: a number, "N" (flywheels), "W" (six a body with a run-time wrench), "" for a scalar
    bounds    names of BOUNDS: of all components, or of the linear and of the angular half; empty where none
    ordinary  largest ordinary magnitude, SI, for proofs by intervals
    largest_drawn largest magnitude in the self-test: a power of two, so that scaling is exact
    deviation standard deviation of random states, of all components or of both halves; 0: drawn otherwise
    draw      how the self-test draws it
    integers  least and largest ordinary integer, for proofs by intervals
    shared    whether all states of a batch have it in common; otherwise each state has its own
    input     whether a line of `eval` may contain it
    invalid   values within the bounds, or without any, that are refused nevertheless, with the status
    edges     values nearest to these: just refused, with the same status, or (False) just not
    infinite  whether infinity is a value, "no limit"
    struct    the struct type of a table of numbers of the stand, and `default`: the constant of the C that holds it
    """

    symbol: str
    unit: str
    axes: str
    count: str
    bounds: tuple[str, ...] = ()
    ordinary: float = 1.0
    largest_drawn: float = 1.0
    deviation: tuple[float, ...] = ()
    draw: Draw = Draw.REALS
    integers: tuple[int, int] = (-(1 << 20), 1 << 20)
    shared: bool = False
    input: bool = False
    invalid: tuple[tuple[float, str], ...] = ()
    edges: tuple[tuple[float, bool], ...] = ()
    infinite: bool = False
    struct: str = ""
    default: str = ""

    def limits(self, real: str) -> tuple[float, ...]:
        """Bounds of the six components, or one for all of them; empty where there are none."""
        values = tuple(BOUNDS[name].at(real) for name in self.bounds)
        return values if len(values) < 2 else tuple(value for value in values for _ in range(3))


_ANGULAR = ("MAX_ACCELERATION",)


def _bad_arguments(*values: float) -> tuple[tuple[float, str], ...]:
    """Values that are refused as BAD_ARGUMENT."""
    return tuple((value, "BAD_ARGUMENT") for value in values)


_ABOVE_ZERO, _FROM_ZERO = ((1e-30, False),), ((-1e-30, True), (0.0, False))
"""Edges of what must be above zero, of what may be zero."""


def _option(symbol: str, unit: str, least: float, *bad: float) -> Quantity:
    """A number of each flywheel that may be infinite, and that tests draw from `least` upwards."""
    return Quantity(
        symbol,
        unit,
        "flywheels",
        "N",
        largest_drawn=least,
        draw=Draw.POWER,
        invalid=_bad_arguments(*bad),
        edges=_ABOVE_ZERO if 0.0 in bad else _FROM_ZERO,
        infinite=True,
    )


def _share(symbol: str) -> Quantity:
    """A part of the largest singular value."""
    bad = _bad_arguments(-0.1, 1.5)
    edges = (*_FROM_ZERO, (1.0, False), (1.0 + 1e-6, True))
    return Quantity(symbol, "", "part of the largest singular value", "", draw=Draw.SHARE, invalid=bad, edges=edges)


QUANTITIES = {
    row.symbol: row
    for row in (
        # what a state holds
        Quantity("position", "m", "O1 in E0", "3", ("MAX_POSITION",), 100.0, 2.0, (1.0,), input=True),
        Quantity("attitude", "", "unit quaternion, w first, of x0 = C x1", "4", draw=Draw.ATTITUDE),
        Quantity("angles", "rad", "psi, theta, phi of the sequence of the stand", "3", ("MAX_PHASE",), 7.0, input=True),
        Quantity(
            "V", "m/s, rad/s", "E1, about O1", "6", ("MAX_VELOCITY", "MAX_SPEED"), 20.0, 2.0, (1.0, 2.0), input=True
        ),
        Quantity("phi", "rad", "flywheels", "N", ("MAX_PHASE",), 100.0, 16.0, input=True),
        Quantity("phi_dot", "rad/s", "flywheels", "N", ("MAX_SPEED",), 1000.0, 256.0, (100.0,), input=True),
        # what is given with a state
        Quantity("phi_ddot", "rad/s2", "flywheels", "N", _ANGULAR, 1e4, 512.0, (300.0,), input=True),
        Quantity("V_dot", "m/s2, rad/s2", "E1, about O1", "6", _ANGULAR, 1e3, 16.0, (5.0, 20.0), input=True),
        Quantity("demand", "m/s2, rad/s2", "rows of a task", "", _ANGULAR, 1e3, 16.0, (5.0,)),
        Quantity("tau", "N m", "flywheels", "N", ("MAX_WRENCH",), 100.0, 2.0, (1.0,), input=True),
        Quantity("wrench", "N, N m", "each body, about its origin", "W", ("MAX_WRENCH",), 1e3, 8.0, (5.0,), input=True),
        Quantity("sine", "", "flywheels", "N", draw=Draw.TURNS),
        Quantity("cosine", "", "flywheels", "N", draw=Draw.NEVER),
        Quantity("q", "m, rad", "freedoms of a held carrier, from its home pose", "", ("MAX_POSITION",), 3.0, 2.0),
        Quantity("orientation", "", "unit quaternion, w first, from the home pose", "4", draw=Draw.ATTITUDE),
        Quantity("q_dot", "m/s, rad/s", "O1 in E0, then psi, theta, phi", "6", ("MAX_SPEED",), 20.0, 2.0),
        Quantity("q_ddot", "m/s2, rad/s2", "O1 in E0, then psi, theta, phi", "6", _ANGULAR, 1e3, 16.0),
        # what all states of a batch share
        Quantity(
            "table",
            "",
            "numbers of the stand, prepared",
            "",
            draw=Draw.NEVER,
            shared=True,
            struct="table",
            default="default",
        ),
        Quantity(
            "mounting",
            "",
            "mountings of the flywheels, prepared",
            "",
            draw=Draw.NEVER,
            shared=True,
            struct="mount_table",
        ),
        Quantity(
            "options",
            "",
            "how inverse chooses",
            "",
            draw=Draw.NEVER,
            shared=True,
            struct="inverse_options",
            default="default_options",
        ),
        Quantity(
            "parameters",
            "",
            "what the tables are made of",
            "",
            draw=Draw.NEVER,
            shared=True,
            struct="parameters",
            default="default_parameters",
        ),
        Quantity("locked", "", "flywheels", "N", draw=Draw.FLAGS, integers=(0, 1), shared=True),
        Quantity("dt", "s", "", "", ("MAX_STEP",), draw=Draw.STEP, shared=True, invalid=_bad_arguments(0.0, -1e-3)),
        Quantity(
            "order", "", "", "", draw=Draw.ORDER, integers=(2, 4), shared=True, invalid=_bad_arguments(-2, 0, 1, 3, 5)
        ),
        # members of tables and options
        Quantity("stream", "m/s", "E0", "3", ("MAX_VELOCITY",), 10.0),
        Quantity(
            "weight",
            "",
            "flywheels",
            "N",
            ("MAX_WEIGHT",),
            largest_drawn=2.0**-10,
            draw=Draw.POWER,
            invalid=tuple((bad, "RANGE") for bad in (0.0, -1.0, 1e-7)),
            edges=((1e-6 - 1e-12, True), (1e-6 + 1e-12, False)),
        ),
        _option("limit", "rad/s2", 1.0, 0.0, -1.0),
        _option("most", "rad/s2", 1.0, 0.0, -1.0),
        _option("motor_torque", "N m", 2.0**-16, -1.0),
        _option("motor_speed", "rad/s", 2.0**-8, 0.0, -1.0),
        Quantity("motor_curve_speed", "rad/s", "flywheels", "", ("MAX_SPEED",), draw=Draw.NEVER),
        replace(_option("motor_curve_torque", "N m", 2.0**-16, -1.0), draw=Draw.NEVER),
        _option("motor_viscous", "N m s", 2.0**-30, -1.0),
        _option("motor_coulomb", "N m", 2.0**-20, -1.0),
        _option("motor_coulomb_speed", "rad/s", 2.0**-8, 0.0, -1.0),
        _option("motor_power", "W", 2.0**-16, -1.0),
        Quantity("target_speed", "rad/s", "flywheels", "N", ("MAX_SPEED",), largest_drawn=256.0),
        Quantity("target_rate", "1/s", "", "", draw=Draw.SHARE, invalid=_bad_arguments(-1.0)),
        Quantity("avoid_speed", "rad/s", "", "", draw=Draw.SHARE, invalid=_bad_arguments(-1.0)),
        _share("near_singular"),
        _share("damping"),
        *(
            Quantity(name, "kg", "a body", "", invalid=((-1.0, "RANGE"),), edges=_FROM_ZERO)
            for name in ("mass", "displaced_mass")
        ),
        # what a step keeps for the next, in a carry
        Quantity("rounding", "SI", "numbers of the state", "", ("MAX_ROUNDING",), 1e-6, 2.0**-24),
    )
}
"""Quantities by symbol. Others than these are results, or of ordinary magnitude 1 and drawn as reals."""

EXPORTED = {
    row.symbol: row
    for row in (
        Quantity("phi_ref", "rad", "flywheels", "N", ("MAX_PHASE",)),
        Quantity("phi_dot_ref", "rad/s", "flywheels", "N", ("MAX_SPEED",)),
        Quantity("tau_ff", "N m", "flywheels", "N", ("MAX_WRENCH",)),
        Quantity("integral", "N m", "flywheels", "N", ("MAX_WRENCH",)),
        Quantity("torque", "N m", "flywheels", "N", ("MAX_WRENCH",)),
        Quantity("speed", "rad/s", "flywheels", "N", invalid=((-2.01e5, "RANGE"), (2.01e5, "RANGE"))),
        Quantity(
            "phase", "", "part of the period", "", invalid=tuple((bad, "RANGE") for bad in (-1e-30, 1.000001, 7.0))
        ),
        Quantity("ticks", "", "", "", invalid=_bad_arguments(-1, 0, 1)),
        Quantity("periods", "", "", "", invalid=_bad_arguments(-1, 0)),
        Quantity("sample", "", "", "", invalid=_bad_arguments(-1)),
        Quantity("rounds", "", "", "", invalid=_bad_arguments(-1)),
    )
}
"""Arguments of functions of servos and programmes alone; the error of a speed has two speeds' bounds."""

BESIDE = {
    **dict.fromkeys(("phi_ddot", "tau", "mount_wrench", "sigma", "u_dot", "q", "residual", "Y_flywheel", "Y_drive"), 0),
    **dict.fromkeys(("I", "J", "I0", "J0"), 1),
}
"""Axes of results along which flywheels, freedoms or rows of a task stand: a rotation does not mix them."""

FLOORS = {
    "residual": "terms",
    "reaction": "terms",
    "V_dot": "motion",
    "u_dot": "motion",
    "q_ddot": "motion",
    "phi_ddot": "spin",
    "tau": "spin",
    "mount_wrench": "turning",
    "sigma": "largest",
    "K_dot": "own",
    "J0": "largest",
    "center_of_mass": "own",
}
"""Results that symmetry or cancelling terms may make zero, or nearly, and what is added to their measured scales.

terms    scale of the terms of (8); of a task, of its demand and the motion
motion   a small part of the acceleration that these terms have together, by the mass matrix
spin     a small part of phi_dot^2: a flywheel's own spin makes nothing of it, but sums of it cancel only to rounding
turning  phi_dot times the flywheel's momentum without its spin: in axes that turn with it, as in (4), it cancels
largest  the largest scale in the quantity
own      nothing: the scale is that of terms that cancel
"""

TABLES = {row.struct: row for row in QUANTITIES.values() if row.struct}
"""Arguments that hold numbers of the stand, by the name of their struct type."""

ORDINARY_STEP = (1e-6, 1e-3)
"""s: ordinary time steps, for proofs by intervals."""

DRAWN_STEP = 2.0**-14
"""s: time step of the self-test, short enough for light flywheels in strong laws of damping."""


def short(number: float) -> str:
    """A number as comments of the C show it: 1e9, 1e-6."""
    return f"{number:g}".replace("e+0", "e").replace("e-0", "e-")


UNIT_LENGTH = 1e-3
"""A quaternion, and a pair of sine and cosine, may be off unit length by so much."""

SINGULAR_BELOW = 1e-6
"""|cos theta| (Euler: |sin theta|) below which an attitude is refused as singular."""


def ordinary(symbol: str) -> float:
    """Largest ordinary magnitude of a quantity, SI; 1 for one without a row."""
    return QUANTITIES[symbol].ordinary if symbol in QUANTITIES else 1.0


def ordinary_integers(symbol: str) -> tuple[int, int]:
    """Least and largest ordinary integer of a quantity."""
    return QUANTITIES[symbol].integers if symbol in QUANTITIES else Quantity.integers


def limits_of(symbol: str, real: str = "double") -> tuple[float, ...]:
    """Accepted magnitudes: of the six components, of every component, or none."""
    return QUANTITIES[symbol].limits(real) if symbol in QUANTITIES else ()


def is_shared(symbol: str) -> bool:
    """Whether all states of a batch have an argument in common."""
    return symbol in QUANTITIES and QUANTITIES[symbol].shared
