"""The C of a programme is judged by `verify`: right C passes, planted faults fail by their row."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from export import programmes
from export.programmes import exported, motion, written
from mahovik.errors import ToolchainError, UsageError
from mahovik.out.export.programme import export_programme
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.files import Generate
from mahovik.proof.verify.functions.table import verify_compiled
from mahovik.proof.verify.programme.verification import ProgrammeCase
from toolchain.quick import quick
from verify.build import changed


def judged(folder: Path, programme: str = "started", generate: Generate | None = None) -> dict[str, Check]:
    """Checks of the C in a folder by their names."""
    stand, built = programmes.stand(), getattr(programmes, programme)()
    report = verify_compiled(stand, ProgrammeCase.of(stand, motion(), built), folder, generate=generate)
    return {item.quantity: item for item in report}


@pytest.mark.parametrize(
    ("programme", "kind", "real"),
    quick(
        1,
        [
            ("started", "quintic", "double"),
            ("spin", "fourier", "float"),
            ("started", "quintic", "float"),
            ("spin", "fourier", "double"),
            ("spin", "quintic", "float"),
        ],
    ),
)
def test_every_function_of_the_header_is_judged(programme: str, kind: str, real: str, tmp_path: Path) -> None:
    source = written(exported(programme, kind, real), tmp_path, real)
    report = judged(tmp_path, programme)
    assert not any(item.failed for item in report.values())
    header = re.sub(r"/\*.*?\*/", "", source.with_suffix(".h").read_text(), flags=re.DOTALL)
    functions = set(re.findall(r"^shaker2_status shaker2_programme_(\w+)\(", header, re.MULTILINE))
    assert functions - {"at", "runup_at", "rundown_at"} == {"start", "phase", "advance"}  # judged by the clock's row
    rows = {name.removeprefix("C ") for name in report}
    assert functions & {"at", "runup_at", "rundown_at"} <= rows
    assert {"clock", "residual"} <= rows
    assert ("torque" in rows) == (programme == "spin")


FAULTS = [
    pytest.param("started", changed(r"phi_dot\[s\] = ", "phi_dot[s] = -"), {"C at"}, id="speed"),
    pytest.param("spin", changed(r"phi_ddot\[s\] = ", "phi_ddot[s] = 10.0 + "), {"C residual"}, id="acceleration"),
    pytest.param("spin", changed(r"tau\[s\] \+= ", "tau[s] += 1.001 * "), {"C torque"}, id="torque"),
    pytest.param("started", changed(r"\(\(lapped", "((!lapped"), {"C clock"}, id="laps"),
    pytest.param("spin", changed(r"(weight\[2\] = -0\.083333)\d+", r"\1"), {"C torque"}, id="digits"),
    pytest.param("spin", changed(r"phase < 1\.0", "phase <= 1.0"), {"C at bad inputs refused"}, id="end"),
    pytest.param("spin", changed(r"phase < 1\.0", "phase < 0.9999999"), {"C at"}, id="before the end"),
    pytest.param("spin", changed(r"ticks / 2", "ticks"), {"C start bad inputs refused"}, id="periods"),
    pytest.param(
        "spin", changed(r"clock->laps >= 0", "clock->laps >= -5"), {"C advance bad inputs refused"}, id="laps"
    ),
]


@pytest.mark.parametrize(("programme", "change", "failed"), quick(1, FAULTS))
def test_a_planted_fault_fails_by_its_row(
    programme: str, change: Callable[[str], str], failed: set[str], tmp_path: Path
) -> None:
    source = written(exported(programme), tmp_path)
    source.write_text(change(source.read_text()))
    assert failed <= {name for name, item in judged(tmp_path, programme).items() if item.failed}


@pytest.mark.parametrize(("column", "failed"), [("tau", "torque"), ("phi_ddot", "acceleration")])
def test_a_number_of_a_run_up_fails_where_it_is_wrong(column: str, failed: str, tmp_path: Path) -> None:
    source = written(export_programme(programmes.stand(), programmes.started(), motion()), tmp_path)
    assert not any(item.failed for item in judged(tmp_path).values())
    before, table, after = source.read_text().partition("shaker2_programme_runup_table_values =")
    source.write_text(before + table + re.sub(rf"(\.{column} = {{ )[^,]+", r"\g<1>0.01", after, count=1))
    assert f"C runup_at {failed}" in {name for name, item in judged(tmp_path).items() if item.failed}


def test_limits_do_not_come_from_the_folder(tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path)
    before, facts = judged(tmp_path, "spin"), source.with_suffix(".json")
    facts.write_text(re.sub(r'("(?:limit|phi|phi_dot|relative|tau)"): [^,]+', r"\1: 1.0", facts.read_text()))
    after = judged(tmp_path, "spin", lambda real, kind, torques: exported("spin", kind, real).files)
    assert {name: item.limit for name, item in after.items()} == {name: item.limit for name, item in before.items()}
    assert "edited by hand after mahovik 0.1.0 wrote it: shaker2_programme.json" in after["text = as generated"].words


def test_c_that_is_not_there_or_of_another_stand_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"shaker2_programme\.h: not there; .* `mahovik generate --programme"):
        judged(tmp_path)
    source = written(exported("spin"), tmp_path)
    facts = source.with_suffix(".json")
    right = facts.read_text()
    facts.write_text(re.sub(r'"physics": "[0-9a-f]+"', '"physics": "00000001"', right))
    with pytest.raises(UsageError, match="its physics is 00000001, expected"):
        judged(tmp_path, "spin")
    facts.write_text(right.replace('"double"', '"real"'))
    with pytest.raises(UsageError, match="not as `mahovik generate --programme` writes it"):
        judged(tmp_path, "spin")
    facts.write_text(right)
    source.write_text("#error no\n")
    with pytest.raises(ToolchainError):
        judged(tmp_path, "spin")
