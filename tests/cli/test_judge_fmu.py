"""judge --fmu: FMUs of right and of wrong stands as programs, and maps of variables that are refused."""

from __future__ import annotations

import json
import tempfile
import time
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from cli.bricks import BRICK
from cli.run import refused, run

STAND = BRICK + "wrench_input = true\n"

MAP = """
[state]
quaternion = "carrier.attitude[{i}]"
V = "carrier.V[{i}]"
[state.wrench]
carrier = "carrier.wrench[{i}]"
[forward]
V_dot = "carrier.V_dot[{i}]"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A stand, its FMU, the FMU of a stand with another inertia, and a map."""
    found = tmp_path_factory.mktemp("fmu")
    (found / "brick.toml").write_text(STAND, encoding="utf-8")
    (found / "heavy.toml").write_text(STAND.replace("inertia = [0.2,", "inertia = [0.25,"), encoding="utf-8")
    (found / "map.toml").write_text(MAP, encoding="utf-8")
    start = found / "start.json"
    start.write_text("{}", encoding="utf-8")
    for stand, version, kind in (("brick", "2.0", "cs"), ("heavy", "3.0", "me")):
        options = ("--version", version, "--kind", kind, "--start", str(start))
        made = run("export", "fmu", str(found / f"{stand}.toml"), *options, "-o", str(found / f"{stand}.fmu"))
        assert made.exit_code == 0, made.output
    return found


def judged(folder: Path, fmu: str, *more: str) -> tuple[str, ...]:
    return ("judge", str(folder / "brick.toml"), "--fmu", str(folder / fmu), *more)


def test_a_right_fmu_agrees(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    result = run(*judged(folder, "brick.fmu", "--map", "map.toml", "--states", "20", "--json"))
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert [(row["want"], row["states"]) for row in found["rows"]] == [("forward", 20)]


@pytest.mark.slow
def test_wrong_terms_of_an_fmu_are_named(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    result = run(*judged(folder, "heavy.fmu", "--map", "map.toml", "--states", "4", "--explain", "--json"))
    assert result.exit_code == 1
    found = json.loads(result.stdout)["diagnosis"]["found"]
    # without moments about the centre of mass p_dot is a multiple of q r: another I_xx is another factor of q r as well
    assert {(row["component"], row["term"]) for row in found} == {("K", "q r"), ("M", "p r"), ("N", "p q")}
    errors = {row["component"]: row["factor"] - row["expected"] for row in found if not row["coefficient"]}
    assert (errors["M"], errors["N"]) == (pytest.approx(-0.05), pytest.approx(0.05))


BAD = {
    "an unknown variable": (("carrier.V[", "carrier.W["), 'no variable "carrier.W[1]"'),
    "a variable that is calculated": (
        ('V = "carrier.V[', 'V = "carrier.V_dot['),
        '"carrier.V_dot[1]" cannot be set',
    ),
    "too few": (('V = "carrier.V[{i}]"', 'V = ["a", "b"]'), "state.V: 2 variables, expected 6"),
    "an unknown want": (("[forward]", "[foward]"), 'did you mean "forward"?'),
    "an unknown key": (("quaternion =", "quaternio ="), 'did you mean "quaternion"?'),
    "no attitude": (('quaternion = "carrier.attitude[{i}]"', ""), "state.quaternion is missing"),
    "no wrench": (('carrier = "carrier.wrench[{i}]"', ""), "state.wrench.carrier is missing"),
    "no answers": (('[forward]\nV_dot = "carrier.V_dot[{i}]"', ""), "no answers"),
    "no name": (('V = "carrier.V[{i}]"', "V = [1, 2, 3, 4, 5, 6]"), "expected the name of a variable"),
    "a factor of zero": (
        ('V = "carrier.V[{i}]"', 'V = [{ variable = "a", factor = 0 }]'),
        "the factor not zero",
    ),
    "no TOML": (("[state]", "[state"), "no TOML"),
}


@pytest.mark.parametrize("name", BAD)
def test_maps_that_are_refused(folder: Path, tmp_path: Path, name: str) -> None:
    (old, new), words = BAD[name]
    assert old in MAP
    (tmp_path / "map.toml").write_text(MAP.replace(old, new), encoding="utf-8")
    assert words in refused(*judged(folder, "brick.fmu", "--map", str(tmp_path / "map.toml")))


def test_files_that_are_refused(folder: Path, tmp_path: Path) -> None:
    given = str(folder / "map.toml")
    assert "no such file" in refused(*judged(folder, "none.fmu", "--map", given))
    assert "no FMU" in refused(*judged(folder, "brick.toml", "--map", given))
    assert "no such file" in refused(*judged(folder, "brick.fmu", "--map", str(tmp_path / "none.toml")))
    assert "--map" in refused(*judged(folder, "brick.fmu"))
    assert "expected one of them" in refused(*judged(folder, "brick.fmu", "--map", given, "--with", "cat"))


def damaged(fmu: Path, made: Path, **more: str) -> Path:
    """The FMU with other files in it: texts by name."""
    with ZipFile(fmu) as whole, ZipFile(made, "w", ZIP_DEFLATED) as archive:
        for each in whole.infolist():
            archive.writestr(each.filename, whole.read(each))
        for name, text in more.items():
            archive.writestr(name, text)
    return made


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({f"resources/{k}": "" for k in range(10_001)}, "files, expected at most 10000"),
        ({f"resources/{k}": "0" * (1 << 20) for k in range(9)}, "bytes, expected at most 8388608"),
        (
            {"modelDescription.xml": "<!--" + " " * (1 << 26)},
            "bytes of modelDescription.xml, expected at most 67108864",
        ),
        ({"../outside": "x"}, 'a file named "../outside", expected names inside of it'),
        ({"resources/../../outside": "x"}, 'a file named "resources/../../outside"'),
        ({"/outside": "x"}, 'a file named "/outside"'),
        ({"C:outside": "x"}, 'a file named "C:outside"'),
    ],
    ids=["files", "bytes", "description", "above", "inside and above", "absolute", "drive"],
)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_an_fmu_that_would_fill_the_disk_is_not_unpacked(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, files: dict[str, str], words: str
) -> None:
    (tmp_path / "room" / "inner").mkdir(parents=True)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "room" / "inner"))
    monkeypatch.setattr("mahovik.proof.verify.fmu.program.MOST_BYTES", 1 << 23)
    damaged(folder / "brick.fmu", tmp_path / "bad.fmu", **files)
    said = refused(*judged(folder, str(tmp_path / "bad.fmu"), "--map", str(folder / "map.toml")))
    assert "bad.fmu: no FMU: " in said and words in said
    assert [each.name for each in (tmp_path / "room").rglob("*")] == ["inner"]


@pytest.mark.parametrize("kill", [False, True])
def test_nothing_of_an_fmu_stays(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kill: bool) -> None:
    """Also where its process is killed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    if kill:
        monkeypatch.setattr("mahovik.proof.verify.foreign._read", lambda *_: time.sleep(3))
    more = ("--map", str(folder / "map.toml"), "--states", "3", "--timeout", "1 s")
    result = run(*judged(folder, "brick.fmu", *(more if kill else more[:-2])))
    assert result.exit_code == (1 if kill else 0), result.output
    assert list(tmp_path.iterdir()) == []
