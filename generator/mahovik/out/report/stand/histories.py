"""Time histories of a run."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Array, Line, Panel
from mahovik.out.report.plot.run import panels as run_panels
from mahovik.out.report.stand.markup import paragraph
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.run import Run, some_rows
from mahovik.proof.reference.pieces import stream_at
from mahovik.use.plan.certificate import mass_and_coupling
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.evaluate import flywheel_wrenches
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.prescribed_motion import prescribed_at

Rows = NDArray[np.intp]

ROWS = 1500
"""Rows of a run at which the equations are evaluated again."""

ROUNDING = 1e-13
"""Part of the largest spin inertia times the square of the speed: smaller torques are rounding."""

LEAST = 1e-17
"""Value drawn for a residual of zero."""


def section(material: Material) -> Section | None:
    """The section; None without a run."""
    run = material.run
    if run is None:
        return None
    shown = run_panels(run.columns)
    words = f"{len(run.t)} rows, {run.t[0]:.6g} to {run.t[-1]:.6g} s. "
    summary = f"{run.t[-1] - run.t[0]:.6g} s in {len(run.t)} rows"
    rows = some_rows(len(run.t), ROWS)
    shown.append(energy(material.stand, run, rows))
    sides = "F" if run.reaction is None else "F + R"
    if (checked := residuals(material.stand, run, rows)) is not None:
        shown.append(checked)
        largest = max(float(line.y.max(initial=0.0)) for line in checked.lines)
        words += (
            f"Residual: `{sides} - K V_r* - M V_r - J phi' - I phi''` of (8), and drive torques less those of the run, "
            f"by the same equations in NumPy and not by the C, at {len(rows)} rows; largest {largest:.2g} of the "
            "largest wrench or torque. "
            "A run-time wrench of the regime is not among the columns, and would stand here in full. "
        )
        summary += f"; residual of (8) at most {largest:.2g}"
    words += "Of many rows the envelope is drawn: every peak is in sight."
    return Section("histories", "Time histories", "".join([paragraph(words), charts(shown)]), summary=summary)


def residuals(stand: Stand, run: Run, rows: Rows) -> Panel | None:
    """Residual of (8) in the K0^-1/2 norm over its largest term, and of torques over the largest; None without data.

    A run that follows a programme has no accelerations. Of a held carrier the reaction of the run stands beside F.
    """
    if run.V_dot is None or run.phi_ddot is None:
        return None
    own = Mechanics.of(stand)
    at = prescribed_at(own, twists(stand, run, rows))
    with np.errstate(all="ignore"):  # not finite if the carrier moves too violently: not drawn
        W = flywheel_wrenches(at, run.phi[rows], run.phi_dot[rows], run.phi_ddot[rows])
        root = np.linalg.inv(np.linalg.cholesky(own.mean_inertia))
        sum_W = W[:6].sum(axis=2).T
        balance = at.balance if run.reaction is None else at.balance + run.reaction[rows]
        off = np.linalg.norm((balance - sum_W) @ root.T, axis=1)
        scale = np.linalg.norm(np.abs(root) @ np.abs(W[:6]).sum(axis=2), axis=0).max(initial=0.0)
        scale = max(scale, float(np.linalg.norm(balance @ root.T, axis=1).max(initial=0.0)))
        lines = []
        if scale > 0.0:
            lines.append(Line("of (8)", run.t[rows], np.maximum(off / scale, LEAST), 0))
        largest = float(np.abs(run.tau[rows]).max(initial=0.0))
        spin = float((own.tables.Theta_ff * run.phi_dot[rows] ** 2).max(initial=0.0))
        if largest > ROUNDING * spin:
            apart = np.abs(W[6] - run.tau[rows]).max(axis=1)
            lines.append(Line("of torques", run.t[rows], np.maximum(apart / largest, LEAST), 1))
    return Panel("residual of (8) and of torques, relative", tuple(lines), log=True) if lines else None


def twists(stand: Stand, run: Run, rows: Rows) -> Twists:
    """The carrier's motion in rows of a run that has accelerations."""
    assert run.V_dot is not None
    V, V_dot, C = run.V[rows], run.V_dot[rows], attitude(run, rows)
    u = in_E1(C, streams(stand, run, rows))
    none = np.zeros_like(u)
    rate = np.hstack([np.cross(V[:, 3:], u), none])
    return Twists(C, run.position[rows], V, V - np.hstack([u, none]), V_dot + rate)


def streams(stand: Stand, run: Run, rows: Rows) -> Array:
    """Velocity of the fluid (M, 3; m/s) in E0 where O1 is."""
    if stand.profile is None:
        return np.broadcast_to(np.array(stand.stream or (0.0, 0.0, 0.0)), (len(run.V[rows]), 3))
    return np.array([stream_at(stand, (x, y, z)) for x, y, z in run.position[rows].tolist()])


def attitude(run: Run, rows: Rows) -> Array:
    """C (M, 3, 3), x0 = C x1."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_quat(run.quaternion[rows][:, [1, 2, 3, 0]]).as_matrix())


def energy(stand: Stand, run: Run, rows: Rows) -> Panel:
    """Kinetic energy V^T K V / 2 + V^T I phi' + phi'^T Theta_ff phi' / 2, and its first term alone.

    Added mass takes V_r in place of V.
    """
    own = Mechanics.of(stand)
    K, I = mass_and_coupling(own, run.phi[rows])
    V, phi_dot = run.V[rows], run.phi_dot[rows]
    carried = np.einsum("mi,mij,mj->m", V, K, V) / 2.0
    added = np.zeros((6, 6))
    for Lambda in (stand.carrier.added_mass, *(p.added_mass for p in stand.instruments)):
        added += 0.0 if Lambda is None else np.array(Lambda)
    if stand.stream is not None:
        V_r = V - np.hstack([in_E1(attitude(run, rows), streams(stand, run, rows)), 0.0 * V[:, 3:]])
        carried += (np.sum(V_r @ added * V_r, axis=1) - np.sum(V @ added * V, axis=1)) / 2.0
    both = np.einsum("mi,min,mn->m", V, I, phi_dot)
    spin: Array = (phi_dot**2 @ own.tables.Theta_ff) / 2.0
    t = run.t[rows]
    lines = (Line("all", t, carried + both + spin, 0), Line("carrier, flywheels locked", t, carried, 1))
    return Panel("kinetic energy, J", lines)
