"""Two exciters with motor curves on a table, `two_exciters.toml`, without mahovik: Lagrange's equations by SciPy.

python exciters.py STAND.toml SECONDS FILE.csv    place and angles each 10 ms, as accurate as `mahovik simulate` is
"""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def curves_of(path: Path) -> list[Any]:
    """Torque by speed of each motor, rpm and N m."""
    wheels = tomllib.loads(path.read_text(encoding="utf-8"))["flywheel"]
    return [wheel["motor"]["torque_speed"]["value"] for wheel in wheels]


def lagrange(inertia: float, curves: list[Any], until: float, times: Array, rtol: float = 1e-10) -> Array:
    """x, z, pitch, phi a, phi b and their rates at some times: kinetic energy of points, springs by hand."""
    points = [np.array(curve) * [np.pi / 30, 1.0] for curve in curves]
    m, u, J, weight = 2.0, 0.04, 0.012, 9.81
    e = u / m
    K = np.array([16e3, 24e3, 24e3 * 0.25])
    cx, cz = (2 * 2 * 0.1 * np.sqrt(k * 32) for k in (8e3, 12e3))
    D = np.array([cx, cz, cz * 0.25])
    raised = 64 * weight / 24e3

    def matrices(q: Array) -> tuple[Array, list[Array]]:
        """Mass matrix, and the Jacobians (2, 5) of the points of the unbalances."""
        theta = q[2]
        M = np.diag([60.0, 60.0, inertia, 0.0, 0.0])
        jacobians = []
        for s, side in enumerate((-0.4, 0.4)):
            psi = theta + q[3 + s]
            J2 = np.zeros((2, 5))
            J2[0, 0] = J2[1, 1] = 1.0
            J2[:, 2] = [-side * np.sin(theta) - e * np.sin(psi), -side * np.cos(theta) - e * np.cos(psi)]
            J2[:, 3 + s] = [-e * np.sin(psi), -e * np.cos(psi)]
            jacobians.append(J2)
            turn = np.zeros(5)
            turn[[2, 3 + s]] = 1.0
            M += m * J2.T @ J2 + (J - m * e * e) * np.outer(turn, turn)
        return M, jacobians

    def rate(t: float, y: Array) -> Array:
        q, v = y[:5], y[5:]
        M, jacobians = matrices(q)
        force = np.zeros(5)
        for s, side in enumerate((-0.4, 0.4)):
            theta, psi = q[2], q[2] + q[3 + s]
            w, W = v[2], v[2] + v[3 + s]
            centripetal = -side * w * w * np.array([np.cos(theta), -np.sin(theta)])
            centripetal -= e * W * W * np.array([np.cos(psi), -np.sin(psi)])
            force -= m * jacobians[s].T @ (centripetal + np.array([0.0, weight]))
            force[3 + s] += np.interp(abs(v[3 + s]), *points[s].T) - 0.002 * v[3 + s]
        c, s_ = np.cos(q[2]), np.sin(q[2])
        C = np.array([[c, s_], [-s_, c]])  # axes of E1 as columns, in x and z
        along = C.T @ (q[:2] - [0.0, raised])
        springs = C @ (-K[:2] * along - D[:2] * (C.T @ v[:2]))
        force[:2] += springs - [0.0, 60 * weight]
        force[2] += -K[2] * q[2] - D[2] * v[2]
        return np.concatenate([v, np.linalg.solve(M, force)])

    start = np.zeros(10)
    start[4] = 2.0
    solution = solve_ivp(rate, (0.0, until), start, "DOP853", times, rtol=rtol, atol=rtol / 10)
    return np.asarray(solution.y.T)


def main() -> None:
    """The motion of the stand in a file."""
    stand, until, path = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    times: Array = np.arange(round(until / 0.01) + 1, dtype=np.float64) * 0.01
    motion = lagrange(2.5, curves_of(Path(stand)), until, times, RTOL)
    np.savetxt(path, np.column_stack([times, motion]), delimiter=",")


RTOL = 1e-8
"""Angles are then off by 6e-5 rad after three seconds, those of `mahovik simulate` by 4e-5 rad."""

if __name__ == "__main__":
    main()
