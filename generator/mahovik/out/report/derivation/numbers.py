"""The numbers of a stand as the derivation names them: mass matrix, and each flywheel's harmonics.

They are those of the emitted table: computed by the interpreter of the same `prepare`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from mahovik.core.derive import accumulate, carrier, flywheel
from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.derive.symbols import vector
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import Values
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.hold import twists, words
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.core.stand.structure import structure

COLUMNS = {
    "mu_0": 3,
    "J_0": 6,
    "mu_c": 3,
    "mu_s": 3,
    "J_c": 6,
    "J_s": 6,
    "J_2c": 6,
    "J_2s": 6,
    "t_0": 3,
    "t_c": 3,
    "t_s": 3,
}
"""Columns of a row with their lengths; those of 0 are summed over all bodies in the emitted table."""


@dataclass(frozen=True)
class Quantity:
    """Fourier polynomials of one kind: `rows` hold the coefficients of 1, cos, sin, cos 2phi, sin 2phi.

    What is below `noise` is rounding.
    """

    labels: tuple[str, ...]
    unit: str
    rows: tuple[tuple[float, ...], ...]
    noise: float

    @property
    def labelled_rows(self) -> list[tuple[str, tuple[float, ...]]]:
        """Rows with their labels."""
        return list(zip(self.labels, self.rows, strict=True))


@dataclass(frozen=True)
class FlywheelNumbers:
    """One flywheel in E1 about O1: what it adds to K, K*, I, J of (8)."""

    name: str
    mount: str
    mass: float
    spin: float
    quantities: tuple[Quantity, ...]


@dataclass(frozen=True)
class HoldNumbers:
    """How a held carrier moves: S (6 rows of m), and S^T K S (m rows) at phi = 0; what is below the noise is rounding.

    words  how it can move, in a line
    """

    words: str
    S: tuple[tuple[float, ...], ...]
    mass: tuple[tuple[float, ...], ...]
    S_noise: tuple[tuple[float, ...], ...]
    mass_noise: tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class StandNumbers:
    """Constant part of K, K at phi = 0, the flywheels, and the hold; None of a free carrier."""

    mass: float
    K_constant: tuple[tuple[float, ...], ...]
    K_at_zero: tuple[tuple[float, ...], ...]
    noise: tuple[tuple[float, ...], ...]
    flywheels: tuple[FlywheelNumbers, ...]
    hold: HoldNumbers | None = None


KG_M, KG_M2 = '`"kg m"`', '`"kg m"^2`'
ROUNDING = 1e-14
"""Part of the natural size of its kind below which a number is rounding."""


def numbers(stand: Stand) -> StandNumbers:
    """All numbers of a stand. Raises StandError where its masses are refused."""
    layout = Layout(structure(stand), DOUBLE)
    program = lower_layout(layout)
    values = Values(stand, layout, program)
    table, running = values.table, Interpreter(program)
    rows = table.get("flywheel", [])
    constant = {name: table[name] for name in ("mass", "first_moment", "inertia")}
    at_zero = dict(constant)
    for row in rows:
        at_zero["first_moment"] = np.add(at_zero["first_moment"], row["mu_c"])
        at_zero["inertia"] = np.add(at_zero["inertia"], np.add(row["J_c"], row["J_2c"]))
    K = _mass_matrix(constant | {k: table[k] for k in ("A", "G") if k in table})
    K_zero = _mass_matrix(at_zero | {k: table[k] for k in ("A", "G") if k in table})
    generic = _Generic() if rows else None
    found: list[FlywheelNumbers] = []
    for s, row in zip(stand.flywheels, rows, strict=True):
        assert generic is not None
        own = values.parameters["flywheel"][len(found)]
        columns = row | _constant_part(running, values.parameters, own, generic)
        found.append(_flywheel(s, columns, generic))
    return StandNumbers(
        float(table["mass"]), _rows(K), _rows(K_zero), _rows(_noise(K)), tuple(found), _hold(stand, K_zero)
    )


def _hold(stand: Stand, K: Any) -> HoldNumbers | None:
    """S and the mass matrix of the freedoms of a held carrier."""
    if stand.hold is None:
        return None
    S = twists(stand.hold)
    size = np.abs(S).T @ np.abs(K) @ np.abs(S)
    return HoldNumbers(
        words(stand.hold), _rows(S), _rows(S.T @ K @ S), _rows(np.zeros(S.shape)), _rows(ROUNDING * size)
    )


def _rows(matrix: Any) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(float(x) for x in row) for row in matrix)


def _mass_matrix(given: Mapping[str, Any]) -> Any:
    """K of (2) filled with numbers."""
    known: dict[sp.Symbol, float] = {sp.Symbol("m"): given["mass"]}
    names = {"mu": "first_moment", "J": "inertia", "A": "A", "G": "G"}
    for name, key in names.items():
        known |= {sp.Symbol(f"{name}[{i}]"): float(x) for i, x in enumerate(given.get(key, ()))}
    K = carrier.mass_matrix("A" in given)
    return np.array(K.xreplace(known).tolist(), dtype=float)


def _noise(K: Any) -> Any:
    """Rounding of each entry of K: masses by the largest mass, moments of inertia by the largest, kg m in between."""
    mass, inertia = np.abs(K[:3, :3]).max(), np.abs(K[3:, 3:]).max()
    size = np.repeat([np.sqrt(mass), np.sqrt(inertia)], 3)
    return ROUNDING * np.outer(size, size)


class _Generic:
    """Expressions of the derivation as functions of numbers, made once for all flywheels."""

    def __init__(self) -> None:
        w = flywheel.generic()
        constant = flywheel.spun_inertia(w)["0"]
        self.half = sp.lambdify([list(w.b), list(vector("J", 6))], list(constant.b) + list(constant.J), "numpy")
        columns, sums, weights = accumulate.columns(), accumulate.sums(), accumulate.weights()
        rate = {
            sp.Symbol(n): x.subs(sp.Symbol("phi_dot"), 1) for n, x in weights.items() if n[0] == "d" and n[1] != "d"
        }
        moment = [f"_{{{i + 1}{j + 1}}}" for i, j in SYMMETRIC]
        self.quantities = (
            (tuple(f"mu_{i}(phi)" for i in (1, 2, 3)), KG_M, vector("mu_0") + sums.mu),
            (tuple(f"J{n}(phi)" for n in moment), KG_M2, vector("J_0", 6) + sums.J),
            (tuple(f"J'{n}(phi)" for n in moment), KG_M2, sums.J_dot.xreplace(rate)),
            (tuple(f"I_{i}(phi)" for i in (1, 2, 3)), KG_M, columns.I[:3, :]),
            (tuple(f"I_{i}(phi)" for i in (4, 5, 6)), KG_M2, columns.I[3:, :]),
            (tuple(f"I'_{i}(phi)" for i in (1, 2, 3)), KG_M, columns.I_prime[:3, :]),
            (tuple(f"I'_{i}(phi)" for i in (4, 5, 6)), KG_M2, columns.I_prime[3:, :]),
        )
        arguments = [list(vector(name, size)) for name, size in COLUMNS.items()]
        together = sp.Matrix.vstack(*(_coefficients(q[2]) for q in self.quantities))
        self.coefficients = sp.lambdify(arguments, together.tolist(), "numpy")


def _coefficients(polynomials: sp.Matrix) -> sp.Matrix:
    """A row of coefficients of 1, c, s, c2, s2 for each element, which is linear in these."""
    weights = sp.symbols("c s c2 s2")
    constant = polynomials.xreplace(dict.fromkeys(weights, sp.S.Zero))
    return sp.Matrix.hstack(constant, *(polynomials.diff(w) for w in weights))


def _constant_part(running: Interpreter, parameters: Any, own: Any, generic: _Generic) -> dict[str, Sequence[float]]:
    """Harmonic 0 of one flywheel in E1, which the emitted table holds in sums only."""
    _, place = running.run("place_flywheel", {"parameters": parameters, "w": own})
    body = own["body"]
    first_moment = [body["mass"] * x for x in body["center_of_mass"]]
    six = generic.half(first_moment, body["inertia"])
    given = {"m": body["mass"], "b": six[:3], "J": six[3:], "O": place["O"], "R": place["R"]}
    _, carried = running.run("carry", given)
    return {"mu_0": carried["mu"], "J_0": carried["J1"]}


def _flywheel(s: Flywheel, columns: Mapping[str, Any], generic: _Generic) -> FlywheelNumbers:
    every = generic.coefficients(*(columns[name] for name in COLUMNS))
    largest = dict.fromkeys((KG_M, KG_M2), 0.0)
    parts, at = [], 0
    for labels, unit, _ in generic.quantities:
        rows = _rows(every[at : at + len(labels)])
        at += len(labels)
        largest[unit] = max(largest[unit], *(abs(x) for row in rows for x in row))
        parts.append((labels, unit, rows))
    largest[KG_M] = max(largest[KG_M], float(np.sqrt(s.mass * largest[KG_M2])))
    quantities = tuple(Quantity(labels, unit, rows, ROUNDING * largest[unit]) for labels, unit, rows in parts)
    return FlywheelNumbers(s.name, s.mount, s.mass, float(columns["spin"]), quantities)
