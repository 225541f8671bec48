"""verify --against: batch C beside what it judges must be what this version generates."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from emit.stands import generated, stand, write
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate_all
from mahovik.proof.verify.harness import BATCH, check_batch
from toolchain.quick import quick


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """C of demo3 with its batches, not to be changed."""
    folder = tmp_path_factory.mktemp("made")
    write({**generated("demo3").files, **batch_files(stand("demo3"), generated("demo3"))}, folder)
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copytree(made, tmp_path / "out"))


def verdict_and_reason(folder: Path, made: object = None) -> str:
    """Verdict and reason; the C is of double unless it is given."""
    row = check_batch(stand("demo3"), made or generated("demo3"), folder)  # type: ignore[arg-type]
    return "none" if row is None else f"{row.verdict} {row.reason}".strip()


def test_no_batch_no_row_and_a_right_one_passes(folder: Path, tmp_path: Path) -> None:
    assert verdict_and_reason(folder) == "ok"
    assert verdict_and_reason(tmp_path) == "none"


@pytest.mark.slow
@pytest.mark.parametrize("name", quick(1, ["demo3_batch.c", "demo3_batch.h"]))
def test_a_changed_or_missing_file_fails(name: str, folder: Path) -> None:
    text = (folder / name).read_text()
    (folder / name).write_text(text + "\n")
    assert (
        verdict_and_reason(folder)
        == f"FAILED {name} is not what this version generates: generate it again with --batch"
    )
    (folder / name).unlink()
    assert verdict_and_reason(folder) == f"FAILED {name} is missing: generate it again with --batch"


@pytest.mark.slow
def test_batches_of_another_element_type_fail(folder: Path) -> None:
    assert "not what this version generates" in verdict_and_reason(folder, generate_all(stand("demo3"), "float"))


@pytest.mark.slow
def test_verify_fails_by_it(folder: Path) -> None:
    path = folder / "demo3_batch.c"
    path.write_text(path.read_text().replace(" + ", " - ", 1))
    result = run("verify", DEMO3, "--against", str(folder), "--states", "1")
    assert result.exit_code == 1
    assert f"FAILED: {BATCH}\n" in result.stdout
