"""Judges a stand with a law that is no part of the package: as a program, this adds its folder and its row."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

import mahovik.laws
from mahovik.contract import laws as rows

mahovik.laws.__path__.append(str(Path(__file__).parent / "added"))
rows.BODY_LAWS += ("tug",)  # type: ignore[assignment]  # the row

from mahovik.core.lower.fmu_variables import laws  # noqa: E402
from mahovik.core.lower.law_arrays import LawArrays  # noqa: E402
from mahovik.core.stand import dumps, identities, loads  # noqa: E402
from mahovik.core.stand.files import parse_toml  # noqa: E402
from mahovik.core.stand.laws import body_laws  # noqa: E402
from mahovik.core.stand.numbers import StandNumbers  # noqa: E402
from mahovik.core.stand.random import BARE, Features, random_stand  # noqa: E402
from mahovik.proof.second import Second  # noqa: E402
from mahovik.proof.verify.c_backend import InterpreterBackend  # noqa: E402
from mahovik.proof.verify.draw import draw  # noqa: E402
from mahovik.proof.verify.harness import judge  # noqa: E402
from mahovik.use.control.mismatch import with_mismatch  # noqa: E402
from verify.build import generated  # noqa: E402

if __name__ == "__main__":
    tug = body_laws()[-1]
    stand = random_stand(np.random.default_rng(2), 2, Features(instruments=1, gravity=True, flow=True))
    assert identities(loads(dumps(stand))) == identities(stand)
    assert len(tug.of(stand)) == 4
    without = replace(stand, carrier=stand.carrier.without_laws(tug))
    assert identities(stand).physics != identities(without).physics
    assert "carrier.tug.force[2]" in {number.path for number in StandNumbers(stand, parse_toml(dumps(stand)))}
    assert with_mismatch(stand, 0.01, 1).carrier.law(tug) != stand.carrier.law(tug)
    alone = replace(
        random_stand(np.random.default_rng(2), 1, BARE),
        carrier=replace(stand.carrier, laws=tuple(filter(None, [stand.carrier.law(tug)]))),
    )
    (carrier, *_) = LawArrays(alone).bodies
    assert carrier is not None and not carrier.rate(np.ones((1, 6))).any()  # it reads no speed
    lowered = generated(stand)
    shown = {member.name: member for member in laws(stand, lowered.layout, lowered.values)}
    force = vars(stand.carrier.law(tug))["force"]
    assert shown["carrier.tug.force[2]"].value == force[1]  # of an FMU
    assert shown["carrier.tug.force[2]"].unit.name == "N"
    backend = InterpreterBackend(lowered)
    checks = judge(stand, backend, draw(stand, 3, 5), ("forward", "torque"), second=Second(stand))
    print(*(check.words for check in checks if check.failed), "judged", sep="\n")
