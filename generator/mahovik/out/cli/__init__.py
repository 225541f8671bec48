"""The command line: one thin module per command. Nothing is computed here.

Exit status: 0 good; 1 a check failed, or some states; 2 bad input or usage; 130 Ctrl-C. Slow modules are imported
inside the commands, and of a command only its own module, so that it answers at once.
"""

from __future__ import annotations

import click

from mahovik import __version__
from mahovik.out.cli.group import Commands

SECTIONS = {
    "A stand": ("new", "import", "check", "derive", "rest"),
    "Its C, and the evidence": ("generate", "verify", "judge", "cost", "evidence", "judge-log"),
    "Motion, vibration": (
        *("eval", "simulate", "replay", "modes", "linearize", "response", "jitter", "quiet", "balance", "identify"),
        "campaign",
    ),
    "Programmes of the flywheels": ("plan", "verify-programme"),
    "Interfaces and tools": ("report", "plot", "export", "doctor", "completion"),
}
"""Commands under the headings of `--help`, in the order of use; all fit on a screen of 40 lines."""


@click.group(
    cls=Commands,
    sections=SECTIONS,
    context_settings={"help_option_names": ["-h", "--help"]},
    options_metavar="[-h | --version]",
    subcommand_metavar="COMMAND ...",
)
@click.version_option(__version__, prog_name="mahovik")
def main() -> None:
    """\b
    Verified C of carriers with unbalanced flywheels; try: mahovik new bench8
    Exit status: 0 good, 1 a check failed, 2 bad input or usage, 130 Ctrl-C.
    """
