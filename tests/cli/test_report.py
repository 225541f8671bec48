"""mahovik report: one page that stands alone; foreign files refused; what fails is said to fail."""

from __future__ import annotations

import json
import re
import shutil
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik import __version__
from mahovik.core.stand import identities, load
from mahovik.out.report.stand import page, verification
from mahovik.out.report.stand.material import gather
from mahovik.proof.verify import bounds
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.stands import path
from report.stand.reports import read, words

SHAKER2 = str(path("shaker2"))
TURN = str(Path(DEMO3).with_name("demo3.motion.json"))
GENERATED = Path(__file__).resolve().parents[2] / "generated"
SPIN = "schema = 1\ndefault = { speed = 20 }\n"


def report_page(*options: str, stand: str = DEMO3) -> str:
    """The page."""
    result = run("report", stand, "-o", "r.html", *options)
    assert (result.exit_code, result.stdout) == (0, "r.html\n"), result.output
    return Path("r.html").read_text(encoding="utf-8")


def only(monkeypatch: pytest.MonkeyPatch, *names: str) -> None:
    """These sections alone: what a test is not about takes time."""
    monkeypatch.setattr(page, "ORDER", names)
    monkeypatch.setattr(page, "BESIDE", tuple(name for name in page.BESIDE if name in names))
    monkeypatch.setattr(verification, "STATES", 4)


def simulated(name: str, stand: str = DEMO3) -> str:
    Path("spin.toml").write_text(SPIN, encoding="utf-8")
    options = ("--until", "0.02", "--regime", "spin.toml", "--backend", "scipy")  # the C would be compiled first
    assert run("simulate", stand, *options, "-o", name).exit_code == 0
    return name


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The report of demo3, all of it."""
    folder = tmp_path_factory.mktemp("report")
    result = run("report", DEMO3, "-o", str(folder / "r.html"))
    assert result.exit_code == 0, result.output
    assert [each.name for each in folder.iterdir()] == ["r.html"]
    yield (folder / "r.html").read_text(encoding="utf-8")


def test_the_page_is_well_formed_and_says_what_it_is_of(whole: str) -> None:
    seen = read(whole)
    assert seen.wrong == []
    assert {"bodies", "matrices", "verification", "cost"} <= set(seen.sections)
    linked = {value.removeprefix("#") for _, name, value in seen.attributes if name == "href"}
    ids = {value for _, name, value in seen.attributes if name == "id"}
    assert set(seen.sections) <= linked <= ids
    names = identities(load(DEMO3))
    text = words(whole)
    for part in ("demo3.toml", names.structure, names.physics, f"mahovik {__version__}", "3 flywheels"):
        assert part in text
    assert "FAIL" not in text
    assert "three derivations agree at" in text


def test_the_page_needs_nobody_else(whole: str) -> None:
    """No address, no path of this machine, no date; small."""
    addresses = whole.replace('xmlns="http://www.w3.org/2000/svg"', "")  # a name, which nobody asks for
    assert not re.search(r"(https?:|file:|//[a-z])", addresses)
    assert "@import" not in whole
    assert not re.search(r"url\((?!#|data:)", whole)
    for tag, name, value in read(whole).attributes:
        if name in ("src", "href"):
            assert value.startswith(("#", "data:")), (tag, value)
    assert str(Path.cwd().anchor + "tmp") not in whole
    assert str(Path(DEMO3).parent) not in whole
    assert not re.search(r"\b20\d\d-\d\d-\d\d\b", whole)
    assert len(whole.encode("utf-8")) < 3_000_000


def test_what_was_not_run_is_said_with_its_command(whole: str) -> None:
    text = words(whole)
    assert "Not run here" in text
    assert "mahovik verify demo3.toml --targets quick" in text
    assert "mahovik cost demo3.toml" in text


@pytest.mark.slow
def test_the_same_inputs_give_the_same_bytes(whole: str) -> None:
    assert report_page() == whole


def test_the_head_says_what_outside_judges_do_not_know(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "verification")
    assert run("report", str(path("auv6")), "-o", "r.html").exit_code == 0
    head = words(Path("r.html").read_text(encoding="utf-8")).partition("Not run here")[0]
    judges, _, left = head.partition("they know the stand without ")
    assert "Pinocchio agrees; MuJoCo agrees" in judges
    assert left.startswith("added mass (carrier), buoyancy (carrier, sonar), damping (carrier), stream")


def test_a_comparison_that_fails_is_shown_as_failing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is as near as 1e-30: the page is written, red at its top, and the status is 1."""
    only(monkeypatch, "verification")
    monkeypatch.setitem(bounds.BOUNDS, "double", replace(DOUBLE, default=1e-30))
    result = run("report", DEMO3, "-o", "r.html")
    assert result.exit_code == 1
    assert "error: three derivations: " in result.stderr
    found = Path("r.html").read_text(encoding="utf-8")
    assert read(found).wrong == []
    head = words(found[: found.index("<main>")])
    assert "FAIL three derivations: " in head
    assert "three derivations disagree" in head
    assert '<span class="verdict bad">FAILED' in found
    assert '<div class="failure" role="alert">' in found


def test_without_a_compiler_nothing_is_shown_as_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "verification")
    monkeypatch.setenv("CC", "no-such-cc")
    text = words(report_page())
    assert "The compiled C: CC=no-such-cc: no such command" in text
    assert "The program, interpreted, the literal equations" in text
    assert "The generated C, the literal" not in text


def test_judges_that_are_not_installed_are_not_run(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "verification")
    for name in ("pinocchio", "mujoco"):
        monkeypatch.setitem(__import__("sys").modules, name, None)
        monkeypatch.delitem(__import__("sys").modules, f"mahovik.proof.verify.judges.{name}_judge", raising=False)
    text = words(report_page())
    assert "Judges from outside" not in text
    assert "Pinocchio: pinocchio is not installed (pinocchio): pip install pin mujoco" in text
    assert "Pinocchio agrees" not in text


def test_names_are_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files may have any name."""
    only(monkeypatch, "bodies")
    odd = "<b onload='x'>&amp;.toml"
    shutil.copy(DEMO3, odd)
    run_file = simulated("<i>.csv")
    found = report_page("--run", run_file, stand=odd)
    assert "<b onload" not in found
    assert "<i>" not in found
    assert {odd, "<i>.csv"} <= set(words(found).replace(",", "").split()) | {odd}
    assert odd in words(found)


def test_a_run_is_taken_for_the_state(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "matrices")
    for name in ("run.csv", "run.parquet"):
        text = words(report_page("--run", simulated(name)))
        assert f"run {name}" in text
        assert "The last row of the run, t = 0.02 s." in text
        assert " 0.4 20 0 " in text  # phase, speed, acceleration


def test_a_run_of_another_stand_is_refused() -> None:
    """The run's identities show it; without identities, its columns and the equations do."""
    heavier = Path(SHAKER2).read_text(encoding="utf-8").replace("mass = 0.5", "mass = 0.5005", 1)
    Path("heavier.toml").write_text(heavier, encoding="utf-8")
    names = identities(load("heavier.toml")), identities(load(SHAKER2))
    for name in ("a.csv", "a.parquet"):
        simulated(name, "heavier.toml")
    said = refused("report", SHAKER2, "--run", "a.parquet", "-o", "r.html")
    assert said == (
        f"error: --run a.parquet: run of another stand: physics is {names[0].physics}, "
        f"of the stand {names[1].physics}\n"
    )
    said = refused("report", SHAKER2, "--run", "a.csv", "-o", "r.html")
    assert re.fullmatch(
        r"error: --run a\.csv: run of another stand: (a drive torque|the acceleration of its carrier) at t = \S+ s is "
        r"not that of the stand, \S+ of its natural scale apart\n",
        said,
    )
    said = refused("report", DEMO3, "--run", "a.csv", "-o", "r.html")
    assert said == (
        "error: --run a.csv: run of another stand: its flywheels are left, right, of the stand w1, w2, w3\n"
    )
    assert not Path("r.html").exists()


def test_a_run_of_the_same_numbers_is_taken_whatever_wrote_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The C as well as the adaptive reference, and a stand with a suspension."""
    only(monkeypatch, "bodies")
    Path("spin.toml").write_text(SPIN, encoding="utf-8")
    for backend in ("c", "scipy"):
        options = ("--until", "0.01", "--regime", "spin.toml", "--backend", backend, "-o", "run.csv")
        assert run("simulate", SHAKER2, *options).exit_code == 0
        report_page("--run", "run.csv", stand=SHAKER2)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a,b\n1,2\n", 'no run of `mahovik simulate`: expected a column "t [s]" and rows'),
        ("t [s]\n0\n", "run of another stand: its flywheels are none"),
        ("t [s]\nzero\n", "no run of `mahovik simulate`"),
        ("", "no run of `mahovik simulate`"),
    ],
)
def test_what_is_no_run_is_refused(text: str, said: str) -> None:
    Path("x.csv").write_text(text, encoding="utf-8")
    found = refused("report", DEMO3, "--run", "x.csv", "-o", "r.html")
    assert found.startswith("error: ")
    assert said in found
    assert found.count("\n") == 1


def test_a_run_with_numbers_that_are_none_is_refused() -> None:
    lines = Path(simulated("a.csv")).read_text(encoding="utf-8").splitlines()
    cells = lines[3].split(",")
    cells[15] = "nan"
    Path("a.csv").write_text("\n".join([*lines[:3], ",".join(cells), *lines[4:]]) + "\n", encoding="utf-8")
    said = refused("report", DEMO3, "--run", "a.csv", "-o", "r.html")
    assert said == 'error: --run a.csv: column "v_dot_y [m/s2]", row 3 of 21: nan is not finite\n'


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ({0: "0.001"}, 'column "t [s]", row 3 of 21: 0.001 after 0.001; expected times that increase'),
        ({4: "0.0"}, "columns qw, qx, qy, qz, row 3 of 21: of length 0; expected a unit quaternion"),
    ],
)
def test_a_run_out_of_order_or_without_attitude_is_refused(cells: dict[int, str], said: str) -> None:
    lines = Path(simulated("a.csv")).read_text(encoding="utf-8").splitlines()
    row = [cells.get(i, cell) for i, cell in enumerate(lines[3].split(","))]
    Path("a.csv").write_text("\n".join([*lines[:3], ",".join(row), *lines[4:]]) + "\n", encoding="utf-8")
    assert refused("report", DEMO3, "--run", "a.csv", "-o", "r.html") == f"error: --run a.csv: {said}\n"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("-o", "r.pdf"), "-o r.pdf: expected a name that ends in .html"),
        (("-o", "."), "-o .: expected a name that ends in .html"),
        (("-o", "/proc/r.html"), "/proc/r.html: cannot be written"),
        (("-o", "r.html", "--run", "none.csv"), "none.csv: cannot be read: No such file or directory"),
        (("-o", "r.html", "--run", "none.parquet"), "none.parquet: cannot be read: No such file or directory"),
        (("-o", "r.html", "--run", "run.txt"), "--run run.txt: expected a name that ends in .csv or .parquet"),
        (("-o", "r.html", "--programme", "none.json"), "none.json: no such file"),
        (("-o", "r.html", "--motion", TURN), f"--motion {TURN}: goes with --programme P.json, which is missing"),
        (("-o", "r.html", "--cost", "nowhere"), "--cost nowhere: no such folder"),
        (("-o", "r.html", "--cost", "."), "--cost .: has no cost.json: `mahovik cost` measures and writes it"),
        (("-o", "r.html", "--cost", str(GENERATED / "sat4")), "no figures of `mahovik cost` for demo3"),
        (("-o", "r.html", "--targets", "m8"), '--targets: unknown "m8", did you mean'),
        ((), "Missing option '-o'"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(options: tuple[str, ...], said: str) -> None:
    found = refused("report", DEMO3, *options)
    assert said in found
    assert found.startswith("error: ")
    assert found.count("\n") == 1
    assert list(Path().iterdir()) == []


@pytest.mark.slow
def test_a_programme_of_another_stand_or_motion_is_refused() -> None:
    planned = run("plan", DEMO3, "--motion", TURN, "-o", "p.json", "--winding", "rock", "--seed", "5")
    assert planned.exit_code == 0
    other = refused("report", BENCH8, "--programme", "p.json", "-o", "r.html")
    assert "error: --programme p.json: programme of another stand: name is demo3, of the stand bench8" in other
    motion = json.loads(Path(TURN).read_text(encoding="utf-8")) | {"name": "other"}
    Path("m.json").write_text(json.dumps(motion), encoding="utf-8")
    found = refused("report", DEMO3, "--programme", "p.json", "--motion", "m.json", "-o", "r.html")
    assert "error: --programme p.json: programme of another motion: name is" in found
    assert not Path("r.html").exists()


def test_figures_of_other_numbers_are_refused() -> None:
    heavier = Path(BENCH8).read_text(encoding="utf-8").replace("mass = 12.0", "mass = 12.5", 1)
    Path("bench8.toml").write_text(heavier, encoding="utf-8")
    said = refused("report", "bench8.toml", "--cost", str(GENERATED / "bench8"), "-o", "r.html")
    assert "figures of another stand: physics is" in said


def test_measured_cost_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every target in cost.json is shown, number by number."""
    only(monkeypatch, "cost")
    figures = json.loads((GENERATED / "bench8" / "cost.json").read_text(encoding="utf-8"))
    text = words(report_page("--cost", str(GENERATED / "bench8"), stand=BENCH8)).replace("\u202f", "")
    for target in figures["targets"]:
        assert f"{target['target']}, {target['real']} function" in text
        for f in target["functions"]:
            count = str(f["instructions"]) if f["instructions"] else "refused"
            assert f"{f['function']} {count} {f['stack']} {f['code']}" in text
    assert "Not measured here" not in text
    assert "from cost.json, by mahovik cost" in text


def test_an_interrupt_leaves_what_was_there(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    Path("r.html").write_text("before", encoding="utf-8")
    monkeypatch.setattr(page, "page", interrupted)
    result = run("report", DEMO3, "-o", "r.html")
    assert result.exit_code == 130
    assert result.stderr == "error: interrupted; no file is half written\n"
    assert [each.name for each in Path().iterdir()] == ["r.html"]
    assert Path("r.html").read_text(encoding="utf-8") == "before"


def test_parquet_carries_the_identity_of_its_stand() -> None:
    from mahovik.out.report.plot.run import identity
    from mahovik.out.report.plot.run import read as columns

    names = identities(load(DEMO3))
    simulated("a.parquet"), simulated("a.csv")
    assert identity(Path("a.parquet")) == {
        "stand": "demo3",
        "structure": names.structure,
        "physics": names.physics,
    }
    assert identity(Path("a.csv")) is None
    same = zip(columns(Path("a.csv")).values(), columns(Path("a.parquet")).values(), strict=True)
    assert all(np.array_equal(one, other) for one, other in same)


def test_sections_that_are_made_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "bodies", "drawing", "reach")
    heard: list[int] = []
    page.page(gather(load(DEMO3), DEMO3), heard.append)
    assert heard == [1, 2, 3]


def test_a_missing_matplotlib_is_one_line_before_anything_is_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "page", lambda *given: pytest.fail("computed"))
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    said = refused("report", DEMO3, "-o", "r.html")
    assert 'report needs matplotlib: pip install "mahovik[report]"' in said
    assert len(said.splitlines()) == 1
    assert not Path("r.html").exists()


def test_a_held_carrier_has_a_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """A force table: the hold, its reaction over speeds, three derivations that agree; no jitter, no modes."""
    only(monkeypatch, "hold", "response", "jitter", "campbell", "singular", "matrices", "verification")
    stand = Path(__file__).resolve().parents[2] / "docs" / "held" / "force_table.toml"
    seen = read(report_page(stand=str(stand)))
    assert seen.wrong == []
    assert set(seen.sections) == {"hold", "response", "matrices", "verification"}
    assert "three derivations agree at" in seen.text
    assert "force of hold.reaction at most 7.11 N RMS at 3000 rpm" in seen.text
