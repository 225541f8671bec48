"""A campaign file and a table of measured parts."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given

from fuzz.mangle import spoiled_bytes, spoiled_toml
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.out.campaign.file import load_campaign

pytestmark = READERS

CAMPAIGNS = [
    """schema = 1
name = "tolerances"
stand = "demo3"
samples = 100
seed = 3
design = "latin"
shard = 10
until = "2 %"
[quantile]
of = "shake"
at = "95 %"
[vary]
"w*.unbalance.static" = { normal = ["1 g mm", "0.3 g mm"], most = "2 g mm" }
"w1.mass" = { table = "w.csv" }
"carrier.inertia.J12" = { triangular = [-1e-4, 0, 1e-4] }
"w2.position" = { tolerance = ["-1 mm", "2 mm"], group = "jig" }
[[correlation]]
of = ["w*.unbalance.static"]
coefficient = 0.3
[over]
regime = { default = { speed = "1000 rpm" } }
until = "5 ms"
[[quantity]]
name = "shake"
what = "rms velocity"
at = "carrier"
band = ["1 Hz", "20 Hz"]
""",
    """schema = 1
stand = "demo3"
samples = 100
design = "saltelli"
[vary]
"w*.unbalance" = { grade = "G 2.5", speed = "3000 rpm", share = { uniform = [0, 1] } }
"carrier.mass" = { lognormal = ["10 kg", 0.1] }
"w3.mass" = { discrete = ["1 kg", "2 kg"], weights = [1, 3] }
"carrier.inertia.J11" = { relative = "2 %" }
[over]
speeds = { w1 = "100 rpm" }
[[quantity]]
name = "peak"
what = "peak acceleration"
at = "carrier"
""",
]
TABLES = [b"mass [kg],serial\n1.0,a1\n1.1,a2\n"]


def read(folder: Path, campaign: bytes, table: bytes) -> None:
    (folder / "w.csv").write_bytes(table)
    (folder / "C.toml").write_bytes(campaign)
    load_campaign(folder / "C.toml")


@pytest.mark.parametrize("text", CAMPAIGNS)
def test_the_examples_are_campaigns(text: str, tmp_path: Path) -> None:
    read(tmp_path, text.encode(), TABLES[0])


@fuzzed(150)
@given(text=spoiled_toml(CAMPAIGNS))
def test_toml(text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    read_or_refuse(lambda: read(folder, text.encode("utf-8", "surrogatepass"), TABLES[0]))


@fuzzed(50)
@given(data=spoiled_bytes(TABLES))
def test_tables(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    read_or_refuse(lambda: read(folder, CAMPAIGNS[0].encode(), data))
