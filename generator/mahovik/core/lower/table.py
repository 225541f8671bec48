"""The structs that a caller fills or keeps: state, parameters, and the prepared table with its laws."""

from __future__ import annotations

from functools import cached_property

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower import stream_profile
from mahovik.core.lower.features import Features
from mahovik.core.lower.law import BodyProgram
from mahovik.core.program.types import Field, Kind, Struct

REAL, INT = Kind.REAL, Kind.INT


OF_HOLD = frozenset(("S", "pivot", "sliding", "home_position", "home_attitude"))
"""Members of the table that are numbers of a hold: they belong together, none is changed alone."""


class Tables(Features):
    """State, parameters and table: with the members that the features of a stand need; the others are omitted."""

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
            m, P = self.freedoms, self.freedoms * (self.freedoms + 1) // 2
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
        if self.own_turning:
            fields.append(Field("flywheel", INT, (), "", "index of the flywheel whose phase turns the axes; -1: none"))
        if self.own_fixed:
            fields.append(Field("instrument", INT, (), "", "index of the instrument; -1: none"))
        if self.own_damped:
            fields.append(Field("damper", self.damper))
        if self.own_inputs:
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
            P = self.freedoms * (self.freedoms + 1) // 2
            text = "S^T K S, lower triangle, row by row, constant part"
            fields.append(Field("P_0", REAL, (P,), "SI", text))
        if self.added_mass:
            fields += [
                Field("A", REAL, (6,), "kg", "m E + Lambda_11: 11 22 33 12 13 23"),
                Field("A_inv", REAL, (6,), "1/kg", ""),
                Field("G", REAL, (9,), "kg m", "Lambda_21, row by row"),
            ]
        if self.displaces:
            fields += [
                Field("weight_mass", REAL, (), "kg", "mass minus displaced mass"),
                Field("displaced_moment", REAL, (3,), "kg m", "first moment of displaced fluid, constant part"),
            ]
        if self.flywheels:
            fields.append(Field("flywheel", self.row, (self.count,)))
        if self.own:
            fields.append(Field("frame", self.frame, (len(self.own),)))
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
        laws += stream_profile.table_fields(self.structure)
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
