"""What is refused is one line with the reason, and nothing is written: reasons that no transcript shows."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from string import Template

import pytest

from cli.run import refused
from control.following import SERVO
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from verify.programme.programmes import shaker

EXAMPLES = {name: str(stands.path(name)) for name in stands.names()}
MOTIONS = {"turn": "demo3.motion.json", "spin": "shaker2_spin.motion.json", "tilt": "shaker2.motion.json"}
PLACES = EXAMPLES | {name: str(Path(EXAMPLES["demo3"]).with_name(file)) for name, file in MOTIONS.items()}

COMMANDS = {
    "simulate": "simulate $demo3 --until 1 -o a.csv",
    "follow": "simulate $shaker2 --programme p.json --motion $spin --servo servo.toml",
    "response": "response $bench8 --at carrier --speed w1=6rpm",
    "jitter": "jitter $sat4 --speed all=3000rpm --at acc1",
    "quiet": "quiet $sat4 --point acc1 --band 20..200Hz --momentum '0 0 14'",
    "plan": "plan $demo3 --motion $turn -o p2.json",
    "verify": "verify $demo3",
    "replay": "replay $demo3 --log none.log",
    "report": "report $demo3 -o r.html",
    "judge": "judge $demo3 --log log.csv",
    "program": "judge $demo3",
    "new": "new adapter",
    "modes": "modes $shaker2 --at state.json -o model.json",
}
"""Arguments that are right; those of a case come after them."""

CASES = [
    ("simulate", "--until 0", "--until 0: expected a time above 0"),
    ("simulate", "--until nan", "--until nan: expected a time above 0"),
    ("simulate", "--dt '1 2'", "--dt: "),
    ("simulate", "--dt 20", "--dt 20: expected at most 10 s"),
    ("simulate", "--every -1", "--every -1"),
    ("simulate", "-o /proc/a.csv", "/proc/a.csv: cannot be written"),
    ("simulate", "--regime none.toml", "none.toml: no such file"),
    ("simulate", "--start none.json", "none.json: cannot be read"),
    ("simulate", "--start twice.json", "appears twice"),
    ("simulate", "--start tau.json", '"tau" is not part of a start, expected some of id, position, angles'),
    ("simulate", "--start broken.json", "broken.json: not JSON: Expecting ':' delimiter at line 2, column 6"),
    ("simulate", "--mismatch 1%", "--mismatch: needs --programme"),
    ("follow", "--mismatch -1%", "--mismatch -1%: expected 0 or more"),
    ("follow", "--mismatch 90%", "--mismatch 90%: expected 0% to 20%"),
    ("follow", "--table many", "Invalid value for '--table'"),
    ("follow", "--table 2", "--table 2: expected at least 4 nodes"),
    ("follow", "--begin rest", "--begin rest: p.json has no run-up"),
    ("follow", "--dt 1e-4", "--dt: not allowed with --programme"),
    ("follow", "--motion $tilt", "programme of another motion"),
    ("response", "--speed w2=nan", "--speed w2=nan: expected a finite speed, as w2=1000 rpm"),
    ("response", "--speed w2=0..60Hz", "a frequency is not one: write rpm or rad/s"),
    ("response", "--steps 5", "--steps: no speed is swept"),
    ("response", "--speed w2=1.41421356237", "no common period within 1000 turns"),
    ("response", "--band 5..1Hz", "--band 5..1 Hz: expected two frequencies"),
    ("response", "--phase w1=1kg", 'unit "kg" does not fit'),
    ("response", "-o r.pdf", "expected a name that ends in .csv or .json or .svg or .png"),
    ("jitter", "--harmonics rw9=wheel.csv", 'unknown flywheel "rw9", did you mean'),
    ("jitter", "--harmonics wheel.csv", "expected NAME=FILE.csv"),
    ("jitter", "--require 'peak 1 arcsec'", "expected rms, rss or worst"),
    ("jitter", "--require 'rms 0.1'", 'a limit with a unit, as "rms 0.1 arcsec"'),
    ("jitter", "--exact", "no speed is swept"),
    ("jitter", "--modes wheel.csv", 'unknown column "order [-]"'),
    ("jitter", "--noise rw1=missing.csv", "missing.csv: cannot be read"),
    ("quiet", "--axis zz", "--axis zz: expected some of the letters xyz"),
    ("quiet", "--reduction 0.5", "--reduction 0.5: expected a factor above 1"),
    ("quiet", "--change '-3 rpm'", "--change -3 rpm: expected a speed above 0"),
    ("quiet", "--avoid 40..30Hz", "--avoid 40..30 Hz: expected two frequencies"),
    ("quiet", "--orders 0", "--orders: expected whole numbers from 1"),
    ("quiet", "--margin ten", "--margin ten: expected a fraction"),
    ("quiet", "--guard 200%", "--guard 2: expected a fraction of 1"),
    ("quiet", "--speeds '1 2 3'", "3 speeds, but the stand has 4 flywheels"),
    ("quiet", "--band 0..200Hz --measure angle", "--band from 0 Hz: a drift has no angle"),
    ("quiet", "-o $sat4", "is read by this command"),
    ("quiet", "-o both --state ./both", "-o and --state ./both: one file for both"),
    ("plan", "--stand new.toml", "--stand: writes what --free changes; expected --free KEYS"),
    ("plan", "-o .", ".: is a directory, expected a file to write"),
    ("plan", "--method ocp", "(13) needs at least 6"),
    ("plan", "--time 0", "--time"),
    ("program", "--with ''", "no command"),
    ("program", '--with "\'unclosed"', "No closing quotation"),
    ("program", "--with 'no-such-program {stand}'", "cannot be started"),
    ("program", "--with cat --want frward", 'unknown "frward", did you mean "forward"?'),
    ("program", "--with cat --want torque_for", "demo3 has no task, [task.NAME]"),
    ("program", "--with cat --attitude quaternion --want generalized", "generalized: needs angles"),
    ("new", "-o adapter.rs", "expected a name that ends in .py or .cpp"),
    ("new", "-o twice.py", "twice.py: exists already"),
    ("judge", "--attitude angles", "--attitude: only of a program"),
    ("verify", "--real float --judges", "for the generated C"),
    ("verify", "--rigorous --judges", "--rigorous measures the C: not with --judges, --targets"),
    ("replay", "", "none.log: cannot be read"),
    ("replay", "-o states.txt", "expected a name that ends in .csv or .jsonl"),
    ("report", "--motion $turn", "goes with --programme P.json, which is missing"),
    ("report", "--require 'rms 1 kg'", "rms 1 kg"),
    ("report", "--run wheel.csv", 'no run of `mahovik simulate`: expected a column "t [s]" and rows'),
    ("report", "--run run.txt", "--run run.txt: expected a name that ends in .csv or .parquet"),
    ("judge", "--states 3", "--states"),
    ("judge", "--log missing.csv", "no such file"),
    ("judge", "--log log.txt", "expected .csv or .parquet"),
    ("modes", "", '"tau" is not part of a start, expected some of'),
]


@pytest.fixture(autouse=True)
def files(own_folder: Path) -> set[str]:
    """Files that the commands read."""
    save_programme(shaker()[2], own_folder / "p.json")
    Path("servo.toml").write_text(SERVO)
    Path("twice.json").write_text('{"phi": [0, 0, 0], "phi": [1, 0, 0]}')
    Path("twice.py").touch()
    Path("broken.json").write_text('{\n "V" [1]}')
    for name in ("tau", "state"):
        Path(f"{name}.json").write_text(json.dumps({"tau": [1.0, 2.0]}))
    Path("wheel.csv").write_text("order [-],radial force [N/(rad/s)^2]\n1,1.5e-6\n")
    return {path.name for path in own_folder.iterdir()}


@pytest.mark.parametrize(("command", "options", "words"), CASES, ids=[f"{case[0]} {case[1]}" for case in CASES])
def test_one_line_says_why_and_nothing_is_written(command: str, options: str, words: str, files: set[str]) -> None:
    said = refused(*shlex.split(Template(f"{COMMANDS[command]} {options}").substitute(PLACES)))
    assert said.splitlines()[-1].startswith("error: ") and words in said
    assert {path.name for path in Path().iterdir()} == files
