"""Programmes with stand, motion and hashes, and with the findings of the independent verification."""

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
"""Optional tables of a programme: key in the file, and name in messages."""

ROUNDING = 1e-15
"""m, rad: a smaller shift of the mean counts as none."""


def make_programme(
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


def certify(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
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


def failed_items(programme: Programme, of: str = "") -> str:
    """Failed items of the verification, in words, except bounds, which are reported separately. Empty if none failed.

    `of`: only items whose names begin with this.
    """
    found = [each for each in programme.report.get("verification", ()) if each["name"].startswith(of)]
    wrong = [each for each in found if not each["passed"] and "bound" not in each["name"].split()]
    values = [f"{each['value']:.3g}, at most" if each["value"] is not None else "not finite, at most" for each in wrong]
    told = [
        f"{each['name']} {value} {each['limit']:.3g}, {each['words']}"
        for each, value in zip(wrong, values, strict=True)
    ]
    return "; ".join(told)


def drop_refused_tables(programme: Programme) -> Programme:
    """Leave out a run-up or run-down that the verification refuses; its report has the reason under `reason`.

    The programme does not depend on them. The findings about such a table leave its verification, too.
    """
    report = dict(programme.report)
    for key, name in TABLES.items():
        wrong = failed_items(programme, f"{name} ")
        if not wrong:
            continue
        left = [each for each in report["verification"] if not each["name"].startswith(f"{name} ")]
        report["verification"], report["verified"] = left, all(each["passed"] for each in left)
        report[key] = {"reason": f"{name}: found, but refused by the verification: {wrong}"}
        programme = replace(programme, runup=None) if key == "runup" else replace(programme, rundown=None)
    return replace(programme, report=report)
