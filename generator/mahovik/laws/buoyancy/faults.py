"""Faults in buoyancy, (7)."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.proof.diagnose.edits import minus, without_moment, wrench, zero
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import force_at


def not_turned(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """Buoyancy (6) with its force in E0 taken as one of the body's frame, at the centre of buoyancy."""
    found = k.body.law(Buoyancy)
    if found is None:
        return P
    return force_at(-found.displaced_mass * (at.C @ at.gravity), np.array(found.center))


# fmt: off
FAULTS = (
    Fault("buoyancy at O1", "(7)", "all", [wrench(without_moment, "buoyancy")],
          "Buoyancy acts at the origin of the body (O1 of the carrier), not at the centre of buoyancy",
          "`center` of `buoyancy`"),
    Fault("buoyancy at the centre of mass", "(7)", "all",
          [wrench(lambda P, k, at: force_at(P[:3], np.array(k.body.center_of_mass)), "buoyancy")],
          "Buoyancy acts at the centre of mass, not at the centre of buoyancy",
          "`center` of `buoyancy`: the righting moment comes from the two centres being apart"),
    Fault("buoyancy not turned", "(7)", "all", [wrench(not_turned, "buoyancy")],
          "Buoyancy is not turned into the axes of the body: its vector in E0 is applied as one of the body",
          "C^T before the force; its moment is of the turned force"),
    Fault("buoyancy, sign", "(7)", "all", [wrench(minus, "buoyancy")],
          "Buoyancy pulls down",
          "-displaced_mass g"),
    Fault("buoyancy missing", "(7)", "all", [wrench(zero, "buoyancy")],
          "Buoyancy is missing",
          "`buoyancy` of carrier, instruments, flywheels"),
)
# fmt: on


def coefficients(body: Body, g: float) -> dict[str, float]:
    """Buoyancy of a body, N, and its moments about the origin, N m, by name, under gravity g (m/s2)."""
    found = body.law(Buoyancy)
    if found is None:
        return {}
    B = found.displaced_mass * g
    return {"B": B} | {f"B {axis}_B": B * x for axis, x in zip("xyz", found.center, strict=True)}
