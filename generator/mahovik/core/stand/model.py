"""The stand as validated raw data in SI: what the stand file says, nothing derived from it.

No spatial inertia, no transfer matrix and no rotation is built here: each derivation builds its own from
these numbers, so that an error in one cannot hide in all. All classes are frozen and hashable; vectors are
tuples of floats, matrices tuples of rows. Lengths m, masses kg, angles rad, forces N.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, Self, TypeVar

Vec3 = tuple[float, float, float]
Vec6 = tuple[float, float, float, float, float, float]
Mat3 = tuple[Vec3, Vec3, Vec3]
Mat6 = tuple[Vec6, Vec6, Vec6, Vec6, Vec6, Vec6]

Sequence = Literal["ship", "aircraft", "euler"]
About = Literal["origin", "center_of_mass"]
PhaseInput = Literal["angle", "sincos"]
FreedomKind = Literal["turn", "slide", "twist"]

Component = Literal["vx", "vy", "vz", "wx", "wy", "wz"]
COMPONENTS: tuple[Component, ...] = ("vx", "vy", "vz", "wx", "wy", "wz")
"""Components that a task may demand: of the acceleration (v.) and of the angular acceleration (w.)."""

INVERSE_MOST = 1e4
"""rad/s2: default of `inverse_most`."""

WRENCH_LETTERS = ("X", "Y", "Z", "K", "M", "N")
TWIST_LETTERS = ("u", "v", "w", "p", "q", "r")


@dataclass(frozen=True)
class LawData:
    """Raw data of one law of wrenches: each folder of `laws/` has its own class."""

    @property
    def nonlinear(self) -> bool:
        """Whether a law of bodies is not linear in the body's twist."""
        return False

    @property
    def has_kinks(self) -> bool:
        """Whether its derivatives jump, as those of a law of bodies that depends on magnitudes of the twist."""
        return False

    @property
    def drives(self) -> bool:
        """Whether a law of bodies is an engine: it is there to do work on its body."""
        return False

    @property
    def takes_out_products(self) -> bool:
        """Whether a law of bodies takes the products of added mass out of the equations, as its own terms have them."""
        return False

    @property
    def inputs(self) -> dict[str, float]:
        """Numbers of a law of bodies that may be set at run time, "rudder.deflection", in the order of the table."""
        return {}

    @property
    def displaced(self) -> tuple[float, Vec3] | None:
        """Mass (kg) of the fluid that a body displaces by a law of bodies, and its centre in the body's frame."""
        return None

    @property
    def matrices(self) -> dict[str, Mat6]:
        """Matrices of a law of bodies in which the equations are linear, by name."""
        return {}

    @property
    def rows(self) -> tuple[int, ...] | None:
        """Components that its wrench on the carrier can have, in E1 about O1; None where any."""
        return None


Law = TypeVar("Law", bound=LawData)


@dataclass(frozen=True)
class WithLaws:
    """What laws of wrenches act on: the stand by those between E0 and the carrier, a body by its own. See `law`."""

    laws: tuple[LawData, ...] = field(default=(), kw_only=True)

    def law(self, kind: type[Law]) -> Law | None:
        """The data of one law; None where it does not act."""
        for found in self.laws:
            if isinstance(found, kind):
                return found
        return None

    def with_laws(self, *given: LawData) -> Self:
        """A copy with the given laws instead of its own of the same kinds."""
        kinds = {type(law): law for law in (*self.laws, *given)}
        return replace(self, laws=tuple(kinds.values()))

    def without_laws(self, *kinds: type[LawData]) -> Self:
        """A copy without some kinds of law; with no kind named, without any."""
        return replace(self, laws=tuple(law for law in self.laws if kinds and not isinstance(law, kinds)))


@dataclass(frozen=True)
class Body(WithLaws):
    """What carrier, instruments and flywheels have in common, in the body's own frame.

    `inertia` is the full symmetric tensor as the file gives it, about the point named by `inertia_about`.
    `laws`: data of the laws that act on it in its own frame, weight aside.
    `wrench_input`: the emitted C takes a run-time wrench on this body.
    """

    name: str
    mass: float
    center_of_mass: Vec3
    inertia: Mat3
    inertia_about: About
    wrench_input: bool

    @property
    def inputs(self) -> dict[str, float]:
        """Numbers of its laws that may be set at run time, by name: "rudder.deflection", rad; "screw.speed", rad/s."""
        return {name: value for law in self.laws for name, value in law.inputs.items()}

    @property
    def displaced(self) -> list[tuple[float, Vec3]]:
        """Mass (kg) and centre, in its frame, of the fluid that it displaces, by each law of its own that says so."""
        return [displaced for law in self.laws if (displaced := law.displaced) is not None]


@dataclass(frozen=True)
class Carrier(Body):
    """The carrier E1 (its `name` is "carrier"). `added_mass` about O1 in E1 axes; None where absent or zero."""

    added_mass: Mat6 | None


@dataclass(frozen=True)
class Instrument(Body):
    """A body Ep fixed on the carrier: origin Op in E1, axes C3(psi) C2(theta) C1(phi).

    `added_mass` is about O1 in E1 axes, as for the carrier.
    """

    position: Vec3
    angles: Vec3
    added_mass: Mat6 | None


@dataclass(frozen=True)
class MountingAngles:
    """Mounting of a flywheel by angles: C3(psi) C2(theta) C1(zero + phi_s)."""

    psi: float
    theta: float
    zero: float


@dataclass(frozen=True)
class MountingAxes:
    """Mounting of a flywheel by directions in the mount's frame, of any length.

    `axis`: spin axis (first axis of Es); `zero`: its part across the axis is the second axis of Es at phi_s = 0.
    """

    axis: Vec3
    zero: Vec3


@dataclass(frozen=True)
class Motor:
    """Drive of a flywheel; acts in simulation only. None: no limit, or not known."""

    torque: float | None
    speed: float | None
    constant: float | None
    resistance: float | None
    supply: float | None
    viscous: float
    coulomb: float
    coulomb_speed: float


@dataclass(frozen=True)
class Encoder:
    """Encoder of a flywheel: counts per turn (with sign), count at phi_s = 0, latency in s."""

    counts: int
    zero: float
    latency: float


@dataclass(frozen=True)
class Flywheel(Body):
    """A flywheel Es: origin Os in the frame of its mount, spinning about its own first axis.

    `inverse_weight` is its weight in the norm of phi'' that `inverse` makes least, 1 by default.
    """

    mount: str
    position: Vec3
    mounting: MountingAngles | MountingAxes
    motor: Motor | None
    encoder: Encoder | None
    inverse_weight: float = 1.0


@dataclass(frozen=True)
class Point:
    """A sensor or place of interest on the carrier or an instrument; axes C3(psi) C2(theta) C1(phi)."""

    name: str
    mount: str
    position: Vec3
    angles: Vec3


@dataclass(frozen=True)
class TaskRow:
    """One demanded component: of O1 where `of` is "" (derivative of a component of V, in E1).

    Else of the point or instrument `of`: its acceleration or angular acceleration relative to E0, in its own axes.
    """

    of: str
    component: Component


@dataclass(frozen=True)
class Task:
    """Components of the carrier's motion that are demanded together; what no row names is free."""

    name: str
    rows: tuple[TaskRow, ...]


@dataclass(frozen=True)
class Freedom:
    """One way in which a held carrier can move at speed u, in E1: `turn` about the pivot, `slide`, or a `twist` of O1.

    direction   of a turn or slide, of any length: u is in rad/s or m/s along its unit vector
    twist       of a twist: V at u = 1, as written
    """

    kind: FreedomKind
    direction: Vec3 = (0.0, 0.0, 0.0)
    twist: Vec6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Hold:
    """What holds the carrier: it moves as V = S u, a column of S (6 x m) for each freedom, constant in E1.

    freedoms          m of them, independent; none: clamped
    pivot             of E1, m: what turns, turns about it
    position, angles  home pose in E0, where all freedoms are zero: place of O1 (m) and attitude (rad)
    """

    freedoms: tuple[Freedom, ...]
    pivot: Vec3
    position: Vec3
    angles: Vec3


@dataclass(frozen=True)
class StreamProfile:
    """Velocity of the fluid by depth, beside the uniform `stream`: linear between stations, none outside of them.

    down      direction in E0, of any length, along which the depth of a position is counted from the origin of E0
    depth     m, increasing
    velocity  m/s in E0, one for each depth
    """

    down: Vec3
    depth: tuple[float, ...]
    velocity: tuple[Vec3, ...]


@dataclass(frozen=True)
class Stand(WithLaws):
    """A whole stand. `stream` is None where the file has no such key; bodies are in the file's order.

    `laws`: data of the laws between E0 and the carrier that the stand has.
    `phase_input`: "sincos" where functions of the C take sines and cosines of the phases as well.
    `inverse_most`: rad/s2, phi'' of a flywheel without motor above which an answer of `inverse` is EXCESSIVE.
    `hold`: what holds the carrier; None where it is free.
    `profile`: what the depth of O1 adds to `stream`, which is then not None; None where nothing.
    """

    name: str
    angles: Sequence
    gravity: Vec3
    stream: Vec3 | None
    carrier: Carrier
    instruments: tuple[Instrument, ...]
    flywheels: tuple[Flywheel, ...]
    points: tuple[Point, ...]
    phase_input: PhaseInput = "angle"
    tasks: tuple[Task, ...] = ()
    inverse_most: float = INVERSE_MOST
    hold: Hold | None = None
    profile: StreamProfile | None = None

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Carrier, instruments, flywheels, in this order."""
        return (self.carrier, *self.instruments, *self.flywheels)

    @property
    def has_kinks(self) -> bool:
        """Whether a law of any body, or one between E0 and the carrier, has derivatives that jump."""
        return any(law.has_kinks for bearer in (self, *self.bodies) for law in bearer.laws)

    def __repr__(self) -> str:
        parts = {"instrument": self.instruments, "flywheel": self.flywheels, "point": self.points}
        counts = ", ".join(f"{len(all_)} {noun}{'' if len(all_) == 1 else 's'}" for noun, all_ in parts.items() if all_)
        return f"<Stand {self.name}: {counts or 'a rigid body'}>"
