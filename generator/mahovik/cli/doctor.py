"""`mahovik doctor`: which compilers, emulators and extras are here, and what installs the others."""

from __future__ import annotations

import click

from mahovik.cli.arguments import console, table
from mahovik.cli.progress import progress


@click.command(short_help="Say which tools are here, and what installs the others.")
@click.option("--json", "as_json", is_flag=True, help="As JSON.")
def doctor(as_json: bool) -> None:
    """Say which compilers, emulators, checkers and extras this machine has, and what installs the others.

    Only a C compiler is needed for daily work, and not even that for `generate`. Exit status 1 without one.
    """
    import json
    from dataclasses import asdict

    from mahovik.toolchain.doctor import findings

    with progress("ask the tools for their versions"):
        found = findings()
    if as_json:
        click.echo(json.dumps([asdict(each) for each in found], indent=1))
    else:
        rows = table("", "tool", "serves", "found, or how to install it")
        for each in found:
            rows.add_row("yes" if each.found else "no", each.what, each.serves, each.found or each.install)
        console().print(rows)
    if not found[0].found:
        raise SystemExit(1)
