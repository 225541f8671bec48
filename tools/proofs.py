"""Run the delivered Frama-C scripts of the example stands, and write docs/results/proofs.md.

python tools/proofs.py [--stands demo3,...] [--quick] [--tried] [--jobs 2] [--page]

Outcomes are kept in build/proofs by the SHA-256 of C, drivers and script: a second run repeats only what has changed.
Exit status 1 where anything that is claimed is not proved.
"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.contract.functions import FUNCTIONS
from mahovik.core.emit.eva import Driver, drivers, eva_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand import Stand, load, loads
from mahovik.core.stand.identity import identities
from mahovik.core.toolchain.eva import Proof, prove, version
from mahovik.stands import names, path
from mahovik.writing import write_all

KEPT = campaign.ROOT / "build" / "proofs"
REALS = ("double", "float")
QUICK = {
    "demo3": (
        *("any_forward", "any_torque", "any_wrap", "bits_step", "normal_prepare"),
        *("routine_sincos", "routine_sqrt", "routine_check_state", "routine_check_motion"),
    )
}
"""Proofs that every change must pass: a stand, in both precisions."""
LIMIT = 1800
"""Seconds a driver may take."""

FADING = """
fading_damping = { linear = [3, 9, 9, 0.2, 2, 2], rate = 3 }
"""
"""Damping of the carrier that fades: no example stand has it, nor the exponential that it takes."""

Key = tuple[str, str, Driver]


def write_folder(stand: str, real: str) -> tuple[Path, tuple[Driver, ...]]:
    """Emits C, drivers and script of a stand into a folder of their own; the script, and all drivers."""
    given = given_stand(stand)
    generated = generate_all(given, real)
    files = {**generated.files, **eva_files(generated.program, identities(given))}
    read = "".join(text for _, text in sorted(files.items()))
    digest = hashlib.sha256(read.encode()).hexdigest()[:16]
    folder = KEPT / f"{stand}-{real}-{digest}"
    write_all(folder, files)
    return folder / f"{VERIFICATION}{stand}_eva.sh", drivers(generated.program)


def given_stand(name: str) -> Stand:
    """An example stand, or `fading3`: demo3 with damping that fades."""
    if name != "fading3":
        return load(path(name))
    text = path("demo3").read_text(encoding="utf-8").replace('name = "demo3"', f'name = "{name}"', 1)
    return loads(text.replace("[carrier]\n", "[carrier]" + FADING, 1), name)


def outcome(script: Path, driver: Driver) -> Proof:
    """One driver's outcome, kept or new."""
    name = f"{driver.set}_{driver.function}"
    kept = script.parent / f"{name}.json"
    if kept.exists():
        return Proof(**json.loads(kept.read_text(encoding="utf-8")))
    (proof,) = prove(script, [name], LIMIT, script.parent / "logs")
    kept.write_text(json.dumps(asdict(proof)), encoding="utf-8")
    print(f"{script.parent.name} {name}: {verdict(proof)}, {proof.seconds} s", flush=True)
    return proof


def verdict(proof: Proof | None) -> str:
    """A cell: alarms, and unproved properties of results."""
    if proof is None:
        return "not run"
    if proof.alarms is None:
        return "no end"
    return f"{proof.alarms}" if proof.unproved == 0 else f"{proof.alarms}, {proof.unproved} unproved"


def figures(
    found: dict[Key, Proof], every: dict[tuple[str, str], tuple[Driver, ...]], stands: Sequence[str]
) -> Figures:
    """The figures to keep: what is claimed, what is tried, how long it took, the functions of which nothing was run."""
    columns = [(stand, real) for stand in stands for real in REALS]

    def rows(claimed: bool) -> list[dict[str, str | None]]:
        wanted = dict.fromkeys(d for key in columns for d in every[key] if d.claimed == claimed)
        if not claimed:
            wanted = {d: None for d in wanted if any((*key, d) in found for key in columns)}
        places = {name: k for k, name in enumerate(FUNCTIONS)}  # functions of tasks come after these
        order = sorted(wanted, key=lambda d: places.get(d.function, 98) if d.set != "routine" else 99)
        return [
            {
                "function": d.function,
                "set": d.set,
                **{" ".join(key): verdict(found.get((*key, d))) if d in every[key] else None for key in columns},
            }
            for d in order
        ]

    (stand, real, driver), longest = max(found.items(), key=lambda item: item[1].seconds)
    seen = {driver.function for *_, driver in found}
    return {
        "version": version(),
        "runs": len(found),
        "seconds": sum(proof.seconds for proof in found.values()),
        "longest": {"seconds": longest.seconds, "driver": f"{stand} {real}, {driver.set}_{driver.function}"},
        "columns": [" ".join(key) for key in columns],
        "claimed": rows(True),
        "tried": rows(False),
        "not run": sorted({d.function for drivers in every.values() for d in drivers} - seen),
    }


def page(found: Figures) -> str:
    """The tables."""
    table = Columns({"function": "`{}`", "set": "{}", **dict.fromkeys(found["columns"], "{}")}, None)
    none = ", ".join(f"`{name}`" for name in found["not run"])
    return (
        f"Frama-C {found['version']}; {found['runs']} runs, {found['seconds']} s in all on a busy machine of two "
        f"cores, the longest {found['longest']['seconds']} s ({found['longest']['driver']}).\n\n"
        f"Claimed: alarms\n\n{table.text(found['claimed'])}\n"
        f"Tried, not claimed: alarms\n\n{table.text(found['tried'])}\n"
    ) + (f"Neither claimed nor tried: {none}.\n" if none else "")


CAMPAIGN = Campaign("proofs", campaign.Block("docs/results/proofs.md", "proofs: tools/proofs.py"), page)


def main() -> int:
    """Runs what is asked."""
    parser = campaign.parser(__doc__, stands=",".join([*names(), "fading3"]), quick=False, jobs=2, page=False)
    parser.add_argument("--tried", action="store_true", help="the functions that are not claimed as well")
    parser.add_argument("--only", default="", help="drivers, as in the script")
    given = parser.parse_args()
    stands = list(QUICK) if given.quick else given.stands.split(",")
    scripts: dict[tuple[str, str], Path] = {}
    every: dict[tuple[str, str], tuple[Driver, ...]] = {}
    for stand in stands:
        for real in REALS:
            scripts[stand, real], every[stand, real] = write_folder(stand, real)
    only = [name for name in given.only.split(",") if name]

    def is_asked(stand: str, driver: Driver) -> bool:
        name = f"{driver.set}_{driver.function}"
        if given.quick:
            return name in QUICK[stand]
        return name in only if only else driver.claimed or given.tried

    work = [(*key, d) for key, all_ in every.items() for d in all_ if is_asked(key[0], d)]
    if only:
        work.sort(key=lambda item: only.index(f"{item[2].set}_{item[2].function}"))
    with ThreadPoolExecutor(given.jobs) as pool:
        proofs = list(pool.map(lambda item: outcome(scripts[item[0], item[1]], item[2]), work))
    found = dict(zip(work, proofs, strict=True))
    wrong = [key for key, proof in found.items() if key[2].claimed and not proof.holds]
    for stand, real, driver in wrong:
        print(f"not proved: {stand} {real} {driver.set}_{driver.function}", file=sys.stderr)
    if given.page:
        _write(scripts, every, stands)
    return 1 if wrong else 0


def _write(
    scripts: dict[tuple[str, str], Path], every: dict[tuple[str, str], tuple[Driver, ...]], stands: Sequence[str]
) -> None:
    """Puts all kept outcomes into the page."""
    found: dict[Key, Proof] = {}
    for key, all_ in every.items():
        for driver in all_:
            kept = scripts[key].parent / f"{driver.set}_{driver.function}.json"
            if kept.exists():
                found[(*key, driver)] = Proof(**json.loads(kept.read_text(encoding="utf-8")))
    CAMPAIGN.keep(figures(found, every, stands))


if __name__ == "__main__":
    sys.exit(main())
