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
    "vibration": "vibration $sat4 --speed rw1=3000rpm --at acc1",
    "plan": "plan $demo3 --motion $turn -o p2.json",
    "generate": "generate $demo3",
    "verify": "verify $demo3",
    "replay": "replay $demo3 --log none.log",
    "report": "report $demo3 -o r.html",
    "judge": "judge $demo3 --log log.csv",
    "program": "judge $demo3",
    "new": "new adapter",
    "modes": "modes $shaker2 --start state.json -o model.json",
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
    ("simulate", "--start none.json", "--start none.json: no such file"),
    ("simulate", "--start utf16.json", "utf16.json: not UTF-8, byte 0xff in line 1: save it as UTF-8"),
    ("simulate", "--regime link.toml", "link.toml: no such file\n"),
    ("simulate", "--regime .", ".: is a directory, expected a regime"),
    ("simulate", "--start twice.json", "appears twice"),
    ("simulate", "--start tau.json", '"tau" is not part of a start, expected some of id, position, angles'),
    ("simulate", "--start broken.json", "broken.json: not JSON: Expecting ':' delimiter at line 2, column 6"),
    ("simulate", "--backend scipy --order 2", "--order: needs --backend c"),
    ("simulate", "--mismatch 1%", "--mismatch: needs --programme"),
    ("follow", "--mismatch -1%", "--mismatch -1%: expected 0% to 20%"),
    ("follow", "--mismatch 90%", "--mismatch 90%: expected 0% to 20%"),
    ("follow", "--table many", "--table many: expected a whole number"),
    ("follow", "--table 2", "--table 2: expected at least 4 nodes"),
    ("follow", "--begin rest", "--begin rest: p.json has no run-up"),
    ("follow", "--dt 1e-4", "--dt: not allowed with --programme"),
    ("follow", "--motion $tilt", "programme of another motion"),
    ("vibration", "--speed rw2=nan", "--speed rw2=nan: expected a finite angular speed, as rw2=1000 rpm"),
    ("vibration", "--speed rw2=0..60Hz", "a frequency is not one: write rpm or rad/s"),
    ("vibration", "--speed rw2=0..60rpm --steps 1", "--steps 1: expected a whole number from 2"),
    ("vibration", "--band 5..1Hz", "--band 5..1 Hz: expected two frequencies"),
    ("vibration", "--band 20..200kg", "--band 200kg: expected a frequency with its unit"),
    ("vibration", "--band 1..5", "--band 1..5: expected two frequencies with their unit"),
    ("vibration", "--phase rw1", "--phase rw1: expected NAME=VALUE, or one for each"),
    ("vibration", "--phase rw1=nan", "--phase rw1=nan: expected a finite angle, as rw1=90 deg"),
    ("vibration", "--phase rw1=1kg", 'unit "kg" does not fit'),
    ("vibration", "-o r.pdf", "expected a name that ends in .csv or .json"),
    ("vibration", "--sight wheel.csv", "--at, --sight: expected a point or a line of sight, one of them"),
    ("vibration", "--harmonics rw9=wheel.csv", 'unknown flywheel "rw9", did you mean'),
    ("vibration", "--harmonics wheel.csv", "--harmonics wheel.csv: expected a mapping NAME=FILE.csv"),
    ("vibration", "--require 'rss 1 arcsec'", "expected rms, peak or worst"),
    ("vibration", "--require 'rms 0.1'", 'a limit with a unit, as "rms 0.1 arcsec'),
    ("vibration", "--modes wheel.csv", 'unknown column "order [-]"'),
    ("vibration", "--noise rw1=missing.csv", "missing.csv: cannot be read"),
    ("vibration", "--improve --time 0", "--time 0: expected a time above 0"),
    ("vibration", "--time 4", "--time: needs a range of speeds, --speed NAME=LOW..HIGH"),
    ("vibration", "--improve --limit '-3 rpm'", "--limit -3 rpm: expected a speed, or a range of them, from zero up"),
    ("vibration", "--improve --avoid 40..30Hz", "--avoid 40..30 Hz: expected two frequencies"),
    ("vibration", "--improve --seed -1", "--seed -1: expected a whole number of at least 0"),
    ("vibration", "--improve --harmonics all=wheel.csv", "--improve: expected one set of speeds, and no makers'"),
    ("plan", "--stand new.toml", "--stand: needs --free KEYS"),
    ("plan", "--free '*t.mass' -o p.json", "--stand: missing, expected a file for the stand with the moved numbers"),
    ("plan", "-o .", "-o .: expected a name that ends in .json or .csv"),
    ("generate", "-o c.svg", "-o c.svg: expected a folder"),
    ("plan", "--method ocp", "(13) needs at least 6"),
    ("plan", "--time 0", "--time"),
    ("program", "--with ''", "--with: is empty"),
    ("program", '--with "\'unclosed"', "--with 'unclosed: No closing quotation"),
    ("program", "--with cat --log log.csv", "--with, --log, --fmu: found 2 of them, expected one"),
    ("program", "--with cat --tolerance few", "--tolerance few: expected a number"),
    ("program", "--with 'no-such-program {stand}'", "cannot be started"),
    ("program", "--with cat --want frward", 'unknown "frward", did you mean "forward"?'),
    ("program", "--with cat --want torque_for", "--want torque_for: demo3 has no task, [task.NAME]"),
    ("program", "--with cat --attitude quaternion --want generalized", "--want, --attitude: generalized needs angles"),
    ("program", "--fmu a.fmu --map $bench8", "is a stand file, expected a map of variables"),
    ("new", "-o adapter.rs", "expected a name that ends in .py or .cpp"),
    ("new", "-o twice.py", "twice.py: exists already"),
    ("judge", "--attitude angles", "--attitude: needs --with COMMAND"),
    ("verify", "--real float --judges", "judge a fresh copy in double"),
    ("verify", "--rigorous --judges", "--judges, --rigorous: each is a verification of its own"),
    ("replay", "", "none.log: cannot be read"),
    ("replay", "-o states.txt", "expected a name that ends in .csv"),
    ("report", "--derivation --at acc1", "--at: not allowed with --derivation"),
    ("report", "--require 'rms 1 kg'", "rms 1 kg"),
    ("judge", "--states 3", "--states"),
    ("judge", "--log missing.csv", "no such file"),
    ("judge", "--log log.txt", "expected .csv or .parquet"),
    ("modes", "", '"tau" is not part of a start, expected some of'),
]


@pytest.fixture(autouse=True)
def files(work_folder: Path) -> set[str]:
    """Files that the commands read."""
    save_programme(shaker()[2], work_folder / "p.json")
    Path("servo.toml").write_text(SERVO)
    Path("twice.json").write_text('{"phi": [0, 0, 0], "phi": [1, 0, 0]}')
    Path("twice.py").touch()
    Path("link.toml").symlink_to("nowhere.toml")
    Path("utf16.json").write_text("{}", encoding="utf-16")
    Path("broken.json").write_text('{\n "V" [1]}')
    for name in ("tau", "state"):
        Path(f"{name}.json").write_text(json.dumps({"tau": [1.0, 2.0]}))
    Path("wheel.csv").write_text("order [-],radial force [N/(rad/s)^2]\n1,1.5e-6\n")
    return {path.name for path in work_folder.iterdir()}


def test_of_many_problems_the_first_are_printed_and_the_rest_counted() -> None:
    Path("many.toml").write_text("".join(f"key{number} = 1\n" for number in range(1000)))
    lines = refused("check", "many.toml").splitlines()
    assert len(lines) == 21 and lines[-1] == "error: 983 more problems, shown when these are mended"


@pytest.mark.parametrize(("command", "options", "words"), CASES, ids=[f"{case[0]} {case[1]}" for case in CASES])
def test_one_line_says_why_and_nothing_is_written(command: str, options: str, words: str, files: set[str]) -> None:
    said = refused(*shlex.split(Template(f"{COMMANDS[command]} {options}").substitute(PLACES)))
    assert said.splitlines()[-1].startswith("error: ") and words in said
    assert {path.name for path in Path().iterdir()} == files


def test_a_result_never_replaces_what_was_read(tmp_path: Path) -> None:
    start = tmp_path / "s.json"
    start.write_text('{"V": [0, 0, 0, 0, 0, 0]}')
    said = refused("simulate", str(stands.path("bench8")), "--until", "0.01", "--start", str(start), "-o", str(start))
    assert said == f"error: -o {start}: is read by this command; expected another name\n"
    assert start.read_text() == '{"V": [0, 0, 0, 0, 0, 0]}'
