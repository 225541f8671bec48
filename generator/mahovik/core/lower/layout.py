"""The structs of a stand's program, and the features of its structure that decide them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.contract.quantities import BOUNDS, short
from mahovik.core.lower import stream
from mahovik.core.lower.freedoms import are_closed, coordinates_struct, momenta_needed, place_of
from mahovik.core.lower.law import BodyProgram, CarrierProgram, RunTimeInput
from mahovik.core.program.types import Field, Kind, NamedCount, Precision, Struct
from mahovik.core.stand.model import Structure, Task

REAL, INT = Kind.REAL, Kind.INT
WEIGHT = BOUNDS["MAX_WEIGHT"].value

OF_HOLD = frozenset(("S", "pivot", "sliding", "home_position", "home_attitude"))
"""Members of the table that are numbers of a hold: they belong together, none is changed alone."""


@dataclass(frozen=True)
class LocalWrenchBody:
    """An instrument or flywheel with a wrench in its own frame.

    `index` in the stand's bodies; `instrument`, `flywheel` its number among those, `input` its row of the run-time
    wrenches; -1 where it is or has none.
    """

    index: int
    instrument: int
    flywheel: int
    input: int


@dataclass(frozen=True)
class Layout:
    """What stands of one structure have at one precision, and the structs of their program, by no number of a stand.

    Features of the structure; the structs that a caller fills or keeps: state, parameters, the prepared table with its
    laws; sums and other scratch; results. Fields that the stand does not use are omitted.
    """

    structure: Structure
    precision: Precision

    @cached_property
    def count(self) -> NamedCount:
        return NamedCount("N", len(self.structure.flywheels), "flywheels, in the order of the stand file")

    @property
    def flywheels(self) -> bool:
        return bool(self.structure.flywheels)

    @property
    def held(self) -> bool:
        """The carrier is held."""
        return self.structure.hold is not None

    @property
    def freedoms(self) -> int:
        """Freedoms of a held carrier; 0 of a clamped one, and of a free one."""
        return len(self.ways)

    @property
    def ways(self) -> tuple[str, ...]:
        """Freedoms of a held carrier, by their names in FREEDOMS or as turn, slide, twist."""
        return self.structure.hold or ()

    @property
    def along(self) -> bool:
        """The flywheels' terms are added up along the freedoms: few, closed, and (8) is of V = S u.

        Of more than three freedoms the projected sums are more numbers than those of six rows.
        """
        few = 0 < self.freedoms <= 3 and bool(self.flywheels)
        return few and not self.drifts and are_closed(self.ways)

    @property
    def coordinates(self) -> bool:
        """Poses of the held carrier have coordinates of its freedoms."""
        return bool(self.freedoms) and are_closed(self.ways)

    @property
    def instruments(self) -> int:
        return len(self.structure.instruments)

    @property
    def added_mass(self) -> bool:
        return self.structure.added_mass

    @property
    def weight(self) -> bool:
        return self.structure.weight

    @property
    def stream(self) -> bool:
        return self.structure.stream

    @property
    def drifts(self) -> bool:
        """(8) is of V_r, the twist relative to the stream; of rigid bodies alone it is of V, which keeps its digits."""
        return self.stream and self.added_mass

    @property
    def twist(self) -> str:
        """The twist in (8)."""
        return "V_r" if self.drifts else "V"

    @cached_property
    def law_tables(self) -> tuple[CarrierProgram, ...]:
        """The laws of `laws/` that the stand has."""
        return tuple(law for law in parts("program", CarrierProgram) if law.present(self.structure))

    @property
    def body_laws(self) -> tuple[str, ...]:
        """The laws of bodies that the stand has, in words."""
        first = [("weight", self.weight), ("buoyancy", self.displaces)]
        rest = [(law.words, bool(law.bodies(self.structure))) for law in parts("program", BodyProgram, BODY_LAWS)]
        return tuple(words for words, acts in (*first, *rest) if acts)

    @cached_property
    def displaces(self) -> bool:
        """Any displaced mass under gravity."""
        return self.structure.law("buoyancy") or self.flywheel_displaces

    @cached_property
    def flywheel_displaces(self) -> bool:
        """A flywheel does."""
        return bool(self.structure.law("flywheel_buoyancy"))

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies with a run-time wrench, in the order of the stand."""
        return tuple(self.structure.bodies[i] for i in self.structure.wrench_inputs)

    @property
    def flywheel_input(self) -> bool:
        return any(o.flywheel >= 0 and o.input >= 0 for o in self.local_bodies)

    @property
    def sine_input(self) -> bool:
        """Some functions take sines and cosines of the phases."""
        return self.flywheels and self.structure.phase_input == "sincos"

    @property
    def input_count(self) -> NamedCount:
        return NamedCount("WRENCHES", len(self.inputs), "bodies with a run-time wrench")

    @cached_property
    def local_bodies(self) -> tuple[LocalWrenchBody, ...]:
        """Instruments and flywheels that need their own frame at run time: damping or a run-time wrench."""
        inputs = self.structure.wrench_inputs
        indices = sorted({*self._damped_bodies, *inputs} - {0})
        fixed = 1 + self.instruments
        return tuple(
            LocalWrenchBody(i, i - 1 if i < fixed else -1, i - fixed if i >= fixed else -1, _position(i, inputs))
            for i in indices
        )

    @cached_property
    def _damped_bodies(self) -> frozenset[int]:
        """Indices of the bodies on which any damping acts."""
        return frozenset(i for law in parts("program", BodyProgram, BODY_LAWS) for i in law.bodies(self.structure))

    @property
    def damped(self) -> bool:
        return bool(self._damped_bodies)

    @property
    def carrier_damped(self) -> bool:
        return 0 in self._damped_bodies

    @property
    def local_damped(self) -> bool:
        return any(i > 0 for i in self._damped_bodies)

    @property
    def local_inputs(self) -> bool:
        return any(o.input >= 0 for o in self.local_bodies)

    @property
    def local_turning(self) -> bool:
        return any(o.flywheel >= 0 for o in self.local_bodies)

    @property
    def local_fixed(self) -> bool:
        return any(o.instrument >= 0 for o in self.local_bodies)

    @property
    def attitude_needed(self) -> bool:
        """The equations depend on the attitude."""
        return self.weight or self.stream or bool(self.law_tables)

    @property
    def wrenches(self) -> bool:
        """Any external wrench at all."""
        return self.weight or self.damped or bool(self.inputs) or bool(self.law_tables)

    @property
    def sensors(self) -> tuple[str, ...]:
        """Instruments and points, which `points` reads."""
        return (*self.structure.instruments, *self.structure.points)

    @property
    def sensor_count(self) -> NamedCount:
        return NamedCount("SENSORS", len(self.sensors), "instruments and points: those of the function points")

    # -- what a caller fills or keeps

    @cached_property
    def state(self) -> Struct:
        fields = [
            Field("position", REAL, (3,), "m", "position of O1, in E0"),
            Field("attitude", REAL, (4,), "", "unit quaternion, w first: x0 = C x1"),
            Field(
                "V",
                REAL,
                (6,),
                "m/s, rad/s",
                "twist of the carrier relative to E0, in E1" + (", V = S u of its freedoms" if self.held else ""),
            ),
        ]
        if self.flywheels:
            fields += [
                Field("phi", REAL, (self.count,), "rad", "phases"),
                Field("phi_dot", REAL, (self.count,), "rad/s", "speeds relative to the mount"),
            ]
        return Struct("state", "State of the whole system.", tuple(fields))

    @cached_property
    def carry(self) -> Struct:
        numbers = sum(int(f.shape[0]) for f in self.state.fields)
        field = Field("rounding", REAL, (numbers,), "SI", "of each number of the state, in its order")
        return Struct(
            "step_carry", "What rounding took from a state: kept from step to step, all zero at first.", (field,)
        )

    def _body(self, name: str, purpose: str, buoyant: bool) -> Struct:
        fields = [
            Field("mass", REAL, (), "kg", ""),
            Field("center_of_mass", REAL, (3,), "m", "rc, from the body's origin, in its own axes"),
            Field("inertia", REAL, (6,), "kg m2", "J11, J22, J33, J12, J13, J23 about the body's origin"),
        ]
        if buoyant:
            fields += [
                Field("displaced_mass", REAL, (), "kg", "mass of the displaced fluid"),
                Field("displaced_center", REAL, (3,), "m", "centre of buoyancy, in the body's frame"),
            ]
        return Struct(name, purpose, tuple(fields))

    @cached_property
    def body(self) -> Struct:
        """Carrier and instruments."""
        return self._body("body", "Mass properties of one body, in its own frame.", self.displaces)

    @cached_property
    def flywheel_body(self) -> Struct:
        """Flywheels: the same struct, unless only fixed bodies displace fluid."""
        if self.displaces == self.flywheel_displaces:
            return self.body
        return self._body("dry_body", "Mass properties of a flywheel, in its own frame.", False)

    @cached_property
    def instrument_parameters(self) -> Struct:
        fields = (
            Field("body", self.body),
            Field("position", REAL, (3,), "m", "Op, in E1"),
            Field("axis", REAL, (3,), "", "first axis of Ep in E1, any length"),
            Field("zero", REAL, (3,), "", "its component perpendicular to the first axis is the second axis of Ep"),
        )
        return Struct("instrument", "An instrument fixed on the carrier.", fields)

    @cached_property
    def flywheel_parameters(self) -> Struct:
        fields = [
            Field("body", self.flywheel_body),
            Field("position", REAL, (3,), "m", "Os, in the frame of the mount"),
            Field("axis", REAL, (3,), "", "spin axis in the frame of the mount, any length"),
            Field(
                "zero", REAL, (3,), "", "its component perpendicular to the axis is the second axis of Es at phi = 0"
            ),
        ]
        if self.instruments:
            fields.append(Field("mount", INT, (), "", "index of the instrument it is mounted on; -1: the carrier"))
        return Struct("flywheel", "A flywheel and how it is mounted.", tuple(fields))

    @cached_property
    def point_parameters(self) -> Struct:
        fields = [
            Field("position", REAL, (3,), "m", "in the frame of the mount"),
            Field("axis", REAL, (3,), "", "first axis in the frame of the mount, any length"),
            Field("zero", REAL, (3,), "", "its component perpendicular to the first axis is the second axis"),
        ]
        if self.instruments:
            fields.append(Field("mount", INT, (), "", "index of the instrument it is mounted on; -1: the carrier"))
        return Struct("point", "A sensor or a place of interest.", tuple(fields))

    @cached_property
    def sensor(self) -> Struct:
        fields = (
            Field("origin", REAL, (3,), "m", "in E1"),
            Field("axes", REAL, (9,), "", "own axes to E1, row by row"),
        )
        return Struct("sensor", "Pose of an instrument or a point.", fields)

    @cached_property
    def points_result(self) -> Struct:
        fields = (
            Field("position", REAL, (3,), "m", "in E0"),
            Field("C", REAL, (3, 3), "", "own axes to E0"),
            Field(
                "twist", REAL, (6,), "m/s, rad/s", "relative to E0, in own axes; the last three are the gyro's reading"
            ),
            Field(
                "specific_force",
                REAL,
                (3,),
                "m/s2",
                "acceleration minus gravity, in own axes: the accelerometer's reading",
            ),
            Field("angular_acceleration", REAL, (3,), "rad/s2", "in own axes"),
        )
        return Struct("points_result", "Motion at an instrument or a point.", fields)

    @cached_property
    def parameters(self) -> Struct:
        fields = [Field("carrier", self.body)]
        if self.added_mass:
            fields.append(Field("added_mass", REAL, (6, 6), "kg, kg m, kg m2", "Lambda of all bodies, about O1 in E1"))
        if self.instruments:
            fields.append(Field("instrument", self.instrument_parameters, (self.instruments,)))
        if self.flywheels:
            fields.append(Field("flywheel", self.flywheel_parameters, (self.count,)))
        if self.structure.points:
            fields.append(Field("point", self.point_parameters, (len(self.structure.points),)))
        return Struct("parameters", "Masses, inertias and mountings, of which the table is made.", tuple(fields))

    @cached_property
    def row(self) -> Struct:
        fields = [
            Field("mu_c", REAL, (3,), "kg m", "first moment about O1: cos phi"),
            Field("mu_s", REAL, (3,), "kg m", "sin phi"),
            Field("J_c", REAL, (6,), "kg m2", "inertia about O1, 11 22 33 12 13 23: cos phi"),
            Field("J_s", REAL, (6,), "kg m2", "sin phi"),
            Field("J_2c", REAL, (6,), "kg m2", "cos 2 phi"),
            Field("J_2s", REAL, (6,), "kg m2", "sin 2 phi"),
            Field("t_0", REAL, (3,), "kg m2", "moment part of I: constant"),
            Field("t_c", REAL, (3,), "kg m2", "cos phi"),
            Field("t_s", REAL, (3,), "kg m2", "sin phi"),
            Field("spin", REAL, (), "kg m2", "Theta_ff: inertia about the spin axis"),
            Field("spin_inv", REAL, (), "1/(kg m2)", ""),
            Field("spin_root_inv", REAL, (), "1/(kg m2)^0.5", "1/sqrt(spin): scales the unknowns of (12)"),
        ]
        if self.flywheel_displaces:
            fields += [
                Field("displaced_c", REAL, (3,), "kg m", "first moment of displaced fluid: cos phi"),
                Field("displaced_s", REAL, (3,), "kg m", "sin phi"),
            ]
        if self.along:
            m, P = self.freedoms, place_of(self.freedoms, 0)
            fields += [
                Field("P_c", REAL, (P,), "SI", "S^T K S, lower triangle, row by row: cos phi"),
                Field("P_s", REAL, (P,), "SI", "sin phi"),
                Field("P_2c", REAL, (P,), "SI", "cos 2 phi"),
                Field("P_2s", REAL, (P,), "SI", "sin 2 phi"),
                Field("I_0", REAL, (m,), "SI", "S^T I: constant"),
                Field("I_c", REAL, (m,), "SI", "cos phi"),
                Field("I_s", REAL, (m,), "SI", "sin phi"),
            ]
        return Struct("row", "Table of one flywheel: harmonics of its terms in (8), in E1 about O1.", tuple(fields))

    @cached_property
    def damper(self) -> Struct:
        """Data of one body for the laws of its own twist."""
        fields = [
            field for law in parts("program", BodyProgram, BODY_LAWS) for field in law.damper_fields(self.structure)
        ]
        return Struct("damper", "Damping of one body, in its own frame.", tuple(fields))

    @cached_property
    def frame(self) -> Struct:
        fields = [
            Field("origin", REAL, (3,), "m", "of the body, in E1"),
            Field("axes", REAL, (9,), "", "C, row by row; of a flywheel at phi = 0"),
        ]
        if self.local_turning:
            fields.append(Field("flywheel", INT, (), "", "index of the flywheel whose phase turns the axes; -1: none"))
        if self.local_fixed:
            fields.append(Field("instrument", INT, (), "", "index of the instrument; -1: none"))
        if self.local_damped:
            fields.append(Field("damper", self.damper))
        if self.local_inputs:
            fields.append(Field("wrench", INT, (), "", "its row in the run-time wrenches; -1: none"))
        return Struct("frame", "A body with wrenches in its own frame.", tuple(fields))

    @cached_property
    def table(self) -> Struct:
        """The prepared stand: constants of the equations, then the laws of the wrenches."""
        fields = [
            Field("mass", REAL, (), "kg", "mass of all bodies"),
            Field("mass_inverse", REAL, (), "1/kg", ""),
            Field("first_moment", REAL, (3,), "kg m", "mu about O1, constant part"),
            Field(
                "inertia",
                REAL,
                (6,),
                "kg m2",
                "J about O1, 11 22 33 12 13 23, constant part" + (", with added mass" if self.added_mass else ""),
            ),
        ]
        if self.along:
            text = "S^T K S, lower triangle, row by row, constant part"
            fields.append(Field("P_0", REAL, (place_of(self.freedoms, 0),), "SI", text))
        if self.added_mass:
            fields += [
                Field("A", REAL, (6,), "kg", "m E + Lambda_11: 11 22 33 12 13 23"),
                Field("A_inv", REAL, (6,), "1/kg", ""),
                Field("G", REAL, (9,), "kg m", "Lambda_21, row by row"),
            ]
            if self.stream:
                fields.append(Field("Lambda_11", REAL, (6,), "kg", "11 22 33 12 13 23: for Z of the fluid alone"))
        if self.displaces:
            fields += [
                Field("weight_mass", REAL, (), "kg", "mass minus displaced mass"),
                Field("displaced_moment", REAL, (3,), "kg m", "first moment of displaced fluid, constant part"),
            ]
        if self.flywheels:
            fields.append(Field("flywheel", self.row, (self.count,)))
        if self.local_bodies:
            fields.append(Field("frame", self.frame, (len(self.local_bodies),)))
        if self.sensors:
            fields.append(Field("sensor", self.sensor, (self.sensor_count,)))
        fields += self.laws
        return Struct(
            "table",
            "The constants of the equations, made of the parameters; the laws at the end (gravity, ...) are as given.",
            tuple(fields),
        )

    @property
    def laws(self) -> list[Field]:
        """Laws of wrenches, as the stand file gives them: prepare does not touch them."""
        laws = []
        if self.weight:
            laws.append(Field("gravity", REAL, (3,), "m/s2", "in E0"))
        if self.stream:
            laws.append(Field("stream", REAL, (3,), "m/s", "velocity of the fluid, in E0"))
        laws += stream.table_fields(self.structure)
        if self.freedoms:
            laws.append(Field("S", REAL, (6, self.freedoms), "", "twists of the hold's freedoms, V = S u"))
        if self.held:
            laws.append(Field("pivot", REAL, (3,), "m", "point that steps keep where the hold does, in E1"))
            laws.append(Field("sliding", REAL, (9,), "", "projector to the directions in which it slides, row by row"))
        if self.coordinates:
            laws.append(Field("home_position", REAL, (3,), "m", "of O1 where all coordinates are zero, in E0"))
            laws.append(Field("home_attitude", REAL, (4,), "", "there, unit quaternion, w first"))
        if self.carrier_damped:
            laws.append(Field("damper", self.damper, (), "", "of the carrier"))
        laws += [f for law in parts("program", BodyProgram, BODY_LAWS) for f in law.table_fields(self.structure)]
        return laws + [f for law in self.law_tables for f in law.fields(self.structure)]

    # -- scratch and results

    @cached_property
    def sums(self) -> Struct:
        """Sums over all bodies; h_rel and g_rel, of one form, lie side by side, so that compilers add them in pairs."""
        fields = (
            Field("mu", REAL, (3,), "kg m", "first moment of all bodies about O1"),
            Field("mu_dot", REAL, (3,), "kg m/s", "its rate in E1"),
            Field("J", REAL, (6,), "kg m2", "inertia about O1"),
            Field("J_dot", REAL, (6,), "kg m2/s", "its rate in E1"),
            Field("h_rel", REAL, (3,), "kg m2/s", "moment part of sum I phi_dot"),
            Field("g_rel", REAL, (3,), "N m", "d/dt of the moment part"),
            Field("a_rel", REAL, (3,), "N", "d/dt of the force part"),
        )
        return Struct("sums", "Sums over all bodies at one state.", fields)

    @cached_property
    def along_sums(self) -> Struct:
        """Sums along the freedoms of a held carrier."""
        m, P = self.freedoms, place_of(self.freedoms, 0)
        fields = [
            Field("P", REAL, (P,), "SI", "S^T K S: mass matrix along the freedoms, lower triangle, row by row"),
            Field("P_dot", REAL, (P,), "SI", "its rate"),
            Field("g", REAL, (m,), "SI", "d/dt of S^T sum I phi_dot"),
        ]
        if momenta_needed(self.ways):
            fields.append(Field("h", REAL, (m,), "SI", "S^T sum I phi_dot"))
        return Struct("along_sums", "Sums over all bodies along the freedoms at one state.", tuple(fields))

    @cached_property
    def coupling(self) -> Struct:
        fields = (
            Field("I", REAL, (6,), "kg m, kg m2", "column of I (9)"),
            Field("bias", REAL, (), "N m", "drive torque at V_dot = 0, phi_ddot = 0"),
        )
        return Struct(
            "coupling", "One flywheel's drive torque by the motion: I . V_dot + Theta_ff phi_ddot + bias.", fields
        )

    @cached_property
    def mount(self) -> Struct:
        fields = [
            Field("mass", REAL, (), "kg", ""),
            Field("first_moment", REAL, (3,), "kg m", "m rc, in Es"),
            Field("inertia", REAL, (6,), "kg m2", "about Os in Es, 11 22 33 12 13 23"),
            Field("origin", REAL, (3,), "m", "Os in E1"),
            Field("axes", REAL, (9,), "", "axes of Es in E1 at phi = 0, row by row"),
        ]
        if self.flywheel_displaces:
            fields.append(Field("displaced_mass", REAL, (), "kg", "mass of the displaced fluid"))
            fields.append(Field("displaced_moment", REAL, (3,), "kg m", "its first moment, in Es"))
        return Struct("mount", "One flywheel and its mounting; used by mounts only.", tuple(fields))

    @cached_property
    def mount_table(self) -> Struct:
        fields = (Field("flywheel", self.mount, (self.count,)),)
        return Struct("mount_table", "Second table, which the function mounts needs. Made by prepare_mounts.", fields)

    @cached_property
    def regressor_result(self) -> Struct:
        body = "by mass, first moment (m rc) and J about the origin: 11 22 33 12 13 23, in the body's frame"
        fields = [Field("Y_carrier", REAL, (6, 10), "SI", f"wrench in E1 about O1 {body}")]
        if self.flywheels:
            fields.append(Field("Y_flywheel", REAL, (self.count, 6, 10), "SI", "likewise, of each flywheel"))
            fields.append(Field("Y_drive", REAL, (self.count, 10), "SI", "drive torque of each, by its own ten"))
        if self.added_mass:
            text = "wrench by Lambda of all bodies: its upper half, row by row"
            fields.append(Field("Y_added_mass", REAL, (6, 21), "SI", text))
        for name in ("linear", "quadratic"):
            text = f"j: row i of the column of {name}[i][j], damping of the carrier; its other rows are 0"
            fields.append(Field(f"Y_{name}", REAL, (6,), "SI", text))
        return Struct("regressor_result", "Columns of parameters; rows X Y Z K M N.", tuple(fields))

    @property
    def unbalances(self) -> int:
        """Numbers that identify_step estimates: its slopes are those of all six rows of (8), of a free carrier."""
        return 0 if self.held else 2 * int(self.count)

    @cached_property
    def estimate(self) -> Struct:
        n = self.unbalances
        fields = (
            Field("unbalance", REAL, (n,), "kg m", "to be added to m rc of each flywheel along its axes 2 and 3"),
            Field("variance", REAL, (n,), "kg2 m2", "D"),
            Field("factor", REAL, (n * (n - 1) // 2,), "", "U above its diagonal, column by column"),
            Field("largest", REAL, (), "kg2 m2", "variances never grow beyond this"),
        )
        return Struct("estimate", "Unbalances found so far, with their covariance U D U^T.", fields)

    @cached_property
    def factors3(self) -> Struct:
        fields = [Field(name, REAL, (), "", "") for name in ("r1", "r2", "d3", "l21", "l31", "l32")]
        fields[0] = Field("r1", REAL, (), "", "1 / D, of the last D itself")
        fields[3] = Field("l21", REAL, (), "", "L below its diagonal")
        return Struct("factors3", "A symmetric 3x3 matrix factored, L D L^T.", tuple(fields))

    @cached_property
    def carrier_factor(self) -> Struct:
        if self.added_mass:
            field = Field("U", REAL, (9,), "m", "A^-1 B^T")
        else:
            field = Field("rho", REAL, (3,), "m", "mass centre from O1, in E1")
        fields = (field, Field("L", self.factors3, (), "", "what is left of the inertia"))
        return Struct("carrier_factor", "K of the carrier factored.", fields)

    @cached_property
    def schur_factor(self) -> Struct:
        fields = (
            Field("A_inv", REAL, (6,), "1/kg", ""),
            Field("U", REAL, (9,), "m", "A^-1 B^T"),
            Field("L", self.factors3, (), "", "D - B A^-1 B^T"),
        )
        return Struct("schur_factor", "K with free flywheels eliminated, factored.", fields)

    @cached_property
    def schur(self) -> Struct:
        fields = (
            Field("A", REAL, (6,), "kg", "force by v_dot: 11 22 33 12 13 23"),
            Field("B", REAL, (9,), "kg m", "moment by v_dot, row by row"),
            Field("D", REAL, (6,), "kg m2", "moment by omega_dot: 11 22 33 12 13 23"),
        )
        return Struct("schur", "K with free flywheels eliminated: K - sum I I^T / Theta_ff.", fields)

    @property
    def motor_points(self) -> int:
        """Points of the curves by which motors are limited; 0: none is."""
        return self.structure.motor_points

    def _of_flywheels(self, *rows: tuple[str, str, str]) -> list[Field]:
        """A real of each flywheel: name, unit, text."""
        return [Field(name, REAL, (self.count,), unit, text) for name, unit, text in rows]

    @cached_property
    def inverse_options(self) -> Struct:
        norm = f"weight of each flywheel in the norm of phi_ddot: {short(1 / WEIGHT)} to {short(WEIGHT)}; else 1"
        no_load = "no-load speed, where the torque that drives has fallen to 0; greater than 0; infinity: none"
        three_quarters = "speed at which three quarters of the dry friction act; greater than 0"
        least = "status NEAR_SINGULAR below this fraction of the largest singular value, 0..1"
        damped = "damping of small singular values, as a fraction of the largest, 0..1; 0: none"
        fields = self._of_flywheels(
            ("weight", "", norm),
            ("limit", "rad/s2", "largest magnitude of each phi_ddot; greater than 0; infinity: no limit"),
            ("most", "rad/s2", "EXCESSIVE above this |phi_ddot|; greater than 0"),
            ("motor_torque", "N m", "EXCESSIVE if the drive torque is larger; not negative; infinity: no limit"),
            ("motor_speed", "rad/s", no_load),
        )
        if points := self.motor_points:
            speeds = "speeds of the points of its limit, none below the one before"
            torques = "EXCESSIVE if the drive torque is larger at a speed; not negative; between points straight lines"
            fields += [
                Field("motor_curve_speed", REAL, (self.count, points), "rad/s", speeds),
                Field("motor_curve_torque", REAL, (self.count, points), "N m", torques),
            ]
        fields += self._of_flywheels(
            ("motor_viscous", "N m s", "viscous friction, which the motor bears; 0: none"),
            ("motor_coulomb", "N m", "dry friction, which the motor bears; 0: none"),
            ("motor_coulomb_speed", "rad/s", three_quarters),
        )
        fields += [Field("near_singular", REAL, (), "", least), Field("damping", REAL, (), "", damped)]
        for task in self.structure.tasks:
            fields.append(
                Field(f"use_{task.name}", INT, (len(task.rows),), "", f"rows of the task {task.name}: 0: free")
            )
        if self.structure.tasks:  # what torque_for looks at besides
            wanted = "speed that torque_for approaches with what the demand leaves free"
            missing = "part of what is missing to it, wanted a second; 0: least torque"
            nearest = "no wanted speed lies nearer to 0 than this; 0: none is avoided"
            fields += self._of_flywheels(
                ("motor_power", "W", "most that torque_for drives with; infinity: no limit"),
                ("target_speed", "rad/s", wanted),
            )
            fields += [
                Field("target_rate", REAL, (), "1/s", missing),
                Field("avoid_speed", REAL, (), "rad/s", nearest),
                Field("keep_direction", INT, (), "", "1: a demand out of reach is made smaller, 0: least error"),
            ]
        purpose = "Options of inverse: how it distributes a demand, and what it does near a singularity."
        return Struct("inverse_options", purpose, tuple(fields))

    @cached_property
    def inverse_work(self) -> Struct:
        fields: tuple[Field, ...] = (
            Field("I", REAL, (6, self.count), "kg m, kg m2", "flywheel coupling (9)"),
            Field("W", REAL, (6, self.count), "", "scaled: G^-1 I D^-1; then with orthogonal rows"),
            Field("U", REAL, (6, 6), "", "rotations of the rows"),
            Field("G", REAL, (6, 6), "", "Cholesky factor of K, lower triangle"),
            Field("b", REAL, (6,), "N, N m", "the wrench demanded of the flywheels"),
            Field("r", REAL, (6,), "", "scaled: G^-1 b; then U^T r"),
            Field("sigma", REAL, (6,), "", "singular values"),
            Field("scale", REAL, (self.count,), "", "D^-1"),
        )
        if not self.flywheels:
            fields = tuple(f for f in fields if f.name in ("G", "b", "r"))
        return Struct("inverse_work", "Scratch of inverse.", fields)

    @property
    def inverse_rows(self) -> int:
        """Rows of (12): six, or those of the freedoms of a held carrier."""
        return self.freedoms if self.held else 6

    @cached_property
    def inverse_result(self) -> Struct:
        V, matrix, norm = self.twist, "K^-1/2 I Theta_ff^-1/2", "K^-1"
        left = f"F - K {V}_dot - M {V} - J phi_dot - I phi_ddot"
        if self.held:
            left, matrix, norm = f"S^T ({left})", "(S^T K S)^-1/2 S^T I Theta_ff^-1/2", "(S^T K S)^-1"
        hardest = f"the unreachable wrench, or the one hardest to reach; a unit vector in the norm of {norm}"
        residual = Field("residual", REAL, (self.inverse_rows,), "N, N m", left)
        fields = self._quality(residual, matrix, Field("hardest", REAL, (self.inverse_rows,), "", hardest))
        if not self.flywheels:
            fields = tuple(f for f in fields if f.name in ("residual", "rank", "damped_by", "hardest"))
        return Struct("inverse_result", "Result of inverse and its quality.", fields)

    def task_result(self, task: Task) -> Struct:
        """Result of the inverse problem of a task."""
        text = "the unreachable part of the demand, or the one hardest to reach; a unit in its norm"
        residual, matrix = self._missed(task), "(S K^-1 S^T)^-1/2 S K^-1 I Theta_ff^-1/2"
        fields = self._quality(residual, matrix, replace(residual, name="hardest", comment=text), self._moved)
        return Struct(f"inverse_{task.name}_result", f"Result of inverse_{task.name} and its quality.", fields)

    def torque_for_result(self, task: Task) -> Struct:
        """Result of the torques for a task."""
        fields = (
            *self._of_flywheels(
                ("tau", "N m", "drive torques"), ("phi_ddot", "rad/s2", "flywheel accelerations that result")
            ),
            self._moved,
            self._missed(task),
            Field("share", REAL, (), "", "part of the demand that is met, with keep_direction; else 1"),
            Field("limited", INT, (self.count,), "", "1 if the torque is at its limit"),
        )
        return Struct(f"torque_for_{task.name}_result", f"Result of torque_for_{task.name} and its quality.", fields)

    @property
    def _moved(self) -> Field:
        return Field("V_dot", REAL, (6,), "m/s2, rad/s2", "motion of the carrier that results")

    def _missed(self, task: Task) -> Field:
        return Field("residual", REAL, (len(task.rows),), "m/s2, rad/s2", "demand minus reached; 0 of a free row")

    def _quality(self, residual: Field, matrix: str, hardest: Field, *moved: Field) -> tuple[Field, ...]:
        """An answer of `inverse` and how good it is, by the singular values of a matrix."""
        count = min(int(residual.shape[0]), int(self.count))
        return (
            *self._of_flywheels(("phi_ddot", "rad/s2", "flywheel accelerations")),
            *moved,
            residual,
            Field("sigma", REAL, (count,), "", f"singular values of {matrix}, descending"),
            Field("rank", INT, (), "", "number of singular values above the rank threshold"),
            Field("damped_by", REAL, (), "", "largest damping lambda applied, in units of sigma; 0: none"),
            Field("limited", INT, (self.count,), "", "1 if the flywheel reached its limit"),
            hardest,
        )

    @property
    def moved(self) -> tuple[str, str, str, int]:
        """What Jacobians are of: names of its rate and of itself, the symbol of the rate, how many numbers it has."""
        return ("u_dot", "u", "u_dot", self.freedoms) if self.held else ("V_dot", "V", "V_dot", 6)

    @cached_property
    def forward_jacobian_result(self) -> Struct:
        rate, speed, of, rows = self.moved
        fields = [Field(f"{rate}_{speed}", REAL, (rows, rows), "", f"of {of} by {speed}: row i, column j")]
        words = {"phi": f"of {of} by the phases", "phi_dot": "by the speeds", "phi_ddot": "by the accelerations"}
        for by, text in words.items() if self.flywheels else ():
            fields.append(Field(f"{rate}_{by}", REAL, (rows, self.count), "", text))
        return Struct("forward_jacobian_result", "Derivatives of forward.", tuple(fields))

    @cached_property
    def coupled_jacobian_result(self) -> Struct:
        (rate, speed, of, rows), n = self.moved, self.count
        fields = (
            Field(f"{rate}_{speed}", REAL, (rows, rows), "", f"of {of} by {speed}: row i, column j"),
            Field(f"{rate}_phi", REAL, (rows, n), "", f"of {of} by the phases"),
            Field(f"{rate}_phi_dot", REAL, (rows, n), "", "by the speeds"),
            Field(f"{rate}_tau", REAL, (rows, n), "", "by the drive torques"),
            Field(f"phi_ddot_{speed}", REAL, (n, rows), "", f"of phi_ddot by {speed}: row s, column j"),
            Field("phi_ddot_phi", REAL, (n, n), "", "of phi_ddot by the phases"),
            Field("phi_ddot_phi_dot", REAL, (n, n), "", "by the speeds"),
            Field("phi_ddot_tau", REAL, (n, n), "", "by the drive torques"),
        )
        return Struct("coupled_jacobian_result", "Derivatives of coupled.", fields)

    @cached_property
    def matrices(self) -> Struct:
        V = "V_r" if self.stream else "V"
        fields = [
            Field("K", REAL, (6, 6), "kg, kg m, kg m2", "mass matrix (2)"),
            Field("K_dot", REAL, (6, 6), "per s", "its rate (6)"),
            Field("M", REAL, (6, 6), "per s", f"velocity matrix (9) at {V}"),
        ]
        if self.flywheels:
            fields += [
                Field("I", REAL, (6, self.count), "kg m, kg m2", "flywheel coupling (9), one column per flywheel"),
                Field("J", REAL, (6, self.count), "per s", f"its velocity part (9) at {V}"),
            ]
        fields.append(Field("F", REAL, (6,), "N, N m", "total external wrench (7)"))
        return Struct("matrices_result", "The matrices of (8).", tuple(fields))

    @cached_property
    def momentum(self) -> Struct:
        fields = (
            Field("Z", REAL, (6,), "kg m/s, kg m2/s", "momentum screw in E1 about O1 (2)"),
            Field("Z0", REAL, (6,), "kg m/s, kg m2/s", "momentum screw in E0 about its origin (1)"),
            Field("energy", REAL, (), "J", "kinetic energy"),
            Field("center_of_mass", REAL, (3,), "m", "mass centre of all bodies, in E1"),
            Field("center_of_mass_velocity", REAL, (3,), "m/s", "of the mass centre relative to E0, in E0"),
        )
        return Struct("momentum_result", "Momentum, energy, mass centre and its velocity.", fields)

    @cached_property
    def generalized(self) -> Struct:
        if self.coordinates:
            return coordinates_struct(self.ways)
        fields = (
            Field("A", REAL, (6, 6), "", "V = A q_dot (10)"),
            Field("D", REAL, (6, 6), "1/s", "A_dot (10)"),
            Field("I0", REAL, (6, 6), "", "K A (11)"),
            Field("J0", REAL, (6, 6), "", "K D + M A (11), M at V"),
            Field("q_dot", REAL, (6,), "m/s, rad/s", "O1 in E0, then psi, theta, phi"),
            Field("q_ddot", REAL, (6,), "m/s2, rad/s2", "A^-1 (V_dot - D q_dot), V_dot by (8) for the given phi_ddot"),
        )
        return Struct(
            "generalized_result", "The equations in generalized coordinates q = (O1 in E0; psi, theta, phi).", fields
        )


def _position(index: int, indices: tuple[int, ...]) -> int:
    return indices.index(index) if index in indices else -1


def run_time_inputs(structure: Structure) -> tuple[RunTimeInput, ...]:
    """Inputs in the table that laws of the stand take at run time."""
    laws = parts("program", BodyProgram, BODY_LAWS)
    return tuple(settable for law in laws if (settable := law.run_time_input(structure)) is not None)
