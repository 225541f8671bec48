"""`generate --only`: some of the public functions and what they need, with the bits of the whole."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import mahovik
from cli.run import refused
from cli.run import run as cli
from emit.stands import generated, stand, write
from mahovik.contract.functions import CHOSEN, FUNCTIONS
from mahovik.core.emit.delivered import delivered_options
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.generate import generate_all
from mahovik.errors import UsageError
from mahovik.proof.cost import require_place
from mahovik.stands import path
from toolchain.tools import compile_c, require, run


@pytest.mark.slow
@pytest.mark.parametrize("only", ["forward,torque", "mounts", "step", "wrap"])
def test_a_part_compiles_and_passes_its_self_test(only: str, tmp_path: Path) -> None:
    """The C has no warning; golden vectors and sweeps are those of the interpreter."""
    names = only.split(",")
    write(delivery(stand("sat4"), "double", tuple(names), ("selftest",)), tmp_path)
    header = (tmp_path / "sat4.h").read_text()
    public = re.findall(r"^sat4_status sat4_(\w+)\(|^sat4_real sat4_(\w+)\(", header, re.MULTILINE)
    assert {a or b for a, b in public} == {*names, *(["prepare_mounts"] if "mounts" in names else [])}
    program = tmp_path / "program"
    compile_c(
        require("gcc", "gcc"), *tmp_path.rglob("*.c"), "-O1", "-ffp-contract=off", "-DSAT4_SELFTEST_MAIN", "-o", program
    )
    log = run(program)
    assert log.splitlines()[-1] == "failures 0"
    assert all(name in log for name in names)


def test_a_part_is_text_of_the_whole_and_smaller() -> None:
    whole = generated("sat4").files["sat4.c"]
    part = delivery(stand("sat4"), only=("forward",))["sat4.c"]
    assert len(part) < len(whole) / 3
    body = re.search(r"\nSAT4_CODE sat4_status sat4_forward\(.*?\n}\n", part, re.DOTALL)
    assert body is not None and body[0] in whole


@pytest.mark.parametrize("only", ["forward", "wrap", "step"])
def test_a_part_declares_only_what_it_needs(only: str, tmp_path: Path) -> None:
    """It has no unused macro, no status that cannot occur, and no word about absent functions."""
    files = generate_all(stand("sat4"), only=(only,)).files
    source, header = write(files, tmp_path), files["sat4.h"]
    compile_c(require("gcc", "gcc"), source, "-Wunused-macros", "-fsyntax-only")
    code = re.sub(r"/\*.*?\*/", "", files["sat4.c"], flags=re.DOTALL)
    bounds = re.findall(r"#define (SAT4_(?:MAX_\w+|LARGEST)) ", header)
    assert [macro for macro in bounds if macro not in code] == []
    named = re.search(r"Returns ([^.]*)\.", re.sub(r"\n \*", "", header))
    returned = {"OK"} if named is None else {status.strip() for status in named[1].split(",")}
    listed = re.findall(r"^    SAT4_(\w+) = -?\d+,?  ", re.sub(r" +/\*", "  /*", header), re.MULTILINE)
    assert set(listed) == returned | {"OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"}
    page = delivery(stand("sat4"), "double", (only,), ("selftest",))["verification/sat4_selftest.c"]
    text = header + page
    absent = {f.name for f in generated("sat4").program.functions if f.public and f.name != only}
    assert absent & set(re.findall(r"(?:sat4_|^ \*     )(\w+)(?=\(| PASS| 0123)", text, re.MULTILINE)) == set()
    assert not re.search(r"\bprepare\b", text)


def test_names_are_a_list_or_a_text_and_all_means_all(tmp_path: Path) -> None:
    mahovik.generate(mahovik.example("demo3"), output=tmp_path / "part", only="torque, forward")
    for name, text in delivery(stand("demo3"), only=("forward", "torque")).items():
        assert (tmp_path / "part" / name).read_text() == text
    mahovik.generate(mahovik.example("demo3"), output=tmp_path / "all", only="all")
    header = (tmp_path / "all" / "demo3.h").read_text()
    assert all(f"demo3_status demo3_{name}(" in header for name, row in (FUNCTIONS | CHOSEN).items() if not row.needs)


def test_an_unknown_function_is_refused() -> None:
    message = refused("generate", str(path("sat4")), "--only", "forward,torqe")
    assert '--only torqe: the C of sat4 has no such function, did you mean "torque"?' in message
    for names in ("list,forward", "all,forward", "", "forward,"):
        assert refused("generate", str(path("sat4")), "--only", names).startswith(
            ("error: --only ", "error: --only: is empty")
        )
    for only in ("", ["all", "forward"]):
        with pytest.raises(UsageError, match=r"^(--)?only:? "):
            mahovik.generate(mahovik.example("demo3"), only=only)
    said = refused("generate", str(path("demo3")), "--only", "momentum", "--batch")
    assert said.startswith("error: --batch: none of the functions momentum has one, expected one of matrices, forward,")
    assert "points" not in said and "reaction" not in said  # this stand has neither


def test_the_manifest_names_the_functions_and_commands_know_them(tmp_path: Path) -> None:
    folder, arguments = str(tmp_path / "part"), (str(path("sat4")), "--only", "torque,forward")
    assert cli("generate", *arguments, "--with", "encoder", "-o", folder).exit_code == 0
    assert json.loads((tmp_path / "part" / "manifest.json").read_text())["only"] == ["forward", "torque"]
    options = delivered_options(tmp_path / "part")
    assert options is not None
    assert (options.only, options.additions) == (("forward", "torque"), ("encoder",))
    assert cli("generate", arguments[0], "-o", folder, "--check").exit_code == 0
    require_place(tmp_path / "part", stand("sat4"))  # knows the C as that of a part


def test_batches_of_some_functions_compile_and_a_hold_has_no_estimate_of_unbalance(tmp_path: Path) -> None:
    cli("generate", str(path("demo3")), "--only", "mounts,forward", "--batch", "-o", str(tmp_path))
    compile_c(require("gcc", "gcc"), tmp_path / "demo3_batch.c", "-fsyntax-only")
    assert "_batch_of(" not in (tmp_path / "demo3_batch.h").read_text()  # tables of n stands are made by `prepare`
    with pytest.raises(UsageError, match="only identify_step: the C of held3 has no such function"):
        generate_all(stand("held3"), only=("identify_step",))
