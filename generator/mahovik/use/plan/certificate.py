"""A programme with whose it is, and what the independent verification says of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme, Samples
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array

TABLES = {"runup": "run-up", "rundown": "run-down"}
"""What may stand beside a programme: key of the file, and how it is called."""

ROUNDING = 1e-15
"""m, rad: a shift of the mean below this is no shift."""


def programme_of(
    stand: Stand,
    motion: RequiredMotion,
    bias: Array,
    winding: tuple[int, ...],
    course: Fourier | Samples,
    report: Mapping[str, Any],
) -> Programme:
    """The programme of a stand for a motion."""
    whose = identities(stand)
    return Programme(
        stand=stand.name,
        structure=whose.structure,
        physics=whose.physics,
        motion=motion.name,
        flywheels=tuple(s.name for s in stand.flywheels),
        periodic=motion.periodic,
        span=motion.span,
        bias=np.where(np.abs(bias) < ROUNDING, 0.0, bias),
        winding=winding,
        course=course,
        report=report,
    )


def certified(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
    """The programme with the findings of the independent verification in its report."""
    from mahovik.proof.verify.programme import verify_programme
    from mahovik.proof.verify.programme.finding import floquet_of

    findings = verify_programme(stand, motion, programme)
    items = [each.as_item() for each in findings]
    values = {each["name"]: each["value"] for each in items}
    words = {
        "verified": all(each.passed for each in findings),
        "simulation_error": values.get("simulation"),
        "largest_multiplier": values.get("Floquet"),
        "floquet": floquet_of(findings),
        "verification": items,
        "warnings": [f"{each.name}: {each.words}" for each in findings if each.warns],
    }
    return replace(programme, report={**programme.report, **words})


def wrong_items(programme: Programme, of: str = "") -> str:
    """Items of the verification that failed, bounds apart: those are told as such. Empty where none.

    `of`: what the names of the items begin with.
    """
    found = [each for each in programme.report.get("verification", ()) if each["name"].startswith(of)]
    wrong = [each for each in found if not each["passed"] and "bound" not in each["name"].split()]
    values = [f"{each['value']:.3g}, at most" if each["value"] is not None else "not finite, at most" for each in wrong]
    told = [
        f"{each['name']} {value} {each['limit']:.3g}, {each['words']}"
        for each, value in zip(wrong, values, strict=True)
    ]
    return "; ".join(told)


def without_refused_tables(programme: Programme) -> Programme:
    """Without a run-up or run-down that the verification refuses: its report says why under `reason`.

    The programme does not depend on them. What was found of such a table is no item of its verification any more.
    """
    report = dict(programme.report)
    for key, name in TABLES.items():
        wrong = wrong_items(programme, f"{name} ")
        if not wrong:
            continue
        left = [each for each in report["verification"] if not each["name"].startswith(f"{name} ")]
        report["verification"], report["verified"] = left, all(each["passed"] for each in left)
        report[key] = {"reason": f"{name}: one was found and refused by the verification: {wrong}"}
        programme = replace(programme, runup=None) if key == "runup" else replace(programme, rundown=None)
    return replace(programme, report=report)
