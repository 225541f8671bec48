"""A sample of the kept figures of docs/results is measured again; each must be inside its spread."""

from __future__ import annotations

import os
import subprocess
from random import Random

import pytest
from kept import Campaign
from results import campaigns

from docs.pages import ROOT

SEED = os.environ.get("MAHOVIK_SAMPLE_SEED", "18")
"""Another seed samples other figures: `.ci/run` takes the commit's hash, so that every landing measures others."""


def test_ci_takes_the_seed_from_the_commit() -> None:
    """The lines of `.ci/run` that set it, run by themselves; the variable is exported to `make test-slow` below."""
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8").split("make test-slow")[0]
    lines = [line for line in script.splitlines() if line.startswith(("MAHOVIK_SAMPLE_SEED=", "export MAHOVIK"))]
    shown = "\n".join((*lines, "env"))
    found = subprocess.run(["bash", "-ec", shown], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert f"MAHOVIK_SAMPLE_SEED={head}" in found


@pytest.mark.slow
@pytest.mark.parametrize("each", [each for each in campaigns() if each.sample], ids=lambda each: each.name)
def test_a_sample_is_measured_again(each: Campaign) -> None:
    assert each.sample is not None
    found = list(each.sample(each.figures(), Random(f"{SEED} {each.name}")))
    assert found
    assert [measured for measured in found if not measured.good] == [], f"seed {SEED}"
