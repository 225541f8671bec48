"""Data of a stand, computed once."""

from __future__ import annotations

from pathlib import Path

import pytest

from balance.bench import write_bench


@pytest.fixture(scope="session")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two.toml and run.csv."""
    folder = tmp_path_factory.mktemp("bench")
    write_bench(folder)
    return folder
