"""`mahovik doctor`: which compilers, emulators and extras are here, and what installs the others."""

from __future__ import annotations

import click

from mahovik.out.cli.arguments import console, table
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress


@click.command(short_help="Say which tools are here, and what installs the others.")
@json_option("Print JSON.")
def doctor(as_json: bool) -> None:
    """Say which compilers, emulators, checkers and extras this machine has, and what installs the others.

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
