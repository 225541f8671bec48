"""What a campaign file may not say: each refusal in one line, with the message that a user sees."""

from __future__ import annotations

from datetime import date
from pathlib import Path

import pytest

import mahovik
from campaigns.sections import RUN, VARY, Keys, computation, refusal, write
from campaigns.test_held import PENDULUM, SERVO_RUN, SHAKE, SHAKER, write_files
from campaigns.test_held import RUN as FOLLOW
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.errors import CampaignError, MahovikError
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.campaign import Campaign
from plan.held_stands import stand, wheel
from verify.holds import PENDULUM as TEXT

REFUSALS = {
    '"rw5.mass" = { tolerance = "1 g" }': 'vary "rw5.mass": sat4 has no "rw5", did you mean "rw1"?',
    '"wheel*.mass" = { tolerance = "1 g" }': 'no name matches "wheel*"',
    '"rw1.unbalance.statik" = { tolerance = "1 g mm" }': 'unknown key "statik", did you mean "static"?',
    '"rw1.mass" = { tolerance = "1 mm" }': 'tolerance: unit "mm" does not fit, expected a mass (kg)',
    '"rw1.mass" = { normal = ["1 kg", "1 mm"] }': 'vary "rw1.mass": normal[1]: unit "mm" does not fit',
    '"rw1.mass" = { norml = ["1 kg", "1 g"] }': 'unknown key "norml", did you mean "normal"?',
    '"rw1.mass" = { normal = [1, 0.1], uniform = [1, 2] }': "expected one of normal, relative",
    '"rw1.mass" = "1 kg"': "expected a table such as",
    '"rw1.mass" = { uniform = ["3 kg", "2 kg"] }': "uniform: 2 is below 3 kg",
    '"rw1.mass" = { normal = [-1, 0.1] }': "normal[0]: -1 kg is negative",
    '"rw1.mass" = { normal = [2, -0.1] }': "is negative, expected a spread",
    '"rw1.mass" = { normal = [2, 0.1], least = 9 }': "the distribution has no values between them",
    '"rw1.mass" = { normal = [2, 0.1], least = 3, most = 1 }': "least: 3 is above most, 1 kg",
    '"gravity[2]" = { relative = 0.1 }': "gravity[2] is zero in the stand file",
    '"rw1" = { tolerance = "1 g" }': "is a table; expected the path of a number, such as rw1.mass",
    '"rw1.name" = { tolerance = "1 g" }': "is no number",
    '"rw1.position[3]" = { tolerance = "1 mm" }': "expected a place from [0] to [2], found [3]",
    '"carrier.inertia" = { relative = 0.1 }': "expected an element of the matrix, such as carrier.inertia.J12",
    '"rw1.buoyancy.displaced_mass" = { relative = 0.1 }': "has no rw1.buoyancy to vary",
    '"rw1.motor.torque" = { relative = 0.1 }': "acts in no table of the C",
    '"rw1..mass" = { relative = 0.1 }': "is no path",
    '"rw1.unbalance" = { grade = "G 2.5" }': "speed: required with grade, but missing",
    '"rw1.unbalance" = { grade = 2.5, speed = "3000 rpm" }': 'expected a balance quality grade, such as "G 2.5"',
    '"rw1.unbalance" = { grade = "G 2.5", speed = "50 Hz" }': "speed: ",
    '"carrier.unbalance" = { grade = "G 2.5", speed = "50 rpm" }': "carrier.unbalance",
    '"rw1.mass" = { table = "none.csv" }': "none.csv: cannot be read",
    '"rw1.mass" = { discrete = [] }': "discrete: expected at least one value",
    '"rw1.mass" = { discrete = [1, 2], weights = [0, 0] }': "weights: expected numbers from 0",
    '"rw1.mass" = { lognormal = ["0 kg", 0.1] }': "0 kg is not above 0",
    '"rw*.mass" = { relative = 0.1 }\n"*1.mass" = { relative = 0.2 }': "rw1.mass varies twice, also by",
}


@pytest.mark.parametrize("entry", REFUSALS)
def test_what_cannot_vary_is_refused_by_name(tmp_path: Path, entry: str) -> None:
    assert REFUSALS[entry] in refusal(tmp_path, f"[vary]\n{entry}\n")


def test_an_unbalance_varies_once(tmp_path: Path) -> None:
    body = '[vary]\n"w1.unbalance.static" = { relative = 0.1 }\n"w1.center_of_mass[1]" = { tolerance = "1 mm" }'
    text = refusal(tmp_path, body, stand="bench8")
    assert "w1.center_of_mass[1] and w1.unbalance.static are the same unbalance" in text


def test_a_table_without_the_column_is_refused(tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_text("static [g mm],mas [kg]\n1,2\n")
    text = refusal(tmp_path, '[vary]\n"rw1.mass" = { table = "w.csv" }')
    assert 'w.csv has no column "mass", did you mean "mas"?' in text
    (tmp_path / "w.csv").write_text("mass [kg]\n2\nheavy\n")
    assert '"heavy" is not a number' in refusal(tmp_path, '[vary]\n"rw1.mass" = { table = "w.csv" }')


CORRELATIONS = {
    'of = ["rw1.mass"]\ncoefficient = 0.5': "expected two numbers or more",
    'of = ["rw1.mass", "carrier.mass"]\ncoefficient = 0.5': "carrier.mass does not vary",
    'of = ["rw*.mass"]\ncoefficient = 1': "expected above -1 and below 1",
    'of = ["rw*.mass"]\ncoefficient = -0.5': "not positive definite",
    'of = ["rw*.mass"]\ncoefficient = 0.1\n[[correlation]]\nof = ["rw1.mass", "rw2.mass"]\ncoefficient = 0.2': "twice",
}


@pytest.mark.parametrize("entry", CORRELATIONS)
def test_correlations_that_cannot_be_are_refused(tmp_path: Path, entry: str) -> None:
    text = refusal(tmp_path, f'[vary]\n"rw*.mass" = {{ relative = 0.01 }}\n[[correlation]]\n{entry}\n')
    assert CORRELATIONS[entry] in text


QUANTITIES = {
    'name = "shake"\nwhat = "velocity"': 'what: expected a statistic and a signal such as "rms acceleration"',
    'name = "shake"\nwhat = "rms"': 'what: expected a statistic and a signal such as "rms acceleration"',
    'name = "shake"\nwhat = 3': "what: expected a statistic and a signal",
    'name = "shake"\nrms = "velocity"': 'rms: unknown key; expected what = "rms velocity"',
    'name = "shake"\nwhat = "rms velocity"\nbnd = 3': 'quantity, shake: unknown key "bnd", did you mean "band"?',
    'what = "rms velocity"': "quantity[0], name: required, but missing",
    'name = 3\nwhat = "rms velocity"': "quantity[0], name: expected a string, found 3",
    'name = "a"\nwhat = "rms velocity"\n[[quantity]]\nname = "a"': '"a" is the name of another quantity',
    'name = "sample"\nwhat = "rms velocity"': "is the name of another column",
}


@pytest.mark.parametrize("keys", QUANTITIES)
def test_quantities_that_mean_nothing_are_refused(tmp_path: Path, keys: str) -> None:
    body = VARY + RUN.partition("[[quantity]]")[0] + '[[quantity]]\nat = "carrier"\n' + keys
    assert QUANTITIES[keys] in refusal(tmp_path, body, stand="demo3")


KEYS = {
    'design = "sobel"': 'design: unknown "sobel", did you mean "sobol"?',
    'stand = "sat5"': 'stand: no stand file "sat5" beside it, and no such example, did you mean "sat4"?',
    "samples = 0": "samples: 0: expected 1 to",
    "sample = 3": 'unknown key "sample", did you mean "samples"?',
    'until = "2 %"': "until: of which quantile?",
    'until = "2 s"': "until: ",
    'design = "latin"\nsamples = 6000000': 'samples: at most 5000000 with design "latin"',
    'design = "morris"\nsamples = 3000000': 'at most 625000 with design "morris"; expected fewer, or another design',
    "seed = -1": "seed: -1: expected 0 to",
    'quantile = { of = "shake", at = 95 }': "quantile, at: 95: expected above 0 and below 1",
    'until = 0.1\ndesign = "morris"\nquantile = { of = "shake" }': 'until: not allowed with design "morris"',
    'design = "saltelli"\nquantile = { of = "shake" }': 'quantile: not allowed with design "saltelli"',
}


@pytest.mark.parametrize("keys", KEYS)
def test_keys_that_mean_nothing_are_refused(tmp_path: Path, keys: str) -> None:
    path = write(tmp_path, "", stand="demo3")
    head = {line.split(" = ")[0]: line for line in path.read_text().splitlines()}
    head |= {line.split(" = ")[0]: line for line in keys.splitlines()}
    path.write_text("\n".join(head.values()) + VARY + RUN)
    with pytest.raises(CampaignError) as refused:
        Campaign.load(path)
    assert KEYS[keys] in str(refused.value)
    assert "\n" not in str(refused.value)


ENDS = {
    '"w1.mass" = { discrete = [0.5, 0.6, "-1 kg"] }': "at one of its values, w1.mass = -1 kg: ",
    '"w1.mass" = { normal = [0.5, 0.3], most = 0.6, least = -1 }': "at its lower end, w1.mass = -0.",
    '"w*.mass" = { uniform = ["-1 kg", "1 kg"], group = "batch" }': "w1.mass = -1 kg, w2.mass = -1 kg, w3.mass = -1 ",
}


@pytest.mark.parametrize("entry", ENDS)
def test_ends_are_tried_before_the_run(tmp_path: Path, entry: str) -> None:
    with pytest.raises(CampaignError) as refused:
        Campaign.load(write(tmp_path, f"[vary]\n{entry}\n{RUN}", stand="demo3"))
    assert ENDS[entry] in str(refused.value) and "; sample " in str(refused.value)


def test_what_is_computed_must_be_there(tmp_path: Path) -> None:
    for body, words in (
        (VARY, "over: required, but missing"),
        (VARY + RUN.partition("[[quantity]]")[0], "quantity: none"),
        ("quantile = { of = 'shak' }" + VARY + RUN, 'quantile, of: unknown quantity "shak", did you mean "shake"?'),
        (VARY + RUN.replace("velocity", "velocty"), 'did you mean "velocity"'),
    ):
        with pytest.raises(CampaignError) as refused:
            Campaign.load(write(tmp_path, body, stand="demo3", samples=300))
        assert words in str(refused.value)
    assert "nothing varies" in refusal(tmp_path, "[vary]\n")
    assert "vary: required" in refusal(tmp_path, "")


SPEED = {"regime": {"default": {"speed": 100}}, "until": "10 ms"}


@pytest.mark.parametrize(
    ("run", "quantity", "words"),
    [
        (SPEED, {"peak": "acceleraton", "at": "carrier"}, 'peak: unknown "acceleraton", did you mean "acceleration"?'),
        (SPEED, {"peak": "acceleration"}, "at: required, but missing; expected one of carrier"),
        (SPEED, {"peak": "force", "of": "leg 1"}, 'of: unknown "leg 1"'),
        (SPEED, {"peak": "torque", "of": "w9"}, 'of: unknown "w9", did you mean "w1"?'),
        (SPEED, {"peak": "torque", "at": "w1"}, "at: not allowed, expected `of`"),
        (SPEED, {"peak": "torque", "of": "w1", "axis": "x"}, "axis: x: expected none"),
        (SPEED, {"peak": "error"}, "no signal `error` over regime"),
        (SPEED, {"peak": "rate", "rms": "rate", "at": "carrier"}, "expected exactly one of"),
        (SPEED, {"peak": "rate", "at": "carrier", "band": ["1 Hz", "2 Hz"]}, "band: only allowed with `rms`"),
        (SPEED, {"rms": "rate", "at": "carrier", "band": ["1 Hz", "900 Hz"]}, "band: 900 Hz needs `every` of at most"),
        (SPEED, {"rms": "rate", "at": "carrier", "band": ["9 Hz", "8 Hz"]}, "band: expected a lower and a higher"),
        (SPEED, {"rms": "rate", "at": "carrier", "band": ["9 Hz", "19 Hz"]}, "resolved in 0.01 s; needs 0.2 s"),
        (SPEED, {"peak": "rate", "at": "carrier", "after": "1 s"}, "after: 1 s: expected less than `until`"),
        (SPEED, {"settling": "rate", "at": "carrier"}, "within: required with `settling`"),
        (SPEED, {"settling": "rate", "at": "carrier", "within": "1 mm"}, "expected an angular speed (rad/s)"),
        (SPEED, {"function": "nothing"}, 'function: "nothing": expected "package.module:function"'),
        (SPEED, {"function": "no_such_module:f"}, "function: no_such_module cannot be imported"),
        (SPEED, {"function": "math:squareroot"}, 'function: math has no "squareroot"'),
        (SPEED, {"function": "f.py:f"}, "function: f.py: no such file"),
        ({"speeds": {"w1": 100}}, {"peak": "torque", "of": "w1"}, "no signal `torque` over speeds; expected one of"),
        ({"speeds": {"w1": 100}}, {"end": "rate", "at": "carrier"}, "no statistic `end` over speeds"),
        ({"speeds": {"w1": date(2000, 1, 1)}}, {"rms": "rate", "at": "carrier"}, "speeds: w1: expected a speed"),
        ({"speeds": {"w1": 100, "w2": 3.14}}, {"rms": "rate", "at": "carrier"}, "over: speeds 100, 3.14"),
        ({"speeds": {"w1": "0..100"}}, {"rms": "rate", "at": "carrier"}, "a range of speeds, expected one speed"),
        ({"states": "none.jsonl"}, {"peak": "rate", "at": "carrier"}, "none.jsonl: no such file"),
        ({"regime": {"default": {"hold": True}}}, {"peak": "rate", "at": "carrier"}, "until: required with `regime`"),
        (SPEED | {"servo": "s"}, {"peak": "rate", "at": "carrier"}, "run, servo: not allowed with `regime`"),
        (SPEED | {"states": "s"}, {"peak": "rate", "at": "carrier"}, "exactly one of regime, speeds, programme"),
        (SPEED | {"order": 3}, {"peak": "rate", "at": "carrier"}, "run, order: 3: expected 4 or 2"),
        (SPEED | {"regime": "no.toml"}, {"peak": "rate", "at": "carrier"}, "no.toml: no such file"),
        (SPEED | {"until": "900 s", "every": "0.1 ms"},
         {"rms": "rate", "at": "carrier", "band": ["1 Hz", "100 Hz"]}, "expected a larger `every`"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_in_one_line(run: Keys, quantity: Keys, words: str, tmp_path: Path) -> None:
    """It says where, what was found and what was expected, before anything is computed."""
    with pytest.raises(MahovikError) as refused:
        computation(mahovik.example("bench8"), run, {"q": quantity}, folder=tmp_path)
    said = str(refused.value)
    assert words in said and "\n" not in said, said
    assert said.startswith(("C.toml: ", "quantity q: ", "over: ", str(tmp_path))), said


CLAMPED = stand("freedoms = []", wheel(1, [1, 0, 0], 40))
HELD = [
    (SHAKER, FOLLOW, {"peak": "error", "axis": "x"}, "axis: x: expected one of z"),
    (SHAKER, FOLLOW, {"peak": "error", "axis": "phi"}, "axis: phi: expected one of z"),
    (CLAMPED, FOLLOW, {"peak": "error"}, "clamped, the carrier makes no motion"),
    (PENDULUM, FOLLOW, {"peak": "error"}, "over: programme: p.json: programme of another stand: "),
    (SHAKER, SERVO_RUN, {"peak": "error", "axis": "theta"}, "axis: theta: expected one of z"),
    (SHAKER, SERVO_RUN, {"mean": "error"}, "axis: required with the mean of the error; expected one of z"),
    (SHAKER, SERVO_RUN, {"peak": "force", "of": "hold"}, "no signal `force` over servo"),
    (SHAKER, {"speeds": {"w1": 10.0}}, {"peak": "force", "of": "w1"}, "over speeds only that of the hold is known"),
]


@pytest.mark.parametrize(("machine", "run", "wanted", "words"), HELD)
def test_what_a_held_carrier_does_not_have_is_refused(
    tmp_path: Path, machine: CoreStand, run: Keys, wanted: Keys, words: str
) -> None:
    write_files(tmp_path, SHAKER, SHAKE)
    with pytest.raises(MahovikError) as refused:
        computation(Stand.of(machine), run, {"e": wanted}, folder=tmp_path)
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_states_of_a_file_are_of_one_place(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(TEXT, encoding="utf-8")
    (tmp_path / "s.jsonl").write_text('{"u": [1]}\n', encoding="utf-8")
    body = (
        '[vary]\n"hold.pivot[2]" = { tolerance = "1 mm" }\n[over]\nstates = "s.jsonl"\n'
        '[[quantity]]\nname = "f"\nwhat = "peak force"\nat = "hold"\n'
    )
    with pytest.raises(CampaignError, match="the states of a file are of one place"):
        Campaign.load(write(tmp_path, body, stand="p.toml", samples=4))
