"""Pages on held carriers: their stands and regimes are those of docs/held, their pictures those of their commands."""

from __future__ import annotations

import math
import re
import subprocess
from pathlib import Path

import held_pictures
import pytest

from docs.pages import ROOT, Block, blocks
from mahovik.core.motion.read import load as load_regime
from mahovik.core.stand import load
from mahovik.out.functions.evidence import generate

DOCS = ROOT / "docs"
EXAMPLES, PENDULUM, HELD = (DOCS / f"tutorial-{name}.md" for name in ("held-examples", "pendulum", "held"))
STANDS = sorted(file.stem for file in (DOCS / "held").glob("*.toml"))


def shown(page: Path, file: str) -> str:
    """Text of the file with this name on a page."""
    (block,) = (each for each in blocks(page) if each.file == file)
    return block.text


def commands(page: Path) -> list[Block]:
    """Blocks of commands of a page."""
    return [each for each in blocks(page) if each.language == "sh"]


@pytest.mark.parametrize("name", STANDS)
def test_a_stand_has_a_regime_and_a_section_with_both(name: str) -> None:
    stand, regime = (DOCS / "held" / folder / f"{name}.toml" for folder in ("", "regimes"))
    assert shown(EXAMPLES, f"{name}.toml") == stand.read_text(encoding="utf-8")
    assert shown(EXAMPLES, f"{name}.regime.toml") == regime.read_text(encoding="utf-8")
    assert f"(held/regimes/{name}.toml)" in HELD.read_text(encoding="utf-8")
    assert len(load_regime(regime, load(str(stand)), 10.0).flywheels) == len(load(str(stand)).flywheels)


def test_the_pendulum_of_the_firmware_differs_by_its_motor_alone() -> None:
    own = [line.partition("  #")[0].rstrip() for line in shown(PENDULUM, "pendulum.toml").splitlines()]
    without = [line for line in own if not line.startswith("motor")]
    kept = (DOCS / "held" / "pendulum.toml").read_text(encoding="utf-8").splitlines()
    assert len(own) == len(without) + 1
    assert without == [line for line in kept if not line.startswith("#")]


@pytest.mark.parametrize("page", [PENDULUM, EXAMPLES], ids=lambda page: page.stem)
def test_the_pictures_are_drawn_by_commands_of_the_page(page: Path) -> None:
    """Each is in docs/, and a command writes it from a run that a command before it wrote."""
    assert page.name in held_pictures.PAGES
    text = "\n".join(each.text for each in commands(page))
    drawn = dict(re.findall(r"^mahovik plot --run (\S+) .*-o (\S+\.svg)$", text, re.MULTILINE))
    assert sorted(drawn.values()) == sorted(held_pictures.pictures(page))
    for run, picture in drawn.items():
        assert re.search(rf"(-o|>) {run}$", text, re.MULTILINE)
        assert (DOCS / picture).read_text(encoding="utf-8").startswith("<?xml")


def test_every_picture_has_its_section() -> None:
    names = [f"held-{name.replace('_', '-')}.svg" for name in STANDS]
    assert sorted(held_pictures.pictures(EXAMPLES)) == sorted(names)


@pytest.mark.slow
@pytest.mark.parametrize("page", [PENDULUM, EXAMPLES], ids=lambda page: page.stem)
def test_the_pictures_are_those_of_the_pages(page: Path) -> None:
    """Same words, same lines within a hundredth of a point; pixels of a map of levels are not compared."""
    for name, text in held_pictures.draw(page).items():
        now, kept = (skeleton(each) for each in (text, (DOCS / name).read_text(encoding="utf-8")))
        assert now[0] == kept[0], name
        assert len(now[1]) == len(kept[1])
        assert max(abs(a - b) for a, b in zip(now[1], kept[1], strict=True)) < 0.01, name


NUMBER = re.compile(r"-?\d+\.\d+")


def skeleton(svg: str) -> tuple[str, list[float]]:
    """Text of a picture without its decimal numbers and pixels, and these numbers; names that are hashes left out."""
    text = re.sub(r"data:image/png;base64,[^\"]*", "", svg)
    text = re.sub(r"\b[mpi][0-9a-f]{10}\b|image[0-9a-f]{8,}", "", text)
    return NUMBER.sub("", text), [float(each) for each in NUMBER.findall(text)]


def test_the_page_on_C_tells_a_V_that_the_hold_does_not_allow(tmp_path: Path) -> None:
    """The function of the page, compiled: zero of V = S u in any pose, else what is blocked; a status of a NaN."""
    (snippet,) = (each.text for each in blocks(DOCS / "c-interface.md") if "double blocked_speed(" in each.text)
    generate(DOCS / "held" / "pendulum.toml", tmp_path)
    states = [(0.0, 2.0, 0.0), (1.0, -3.0, 0.0), (1.0, -3.0, 0.25), (2.5, 1.0, -0.5)]
    lines = "".join(
        f"x.attitude[0] = {math.cos(angle / 2)!r}; x.attitude[2] = {math.sin(angle / 2)!r};\n"
        f'x.V[4] = {speed!r}; x.V[0] = {off!r}; printf("%.17g\\n", blocked_speed(&x));\n'
        for angle, speed, off in states
    )
    (tmp_path / "main.c").write_text(
        f"#include <stdio.h>\n{snippet}\nint main(void)\n{{\n"
        f"pendulum_state x = {{ .attitude = {{ 1 }} }};\n{lines}"
        'x.V[4] = 0.0 / 0.0;\nprintf("%g\\n", blocked_speed(&x));\nreturn 0;\n}\n'
    )
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", "-O1"]
    subprocess.run(["gcc", *flags, "main.c", "pendulum.c", "-o", "main"], cwd=tmp_path, check=True)
    found = subprocess.run(["./main"], cwd=tmp_path, check=True, capture_output=True, text=True).stdout.split()
    assert [float(each) for each in found] == pytest.approx([0.0, 0.0, 0.25, 0.5, -1.0], abs=1e-15)
