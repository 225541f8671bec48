"""A stand file in the place of another file is called by its name; its keys are not listed as unknown."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused
from mahovik.out.cli import main
from mahovik.out.cli.options import is_stand_file
from mahovik.stands import path


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("simulate", DEMO3, "--until", "1", "-o", "a.csv", "--regime"), "a regime file"),
        (("simulate", DEMO3, "--programme", "p.json", "--motion", "m.json", "--servo"), "a servo file"),
        (("identify", DEMO3, "--free", "w*.unbalance", "-o", "new.toml", "--data"), "measured data"),
        (("identify", DEMO3, "--data", "d.csv", "-o", "new.toml", "--free"), "a file that names free numbers"),
        (("balance", DEMO3, "--data"), "measured data"),
        (("balance", DEMO3, "--data", "d.csv", "--plane"), "a file of correction planes"),
        (("design", DEMO3, "--motion", "m.json", "-o", "new.toml", "--free"), "a file that names free numbers"),
        (("judge", DEMO3, "--fmu", "a.fmu", "--map"), "a map of variables"),
        (("verify", DEMO3, "--against", "c", "--servo"), "a servo file"),
    ],
    ids=lambda value: f"{value[0]} {value[-1]}" if isinstance(value, tuple) else "",
)
def test_one_line_says_that_it_is_a_stand_file(arguments: tuple[str, ...], expected: str) -> None:
    line = f"error: {arguments[-1]} {BENCH8}: this is a stand file, expected {expected}\n"
    assert refused(*arguments, BENCH8) == line
    assert not list(Path.cwd().iterdir())


def test_a_campaign_has_no_option_to_name() -> None:
    assert refused("campaign", "run", BENCH8, "-o", "out") == (
        f"error: {BENCH8}: this is a stand file, expected a campaign file\n"
    )


def test_every_option_that_reads_toml_knows_what_it_reads() -> None:
    """Another one is added with `reads`: the help shows a name that ends in .toml."""
    found = {}

    def walk(group: object, name: str) -> None:
        for each in getattr(group, "commands", {}).values():
            walk(each, f"{name} {each.name}")
        for each in getattr(group, "params", ()):
            metavar = each.metavar or ""
            if each.opts[0] != "-o" and metavar.endswith(".toml") and "STAND" not in metavar:
                found[f"{name} {each.opts[0]}"] = each.callback is not None

    walk(main, "mahovik")
    assert len(found) > 5
    assert all(found.values()), sorted(name for name, told in found.items() if not told)


@pytest.mark.parametrize(
    "text",
    [
        "schema = 1\n[flywheel.w1]\nspeed = 1\n",
        '[carrier]\nmass = "1 kg"\n',
        "schema = 1\ncarrier = \n",
        "schema = 1\ncarrier = '\xff'\n",
        "",
    ],
    ids=["a regime", "no schema", "no TOML", "no UTF-8", "empty"],
)
def test_other_files_are_left_to_their_reader(text: str, tmp_path: Path) -> None:
    file = tmp_path / "a.toml"
    file.write_bytes(text.encode("latin-1"))
    assert not is_stand_file(file)
    assert not is_stand_file(tmp_path)
    assert not is_stand_file(tmp_path / "none.toml")


def test_every_example_is_one() -> None:
    assert all(is_stand_file(path(name)) for name in ("bench8", "demo3", "auv6"))
