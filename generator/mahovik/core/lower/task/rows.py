"""Rows of a task as expressions, a = S V* + s: of O1 by structure, of a point or instrument by its place in the table.

With the axes c1, c2, c3 (columns, in E1) and the origin O of a point, its angular row k is c_k . omega*, its linear row
c_k . v* + (O x c_k) . omega* + s, s = c_k . (omega x (v + omega x O)): its acceleration in its own axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Expr, Place, real, select
from mahovik.core.stand.model import COMPONENTS, Task, TaskRow


@dataclass(frozen=True)
class Rows:
    """The rows of a task of a stand."""

    layout: Layout
    task: Task

    def __len__(self) -> int:
        return len(self.task.rows)

    @property
    def turning(self) -> bool:
        """Whether only angular accelerations are demanded: then a 3x3 of K is enough."""
        return all(row.component.startswith("w") for row in self.task.rows)

    @property
    def size(self) -> int:
        """Components of V* that the rows take: 3 where only turning is demanded, else 6."""
        return 3 if self.turning else 6

    @property
    def whole_turning(self) -> bool:
        """Whether the rows are all three of turning in one set of axes."""
        return self.turning and len(self) == 3 and len({row.of for row in self.task.rows}) == 1

    def sensor(self, table: Place, row: TaskRow) -> Place:
        """The point or instrument of a row in the table."""
        return table.sensor[self.layout.sensors.index(row.of)]

    def axis(self, table: Place, row: TaskRow) -> list[Expr]:
        """c_k in E1 (3) of a row of a point or instrument."""
        axes = self.sensor(table, row).axes
        return [axes[3 * i + _place(row)] for i in range(3)]

    def fill(self, body: Body, table: Place, Y: Place) -> None:
        """Set the rows of S, `size` numbers each."""
        skipped = 6 - self.size
        for j, row in enumerate(self.task.rows):
            for i, value in enumerate(self._row(table, row)[skipped:]):
                body.set(Y[j][i], value)

    def _row(self, table: Place, row: TaskRow) -> Sequence[Expr]:
        zero: list[Expr] = [real(0), real(0), real(0)]
        if not row.of:
            return [real(float(k == COMPONENTS.index(row.component))) for k in range(6)]
        axis = self.axis(table, row)
        return [*axis, *self._arm(table, row)] if _linear(row) else [*zero, *axis]

    def _arm(self, table: Place, row: TaskRow) -> list[Expr]:
        """O x c_k."""
        binding: dict[str, Any] = {"omega": self.sensor(table, row).origin, "O": self.axis(table, row)}
        return [translate(each, binding) for each in derived.turning_velocity()]

    def known_terms(self, body: Body, table: Place, V: Place) -> list[Expr]:
        """s: one a row, at the twist V (6) of the carrier relative to E0."""
        turned: dict[str, Place] = {}
        found: list[Expr] = []
        for row in self.task.rows:
            if not row.of or not _linear(row):
                found.append(real(0))
                continue
            if row.of not in turned:
                six = parts_of_twist(V)
                velocity = body.local(f"velocity_{len(turned)}", (3,), comment=f"of {row.of}, in E1")
                turned[row.of] = body.local(f"turned_{len(turned)}", (3,), comment="omega x this velocity")
                assign(body, list(velocity), derived.twist_at(), six | {"O": self.sensor(table, row).origin})
                assign(body, list(turned[row.of]), derived.turning_velocity(), six | {"O": velocity})
            found.append(_dot(self.axis(table, row), list(turned[row.of])))
        return found

    def reached_rows(self, table: Place, V_dot: Place) -> list[Expr]:
        """S V*: one a row."""
        found: list[Expr] = []
        for row in self.task.rows:
            if not row.of:
                found.append(V_dot[COMPONENTS.index(row.component)])
                continue
            axis, six = self.axis(table, row), list(V_dot)
            turning = _dot(self._arm(table, row) if _linear(row) else axis, six[3:])
            found.append(_dot(axis, six[:3]) + turning if _linear(row) else turning)
        return found

    def residual(self, body: Body, given: Mapping[str, Place], V_dot: Place, use: Place) -> Place:
        """Demand minus reached (m), 0 of a free row; `given`: table, x, demand."""
        table, demand = given["table"], given["demand"]
        residual = body.local("residual", (len(self),))
        pairs = zip(self.known_terms(body, table, given["x"].V), self.reached_rows(table, V_dot), strict=True)
        for j, (known, reached) in enumerate(pairs):
            missing = demand[j] - reached - known if self.task.rows[j].of else demand[j] - reached
            left = body.let(f"left_{j + 1}", missing)
            body.set(residual[j], select(use[j] > 0, left, real(0)))
        return residual

    def turning_demand(self, table: Place, demand: Place) -> list[Expr]:
        """omega* (3, in E1) of all three rows of turning in one set of axes."""
        found: list[Expr | None] = [None, None, None]
        for j, row in enumerate(self.task.rows):
            axis = self.axis(table, row) if row.of else None
            for i in range(3):
                if axis is not None:
                    term = axis[i] * demand[j]
                    known = found[i]
                    found[i] = term if known is None else known + term
                elif i == _place(row):
                    found[i] = demand[j]
        return [each for each in found if each is not None]


def _place(row: TaskRow) -> int:
    return COMPONENTS.index(row.component) % 3


def _linear(row: TaskRow) -> bool:
    return row.component.startswith("v")


def _dot(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
