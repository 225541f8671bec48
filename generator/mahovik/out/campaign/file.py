"""Read a campaign file (TOML): what varies, the design of the samples, what is computed of each.

All problems are found before any is reported.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from mahovik import stands
from mahovik.core.motion.document import NOT_NULL, any_list, document_of, text_of
from mahovik.core.stand.content import TEXT, is_file
from mahovik.core.stand.fields import Table, Text, integer, refuse, text, validator
from mahovik.core.stand.numbers import StandNumbers
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import PLAIN, QuantityError, number, show
from mahovik.errors import CampaignError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand, load
from mahovik.out.campaign.convergence import Goal
from mahovik.out.campaign.designs import DESIGNS, MOST_HELD
from mahovik.out.campaign.draw import Copula, Draw, Parameter, cholesky
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.quantity_tables import quantities_by_name
from mahovik.out.campaign.rows import MOST_SAMPLES
from mahovik.out.campaign.vary import read_vary
from mahovik.out.campaign.wanted import WantedTable

_LONGEST_SEED = 2**63 - 1


def _whole(least: int, most: int) -> Any:
    def read(raw: Any) -> int:
        found = integer(raw)
        if not least <= found <= most:
            raise QuantityError(f"{show(found)}: expected {least} to {most}")
        return found

    return validator(read)


def _share(raw: Any) -> float:
    found = number(raw, PLAIN)
    if not 0.0 < found < 1.0:
        raise QuantityError(f"{found:g}: expected above 0 and below 1, or in %")
    return found


def _design(raw: Any) -> str:
    if text(raw) not in DESIGNS:
        raise QuantityError(f"unknown {show(raw)}{suggestion(raw, DESIGNS)}")
    return str(raw)


def _paths(raw: Any) -> tuple[str, ...]:
    return tuple(text(each) for each in any_list(raw))


def _coefficient(raw: Any) -> float:
    found = number(raw, PLAIN)
    if not -1.0 < found < 1.0:
        raise QuantityError(f"{found:g}: expected above -1 and below 1")
    return found


def _by_name(raw: Any) -> dict[str, Any]:
    if not isinstance(raw, dict):
        raise QuantityError(f"expected a table, found {show(raw)}")
    return raw


def _only_tables(raw: Any) -> Any:
    if not isinstance(raw, dict):
        raise refuse(f"expected a table, found {show(raw)}")
    return raw


class CorrelationTable(Table):
    """One `[[correlation]]`: numbers of which every two have this coefficient."""

    of: Annotated[tuple[str, ...], validator(_paths)]
    coefficient: Annotated[float, validator(_coefficient)]


class QuantileTable(Table):
    """`[quantile]`: what is to be known well."""

    of: Text
    at: Annotated[float, validator(_share)] = 0.95
    confidence: Annotated[float, validator(_share)] = 0.95


class CampaignTable(Table):
    """A campaign file."""

    name: Text | None = None
    stand: Text
    samples: Annotated[int, _whole(1, MOST_SAMPLES)]
    seed: Annotated[int, _whole(0, _LONGEST_SEED)] = 1
    design: Annotated[str, validator(_design)] = "random"
    shard: Annotated[int | None, _whole(1, MOST_SAMPLES)] = None
    until: Annotated[float | None, validator(_share)] = None
    quantile: Annotated[QuantileTable | None, NOT_NULL] = None
    vary: Annotated[dict[str, Any], validator(_by_name)]
    correlation: list[CorrelationTable] = Field(default_factory=list)
    over: Annotated[OverTable | None, NOT_NULL] = None
    quantity: Annotated[dict[str, WantedTable], BeforeValidator(_only_tables)] = Field(default_factory=dict)


@dataclass(frozen=True)
class CampaignFile:
    """A valid campaign file.

    `source`: its name in messages; `document`: its keys as they are written; `files`: tables that numbers are taken
    from.
    """

    name: str
    source: str
    table: CampaignTable
    stand: Stand
    draw: Draw
    goal: Goal | None
    document: dict[str, Any]
    folder: Path
    files: tuple[Path, ...]


def load_campaign(path: str | Path) -> CampaignFile:
    """Read and check the campaign file at `path`. Raises CampaignError with every problem, StandError."""
    path = Path(path)
    source, folder = path.name, path.parent
    document = document_of(text_of(path, TEXT, CampaignError), source, CampaignError, is_json=False)
    problems = Problems(source)
    table = problems.valid(CampaignTable, quantities_by_name(document, problems))
    if table is None or problems.lines:
        raise CampaignError(problems.lines)
    stand = _stand(table.stand, folder, problems)
    numbers = StandNumbers(stand, stand.to_dict())
    vary = read_vary(table.vary, numbers, folder, problems)
    if not vary.parameters and not problems.lines:
        problems.add("vary", "nothing varies; expected a path such as carrier.mass")
    draw = _draw(vary.parameters, table, numbers, problems)
    goal = _goal(table, problems)
    taken = {"sample", "error", *(each.place.path for each in vary.parameters)}
    for name in taken & table.quantity.keys():
        problems.add(f"quantity {show(name)}", "is the name of another column; expected another name")
    if problems.lines or draw is None:
        raise CampaignError(problems.lines)
    varied = Stand.from_dict(numbers.written_out(each.place for each in vary.parameters), stand.name)
    return CampaignFile(table.name or path.stem, source, table, varied, draw, goal, document, folder, vary.files)


def _stand(given: str, folder: Path, problems: Problems) -> Stand:
    """The stand of a file beside the campaign file, or an example. Raises CampaignError, StandError."""
    path = folder / given
    if is_file(path):
        return Stand.of(path)
    if given in stands.names():
        return load(stands.path(given))
    known = [*sorted(each.name for each in folder.glob("*.toml")), *stands.names()]
    problems.add("stand", f"no stand file {show(given)} beside it, and no such example{suggestion(given, known)}")
    raise CampaignError(problems.lines)


def _goal(table: CampaignTable, problems: Problems) -> Goal | None:
    if table.quantile is None:
        if table.until is not None:
            problems.add("until", "of which quantile? expected a table [quantile] with of and at")
        return None
    if table.design in ("morris", "saltelli"):
        key = "quantile" if table.until is None else "until"
        problems.add(key, f'not allowed with design "{table.design}", which has no quantiles')
    return Goal(table.quantile.of, table.quantile.at, table.quantile.confidence, table.until)


def _draw(
    parameters: tuple[Parameter, ...], table: CampaignTable, numbers: StandNumbers, problems: Problems
) -> Draw | None:
    """Factors in the order of the file, with their correlations."""
    factors = tuple(dict.fromkeys(each.factor for each in parameters if each.factor is not None))
    by_path = {each.place.path: each.factor for each in parameters}
    matrix = [[float(i == j) for j in range(len(factors))] for i in range(len(factors))]
    given: dict[tuple[int, int], int] = {}
    for number_, each in enumerate(table.correlation):
        where = f"correlation[{number_}]"
        try:
            found = list(_factors_of(each.of, numbers, by_path))
        except UsageError as error:
            problems.add(where, "of", str(error))
            continue
        if len(set(found)) < 2:
            problems.add(where, "of", "expected two numbers or more that vary each by itself")
        columns = [factors.index(name) for name in dict.fromkeys(found)]
        for i in columns:
            for j in columns:
                if i < j and given.setdefault((i, j), number_) != number_:
                    problems.add(where, "of", f"{factors[i]} and {factors[j]} are correlated twice")
                if i != j:
                    matrix[i][j] = each.coefficient
    if table.correlation and table.design in ("morris", "saltelli"):
        problems.add("correlation", f'not allowed with design "{table.design}", which changes factors one by one')
    held = {"latin": table.samples, "morris": table.samples * len(factors)}.get(table.design, 0)
    if held > MOST_HELD:
        least = MOST_HELD if table.design == "latin" else MOST_HELD // len(factors)
        problems.add("samples", f'at most {least} with design "{table.design}"; expected fewer, or another design')
    if problems.lines:
        return None
    columns = sorted({i for pair in given for i in pair})
    if not columns:
        return Draw(parameters, factors, None)
    lower = cholesky([[matrix[i][j] for j in columns] for i in columns])
    if lower is None:
        problems.add("correlation", "no such numbers exist: the matrix of all coefficients is not positive definite")
        return None
    return Draw(parameters, factors, Copula(tuple(columns), lower))


def _factors_of(paths: tuple[str, ...], numbers: StandNumbers, by_path: dict[str, str | None]) -> Iterator[str]:
    for pattern in paths:
        for place in numbers.find(pattern):
            factor = by_path.get(place.path)
            if factor is None:
                raise UsageError(f"{place.path} does not vary{suggestion(place.path, by_path)}")
            yield factor


def files_in(value: Any, folder: Path) -> Iterator[Path]:
    """Files that texts of a part of the campaign file name, in order."""
    if isinstance(value, dict):
        for each in value.values():
            yield from files_in(each, folder)
    elif isinstance(value, list):
        for each in value:
            yield from files_in(each, folder)
    elif isinstance(value, str):
        for name in (value, value.rpartition(":")[0]):  # file.py:function
            if name and is_file(folder / name):
                yield folder / name
                yield from _named_inside(folder / name)


def _named_inside(path: Path) -> Iterator[Path]:
    """Files that a regime or another text names, such as tables of speeds."""
    if path.suffix in (".toml", ".json") and path.stat().st_size < TEXT:
        for name in re.findall(r'"([^"\n\0]{1,199})"', path.read_text(encoding="utf-8", errors="replace")):
            if is_file(path.parent / name):
                yield path.parent / name
