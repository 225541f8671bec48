"""The command line: one thin module a command. Nothing is computed here.

Exit status: 0 good; 1 a check failed, or some states; 2 bad input or usage; 130 Ctrl-C. What is heavy is
imported inside the commands, so that `mahovik --help` answers at once.
"""

from __future__ import annotations

import click

from mahovik import __version__
from mahovik.cli.check import check
from mahovik.cli.completion import completion
from mahovik.cli.cost import cost
from mahovik.cli.derive import derive
from mahovik.cli.design import design
from mahovik.cli.doctor import doctor
from mahovik.cli.evaluate import evaluate
from mahovik.cli.evidence import evidence
from mahovik.cli.export import export
from mahovik.cli.generate import generate
from mahovik.cli.group import Commands
from mahovik.cli.import_model import import_model
from mahovik.cli.judge import judge
from mahovik.cli.judge_log import judge_log
from mahovik.cli.linearize import linearize
from mahovik.cli.modes import modes
from mahovik.cli.new import new
from mahovik.cli.plan import plan
from mahovik.cli.plot import plot
from mahovik.cli.quiet import quiet
from mahovik.cli.replay import replay
from mahovik.cli.report import report
from mahovik.cli.response import response
from mahovik.cli.rest import rest
from mahovik.cli.simulate import simulate
from mahovik.cli.verify import verify
from mahovik.cli.verify_programme import verify_programme

SECTIONS = {
    "A stand": (new, import_model, check, derive, rest),
    "Its C, and the proof": (generate, verify, judge, cost, evidence, judge_log),
    "Motion, vibration": (evaluate, simulate, replay, modes, linearize, response, quiet),
    "Programmes of the flywheels": (plan, design, verify_programme),
    "Around it": (report, plot, export, doctor, completion),
}
"""Commands under the headings of `--help`, in the order in which one uses them; all fit on a screen of 40 lines."""


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    options_metavar="[-h | --version]",
    subcommand_metavar="COMMAND ...",
)
@click.version_option(__version__, prog_name="mahovik")
def main() -> None:
    """\b
    Exact equations of motion of carrier and unbalanced flywheels, as verified C.
        mahovik new bench8               copy an example stand
        mahovik generate bench8.toml     C into ./bench8
        mahovik verify bench8.toml       that C against the literal reference

    Exit status: 0 good, 1 a check failed, 2 bad input or usage, 130 Ctrl-C.
    """


for title, commands in SECTIONS.items():
    main.add_section(title, commands)
