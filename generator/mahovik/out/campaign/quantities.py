"""`[[quantity]]` of a campaign file: a signal of the stand, and the number that is kept of it.

Arrays have moments first and samples last: a vector is (K, 3, n). Sums are written out, so that the bits of a sample do
not depend on how many others are beside it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from mahovik.core.stand import units
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.fields import FREQUENCY, Name, Text, scalar, text, validator, vector
from mahovik.core.stand.model import Stand
from mahovik.core.stand.tables import Table
from mahovik.core.stand.units import Dimension, QuantityError, show
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.measured.headers import sensors
from mahovik.use.numeric.se3 import Array
from mahovik.use.simulate.course import Moments
from mahovik.use.vibration.lines import in_band

AXES = ("x", "y", "z")
HOLD = "hold.reaction"
"""What holds a carrier, as a part that transmits force: its reaction, in E1 about O1."""
EVERY = "all"
"""In place of a flywheel's name: the largest magnitude of all flywheels at each moment."""


def _band(raw: Any) -> tuple[float, float]:
    low, high = vector(raw, (2,), FREQUENCY)
    if not 0.0 <= low < high:
        raise QuantityError(f"expected a lower and a higher frequency, found {low:g} Hz and {high:g} Hz")
    return low, high


class QuantityTable(Table):
    """One `[[quantity]]`.

    name   of its column
    what   a statistic and a signal, such as `"rms acceleration"`
    at     what the signal is of: a point, a flywheel, `carrier`, `hold.reaction`
    axis   one component of a vector, in place of its length
    band   lower and upper frequency, of an `rms`
    after  earlier times do not count
    """

    name: Name
    what: Text
    at: Annotated[str | None, validator(text)] = None
    axis: Annotated[str | None, validator(text)] = None
    band: Annotated[tuple[float, float] | None, validator(_band)] = None
    after: Annotated[float, scalar(units.TIME, least=0.0)] = 0.0


Errors = Callable[[Moments], tuple[Array, Array]]
"""Coordinates of the carrier less the required ones (K, m, n), and all as a share of the motion (K, 1, n)."""


class Scene:
    """What the signals of n samples are measured from.

    start     states (13 + 2 N, n) at the start; readings: what `points` gives there (24 S, n)
    errors    from the motion that a programme requires; None: there is no programme
    places    of points from O1, m (3, n), and `axes` as columns (3, 3, n), both in E1
    """

    def __init__(self, stand: Stand, start: Array, readings: Array, errors: Errors | None) -> None:
        self.stand, self.start, self.errors, self.C = stand, start, errors, rotation(start[3:7])
        n = start.shape[1]
        self.places = {stand.carrier.name: np.zeros((3, n))}
        self.axes = {stand.carrier.name: np.repeat(np.eye(3)[:, :, None], n, axis=2)}
        for name, numbers in zip(sensors(stand), readings.reshape(-1, 24, n), strict=True):
            self.places[name] = turn(self.C, numbers[:3] - start[:3], back=True)
            C = numbers[3:12].reshape(3, 3, n)
            self.axes[name] = np.stack([turn(self.C, C[:, j], back=True) for j in range(3)], axis=1)


@dataclass(frozen=True)
class Signal:
    """A signal in time.

    place      what it belongs to: a point, a sensor, a part that carries load, a flywheel; "" the motion of the carrier
    dimension  of its numbers; need: the result of the C that it is made of, or ""
    values     (K, c, n) of moments: three components of a point, sensor or part
    """

    place: str
    dimension: Dimension
    need: str
    values: Callable[[Quantity, Scene, Moments], Array]


@dataclass(frozen=True)
class Quantity:
    """One column of the rows.

    statistic  a key of STATISTICS; `what`: a key of SIGNALS
    at         a point, a part or a flywheel; `axis`: a component, "" for the length of a vector
    band       Hz, of `rms`; `after`: earlier times (s) do not count
    """

    name: str
    unit: str
    statistic: str
    what: str
    at: str
    axis: str
    band: tuple[float, float] | None
    after: float

    @staticmethod
    def of(table: QuantityTable, stand: Stand, over: str) -> Quantity:
        """What a table says, over a kind of run. Raises UsageError."""
        words = re.split(r"[ _]+", table.what.strip().lower())
        statistics = [word for word in words if word in STATISTICS]
        what = "_".join(word for word in words if word not in STATISTICS)
        if len(statistics) != 1 or not what:
            example = 'expected a statistic and a signal such as "rms acceleration"'
            raise UsageError(f"what: {example}, a statistic of {', '.join(STATISTICS)}; found {show(table.what)}")
        statistic = statistics[0]
        if what not in SIGNALS:
            raise UsageError(f"what: unknown {show(what)}{suggestion(what, SIGNALS)}")
        signal = SIGNALS[what]
        for word, allowed in (
            (what, SIGNALS_OVER.get(over, SIGNALS)),
            (statistic, ("peak", "rms") if over == "speeds" else STATISTICS),
        ):
            if word not in allowed:
                raise UsageError(f"what: no {word} over {over}; expected one of {', '.join(allowed)}")
        at = _place(stand, signal, table.at)
        axes = coordinates_of(stand).names if what == "error" else () if signal.place == "flywheel" else AXES
        if table.axis is not None and table.axis not in axes:
            raise UsageError(f"axis: {table.axis}: expected {'one of ' + ', '.join(axes) if axes else 'none'}")
        if table.band is not None and (statistic != "rms" or over == "states"):
            raise UsageError(f"band: only allowed with rms, and not over states, found {table.what} over {over}")
        if table.after and over in ("states", "speeds"):
            raise UsageError(f"after: not allowed over {over}")
        unit = signal.dimension.si.replace("^", "")
        if what == "error" and table.axis is not None:
            unit = coordinates_of(stand).unit_names[axes.index(table.axis)]
        return Quantity(table.name, unit, statistic, what, at, table.axis or "", table.band, table.after)

    @property
    def need(self) -> str:
        """The result of the C that it is made of, or ""."""
        return "reaction" if self.at == HOLD else SIGNALS[self.what].need

    @property
    def on_axes(self) -> bool:
        """Whether a vector is needed on fixed axes; otherwise its length alone counts."""
        return bool(self.axis or self.band)

    def values(self, scene: Scene, at: Moments) -> Array:
        """Values (K, c, n) of the signal at moments: one component, or three where the length counts."""
        values = SIGNALS[self.what].values(self, scene, at)
        return values[:, [AXES.index(self.axis)]] if self.axis and values.shape[1] == 3 else values

    def number(self, t: Array, values: Array) -> Array:
        """What is kept (n) of values (K, c, n) at times (K), s."""
        late = slice(int(np.count_nonzero(t < self.after * (1 - 1e-12))), None)
        t, values = t[late], values[late]
        if not len(t):
            return np.full(values.shape[2], np.nan)
        return band_rms(t, values, self.band) if self.band is not None else STATISTICS[self.statistic](values)


def _place(stand: Stand, signal: Signal, at: str | None) -> str:
    """The name that a signal belongs to; "" for the motion of the carrier. Raises UsageError."""
    wheels = tuple(s.name for s in stand.flywheels)
    known = {
        "point": (*sensors(stand), stand.carrier.name),
        "sensor": sensors(stand),
        "part": (*((HOLD,) if stand.hold is not None else ()), *wheels),
        "flywheel": (*wheels, EVERY) if wheels else (),
        "": (),
    }[signal.place]
    if not signal.place:
        if at is not None:
            raise UsageError("at: not allowed, the signal is of the whole stand")
        return ""
    if at is None:
        raise UsageError(f"at: required, but missing; expected one of {', '.join(known) or 'none: there is none'}")
    if at not in known:
        raise UsageError(f'at: unknown "{at}"{suggestion(at, known, "the stand has none")}')
    return at


# -- signals ---------------------------------------------------------------------------------------------------------


def _acceleration(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    V, r, omega = at.state[:, 7:10], scene.places[quantity.at], at.state[:, 10:13]
    values = at.V_dot[:, :3] + cross(omega, V + cross(omega, r)) + cross(at.V_dot[:, 3:], r)
    return _on_axes(quantity, scene, at, values)


def _velocity(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    return _on_axes(quantity, scene, at, at.state[:, 7:10] + cross(at.state[:, 10:13], scene.places[quantity.at]))


def _on_axes(quantity: Quantity, scene: Scene, at: Moments, values: Array) -> Array:
    """A vector in E1 on the axes that the point has at the start; as it is where its length alone counts."""
    if not quantity.on_axes:
        return values
    fixed = turn(rotation(at.state[:, 3:7]), values)
    return turn(scene.axes[quantity.at], turn(scene.C, fixed, back=True), back=True)


def _displacement(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    r = scene.places[quantity.at]
    values = (at.state[:, :3] - scene.start[:3]) + (turn(rotation(at.state[:, 3:7]), r) - turn(scene.C, r))
    return turn(scene.axes[quantity.at], turn(scene.C, values, back=True), back=True) if quantity.on_axes else values


def _angle(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    values = rotation_vector(scene.start[3:7], at.state[:, 3:7])
    return turn(scene.axes[quantity.at], values, back=True) if quantity.on_axes else values


def _rate(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    return turn(scene.axes[quantity.at], at.state[:, 10:13], back=True) if quantity.on_axes else at.state[:, 10:13]


def _specific_force(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    first = 24 * sensors(scene.stand).index(quantity.at) + 18
    return at.readings[:, first : first + 3]


def _load(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    first, values = (0 if quantity.what == "force" else 3), at.reaction
    if quantity.at != HOLD:
        first, values = first + 6 * [s.name for s in scene.stand.flywheels].index(quantity.at), at.loads
    return values[:, first : first + 3]


def _of_flywheel(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    N = len(scene.stand.flywheels)
    speed = at.state[:, 13 + N :]
    values = {"torque": at.tau, "speed": speed}.get(quantity.what)
    values = at.tau * speed if values is None else values
    if quantity.at == EVERY:
        return np.asarray(np.abs(values).max(axis=1, keepdims=True))
    return values[:, [[s.name for s in scene.stand.flywheels].index(quantity.at)]]


def _error(quantity: Quantity, scene: Scene, at: Moments) -> Array:
    assert scene.errors is not None
    coordinates, share = scene.errors(at)
    return coordinates[:, [coordinates_of(scene.stand).names.index(quantity.axis)]] if quantity.axis else share


SIGNALS: Mapping[str, Signal] = {
    "acceleration": Signal("point", units.ACCELERATION, "V_dot", _acceleration),
    "velocity": Signal("point", units.VELOCITY, "", _velocity),
    "displacement": Signal("point", units.LENGTH, "", _displacement),
    "angle": Signal("point", units.ANGLE, "", _angle),
    "rate": Signal("point", units.SPEED, "", _rate),
    "specific_force": Signal("sensor", units.ACCELERATION, "readings", _specific_force),
    "force": Signal("part", units.FORCE, "loads", _load),
    "moment": Signal("part", units.TORQUE, "loads", _load),
    "torque": Signal("flywheel", units.TORQUE, "tau", _of_flywheel),
    "power": Signal("flywheel", Dimension("a power", "W"), "tau", _of_flywheel),
    "speed": Signal("flywheel", units.SPEED, "", _of_flywheel),
    "error": Signal("", units.PLAIN, "", _error),
}
"""Signals by the word in `what`."""

SIGNALS_OVER: Mapping[str, tuple[str, ...]] = {
    "regime": tuple(name for name in SIGNALS if name != "error"),
    "speeds": ("acceleration", "velocity", "displacement", "angle", "rate", "force", "moment"),
    "states": tuple(name for name in SIGNALS if name not in ("displacement", "angle", "error")),
}
"""Those over a kind of run; all over others."""


# -- statistics ------------------------------------------------------------------------------------------------------


def _square(values: Array) -> Array:
    """v . v (K, n), of any number of components."""
    return np.asarray(sum(values[:, i] ** 2 for i in range(values.shape[1])))


def _size(values: Array) -> Array:
    """The value where there is one component, else the length, (K, n)."""
    return values[:, 0] if values.shape[1] == 1 else np.sqrt(_square(values))


STATISTICS: Mapping[str, Callable[[Array], Array]] = {
    "peak": lambda values: np.sqrt(_square(values).max(axis=0)),
    "rms": lambda values: np.sqrt(np.add.reduce(_square(values), axis=0) / len(values)),
    "mean": lambda values: np.add.reduce(_size(values), axis=0) / len(values),
    "least": lambda values: _size(values).min(axis=0),
    "end": lambda values: _size(values[-1:])[0],
}
"""Numbers (n) of values (K, c, n): of a vector without an axis, of its length."""


def band_rms(t: Array, values: Array, band: tuple[float, float]) -> Array:
    """Root mean square (n) of the part of values (K, c, n) within a band (Hz), by the spectrum of the whole run.

    The mean is subtracted and a Hann window is put on, so that what has no whole number of periods does not spill over
    the spectrum; the sum is divided by the mean square of the window.
    """
    every = t[1] - t[0]
    even = int(np.count_nonzero(np.abs(np.diff(t) - every) <= 1e-6 * every)) + 1  # a last moment may be nearer
    samples = np.ascontiguousarray(values[:even].transpose(2, 1, 0))  # a sample by itself, whatever the others are
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * (np.arange(even) + 0.5) / even)
    power = np.abs(np.fft.rfft((samples - samples.mean(axis=-1, keepdims=True)) * window)) ** 2
    power[..., 1 : (even + 1) // 2] *= 2.0
    inside = in_band(np.fft.rfftfreq(even, every), band)
    sums = np.ascontiguousarray(power[..., inside]).sum(axis=-1)
    return np.asarray(np.sqrt(sum(sums.T) / even / (window**2).sum()))


# -- vectors and rotations of many samples ---------------------------------------------------------------------------


def rotation(q: Array) -> Array:
    """C (..., 3, 3, n) of quaternions (..., 4, n), w first, of any length but zero."""
    w, x, y, z = (q[..., i, :] for i in range(4))
    s = 2.0 / (w * w + x * x + y * y + z * z)
    sx, sy, sz = s * x, s * y, s * z
    wx, wy, wz, xx, xy, xz, yy, yz, zz = w * sx, w * sy, w * sz, x * sx, x * sy, x * sz, y * sy, y * sz, z * sz
    rows = ((1 - (yy + zz), xy - wz, xz + wy), (xy + wz, 1 - (xx + zz), yz - wx), (xz - wy, yz + wx, 1 - (xx + yy)))
    return np.stack([np.stack(row, axis=-2) for row in rows], axis=-3)


def turn(C: Array, v: Array, back: bool = False) -> Array:
    """C v, or C^T v: C (..., 3, 3, n), v (..., 3, n)."""
    C = np.swapaxes(C, -3, -2) if back else C
    return np.stack([sum(C[..., i, j, :] * v[..., j, :] for j in range(3)) for i in range(3)], axis=-2)


def cross(a: Array, b: Array) -> Array:
    """a x b, (..., 3, n)."""
    (a1, a2, a3), (b1, b2, b3) = ((v[..., 0, :], v[..., 1, :], v[..., 2, :]) for v in (a, b))
    result = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, (p, q, r, s) in enumerate(((a2, b3, a3, b2), (a3, b1, a1, b3), (a1, b2, a2, b1))):
        np.multiply(p, q, out=result[..., i, :])
        result[..., i, :] -= r * s
    return result


def rotation_vector(start: Array, q: Array) -> Array:
    """Rotation vector (..., 3, n), of length at most pi, from quaternions `start` (4, n) to others (..., 4, n)."""
    (a, b, c, d), (w, x, y, z) = ([quaternion[..., i, :] for i in range(4)] for quaternion in (start, q))
    real = a * w + b * x + c * y + d * z
    result = np.empty(q[..., 1:, :].shape)
    result[..., 0, :] = a * x - b * w - c * z + d * y
    result[..., 1, :] = a * y + b * z - c * w - d * x
    result[..., 2, :] = a * z - b * y + c * x - d * w
    sine = np.sqrt(result[..., 0, :] ** 2 + result[..., 1, :] ** 2 + result[..., 2, :] ** 2)
    small = sine < 1e-12
    angle = 2.0 * np.arctan2(sine, np.abs(real)) / np.where(small, 1.0, sine)
    return np.asarray(result * np.copysign(np.where(small, 2.0, angle), real)[..., None, :])
