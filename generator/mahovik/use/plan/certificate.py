"""Programmes with stand, motion and hashes, figures for their report, findings of the verification, weak motors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array

TABLES = {"runup": "run-up", "rundown": "run-down"}
"""Optional tables of a programme: key in the file, and name in messages."""


def certify(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
    """The programme with the findings of the independent verification in its report."""
    from mahovik.proof.verify.programme.verification import as_item, verify_programme

    checks = verify_programme(stand, motion, programme)
    items = [as_item(item) for item in checks]
    values = {finding["name"]: finding["value"] for finding in items}
    words = {
        "verified": not any(item.failed for item in checks),
        "simulation_error": values.get("simulation"),
        "verification": items,
    }
    return replace(programme, report={**programme.report, **words})


def failed_items(programme: Programme, of: str = "") -> str:
    """Failed items of the verification, in words, except bounds, which are reported separately. Empty if none failed.

    `of`: only items whose names begin with this.
    """
    items = [item for item in programme.report.get("verification", ()) if item["name"].startswith(of)]
    wrong = [item for item in items if not item["passed"] and "bound" not in item["name"].split()]
    values = [f"{item['value']:.3g}, at most" if item["value"] is not None else "not finite, at most" for item in wrong]
    lines = [
        f"{item['name']} {value} {item['limit']:.3g}, {item['words']}"
        for item, value in zip(wrong, values, strict=True)
    ]
    return "; ".join(lines)


def drop_refused_tables(programme: Programme) -> Programme:
    """Leave out a run-up or run-down that the verification refuses; its report has the reason under `reason`.

    The programme does not depend on them. The findings about such a table leave its verification, too.
    """
    report = dict(programme.report)
    for key, name in TABLES.items():
        wrong = failed_items(programme, f"{name} ")
        if not wrong:
            continue
        left = [item for item in report["verification"] if not item["name"].startswith(f"{name} ")]
        report["verification"], report["verified"] = left, all(item["passed"] for item in left)
        report[key] = {"reason": f"{name}: found, but refused by the verification: {wrong}"}
        programme = replace(programme, runup=None) if key == "runup" else replace(programme, rundown=None)
    return replace(programme, report=report)


def peaks(angles: Angles, tau: Array) -> dict[str, Any]:
    """Largest speed, acceleration and torque (N each) of a motion for a report; rad, s, N m."""
    return {
        "peak_speed": np.abs(angles.phi_dot).max(axis=0),
        "peak_acceleration": np.abs(angles.phi_ddot).max(axis=0),
        "peak_torque": np.abs(tau).max(axis=0),
    }


def regularity(mechanics: Mechanics, phi: Array, *, periodic: bool) -> dict[str, Any]:
    """How regular (12) is at angles (M, N), for a report.

    Least singular value of K^-1/2 I Theta_ff^-1/2, and the number of sign changes of det I, `periodic`: also from the
    last moment to the first; None unless there are six flywheels. Of a held carrier, rows along its m freedoms take the
    place of the six.
    """
    (K, I), S = mechanics.mass_and_coupling(phi), mechanics.freedoms
    factor, columns = np.linalg.cholesky(S.T @ K @ S), S.T @ I / np.sqrt(mechanics.tables.Theta_ff)
    scaled = np.linalg.solve(factor, columns)
    sigma, changes = np.linalg.svd(scaled, compute_uv=False), None
    if scaled.shape[1] == mechanics.N:
        signs = np.linalg.det(scaled) < 0.0  # of G^-1 I Theta_ff^-1/2 with K = G G^T: the sign is that of det I
        changes = int(np.sum(signs[1:] != signs[:-1])) + int(periodic and signs[0] != signs[-1])
    return {"least_singular_value": float(sigma.min()) if sigma.size else 0.0, "det_I_sign_changes": changes}


def motor_warnings(stand: Stand, report: Mapping[str, Any]) -> tuple[str, ...]:
    """One line for each peak torque (N m) or peak speed (rad/s) of a report that is above that of the motor.

    Peaks are compared with the motor's numbers, as they are in the file: its torque at speed is less, and its friction
    comes on top. A flywheel without a motor, or whose motor has no limit, has no line.
    """
    result = list(_exceeding(stand, report["peak_torque"], report["peak_speed"], ""))
    for key, name in TABLES.items():
        if peak := report.get(key, {}).get("peak"):
            result += _exceeding(stand, peak["torque"], peak["speed"], f" in the {name}")
    return tuple(result)


def _exceeding(stand: Stand, torques: Sequence[float], speeds: Sequence[float], where: str) -> Iterator[str]:
    for flywheel, torque, speed in zip(stand.flywheels, torques, speeds, strict=True):
        motor = flywheel.motor
        if motor is None:
            continue
        asked = (("torque", "N m", torque, motor.peak), ("speed", "rad/s", speed, motor.no_load))
        for kind, unit, value, most in asked:
            if most is not None and value > most:
                yield (
                    f"{flywheel.name}: peak {kind}{where} {value:.4g} {unit} is above its motor's {most:.4g} {unit}, "
                    f"which the search does not heed: add {kind} to the bounds of the motion, or ask for less"
                )
