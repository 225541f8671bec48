"""`mahovik doctor`: compilers, emulators and extras on this machine, and how to install missing ones."""

from __future__ import annotations

from mahovik.out.cli.options import JSON, command
from mahovik.out.cli.output import print_json, print_table
from mahovik.out.cli.progress import progress


@command(short_help="List tools found, and how to install others.")
def doctor(as_json: bool = JSON) -> None:
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
        rows = (("yes" if e.found else "no", e.what, e.serves, e.found or e.install) for e in found)
        print_table(("", "tool", "serves", "found, or how to install it"), rows)
    if not found[0].found:
        raise SystemExit(1)
