"""`mahovik export fmu`: what it writes where, and what it refuses."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import fmpy
import pytest

from cli.run import DEMO3, refused, run
from mahovik import stands

DRY = ("export", "fmu", DEMO3, "--no-binary")


def test_file_and_what_is_said(tmp_path: Path) -> None:
    (tmp_path / "S.json").write_text(json.dumps({"position": [0, 0, 0.5], "phi_dot": [10, 20, -30]}))
    target = tmp_path / "new" / "demo.fmu"
    start = str(tmp_path / "S.json")
    result = run(*DRY, "--version", "3.0", "--kind", "cs", "-o", str(target), "--start", start, "--dt", "0.002")
    assert result.exit_code == 0, result.output
    lines = result.stdout.splitlines()
    assert lines[0] == str(target)
    assert lines[1].startswith("FMI 3.0, co-simulation; {")
    assert lines[2] == "no binary, only sources"
    with zipfile.ZipFile(target) as file:
        assert file.testzip() is None
        names = file.namelist()
    assert names[0] == "modelDescription.xml"
    assert {"sources/demo3.c", "sources/demo3_model.c", "sources/buildDescription.xml"} <= set(names)
    read = fmpy.read_model_description(str(target))
    starts = {v.name: v.start for v in read.modelVariables}
    wheels = [v for v in starts if v.endswith(".phi_dot")]
    assert [float(starts[w]) for w in wheels] == [10.0, 20.0, -30.0]
    assert (float(starts["carrier.position[3]"]), float(starts["dt"])) == (0.5, 0.002)
    assert read.instantiationToken in lines[1]


@pytest.mark.parametrize(
    ("arguments", "status", "expected"),
    [
        ((*DRY, "-o", "demo.zip"), 2, "-o demo.zip: expected a name that ends in .fmu"),
        ((*DRY, "--dt", "0"), 2, "--dt 0: expected 1e-09 to 10 s"),
        ((*DRY, "--dt", "20 s"), 2, "--dt 20: expected 1e-09 to 10 s"),
        ((*DRY, "--kind", "me", "--dt", "0.001"), 2, "--dt: model exchange has no internal step"),
        ((*DRY, "--start", "none.json"), 2, "none.json: cannot be read"),
        ((*DRY, "--version", "1.0"), 2, "1.0"),
        (("export", "fmu", "none.toml"), 2, "none.toml"),
        (("export", "fmu", str(stands.path("remus6")), "--no-binary"), 1, "give an initial state by --start"),
    ],
)
def test_refusals(
    arguments: tuple[str, ...], status: int, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in refused(*arguments, status=status)
    assert list(tmp_path.iterdir()) == []
