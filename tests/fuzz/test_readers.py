"""Files of every kind, spoiled, and states: each is taken or refused in words, and what is taken can be used."""

from __future__ import annotations

import io
import json
import math
import os
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cli.run import DEMO3, run
from fuzz.mangle import CELLS, spoiled_bytes, spoiled_csv, spoiled_json, spoiled_toml, spoiled_xml
from fuzz.reading import READERS, check_message, fuzzed, read_or_refuse, soon
from mahovik import stands
from mahovik.core.motion.motion_file import load_motion, read_motion
from mahovik.core.motion.programme import load_programme, programme_text, read_programme
from mahovik.core.motion.regime import load as load_regime
from mahovik.core.motion.servo import load_servo
from mahovik.core.stand import load
from mahovik.core.stand.model import rest_state
from mahovik.errors import MotionError
from mahovik.out.campaign.file import load_campaign
from mahovik.out.foreign.original import read
from mahovik.out.foreign.stand import make_stand
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.foreign import read_results
from mahovik.proof.verify.states import Backend, Request, evaluate_lines
from mahovik.stands import path
from mahovik.use.control.servo import check_margins, gains
from mahovik.use.simulate.case import load_start

pytestmark = READERS

DEMO, SAT4 = load(stands.path("demo3")), load(stands.path("sat4"))
STANDS = [stands.path(name).read_text(encoding="utf-8") for name in stands.names()]

EXAMPLES = Path(__file__).parent / "examples"


def examples(pattern: str) -> list[bytes]:
    """Files of the folder of examples."""
    return [path.read_bytes() for path in sorted(EXAMPLES.glob(pattern))]


CAMPAIGNS, SERVOS, REGIMES = (
    [data.decode() for data in examples(f"{kind}-*.toml")] for kind in ("campaign", "servo", "regime")
)
COURSES = examples("course-*.csv")
SHIPPED = [path.read_bytes() for path in stands.motions("demo3")]
MOTIONS, PROGRAMMES = (
    [json.loads(data) for data in files] for files in ([*SHIPPED, *examples("motion-*")], examples("programme-*"))
)
MODELS = Path(__file__).parents[1] / "foreign" / "models"
URDF, MJCF, SDF = ((MODELS / f"sat.{kind}").read_text(encoding="utf-8") for kind in ("urdf", "xml", "sdf"))


def read_servo_file(file: Path) -> None:
    """The servo, its gains and its margins."""
    servo = load_servo(file, SAT4)
    for values in gains(SAT4, servo, 0.1).values():
        assert all(map(math.isfinite, values if isinstance(values, list) else [values]))
    check_margins(SAT4, servo, file.name)


def read_motion_file(file: Path) -> None:
    """The motion, at some times."""
    motion = load_motion(file, DEMO)
    assert np.all(np.isfinite(motion.at(np.array([0.0, 0.3, 1e3])).q_ddot))


def read_programme_file(file: Path) -> None:
    """The programme, which can be written again."""
    text = programme_text(load_programme(file))
    assert programme_text(read_programme(text)) == text


def read_model(file: Path) -> None:
    """The stand of a model, as a stand file."""
    stand = make_stand(read(file, None)[0], "x", file.name)
    assert all("\n" not in note for note in stand.notes)


def read_with(text: str, name: str, read: Callable[[Path], Any], file: Path) -> None:
    """A file that reads the tables beside it."""
    (file.parent / name).write_text(text, encoding="utf-8")
    read(file.parent / name)


def read_course(file: Path) -> None:
    """A table as a motion and as a wrench."""
    (file.parent / "t.csv").write_bytes(file.read_bytes())
    (file.parent / "w.csv").write_bytes(file.read_bytes())
    for text in REGIMES:
        read_with(text, "regime.toml", lambda path: load_regime(path, DEMO, 1.0), file)


@dataclass(frozen=True)
class Reader:
    """A reader of files: what it reads, the name of the file, examples that it takes, and how they are spoiled."""

    read: Callable[[Path], Any]
    name: str
    examples: Sequence[bytes]
    spoiled: st.SearchStrategy[str | bytes]


def encoded(texts: Sequence[str]) -> list[bytes]:
    """Texts as UTF-8."""
    return [text.encode() for text in texts]


def as_json(documents: Sequence[Any]) -> list[bytes]:
    """Documents as JSON."""
    return encoded([json.dumps(document) for document in documents])


regime = partial(load_regime, stand=DEMO, until=1.0)
regime_documents = [tomllib.loads(text) for text in REGIMES]
FILES = {
    "stand": Reader(load, "stand.toml", encoded(STANDS), spoiled_toml(STANDS)),
    "servo": Reader(read_servo_file, "S.toml", encoded(SERVOS), spoiled_toml(SERVOS)),
    "campaign": Reader(load_campaign, "C.toml", encoded(CAMPAIGNS), spoiled_toml(CAMPAIGNS)),
    "regime": Reader(regime, "regime.toml", encoded(REGIMES), spoiled_toml(REGIMES)),
    "regime in JSON": Reader(regime, "regime.json", as_json(regime_documents), spoiled_json(regime_documents)),
    "table of a regime": Reader(read_course, "any.csv", COURSES, spoiled_csv(COURSES, CELLS)),
    "motion": Reader(read_motion_file, "motion.json", as_json(MOTIONS), spoiled_json(MOTIONS)),
    "programme": Reader(read_programme_file, "programme.json", as_json(PROGRAMMES), spoiled_json(PROGRAMMES)),
    "URDF": Reader(read_model, "m.urdf", [URDF.encode()], spoiled_xml(URDF)),
    "MJCF": Reader(read_model, "m.xml", [MJCF.encode()], spoiled_xml(MJCF)),
    "SDF": Reader(read_model, "m.sdf", [SDF.encode()], spoiled_xml(SDF)),
}


def place(folder: Path) -> None:
    """The tables that the examples name."""
    for name, table in (("t.csv", COURSES[0]), ("w.csv", COURSES[2])):
        (folder / name).write_bytes(table)


@pytest.mark.parametrize("kind", [kind for kind in FILES if kind != "table of a regime"])
def test_the_examples_are_taken(kind: str, tmp_path: Path) -> None:
    reader = FILES[kind]
    place(tmp_path)
    for example in reader.examples:
        (tmp_path / reader.name).write_bytes(example)
        reader.read(tmp_path / reader.name)


@pytest.mark.parametrize("kind", FILES)
@fuzzed(200)
@given(data=st.data())
def test_values_that_nobody_would_write(
    kind: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    read_spoiled(FILES[kind], data.draw(FILES[kind].spoiled), tmp_path_factory.getbasetemp())


@pytest.mark.parametrize("kind", FILES)
@fuzzed(60)
@given(data=st.data())
def test_bytes(kind: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    spoiled = data.draw(spoiled_bytes(FILES[kind].examples))
    read_spoiled(FILES[kind], spoiled, tmp_path_factory.getbasetemp())


def read_spoiled(reader: Reader, content: str | bytes, folder: Path) -> None:
    """Write a file beside its tables and read it."""
    place(folder)
    raw = content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass")
    (folder / reader.name).write_bytes(raw)
    read_or_refuse(lambda: reader.read(folder / reader.name))


def test_half_of_a_pair_is_no_character() -> None:
    """JSON can write it, `"\\ud800"`; UTF-8 cannot."""
    with pytest.raises(MotionError, match="not JSON: "):
        read_motion(json.dumps(MOTIONS[0] | {"type": "\ud800"}), DEMO)


@fuzzed(15)
@given(text=spoiled_toml(STANDS), command=st.sampled_from(("check", "report", "modes")))
def test_the_commands_end_with_a_status(text: str, command: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    file = folder / "stand.toml"
    file.write_text(text, encoding="utf-8", errors="surrogatepass")
    more = ["-o", str(folder / "page.html"), "--derivation"] if command == "report" else []
    with soon(120):
        result = run(command, str(file), *more)
    assert result.exit_code in (0, 1, 2)
    if result.exit_code:
        assert result.stderr.startswith("error: ")
        check_message(result.stderr)


AUV6 = load(path("auv6"))
N = len(AUV6.flywheels)
STATES: list[dict[str, Any]] = [
    {"id": 7, "V": [1, 2, 3, 0.1, 0.2, 0.3], "phi": [0.5] * N, "phi_dot": [100.0] * N, "want": ["forward", "torque"]},
    {"id": "a", "angles": [0.1, 0.2, 0.3], "phi_ddot": [1.0] * N, "want": ["generalized", "measure", "inverse"]},
    {"quaternion": [1, 0, 0, 0], "tau": [0.01] * N, "want": ["coupled"]},
    {"id": None, "position": [1, 2, 3], "wrench": {"carrier": [1, 2, 3, 4, 5, 6]}, "want": ["wrench", "momentum"]},
    {"id": [1, {"a": 2}], "V_dot": [1, 2, 3, 4, 5, 6], "phi_dot": [1e5] * N, "want": ["mounts", "matrices", "forward"]},
]
LINES = st.one_of(
    spoiled_json(STATES).map(lambda text: text.encode("utf-8", "surrogatepass")),
    spoiled_bytes([json.dumps(state).encode() for state in STATES]),
)


@pytest.fixture(scope="module", params=["c", "numpy"])
def backend(request: pytest.FixtureRequest) -> Backend:
    return CBackend(AUV6) if request.param == "c" else NumpyBackend(AUV6)


def strict(line: str) -> Any:
    """Strict JSON has no NaN."""

    def constant(name: str) -> None:
        raise AssertionError(f"{name} in {line[:200]}")

    return json.loads(line, parse_constant=constant)


@fuzzed(150)
@given(data=st.lists(LINES, min_size=1, max_size=3).map(b"\n".join))
def test_eval_answers_each_line(data: bytes, backend: Backend) -> None:
    lines = [line for line in io.BytesIO(data) if line.strip()]
    with soon(60):
        answers = list(evaluate_lines(AUV6, backend, iter(lines)))
    blank = sum(not line.removeprefix(b"\xef\xbb\xbf").strip() for line in lines[:1])
    assert len(answers) == len(lines) - blank
    for answer, good in answers:
        assert "\n" not in answer
        reply = strict(answer)
        assert good == ("error" not in reply)
        assert next(iter(reply)) == "id"


@pytest.mark.parametrize("reader", ["start of simulate", "answers of a program"])
@fuzzed(100)
@given(data=LINES)
def test_readers_of_states(reader: str, data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    if reader == "start of simulate":
        file = tmp_path_factory.getbasetemp() / "start.json"
        file.write_bytes(data)
        read_or_refuse(lambda: load_start(file, AUV6))
    else:
        read_or_refuse(lambda: read_results([data], [Request(7, rest_state(AUV6), ("forward",))]))


COMMANDS = {
    "check": ("check", "{}"),
    "report": ("report", "{}", "-o", "{out}"),
    "generate": ("generate", "{}", "-o", "{out}"),
    "verify": ("verify", "{}"),
    "verify, folder": ("verify", DEMO3, "{}"),
    "eval": ("eval", "{}"),
    "verify --cost": ("verify", "{}", "--cost", "{out}"),
    "generate --project m7": ("generate", "{}", "--project", "m7", "-o", "{out}"),
    "generate --project fuzz": ("generate", "{}", "--project", "fuzz", "-o", "{out}"),
    "simulate": ("simulate", "{}", "--until", "0.001", "-o", "{out}/x.csv"),
    "regime": ("simulate", DEMO3, "--until", "0.001", "-o", "{out}/x.csv", "--regime", "{}"),
    "start": ("simulate", DEMO3, "--until", "0.001", "-o", "{out}/x.csv", "--start", "{}"),
    "replay": ("replay", DEMO3, "--log", "{}"),
    "replay, stand": ("replay", DEMO3, "--log", "{}"),
}
PLACES = ("missing", "folder", "empty", "/dev/zero", "a/b", "blank", "closed")


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_place_that_holds_nothing_to_read(command: str, place: str, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "empty").touch()
    (tmp_path / "blank").write_bytes(b" \r\n\t\n" * 9)
    (tmp_path / "closed").write_bytes(b"x")
    os.chmod(tmp_path / "closed", 0)
    target = str(tmp_path / place)
    words = [word.replace("{}", target).replace("{out}", str(tmp_path / "out")) for word in COMMANDS[command]]
    with soon(60):
        result = run(*words)
    assert result.exit_code in (1, 2)
    check_message(result.stderr)
    assert len(result.stderr.splitlines()) < 30
    assert not (tmp_path / "out").exists()
