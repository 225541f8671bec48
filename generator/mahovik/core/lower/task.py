"""Tasks: chosen components a = S V_dot + s of the carrier's motion, scaled: W y = r, y = Theta_ff^1/2 phi_ddot.

Of O1 a row is a component of V_dot. With the axes c1, c2, c3 (columns, in E1) and origin O of a point, its angular row
k is c_k . omega_dot, its linear row c_k . v_dot + (O x c_k) . omega_dot + s, s = c_k . (omega x (v + omega x O)): its
acceleration in its own axes.

With K = G G^T, X = G^-1 I D^-1 and x = G^-1 (b - K d), as `demand` has them for V_dot = 0, and Y = G^-1 S^T = Q R, the
norm is S K^-1 S^T = L L^T with L = R^T, and W = L^-1 S K^-1 I D^-1 = Q^T X, r = Q^T x + L^-1 (s - a): no inverse of K.
If only turning is demanded, the last three rows of all are enough, and their G is the factor of the inertia about the
mass centre (with added mass: of what eliminating v_dot leaves of it).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.lower.demand import right_side
from mahovik.core.lower.flywheels import column_of
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import about_mass_center, factored, lower_left
from mahovik.core.program.expression import Place, Status
from mahovik.core.program.kernel import OK, Ints, Reals, argument, body, inline, let, reals
from mahovik.core.program.vector import cross, dot, symmetric
from mahovik.core.stand.model import COMPONENTS, Task, TaskRow

FREE_NOTE = "A row is free where its flag in the options is 0; its demand must be a number nevertheless."


@dataclass(frozen=True)
class Rows:
    """The rows of a task of a stand, as expressions: of O1 by structure, of a point or instrument by the table."""

    layout: Layout
    task: Task

    def __len__(self) -> int:
        return len(self.task.rows)

    @property
    def name(self) -> str:
        """Name of the task."""
        return self.task.name

    @property
    def words(self) -> str:
        """Names of the rows."""
        return ", ".join(f"{row.of}.{row.component}" if row.of else row.component for row in self.task.rows)

    @property
    def turning(self) -> bool:
        """Whether only angular accelerations are demanded: then a 3x3 of K is enough."""
        return all(row.component.startswith("w") for row in self.task.rows)

    @property
    def size(self) -> int:
        """Components of V_dot that the rows take: 3 where only turning is demanded, else 6."""
        return 3 if self.turning else 6

    @property
    def whole_turning(self) -> bool:
        """Whether the rows are all three of turning in one set of axes."""
        return self.turning and len(self) == 3 and len({row.of for row in self.task.rows}) == 1

    def use(self, options: Place) -> Place:
        """The flags of the rows: 0 is a free row."""
        return options.member(f"use_{self.name}")

    def axis(self, table: Place, row: TaskRow) -> list[Any]:
        """c_k in E1 (3) of a row."""
        k = COMPONENTS.index(row.component) % 3
        return [self._sensor(table, row).axes[3 * i + k] if row.of else int(i == k) for i in range(3)]

    def twist(self, table: Place, row: TaskRow) -> list[Any]:
        """A row of S."""
        axis = self.axis(table, row)
        if not _is_linear(row):
            return [0, 0, 0, *axis]
        return [*axis, *(cross(self._sensor(table, row).origin, axis) if row.of else (0, 0, 0))]

    def centripetal(self, table: Place, V: Any) -> list[Any]:
        """s: one a row, at the twist V (6) of the carrier relative to E0."""
        points = {row.of: row for row in self.task.rows if row.of and _is_linear(row)}
        turned: dict[str, Place] = {}
        for number, (name, row) in enumerate(points.items()):
            velocity = body().local(f"velocity_{number}", (3,), comment=f"of {name}, in E1")
            turned[name] = body().local(f"turned_{number}", (3,), comment="omega x this velocity")
            body().set(velocity, V[:3] + cross(V[3:], self._sensor(table, row).origin))
            body().set(turned[name], cross(V[3:], velocity))
        return [
            dot(self.axis(table, row), turned[row.of]) if row.of and _is_linear(row) else 0 for row in self.task.rows
        ]

    def turn(self, table: Place, demand: Any) -> list[Any]:
        """omega_dot (3, in E1) of all three rows of turning in one set of axes."""
        axes = [self.axis(table, row) for row in self.task.rows]
        return [dot([axis[i] for axis in axes], demand) for i in range(3)]

    def _sensor(self, table: Place, row: TaskRow) -> Place:
        """The point or instrument of a row in the table."""
        return table.sensor[self.layout.sensors.index(row.of)]


def _is_linear(row: TaskRow) -> bool:
    return row.component.startswith("v")


@inline
def factor3(lib: Any, S: Reals, work: Any) -> None:
    """S (11 22 33 12 13 23) = U D U^T, U unit lower triangular: U below the diagonal of G, D on it, D^-1 in sigma."""
    r1, r2, d3, l21, l31, l32, d2 = factored(S, lib.layout.precision.smallest)
    for i, row in enumerate(([S[0]], [l21, d2], [l31, l32, d3])):
        for j, value in enumerate(row):
            work.G[i][j] = value
    for i, inverse in enumerate((r1, r2, 1 / d3)):
        work.sigma[i] = inverse


@inline
def substitute3(G: Reals, moment: Reals, out: Any, name: str) -> None:
    """out = U^-1 moment, three numbers."""
    second = let(f"{name}_2", moment[1] - G[1][0] * moment[0])
    out[0] = moment[0]
    out[1] = second
    out[2] = moment[2] - G[2][0] * moment[0] - G[2][1] * second


@inline
def turning_part(
    lib: Any, F: Reals, S: Reals, work: Any, moment_of: Any, flywheel: Any = None, turns: Any = ()
) -> None:
    """The last three rows: the moments of F and of I, whose columns are found by `turns`, when v_dot is eliminated."""
    factor3(lib, S, work)
    moment: Reals = moment_of(F)  # of b, then of each column of I, when v_dot is eliminated
    substitute3(work.G, moment, work.r[:3], "r")
    for s in range(lib.layout.count):
        if turns:
            s_phi = turns[0][s]
            c_phi = turns[1][s]
            I: Reals = column_of(flywheel[s], s_phi, c_phi)
        else:
            I = work.I[:, s]
        moment[:] = moment_of(I)
        substitute3(work.G, moment, work.W[:3, s], "W")


def add_demand(lib: Library, task: Rows) -> None:
    """Adds `project_TASK`, and what tasks of turning share."""
    if "demand_turning" not in lib and any(Rows(lib.layout, other).turning for other in lib.layout.structure.tasks):
        add_demand_turning(lib)
        add_scale_turning(lib)
    add_project(lib, task)


def add_demand_turning(lib: Library) -> None:
    """U^-1 (moments of I), U^-1 (moment of b), U and D of the inertia U D U^T that is left when v_dot is eliminated."""
    layout, added = lib.layout, lib.layout.added_mass

    @lib.kernel(
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        purpose="The turning part of (12) at omega_dot = 0: moments of I and of the right-hand side, by the inertia's "
        "factor U.",
    )
    def demand_turning(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        wrench: Any = lib.wrench,
        work: Any = argument(
            "of G, W, r, sigma the first three rows are written", struct=layout.inverse_work, direction="out"
        ),
    ) -> Status:
        """Moments of I and of the right-hand side."""
        seen, F, _ = right_side(lib, table, x, (sine, cosine), wrench, "b = F - M V_r - J phi_dot")
        mu, J = seen.sums.mu, seen.sums.J
        if added:
            B: Reals = lower_left(lib, table, mu).flat  # <mu> + Lambda_21: lower left block of K
            U: Reals = (symmetric(table.A_inv) @ B.T).flat  # A^-1 B^T
            S: Reals = J - (B.square @ U.square).six  # J - B A^-1 B^T
            turning_part(lib, F, S, work, lambda six: six[3:] - U.T @ six[:3], table.flywheel, seen.turns)
        else:
            rho: Reals = table.mass_inverse * mu  # mass centre from O1, in E1
            S: Reals = about_mass_center(seen.sums, rho)  # inertia about the mass centre
            turning_part(lib, F, S, work, lambda six: cross(six[:3], rho) + six[3:], table.flywheel, seen.turns)
        return OK


def add_scale_turning(lib: Library) -> None:
    """The norms into what `demand_turning` gives: G = U D^1/2, W = D^-1/2 U^-1 (moments of I) Theta_ff^-1/2."""
    N, sqrt = lib.layout.count, lib["sqrt"]

    @lib.kernel()
    def scale_turning(
        table: Any = lib.table,
        work: Any = argument(struct=lib.layout.inverse_work, direction="inout"),
    ) -> None:
        """Scales what demand_turning gives by the norms of inertia and spin inertias."""
        for s in range(N):
            work.scale[s] = table.flywheel[s].spin_root_inv
        for i in range(3):
            root = sqrt(work.G[i][i])
            work.G[i][i] = root
            for k in range(i + 1, 3):
                work.G[k][i] = work.G[k][i] * root
            work.r[i] = work.r[i] / root
            for s in range(N):
                work.W[i][s] = work.W[i][s] / root * work.scale[s]


@inline
def base_demand(
    lib: Any, task: Any, table: Any, x: Any, turns: Any, wrench: Any, work: Any, scaled: bool = True
) -> None:
    """X, x and G of the rows that the task takes, into the work; `scaled`: by norms, of turning as well."""
    if task.turning:
        lib["demand_turning"](table, x, *turns, wrench, work)
        if scaled:
            lib["scale_turning"](table, work)
    else:
        still = reals(6)  # V_dot = 0
        still[:] = [0] * 6
        lib["demand"](table, x, *turns, still, wrench, work)


@inline
def turn_all(task: Any, table: Any, demand: Reals, work: Any) -> None:
    """r = U^-1 moment - D U^T omega_dot where all of omega_dot is demanded: the norm is the inertia, W stays."""
    # all of omega_dot is demanded: r = U^-1 (moment - inertia omega_dot)
    G, r, a = work.G, work.r, [let(f"turn_{i + 1}", value) for i, value in enumerate(task.turn(table, demand))]
    r[0] = r[0] - G[0][0] * (a[0] + G[1][0] * a[1] + G[2][0] * a[2])
    r[1] = r[1] - G[1][1] * (a[1] + G[2][1] * a[2])
    r[2] = r[2] - G[2][2] * a[2]


def add_project(lib: Library, task: Rows) -> None:
    """W and r of the rows of a task that are demanded, from X and x; L in the place of G."""
    N, rows, size, sqrt = lib.layout.count, len(task), task.size, lib["sqrt"]

    @lib.kernel(
        f"project_{task.name}",
        purpose=f"Matrix and right-hand side of the rows of the task {task.name} that are demanded, scaled.",
    )
    def project(
        table: Any = lib.table,
        x: Any = lib.x,
        demand: Reals = argument("one a row", rows, unit="m/s2, rad/s2"),
        use: Ints = argument("0: the row is free", rows),
        work: Any = argument(
            "in: X, x as W, r, and G; out: W, r, and L as G, L L^T = S K^-1 S^T",
            struct=lib.layout.inverse_work,
            direction="inout",
        ),
    ) -> None:
        """Matrix and right-hand side of the rows of a task."""
        G = work.G
        Y = reals(rows, size)  # rows: columns of G^-1 S^T, then of Q
        known = reals(rows)  # s - a, then L^-1 (s - a)
        terms = task.centripetal(table, x.V)
        for j in [*range(rows)]:
            known[j] = terms[j] - demand[j]
            twist = task.twist(table, task.task.rows[j])[6 - size :]
            for i in [*range(size)]:
                Y[j][i] = twist[i]
        for j in range(rows):
            for i in range(size):
                rest: float = Y[j][i] if use[j] > 0 else 0.0
                for k in range(i):
                    rest -= G[i][k] * Y[j][k]
                Y[j][i] = rest / G[i][i]
        for j in range(rows):
            # orthogonal to the rows before, twice, so that no digit is lost
            for i in range(j):
                G[j][i] = 0
            for pass_ in range(2):
                for i in range(j):
                    along: float = 0.0
                    for k in range(size):
                        along += Y[i][k] * Y[j][k]
                    for k in range(size):
                        Y[j][k] -= along * Y[i][k]
                    G[j][i] += along
            square: float = 0.0
            for k in range(size):
                square += Y[j][k] * Y[j][k]
            length = sqrt(square)
            G[j][j] = length if length > 0 else 1.0  # a free row demands nothing
            for k in range(size):
                Y[j][k] = Y[j][k] / G[j][j]
            left: float = known[j] if use[j] > 0 else 0.0  # of L known = s - a
            for i in range(j):
                left -= G[j][i] * known[i]
            known[j] = left / G[j][j]
        kept = reals(size)
        total = reals()
        # W = Q^T X, r = Q^T x + L^-1 (s - a)
        for s in range(N):
            for i in range(size):
                kept[i] = work.W[i][s]
            for j in range(rows):
                total = 0
                for i in range(size):
                    total += Y[j][i] * kept[i]
                work.W[j][s] = total
        for i in range(size):
            kept[i] = work.r[i]
        for j in range(rows):
            total = known[j]
            for i in range(size):
                total += Y[j][i] * kept[i]
            work.r[j] = total


@inline
def project_rows(lib: Any, task: Any, table: Any, x: Any, demand: Reals, options: Any, work: Any) -> None:
    """W, r and L of the rows that are demanded, from X, x and G."""
    lib[f"project_{task.name}"](table, x, demand, task.use(options), work)


@inline
def miss(task: Any, table: Any, x: Any, demand: Reals, use: Ints, V_dot: Reals, residual: Reals) -> None:
    """The residual of a motion: demand minus reached, 0 of a free row."""
    known = task.centripetal(table, x.V)
    for j, row in enumerate(task.task.rows):
        reached = [1, -1, -1], [demand[j], dot(task.twist(table, row), V_dot), known[j]]
        left = let(f"left_{j + 1}", dot(*reached))
        residual[j] = left if use[j] > 0 else 0.0


@inline
def demanded_rows(use: Ints) -> int:
    """Number of rows that are not free."""
    demanded: int = 0  # rows that are not free
    for j in range(len(use)):
        if use[j] > 0:
            demanded = demanded + 1
    return demanded
