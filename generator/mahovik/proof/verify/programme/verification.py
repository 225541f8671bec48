"""Verification of a programme: all items that it must pass (docs/planning.md), in order."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from mahovik.contract.limits import ALONG, BEGIN, DRIFT, END, EXCEEDED, JOINT, KINKED, RUNUP, SMOOTH, TABLE
from mahovik.core.motion.functions import Angles, Fourier, Samples
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.coordinates import FREE, coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import UNLIMITED, available_torque, required_torque
from mahovik.core.stand.structure import identities, under_name
from mahovik.errors import StateError, above_zero
from mahovik.proof.reference.algebra import Array, cross, rotation_vector, vector
from mahovik.proof.reference.inverse import task_rows
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import (
    STEP_ERROR,
    Scale,
    displacement,
    largest,
    moment,
    residual_and_torque,
    rest_near,
    scale_of,
    simulate,
    torques_along,
    twist,
)


class Tolerance(NamedTuple):
    """residual, error   of the equations and of the carrier's motion by simulation, shares
    runup   of the carrier's state at the end of a run-up or run-down, share of the amplitude
    """

    residual: float
    error: float
    runup: float


FINER, OFFSET, FINER_ANGLES, OF_WAVE = 20, 0.382, 8, 32
"""Points of the grid of the residual for each node of the programme, beginning this share of a step after a node, so
that no node is a point of it; for angles, which are cheap, so many times as many; rows of the table that a Fourier
series is judged as, in a period of its highest harmonic."""

STEPS_OF_TORQUES, TORQUES_ERROR = 8, 1e-7
"""Steps of a run-up in a period, and the error of one over the amplitude: enough for feedforward torques."""

STEPS_OF_SPAN, STEPS_OF_RUNUP, RUNUP_ERROR = 32, 24, 1e-8
"""Least number of steps in a span, and of a run-up in a period: the error estimate of a step misses jumps of phi's
third derivative at rows. Error of a step of a run-up over the amplitude: its end has a wider tolerance."""

FURTHEST = 100.0
"""Largest distance from the required motion, in amplitudes, at which the simulation goes on."""

POINTS, ARCSEC = 400, np.pi / 648000.0
"""Times along a slew, and an angle, rad."""


def tolerance_for(stand: Stand, share: float | None) -> Tolerance:
    """Limits for a stand; `share` replaces that of the residual, and the others follow from it."""
    if share is not None:
        above_zero("tolerance", share)
    elif not any(law.nonlinear for body in stand.bodies for law in body.laws):
        return Tolerance(SMOOTH, SMOOTH, RUNUP)
    share = KINKED if share is None else share
    return Tolerance(share, DRIFT * share, max(DRIFT * share, RUNUP))


def stand_check(stand: Stand, programme: Programme) -> Check:
    """How many of name, structure, physics, flywheels and coordinates are of another stand.

    A stand under another name, as `generate --prefix` gives it one, is the same.
    """
    of = programme.stand
    stand = under_name(stand, of.name, of.physics) or stand
    now = identities(stand)
    pairs = {
        "name": (of.name, stand.name),
        "structure": (of.structure, now.structure),
        "physics": (of.physics, now.physics),
        "flywheels": (", ".join(programme.flywheels), ", ".join(s.name for s in stand.flywheels)),
        "coordinates": (", ".join(programme.coordinates or FREE), ", ".join(coordinates_of(stand).names)),
    }
    return _owner_check("stand", pairs, f"{now.structure} {now.physics}")


def motion_check(motion: RequiredMotion, programme: Programme) -> Check:
    """How many of name, kind, period (duration) and unbalance are of another motion."""
    kind, same = {True: "periodic", False: "finite"}, abs(programme.span - motion.span) <= 1e-12 * motion.span
    span = motion.span if same else programme.span
    pairs = {"name": (programme.motion, motion.name), "kind": (kind[programme.periodic], kind[motion.periodic])}
    if programme.periodic == motion.periodic:
        pairs["period" if motion.periodic else "duration"] = f"{span:.15g} s", f"{motion.span:.15g} s"
    pairs["unbalance"] = programme.unbalance, "resisted" if motion.slew is None else "averaged"
    return _owner_check("motion", pairs, motion.name)


def _owner_check(kind: str, pairs: Mapping[str, tuple[str, str]], words: str) -> Check:
    other = [f"{key} is {theirs}, of the {kind} {ours}" for key, (theirs, ours) in pairs.items() if theirs != ours]
    return Check.of(kind, len(other), 0, f"programme of another {kind}: {'; '.join(other)}" if other else words)


def bound_check(name: str, values: Array, limits: Any, names: Sequence[str], unit: str) -> Check:
    """Largest magnitude of values (M, N) over its limit (N, or M, N)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(values == 0.0, 0.0, np.abs(values) / limits)
    i, s = divmod(int(np.argmax(shares)), shares.shape[1])
    most = np.broadcast_to(limits, shares.shape)[i, s]
    return Check.of(name, shares[i, s], EXCEEDED, f"{names[s]}: {abs(values[i, s]):.6g} of {most:.6g} {unit}".rstrip())


def bound_checks(
    bounds: Bounds, names: Sequence[str], angles: Angles, tau: Array, rocking: Array | None = None, prefix: str = ""
) -> list[Check]:
    """An item for each given bound. `rocking` (M, N): phi less winding and mean; without it this is part of a run-up,
    where `angle` and `speed_min` are not bounded.
    """
    rows: list[tuple[str, Array | None, str]] = [
        ("speed", angles.phi_dot, "rad/s"), ("acceleration", angles.phi_ddot, "rad/s2"), ("torque", tau, "N m"),
        ("angle", rocking, "rad"),
    ]  # fmt: skip
    items = [
        bound_check(f"{prefix}bound {key}", values, np.array(getattr(bounds, key)), names, unit)
        for key, values, unit in rows
        if values is not None and getattr(bounds, key) is not None and names
    ]
    if rocking is not None and bounds.speed_min is not None and names:
        turns_back = angles.phi_dot.min(axis=0) * angles.phi_dot.max(axis=0) < 0.0
        least = np.where(turns_back, 0.0, np.abs(angles.phi_dot).min(axis=0))
        unit = "rad/s that it goes down to"
        items.append(bound_check("bound speed_min", np.array([bounds.speed_min]), least, names, unit))
    return items


def rocking_of(programme: Programme, t: Array, phi: Array) -> Array:
    """Angles phi less their winding and mean (M, N; rad)."""
    left = phi - (t / programme.span)[:, None] * 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    return np.asarray(left - left.mean(axis=0))


def neighbour_errors(samples: Samples) -> Array:
    """For each inner row what the quintic between its two neighbours misses phi, phi', phi'' by (M - 2).

    phi' and phi'' as shares of their peaks, phi of the way that the peak speed goes in the step.
    """
    speed = largest(samples.phi_dot) or 1.0
    acceleration = max(largest(samples.phi_ddot), 1e-6 * speed / float(np.ptp(samples.t)))
    rows, errors = (samples.phi, samples.phi_dot, samples.phi_ddot), np.zeros(max(len(samples.t) - 2, 0))
    for first in (1, 2):
        skipped = np.arange(first, len(samples.t) - 1, 2)
        if len(skipped):
            coarse = Samples(*(np.delete(row, skipped, axis=0) for row in (samples.t, *rows))).at(samples.t[skipped])
            scales = speed * np.diff(samples.t)[skipped - 1][:, None], speed, acceleration
            off = [np.abs(x - y[skipped]) / scale for x, y, scale in zip(coarse, rows, scales, strict=True)]
            errors[skipped - 1] = np.max(off, axis=(0, 2))
    return errors


def rows_check(name: str, t: Array, errors: Array, words: str = "") -> Check:
    """The worst of rows at times t (M, s); with `words` in place of its number and time."""
    if not len(errors):
        return Check.of(name, 0.0, TABLE, "no row has neighbours")
    i = int(np.argmax(errors))
    return Check.of(name, errors[i], TABLE, words or f"row {i + 1}, t = {t[i]:.6g} s, against its neighbours")


def motor_torques(stand: Stand, phi_dot: Array, tau: Array) -> tuple[Array, Array]:
    """Torques of the motors themselves in drive torques tau, which friction is part of, and what they can give.

    All (M, N; N m), at speeds phi_dot (M, N).
    """
    needed, most = np.array(tau), np.full_like(tau, np.inf)
    for s, motor in enumerate(wheel.motor for wheel in stand.flywheels):
        if motor is not None:
            needed[:, s] = required_torque(motor, tau[:, s], phi_dot[:, s])
            most[:, s] = available_torque(motor, needed[:, s], phi_dot[:, s])
    return needed, most


class Residuals(NamedTuple):
    """Residual of (12) along a programme: t (M, s), residual (M) and its mean as shares; tau (M, N; N m)."""

    t: Array
    residual: Array
    mean: float
    tau: Array


@dataclass(frozen=True, eq=False)
class ProgrammeCase:
    """A programme, the motion that it shall give, and the stand whose equations it keeps. Items in groups."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    limit: Tolerance

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme, tolerance: float | None = None) -> ProgrammeCase:
        """For the stand that the programme was planned for; `tolerance` of the residual, a share."""
        return ProgrammeCase(programme.planned_for(stand), motion, programme, tolerance_for(stand, tolerance))

    @cached_property
    def scale(self) -> Scale:
        """Scales of the motion."""
        return scale_of(self.stand, self.motion, self.programme)

    def equations(self, t: Array, angles: Angles | None = None) -> tuple[Array, Array]:
        """Residual (M, 6; N, N m) of (12) and drive torques (M, N; N m) at times t (M, s), also of other angles."""
        course = self.motion.at(t, self.programme.bias)
        return residual_and_torque(self.stand, course, self.programme.at(t) if angles is None else angles)

    def residuals(self, times: int | None = None) -> Residuals:
        """Residuals over the whole span, beside every node: at a number of `times`, by default 20 to a node."""
        course = self.programme.course
        nodes = 2 * len(course.cos) + 1 if isinstance(course, Fourier) else len(course.t)
        fastest = max([*self.motion.harmonics, *(abs(n) for n in self.programme.winding), 1])
        M = times or FINER * max(nodes, 2 * fastest + 1)
        t = self.programme.span * (np.arange(M) + OFFSET) / M
        R, tau = self.equations(t)
        return Residuals(t, self.scale.wrench_share(R), float(self.scale.wrench_share(np.mean(R, axis=0))), tau)

    @cached_property
    def course(self) -> Residuals:
        """Residual of (12) and drive torques between the nodes of the programme."""
        return self.residuals()

    @cached_property
    def start(self) -> Array:
        """The required state (q, q') (2 m) at t = 0."""
        q, q_dot, _ = self.motion.at(np.zeros(1), self.programme.bias)
        return np.concatenate([q[0], q_dot[0]])

    def winding(self) -> list[Check]:
        """Flywheels whose winding is not as the motion wants it."""
        wanted, turns = self.motion.winding, self.programme.winding
        if not self.motion.periodic or wanted == "any":
            return []
        right = [(n != 0) == (wanted == "spin") for n in turns] if isinstance(wanted, str) else np.equal(turns, wanted)
        named = wanted if isinstance(wanted, str) else list(wanted)
        return [Check.of("winding", len(turns) - sum(right), 0, f"{list(turns)}, wanted {named}")]

    def table(self) -> list[Check]:
        """Whether phi', phi'' are derivatives of phi, and a period ends where it began, a winding further on."""
        rows, span, words = self.programme.course, self.programme.span, ""
        if isinstance(rows, Fourier):
            t = span * np.arange(OF_WAVE * max(len(rows.cos), 1)) / (OF_WAVE * max(len(rows.cos), 1))
            rows, words = Samples(t, *self.programme.at(t)), "rows of the Fourier series against their neighbours"
        if not self.programme.periodic:
            return [rows_check("table", rows.t[1:-1], neighbour_errors(rows))]
        turn = 2 * np.pi * np.array(self.programme.winding, dtype=np.float64)
        columns = (rows.t, span), (rows.phi, turn), (rows.phi_dot, 0.0), (rows.phi_ddot, 0.0)
        # a row more at both ends, so that all are inner rows
        padded = (np.concatenate([column[-1:] - more, column, column[:1] + more]) for column, more in columns)
        errors = neighbour_errors(Samples(*padded))
        ends = Check.of("periodicity", np.max(errors[[0, -1]]), TABLE, "last and first row, winding turns apart")
        return [rows_check("table", rows.t[1:-1], errors[1:-1], words), ends]

    def bias(self) -> list[Check]:
        """The bias: zero where the mean is not free; within its bound."""
        names, bias, bound = self.programme.coordinates or FREE, self.programme.bias, self.motion.bounds.bias
        held = np.where(self.motion.free_mean, 0.0, np.abs(bias))
        worst = int(np.argmax(held))
        words = f"of {names[worst]}, whose mean is not free" if held[worst] else "zero where the mean is not free"
        items = [Check.of("bias", held[worst], 0.0, words)]
        return items if bound is None else [*items, bound_check("bound bias", bias[None], np.array(bound), names, "")]

    def bounds(self) -> list[Check]:
        """Bounds of the motion, on a finer grid than that of the residual; of a slew torques of its motors."""
        M, programme = FINER_ANGLES * len(self.course.t), self.programme
        t, tau = programme.span * np.arange(M + (not programme.periodic)) / M, self.course.tau
        if self.motion.slew is not None:
            tau = motor_torques(self.stand, programme.at(self.course.t).phi_dot, tau)[0]
        angles = programme.at(t)
        return bound_checks(self.motion.bounds, programme.flywheels, angles, tau, rocking_of(programme, t, angles.phi))

    def residual(self) -> Check:
        """The largest residual of (12), relative."""
        course, i = self.course, int(np.argmax(self.course.residual))
        value = float(course.residual[i])
        words = f"of (12), at {len(course.t)} times; largest at t = {course.t[i]:.6g} s"
        if course.mean > 0.5 * value and value > 0.1 * self.limit.residual:
            words += f"; mean {course.mean:.2g}, which nothing balances: the carrier drifts"
        return Check.of("residual", value, self.limit.residual, words)

    def simulation(self) -> Check:
        """The carrier's distance from the required motion over one span, from the required state at t = 0."""
        stand, programme = self.stand, self.programme
        t, furthest = np.linspace(0.0, programme.span, 16 * max([*self.motion.harmonics, 12]) + 1), FURTHEST
        rows = self.motion.slew is not None and isinstance(programme.course, Samples)
        if isinstance(programme.course, Samples) and rows:  # torques of a slew bend within a hundredth of its time
            t, furthest = programme.course.t, np.inf
        try:
            longest = programme.span / STEPS_OF_SPAN
            y = simulate(stand, programme.at, self.start, t, self.scale, longest, furthest=furthest, rows=rows)
        except StateError as error:
            return Check.of("simulation", np.inf, self.limit.error, str(error))
        required, coordinates = self.motion.at(t, programme.bias).q, coordinates_of(stand)
        apart = np.hsplit(y, 2)[0] - required
        shares = self.scale.displacement_share(
            np.array([twist(stand, *row) for row in zip(required, apart, strict=True)])
        )
        i = int(np.argmax(shares))
        x = 1e3 * apart[i]
        away = f"O1 {np.linalg.norm(x[:3]):.2g} mm, angles {np.linalg.norm(x[3:]):.2g} mrad"
        if stand.hold is not None:
            parts = zip(coordinates.names, np.abs(x), coordinates.unit_names, strict=True)
            away = ", ".join(f"{name} {size:.2g}{f' m{unit}' if unit else 'e-3'}" for name, size, unit in parts)
        words = f"of (8) from the required state: largest at t = {t[i]:.6g} s, {away} away"
        return Check.of("simulation", shares[i], self.limit.error, words)

    def run_up(self, name: str, t: Array, steps: int, error: float = STEP_ERROR, *, rows: bool = False) -> Array:
        """y = (q, q') (M, 2 m) at the times t (M, s) of "run-up" or "run-down", on which the carrier is free, by (8).

        A run-up begins at rest at the equilibrium, a run-down with the required state. `steps`: least number in
        a period; `error`, `rows`: see `simulate`. StateError: there is no equilibrium, or the simulation stops.
        """
        table, start = self.programme.runup if name == "run-up" else self.programme.rundown, self.start
        assert table is not None
        if name == "run-up":
            mean = self.motion.mean + self.programme.bias
            rest, _ = rest_near(self.stand, table.samples.phi[0], mean, self.scale.K0)
            start = np.concatenate([rest, np.zeros_like(rest)])
        longest = min(self.programme.span, table.duration) / steps
        return simulate(self.stand, table.at, start, t, self.scale, longest, error=error, rows=rows)

    def torques(self, part: str, t: Array) -> Array:
        """Drive torques (M, N; N m) at rising times t (M, s) of the programme, "", or of its "runup" or "rundown".

        On these the carrier is free: see `run_up`.
        """
        if not part:
            return self.equations(t)[1]
        table, name = (self.programme.runup, "run-up") if part == "runup" else (self.programme.rundown, "run-down")
        assert table is not None
        times = np.unique(np.concatenate([[0.0], t]))
        y = self.run_up(name, times, STEPS_OF_TORQUES, TORQUES_ERROR)
        return torques_along(self.stand, y[np.searchsorted(times, t)], table.at(t))

    def runups(self) -> list[Check]:
        """Checks of run-up and run-down: rows, joint with the programme, rest at the other end, end of the carrier."""
        items, begin = [], self.programme.at(np.zeros(1))
        for name, table in (("run-up", self.programme.runup), ("run-down", self.programme.rundown)):
            if table is None:
                continue
            rows, (joint, rest) = table.samples, (-1, 0) if name == "run-up" else (0, -1)
            turned, rates = rows.phi[joint] - begin.phi[0], (rows.phi_dot, rows.phi_ddot)
            apart = [largest(turned - 2 * np.pi * np.round(turned / (2 * np.pi)))]
            for ours, theirs in zip(rates, begin[1:], strict=True):
                apart.append(largest(ours[joint] - theirs[0]) / max(largest(ours), largest(theirs), 1e-300))
            moving = [largest(rate[rest]) / (largest(rate) or 1.0) for rate in rates]
            where = f"{('phi', 'phi_dot', 'phi_ddot')[int(np.argmax(apart))]} at the programme's t = 0"
            still = "phi', phi'' of the flywheels at rest, share of their peaks"
            items += [
                rows_check(f"{name} table", rows.t[1:-1], neighbour_errors(rows)),
                Check.of(f"{name} joint", np.max(apart), JOINT, where),
                Check.of(f"{name} rest", np.max(moving), JOINT, still),
                *self._way(name, table),
            ]
        return items

    def _way(self, name: str, table: RunUpTable) -> list[Check]:
        """The carrier by (8), from equilibrium to the required state or the reverse, and bounds on the way."""
        stand, bounds, scale, up = self.stand, self.motion.bounds, self.scale, name == "run-up"
        (q, q_dot), mean = np.split(self.start, 2), self.motion.mean + self.programme.bias
        t, still = table.samples.t, 0 if up else -1
        try:
            y = self.run_up(name, t, STEPS_OF_RUNUP, RUNUP_ERROR, rows=True)
            rest, free = rest_near(stand, table.samples.phi[still], y[still, : len(q)], scale.K0)
        except StateError as error:
            return [Check.of(f"{name} end", np.inf, self.limit.runup, str(error))]
        end, end_dot = np.split(y[-1], 2)
        apart = twist(stand, q, end - (q if up else rest))
        apart -= free @ (free.T @ (scale.K0 @ apart))  # where the stand may as well have begun elsewhere
        left = twist(stand, end, end_dot) - (twist(stand, q, q_dot) if up else 0.0)
        shares = scale.displacement_share(apart), scale.twist_share(left)
        strayed = np.array([displacement(stand, row, mean) for row in np.hsplit(y, 2)[0]]).max(axis=0)
        words = (
            f"carrier at the end, pose {shares[0]:.2g}, twist {shares[1]:.2g} of the amplitude; on the way "
            f"{1e3 * strayed[0]:.3g} mm, {1e3 * strayed[1]:.3g} mrad from the mean pose"
        )
        angles = table.at(t)
        tau = torques_along(stand, y, angles) if bounds.torque is not None else np.zeros_like(angles.phi)
        items = [Check.of(f"{name} end", np.max(shares), self.limit.runup, words)]
        items += bound_checks(bounds, self.programme.flywheels, angles, tau, prefix=f"{name} ")
        if bounds.deviation is not None:
            names, most = ("O1, m", "E1, rad"), np.array(bounds.deviation.limits)
            items.append(bound_check(f"{name} bound deviation", strayed[None], most, names, "from the mean pose"))
        return items

    def beginning(self) -> list[Check]:
        """Distance from `start` of a finite motion: rad, and share of the peak speed."""
        angles, bounds, items = self.programme.at(np.linspace(0.0, self.programme.span, 999)), self.motion.bounds, []
        if bounds.start.phi is not None:
            items.append(Check.of("start phi", largest(angles.phi[0] - np.array(bounds.start.phi)), JOINT, "rad"))
        if bounds.start.phi_dot is not None:
            speeds = np.array(bounds.start.phi_dot)
            share = largest(angles.phi_dot[0] - speeds) / max(largest(angles.phi_dot), largest(speeds), 1e-12)
            items.append(Check.of("start phi_dot", share, JOINT, "share of the peak speed"))
        return items

    def slew(self) -> list[Check]:
        """The course of a slew begins, goes and ends as demanded, which (8) follows by another item; its motors."""
        from scipy.linalg import expm

        slew, stand, programme = self.motion.slew, self.stand, self.programme
        if slew is None:
            return []
        t, C, rates, accelerations = np.linspace(0.0, programme.span, POINTS + 1), [], [], []
        angles = programme.at(t)
        for q, q_dot, q_ddot, phi, phi_dot in zip(*self.motion.at(t), angles.phi, angles.phi_dot, strict=True):
            now = moment(stand, q, q_dot, phi, phi_dot)
            rows = task_rows(now.at, stand, slew.task)
            C.append(now.carrier.C)
            rates.append(rows.S @ now.at.V)
            accelerations.append(rows.acceleration(now.V_dot(q_ddot)))
        q, q_dot = np.split(self.start, 2)
        turned = [np.linalg.norm(rotation_vector(C[0].T @ slew.start))]
        begins = q[:3] - vector(slew.position), turned, twist(stand, q, q_dot)
        items = [Check.of("slew start", largest(np.concatenate(begins)), BEGIN, "pose and twist at t = 0: m, rad, s")]
        if slew.kind != "still":
            wanted = expm(slew.angle * cross(slew.normal)) @ slew.start
            if slew.kind == "attitude":
                what, end = "attitude", float(np.linalg.norm(rotation_vector(C[-1].T @ wanted)))
                way = np.array([rotation_vector(now @ slew.start.T) for now in C])
                aside = largest(way - np.outer(way @ slew.normal, slew.normal))
            else:
                sight, goal = np.array(C) @ slew.axis, wanted @ slew.axis
                what, end = "line of sight", math.atan2(np.linalg.norm(np.cross(sight[-1], goal)), sight[-1] @ goal)
                aside = largest(sight @ slew.normal)
            words = f"of the {what} aside from the shortest turn, share of it"
            items += [
                Check.of("slew end", end / ARCSEC, END, f"arcsec between the {what} at the end and the demanded one"),
                Check.of("slew path", aside / slew.angle, ALONG, words),
            ]
        angular = np.array([row.component.startswith("w") for row in slew.task.rows])
        turning, moving = np.array(rates)[:, angular], np.array(accelerations)
        if angular.any():
            peak = largest(turning) or 1.0
            words = f"rates of the rows at the end, share of {peak:.3g} rad/s"
            items.append(Check.of("slew rest", largest(turning[-1]) / peak, ALONG, words))
        if not angular.all():
            peak = largest(moving[:, angular]) or 1.0
            words = f"accelerations of the linear rows, m/s2, over {peak:.3g} rad/s2 of the angular ones"
            items.append(Check.of("slew rows", largest(moving[:, ~angular]) / peak, ALONG, words))
        return [*items, *self._motors()]

    def _motors(self) -> list[Check]:
        """The torque that each motor itself gives, with its friction, over what it can at that speed; and the speed."""
        names, motors = self.programme.flywheels, [s.motor for s in self.stand.flywheels]
        fastest = np.array([(motor or UNLIMITED).no_load or np.inf for motor in motors])
        phi_dot, items = self.programme.at(self.course.t).phi_dot, []
        if any(motor is not None for motor in motors):
            torques = motor_torques(self.stand, phi_dot, self.course.tau)
            items.append(bound_check("motor torque", *torques, names, "N m"))
        if np.isfinite(fastest).any():
            items.append(bound_check("motor speed", phi_dot, fastest, names, "rad/s"))
        return items


def verify_programme(
    stand: Stand,
    motion: RequiredMotion,
    programme: Programme,
    *,
    tolerance: float | None = None,
) -> tuple[Check, ...]:
    """Checks, one an item; the programme is right where none has failed. If the carrier does not follow the
    motion, run-ups are not examined.

    `tolerance`: of the residual, a share; default 1e-6, with damping of V|V| 1e-5. What is of another
    stand's flywheels or another motion's kind or period is not verified further: only that is reported.
    """
    items = [stand_check(stand, programme), motion_check(motion, programme)]
    case = ProgrammeCase.of(stand, motion, programme, tolerance)
    same_span = programme.periodic == motion.periodic and abs(programme.span / motion.span - 1) < 1e-9
    same_size = len(programme.bias) == coordinates_of(stand).count
    if not same_span or not same_size or programme.flywheels != tuple(s.name for s in stand.flywheels):
        return tuple(item for item in items if item.failed)
    with np.errstate(all="ignore"):  # what overflows is not finite, and fails
        items += [*case.winding(), *case.table(), *case.bias()]
        try:
            items.append(case.residual())
        except (StateError, np.linalg.LinAlgError) as error:
            return (*items, Check.of("residual", np.inf, case.limit.residual, str(error)))
        items.append(case.simulation())
        follows = not any(item.failed for item in items[-2:])
        items += case.bounds()
        items += case.runups() if motion.periodic and follows else case.beginning()
        items += case.slew()
    return tuple(items)


def as_item(item: Check) -> dict[str, Any]:
    """An item for JSON; a value that is not finite is null."""
    value = item.value if math.isfinite(item.value) else None
    return {"name": item.quantity, "value": value, "limit": item.limit, "passed": not item.failed, "words": item.words}
