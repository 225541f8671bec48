"""From wrenches of the wheels on their mounts to what is seen: internal modes, rigid carrier, structural modes.

All of it is linear and one-way: nothing that is driven here acts back on the wheels. Of makers' harmonics, of broadband
noise, and of the whole equations (8) at one set of speeds and phases.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.use.numeric.se3 import Array, Complex, skew
from mahovik.use.vibration.lines import COMBINATION, MAKER, SAME, UNBALANCE, LineName, Lines, Spectrum
from mahovik.use.vibration.maker import PARTS, PATTERNS, Harmonics, InnerModes, Noise, Structure, way_back
from mahovik.use.vibration.plant import Plant, Scene
from mahovik.use.vibration.steady import SLOW, Steady, rounding_rates, rounding_wrench
from mahovik.use.vibration.torus import Whole
from mahovik.use.vibration.view import LinearMotion, LoadView, Observable, View

CHUNK = 2_000_000
"""Speeds, lines and modes treated at once: their product."""


@dataclass(frozen=True, eq=False)
class Makers:
    """What makers and analysts say: of wheels by name, and of the structure."""

    harmonics: Mapping[str, Harmonics] = field(default_factory=dict)
    noise: Mapping[str, Noise] = field(default_factory=dict)
    inner: Mapping[str, InnerModes] = field(default_factory=dict)
    structure: Structure | None = None


@dataclass(frozen=True, eq=False)
class Chain:
    """Linear chain of a stand.

    mount_transfer  (N, 6, 6): transfer of a wheel's mount, axes at phase 0, to E1 about O1
    Theta, gyro  (N, 6, 6): mean inertia of each wheel in E1 about O1; wrench on the carrier by V, at a speed of 1
    tilting      (N, 6, 3): wrench of each wheel's mean weight on the carrier by a turning of it, in E1 about O1
    seen_modes   (3, m): what is seen of each structural mode
    mount_modes  (N, m, 6): modal forces of wrenches of a wheel on its mount, in E1 about O1
    ratios       mass_ratio, gyro_ratio of `structure.way_back`
    """

    plant: Plant
    seen: Observable
    makers: Makers
    names: tuple[str, ...]
    mount_transfer: Array
    Theta: Array
    gyro: Array
    tilting: Array
    seen_modes: Array
    mount_modes: Array
    ratios: tuple[Array, Array]

    @staticmethod
    def of(scene: Scene, seen: Observable, makers: Makers, fastest: Array) -> Chain:
        """The chain for speeds of up to `fastest` (N, rad/s).

        Raises TableError: a shape is missing; UsageError: structural modes, but a load is seen.
        """
        tables, names = scene.chart.mechanics.tables, tuple(s.name for s in scene.stand.flywheels)
        plant, N, structure = Plant.of(scene), len(names), makers.structure
        Theta = tables.Theta[0]
        gyro = plant.free.gyro
        tilting = tables.weight[0] @ skew(scene.chart.frame.C.T @ np.array(scene.stand.gravity))
        if structure is None:
            none = np.zeros((3, 0))
            ratios = (np.zeros(0), np.zeros(0))
            unseen = np.zeros((N, 0, 6))
            return Chain(plant, seen, makers, names, tables.Lm, Theta, gyro, tilting, none, unseen, ratios)
        if isinstance(seen, LoadView) or not seen.parts:
            what = "load" if isinstance(seen, LoadView) else "freedom"
            raise UsageError(f"modes: structural modes have no shape of a {what}, {seen.name}; expected a point")
        about = np.array([_to_mount(L) for L in tables.Lm])
        modes = np.zeros((N, len(structure.omega), 6))
        for s, name in enumerate(names):
            if fastest[s] > 0.0 or name in structure.shapes:
                modes[s] = structure.at(name, "the mount of").T @ about[s]
        local = np.array([about[s] @ Theta[s] @ about[s].T for s in range(N)])
        spin = tables.axis * (tables.Theta_ff * fastest)[:, None]
        ratios = way_back(structure, names, local, spin)
        return Chain(plant, seen, makers, names, tables.Lm, Theta, gyro, tilting, seen.shape(structure), modes, ratios)

    @property
    def modes(self) -> list[tuple[float, float]]:
        """Natural frequency (rad/s) and damping of all internal and structural modes."""
        modes = [mode for inner in self.makers.inner.values() for mode in inner.modes.values()]
        if self.makers.structure is not None:
            modes += list(zip(self.makers.structure.omega, self.makers.structure.damping, strict=True))
        return modes

    @property
    def one_way(self) -> bool:
        """Whether mount wrenches drive anything beside the rigid carrier."""
        return bool(self.makers.inner) or self.makers.structure is not None

    def driven_amplitudes(self, speeds: Array, omega: Array, mounts: Complex) -> Complex:
        """Amplitudes (S, L, 3) in addition to the rigid motion, by rigid mount wrenches (S, L, N, 6) in E1 about O1.

        speeds (S, N; rad/s), omega (S, L; rad/s, above 0).
        """
        passed = self._transmit(speeds, omega, mounts)
        relative = (passed - mounts)[..., None]
        a = self.bent(omega, passed)
        if relative.any():
            a += self.seen.linear(self.motion(speeds, omega, relative.sum(axis=2), lambda s: relative[:, :, s]))[..., 0]
        return a

    def bent(self, omega: Array, mounts: Complex) -> Complex:
        """Amplitudes (S, L, 3) of what the structural modes move, by mount wrenches (S, L, N, 6) in E1 about O1."""
        if self.makers.structure is None:
            return np.zeros((*omega.shape, 3), dtype=np.complex128)
        modes = self.mount_modes.transpose(0, 2, 1).reshape(-1, self.mount_modes.shape[1])
        force = mounts.reshape(*omega.shape, 6 * len(self.names)) @ modes.astype(np.complex128)
        q = np.where(force == 0.0, 0.0, force * self.makers.structure.compliance(omega))
        return np.asarray((q @ self.seen_modes.T) * self.seen.measure.derivative(omega)[..., None])

    def motion(self, speeds: Array, omega: Array, wrench: Complex, by_wheel: Callable[[int], Complex]) -> LinearMotion:
        """Motion of the rigid carrier by wrenches (S, L, 6, P) on it in E1 about O1; `by_wheel`: those of one wheel."""
        pose = self.plant.pose(speeds, omega, wrench)

        def reaction() -> Complex:
            return self.plant.reaction(speeds, omega, pose, wrench)

        def mount(s: int) -> Complex:
            on_carrier = self.mount_reply(s, speeds, omega, pose) + by_wheel(s)
            return np.asarray(-np.linalg.inv(self.mount_transfer[s]) @ on_carrier)

        return LinearMotion(omega, pose, reaction, mount)

    def by_unbalance(self, speeds: Array, omega: Array, wrench: Complex) -> LinearMotion:
        """Motion by the first order of each flywheel: line l is of wheel l, wrench (S, N, 6)."""
        wheels = np.arange(wrench.shape[1])

        def by_wheel(s: int) -> Complex:
            return np.where(wheels == s, 1.0, 0.0)[:, None, None] * wrench[..., None]

        return self.motion(speeds, omega, wrench[..., None], by_wheel)

    def first_orders(self, speeds: Array, phases: Array) -> tuple[Array, Complex]:
        """omega (S, N; rad/s) and amplitudes (S, N, 3) of the first orders, to first order in unbalance.

        Speeds (S, N; rad/s), phases (N, rad) at t = 0; zero for a wheel at rest, NaN at an undamped resonance.
        """
        omega, wrench = self.plant.unbalance(speeds, phases)
        still = omega == 0.0
        positive = np.where(still, 1.0, omega)
        motion = self.by_unbalance(speeds, positive, wrench)
        a = self.seen.linear(motion)[..., 0]
        if self.one_way:
            mounts = self.mounts(speeds, positive, motion.pose[..., 0])
            wheels = np.arange(wrench.shape[1])
            mounts[:, wheels, wheels] += wrench
            a += self.driven_amplitudes(speeds, positive, mounts)
        a[still] = 0.0
        return omega, np.asarray(a, dtype=np.complex128)

    def _transmit(self, speeds: Array, omega: Array, mounts: Complex) -> Complex:
        """Mount wrenches after the internal modes of the wheels."""
        transmit = mounts.astype(np.complex128)
        for s, name in enumerate(self.names):
            inner = self.makers.inner.get(name)
            if inner is not None:
                on_wheel = mounts[:, :, s] @ np.linalg.inv(self.mount_transfer[s]).T
                transmit[:, :, s] = inner.transmit(on_wheel, omega, speeds[:, s, None]) @ self.mount_transfer[s].T
        return transmit

    def mounts(self, speeds: Array, omega: Array, pose: Complex) -> Complex:
        """Wrenches (S, L, N, 6) of wheels on their mounts by the carrier's motion: inertia and spin, to first order."""
        V = 1j * omega[..., None] * pose
        shape = (*omega.shape, len(self.names), 6)
        inertial = (1j * omega[..., None] * V @ self.Theta.reshape(-1, 6).T).reshape(shape)
        turning = (V @ self.gyro.reshape(-1, 6).T).reshape(shape) * speeds[:, None, :, None]
        return np.asarray(turning - inertial)

    def mount_reply(self, s: int, speeds: Array, omega: Array, pose: Complex) -> Complex:
        """Wrench (S, L, 6, P) of wheel s on its mount by the carrier's pose (S, L, 6, P), its weight among it."""
        w = omega[:, :, None, None]
        turning = 1j * w * np.einsum("ij,tljp,t->tlip", self.gyro[s], pose, speeds[:, s])
        return np.asarray(w**2 * (self.Theta[s] @ pose) + turning + self.tilting[s] @ pose[:, :, 3:])

    def table_lines(self, speeds: Array) -> Lines:
        """Lines of the makers' harmonics at speeds (S, N; rad/s), each part of each order by itself."""
        lines = Lines.none(len(speeds))
        for s, name in enumerate(self.names):
            table = self.makers.harmonics.get(name)
            if table is not None:
                lines = lines.join(self.wheel_lines(s, table, speeds))
        return lines

    def wheel_lines(self, s: int, table: Harmonics, speeds: Array) -> Lines:
        """Lines of wheel s by its table at speeds (S, N; rad/s), each part of each order by itself."""
        there = np.flatnonzero(table.amplitude.any(axis=0))
        omega = np.abs(speeds[:, s, None]) * table.order
        still = omega == 0.0
        size = table.amplitude[:, there] * np.where(still, 0.0, 1.0)[..., None] * (speeds[:, s] ** 2)[:, None, None]
        forward, backward = self.unit_answers(s, there, speeds, np.where(still, 1.0, omega))  # (S, H, 3, P) each
        sense = np.array(table.sense)[:, None, None]
        larger = np.where(np.isnan(forward) | (np.abs(backward) <= np.abs(forward)), forward, backward)
        answer = np.where(sense == "forward", forward, np.where(sense == "backward", backward, larger))
        a = np.moveaxis(answer * size[:, :, None, :], 3, 2).reshape(len(speeds), -1, 3)
        parts, sides = [list(PARTS)[i] for i in there], [" backward" * (word == "backward") for word in table.sense]
        names = [
            LineName(self.names[s], float(order), MAKER, part + side * part.startswith("radial"), float(tolerance))
            for order, side, tolerance in zip(table.order, sides, table.tolerance, strict=True)
            for part in parts
        ]
        kept = (table.amplitude[:, there] > 0.0).ravel()
        frequency = np.repeat(omega / (2.0 * np.pi), len(parts), axis=1)
        return Lines(tuple(names), frequency, np.asarray(a, dtype=np.complex128)).select(kept)

    def unit_answers(self, s: int, parts: Whole, speeds: Array, omega: Array) -> Complex:
        """Amplitudes (2, S, L, 3, P) by parts of wheel s with amplitude 1 at omega (S, L; rad/s, above 0).

        Radial parts turn with the wheel in the first, against it in the second.
        """
        S, L = omega.shape
        used = np.flatnonzero(PATTERNS[parts].any(axis=0))  # axes of the mount: what is seen is linear in them
        wrench, basis = self.mount_transfer[s][:, used].astype(np.complex128), PATTERNS[parts][:, used].T + 0.0
        sense = np.where(speeds[:, s] < 0.0, -1.0, 1.0)[:, None]
        a = np.empty((2, S, L, 3, len(parts)), dtype=np.complex128)
        step = max(1, CHUNK // max(L * len(self.names) * max(len(self.seen_modes.T), 6), 1))
        for i in range(0, S, step):
            at = slice(i, i + step)
            motion = self.motion(speeds[at], omega[at], wrench, partial(_of_wheel, s, wrench))
            by_axis = self.seen.linear(motion)
            if self.makers.structure is not None:
                by_axis = by_axis + self._bent_by_axis(s, wrench, speeds[at], motion)
            by_axis = by_axis.reshape(len(by_axis), 3 * L, len(used))
            for k, side in enumerate((sense[at], -sense[at])):
                turned = np.where(side[:, :, None] < 0.0, basis.conj(), basis)
                a[k, at] = (by_axis @ turned).reshape(-1, L, 3, len(parts))
        if self.names[s] in self.makers.inner:
            for k, side in enumerate((sense, -sense)):
                a[k] *= self._part_gains(s, parts, side * omega, speeds[:, s, None])[:, :, None]
        return a

    def _bent_by_axis(self, s: int, wrench: Complex, speeds: Array, motion: LinearMotion) -> Complex:
        """`bent` (S, L, 3, P) by wrenches (6, P) of wheel s and the wheels' replies to the carrier's motion by them.

        One transfer a line from motion and wrench to what is seen, whatever number of wrenches.
        """
        structure, omega, pose = self.makers.structure, motion.omega, motion.pose
        assert structure is not None
        (S, L), m = omega.shape, len(structure.omega)
        way = np.einsum("km,smj->smkj", self.seen_modes, self.mount_modes).astype(np.complex128)
        inertial = np.einsum("smkj,sji->mki", way, self.Theta).reshape(m, 18)
        turning = np.tensordot(speeds, np.einsum("smkj,sji->smki", way, self.gyro), axes=1).reshape(S, m, 18)
        compliance, w = structure.compliance(omega), omega[..., None]
        by_pose = w**2 * (compliance @ inertial) + 1j * w * (compliance @ turning)
        direct = (compliance @ (way[s] @ wrench).reshape(m, -1)).reshape(S, L, 3, -1)
        a = (by_pose.reshape(S, L, 3, 6) @ pose + direct) * self.seen.measure.derivative(omega)[..., None, None]
        for i, k in np.argwhere(np.isnan(compliance).any(axis=2)):  # met without damping: whether it is driven counts
            for p in range(wrench.shape[1]):
                mounts = self.mounts(speeds[i : i + 1], omega[i : i + 1, k : k + 1], pose[i : i + 1, k : k + 1, :, p])
                mounts[0, 0, s] += wrench[:, p]
                a[i, k, :, p] = self.bent(omega[i : i + 1, k : k + 1], mounts)[0, 0]
        return np.asarray(a)

    def _part_gains(self, s: int, parts: Whole, signed: Array, speed: Array) -> Complex:
        inner = self.makers.inner[self.names[s]]
        kinds = {"radial force": "radial", "axial force": "axial", "radial moment": "rocking", "axial moment": ""}
        gains_of_parts = [inner.gain(kinds[list(PARTS)[i]], signed, speed) for i in parts]
        gains = np.stack(gains_of_parts, axis=-1)
        return np.where(signed[..., None] < 0.0, gains.conj(), gains)


def _of_wheel(s: int, wrench: Complex, wheel: int) -> Complex:
    """The wrench of a wheel where it is that of wheel s alone."""
    return wrench if wheel == s else np.zeros_like(wrench)


def undamped_mode(makers: Makers, names: Sequence[str], speeds: Array, omega: float) -> str | None:
    """The mode without damping that vibrates at omega (rad/s), in words; speeds (N, rad/s) of the wheels."""
    structure = makers.structure
    if structure is not None:
        met = np.flatnonzero(structure.is_resonant(np.array(omega)))
        if len(met):
            return f"structural mode {met[0] + 1} of {structure.path}"
    for s, name in enumerate(names):
        inner = makers.inner.get(name)
        for kind in inner.modes if inner is not None else ():
            both = inner.gain(kind, np.array([omega, -omega]), speeds[s]) if inner is not None else np.zeros(0)
            if not np.isfinite(both).all():
                return f"the {kind} mode inside {name}"
    return None


def _to_mount(L: Array) -> Array:
    """(6, 6): a wrench in E1 about O1 as one in E1 about Os; L: transfer of the wheel's frame to E1 about O1."""
    arm = L[3:, :3] @ L[:3, :3].T  # <Os>
    mount = np.eye(6)
    mount[3:, :3] = -arm
    return mount


GRID = 600
"""Frequencies of the density, even in their logarithm, beside those of the tables and of modes."""

AROUND = np.linspace(-25.0, 25.0, 101)
"""Frequencies about a structural mode, in half widths of its peak."""

AT_ONCE = 100_000
"""Speeds and frequencies treated at once: their product."""

Band = tuple[float, float]


def noise(chain: Chain, speeds: Array, bands: Sequence[Band | None]) -> Array:
    """Mean square (bands, S, 3) at speeds (S, N; rad/s) within bands (Hz; None: all); zero without a table of noise.

    Independent radial axes are half a forward and half a backward turning vector. Raises CheckError: noise drives a
    mode without damping, and its mean square is infinite.
    """
    result = np.zeros((len(bands), len(speeds), 3))
    if not chain.makers.noise:
        return result
    f = _grid(chain)
    radial, parts = np.array(["radial" in part for part in PARTS]), np.arange(len(PARTS))
    step = max(1, AT_ONCE // len(f))
    for i in range(0, len(speeds), step):
        rows = speeds[i : i + step]
        omega = np.broadcast_to(2.0 * np.pi * f, (len(rows), len(f)))
        density = np.zeros((len(rows), len(f), 3))
        for s, name in enumerate(chain.names):
            table = chain.makers.noise.get(name)
            if table is not None:
                forward, backward = np.abs(chain.unit_answers(s, parts, rows, omega)) ** 2
                gain = np.where(radial, (forward + backward) / 2.0, forward)
                source = np.stack([np.interp(f, table.frequency, d, 0.0, 0.0) for d in table.density.T], axis=1)
                density += (gain * source[:, None, :]).sum(axis=3)
        for k, band in enumerate(bands):
            result[k, i : i + step] = integral(f, density, band or (0.0, np.inf))
    return result


def integral(f: Array, density: Array, band: Band) -> Array:
    """Integral (S, 3) of a density (S, F, 3), linear between frequencies (F, Hz) and zero outside, over a band."""
    low, high = max(band[0], f[0]), min(band[1], f[-1])
    if low >= high:
        return np.zeros((len(density), 3))
    x = np.unique(np.concatenate([[low, high], f[(f > low) & (f < high)]]))
    i = np.clip(np.searchsorted(f, x, side="right") - 1, 0, len(f) - 2)
    share = ((x - f[i]) / (f[i + 1] - f[i]))[:, None]
    return np.asarray(np.trapezoid((1.0 - share) * density[:, i] + share * density[:, i + 1], x, axis=1))


def _grid(chain: Chain) -> Array:
    """Frequencies from the lowest to the highest of the tables, dense about modes. Raises CheckError."""
    tables = list(chain.makers.noise.values())
    low = min(float(table.frequency[0]) for table in tables)
    high = max(float(table.frequency[-1]) for table in tables)
    grids = [np.geomspace(low, high, GRID), *(table.frequency for table in tables)]
    for omega, damping in chain.modes:
        hertz = omega / (2.0 * np.pi)
        if damping == 0.0 and low <= hertz <= high:
            raise CheckError(f"noise drives a mode of {hertz:.6g} Hz without damping: expected a damping above 0")
        grids.append(hertz * (1.0 + max(damping, 1e-4) * AROUND))
    f = np.unique(np.concatenate(grids))
    return f[(f >= low) & (f <= high)]


LOAD_ROUNDING = 1e-13
"""Part of a constant load, as of a weight, below which a line is rounding."""

WRENCH_ROUNDING = 1e-13
"""Part of a mount's largest wrench below which a harmonic of it drives nothing: a mode without damping would ring."""


def spectrum(motion: Steady, chain: Chain) -> Spectrum:
    """Lines of a motion."""
    scene = motion.scene
    torus, w, full = motion.torus, motion.frequencies, motion.full()
    a = torus.coefficients(chain.seen.full(full))
    rounding = _rounding(scene, chain.seen, motion.speeds, w, a[0].real.copy())
    moving, back = np.abs(w) > SLOW * float(np.abs(motion.speeds).max(initial=0.0)), w[:, None] < 0.0
    a = np.where(back, a.conj(), a)
    if chain.one_way:
        mounts = torus.coefficients(full.mount_wrenches())
        mounts = np.where(back[..., None], mounts.conj(), mounts)[moving]
        a[moving] += _driven(chain, motion.speeds, np.abs(w[moving]), mounts)
    left = np.zeros(3)
    if len(motion.base) > 1:
        left = left_out_of(motion, chain.seen)
        left = np.where(left <= rounding[moving].sum(), 0.0, left)
    kept = moving & ~(np.abs(a).max(axis=1) <= rounding)
    w = np.abs(w)
    order = np.flatnonzero(kept)[np.argsort(w[kept], kind="stable")]
    first = np.flatnonzero(np.concatenate([[True], np.diff(w[order]) > SAME * w[order][1:]])[: len(order)])
    groups = np.split(order, first[1:]) if len(order) else []
    names = [s.name for s in scene.stand.flywheels]
    return Spectrum(
        tuple(_name(lowest, names) for lowest in _lowest(motion, groups)),
        w[order][first] / (2.0 * np.pi),
        np.array([a[group].sum(axis=0) for group in groups], dtype=np.complex128).reshape(-1, 3),
        left,
        motion.left_out,
        motion.method,
        motion.hold,
        motion.unstable,
    )


def _driven(chain: Chain, speeds: Array, omega: Array, mounts: Complex) -> Complex:
    """Amplitudes (n, 3) that mount wrenches (n, N, 6) at omega (n; rad/s, above 0) drive."""
    rounding = np.abs(mounts) <= WRENCH_ROUNDING * np.abs(mounts).max(axis=0, initial=0.0)
    return np.asarray(chain.driven_amplitudes(speeds[None], omega[None], np.where(rounding, 0.0, mounts)[None])[0])


def _lowest(motion: Steady, groups: Sequence[Whole]) -> list[Whole]:
    """Combinations k (g, N) of the wheels of the lowest order, sum |k_s|, that have the frequency of a group of lines.

    Of a harmonic of a common period all that are orders of one wheel, else one of several wheels.
    """
    if len(motion.base) > 1:
        sizes = [np.abs(motion.torus.k[group]).sum(axis=1) for group in groups]
        kept = [group[size == size.min()] for group, size in zip(groups, sizes, strict=True)]
        return [motion.torus.k[group] @ motion.turns.T for group in kept]
    harmonics, turns = [abs(int(motion.torus.k[group[0], 0])) for group in groups], motion.turns.ravel().tolist()
    known, result = combinations(turns, max(harmonics, default=0)), []
    for n in harmonics:
        orders = np.diag([n // turn if turn and n % turn == 0 else 0 for turn in turns])
        single = orders[np.abs(orders).sum(axis=1) == np.abs(known[n]).sum()]
        result.append(single if len(single) else known[n][None])
    return result


def combinations(turns: Sequence[int], most: int) -> dict[int, Whole]:
    """The smallest combination of the wheels' turns that gives each n from -most to most, by n.

    That is whole numbers k (N) with k . turns = n and the least sum |k_s|. `turns` have no common divisor.
    """
    reach, zero = most + max(map(abs, turns), default=0), np.zeros(len(turns), dtype=np.int64)
    steps = dict[int, Whole]()
    for turn, unit in zip(turns, np.eye(len(turns), dtype=np.int64), strict=True):
        if turn and turn not in steps:
            steps |= {turn: unit, -turn: -unit}
    result, last = {0: zero}, [0]
    while last:
        reached = dict[int, Whole]()
        for at in last:
            more = {at + step: result[at] + k for step, k in steps.items() if abs(at + step) <= reach}
            reached = {n: k for n, k in more.items() if n not in result} | reached
        result, last = result | reached, [*reached]
    return result


def _name(lowest: Whole, wheels: Sequence[str]) -> LineName:
    """Name of a line by its combinations of the lowest order: that of single wheels before that of several."""
    size, single = float(np.abs(lowest[0]).sum()), lowest[np.count_nonzero(lowest, axis=1) == 1]
    if len(single):
        return LineName(", ".join(wheels[s] for s in np.flatnonzero(single.any(axis=0)).tolist()), size, UNBALANCE)
    k = max(lowest.tolist(), key=lambda k: [abs(n) for n in k])
    words, sign = "", 1 if next(filter(None, k)) > 0 else -1
    for n, name in zip(k, wheels, strict=True):
        if n:
            words += (" + " if sign * n > 0 else " - ") * bool(words) + (f"{abs(n)} " if abs(n) > 1 else "") + name
    return LineName(words, size, COMBINATION)


def left_out_of(motion: Steady, seen: Observable) -> Array:
    """Part of the quantity (3) that a motion leaves out at any phases: sum of the amplitudes of its lines.

    The lines are those of `Steady.missing`, of the rigid stand and to first order; NaN where they are not known. Those
    of a load are what the missing motion and the higher orders add to it.
    """
    missing = motion.missing
    if missing is None:
        return np.full(3, np.nan)
    moving, larger = missing.w != 0.0, missing.torus
    if isinstance(seen, View):
        return np.asarray(np.abs(seen.by_pose(missing.pose[moving], np.abs(missing.w[moving]))).sum(axis=0))
    near = larger.pad(motion.torus.coefficients(seen.full(motion.full())))
    whole = seen.full(motion.full(larger, larger.pad(motion.c) + missing.c))
    return np.asarray(np.abs(larger.coefficients(whole) - near)[moving].sum(axis=0))


def _rounding(scene: Scene, seen: Observable, speeds: Array, w: Array, constant: Array) -> Array:
    """Amplitudes (n) of the quantity that rounding makes at w (n; rad/s), beside a constant part (3)."""
    if isinstance(seen, LoadView):
        wrench = rounding_wrench(scene, speeds)[seen.rows].max()
        return np.full(len(w), max(LOAD_ROUNDING * float(np.abs(constant).max(initial=0.0)), float(wrench)))
    fastest = float(np.abs(speeds).max(initial=0.0)) or 1.0
    slow = np.maximum(np.abs(w), SLOW * fastest)
    pose = scene.twist(rounding_rates(scene, speeds)[None]) / (fastest * slow[:, None])
    return np.asarray(np.abs(seen.by_pose(pose.astype(np.complex128), slow)).max(axis=1))
