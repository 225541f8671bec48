"""Conditions that make a body and a whole stand physical; its own code, shared with no derivation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand.definite import condition_of_twists, least_eigenvalue
from mahovik.core.stand.echoes import Moments
from mahovik.core.stand.hold import twists
from mahovik.core.stand.laws import body_laws
from mahovik.core.stand.masses import inertia_about_center, inertia_about_origin
from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import INERTIA

Array = NDArray[np.float64]

LEAST_EIGENVALUE = 1e-12  # docs/limits.md, The definiteness check
RELATIVE = 1e-9  # a flat disc, rounded, is a body

MOST_CONDITION = 5e5
"""Largest condition of S^T D S of a basis: a double has ten digits left, where two rows differ by a 350th."""


LARGEST = BOUNDS["MAX_PARAMETER"].value
"""SI; mass properties and lengths up to here are taken by the emitted C (MAX_PARAMETER)."""


UNITS = {"mass": "kg", "center_of_mass": "m", "inertia": INERTIA.si, "position": "m"}
"""SI units of what `check_size` looks at; the rest mixes units."""


def check_size(body: Body, where: str, problems: Problems, moments: Moments | None = None) -> bool:
    """Note a number of a body that is beyond what the emitted C takes. Whether all are within."""
    shown = moments or Moments()
    numbers: dict[str, object] = {"mass": body.mass, "center_of_mass": body.center_of_mass, "inertia": body.inertia}
    for kind in body_laws():
        numbers |= {key: getattr(law, key) for key in kind.limited if (law := body.law(kind)) is not None}
    if isinstance(body, Instrument | Flywheel):
        numbers["position"] = body.position
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        numbers["added_mass"] = body.added_mass
    for key, value in numbers.items():
        largest = float(np.abs(np.array(value)).max())
        if largest > LARGEST:
            unit = UNITS.get(key, "in SI")
            problems.add(
                where,
                shown.place if key == "inertia" else key,
                f"{largest:.6g} {unit} is beyond the range of the emitted C, expected at most {LARGEST:g} {unit}",
            )
            return False
    return True


def check_body(body: Body, where: str, problems: Problems, moments: Moments | None = None, advice: str = "") -> None:
    """Note what is unphysical in one body.

    moments  how the messages show moments of inertia; None: in SI
    advice   what is expected if the triangle inequality is broken; "": two moments that would keep it
    """
    shown = moments or Moments()
    if not check_size(body, where, problems, shown):
        return
    with np.errstate(all="ignore"):  # overflow is caught by isfinite
        central, at_origin = inertia_about_center(body), inertia_about_origin(body)
    if not (np.isfinite(central).all() and np.isfinite(at_origin).all()):
        problems.add(where, shown.place, "overflows double precision when moved between origin and centre of mass")
        return
    scale = max(float(np.abs(np.array(body.inertia)).max()), float(np.abs(central).max()))
    if scale > 0.0:
        a, b, c = np.linalg.eigvalsh(central / scale) * scale
        if a < -RELATIVE * scale:
            problems.add(
                where,
                shown.place,
                "Theta is not positive semidefinite, a principal moment about the centre of mass is "
                f"{shown.number(a)} {shown.unit}, expected none below 0",
            )
        elif a + b < c - RELATIVE * scale:
            problems.add(
                where,
                shown.place,
                "principal moments about the centre of mass break the triangle inequality, "
                f"{shown.broken_inequality(a, b, c)}{f'; {advice}' if advice else f', {shown.condition(a, c)}'}",
            )
    for kind in body_laws():
        if (law := body.law(kind)) is not None and (problem := law.problem(body)) is not None:
            problems.add(where, *problem)
    if isinstance(body, Flywheel) and not at_origin[0, 0] > 0.0:
        problems.add(
            where,
            shown.place,
            "a flywheel needs inertia about its own axis, "
            f"J11 at the origin is {shown.number(at_origin[0, 0])} {shown.unit}, expected above 0",
        )
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        _check_added_mass(np.array(body.added_mass), where, problems)


def _check_added_mass(added: Array, where: str, problems: Problems) -> None:
    diagonal = np.diag(added)
    if (diagonal < 0).any():
        i = int(np.argmin(diagonal))
        sign = ""
        if (diagonal <= 0).all():
            sign = ": published derivatives (X_udot, ...) are negative, added mass is minus these; expected other signs"
        problems.add(where, "added_mass", f"not positive semidefinite, [{i}][{i}] = {diagonal[i]:.6g}{sign}")
        return
    for i, j in zip(*np.nonzero(added), strict=True):
        if not diagonal[i] > 0:
            reason = f"not positive semidefinite, [{i}][{i}] = 0 but [{i}][{j}] = {added[i, j]:.6g}"
            problems.add(where, "added_mass", reason)
            return
    # unit diagonal first: kg and kg m2 have no common size
    root = np.where(diagonal > 0, np.sqrt(diagonal), 1.0)
    least = np.linalg.eigvalsh(added / root[:, None] / root[None, :])[0]
    if least < -RELATIVE:
        problems.add(where, "added_mass", f"not positive semidefinite, least eigenvalue at unit diagonal {least:.6g}")


def check_stand(stand: Stand, problems: Problems) -> None:
    """Note what is unphysical in the stand as a whole; every body has passed `check_body`."""
    if not sum(body.mass for body in stand.bodies) > 0.0:
        problems.add("total mass is zero: there is no centre of mass")
        return
    with np.errstate(all="ignore"):  # numbers near the ends of double precision
        try:
            least, phases = least_eigenvalue(stand)
        except np.linalg.LinAlgError:
            least, phases = -np.inf, ()
    if least >= LEAST_EIGENVALUE:
        _check_basis(stand, problems)
        return
    if np.isfinite(least):
        at = ", ".join(f"{f.name} = {phi:.4g}" for f, phi in zip(stand.flywheels, phases, strict=True))
        defect = f"the eigenvalue {least:.3g}{' at phases ' + at if at else ''}"
    else:
        defect = "a zero on its diagonal, or overflows"
    problems.add(
        f"mass matrix of the whole stand, scaled to unit diagonal, has {defect}, "
        f"expected eigenvalues of at least {LEAST_EIGENVALUE:g}: some motion has no inertia"
    )


def _check_basis(stand: Stand, problems: Problems) -> None:
    """Note rows of a basis that are so nearly dependent that digits of the motion would be lost."""
    if stand.hold is None or all(freedom.kind != "twist" for freedom in stand.hold.freedoms):
        return
    with np.errstate(all="ignore"):
        condition = condition_of_twists(stand, twists(stand.hold))
    if condition > MOST_CONDITION:
        shown = f"condition {condition:.2g}" if np.isfinite(condition) else "a condition that no double can tell"
        problems.add(
            "hold",
            "basis",
            f"rows are nearly dependent, by masses and inertias as units they have {shown}, expected at most "
            f"{MOST_CONDITION:g}: say the same motions by rows that differ more, such as by the difference of two rows "
            "in place of one of them",
        )
