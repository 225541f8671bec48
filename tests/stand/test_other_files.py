"""Files of other kinds in the place of a stand file: said in one line, what it is and what was expected."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.errors import StandError

FOLDER = stands.path("bench8").parent


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("bench8.motion.json", "is JSON, as motions and programmes are; expected a stand file (TOML)"),
        ("servos/bench8.toml", "is a file of servos; expected a stand file, with [carrier]"),
    ],
)
def test_a_file_of_another_kind_is_named(name: str, words: str) -> None:
    with pytest.raises(StandError) as error:
        load(FOLDER / name)
    assert str(error.value) == f"{Path(name).name}: {words}"


def test_a_regime_is_named(tmp_path: Path) -> None:
    (tmp_path / "r.toml").write_text('schema = 1\n[default]\nspeed = "3000 rpm"\n')
    with pytest.raises(StandError, match=r"r.toml: is a regime; expected a stand file"):
        load(tmp_path / "r.toml")
