"""`[over]` of a campaign file: over what the quantities of samples are computed."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Union

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.regime import programme_regime
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand import units
from mahovik.core.stand.fields import Text, scalar, validator, whole_number
from mahovik.core.stand.files import readable_text
from mahovik.core.stand.hold import PLACE_OF_HOLD, twists
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.model import State
from mahovik.core.stand.tables import NOTHING, Problems, Table
from mahovik.core.stand.units import PLAIN, TIME, QuantityError, show
from mahovik.core.toolchain.compiled import PER_BLOCK, Block, compile_library
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.api.states import state_of
from mahovik.out.api.tables import Samples, Tables, first_reason
from mahovik.out.arguments import motion_of, programme_of, regime_of, text_of_keys
from mahovik.out.campaign.quantities import AXES, HOLD, Errors, Quantity, Scene, rotation, turn
from mahovik.out.notices import warn_of_steps, warn_of_turn
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.use.control.loop import coordinates, required_state
from mahovik.use.measured.headers import sensors
from mahovik.use.numeric.frame import Frame, uniform_stream
from mahovik.use.numeric.se3 import Array
from mahovik.use.simulate.case import HINT, START_KEYS, Case, read_start
from mahovik.use.simulate.course import FUNCTIONS, SAMPLES, Moments, motion, stand_for, together, why_refused
from mahovik.use.simulate.held import allowed_start
from mahovik.use.study.rest import accuracy, rest
from mahovik.use.vibration.chain import Chain, Makers, spectrum
from mahovik.use.vibration.lines import Lines
from mahovik.use.vibration.speeds import read_phases, read_speeds
from mahovik.use.vibration.steady import steady
from mahovik.use.vibration.view import REACTION, find_view

Values = tuple[dict[str, Array], list[str]]
"""Quantities by name, (n) each, and the reason of each sample that has none, or ""."""

MOST, CACHE = 1 << 23, 1 << 13
"""Numbers of one component that are kept of samples that are stepped together, and worked on at once."""


def _file_or_table(raw: Any) -> Any:
    if not isinstance(raw, str | dict):
        raise QuantityError(f"expected the name of a file, or a table with its keys, found {show(raw)}")
    return raw


def _text_or_number(raw: Any) -> str | float:
    return raw if isinstance(raw, str) else units.number(raw, PLAIN)


TextOrNumber = Annotated[str | float, validator(_text_or_number)]
FileOrTable = Annotated[Any, validator(_file_or_table)]
Seconds = Annotated[float, scalar(TIME, above=0.0)]


class _Timed(Table):
    """Keys of runs in time, as `simulate` has them."""

    dt: Seconds = 1e-4
    every: Seconds = 1e-3
    order: Annotated[int, whole_number(2, 4)] = 4


class RegimeTable(_Timed):
    """`[over]` with a regime: from a start, by default the rest of each sample."""

    regime: FileOrTable
    until: Seconds
    start: FileOrTable = "rest"


class SpeedsTable(Table):
    """`[over]` with constant speeds by flywheel."""

    speeds: Mapping[str, TextOrNumber]
    phases: Mapping[str, TextOrNumber] = NOTHING


class ProgrammeTable(_Timed):
    """`[over]` with a programme, that runs for some periods."""

    programme: Text
    motion: Text
    periods: Annotated[int, whole_number(1, 10**6)] = 1


class StatesTable(Table):
    """`[over]` with a file of states."""

    states: Text


KINDS: Mapping[str, type[Table]] = {
    "regime": RegimeTable, "speeds": SpeedsTable, "programme": ProgrammeTable, "states": StatesTable,
}  # fmt: skip
"""Tables of `[over]` by the key that chooses them."""


def read_over(raw: Mapping[str, Any], problems: Problems) -> tuple[str, Any]:
    """The kind of run, and its table; problems are noted."""
    kinds = [kind for kind in KINDS if kind in raw]
    if len(kinds) != 1:
        problems.add("over", f"expected exactly one of {', '.join(KINDS)}, found {' and '.join(kinds) or 'none'}")
        return "", None
    return kinds[0], problems.valid(KINDS[kinds[0]], raw, "over")


_PLACE = re.compile(rf"hold\.({'|'.join(PLACE_OF_HOLD)})\[")
"""Paths of numbers that say where the carrier is held: a state is another one elsewhere."""


def runner_of(
    stand: Stand, over: Any, quantities: Sequence[Quantity], folder: Path, varied: Sequence[str] = ()
) -> Runner:  # fmt: skip
    """What computes quantities over a table of `KINDS`, of stands that differ in the numbers of some paths.

    Raises UsageError, and what the files raise.
    """
    if isinstance(over, SpeedsTable):
        return ByStand(stand, _steady(stand, over, quantities))
    if isinstance(over, RegimeTable):
        return _over_regime(stand, over, quantities, folder)
    if isinstance(over, ProgrammeTable):
        for path in filter(_PLACE.match, varied):
            raise UsageError(f"programme: its motion is one from the home pose of the stand file; {path} varies")
        return _over_programme(stand, over, quantities, folder)
    return _over_states(stand, folder / over.states, quantities)


Runner = Union["TimeRunner", "ByStand"]
"""Has `stand`, that all samples differ from: that of the file, with the run-time wrenches that a regime needs; and
`values` of its tables, or of samples."""


@dataclass(eq=False)
class ByStand:
    """Quantities by name, of one stand after another: each sample is a run of its own stand."""

    stand: Stand
    numbers_of: Callable[[Stand], Mapping[str, float]]

    def values(self, samples: Samples) -> Values:
        """Quantities of all samples."""
        columns, reasons = dict[str, Array](), [""] * samples.n
        for j in range(samples.n):
            try:
                numbers = self.numbers_of(self.stand.replace(samples.values(j)))
            except MahovikError as error:
                reasons[j] = first_reason(error, self.stand.name)
                continue
            for name, number in numbers.items():
                columns.setdefault(name, np.full(samples.n, np.nan))[j] = number
        return columns, reasons


# -- runs in time ----------------------------------------------------------------------------------------------------

Begin = Callable[[Tables], tuple[Array, Mapping[int, str]]]
"""Numbers (K, c, n) of the states that samples begin in, and the reasons of samples that have none."""

Course = Callable[[Block, Array, int, set[str]], Iterator[Moments]]
"""Moments of a block, of what `Begin` says of it and the parts of its steps, with what is needed."""


@dataclass(eq=False)
class TimeRunner:
    """Quantities of moments of a run, of which there are some; what is computed of a sample depends on no other.

    case  None: there are no steps
    """

    stand: Stand
    quantities: Sequence[Quantity]
    begin: Begin
    course: Course
    moments: int
    case: Case | None = None
    errors: Errors | None = None

    def __post_init__(self) -> None:
        self._made = compile_library(self.stand)

    def values(self, tables: Tables) -> Values:
        """Quantities of all samples of tables."""
        n, names = len(tables), [q.name for q in self.quantities]
        numbers, reasons = {name: np.full(n, np.nan) for name in names}, [""] * n
        size = max(PER_BLOCK, min(SAMPLES, MOST // self.moments // PER_BLOCK * PER_BLOCK))
        with np.errstate(all="ignore"):  # of samples that leave their ranges
            states, lost = self.begin(tables)
            lost, x = dict(lost), states[0, : 13 + 2 * len(self.stand.flywheels)]
            for rows, block, parts in together(self.case, self._made, x, tables, size, lost):
                columns = self._numbers(block, partial(self.course, block, states[..., rows], parts))
                for name, column in zip(names, columns, strict=True):
                    numbers[name][rows] = column
                for j in np.flatnonzero(block.status < 0).tolist():
                    reasons[rows[j]] = why_refused(self.stand, block, j)
        for j, reason in lost.items():
            reasons[j] = reason
        return numbers, reasons

    def _numbers(self, block: Block, course: Callable[[set[str]], Iterator[Moments]]) -> Iterator[Array]:
        """Quantities of a block."""
        readings = np.zeros((0, block.n))
        if sensors(self.stand):
            block.call("points")
            readings = block.found["points"].copy()
        scene = Scene(self.stand, block.x.copy(), readings, self.errors)
        times, values = list[Array](), [list[Array]() for _ in self.quantities]
        for at in course({q.need for q in self.quantities} - {""}):
            for piece in _pieces(at, max(1, CACHE // block.n)):
                times.append(piece.t)
                for q, kept in zip(self.quantities, values, strict=True):
                    kept.append(q.values(scene, piece))
        for q, kept in zip(self.quantities, values, strict=True):
            yield q.number(np.concatenate(times), np.concatenate(kept)) if kept else np.full(block.n, np.nan)


def _pieces(at: Moments, count: int) -> Iterator[Moments]:
    """Moments, some at a time: what is computed of them stays in the cache of the processor."""
    for first in range(0, len(at.t), count):
        yield Moments(**{name: array[first : first + count] for name, array in vars(at).items()})


def _over_regime(stand: Stand, over: RegimeTable, quantities: Sequence[Quantity], folder: Path) -> TimeRunner:
    """Over a regime, as `simulate` runs it, from a given state or from the rest of each sample."""
    source, start = (
        folder / key if isinstance(key, str) and key != "rest" else key for key in (over.regime, over.start)
    )
    regime = regime_of(source, stand, over.until)
    pairs = zip(stand.bodies, stand_for(stand, regime).bodies, strict=True)
    inputs = {f"{body.name}.wrench_input": True for body, other in pairs if body != other}
    stand = stand.replace(inputs) if inputs else stand
    begin: Begin
    if start != "rest":
        keys = start if isinstance(start, Path) else json.loads(text_of_keys(start, schema=False))
        of: Callable[[CoreStand], State] = lambda one: state_of("start", keys, one, START_KEYS, HINT)  # noqa: E731
        state = of(stand)
        begin = partial(_begin_at, stand, of)
    else:
        begin = AtRest(stand, [flywheel.phase or 0.0 for flywheel in regime.flywheels])
        state = begin.nominal
        warn_of_turn(stand, state)
    return _timed(Case(stand, regime, state, over.until, over.every, over.dt, over.order), stand, quantities, begin)


def _timed(
    case: Case, stand: Stand, quantities: Sequence[Quantity], begin: Begin, errors: Errors | None = None
) -> TimeRunner:  # fmt: skip
    """Quantities over a case. Raises UsageError: a law is too steep, moments of output cannot show what is wanted."""
    for q in quantities:
        low, high = q.band or (0.0, 0.0)
        if q.after >= case.until:
            raise UsageError(f"quantity {q.name}: after: {q.after:g} s: expected less than {case.until:g} s")
        if 2.0 * high * case.every > 1.0 + 1e-9:
            raise UsageError(f"quantity {q.name}: band: {high:g} Hz needs `every` of at most {0.5 / high:g} s")
        if q.band and (case.until - q.after) * (high - low) < 2.0:
            least = 2.0 / (high - low) + q.after
            raise UsageError(f"quantity {q.name}: band: {low:g} to {high:g} Hz needs a run of {least:g} s")
    warn_of_steps(case)
    next(together(case, compile_library(stand), _column(stand, case.start)[:, None], None))  # refuses a steep law
    course: Course = lambda block, _states, parts, needs: motion(case, block, needs, parts)  # noqa: E731
    return TimeRunner(stand, quantities, begin, course, len(case.times), case, errors)


def _column(stand: CoreStand, state: State) -> Array:
    """The numbers of a state (13 + 2 N), with the quaternion of its angles as the C computes it."""
    quaternion = state.quaternion or (1.0, 0.0, 0.0, 0.0)
    if state.quaternion is None and state.angles is not None:
        quaternion = tuple(build(Stand.of(stand)).state(angles=state.angles).attitude.tolist())
    return np.array([*state.position, *quaternion, *state.V, *state.phi, *state.phi_dot])


def _begin_at(stand: CoreStand, of: Callable[[CoreStand], State], tables: Tables) -> tuple[Array, Mapping[int, str]]:
    return _beginnings(stand, lambda one: _column(stand, of(one))[None], tables)


def _is_moved(tables: Tables) -> bool:
    return any(map(_PLACE.match, tables.samples.changes))


def _beginnings(
    stand: CoreStand, of: Callable[[CoreStand], Array], tables: Tables
) -> tuple[Array, Mapping[int, str]]:  # fmt: skip
    """See `Begin`: by a function of the stand, or of that of each sample where the carrier is held elsewhere."""
    states, reasons = np.repeat(of(stand)[..., None], len(tables), axis=-1), dict[int, str]()
    for j in range(len(tables) if _is_moved(tables) else 0):
        try:
            states[..., j] = of(tables.stand(j))
        except MahovikError as error:
            reasons[j] = first_reason(error, stand.name)
    return states, reasons


class AtRest:
    """Puts each sample at its own rest pose, which is near that of the stand of the file, `nominal`.

    Corrections by the stiffness of that stand are made until what remains is rounding; a sample that they do not bring
    there is searched by itself.
    """

    MOST, STEP = 40, 1e-6  # corrections; m, rad: step of differences
    SHIFTS_FIRST = np.array([1e3] * 3 + [1.0] * 3)  # along free directions a rotation serves before a shift

    def __init__(self, stand: Stand, phases: Sequence[float]) -> None:
        """Raises CheckError: there is no equilibrium."""
        try:
            self.nominal, self._stand, self._phases = rest(stand, phases).state, stand, list(phases)
        except CheckError as error:
            raise CheckError(f"{error}; give an initial state by `start`") from None
        self._least = 2.0 * accuracy(stand, self.nominal)[:, None]
        self._column = _column(stand, self.nominal)[:, None]
        S = twists(stand.hold)
        self._made = compile_library(stand)
        block = Block(stand, self._made, 2 * S.shape[1])
        block.x[:] = self._column
        self._displace(block.x, np.hstack([self.STEP * S, -self.STEP * S]))
        block.call("forward")
        after, before = np.hsplit(block.given["V_dot"], 2)
        weights = self.SHIFTS_FIRST if stand.hold is None else np.ones(S.shape[1])
        slopes = (after - before) / (2.0 * self.STEP)
        self._inverse = -S @ (np.linalg.pinv(slopes / weights, rcond=1e-8) / weights[:, None])

    def __call__(self, tables: Tables) -> tuple[Array, Mapping[int, str]]:
        """See `Begin`."""
        reasons, n = dict[int, str](), len(tables)
        block, moving = Block(self._stand, self._made, n, tables), np.ones(n, dtype=np.bool_)
        block.x[:] = self._column
        for _ in range(self.MOST if n and not _is_moved(tables) else 0):
            block.call("forward")
            V_dot = block.given["V_dot"]
            moving = np.any(np.abs(V_dot) > self._least, axis=0)
            if not moving.any():
                break
            moved = block.x.copy()
            self._displace(moved, sum(self._inverse[:, j, None] * V_dot[j] for j in range(6)))
            block.x[:, moving] = moved[:, moving]  # those that rest stay as they are, whatever the others need
        for j in np.flatnonzero(moving).tolist():
            block.x[:, j] = self._column[:, 0]
            try:
                block.x[:, j] = _column(self._stand, rest(tables.stand(j), self._phases).state)
            except MahovikError as error:
                reasons[j] = str(error)
        return block.x[None].copy(), reasons

    @staticmethod
    def _displace(x: Array, step: Array) -> None:
        """Displace poses (13 + 2 N, n) by small twists in E1 (6, n; m, rad)."""
        x[:3] += turn(rotation(x[3:7]), step[:3])
        turned = Rotation.from_quat(x[[4, 5, 6, 3]].T) * Rotation.from_rotvec(step[3:].T)
        x[[4, 5, 6, 3]] = turned.as_quat().T


def _over_programme(stand: Stand, over: ProgrammeTable, quantities: Sequence[Quantity], folder: Path) -> TimeRunner:
    """Over a programme, from the state that it requires at t = 0: the flywheels turn, whatever the carrier does."""
    programme = programme_of(folder / over.programme)
    required = motion_of(folder / over.motion, stand, programme)
    for check in (stand_check(stand, programme), motion_check(required, programme)):
        if check.failed:
            raise UsageError(f"programme: {over.programme}: {check.words}")
    if not programme.periodic and over.periods > 1:
        raise UsageError(f"periods: {over.periods}: the programme is finite and is run once")
    angles = programme.at(np.zeros(1))
    state = required_state(stand, required, programme, angles)
    state = replace(state, phi=tuple(angles.phi[0].tolist()), phi_dot=tuple(angles.phi_dot[0].tolist()))
    start, until = allowed_start(stand, state), required.span * over.periods
    case = Case(stand, programme_regime(programme), start, until, over.every, over.dt, over.order)
    begin = partial(_begin_at, stand, lambda _: start)
    errors = partial(_errors, stand, required, programme, scale_of(stand, required, programme))
    return _timed(case, stand, quantities, begin, errors)


def _errors(
    stand: Stand, required: RequiredMotion, programme: Programme, scale: Any, at: Moments
) -> tuple[Array, Array]:  # fmt: skip
    """See `Errors`; the share as `verify` has it."""
    K, _, n = at.state.shape
    q = required.at(at.t if required.periodic else np.clip(at.t, 0.0, required.span), programme.bias).q
    near = np.repeat(q, n, axis=0)
    pose = np.moveaxis(at.state[:, :7], 1, 2).reshape(K * n, 7)
    error, known = np.full(near.shape, np.nan), np.isfinite(pose).all(axis=1)
    error[known] = coordinates(stand, pose[known, :3], pose[known, 3:], near[known]) - near[known]
    errors = np.moveaxis(error.reshape(K, n, -1), 1, 2)
    slopes = np.linalg.cholesky(scale.K0).T @ Frame.of(stand).slopes(q)[2]
    weighted = np.einsum("kij,kjn->kin", slopes, errors)
    return errors, np.sqrt((weighted**2).sum(axis=1, keepdims=True)) / scale.amplitude


# -- states and constant speeds --------------------------------------------------------------------------------------


def _over_states(stand: Stand, path: Path, quantities: Sequence[Quantity]) -> TimeRunner:
    """Over the states of a file of JSON lines. Raises UsageError."""
    try:
        lines = readable_text(path, "a file of states").splitlines()
    except ValueError as error:
        raise UsageError(f"states: {error}") from None

    def of(one: CoreStand) -> Array:
        states = []
        for number, line in enumerate(lines, 1):
            try:
                state = read_start(line, one, (*START_KEYS, "phi_ddot"), "") if line.strip() else None
            except UsageError as error:
                raise UsageError(f"states: {path.name}, line {number}: {error}") from None
            if state is not None:
                states.append(np.append(_column(stand, state), state.phi_ddot))
        if not states:
            raise UsageError(f"states: {path.name}: no state, expected one a line")
        return np.array(states)

    return TimeRunner(stand, quantities, partial(_beginnings, stand, of), _at_states, len(of(stand)))


def _at_states(block: Block, states: Array, _parts: int, needs: set[str]) -> Iterator[Moments]:
    """All samples in each of the states, as `eval` has them; the number of a state takes the place of the time."""
    needed, none = {need: FUNCTIONS[need] for need in needs if need in FUNCTIONS}, np.zeros((0, block.n))
    for number, numbers in enumerate(states):
        block.x[:], block.given["phi_ddot"][:] = np.split(numbers, [len(block.x)])
        for function in ("forward", *(("torque",) if "tau" in needs else ()), *needed.values()):
            block.call(function, number)
        memory = block.given | {"state": block.x} | {need: block.found[function] for need, function in needed.items()}
        fields = (name for name in Moments.__dataclass_fields__ if name != "t")
        yield Moments(np.array([float(number)]), **{name: memory.get(name, none)[None].copy() for name in fields})


def _steady(stand: Stand, over: SpeedsTable, quantities: Sequence[Quantity]) -> Callable[[Stand], Mapping[str, float]]:
    """Numbers of the steady motion of a stand at constant speeds, as `vibration` has it. Raises UsageError: a sweep."""
    texts = (f"{name}={x}" if isinstance(x, str) else f"{name}={x!r} rad/s" for name, x in over.speeds.items())
    uniform_stream(stand)  # refused once, and not for each sample
    plan = read_speeds(stand, list(texts))
    if plan.sweep is not None:
        raise UsageError("speeds: a range of speeds, expected one speed of each flywheel")
    phases = read_phases("phases", stand, over.phases)

    def numbers_of(variant: Stand) -> Mapping[str, float]:
        motion, numbers = steady(variant, plan.speeds(0.0), phases), {}
        for q in quantities:
            view = find_view(variant, REACTION if q.at == HOLD else q.at, q.what)
            chain = Chain.of(motion.scene, view, Makers(), np.abs(motion.speeds))
            solved, seen = spectrum(motion, chain), np.array([q.axis in ("", axis) for axis in AXES])
            lines = Lines(solved.names, solved.frequency[None], np.where(seen, solved.amplitude, 0.0)[None])
            numbers[q.name] = getattr(lines.lengths(np.zeros((1, 3)), q.band), q.statistic)[0]
        return {name: float(number) for name, number in numbers.items()}

    return numbers_of
