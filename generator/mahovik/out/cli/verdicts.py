"""Tables of verdicts that `mahovik verify` and `mahovik judge` print."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mahovik.out.cli.output import Cell, print_line, print_table

if TYPE_CHECKING:
    from mahovik.proof.verify.check import Check, Report


MOST_FUNCTIONS = 20
"""Lines of functions in the short table, so that a stand that passes takes at most thirty lines."""

COLUMNS = ("states>", "worst>", "limit>", "second>")
WIDTH = 100
"""Most columns of a line of the short table; words are cut there."""


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
        columns = ("quantity", by, *COLUMNS, "at state", "verdict")
        print_table(
            columns,
            [(row.quantity, row.judged, *_figures(row), row.state, _verdict(row, row.words)) for row in found.rows],
        )
    elif found.rows:
        _print_functions(found.rows, by)
    _print_conclusion("FAILED" if found.error else conclusion(found), found.passed)


def _print_functions(rows: Sequence[Check], by: str) -> None:
    """A line for each function, by the check that is nearest to its limit; all lines of checks that failed."""
    whole = [row for row in rows if not row.judged]
    groups = {row.judged: [other for other in rows if other.judged == row.judged] for row in rows if row.judged}
    compared = {name: own for name, own in groups.items() if any(row.verdict == "ok" or row.failed for row in own)}
    shown = dict(sorted(compared.items(), key=lambda group: -max(row.share for row in group[1]))[:MOST_FUNCTIONS])
    lines: list[Sequence[Cell]] = []
    for name, own in compared.items():
        failed = [row for row in own if row.failed]
        if name in shown and not failed:
            worst = max((row for row in own if row.states), key=lambda row: row.share)
            states = str(max(row.states for row in own))
            lines.append((name, states, *_figures(worst)[1:], worst.quantity[:24], ("ok", "green")))
        lines += [(name, *_figures(row), row.quantity[:24], _verdict(row, row.words)) for row in failed]
    lines += [
        (row.quantity, *_figures(row), "", _verdict(row, row.words)) for row in whole if row.verdict != "not compared"
    ]
    print_table((by, *COLUMNS, "nearest to its limit", "verdict"), lines)
    if more := [name for name in compared if name not in shown]:
        print_line(f"and {len(more)} more, nearer to the reference: --all lists every check")
    absent = [
        row.judged or row.quantity for row in rows if row.verdict == "not compared" and row.judged not in compared
    ]
    if absent:
        words = f"not compared, --all says why: {', '.join(dict.fromkeys(absent))}"
        print_line(words if len(words) <= WIDTH else f"{words[: WIDTH - 4]} ...", "yellow")


def _figures(row: Check) -> tuple[str, str, str, str]:
    """States, difference, limit and second of a check; none where only equality is right."""
    numbers = row.verdict in ("ok", "FAILED") and row.limit
    figures = (f"{row.value:.1e}", f"{row.limit:.0e}") if numbers else ("", "")
    return (str(row.states) if row.states else "", *figures, "" if row.second is None else f"{row.second:.1e}")


def _identities(found: Report) -> str:
    return f"structure {found.structure}, physics {found.physics}"


def _verdict(row: Check, words: str) -> Cell:
    """The verdict and its words, in its colour."""
    style = "green" if row.verdict == "ok" else "red" if row.failed else "yellow"
    return f"{row.verdict}  {words}".rstrip(), style


def _print_conclusion(words: str, passed: bool) -> None:
    print_line(words, "bold green" if passed else "bold red")
