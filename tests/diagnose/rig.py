"""A program of somebody else: a rig of two rotors on a suspension, by Newton and Euler, with faults to be planted.

`python rig.py FILE [FAULT]` answers `forward`, `torque`, `coupled` and `mounts` of states on standard input. It shares
nothing with the package.
"""

from __future__ import annotations

import json
import math
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ARMATURE = 5e-6
"""Inertia of a motor's armature, kg m2."""

DRAG = 1e-16
"""Moment over the cube of a speed, N m s3: seen at large speeds alone."""


def turn(axis: int, angle: float) -> Array:
    """Rotation about an axis, rad."""
    c, s, (i, j) = math.cos(angle), math.sin(angle), ((1, 2), (2, 0), (0, 1))[axis]
    R = np.eye(3)
    R[i, i], R[i, j], R[j, i], R[j, j] = c, -s, s, c
    return R


def ship(psi: float, theta: float, phi: float) -> Array:
    """Rotation of the sequence 3, 2, 1."""
    return turn(2, psi) @ turn(1, theta) @ turn(0, phi)


def of_quaternion(q: Array) -> Array:
    """Rotation of a unit quaternion, scalar first."""
    w, x, y, z = q
    X = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + 2 * w * X + 2 * X @ X)


def rotation_vector(R: Array) -> Array:
    """Axis times angle of a rotation."""
    axial = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = float(np.linalg.norm(axial))
    return axial if sine == 0 else axial / sine * math.atan2(sine, (np.trace(R) - 1) / 2)


@dataclass(frozen=True)
class Part:
    """A body: its place and axes in E1 (of a rotor at phase zero), mass, mass centre, inertia about it."""

    name: str
    place: Array
    axes: Array
    mass: float
    center: Array
    inertia: Array
    rotor: int = -1


class Rig:
    """The rig of a file's numbers, with one fault."""

    def __init__(self, file: Mapping[str, Any], fault: str = "") -> None:
        self.fault, self.file = fault, file
        self.parts = [self._part(file["carrier"], "carrier", np.zeros(3), np.eye(3))]
        mounts = {"carrier": (np.zeros(3), np.eye(3))}
        for part in file["instrument"]:
            mounts[part["name"]] = np.array(part["position"]), ship(*part["angles"])
            self.parts.append(self._part(part, part["name"], *mounts[part["name"]]))
        for s, part in enumerate(file["flywheel"]):
            O, C = mounts[part.get("mount", "carrier")]
            if "axis" in part:
                e = np.array(part["axis"]) / np.linalg.norm(part["axis"])
                second = np.array(part["zero"]) - e * (e @ np.array(part["zero"]))
                second /= np.linalg.norm(second)
                axes = np.column_stack([e, second, np.cross(e, second)])
            else:
                psi, theta, zero = part["angles"]
                axes = ship(psi, theta, 0.0) @ turn(0, zero)
            self.parts.append(self._part(part, part["name"], O + C @ np.array(part["position"]), C @ axes, s))

    def _part(self, table: Mapping[str, Any], name: str, place: Array, axes: Array, rotor: int = -1) -> Part:
        J, c, m = np.array(table["inertia"], dtype=float), np.array(table["center_of_mass"]), table["mass"]
        if self.fault == "products" and name == "carrier":
            J = 2 * np.diag(np.diag(J)) - J
        if self.fault == "about" or (self.fault == "spin and about" and name == "carrier"):
            J = J - m * (c @ c * np.eye(3) - np.outer(c, c))
        return Part(name, place, axes, m, c, J, rotor)

    def attitude(self, state: Mapping[str, Any]) -> Array:
        """Rotation from E1 to E0."""
        if "quaternion" in state:
            q = np.array(state["quaternion"])
            if self.fault in ("scalar last", "scalar first"):
                q = np.roll(q, 1 if self.fault == "scalar last" else -1)
            if self.fault == "conjugate":
                q = q * [1, -1, -1, -1]
            return of_quaternion(q)
        angles = np.array(state.get("angles", (0.0, 0.0, 0.0)))
        if self.fault in ("sequence", "reversed"):
            order = (1, 2, 0) if self.fault == "sequence" else (0, 1, 2)
            psi, theta, phi = angles if self.fault == "sequence" else angles[::-1]
            return turn(order[0], psi) @ turn(order[1], theta) @ turn(order[2], phi)
        return ship(*(np.radians(angles) if self.fault == "degrees" else angles))

    def wrenches(self, state: Mapping[str, Any], V_dot: Array, rates: Array) -> tuple[Array, Array]:
        """Wrench on the carrier that these accelerations need (6), about O1; wrenches of mounts on rotors (N, 6)."""
        fault, R = self.fault, self.attitude(state)
        V = np.array(state.get("V", np.zeros(6)))
        v, w, a, alpha = V[:3], V[3:], V_dot[:3], V_dot[3:]
        N = len(self.file["flywheel"])
        phi, speed = (np.array(state.get(key, np.zeros(N))) for key in ("phi", "phi_dot"))
        if fault == "phase":
            phi = -phi
        if fault == "rpm":
            speed = speed * math.pi / 30
        if fault == "order":
            phi, speed = phi[::-1], speed[::-1]
        g = R.T @ np.array(self.file["gravity"]) * (-1 if fault == "gravity" else 1)
        total, mounts = np.zeros(6), np.zeros((N, 6))
        for k in self.parts:
            s = k.rotor
            C = k.axes @ (turn(0, phi[s]) if s >= 0 else np.eye(3))
            still = {"still inertia": k.axes, "inertia": C.T}.get(fault, C)
            still = np.eye(3) if fault == "inertia of arm" and k.name == "arm" else still
            r, e, J = (k.axes if fault == "still centre" else C) @ k.center, C[:, 0], still @ k.inertia @ still.T
            c, Omega, spin = k.place + r, w.copy(), speed[s] * e if s >= 0 else np.zeros(3)
            inner = np.cross(spin if fault == "rate" and k.name == "w2" else w, r)
            acceleration = a + np.cross(w, v) + np.cross(alpha, c) + np.cross(w, np.cross(w, k.place) + inner)
            turning = alpha.copy()
            if s >= 0:
                along = speed[s] * (fault == "still axis") * np.cross(np.cross(w, e), r)
                Omega = w + spin
                rate = rates[s] - (e @ alpha if fault == "absolute" else 0)
                coriolis = 1 if fault == "coriolis" else 2
                acceleration = acceleration + rate * np.cross(e, r) + coriolis * np.cross(w, np.cross(spin, r))
                acceleration = acceleration - along
                if not (fault == "centripetal" and k.name == "w2"):
                    acceleration = acceleration + np.cross(spin, np.cross(spin, r))
                turning = alpha + rate * e + (0 if fault in ("omega x u", "still axis") else np.cross(w, spin))
            force = k.mass * (acceleration - g)
            moment = J @ turning + (-1 if fault == "gyroscopic" and s >= 0 else 1) * np.cross(Omega, J @ Omega)
            arm = np.cross(r, k.mass * acceleration) + moment
            if fault in ("spin", "spin and drag", "spin and about") and s >= 0:
                arm = arm - 2 * np.cross(w, (J + k.mass * (r @ r * np.eye(3) - np.outer(r, r))) @ spin)
            if fault == "spin and drag" and s >= 0:
                arm = arm + DRAG * speed[s] ** 3 * e
            if fault == "armature in all" and s >= 0:
                arm = arm + ARMATURE * rates[s] * e
            arm = arm - (0 if fault == "weight" and s >= 0 else np.cross(r, k.mass * g))
            total += np.concatenate([force, np.cross(k.place, force) + arm])
            if s >= 0:
                momentum = arm + (ARMATURE * rates[s] * e if fault == "armature" else 0)
                mounts[s] = np.concatenate([k.axes.T @ force, k.axes.T @ momentum])
        return total - self.applied(state, R, V, V_dot), mounts

    def applied(self, state: Mapping[str, Any], R: Array, V: Array, V_dot: Array) -> Array:
        """Wrench on the carrier of suspension, buoyancy, added mass and the caller (6), about O1 in E1."""
        file, fault = self.file, self.fault
        table = file["suspension"]
        E_eq = ship(*np.array(table["angles"]) * (0 if fault == "equilibrium" else 1))
        position = np.array(state.get("position", np.zeros(3))) * (1e-3 if fault == "mm" else 1)
        displaced = position - table["position"]
        turned = rotation_vector(E_eq.T @ R)
        if fault == "sine":
            turned = turned * np.sinc(np.linalg.norm(turned) / np.pi)
        if fault == "turned in E0":
            turned = E_eq @ turned
        x = np.concatenate([displaced if fault == "displacement" else R.T @ displaced, turned])
        stiffness, damping = (np.array(table[key], dtype=float) for key in ("stiffness", "damping"))
        damping = np.diag(damping) if damping.ndim == 1 else damping
        if fault == "transposed":
            stiffness = stiffness.T
        if fault == "damping":
            L = np.kron(np.eye(2), R)
            damping = L.T @ damping @ L
        wrench = -stiffness @ x - damping @ V
        up = np.array(file["gravity"]) * -file["carrier"]["buoyancy"]["displaced_mass"]
        up = up if fault == "buoyancy" else R.T @ up
        wrench += np.concatenate([up, np.cross(file["carrier"]["buoyancy"]["center"], up)])
        added = np.array(file["carrier"]["added_mass"]) * (-1 if fault == "added mass" else 1)
        p, h = np.split(added @ V, 2)
        along = -1 if fault == "munk" else 1
        wrench -= added @ V_dot + along * np.concatenate([np.cross(V[3:], p), np.cross(V[3:], h) + np.cross(V[:3], p)])
        applied = np.array(state.get("wrench", {}).get("carrier", np.zeros(6)))
        if fault == "no wrench":
            applied = 0 * applied
        if fault == "wrench":
            applied = np.concatenate([R.T @ applied[:3], R.T @ applied[3:]])
        return np.asarray(wrench + applied)

    def answer(self, state: Mapping[str, Any], want: str) -> dict[str, Any]:
        """The values of a want; every equation is linear in the accelerations."""
        N = len(self.file["flywheel"])
        rates, V_dot = np.array(state.get("phi_ddot", np.zeros(N))), np.array(state.get("V_dot", np.zeros(6)))
        if want in ("torque", "mounts"):
            _, mounts = self.wrenches(state, V_dot, rates)
            return {"tau": mounts[:, 3].tolist()} if want == "torque" else {"mount_wrench": mounts.tolist()}

        def rest(x: Array) -> Array:
            total, mounts = self.wrenches(state, x[:6], x[6:] if want == "coupled" else rates)
            torques: Array = mounts[:, 3] - np.array(state.get("tau", np.zeros(N)))
            return np.concatenate([total, torques]) if want == "coupled" else total

        n = 6 + N if want == "coupled" else 6
        start = rest(np.zeros(n))
        x = np.linalg.solve(np.column_stack([rest(column) - start for column in np.eye(n)]), -start)
        answer = {"V_dot": x[:6].tolist()}
        return answer if want == "forward" else {**answer, "phi_ddot": x[6:].tolist()}


WANTS = ("forward", "torque", "coupled", "mounts")


def main() -> None:
    """Answer the states of standard input."""
    with open(sys.argv[1], "rb") as file:
        rig = Rig(tomllib.load(file), *sys.argv[2:3])
    for line in sys.stdin:
        state = json.loads(line)
        if set(state["want"]) <= set(WANTS):
            answer = {key: x for want in state["want"] for key, x in rig.answer(state, want).items()}
        else:
            answer = {"error": f"no want {state['want']}"}
        print(json.dumps({"id": state["id"], **answer}), flush=True)


if __name__ == "__main__":
    main()
