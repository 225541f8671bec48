"""What lies in a delivered folder and is read again: manifest, cost page, header."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.mangle import spoiled_bytes, spoiled_json
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.core.emit.delivered import deliver, differences
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.stand import load
from mahovik.stands import path

DEMO3 = load(path("demo3"))


pytestmark = READERS


@cache
def files() -> dict[str, str]:
    return delivery(DEMO3)


MANIFESTS = st.deferred(
    lambda: st.one_of(
        spoiled_json([json.loads(files()[MANIFEST])]).map(lambda text: text.encode("utf-8", "surrogatepass")),
        spoiled_bytes([files()[MANIFEST].encode()]),
    )
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    deliver(tmp_path, DEMO3, files())
    return tmp_path


def visit(folder: Path) -> None:
    """Everything that reads a folder before it writes there."""
    read_or_refuse(lambda: differences(folder, DEMO3, files(), {}))
    read_or_refuse(lambda: deliver(folder, DEMO3, files()))
    for name, text in files().items():
        there = folder / name
        assert name == MANIFEST or not there.is_file() or there.read_text(encoding="utf-8") == text


@fuzzed(80)
@given(data=MANIFESTS)
def test_manifest(data: bytes, folder: Path) -> None:
    (folder / MANIFEST).write_bytes(data)
    visit(folder)
