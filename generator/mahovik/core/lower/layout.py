"""The structs of a stand's program. Fields that the stand does not use are omitted."""

from __future__ import annotations

from functools import cached_property

from mahovik.contract.quantities import BOUNDS, short
from mahovik.core.lower.freedom_coordinates import coordinates_struct
from mahovik.core.lower.freedoms import momenta_needed
from mahovik.core.lower.table import Tables
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Task

REAL, INT = Kind.REAL, Kind.INT
WEIGHT = BOUNDS["MAX_WEIGHT"].value


class Layout(Tables):
    """All structs: those of `Tables`, sums and other scratch, and results."""

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
        m = self.freedoms
        P = m * (m + 1) // 2
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
        """Numbers that identify_step estimates."""
        return 2 * int(self.count)

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

    @cached_property
    def inverse_options(self) -> Struct:
        fields = (
            Field(
                "weight",
                REAL,
                (self.count,),
                "",
                f"weight of each flywheel in the norm of phi_ddot: {short(1 / WEIGHT)} to {short(WEIGHT)}; else 1",
            ),
            Field(
                "limit",
                REAL,
                (self.count,),
                "rad/s2",
                "largest magnitude of each phi_ddot; greater than 0; infinity: no limit",
            ),
            Field("most", REAL, (self.count,), "rad/s2", "EXCESSIVE above this |phi_ddot|; greater than 0"),
            Field(
                "motor_torque",
                REAL,
                (self.count,),
                "N m",
                "EXCESSIVE if the drive torque is larger; not negative; infinity: no limit",
            ),
            Field(
                "motor_speed",
                REAL,
                (self.count,),
                "rad/s",
                "no-load speed, where the torque that drives has fallen to 0; greater than 0; infinity: none",
            ),
            Field("motor_viscous", REAL, (self.count,), "N m s", "viscous friction, which the motor bears; 0: none"),
            Field("motor_coulomb", REAL, (self.count,), "N m", "dry friction, which the motor bears; 0: none"),
            Field(
                "motor_coulomb_speed",
                REAL,
                (self.count,),
                "rad/s",
                "speed at which three quarters of the dry friction act; greater than 0",
            ),
            Field(
                "near_singular",
                REAL,
                (),
                "",
                "status NEAR_SINGULAR below this fraction of the largest singular value, 0..1",
            ),
            Field(
                "damping", REAL, (), "", "damping of small singular values, as a fraction of the largest, 0..1; 0: none"
            ),
            *(
                Field(f"use_{task.name}", INT, (len(task.rows),), "", f"rows of the task {task.name}: 0: free")
                for task in self.structure.tasks
            ),
            *(self._torque_options if self.structure.tasks else ()),
        )
        return Struct(
            "inverse_options",
            "Options of inverse: how it distributes a demand, and what it does near a singularity.",
            fields,
        )

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
        rows = self.inverse_rows
        least = min(rows, int(self.count))
        left, matrix = "F - K V_dot - M V - J phi_dot - I phi_ddot", "K^-1/2 I Theta_ff^-1/2"
        if self.held:
            left, matrix = f"S^T ({left})", "(S^T K S)^-1/2 S^T I Theta_ff^-1/2"
        fields: tuple[Field, ...] = (
            Field("phi_ddot", REAL, (self.count,), "rad/s2", "flywheel accelerations"),
            Field("residual", REAL, (rows,), "N, N m", left),
            Field("sigma", REAL, (least,), "", f"singular values of {matrix}, descending"),
            Field("rank", INT, (), "", "number of singular values above the rank threshold"),
            Field("damped_by", REAL, (), "", "largest damping lambda applied, in units of sigma; 0: none"),
            Field("limited", INT, (self.count,), "", "1 if the flywheel reached its limit"),
            Field(
                "hardest",
                REAL,
                (rows,),
                "",
                "the unreachable wrench, or the one hardest to reach; a unit vector in the norm of "
                + ("(S^T K S)^-1" if self.held else "K^-1"),
            ),
        )
        if not self.flywheels:
            fields = tuple(f for f in fields if f.name in ("residual", "rank", "damped_by", "hardest"))
        return Struct("inverse_result", "Result of inverse and its quality.", fields)

    @property
    def _torque_options(self) -> tuple[Field, ...]:
        """What torque_for looks at besides."""
        wanted = "speed that torque_for approaches with what the demand leaves free"
        return (
            Field(
                "motor_power",
                REAL,
                (self.count,),
                "W",
                "most that torque_for drives with; infinity: no limit",
            ),
            Field("target_speed", REAL, (self.count,), "rad/s", wanted),
            Field("target_rate", REAL, (), "1/s", "part of what is missing to it, wanted a second; 0: least torque"),
            Field("avoid_speed", REAL, (), "rad/s", "no wanted speed lies nearer to 0 than this; 0: none is avoided"),
            Field("keep_direction", INT, (), "", "1: a demand out of reach is made smaller, 0: least error"),
        )

    def torque_for_result(self, task: Task) -> Struct:
        """Result of the torques for a task."""
        fields = (
            Field("tau", REAL, (self.count,), "N m", "drive torques"),
            Field("phi_ddot", REAL, (self.count,), "rad/s2", "flywheel accelerations that result"),
            Field("V_dot", REAL, (6,), "m/s2, rad/s2", "motion of the carrier that results"),
            Field("residual", REAL, (len(task.rows),), "m/s2, rad/s2", "demand minus reached; 0 of a free row"),
            Field("share", REAL, (), "", "part of the demand that is met, with keep_direction; else 1"),
            Field("limited", INT, (self.count,), "", "1 if the torque is at its limit"),
        )
        return Struct(f"torque_for_{task.name}_result", f"Result of torque_for_{task.name} and its quality.", fields)

    def task_result(self, task: Task) -> Struct:
        """Result of the inverse problem of a task."""
        rows = len(task.rows)
        fields = (
            Field("phi_ddot", REAL, (self.count,), "rad/s2", "flywheel accelerations"),
            Field("V_dot", REAL, (6,), "m/s2, rad/s2", "motion of the carrier that results"),
            Field("residual", REAL, (rows,), "m/s2, rad/s2", "demand minus reached; 0 of a free row"),
            Field(
                "sigma",
                REAL,
                (min(rows, int(self.count)),),
                "",
                "singular values of (S K^-1 S^T)^-1/2 S K^-1 I Theta_ff^-1/2, descending",
            ),
            Field("rank", INT, (), "", "number of singular values above the rank threshold"),
            Field("damped_by", REAL, (), "", "largest damping lambda applied, in units of sigma; 0: none"),
            Field("limited", INT, (self.count,), "", "1 if the flywheel reached its limit"),
            Field(
                "hardest",
                REAL,
                (rows,),
                "m/s2, rad/s2",
                "the unreachable part of the demand, or the one hardest to reach; a unit in its norm",
            ),
        )
        return Struct(f"inverse_{task.name}_result", f"Result of inverse_{task.name} and its quality.", fields)

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
        relative = ", at V relative to the stream" if self.stream else ""
        fields = [
            Field("K", REAL, (6, 6), "kg, kg m, kg m2", "mass matrix (2)"),
            Field("K_dot", REAL, (6, 6), "per s", "its rate (6)"),
            Field("M", REAL, (6, 6), "per s", f"velocity matrix (9){relative}"),
        ]
        if self.flywheels:
            fields += [
                Field("I", REAL, (6, self.count), "kg m, kg m2", "flywheel coupling (9), one column per flywheel"),
                Field("J", REAL, (6, self.count), "per s", "its velocity part (9)"),
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
            Field("D", REAL, (6, 6), "1/s", "A' along the motion (10)"),
            Field("I0", REAL, (6, 6), "", "K A (11)"),
            Field("J0", REAL, (6, 6), "", "K D + M A (11)"),
            Field("q_dot", REAL, (6,), "m/s, rad/s", "O1 in E0, then psi, theta, phi"),
            Field("q_ddot", REAL, (6,), "m/s2, rad/s2", "solution of (11) for the given phi_ddot"),
        )
        return Struct(
            "generalized_result", "The equations in generalized coordinates q = (O1 in E0; psi, theta, phi).", fields
        )
