"""Derivatives of the equations by the phase and the speed of each flywheel, of free and held carriers alike."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mahovik.core.derive.order import WEIGHTS
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import sensitivity as derived
from mahovik.core.lower.flywheels import Turns, along, columns_of, let_turn, let_weights, named_turns
from mahovik.core.lower.forward import Scene
from mahovik.core.lower.library import Library
from mahovik.core.lower.sensitivity import set_weights
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, equal, integer, real, select
from mahovik.core.program.types import NamedCount


def own_change(
    lib: Library,
    body: Body,
    table: Place,
    x: Place,
    seen: Scene,
    wrench: tuple[Argument, ...],
    s: Place,
    rhs: Place,
    by: str,
) -> Place | None:
    """Adds the change of flywheel s's own wrench with its phase or speed to rhs; returns its change about the axis."""
    layout, name = lib.layout, f"own_wrench_by_{by}"
    if name not in lib:
        return None
    own = body.local("own_change", (6 * int(layout.count),), comment="change of the flywheels' own wrenches")
    with body.loop("k", len(layout.own)) as k, body.when(equal(table.frame[k].flywheel, s)):
        named: dict[str, Any] = {"table": table, "frame": table.frame[k], "x": x, "V": seen.V, "d_F": rhs, "d_own": own}
        named |= named_turns(seen.turns) | {w.name: w.place for w in wrench}
        body.call(lib[name], *lib.arguments_of(name, **named))
    return own[s * integer(6) + 3]


def row_weights(body: Body, x: Place, turns: Turns, s: Place, acceleration: Expr) -> dict[str, Expr]:
    """All weights of row s by name."""
    given = let_turn(body, turns, s)
    given |= {"phi_dot": x.phi_dot[s], "phi_ddot": acceleration}
    return let_weights(body, given, ("c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds"))


def change_of_row(
    lib: Library,
    body: Body,
    row: Place,
    by: dict[str, Any],
    weights: dict[str, Expr],
    changes: Place,
    seen: Scene,
    V_dot: Place,
    rhs: Place,
) -> None:
    """Set rhs to the change of what is left of (8) with the phase or speed of a row, by its weights' derivatives."""
    set_weights(body, changes, by, weights)
    named = {"row": row, "weight": changes, "V": seen.V, "V_dot": V_dot, "g": seen.g, "out": rhs}
    body.call(lib["row_slope"], *lib.arguments_of("row_slope", **named))


def torque_slope(
    lib: Library,
    body: Body,
    row: Place,
    weights: dict[str, Expr],
    seen: Scene,
    origin_acceleration: Place,
    motion: Place,
) -> Expr:
    """Slope of the drive torque by phi alone: dI/dphi . V* + mu'' . origin_acceleration - omega . J'' omega / 2."""
    mu_pp, J_pp = derived.second_phase_derivatives()
    binding: dict[str, Any] = weights | columns_of(row)
    second = body.local("mu_pp", (3,), comment="d2 mu / dphi2")
    tensor = body.local("J_pp", (6,), comment="d2 J / dphi2")
    column = body.local("I_p", (6,), comment="dI / dphi")
    assign(body, list(second), mu_pp, binding)
    assign(body, list(tensor), J_pp, binding)
    assign(body, list(column), derived_rows.columns().I_prime, binding)
    bound = parts_of_twist(seen.V) | {"J_pp": tensor, "mu_pp": second, "origin_acceleration": origin_acceleration}
    total = along(list(column), motion) + translate(derived.bias_by_phase(), bound)
    if lib.layout.flywheel_displaces:
        assert seen.g is not None
        for i in range(3):
            sunk = row.displaced_c[i] * weights["c"] + row.displaced_s[i] * weights["s"]
            total = total - sunk * seen.g[i]
    return total


class Sides(ABC):
    """Right-hand sides of the coupled equations, and their solution into columns of the derivatives.

    change     change of the wrench on the carrier (6)
    drive_rhs  right-hand sides of the drives (N)
    """

    body: Body
    count: NamedCount
    change: Place
    drive_rhs: Place

    def write(self, o: Place, name: str, column: Place) -> None:
        """Solve with the right-hand sides of all flywheels, and write a column of the derivatives by `name`."""
        with self.body.loop("t", self.count) as t:
            self.reduce(t, self.drive_rhs[t])
        self.solve(o, name, column, lambda t: self.drive_rhs[t])

    def write_alone(self, o: Place, name: str, s: Place, side: Expr | None) -> None:
        """Likewise column s, where the right-hand side of flywheel s alone is not zero; None: nor is this one."""
        if side is None:
            self.solve(o, name, s, lambda t: real(0))
            return
        alone = self.body.let("side", side)
        self.reduce(s, alone)
        self.solve(o, name, s, lambda t: select(equal(t, s), alone, real(0)))

    @abstractmethod
    def take_change(self) -> None:
        """Make the change of the wrench the right-hand side of the carrier."""

    @abstractmethod
    def clear_carrier(self) -> None:
        """Set the right-hand side of the carrier to zero."""

    @abstractmethod
    def reduce(self, t: Place, side: Expr) -> None:
        """Take the share of flywheel t, by its right-hand side, from that of the carrier; of a locked one nothing."""

    @abstractmethod
    def solve(self, o: Place, name: str, column: Place, side: Callable[[Place], Expr]) -> None:
        """Write the solution of the reduced right-hand side; `side`: right-hand side of a flywheel."""


@dataclass(frozen=True)
class CoupledMotion:
    """What derivatives by phases, speeds and torques start from: arguments, sums, V_r* and phi'' of the motion."""

    table: Place
    x: Place
    wrench: tuple[Argument, ...]
    seen: Scene
    V_dot: Place
    phi_ddot: Place
    origin_acceleration: Place


def by_flywheels(lib: Library, body: Body, at: CoupledMotion, o: Place, sides: Sides) -> None:
    """Derivatives of coupled by phi, phi' and tau, flywheel by flywheel."""
    table, x, seen = at.table, at.x, at.seen
    changes = body.local("change", (len(WEIGHTS),), comment="changes of the harmonic weights of a flywheel")
    with body.loop("s", lib.layout.count) as s:
        row = table.flywheel[s]
        weights = row_weights(body, x, seen.turns, s, at.phi_ddot[s])
        for name, by in (("phi", derived.by_phase()), ("phi_dot", derived.by_speed())):
            with body.block():
                change_of_row(lib, body, row, by, weights, changes, seen, at.V_dot, sides.change)
                side: Expr | None = own_change(lib, body, table, x, seen, at.wrench, s, sides.change, name)
                sides.take_change()
                if name == "phi":
                    slope = torque_slope(lib, body, row, weights, seen, at.origin_acceleration, at.V_dot)
                    side = -slope if side is None else -slope + side
                sides.write_alone(o, name, s, side)
        sides.clear_carrier()
        sides.write_alone(o, "tau", s, real(1))
