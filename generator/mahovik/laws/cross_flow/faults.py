"""Parts and coefficients of cross-flow drag, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.proof.diagnose.terms.law_term import BodyFaults, LawTerm
from mahovik.proof.reference.array import Array

PATH = "cross_flow"

PLANES = (("v", "x r", "drag_y"), ("w", "x q", "drag_z"))
"""Velocities across, at the origin and by turning, and the coefficients of the drag that they alone would have."""


def law_terms(bodies: Sequence[Body], V_r: Array) -> list[LawTerm]:
    """From coarse to fine: the force of a direction, its parts by velocity, by table, by both, by station.

    Parts by velocity are linear in the direction of the drag, so that an arm of the wrong sign shows in one of them.
    """
    law = bodies[0].law(CrossFlow)
    return [] if law is None else list(_Strips(law, V_r).terms())


class _Strips:
    """The strips of a law at n states."""

    def __init__(self, law: CrossFlow, V_r: Array) -> None:
        self._law = law
        nodes, weights = np.polynomial.legendre.leggauss(law.points)
        self._x = np.concatenate([(a + b) / 2 + (b - a) / 2 * nodes for a, b in pairwise(law.x)])
        self._dx = np.concatenate([(b - a) / 2 * weights for a, b in pairwise(law.x)])
        self._size = {
            "drag_y": np.interp(self._x, law.x, law.height),
            "drag_z": np.interp(self._x, law.x, law.breadth),
        }
        v, w, q, r = (V_r[:, [i]] for i in (1, 2, 4, 5))
        one = np.ones_like(self._x)
        self._parts = {"v": v * one, "x r": r * self._x, "w": w * one, "x q": -q * self._x}
        self._across = {
            "drag_y": self._parts["v"] + self._parts["x r"],
            "drag_z": self._parts["w"] + self._parts["x q"],
        }

    def terms(self) -> Iterator[LawTerm]:
        """Parts of all details."""
        law = self._law
        tables = {"drag_y": law.drag_y, "drag_z": law.drag_z}
        of_stations = {key: np.eye(len(law.x)) for key in tables}
        for still, turning, own in PLANES:
            sums = {still: f"{still}", turning: f"{turning}"}
            both = (still, turning)
            acting = tuple(tables) if law.together else (own,)
            whole = f"({still} + {turning})" if still == "v" else f"({still} - {turning})"
            yield LawTerm(0, f"cross flow {whole}", PATH, 1.0, self._wrench(own, both, {k: tables[k] for k in acting}))
            for part in both:
                wrench = self._wrench(own, (part,), {k: tables[k] for k in acting})
                yield LawTerm(1, f"cross flow {sums[part]}", PATH, 1.0, wrench)
            for key in acting:
                wrench = self._wrench(own, both, {key: tables[key]})
                yield LawTerm(2, f"cross flow {whole} of {key}", f"{PATH}.{key}", 1.0, wrench)
                for part in both:
                    wrench = self._wrench(own, (part,), {key: tables[key]})
                    yield LawTerm(3, f"cross flow {sums[part]} of {key}", f"{PATH}.{key}", 1.0, wrench)
                for k, station in enumerate(of_stations[key]):
                    wrench = self._wrench(own, both, {key: station})
                    path = f"{PATH}.{key}[{k}]"
                    yield LawTerm(4, f"cross flow {whole} at {law.x[k]:.3g} m", path, float(tables[key][k]), wrench)

    def _wrench(self, own: str, parts: Sequence[str], tables: dict[str, Sequence[float] | Array]) -> Array:
        """Wrench (n, 6) along the direction of `own` by some parts of its velocity and some tables."""
        law = self._law
        speed = np.hypot(*self._across.values()) if law.together else np.abs(self._across[own])
        drag = sum(
            np.interp(self._x, law.x, table) * self._size[key] * self._across[key] ** 2 for key, table in tables.items()
        )
        along = sum(self._parts[part] for part in parts)
        force = np.divide(drag * along, speed, out=np.zeros_like(speed), where=speed > 0.0)
        found = np.zeros((len(force), 6))
        i, arm, sign = (1, 5, 1.0) if own == "drag_y" else (2, 4, -1.0)
        found[:, i] = -law.density / 2 * force @ self._dx
        found[:, arm] = -sign * law.density / 2 * force @ (self._dx * self._x)
        return found


LAW = BodyFaults("cross-flow drag", law_terms)
