"""Golden vectors take seconds: the files of one stand are made once."""

from __future__ import annotations

from functools import cache

import pytest

from mahovik.core.emit.delivery import firmware
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.out.export import target as project
from mahovik.proof.verify import targets
from mahovik.stands import path


@cache
def _delivered(name: str, real: str, only: tuple[str, ...]) -> dict[str, str]:
    return firmware(load(path(name)), real, only)


@pytest.fixture(autouse=True)
def delivered_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """For example stands only: the name says which it is."""

    def once(stand: Stand, real: str, only: tuple[str, ...] = ()) -> dict[str, str]:
        return dict(_delivered(stand.name, real, only))

    monkeypatch.setattr(targets, "firmware", once)
    monkeypatch.setattr(project, "firmware", once)
