"""Whoever copies a command of the pages gets what they show: every block is run, or listed with a reason."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import click
import pages
import pytest

from docs.pages import PAGES, ROOT, Session, name, prose, steps
from mahovik.out.command_line import main
from toolchain.tools import require

NOT_RUN = {
    (
        "README.md",
        "pip install",
    ): "installs into an environment from the network; tests/test_package.py does so without",
    ("docs/architecture.md", "@kernel"): "a kernel is compiled from its text, never run",
    ("docs/judging.md", ". .venv/bin/activate"): "needs a checkout; tests/audits/test_audits.py runs its commands",
    ("docs/verification.md", "mahovik evidence"): "minutes to hours; a short one: tests/report/test_evidence.py",
    ("docs/verification.md", "sh bench8_eva.sh"): "hours of Frama-C; the quick ones are in .ci/run",
}
"""Blocks that no test runs, by page and how they begin; and why."""

QUICK = {"README.md", "docs/commands.md", "docs/howto/own-stand.md", "docs/stand-file.md", "docs/tutorial.md"}
"""Pages that most readers begin with, a minute of processor in all; the others are run by `make nightly`."""

TOOLS = {
    "gcc ": [("gcc", "gcc")],
    "cmake ": [("cmake", "cmake")],
    "make ": [("make", "make")],
    "target m4": [("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm")],
    "target m7": [("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm")],
    "--targets": [("qemu-system-arm", "qemu-system-arm"), ("qemu-system-riscv64", "qemu-system-misc")],
    "--cost": [("qemu-system-arm", "qemu-system-arm")],
}
"""What blocks with these words need, and the Debian packages that have it."""


def reason(page: Path, text: str) -> str | None:
    """Why a block is not run; None: it is."""
    reasons = [why for (where, start), why in NOT_RUN.items() if where == name(page) and text.startswith(start)]
    return reasons[0] if reasons else None


def runnable(page: Path) -> bool:
    return any(reason(page, step.block.text) is None for step in steps(page))


EXECUTED = [
    pytest.param(page, id=name(page), marks=[] if name(page) in QUICK else [pytest.mark.slow])
    for page in PAGES
    if runnable(page)
]


@pytest.mark.parametrize("page", EXECUTED)
def test_commands_give_what_is_shown(page: Path, tmp_path: Path) -> None:
    session = Session(page, tmp_path)
    for step in steps(page):
        if reason(page, step.block.text) is None:
            for tool, package in [pair for words, pairs in TOOLS.items() if words in step.block.text for pair in pairs]:
                require(tool, package)
            session.run(step)


def test_the_lists_name_what_is_there() -> None:
    """Every entry of the lists is about a block that exists."""
    for where, start in NOT_RUN:
        assert any(step.block.text.startswith(start) for step in steps(ROOT / where)), (where, start)


def test_the_page_of_commands_is_what_help_says() -> None:
    """`python tools/pages.py` rewrites it."""
    assert pages.COMMANDS.read_text(encoding="utf-8") == pages.commands_page()


def test_the_page_of_results_is_what_is_kept() -> None:
    """`python tools/campaign.py --render` rewrites it."""
    subprocess.run([sys.executable, ROOT / "tools" / "campaign.py", "--check"], check=True)


@pytest.mark.parametrize("page", pages.marked_pages(), ids=name)
def test_tables_between_marks_are_those_of_the_code(page: Path) -> None:
    """`python tools/pages.py` rewrites them."""
    assert page.read_text(encoding="utf-8") == pages.filled(page)


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_commands_in_sentences_exist(page: Path) -> None:
    """`mahovik command --option`: there is such a command, and it has that option."""
    for text in re.findall(r"`mahovik ([a-z][^`]*)`", prose(page)):
        if text.startswith("selftest "):
            continue  # the first line of what a board prints
        command, rest = resolved(" ".join(text.split()).split(" "))
        options = {option for parameter in command.params for option in parameter.opts}
        if not isinstance(command, click.Group):
            named = set(re.findall(r"(?<![\w\"-])(--[a-z][\w-]*)", " ".join(rest).partition('"')[0]))
            assert named - options - {"--help"} == set(), text


def resolved(words: list[str]) -> tuple[click.Command, list[str]]:
    """The command that words name, and the words after it."""
    command: click.Command = main
    context = click.Context(command)
    while words and isinstance(command, click.Group) and re.fullmatch(r"[a-z][a-z-]*", words[0]):
        inner = command.get_command(context, words[0].strip(",.;"))
        assert inner is not None, words
        command, words = inner, words[1:]
    return command, words


# ---- the comparison itself ----


@pytest.mark.parametrize(
    "text",
    ["```sh\nfalse\ntrue\n```\n", "```sh\necho a\n```\n```text\nb\n```\n", "```sh\ntrue # exit status 1\n```\n"],
    ids=["fails", "prints something else", "should fail"],
)
def test_what_is_not_so_is_noticed(text: str, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    session = Session(page, tmp_path)
    with pytest.raises(AssertionError, match=r"page\.md-0"):
        for step in steps(page):
            session.run(step)
