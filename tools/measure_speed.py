"""Measures rows of times of this machine, and keeps them with its compiler and processor."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import campaign
from kept import Campaign, Columns

from mahovik.core.toolchain.board import version
from mahovik.core.toolchain.compiler import find_compiler


def measure_speed(about: str | None, kept: Campaign, table: Columns, rows: Callable[[], list[tuple[Any, ...]]]) -> None:
    """The command of a tool whose docstring is `about`: measures, keeps, renders the page; `--print` prints it alone.

    rows  measures all rows of the table
    """
    given = campaign.parser(about, print=False).parse_args()
    compiler = version(find_compiler()[0])
    found = {"compiler": compiler, "processor": campaign.processor(), "rows": table.rows(rows())}
    if given.print:
        print(kept.page(found))
    else:
        kept.keep(found)
