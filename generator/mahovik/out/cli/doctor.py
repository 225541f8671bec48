"""`mahovik doctor`: compilers, emulators and extras on this machine, and how to install missing ones."""

from __future__ import annotations

import click

from mahovik.out.cli.arguments import console, table
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress


@click.command(short_help="List tools found, and how to install others.")
@json_option("Print JSON.")
def doctor(as_json: bool) -> None:
    """List the compilers, emulators, checkers and extras on this machine, and how to install the others.

    Only a C compiler is needed for daily work, and not even that for `generate`. Exit status 1 without one.
    """
    from dataclasses import asdict

    from mahovik.core.toolchain.doctor import findings

    with progress("ask the tools for their versions"):
        found = findings()
    if as_json:
        print_json([asdict(each) for each in found])
    else:
        rows = table("", "tool", "serves", "found, or how to install it")
        for each in found:
            rows.add_row("yes" if each.found else "no", each.what, each.serves, each.found or each.install)
        console().print(rows)
    if not found[0].found:
        raise SystemExit(1)
