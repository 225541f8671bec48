"""A campaign file (TOML): what varies, the design of the samples, what is computed of each; and its rows."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

import mahovik
from mahovik import stands
from mahovik.core.stand.fields import Text, any_list, choice, scalar, text, validator, whole_number
from mahovik.core.stand.files import TEXT, document_of, is_file, text_of
from mahovik.core.stand.numbers import StandNumbers
from mahovik.core.stand.stand_file import dumps
from mahovik.core.stand.tables import Problems, Table, TableError
from mahovik.core.stand.units import PLAIN, QuantityError, show
from mahovik.errors import CampaignError, StandError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.model import Model, build
from mahovik.out.api.stands import Stand, load
from mahovik.out.api.tables import Samples, Tables, change_values, first_reason
from mahovik.out.campaign.quantities import Quantity, QuantityTable
from mahovik.out.campaign.runs import ByStand, Runner, read_over, runner_of
from mahovik.out.campaign.vary import DESIGNS, IN_BLOCKS, MOST_HELD, Design, Draw, read_draw


@dataclass(frozen=True)
class PossibleTables:
    """Tables of the samples that can be. `numbers`: which these are; `reasons`: by number, why another cannot."""

    tables: Tables
    numbers: NDArray[np.int64]
    reasons: Mapping[int, str]


def possible_tables(model: Model, changes: Mapping[str, Any], n: int | None = None) -> PossibleTables:
    """Tables as of `Model.tables`, without the samples that no stand file may have; each of these with its reason.

    Raises InputError for arrays that do not fit, UsageError for a path that leads nowhere.
    """
    samples, stand = Samples.of(changes, n), Stand.of(model.stand)
    with suppress(StandError):  # a path that leads nowhere is no matter of one sample
        change_values(stand, samples.values(0) if samples.n else {})
    reasons, parts = dict[int, str](), [np.arange(samples.n)]
    while parts:
        rows = parts.pop()
        part = samples.part(rows)
        try:
            tables = model.tables(part.changes, part.n)
        except (StandError, UsageError) as error:
            if not len(rows):
                raise
            if len(rows) == 1:
                reasons[int(rows[0])] = first_reason(error, f"{stand.name}, sample 0")
            else:  # which half is it?
                parts += np.array_split(rows, 2)[::-1]
    kept = np.array([i for i in range(samples.n) if i not in reasons], dtype=np.int64)
    if reasons:
        part = samples.part(kept)
        tables = model.tables(part.changes, part.n)
    return PossibleTables(tables, kept, reasons)


MOST = 999_999_999
SHORTEST_CHUNK, LONGEST_CHUNK, CHUNKS = 16, 10_000, 64
"""Samples of a chunk, and chunks, where the file does not say: enough for many workers, and few files."""


def _texts(raw: Any) -> tuple[str, ...]:
    return tuple(text(item) for item in any_list(raw))


class CorrelationTable(Table):
    """One `[[correlation]]`: numbers of which every two have this coefficient.

    of           paths, or patterns, in `vary`
    coefficient  of a Gaussian copula: each number keeps its distribution
    """

    of: Annotated[tuple[str, ...], validator(_texts)]
    coefficient: Annotated[float, scalar(PLAIN, least=-1.0, most=1.0)]


class CampaignTable(Table):
    """A campaign file.

    name         without it that of the file
    stand        a stand file beside this one, or the name of an example
    samples      number of samples; `"morris"` and `"saltelli"` round it up to whole blocks
    seed         another seed draws other samples
    design       how samples are placed
    chunk        samples of a chunk; without it a 64th of all, 16 to 10,000
    vary         numbers that vary
    correlation  numbers that depend on each other: `of`, their paths, and `coefficient` of a Gaussian copula
    over         over what each sample is computed
    quantity     what is kept of each sample
    """

    name: Text | None = None
    stand: Text
    samples: Annotated[int, whole_number(1, MOST)]
    seed: Annotated[int, whole_number(0, MOST)] = 1
    design: Annotated[str, choice(*DESIGNS)] = "random"
    chunk: Annotated[int | None, whole_number(1, MOST)] = None
    vary: dict[str, Any]
    correlation: Sequence[CorrelationTable] = ()
    over: dict[str, Any]
    quantity: Sequence[QuantityTable]

    def check(self) -> None:
        """Raises TableError without quantities."""
        if not self.quantity:
            raise TableError("expected at least one", "quantity")


@dataclass(frozen=True, eq=False)
class Campaign:
    """A valid campaign file.

    path        of the file; the files that it names are beside it
    stand       that all samples differ from
    over        over what, a table of `runs.KINDS`; quantities: what is computed of each sample
    """

    path: Path
    table: CampaignTable
    document: Mapping[str, Any]
    stand: Stand
    draw: Draw
    over: Any
    quantities: tuple[Quantity, ...]

    @property
    def name(self) -> str:
        """Name of the campaign; by default that of its file."""
        return self.table.name or self.path.stem

    @cached_property
    def design(self) -> Design:
        """Where the samples are."""
        return Design(self.table.design, self.draw.factors, self.table.samples, self.table.seed)

    @property
    def chunk(self) -> int:
        """Samples of a chunk; the last one may have fewer."""
        few = -(-self.design.samples // CHUNKS)
        return self.table.chunk or min(max(few, SHORTEST_CHUNK), LONGEST_CHUNK)

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.design.samples // self.chunk)

    @cached_property
    def units(self) -> dict[str, str]:
        """Units of the columns between `sample` and `error`: the numbers that vary, by path, and the quantities."""
        varied = {entry.number.path: entry.number.dimension.si for entry in self.draw.varied}
        return varied | {entry.name: entry.unit for entry in self.quantities}

    @cached_property
    def identity(self) -> dict[str, str]:
        """What decides the rows: hashes of the campaign file with the files that it names, and of the stand; version.

        Names, comments and units decide no row.
        """
        deciding = {key: value for key, value in self.document.items() if key not in ("name", "stand")}
        named = sorted(set(_files_named(self.path)) - {self.path.parent / self.table.stand})
        content = [hashlib.sha256(path.read_bytes()).hexdigest() for path in named]
        canonical = json.dumps([deciding, content], sort_keys=True, default=str)
        hashes = {"campaign file": canonical, "stand": dumps(self.stand)}
        result = {key: hashlib.sha256(value.encode()).hexdigest() for key, value in hashes.items()}
        return result | {"version of mahovik": mahovik.__version__}

    @cached_property
    def _model(self) -> Model:
        return build(self.runner.stand)

    @cached_property
    def runner(self) -> Runner:
        """What computes the quantities. Raises UsageError, and what the files raise that the campaign names."""
        try:
            varied = [entry.number.path for entry in self.draw.varied]
            return runner_of(self.stand, self.over, self.quantities, self.path.parent, varied)
        except UsageError as error:
            raise CampaignError([f"{self.path.name}: over: {error}"]) from None

    def rows(self, first: int, count: int) -> dict[str, Any]:
        """Columns of `count` samples from `first` on, with the same bits however the samples are parted.

        `sample`, the numbers that vary and the quantities (SI, as in `units`), and `error`: empty, or why the sample
        has no quantities, which are then NaN. Raises UsageError.
        """
        if first < 0 or count < 0 or first + count > self.design.samples:
            last = first + count - 1
            raise UsageError(f"rows: samples {first} to {last}, but the campaign has {self.design.samples}")
        values = self.draw.values(self.design.unit(first, count))
        columns = {quantity.name: np.full(count, np.nan) for quantity in self.quantities}
        errors, places = [""] * count, np.arange(count)
        if isinstance(self.runner, ByStand):
            computed, reasons = self.runner.values(Samples.of(values, count))
        else:
            possible = possible_tables(self._model, values, count)
            errors, places = [possible.reasons.get(i, "") for i in range(count)], possible.numbers
            computed, reasons = self.runner.values(possible.tables)
        for i, reason in zip(places.tolist(), reasons, strict=True):
            errors[i] = reason
        for name, numbers in computed.items():
            columns[name][places] = numbers
            for i in places[~np.isfinite(numbers)].tolist():
                errors[i] = errors[i] or f"{name} is {columns[name][i]}"
        for i in (i for i, reason in enumerate(errors) if reason):
            for column in columns.values():
                column[i] = np.nan
        return {"sample": np.arange(first, first + count), **values, **columns, "error": errors}


def load_campaign(path: str | Path) -> Campaign:
    """Read and check the campaign file at `path`. Raises CampaignError with every problem, StandError."""
    path = Path(path)
    problems = Problems(path.name)
    document = document_of(
        text_of(path, "a campaign file", TEXT, CampaignError), path.name, CampaignError, is_json=False
    )
    table = problems.valid(CampaignTable, document)
    if table is None:
        raise CampaignError(problems.lines)
    stand = _stand(table.stand, path.parent, problems)
    numbers = StandNumbers(stand, stand.to_dict(), motors="regime" in table.over)
    draw = read_draw(table.vary, [(entry.of, entry.coefficient) for entry in table.correlation], numbers, problems)
    if not draw.varied and not problems.lines:
        problems.add("vary", "nothing varies; expected a path such as carrier.mass")
    if table.correlation and table.design in IN_BLOCKS:
        problems.add("correlation", f'not allowed with design "{table.design}", which changes factors one by one')
    if table.design in ("latin", "morris") and table.samples * max(len(draw.factors), 1) > MOST_HELD:
        most = MOST_HELD // len(draw.factors)
        problems.add("samples", f'at most {most} with design "{table.design}"; expected fewer, or another design')
    kind, over = read_over(table.over, problems)
    taken = {"sample", "error", *(entry.number.path for entry in draw.varied)}
    quantities = []
    for entry in table.quantity:
        where = f"quantity {show(entry.name)}"
        if entry.name in taken:
            problems.add(where, "is the name of another column; expected another name")
        taken.add(entry.name)
        try:
            quantities.append(Quantity.of(entry, stand, kind))
        except (UsageError, QuantityError) as error:
            problems.add(where, str(error))
    if problems.lines:
        raise CampaignError(problems.lines)
    varied = Stand.from_dict(numbers.written_out(entry.number for entry in draw.varied), stand.name)
    return Campaign(path, table, document, varied, draw, over, tuple(quantities))


def _stand(name: str, folder: Path, problems: Problems) -> Stand:
    """The stand of a file beside the campaign file, or an example. Raises CampaignError, StandError."""
    if is_file(folder / name):
        return Stand.of(folder / name)
    if name in stands.names():
        return load(stands.path(name))
    known = [*sorted(path.name for path in folder.glob("*.toml")), *stands.names()]
    problems.add("stand", f"no stand file {show(name)} beside it, and no such example{suggestion(name, known)}")
    raise CampaignError(problems.lines)


def _files_named(path: Path) -> Iterator[Path]:
    """Files beside a text that it names in quotes, and those that these name, such as tables of a regime."""
    for name in re.findall(r"""["']([^"'\n\0]{1,199})["']""", path.read_text(encoding="utf-8", errors="replace")):
        named = path.parent / name
        if named != path and is_file(named):
            yield named
            if named.suffix in (".toml", ".json") and named.stat().st_size < TEXT:
                yield from _files_named(named)
