"""The command line: one thin module per command. Nothing is computed here.

Exit status: 0 good; 1 a check failed, or some states; 2 bad input or usage; 130 Ctrl-C. Slow modules are imported
inside the commands, so that `mahovik --help` answers at once.
"""

from __future__ import annotations

import click

from mahovik import __version__
from mahovik.out.cli.balance import balance
from mahovik.out.cli.campaign import campaign
from mahovik.out.cli.check import check
from mahovik.out.cli.completion import completion
from mahovik.out.cli.cost import cost
from mahovik.out.cli.derive import derive
from mahovik.out.cli.design import design
from mahovik.out.cli.doctor import doctor
from mahovik.out.cli.evaluate import evaluate
from mahovik.out.cli.evidence import evidence
from mahovik.out.cli.export import export
from mahovik.out.cli.generate import generate
from mahovik.out.cli.group import Commands
from mahovik.out.cli.identify import identify
from mahovik.out.cli.import_model import import_model
from mahovik.out.cli.jitter import jitter
from mahovik.out.cli.judge import judge
from mahovik.out.cli.judge_log import judge_log
from mahovik.out.cli.linear import linearize, modes
from mahovik.out.cli.new import new
from mahovik.out.cli.plan import plan
from mahovik.out.cli.plot import plot
from mahovik.out.cli.quiet import quiet
from mahovik.out.cli.replay import replay
from mahovik.out.cli.report import report
from mahovik.out.cli.response import response
from mahovik.out.cli.rest import rest
from mahovik.out.cli.simulate import simulate
from mahovik.out.cli.verify import verify
from mahovik.out.cli.verify_programme import verify_programme

SECTIONS = {
    "A stand": (new, import_model, check, derive, rest),
    "Its C, and the evidence": (generate, verify, judge, cost, evidence, judge_log),
    "Motion, vibration": (
        evaluate, simulate, replay, modes, linearize, response, jitter, quiet, balance, identify, campaign,
    ),
    "Programmes of the flywheels": (plan, design, verify_programme),
    "Interfaces and tools": (report, plot, export, doctor, completion),
}  # fmt: skip
"""Commands under the headings of `--help`, in the order of use; all fit on a screen of 40 lines."""


@click.group(
    cls=Commands,
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


for title, commands in SECTIONS.items():
    main.add_section(title, commands)
