"""A stand file may hold anything: it is taken, or refused in words."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cli.run import run
from fuzz.mangle import spoiled_bytes, spoiled_toml
from fuzz.reading import READERS, check_message, fuzzed, read_or_refuse, soon
from mahovik.core.stand.read import load, loads
from mahovik.stands import names, path

pytestmark = READERS

EXAMPLES = [Path(path(name)).read_text(encoding="utf-8") for name in names()]


@fuzzed(250)
@given(text=spoiled_toml(EXAMPLES))
def test_values_that_nobody_would_write(text: str) -> None:
    read_or_refuse(lambda: loads(text))


@fuzzed(60)
@given(data=spoiled_bytes([text.encode() for text in EXAMPLES]))
def test_bytes(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "stand.toml"
    file.write_bytes(data)
    read_or_refuse(lambda: load(file))


@fuzzed(15)
@given(text=spoiled_toml(EXAMPLES), command=st.sampled_from(("check", "derive", "rest")))
def test_the_commands_end_with_a_status(text: str, command: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    file = folder / "stand.toml"
    file.write_text(text, encoding="utf-8", errors="surrogatepass")
    more = ["-o", str(folder / "page.html")] if command == "derive" else []
    with soon(120):
        result = run(command, str(file), *more)
    assert result.exit_code in (0, 1, 2)
    if result.exit_code:
        assert result.stderr.startswith("error: ")
        check_message(result.stderr)
