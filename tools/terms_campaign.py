"""Plant one to four wrong terms in the literal equations of random stands, ask for them, write docs/results/terms.md.

python tools/terms_campaign.py [--stands 40] [--first 1] [--jobs 2] [--write]

Exit status 1 where a set is not found whole, a term is named that was not planted, or a search takes over a minute.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures

from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.random import EVERYTHING, SEQUENCES, random_stand
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.monomials import Motion, monomials
from mahovik.proof.diagnose.terms.search import TermSearch
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.screw import Phi
from mahovik.proof.verify.states import Request

COUNTS = (1, 2, 3, 2)
"""Flywheels of the stands, in turn."""

SECONDS = 60.0
"""Limit of a search, questions included."""

KINDS = ("sign", "factor", "missing", "index")
PLACES = ("Phi Theta_1 V", "Phi Lambda V", "weight", "Theta_1", "Lambda", "I phi''")
"""Matrices of the literal equations in one of whose elements a term is wrong."""


@dataclass(frozen=True)
class Plant:
    """A wrong term: element (row, inner, column) of a product, what is wrong with it, and its factor or index."""

    place: str
    kind: str
    row: int
    inner: int
    column: int
    factor: float
    other: int

    def wrench(self, at: Pieces, phi_ddot: Array, V_r_dot: Array) -> Array:
        """Error (6; N, N m) of the right-hand side of K V_r* = ... at a state."""
        found = np.zeros(6)
        right, wrong = (self._element(at, phi_ddot, V_r_dot, k) for k in (self.column, self.other))
        found[self.row] = wrong - right if self.kind == "index" else (self.factor - 1.0) * right
        return found

    def _element(self, at: Pieces, phi_ddot: Array, V_r_dot: Array, column: int) -> float:
        """The product as it is in the right-hand side, with the velocity, acceleration or wheel of that index."""
        i, a, b = self.row, self.inner, self.column
        Theta, V = at.fixed[0].Theta, at.V_r
        if self.place in ("Phi Theta_1 V", "Phi Lambda V"):
            of = Theta if self.place == "Phi Theta_1 V" else at.Lambda
            return float(-Phi(V)[i, a] * of[a, b] * V[column])
        if self.place == "weight":
            return float(at.fixed[0].body.mass * at.gravity[column % 3] if i < 3 else 0.0)
        if self.place in ("Theta_1", "Lambda"):
            of = Theta if self.place == "Theta_1" else at.Lambda
            return float(-of[i, b] * V_r_dot[column])
        return float(-at.I[i, b % at.I.shape[1]] * phi_ddot[column % at.I.shape[1]])


def plants(stand: Stand, rng: np.random.Generator) -> list[Plant]:
    """One to four wrong terms that have an effect; each in an element of its own."""
    states = [request.state for request in TermSearch(stand, 99, ("forward",)).requests[:3]]
    pieces = [reference.pieces(stand, state) for state in states]
    found: list[Plant] = []
    for _ in range(int(rng.integers(1, 5))):
        while True:
            place, kind = PLACES[rng.integers(len(PLACES))], KINDS[rng.integers(len(KINDS))]
            row, inner, column, other = (int(x) for x in rng.integers(0, 6, 4))
            factor = {"sign": -1.0, "missing": 0.0}.get(kind, float(rng.choice([0.5, 2.0, 1.3])))
            one = Plant(place, kind, row, inner, column, factor, other)
            sizes = [
                float(np.abs(one.wrench(at, np.array(s.phi_ddot), np.array(s.V_dot))).max())
                for s, at in zip(states, pieces, strict=True)
            ]
            known = any((x.place, x.row, x.column) == (place, row, column) for x in found)
            if min(sizes) > 1e-6 and not known:
                found.append(one)
                break
    return found


def examine(seed: int) -> dict[str, Any]:
    """Plant a set in the stand of that seed, and look for it."""
    rng = np.random.default_rng(seed)
    features = replace(EVERYTHING, angles=SEQUENCES[seed % 3])
    stand = random_stand(rng, COUNTS[seed % len(COUNTS)], features, f"random{seed}")
    planted = plants(stand, rng)

    def motion(request: Request) -> tuple[Pieces, Array, Array]:
        """Pieces, V_r_dot of the wrong program, error of its right-hand side."""
        at, phi_ddot = reference.pieces(stand, request.state), np.array(request.state.phi_ddot)
        right = at.F - bias(at) - at.I @ phi_ddot
        K = at.K.copy()
        for one in planted:
            if one.place in ("Theta_1", "Lambda"):
                for column in range(6):
                    unit = np.eye(6)[column]
                    K[:, column] -= one.wrench(at, phi_ddot, unit)
            else:
                right = right + one.wrench(at, phi_ddot, np.zeros(6))
        V_r_dot = np.linalg.solve(K, right)
        return at, V_r_dot, at.K @ V_r_dot - (at.F - bias(at) - at.I @ phi_ddot)

    def answer(request: Request) -> Mapping[str, Any]:
        at, V_r_dot, _ = motion(request)
        return {"V_dot": at.V_dot(V_r_dot).tolist()}

    begin = time.perf_counter()
    found = TermSearch(stand, seed, ("forward",)).find(answer)
    seconds = time.perf_counter() - begin
    fresh = TermSearch(stand, seed + 1000, ("forward",)).requests[:50]
    off = _unexplained_part(stand, [motion(each) for each in fresh], fresh, found.terms)
    return {
        "stand": stand.name,
        "flywheels": len(stand.flywheels),
        "planted": ", ".join(f"{x.kind} in {x.place}, {WRENCH_LETTERS[x.row]}" for x in planted),
        "named": "; ".join(f"{x.component}: {x.term}" for x in found.terms),
        "unexplained": max(found.unexplained, off),
        "seconds": seconds,
        "found": found.whole and off < 1e-6,
        "false": sum(x.component not in {WRENCH_LETTERS[p.row] for p in planted} for x in found.terms),
    }


def _unexplained_part(stand: Stand, moves: Any, requests: Any, terms: Any) -> float:
    """Part of the error at states that were not asked for which the named terms do not explain."""
    states = [request.state for request in requests]
    motion = Motion.of(states, [at for at, _, _ in moves], np.array([x for _, x, _ in moves]))
    values = {each.term: each.values for each in monomials(stand, motion)}
    error = np.array([e for _, _, e in moves])
    rest = error.copy()
    for each in terms:
        rest[:, WRENCH_LETTERS.index(each.component)] -= each.error * values[each.term]
    return float(np.linalg.norm(rest) / np.linalg.norm(error))


TABLE = Columns(
    {
        "stand": "{}", "planted": "{}", "named": "{}", "flywheels": "{:,}", "unexplained": "{:.0e}", "s": "{:.1f}",
        "found": lambda found: "yes" if found else "no",
    },
    3,
)  # fmt: skip


def figures(rows: list[dict[str, Any]]) -> Figures:
    """The figures to keep."""
    table = [
        [r["stand"], r["planted"], r["named"], r["flywheels"], r["unexplained"], r["seconds"], r["found"]] for r in rows
    ]
    return {"rows": TABLE.rows(table), "false": sum(r["false"] for r in rows)}


def page(found: Figures) -> str:
    """The table, and how many were found."""
    rows = found["rows"]
    whole, slowest = sum(row["found"] for row in rows), max(row["s"] for row in rows)
    return (
        f"{whole} of {len(rows)} sets of one to four wrong terms were found whole: the terms that were named are the "
        f"error at fifty other states as well. Names in components where nothing was planted: {found['false']}. The "
        f"slowest search took {slowest:.0f} s, its questions included (limit: {SECONDS:.0f} s).\n\n{TABLE.text(rows)}"
    )


CAMPAIGN = Campaign(
    "terms",
    campaign.Block("docs/results/terms.md", "terms"),
    page,
)


def main() -> None:
    """Plants, looks, prints; keeps the figures with --write."""
    given = campaign.parser(__doc__, stands=40, first=1, jobs=2, write=False).parse_args()
    rows = list(campaign.map_rows(examine, given.jobs, campaign.seeds(given.first, given.stands)))
    for row in rows:
        print(row["stand"], row["planted"], "->", row["named"], f"{row['unexplained']:.0e} {row['seconds']:.1f} s")
    if given.write:
        CAMPAIGN.keep(figures(rows), given.first)
    slow = any(row["seconds"] > SECONDS for row in rows)
    raise SystemExit(int(slow or any(row["false"] or not row["found"] for row in rows)))


if __name__ == "__main__":
    main()
