"""(12) and (13) at one node as CasADi expressions of angle, speed, control, with the coefficients as parameters.

Masses and mountings do not appear: `plan.residual` gives the coefficients as numbers. The unit of time is 1/Omega,
with Omega the frequency of the motion: v = phi'/Omega, a = phi''/Omega^2; rows of (12) are scaled like the norm of
residuals, torques are tau / (J_s Omega^2). Flywheels stand in the order (-, +) of (13).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca

from mahovik.use.plan.objective import KINDS

HARMONICS, ROWS = 5, 7
"""Harmonics 1, cos, sin, cos 2, sin 2 of an angle; six rows of a wrench and one of the torque."""


@dataclass(frozen=True)
class Layout:
    """Names and sizes of the parameters: those of a node, and those of the stand with its objective."""

    N: int

    @property
    def node_shapes(self) -> dict[str, tuple[int, ...]]:
        """Parameters of a node: coefficients of (12) (see plan.residual.prescribed), and derivatives by the bias."""
        table = (HARMONICS, ROWS, self.N)
        return {"base": (6,), "fixed": table, "moving": table, "by_bias": (6, 6), "tau_by_bias": (self.N, 6)}

    @property
    def stand_parameters(self) -> dict[str, tuple[int, ...]]:
        """Parameters of all nodes: tables, scales of the columns of I, weights by kind, mean speeds, motors."""
        table = (HARMONICS, ROWS, self.N)
        return {
            "still": table,
            "spun": table,
            "column": (self.N,),
            "weights": (len(KINDS), self.N),
            "mean_speed": (self.N,),
            "loss": (self.N,),
            "viscous": (self.N,),
            "coulomb": (self.N,),
            "coulomb_speed": (self.N,),
        }


def size(shape: tuple[int, ...]) -> int:
    """Count of numbers in a table."""
    n = 1
    for each in shape:
        n *= each
    return n


def _named_pieces(vector: Any, shapes: dict[str, tuple[int, ...]]) -> dict[str, Any]:
    """Pieces of a parameter vector by name, each a function of its indices."""
    found, at = {}, 0
    for name, shape in shapes.items():
        found[name] = _Table(vector, at, shape)
        at += size(shape)
    return found


@dataclass(frozen=True, eq=False)
class _Table:
    """A table of symbols, stored row by row in a vector."""

    vector: Any
    first: int
    shape: tuple[int, ...]

    def __getitem__(self, index: tuple[int, ...] | int) -> Any:
        place = 0
        for i, n in zip(index if isinstance(index, tuple) else (index,), self.shape, strict=True):
            place = place * n + i
        return self.vector[self.first + place]


@dataclass(frozen=True, eq=False)
class _Wrenches:
    """I (6, N) by columns, P - J phi' (6), the part of tau without acceleration, and its factor of acceleration (N)."""

    I: Any
    rest: Any
    tau: Any
    tau_by_a: Any


def _wrenches(N: int, phi: Any, v: Any, bias: Any, at: dict[str, Any], own: dict[str, Any]) -> _Wrenches:
    I = ca.SX(6, N)
    rest = ca.vertcat(*(at["base"][i] + sum(at["by_bias"][i, b] * bias[b] for b in range(6)) for i in range(6)))
    tau, tau_by_a = ca.SX(N, 1), ca.SX(N, 1)
    for s in range(N):
        c, d = ca.cos(phi[s]), ca.sin(phi[s])
        waves = (1.0, c, d, 1.0 - 2.0 * d * d, 2.0 * c * d)
        for row in range(ROWS):
            of_a = sum(h * own["still"][k, row, s] for k, h in enumerate(waves))
            others = sum(
                h * (at["fixed"][k, row, s] + v[s] * (at["moving"][k, row, s] + v[s] * own["spun"][k, row, s]))
                for k, h in enumerate(waves)
            )
            if row < 6:
                I[row, s] = of_a
                rest[row] -= others
            else:
                tau_by_a[s] = of_a
                tau[s] = others + sum(at["tau_by_bias"][s, b] * bias[b] for b in range(6))
    return _Wrenches(I, rest, tau, tau_by_a)


def _cost(N: int, v: Any, a: Any, tau: Any, own: dict[str, Any]) -> Any:
    """J(x, u) of (13) at a node: the rows of `plan.objective`, squared and weighted."""
    total = 0.0
    for s in range(N):
        given = tau[s] + own["viscous"][s] * v[s] + own["coulomb"][s] * ca.tanh(v[s] / own["coulomb_speed"][s])
        rows = {
            "acceleration": a[s],
            "torque": tau[s],
            "speed_variation": v[s] - own["mean_speed"][s],
            "power": own["loss"][s] * given**2 + given * v[s],
        }
        total += sum(own["weights"][k, s] * rows[kind] ** 2 for k, kind in enumerate(KINDS))
    return total


@dataclass(frozen=True, eq=False)
class Node:
    """(12) and (13) at one node, with derivatives by z = (x, u, bias); x = (phi, v) (2N), node and stand: Layout.

    u       controls: a_- (N - 6) in the partition, else all a (N); bias (6): its change
    value   (z, node, stand) -> (y, cost); y: a_+ (6) and |det I+| of scaled columns (1), or R (6) of (12); tau (N)
    slope   (z, node, stand) -> (dy/dz, dcost/dz), dense
    bend    (z, node, stand, by y, by cost) -> second derivatives of by_y . y + by_cost cost, dense
    """

    N: int
    controls: int
    value: Any
    slope: Any
    bend: Any

    @property
    def unknowns(self) -> int:
        """Number of unknowns of one node, including the bias."""
        return 2 * self.N + self.controls + 6


def node_functions(N: int, partition: bool, torque: bool) -> Node:
    """Functions of a node; in the partition a_+ = I+^-1 (P - I- u - J phi') of (13). `torque`: y includes tau."""
    layout, controls = Layout(N), N - 6 if partition else N
    z = ca.SX.sym("z", 2 * N + controls + 6)
    node = ca.SX.sym("node", sum(size(shape) for shape in layout.node_shapes.values()))
    stand = ca.SX.sym("stand", sum(size(shape) for shape in layout.stand_parameters.values()))
    at, own = _named_pieces(node, layout.node_shapes), _named_pieces(stand, layout.stand_parameters)
    phi, v, u, bias = z[:N], z[N : 2 * N], z[2 * N : -6], z[-6:]
    found = _wrenches(N, phi, v, bias, at, own)
    if partition:
        column = ca.vertcat(*(own["column"][s] for s in range(N - 6, N)))
        Q, triangle = ca.qr(found.I[:, N - 6 :] / ca.repmat(column.T, 6, 1))  # no pivoting: valid for every angle
        left = found.rest - ca.mtimes(found.I[:, : N - 6], u) if N > 6 else found.rest
        dependent = ca.solve(triangle, ca.mtimes(Q.T, left)) / column
        volume = 1.0
        for i in range(6):
            volume *= triangle[i, i]
        a, rows = ca.vertcat(u, dependent), [dependent, ca.fabs(volume)]
    else:
        a, rows = u, [found.rest - ca.mtimes(found.I, u)]
    tau = found.tau + found.tau_by_a * a
    y, cost = ca.vertcat(*rows, *([tau] if torque else [])), _cost(N, v, a, tau, own)
    by_y, by_cost = ca.SX.sym("by_y", y.numel()), ca.SX.sym("by_cost")
    bend, _ = ca.hessian(ca.dot(by_y, y) + by_cost * cost, z)
    given = [z, node, stand]
    return Node(
        N,
        controls,
        ca.Function("value", given, [y, cost]),
        ca.Function("slope", given, [ca.densify(ca.jacobian(y, z)), ca.densify(ca.jacobian(cost, z))]),
        ca.Function("bend", [*given, by_y, by_cost], [ca.densify(bend)]),
    )
