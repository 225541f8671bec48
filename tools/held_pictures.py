"""Run the commands of the pages on held carriers, and write the pictures that they draw into docs/.

python tools/held_pictures.py
"""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

import campaign

sys.path.insert(0, str(campaign.ROOT / "tests"))

PAGES = ("tutorial-pendulum.md", "tutorial-held-examples.md")
"""Pages of docs/ whose pictures their own commands draw."""

EMBEDDED = re.compile(r"!\[[^\]]*\]\(([\w-]+\.svg)\)")
"""A picture that a page shows; its name."""


def pictures(page: Path) -> list[str]:
    """Names of the pictures that a page shows."""
    return EMBEDDED.findall(page.read_text(encoding="utf-8"))


def draw(page: Path) -> dict[str, str]:
    """SVG by name of the pictures that the commands of a page draw. Raises AssertionError where a command fails."""
    from docs.execute import Session, steps

    with tempfile.TemporaryDirectory() as scratch:
        session = Session(page, Path(scratch))
        for step in steps(page):
            session.run(step)
        return {name: (Path(scratch) / name).read_text(encoding="utf-8") for name in pictures(page)}


def main() -> None:
    """Write the pictures of all pages."""
    campaign.parser(__doc__).parse_args()
    for name in PAGES:
        for picture, text in draw(campaign.ROOT / "docs" / name).items():
            (campaign.ROOT / "docs" / picture).write_text(text, encoding="utf-8")
            print(f"docs/{picture}")


if __name__ == "__main__":
    main()
