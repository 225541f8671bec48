"""Tables of verdicts that `mahovik verify` and `mahovik judge` print."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import shorten
from typing import TYPE_CHECKING

from mahovik.out.cli.output import Cell, print_line, print_table

if TYPE_CHECKING:
    from mahovik.proof.verify.check import Check, Report


MOST_FUNCTIONS = 20
"""Lines of functions in the short table, so that a stand that passes takes at most thirty lines."""

WIDTH, QUANTITY = 100, 29
"""Most columns of the short table, and of a quantity in it; what is longer is folded, or cut between words."""


def print_report(found: Report, by: str = "", everything: bool = True) -> None:
    """Differences from the reference, and the conclusion: of every quantity, or a line for each function.

    `by`: head of the column of wants.
    """
    from mahovik.contract.functions import ALL_WANTS, is_public
    from mahovik.proof.verify.check import conclusion

    print_line(f"{found.judged} of {found.stand}   {_identities(found)}   seed {found.seed}")
    if found.left_out:
        print_line(f"the stand without: {', '.join(found.left_out)}", "yellow")
    named = {row.judged for row in found.rows if row.judged}
    by = by or ("want" if named <= {*ALL_WANTS} else "function" if all(map(is_public, named)) else "judge")
    if everything:
        columns = ("quantity", by, "states>", "worst>", "limit>", "second, its limit>", "at state", "verdict")
        print_table(
            columns,
            [
                (row.quantity, row.judged, _states(row), *_figures(row), _second(row), row.state, _verdict(row))
                for row in found.rows
            ],
        )
    elif found.rows:
        _print_functions(found.rows, by)
    _print_conclusion("FAILED" if found.error else conclusion(found), found.passed)


def _print_functions(rows: Sequence[Check], by: str) -> None:
    """A line for each function, by the check that is nearest to its limit; all lines of checks that failed."""
    whole = [row for row in rows if not row.judged]
    groups = {row.judged: [other for other in rows if other.judged == row.judged] for row in rows if row.judged}
    compared = {
        name: group for name, group in groups.items() if any(row.verdict == "ok" or row.failed for row in group)
    }
    shown = dict(sorted(compared.items(), key=lambda group: -max(row.share for row in group[1]))[:MOST_FUNCTIONS])
    lines: list[Sequence[Cell]] = []
    for name, group in compared.items():
        failed = [row for row in group if row.failed]
        if name in shown and not failed:
            worst = max((row for row in group if row.states), key=lambda row: row.share)
            lines.append((name, str(max(row.states for row in group)), *_nearest(worst), ("ok", "green")))
        lines += [(name, _states(row), *_nearest(row), _verdict(row)) for row in failed]
    lines += [
        (row.quantity, _states(row), *_figures(row), "", _verdict(row))
        for row in whole
        if row.verdict != "not compared"
    ]
    print_table((by, "states>", "worst>", "limit>", "nearest to its limit", "verdict"), lines, piped=WIDTH)
    if more := [name for name in compared if name not in shown]:
        print_line(f"and {len(more)} more, nearer to the reference: --all lists every check")
    absent = [
        row.judged or row.quantity for row in rows if row.verdict == "not compared" and row.judged not in compared
    ]
    if absent:
        words = f"not compared, --all says why: {', '.join(dict.fromkeys(absent))}"
        print_line(shorten(words, WIDTH, placeholder=" ..."), "yellow")


def _states(row: Check) -> str:
    return str(row.states) if row.states else ""


def _figures(row: Check) -> tuple[str, str]:
    """Difference and limit of a check; none where only equality is right."""
    numbers = row.verdict in ("ok", "FAILED") and row.limit
    return (f"{row.value:.1e}", f"{row.limit:.0e}") if numbers else ("", "")


def _second(row: Check) -> str:
    """Difference of the second derivation from the reference, and its limit."""
    return "" if row.second is None else f"{row.second:.1e}, {row.accepted_of_second:.0e}"


def _nearest(row: Check) -> tuple[str, str, str]:
    """Difference, limit and quantity of a check, or of the second derivation where this is nearer to its limit."""
    quantity, figures = row.quantity, _figures(row)
    if row.second is not None and row.second * row.limit > row.value * row.accepted_of_second:
        quantity, figures = f"{quantity}, second", (f"{row.second:.1e}", f"{row.accepted_of_second:.0e}")
    return (*figures, shorten(quantity, QUANTITY, placeholder=" ..."))


def _identities(found: Report) -> str:
    return f"structure {found.structure}, physics {found.physics}"


def _verdict(row: Check) -> Cell:
    """The verdict and its words, in its colour."""
    style = "green" if row.verdict == "ok" else "red" if row.failed else "yellow"
    return f"{row.verdict}  {row.words}".rstrip(), style


def _print_conclusion(words: str, passed: bool) -> None:
    print_line(words, "bold green" if passed else "bold red")
