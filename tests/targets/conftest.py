"""Golden vectors take seconds: the files of one stand are made once."""

from __future__ import annotations

import pytest

from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import Generated
from mahovik.core.stand.model import Stand
from mahovik.out.export import project
from mahovik.proof.verify import selftest

KNOWN: dict[str, dict[str, str]] = {}


@pytest.fixture(autouse=True)
def delivered_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """For stands whose source says which they are."""

    def once(stand: Stand, generated: Generated) -> dict[str, str]:
        source = generated.files[f"{stand.name}.c"]
        if source not in KNOWN:
            KNOWN[source] = selftest_files(stand, generated)
        return dict(KNOWN[source])

    monkeypatch.setattr(selftest, "selftest_files", once)
    monkeypatch.setattr(project, "selftest_files", once)
