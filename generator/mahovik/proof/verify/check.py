"""Checks, each one quantity of what is judged against a limit, and the report that they make, also as JUnit XML."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

import numpy as np

from mahovik.contract.limits import MOST_SCALE, MOST_SKIPPED
from mahovik.contract.quantities import FLOORS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.proof.verify.states import Request, state_line

FLOOR = 1e-290
"""Least scale of a difference: below it products of inputs are subnormal and have lost their digits."""

ENOUGH = 20
"""States from which on a median is taken: among few, extreme ones may be the most."""


@dataclass
class Check:
    """Largest difference of one quantity over all states at which it was compared, and its limit.

    judged        public function, want, program, judge or item that the quantity belongs to; "" of the whole
    limit         accepted `value`; 0 where only equality is right
    value         largest difference, a share of a scale unless the quantity says otherwise; inf: missing or refused
    verdict       ok, FAILED, "not compared"; of a program also "not offered", MISSING
    words         what there is to say: where `value` was largest, or why nothing was compared
    states        how often it was compared; `skipped`: how often it was not, see MOST_SKIPPED
    state         name of the state where the difference was largest for its limit; `request`: what `eval` takes
    second        largest difference of the second derivation from the reference; None where it has no such quantity
    second_limit  accepted `second`; None: as `limit`
    floor         least scale
    amplified     scales over the sizes of their quantities
    left_out      why states were skipped
    """

    judged: str
    quantity: str
    limit: float = 0.0
    value: float = 0.0
    verdict: str = "not compared"
    words: str = ""
    states: int = 0
    skipped: int = 0
    state: str = ""
    request: Request | None = None
    second: float | None = None
    second_limit: float | None = None
    floor: float = FLOOR
    amplified: list[float] = field(default_factory=list, repr=False)
    left_out: str = field(default="", repr=False)

    @classmethod
    def of(cls, quantity: str, value: float, limit: float, words: str = "") -> Check:
        """A check of one value, with words about it whatever the verdict."""
        made = cls("", quantity, limit)
        made.note(float(value), words=words)
        return made

    @property
    def failed(self) -> bool:
        """Whether this check makes the whole verification fail."""
        return self.verdict not in ("ok", "not offered", "not compared")

    @property
    def share(self) -> float:
        """The larger of both differences over its limit; above 1 the check fails."""
        return max(_share(self.value, self.limit), _share(self.second or 0.0, self.accepted_of_second))

    @property
    def accepted_of_second(self) -> float:
        """Limit of `second`."""
        return self.limit if self.second_limit is None else self.second_limit

    def note(
        self,
        value: float,
        state: str = "",
        words: str = "",
        request: Request | None = None,
        second: float | None = None,
    ) -> None:
        """Count one state with its difference; state, words and request are kept where it is largest for the limit."""
        share = max(_share(value, self.limit), _share(second or 0.0, self.accepted_of_second))
        if not self.states or share > self.share:
            self.state, self.words, self.request = state, words, request
        self.states += 1
        self.value = max(self.value, math.inf if math.isnan(value) else value)
        if second is not None:
            self.second = max(self.second or 0.0, second)
        self._decide()

    def compare(self, result: Any, expected: Any, scale: Any, state: str = "") -> None:
        """Count one state: |result - expected| over the scale; equal values are demanded where the scale is None."""
        off, words = difference(result, expected, scale, self.floor)
        self.note(off, state, words)

    def demand(self, right: bool, state: str = "", words: str = "") -> None:
        """Count one state that is right or wrong, for the reason in `words`."""
        self.note(0.0 if right else math.inf, state, "" if right else words)

    def refuse(self, error: Exception, state: str = "") -> None:
        """Count a state that what is judged refused, though it has an answer."""
        self.note(math.inf, state, str(error))

    def skip(self, words: str, state: str = "") -> None:
        """Leave a state out."""
        self.skipped += 1
        self.left_out = words
        if not self.states:
            self.state, self.words = state, words
        self._decide()
        if self.failed and self.share <= 1:
            self.state, self.words = state, self._skipped_words

    def note_scale(self, quantity: str, value: Any, scale: Any) -> None:
        """Keep how large a scale is for its quantity, but of one that may be zero by its structure."""
        if scale is None or isinstance(value, Mapping) or quantity in FLOORS:
            return
        size = float(np.max(np.abs(value), initial=0.0))
        if size:
            self.amplified.append(float(np.max(scale, initial=0.0)) / size)

    def settle(self) -> None:
        """Fail where the median of the scales is beyond MOST_SCALE: no error would be seen."""
        if len(self.amplified) >= ENOUGH and (scale := median(self.amplified)) > MOST_SCALE:
            self.demand(False, "", f"its scale is {scale:.0e} times its size: no error would be seen")
        self.amplified = []
        if self.verdict == "ok" and self.skipped:
            self.words = self.words or self._skipped_words

    @property
    def _skipped_words(self) -> str:
        return f"{self.skipped} of {self.states + self.skipped} states left out: {self.left_out}"

    def _decide(self) -> None:
        if self.states:
            few = self.skipped <= MOST_SKIPPED * (self.states + self.skipped)
            self.verdict = "ok" if self.share <= 1 and few else "FAILED"


def _share(value: float, limit: float) -> float:
    if value == 0.0:
        return 0.0
    return value / limit if limit else math.inf


def difference(result: Any, expected: Any, scale: Any, floor: float = FLOOR) -> tuple[float, str]:
    """Largest |result - expected| / scale over the components, and a reason if the values cannot be compared.

    `expected` may be balls of Arb, which hold the exact numbers: the largest that it may be.
    """
    if result is None:
        return math.inf, "missing"
    if isinstance(expected, dict):
        return _of_parts(result, expected, scale, floor)
    if scale is None:
        same = np.asarray(result).tolist() == np.asarray(expected).tolist()
        return (0.0, "") if same else (math.inf, f"{result} where the reference has {expected}")
    try:
        numbers = np.array(result, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return math.inf, "no array of numbers"
    wanted = np.asarray(expected)
    if not numbers.size and not wanted.size:
        return 0.0, ""  # an empty list in JSON has no second length
    if numbers.shape != wanted.shape:
        return math.inf, f"shape {list(numbers.shape)}, expected {list(wanted.shape)}"
    if not np.isfinite(numbers).all():
        return math.inf, "not finite"
    with np.errstate(over="ignore"):
        off = np.asarray(np.abs(wanted - numbers))
        if off.dtype == object:
            off = np.reshape([float(ball.upper()) for ball in off.flat], off.shape)
        relative = off / np.maximum(scale, floor)
    return float(relative.max()), ""


def _of_parts(result: Any, expected: dict[str, Any], scale: Any, floor: float) -> tuple[float, str]:
    """Difference of the worst part of a nested object, and its words with the name of the part."""
    if not isinstance(result, Mapping):
        return math.inf, "no object"
    worst, words = 0.0, ""
    for name, value in expected.items():
        off, reason = difference(result.get(name), value, scale[name], floor)
        if off > worst:
            worst, words = off, f"{name}: {reason}" if reason else name
    return worst, words


@dataclass(frozen=True)
class Report:
    """Result of a verification: the stand (without the features in `left_out`), what was judged, and the checks."""

    stand: str
    structure: str
    physics: str
    judged: str
    seed: int | None
    states: int
    tolerance: float
    rows: tuple[Check, ...]
    error: str = ""
    left_out: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether something was compared and nothing failed."""
        return not self.error and any(row.verdict == "ok" for row in self.rows) and not self.failures

    @property
    def failures(self) -> tuple[Check, ...]:
        """Rows that failed."""
        return tuple(row for row in self.rows if row.failed)


TEXT = "text = as generated"
"""Quantity of the row on the text of a folder; its words say where that differs, and who has written it."""

OTHER_TEXT = "its text is not what this version generates"
"""Reason of a row that C of a folder is not compared in, because another version or a hand has written it."""


def report(
    stand: Stand, judged: str, seed: int | None, count: int, tolerance: float, rows: Sequence[Check], error: str = ""
) -> Report:
    """The report of these rows on a stand."""
    names = identities(stand)
    return Report(stand.name, names.structure, names.physics, judged, seed, count, tolerance, tuple(rows), error)


def conclusion(report: Report) -> str:
    """The verdict in one line; of C with another text than this version's, it says so.

    Where nothing was compared, the report is not passed, but nothing failed either.
    """
    names = (
        row.quantity if row.request else " ".join(dict.fromkeys((row.judged, row.quantity))) for row in report.failures
    )
    ok = [row for row in report.rows if row.verdict == "ok"]
    if report.failures and all(row.verdict == "not installed" for row in report.failures):
        verdict = f"not everything was run: {', '.join(dict.fromkeys(row.judged for row in report.failures))}"
    elif report.error or report.failures:
        verdict = f"FAILED: {report.error or ', '.join(dict.fromkeys(name.strip() for name in names))}"
    elif ok:
        row = max([row for row in ok if row.limit == report.tolerance] or ok, key=lambda row: row.value)
        worst = f"worst {row.value:.1e} of the natural scale, {row.limit:.0e} accepted"
        count = f"{len(ok)} of {len(report.rows)}"
        exact = f"{count} checks" if any(other.limit for other in ok) else f"the same in {count}"
        verdict = f"passed: {worst if row.limit else exact}"
    else:
        verdict = ": ".join(["nothing was compared", *[row.words for row in report.rows if row.words][:1]])
    differs = next((row.words for row in report.rows if row.quantity == TEXT and row.words), "")
    return verdict + (f"; text differs from this version's, {differs}" if differs else "")


def summary(report: Report) -> dict[str, Any]:
    """What the JSON of a report says besides its rows, which have `judged` and `states` of their own."""
    keys = ("stand", "structure", "physics", "left_out", "seed", "tolerance", "passed")
    about = {"subject": report.judged, "count": report.states, "conclusion": conclusion(report)}
    return {key: getattr(report, key) for key in keys} | about


def as_junit(report: Report, command: str = "verify", sentences: Sequence[str] = ()) -> str:
    """The table of a command as JUnit XML: one test case for each row; `sentences` go to each that failed."""
    suite = ET.Element("testsuite", name=f"mahovik {command} {report.stand}")
    skipped = 0
    for row in report.rows:
        name = f"{row.judged}: {row.quantity}" if row.judged else row.quantity
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name=name)
        words = f"{row.verdict}, {row.states} states, largest difference {row.value:.3g} at {row.state or '-'}"
        if row.second is not None:
            words += f", second derivation {row.second:.3g} from the reference"
        if row.limit:
            ET.SubElement(case, "system-out").text = _printable(words)
        if row.failed:
            failure = ET.SubElement(case, "failure", message=_printable("; ".join(filter(None, (words, row.words)))))
            failure.text = _printable("\n".join([*sentences, state_line(row.request) if row.request else row.words]))
        elif row.verdict != "ok":
            skipped += 1
            ET.SubElement(case, "skipped", message=_printable(f"{row.verdict} {row.words}".strip()))
    errors = int(bool(report.error or not report.rows))
    if errors:
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name="run")
        ET.SubElement(case, "error", message=_printable(report.error or "nothing was compared"))
    counts = {"tests": len(suite), "failures": len(report.failures), "errors": errors, "skipped": skipped}
    for name, number in counts.items():
        suite.set(name, str(number))
    ET.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(suite, encoding="unicode") + "\n"


def worst_lines(report: Report) -> str:
    """States as `eval` takes them: the worst of every quantity that failed, or of all where none did; worst first."""
    rows = [row for row in report.failures or report.rows if row.request is not None]
    rows.sort(key=lambda row: -row.share)
    return "".join(f"{line}\n" for line in dict.fromkeys(state_line(row.request) for row in rows if row.request))


def _printable(text: str) -> str:
    """Text without characters that XML cannot hold: a foreign program may print anything."""
    return "".join(c if c in "\t\n" or (c >= " " and c.isprintable()) else "?" for c in text)
