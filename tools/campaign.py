"""Run a campaign of tools/campaigns, keep its rows in docs/results/NAME.json, render docs/results.md from what is kept.

python tools/campaign.py NAME [--write] [--only TABLE] [options of the campaign]
python tools/campaign.py --render | --check

Exit status 1 where a row is not as promised, or, with --check, where the page is not what the kept rows say.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import sys
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from nightly import git

from campaigns import ROOT, Row

NAMES = (
    "verification", "judges", "audits", "targets", "proofs", "fuzz", "cost", "benchmarks", "generation",
    "vibration", "planning", "identification", "balancing",
)  # fmt: skip
"""Campaigns in the order of the page."""

FOLDER = ROOT / "docs" / "results"
PAGE = ROOT / "docs" / "results.md"

HEAD = """# Results

See how exact, how fast and how small the C is, and what judges say of it. Every figure was measured once, by the
command at the commit, on the day and, where it was kept, the processor that stand behind it. `python tools/campaign.py
NAME --write` measures again and keeps the rows in `docs/results/NAME.json`; commands of older commits have other names.
Differences are relative to the [natural scale](verification.md#the-natural-scale).
"""


@dataclass(frozen=True)
class Result:
    """Rows of a table as they are kept: by which command, at which commit, when and on which processor (or "")."""

    command: str
    commit: str
    date: str
    processor: str
    rows: list[dict[str, Any]]

    @property
    def provenance(self) -> str:
        """All but the rows, in words."""
        return ", ".join(filter(None, (f"`{self.command}`", f"commit {self.commit}", self.date, self.processor)))


def load(name: str) -> ModuleType:
    """The module of a campaign."""
    return import_module(f"campaigns.{name}")


def results(name: str) -> dict[str, Result]:
    """Kept results of a campaign by table."""
    path = FOLDER / f"{name}.json"
    kept = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return {table: Result(**fields) for table, fields in kept.items()}


def keep(name: str, table: str, rows: Iterable[Row], command: str) -> None:
    """Keep rows that were measured just now, and render the page."""
    commit = git("rev-parse", "--short=8", "HEAD")
    day = datetime.now(UTC).date().isoformat()
    write(name, results(name) | {table: Result(command, commit, day, processor(), [*map(plain, rows)])})
    try:
        PAGE.write_text(page(), encoding="utf-8", newline="\n")
    except ModuleNotFoundError as error:  # the environment of the benchmark has no judges
        print(f"docs/results.md: not written, no {error.name} here: run `python tools/campaign.py --render` elsewhere")


def write(name: str, kept: dict[str, Result]) -> None:
    """The file of a campaign: a row on a line."""
    texts = []
    for table, result in kept.items():
        fields = asdict(result)
        rows = ",\n".join(f"    {json.dumps(row, ensure_ascii=False)}" for row in fields.pop("rows"))
        head = "".join(
            f"\n  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}," for key, value in fields.items()
        )
        texts.append(f'{json.dumps(table)}: {{{head}\n  "rows": [\n{rows}\n  ]\n}}')
    (FOLDER / f"{name}.json").write_text("{\n" + ",\n".join(texts) + "\n}\n", encoding="utf-8", newline="\n")


def plain(value: Any) -> Any:
    """The value in what JSON has: no tuples, no types of NumPy; None for numbers that are not finite."""
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [plain(part) for part in value]
    number = value.item() if hasattr(value, "item") else value
    return None if isinstance(number, float) and not math.isfinite(number) else number


def processor() -> str:
    """Name of the processor as Linux has it; else the machine's kind."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.is_file() else []
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())


def page() -> str:
    """docs/results.md: what was found, how it was measured, and a table, campaign by campaign."""
    text = HEAD
    for name in NAMES:
        kept, module = results(name), load(name)
        tables = {table: module.TABLES[table] for table in module.TABLES if table in kept}
        if tables:
            text += f"\n## {name.capitalize()}\n"
        for table, shown in tables.items():
            rows, measured = kept[table].rows, kept[table].provenance
            text += f"\n**{shown.claim(rows)}** ({measured}). {shown.note}".rstrip() + f"\n\n{shown.text(rows)}"
    return text


def parse() -> argparse.Namespace:
    """The command line; options of a campaign are those that its module has."""
    about, _, usage = (__doc__ or "").partition("\n")
    parser = argparse.ArgumentParser(
        description=about, epilog=usage, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("name", nargs="?", choices=NAMES, metavar="NAME", help=", ".join(NAMES))
    parser.add_argument("--write", action="store_true", help="keep the rows, and render the page")
    parser.add_argument("--render", action="store_true", help="render the page from what is kept")
    parser.add_argument("--check", action="store_true", help="exit status 1 where the page is not what is kept")
    if len(sys.argv) > 1 and sys.argv[1] in NAMES:
        module = load(sys.argv[1])
        parser.add_argument("--only", choices=module.TABLES, help="one table of the campaign")
        for option, default in module.OPTIONS.items():
            kind: dict[str, Any] = {"action": "store_true"} if default is False else {"type": type(default)}
            parser.add_argument(f"--{option.replace('_', '-')}", default=default, help=f"default: {default}", **kind)
    options = parser.parse_args()
    if not (options.name or options.render or options.check):
        parser.error("expected the name of a campaign, --render or --check")
    return options


def run(options: argparse.Namespace) -> bool:
    """Measure and print the tables; keep them where asked to. Whether all rows are as promised."""
    good = True
    for name, table in load(options.name).TABLES.items():
        if options.only in (None, name):
            rows = []
            for row in table.rows(table.measure(options)):
                rows.append(plain(row))
                promised = table.good(row)
                good &= promised
                print(name, *row.values(), *([] if promised else ["NOT AS PROMISED"]), sep="  ", flush=True)
            if options.write:
                keep(options.name, name, rows, " ".join(["python", "tools/campaign.py", *sys.argv[1:]]))
    return good


def main() -> int:
    """Exit status."""
    options = parse()
    if options.check:
        return int(PAGE.read_text(encoding="utf-8") != page())
    if options.render:
        PAGE.write_text(page(), encoding="utf-8", newline="\n")
        return 0
    return int(not run(options))


if __name__ == "__main__":
    sys.exit(main())
