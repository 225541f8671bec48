"""The C of the example stands against Pinocchio and MuJoCo, which are given the same bodies."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator

from campaigns import Row, Rows, Table
from mahovik.contract.limits import DOUBLE
from mahovik.core.stand import load
from mahovik.proof.verify.judges import PROGRAMS, verify_judges
from mahovik.stands import names, path

OPTIONS = {"states": 200}

COLUMNS = {"generated C against": "{}", **dict.fromkeys(PROGRAMS, "{:.0e}")}


def measure(options: Namespace) -> Iterator[tuple[str | float | None, ...]]:
    """A row for each quantity: the largest difference over the example stands, program by program."""
    checks = [check for name in names() for check in verify_judges(load(path(name)), count=options.states).rows]
    for quantity in dict.fromkeys(check.quantity for check in checks):
        differences = {check.judged: [] for check in checks}
        for check in checks:
            if check.quantity == quantity:
                differences[check.judged].append(check.value)
        yield quantity, *(max(differences[program], default=None) for program in PROGRAMS)


def agrees(row: Row) -> bool:
    """Whether both programs agree."""
    return all(row[program] is None or row[program] <= DOUBLE.value for program in PROGRAMS)


def claim(rows: Rows) -> str:
    """The largest difference."""
    worst = max(row[program] or 0.0 for row in rows for program in PROGRAMS)
    return f"The C agrees with Pinocchio and MuJoCo: largest difference {worst:.1e}"


def table_of(rows: Rows) -> Rows:
    """The columns of this campaign; earlier ones had more programs."""
    return [{title: row[title] for title in COLUMNS} for row in rows]


NOTE = """The largest difference over the example stands and their random and extreme states. The programs know no
fluid, suspension or legs, which were taken out. Where 16 times a program's own rounding is above 1e-12, as MuJoCo's is
of almost balanced flywheels, differences are divided by how far it is."""

TABLES = {"judges": Table(measure, COLUMNS, claim, agrees, NOTE, table_of)}
