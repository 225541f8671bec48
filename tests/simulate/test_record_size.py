"""The longest record of the flight recorder fits into the bytes that its header states, and fills them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mahovik.core.emit.recorder import recorder_files
from simulate.flights import Recorder
from toolchain.quick import quick

CASES = [("bench8", "double"), ("everything6", "float"), ("everything0", "double")]


@pytest.mark.parametrize(("name", "real"), quick(1, CASES), ids=["-".join(case) for case in CASES])
def test_a_step_with_everything_is_one_call_of_exactly_the_stated_size(name: str, real: str, tmp_path: Path) -> None:
    """One byte less, and the record leaves in two calls."""
    recorder = Recorder(name, real, tmp_path)
    layout, count = recorder.generated.layout, len(recorder.stand.flywheels)
    header = recorder_files(recorder.stand, recorder.generated)[f"{name}_recorder.h"]
    (longest,) = re.findall(r"_RECORD_BYTES +(\d+)", header)

    def step(number: int) -> int:
        """A step before which everything is written."""
        for member in layout.state.fields:
            if member.name != "attitude":
                for k in range(int(member.shape[0])):
                    getattr(recorder.x, member.name)[k] = 1e-3 * (number + k)
        recorder.x.attitude = [0.6, 0.0, 0.8, 0.0] if number % 2 else [0.8, 0.6, 0.0, 0.0]
        if layout.stream:
            recorder.table.stream = [0.1 * number, 0.2, 0.3]
        drive = [[1e-3] * count, [1] * count] if count else []
        wrench = [[1.0] * (6 * len(layout.inputs))] if layout.inputs else []
        for k in range(len(recorder.carry.rounding)):
            recorder.carry.rounding[k] = 1e-9 * (number + k)
        settings = [1e-4 * number, 2 if number % 2 else 4]
        return recorder.call("step_carried", *drive, *wrench, *settings, recorder.carry)

    assert recorder.call("start") == 0
    assert step(1) == 0
    recorder.calls.clear()
    assert step(2) == 0
    assert [len(call) for call in recorder.calls] == [int(longest)]
