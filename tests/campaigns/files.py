"""Campaign files for tests."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mahovik.out.campaign.file import Campaign, load_campaign

VARY = """
[vary]
"w*.unbalance.static" = { normal = ["1 g mm", "0.5 g mm"] }
"w*.unbalance.static_at" = { uniform = ["0 deg", "360 deg"] }
"carrier.mass" = { normal = [10, 1] }
"""

RUN = """
[over]
regime = { default = { speed = "1000 rpm" } }
until = "5 ms"
dt = "1 ms"
[[quantity]]
name = "shake"
what = "rms velocity"
at = "carrier"
"""


def write(folder: Path, body: str, **head: Any) -> Path:
    """Write a campaign file: keys of the head, by default 40 samples of demo3, then `body`."""
    keys = {"schema": 1, "stand": "demo3", "samples": 40, "seed": 7} | head
    lines = [f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value}" for key, value in keys.items()]
    path = folder / "C.toml"
    path.write_text("\n".join(lines) + "\n" + body, encoding="utf-8")
    return path


def read(folder: Path, body: str, **head: Any) -> Campaign:
    """The campaign of such a file."""
    return load_campaign(write(folder, body, **head))
