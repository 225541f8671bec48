"""Numbers of a stand that vary, `[vary]` and `[[correlation]]` of a campaign file, by distributions of scipy.stats; and
designs: where the samples are in the unit cube of all factors, and what a design tells of them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.random import Generator, Philox
from scipy import stats
from scipy.special import ndtr, ndtri
from scipy.stats import qmc, sobol_indices

from mahovik.core.stand.fields import any_list, require_bounds, text, vector
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import PLAIN, SPEED, Dimension, QuantityError, number, show
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.numeric.se3 import Array

DESIGNS = ("random", "latin", "sobol", "morris", "saltelli")
IN_BLOCKS = ("morris", "saltelli")
"""Designs whose samples change one factor after the other."""

LEVELS = 4
"""Levels of a factor in Morris' design."""

MOST_HELD = 100_000_000
"""Numbers of a Latin hypercube or of Morris' design, at most: every process makes them whole."""

_PER_COUNT = 4
"""Numbers of 64 bits that Philox makes of one count."""


@dataclass(frozen=True)
class Design:
    """Samples in the unit cube of the factors; any range can be asked for, in any process, with the same bits.

    wanted  samples; those of designs in blocks are rounded up to whole blocks
    """

    kind: str
    factors: tuple[str, ...]
    wanted: int
    seed: int

    @property
    def block(self) -> int:
        """Samples that belong together: a trajectory of Morris, or a pair of points that exchange their factors."""
        return {"morris": len(self.factors) + 1, "saltelli": len(self.factors) + 2}.get(self.kind, 1)

    @property
    def samples(self) -> int:
        """Number of samples."""
        return -(-self.wanted // self.block) * self.block

    def unit(self, first: int, count: int) -> Array:
        """Samples from `first` on (count, factors), in 0..1."""
        d = len(self.factors)
        if not d or not count:
            return np.zeros((count, d))
        if self.kind == "random":
            return np.column_stack([self._uniform(name, first, count) for name in self.factors])
        if self.kind == "latin":
            columns = [_latin_column(self.seed, name, self.samples) for name in self.factors]
            return np.column_stack([column[first : first + count] for column in columns])
        if self.kind == "sobol":
            return self._sequence(d, first, count)
        if self.kind == "morris":  # levels are the medians of equal parts: no sample is at an infinite end
            return (0.5 + self._morris_levels[first : first + count] * (LEVELS - 1)) / LEVELS
        pair, place = np.divmod(np.arange(first, first + count), self.block)
        points = self._sequence(2 * d, int(pair[0]), int(pair[-1] - pair[0]) + 1)[pair - pair[0]]
        from_b = (place[:, None] == np.arange(1, d + 1)) | (place == d + 1)[:, None]
        return np.asarray(np.where(from_b, points[:, d:], points[:, :d]))

    def _uniform(self, name: str, first: int, count: int) -> Array:
        """Independent numbers in 0 <= u < 1, by seed, name and sample: they stay when factors are added."""
        skip = first % _PER_COUNT
        stream = Generator(Philox(counter=first // _PER_COUNT, key=_key(self.seed, name)))
        return np.asarray(stream.random(skip + count)[skip:])

    def _sequence(self, dimensions: int, first: int, count: int) -> Array:
        """Points of a scrambled Sobol' sequence (count, dimensions)."""
        engine = qmc.Sobol(d=dimensions, scramble=True, seed=_generator(self.seed, "sobol"))
        if first:
            engine.fast_forward(first)
            return np.asarray(engine.random(count))
        return np.asarray(engine.random(1 << (count - 1).bit_length())[:count])  # SciPy warns of no power of 2

    @cached_property
    def _morris_levels(self) -> Array:
        """What SALib makes: (samples, factors), from 0, the lowest level, to 1."""
        from SALib.sample.morris import sample

        seed = _key(self.seed, "morris") % 2**31
        return np.asarray(sample(self._problem, self.samples // self.block, LEVELS, seed=seed))

    @property
    def _problem(self) -> dict[str, Any]:
        """The factors, as SALib takes them."""
        d = len(self.factors)
        return {"num_vars": d, "names": list(self.factors), "bounds": [[0.0, 1.0]] * d}

    def sensitivity(self, values: Array) -> tuple[Mapping[str, Array], int]:
        """What a quantity (n; of the first samples in order) depends on, by factor, and how many samples say so.

        Of `saltelli` Sobol' indices: `S1` alone, `ST` with all that a factor does together with others, shares of the
        variance; of `morris` `mu_star` and `sigma`, mean size and spread of the change between the lowest and the
        highest level. `+-` are halves of 95 % intervals. Blocks with a NaN are left out, and of pairs those beyond the
        largest power of two, which Sobol' sequences are balanced for. Empty where there are fewer than two blocks.
        """
        blocks = values[: len(values) // self.block * self.block].reshape(-1, self.block)
        good = ~np.isnan(blocks).any(axis=1)
        if self.kind not in IN_BLOCKS or good.sum() < 2:
            return {}, 0
        if self.kind == "morris":
            from SALib.analyze.morris import analyze

            levels = self._morris_levels[: blocks.size].reshape(*blocks.shape, -1)[good].reshape(-1, len(self.factors))
            result = analyze(self._problem, levels, blocks[good].ravel(), num_levels=LEVELS, seed=1)
            figures = {"mu_star": result["mu_star"], "mu_star +-": result["mu_star_conf"], "sigma": result["sigma"]}
            return {name: np.asarray(column, dtype=float) for name, column in figures.items()}, int(blocks[good].size)
        used = blocks[good][: 1 << (int(good.sum()).bit_length() - 1)].T
        first, total = _sobol_indices(used)
        random = np.random.default_rng(1)
        again = [_sobol_indices(used[:, random.integers(used.shape[1], size=used.shape[1])]) for _ in range(100)]
        S1, ST = 1.96 * np.std(again, axis=0)
        return {"S1": first, "S1 +-": S1, "ST": total, "ST +-": ST}, used.size


def _sobol_indices(values: Array) -> tuple[Array, Array]:
    """First and total indices (factors), of values at the first points, at each exchange, at the second points."""
    functions = {"f_A": values[:1], "f_B": values[-1:], "f_AB": values[1:-1, None]}
    indices = sobol_indices(func=functions, n=values.shape[1])
    return np.atleast_1d(indices.first_order), np.atleast_1d(indices.total_order)


def _key(seed: int, name: str) -> int:
    """Key of a stream of random numbers, 128 bits."""
    return int.from_bytes(blake2b(f"{seed} {name}".encode(), digest_size=16).digest(), "little")


def _generator(seed: int, name: str) -> Generator:
    return Generator(Philox(_key(seed, name)))


@lru_cache(maxsize=32)
def _latin_column(seed: int, name: str, samples: int) -> Array:
    """One factor of all samples of a Latin hypercube."""
    return np.asarray(qmc.LatinHypercube(d=1, seed=_generator(seed, f"latin {name}")).random(samples)[:, 0])


KINDS = ("normal", "relative", "tolerance", "uniform", "triangular", "lognormal", "grade")
_OPTIONS = dict.fromkeys(KINDS, ("least", "most", "group")) | {"grade": ("speed", "share")}
"""Keys beside that of the kind."""

_GRADE = re.compile(r"G\s*(\d+\.?\d*|\.\d+)")
NOTABLE_CUT = 1e-3
"""Least part of a distribution that is worth a message where it is cut off."""

_LEAST, _MOST = 2.0**-54, 1.0 - 2.0**-53
"""Probabilities are kept within these, so that no sample of an unbounded distribution is infinite."""


@dataclass(frozen=True)
class Varied:
    """One number of the stand that varies.

    distribution  a frozen distribution of scipy.stats, or the only value
    factor        name of the random number that decides it; None: it has one value
    low, high     only values between these occur, their ratios are kept
    scale         number per unit of the distribution
    """

    number: StandNumber
    distribution: Any
    factor: str | None
    low: float = -math.inf
    high: float = math.inf
    scale: float = 1.0

    def values(self, p: Array) -> Array:
        """Values (n), SI, that are exceeded with the probabilities 1 - p (n)."""
        if self.factor is None:
            return np.full(len(p), self.scale * self.distribution)
        first, last = self.distribution.cdf([self.low, self.high])
        values = self.distribution.ppf(first + (last - first) * p)
        return np.asarray(self.scale * np.clip(values, self.low, self.high))

    @property
    def remark(self) -> str:
        """How much of a distribution is cut off, and the mean that is left; "" if little."""
        if self.factor is None:
            return ""
        first, last = self.distribution.cdf([self.low, self.high])
        share = float(1.0 - (last - first))
        if share < NOTABLE_CUT:
            return ""
        mean = self.scale * float(self.distribution.expect(lb=self.low, ub=self.high, conditional=True))
        ends = ("below", self.low), ("above", self.high)
        where = " or ".join(f"{side} {self.scale * end:g}" for side, end in ends if math.isfinite(end))
        words = f"{100.0 * share:.3g} % of its distribution is {where} and is cut off"
        return f"{self.number.path}: {words}; the mean is {mean:.6g} {self.number.dimension.si}".rstrip()


@dataclass(frozen=True)
class Draw:
    """All numbers that vary, and the random numbers (factors) that decide them.

    correlated  places of factors that depend on each other
    lower       Cholesky factor of the correlation of their normal scores
    """

    varied: tuple[Varied, ...]
    factors: tuple[str, ...]
    correlated: tuple[int, ...]
    lower: Array

    def values(self, unit: Array) -> dict[str, Array]:
        """Numbers by path, SI, of samples (n, factors) in the unit cube; by a Gaussian copula where correlated."""
        unit = np.clip(unit, _LEAST, _MOST)
        scores = [ndtri(unit[:, k]) for k in self.correlated]
        for row, k in zip(self.lower, self.correlated, strict=True):  # sums in this order: the same bits for any n
            unit[:, k] = ndtr(sum(weight * score for weight, score in zip(row, scores, strict=True)))
        unit = np.clip(unit, _LEAST, _MOST)
        columns = dict(zip((None, *self.factors), (np.empty(len(unit)), *unit.T), strict=True))
        return {varied.number.path: varied.values(columns[varied.factor]) for varied in self.varied}


def read_draw(
    vary: Mapping[str, Any], correlations: Sequence[tuple[tuple[str, ...], float]], numbers: StandNumbers,
    problems: Problems,
) -> Draw:  # fmt: skip
    """What `[vary]` and `[[correlation]]` say, which have the paths of some numbers and a coefficient.

    Problems are noted.
    """
    varied = _read_vary(vary, numbers, problems)
    factors = tuple(dict.fromkeys(entry.factor for entry in varied if entry.factor is not None))
    by_path = {entry.number.path: entry.factor for entry in varied}
    matrix, pairs = np.eye(len(factors)), set[tuple[int, int]]()
    for i, (paths, coefficient) in enumerate(correlations):
        try:
            names = dict.fromkeys(_factors_of(paths, numbers, by_path))
            places = sorted(factors.index(name) for name in names)
            if len(places) < 2:
                raise UsageError("expected two numbers or more that vary each by itself")
            for j, k in ((j, k) for j in places for k in places if j < k):
                if (j, k) in pairs:
                    raise UsageError(f"{factors[j]} and {factors[k]} are correlated twice")
                pairs.add((j, k))
                matrix[j, k] = matrix[k, j] = coefficient
        except UsageError as error:
            problems.add(f"correlation[{i}]", "of", str(error))
    correlated = tuple(sorted({k for pair in pairs for k in pair}))
    chosen = matrix[np.ix_(correlated, correlated)]
    if pairs and np.linalg.eigvalsh(chosen)[0] <= 1e-12:
        problems.add("correlation", "no such numbers exist: the matrix of all coefficients is not positive definite")
        chosen = np.eye(len(correlated))
    return Draw(varied, factors, correlated, np.asarray(np.linalg.cholesky(chosen), dtype=float))


def _factors_of(paths: Sequence[str], numbers: StandNumbers, by_path: Mapping[str, str | None]) -> Iterator[str]:
    for path in (leaf.path for pattern in paths for leaf in numbers.find(pattern)):
        factor = by_path.get(path)
        if factor is None:
            raise UsageError(f"{path} does not vary{suggestion(path, by_path)}")
        yield factor


def _read_vary(raw: Mapping[str, Any], numbers: StandNumbers, problems: Problems) -> tuple[Varied, ...]:
    """The numbers that vary, in the order of the file. A plain path has precedence over a pattern."""
    patterns: dict[str, str] = {}
    kept: dict[str, Varied] = {}
    for pattern, entry in sorted(raw.items(), key=lambda item: "*" in item[0]):
        where = f"vary {show(pattern)}"
        try:
            entries = _varied(pattern, entry, numbers)
        except (QuantityError, UsageError) as error:
            problems.add(where, str(error).removeprefix(f"{pattern}: "))
            continue
        for vary in entries:
            path = vary.number.path
            if path not in kept:
                patterns[path], kept[path] = pattern, vary
            elif "*" not in pattern or "*" in patterns[path]:
                problems.add(where, f"{path} varies twice, also by {show(patterns[path])}")
    for path in kept:
        for other in _same_unbalance(path):
            if other in kept:
                words = f"{path} and {other} are the same unbalance; expected one of them"
                problems.add(f"vary {show(patterns[path])}", words)
    order = list(raw)
    return tuple(sorted(kept.values(), key=lambda vary: order.index(patterns[vary.number.path])))


def _same_unbalance(path: str) -> tuple[str, ...]:
    """Paths of unbalances that a centre of mass or a product of inertia of the same flywheel decides as well."""
    body, _, rest = path.partition(".")
    static, dynamic = ("center_of_mass[1]", "center_of_mass[2]"), ("inertia.J12", "inertia.J13")
    amount = (dict.fromkeys(static, "static") | dict.fromkeys(dynamic, "dynamic")).get(rest)
    return () if amount is None else (f"{body}.unbalance.{amount}", f"{body}.unbalance.{amount}_at")


def _varied(pattern: str, raw: Any, numbers: StandNumbers) -> list[Varied]:
    """The numbers of a path or pattern with their distributions. Raises QuantityError, UsageError."""
    if _kind(raw) == "grade":
        return list(_graded(pattern, raw, numbers))
    group = f"group {_read('group', text, raw['group'])}" if "group" in raw else None
    result = []
    for leaf in numbers.find(pattern):
        distribution = _distribution(raw, leaf)
        low, high = _ends(distribution, raw, leaf)
        factor = None if isinstance(distribution, float) else group or leaf.path
        result.append(Varied(leaf, distribution, factor, low, high))
    return result


def _graded(pattern: str, raw: Mapping[str, Any], numbers: StandNumbers) -> Iterator[Varied]:
    """Static unbalance that a balance grade permits, or the given share of it, in a random direction."""
    grade = _read("grade", grade_of, raw["grade"])
    if "speed" not in raw:
        raise QuantityError("speed: required with grade, but missing")
    speed = _read("speed", lambda value: require_bounds(abs(number(value, SPEED)), "rad/s", above=0.0), raw["speed"])
    share, low, high = 1.0, 0.0, math.inf
    if "share" in raw:
        of = StandNumber("share", "", "share", PLAIN, 1.0, least=0.0)
        left = raw["share"] if isinstance(raw["share"], Mapping) else {"normal": [raw["share"], 0]}
        share = _read("share", lambda value: _distribution(value, of), left)
        low, high = _read("share", lambda value: _ends(share, value, of), left)
    wheels = pattern.removesuffix(".static")
    if not wheels.endswith(".unbalance"):
        raise QuantityError("grade: limits the static unbalance, expected it of FLYWHEEL.unbalance")
    statics, angles = numbers.find(f"{wheels}.static"), numbers.find(f"{wheels}.static_at")
    for static, angle in zip(statics, angles, strict=True):
        most = permissible_unbalance(grade, speed, numbers.mass(static.body))
        factor = None if isinstance(share, float) else static.path
        yield Varied(static, share, factor, low, high, most)
        yield Varied(angle, stats.uniform(-math.pi, 2.0 * math.pi), angle.path)


def grade_of(raw: object) -> float:
    """Velocity (m/s) of a balance quality grade of ISO 21940-11: "G 2.5" is 2.5 mm/s. Raises QuantityError."""
    match = _GRADE.fullmatch(raw.strip()) if isinstance(raw, str) else None
    if match is None or float(match[1]) <= 0.0:
        raise QuantityError(f'expected a balance quality grade, such as "G 2.5", found {show(raw)}')
    return float(match[1]) / 1000.0


def permissible_unbalance(grade: float, speed: float, mass: float) -> float:
    """Permissible residual static unbalance, kg m: mass e_per with e_per |speed| = grade (m/s; rad/s, kg)."""
    return mass * grade / abs(speed)


def _kind(raw: Any) -> str:
    """Name of the distribution that a table gives. Raises QuantityError."""
    if not isinstance(raw, Mapping):
        raise QuantityError(f'expected a table such as {{ normal = ["1 g", "0.1 g"] }}, found {show(raw)}')
    kinds = [key for key in raw if key in KINDS]
    known = [*KINDS, *_OPTIONS[kinds[0]]] if kinds else KINDS
    for key in raw:
        if key not in known:
            raise QuantityError(f"unknown key {show(key)}{suggestion(key, known)}")
    if len(kinds) != 1:
        raise QuantityError(f"expected one of {', '.join(KINDS)}, found {' and '.join(kinds) or 'none'}")
    return str(kinds[0])


def _distribution(raw: Mapping[str, Any], about: StandNumber) -> Any:
    """A frozen distribution of scipy.stats, or the only value. Raises QuantityError, which begins with the kind."""
    kind = _kind(raw)
    return _read(kind, lambda raw_value: _read_distribution(kind, raw_value, about), raw[kind])


def _read_distribution(kind: str, raw_value: Any, about: StandNumber) -> Any:
    dimension, value = about.dimension, about.value
    if kind == "normal":
        mean, sigma = vector(raw_value, (2,), dimension)
        if mean < 0.0 and about.least == 0.0:
            raise QuantityError(f"[0]: {mean:g} {dimension.si} is negative")
        return stats.norm(mean, _spread(sigma, dimension)) if sigma else mean
    if kind == "relative":
        share = _spread(number(raw_value, PLAIN), PLAIN)
        if not value:
            raise QuantityError(f"{about.path} is zero in the stand file: expected tolerance or normal")
        return stats.norm(value, share * abs(value)) if share else value
    if kind == "tolerance":
        if isinstance(raw_value, list) or (isinstance(raw_value, dict) and isinstance(raw_value.get("value"), list)):
            low, high = vector(raw_value, (2,), dimension)
        else:
            high = _spread(number(raw_value, dimension), dimension)
            low = -high
        return _bounded(value + low, value + high, None, dimension)
    if kind in ("uniform", "triangular"):
        low, *mode, high = vector(raw_value, (2 if kind == "uniform" else 3,), dimension)
        return _bounded(low, high, mode[0] if mode else None, dimension)
    if kind != "lognormal":
        raise QuantityError("not allowed here")
    pair = any_list(raw_value)
    if len(pair) != 2:
        raise QuantityError(f"expected the median and the standard deviation of the logarithm, found {len(pair)}")
    median = _read("[0]", lambda raw: require_bounds(number(raw, dimension), dimension.si, above=0.0), pair[0])
    sigma = _read("[1]", lambda raw: _spread(number(raw, PLAIN), PLAIN), pair[1])
    return stats.lognorm(sigma, scale=median) if sigma else median


def _bounded(low: float, high: float, mode: float | None, dimension: Dimension) -> Any:
    """Uniform, or triangular with a mode; the value where the ends are the same. Raises QuantityError."""
    if not low <= (low if mode is None else mode) <= high:
        ends = " ".join(f"{x:g}" for x in (low, mode, high) if x is not None)
        raise QuantityError(f"expected rising numbers, found {ends} {dimension.si}".rstrip())
    if low == high:
        return low
    width = high - low
    return stats.uniform(low, width) if mode is None else stats.triang((mode - low) / width, low, width)


def _spread(value: float, dimension: Dimension) -> float:
    return require_bounds(value, dimension.si, least=0.0)


def _ends(distribution: Any, raw: Mapping[str, Any], about: StandNumber) -> tuple[float, float]:
    """Ends at which a distribution is cut: `least`, `most`, and those of an unbounded one by the stand file."""
    unbounded = not isinstance(distribution, float) and distribution.support()[0] == -math.inf
    low = about.least if unbounded and about.least is not None else -math.inf
    low, high = (
        _read(key, lambda raw_value: number(raw_value, about.dimension), raw[key]) if key in raw else end
        for key, end in (("least", low), ("most", math.inf))
    )
    if isinstance(distribution, float):
        kept = float(low <= distribution <= high)
    else:
        kept = float(np.diff(distribution.cdf([low, high]))[0])
    if kept < 1e-9:
        raise QuantityError("least, most: the distribution has no values between them")
    return low, high


def _read(key: str, read: Callable[[Any], Any], raw: Any) -> Any:
    """A value of a key, or of its element, which messages name."""
    try:
        return read(raw)
    except QuantityError as error:
        raise QuantityError(f"{key}{'' if str(error).startswith('[') else ': '}{error}") from None
