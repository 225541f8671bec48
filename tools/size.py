"""How large the house is: lines of Python, of templates, words of the pages, targets of `make`, beside their limits.

python tools/size.py

Exit status 1 where a limit is passed. Python counts as ruff formats it. Not counted: results, `generated/`, the page of
commands and the tables that are made of the code, the headers of the FMI standard and the plot library of the report.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

PARTS = {
    "contract and core": ("contract", "core"),
    "laws": ("laws",),
    "proof": ("proof",),
    "use, campaign, identify": ("use", "out/campaign", "out/identify"),
}
"""Folders of the package whose size is shown by itself."""

OUT = "generator/mahovik/out"
STUDIES = ("campaign", "identify", "foreign")
"""Folders of OUT that do not count as commands, API and report."""

LIMITS = {
    "package": 87_500,
    "laws": 4_500,
    "commands, API, report": 8_500,
    "templates": 7_150,
    "tests": 43_500,
    "tools and bench": 5_000,
    "words of the pages": 35_000,
    "targets of make": 16,
}


def files(*patterns: str) -> list[Path]:
    """Files of the repository by patterns of git."""
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return [path for line in listed.stdout.splitlines() if (path := ROOT / line).is_file()]


def lines(*patterns: str) -> int:
    """Lines of these files."""
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files(*patterns))


def words() -> int:
    """Words of README and pages, without kept results and what tools/pages.py makes of the code."""
    made = ("docs/commands.md", "docs/results")
    pages = [p for p in files("README.md", "docs/*.md") if not str(p.relative_to(ROOT)).startswith(made)]
    texts = (path.read_text(encoding="utf-8") for path in pages)
    return sum(
        len(re.sub(r"(?s)<!-- [\w ]+: tools/pages\.py -->.*?<!-- end of [\w ]+ -->", "", text).split())
        for text in texts
    )


def sizes() -> dict[str, int]:
    """Each size by its name in LIMITS."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    phony = re.search(r"^\.PHONY: (.*)$", makefile, re.M)
    return {
        "package": lines("generator/mahovik/*.py", "generator/mahovik/*.pyi"),
        "laws": lines("generator/mahovik/laws/*.py"),
        "commands, API, report": lines(f"{OUT}/*.py", *(f":!{OUT}/{name}" for name in STUDIES)),
        "templates": lines("templates", ":!templates/fmu/fmi?Fun*.h", ":!templates/fmu/fmi?*Types*.h"),
        "tests": lines("tests/*.py"),
        "tools and bench": lines("tools/*.py", "bench/*.py"),
        "words of the pages": words(),
        "targets of make": len(phony[1].split()) if phony else 0,
    }


def parts() -> dict[str, int]:
    """Lines of each of PARTS, and of the rest of the package."""
    measured = {name: lines(*(f"generator/mahovik/{folder}/*.py" for folder in of)) for name, of in PARTS.items()}
    return measured | {"the rest": lines("generator/mahovik/*.py") - sum(measured.values())}


def main() -> int:
    """Prints the table. Returns the exit status."""
    measured = sizes()
    for name, size in measured.items():
        over = "  over the limit" if size > LIMITS[name] else ""
        print(f"{name:25} {size:8,} of at most {LIMITS[name]:8,}{over}")
        if name == "package":
            print("\n".join(f"  {part:23} {count:8,}" for part, count in parts().items()))
    return 1 if any(size > LIMITS[name] for name, size in measured.items()) else 0


if __name__ == "__main__":
    sys.exit(main())
