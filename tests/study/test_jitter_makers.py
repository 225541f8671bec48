"""Makers' tables and structural modes: closed forms, the exact mount wrenches, what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mahovik.core.stand import Stand, load
from mahovik.proof.reference import pieces
from mahovik.proof.reference.mounts import mounts
from mahovik.stands import path
from mahovik.use.study.jitter import Jitter, Makers, View, balance, jitter
from mahovik.use.study.jitter.csv_table import JitterFileError
from mahovik.use.study.jitter.exact import mount_wrenches
from mahovik.use.study.jitter.maker import InnerModes, read_harmonics, read_inner_modes
from mahovik.use.study.jitter.structure import read_structure
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.speeds import read_speeds
from study.test_jitter import M_CARRIER, one_wheel

OMEGA = 240.0


def run(stand: Stand, speed: str, makers: Makers, quantity: str, point: str = "eye") -> Jitter:
    seen = View.of(places(stand, [point])[0], quantity)
    asked = read_speeds(stand, [speed])
    return jitter(stand, asked, 3, seen, makers=makers)


def table(folder: Path, text: str) -> Path:
    file = folder / "table.csv"
    file.write_text(text)
    return file


def test_mount_wrenches_are_those_of_the_reference() -> None:
    stand = load(path("bench8"))
    found = balance(stand, [60.0, -41.2, 20.1, 0, 0, 0, 0, 0], order=3)
    torus = found.torus
    rates = 1j * found.frequencies[:, None] * found.c
    ours = mount_wrenches(found, torus.values(found.c), torus.values(rates)[:, 6:])
    own = found.scene.chart.mechanics.tables.Lm
    for j in (0, 11, 57):
        at = pieces(stand, found.state(torus.nodes[j]))
        V_dot = torus.values(rates)[j, 6:]
        wanted = mounts(at, V_dot, np.zeros(8))
        for s in range(8):
            assert ours[j, s] == pytest.approx(-own[s] @ wanted[s], rel=1e-9, abs=1e-9)


MODES = "frequency [Hz],damping [-],modal mass [kg],{}\n{},0,{},{}\n"
COLUMNS = ",".join(f"{name} {part} [{'rad/m' if part[0] == 'r' else '-'}]" for name in ("w", "eye") for part in
                   ("x", "y", "z", "rx", "ry", "rz"))  # fmt: skip


@pytest.mark.parametrize("speed", [f"w={OMEGA}", f"w=200..{OMEGA}"])
def test_a_mode_that_is_the_rigid_carrier_moves_as_the_carrier(speed: str, tmp_path: Path) -> None:
    """Shape: translation along x, modal mass: the carrier's, no stiffness. The mount wrench moves both alike."""
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format(COLUMNS, 1e-6, M_CARRIER, "1,0,0,0,0,0,1,0,0,0,0,0"))
    found = run(stand, speed, Makers(structure=read_structure(file, stand)), "displacement").lines
    alone = run(stand, speed, Makers(), "displacement").lines
    axes = places(stand, ["eye"])[0].axes
    first = [each.names.index(each.names[0]) for each in (found, alone)]
    more, rigid = (each.amplitude[-1, i] @ axes.T for each, i in zip((found, alone), first, strict=True))
    assert more == pytest.approx(rigid * [2.0, 1.0, 1.0], rel=1e-6, abs=1e-15)


@pytest.mark.parametrize("speed", [f"w={OMEGA}", f"w=-{OMEGA}", f"w=200..{OMEGA}"])
def test_a_table_with_the_unbalance_gives_the_unbalance(speed: str, tmp_path: Path) -> None:
    """Order 1 of the table takes the place of the wheel's own: 5 g cm are 5e-5 N/(rad/s)^2."""
    stand = one_wheel(tmp_path, 'static = "5 g cm", dynamic = "20 g cm^2"')
    file = table(
        tmp_path, "order [-],radial force [N/(rad/s)^2],radial moment [N m/(rad/s)^2]\n1,5e-5,2e-6\n2.5,1e-5,0\n"
    )
    makers = Makers({"w": read_harmonics(file)})
    for quantity in ("displacement", "angle"):
        found = run(stand, speed, makers, quantity).lines
        own = run(stand, speed, Makers(), quantity).lines
        first = [i for i, name in enumerate(found.names) if name.order == 1.0]
        wanted = max(own.sizes[-1], key=np.linalg.norm)
        got = max(found.sizes[-1, first], key=np.linalg.norm)
        assert got == pytest.approx(wanted, rel=1e-3, abs=1e-12)
    at = next(i for i, name in enumerate(found.names) if name.order == 2.5)
    assert found.frequency[-1, at] == pytest.approx(2.5 * OMEGA / (2.0 * np.pi))


def test_units_of_a_table_are_converted(tmp_path: Path) -> None:
    one = read_harmonics(table(tmp_path, "order,radial force [N/(rad/s)^2],tolerance [%]\n1,1e-5,20\n"))
    rpm = 1e-5 * (np.pi / 30) ** 2
    two = read_harmonics(table(tmp_path, f"order [-],radial force [mN/rpm^2]\n1,{1e3 * rpm!r}\n"))
    assert one.amplitude == pytest.approx(two.amplitude, rel=1e-12)
    assert one.tolerance.tolist() == [0.2]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("order,radial force\n1,1\n", 'column "radial force": no unit; expected a force by the square of a speed'),
        ("order,radial force [N]\n1,1\n", "expected a force by the square of a speed"),
        ("order,radial force [N/Hz^2]\n1,1\n", "Hz may be turns or radians"),
        ("order,radiale force [N/rpm^2]\n1,1\n", 'unknown column "radiale force [N/rpm^2]", did you mean'),
        ("radial force [N/rpm^2]\n1\n", 'no column "order"'),
        ("order,radial force [N/rpm^2]\n0,1\n", "row 2: order 0"),
        ("order,radial force [N/rpm^2]\n1,x\n", '"x" is not a number'),
        ("order,radial force [N/rpm^2]\n1\n", "1 cells, but the header has 2"),
        ("order,radial force [N/rpm^2]\n1,1\n1,2\n", "order 1 appears twice"),
    ],
)
def test_bad_harmonics_are_refused_in_one_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(JitterFileError) as caught:
        read_harmonics(table(tmp_path, text))
    assert words in str(caught.value) and str(caught.value).count("\n") == 0


def test_a_shape_of_some_columns_says_which_to_add(tmp_path: Path) -> None:
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format("w z [-],w rx [rad/m]", 10, 5, "1,0"))
    with pytest.raises(JitterFileError) as caught:
        read_structure(file, stand)
    assert 'mode shape of "w" has z, rx alone, expected all of x, y, z, rx, ry, rz; add columns w x, w y, w ry' in str(
        caught.value
    )


def rotor(inner: InnerModes, omega: float, speed: float) -> tuple[float, float]:
    """Gains of a forward and a backward turning moment, by the two real equations of the rocking rotor."""
    own, damping = inner.modes["rocking"]
    g = inner.polar * speed
    # theta_2'' + g theta_3' + ..., theta_3'' - g theta_2' + ...: unit transverse inertia
    D = np.array([
        [own**2 - omega**2 + 2j * damping * own * omega, 1j * omega * g],
        [-1j * omega * g, own**2 - omega**2 + 2j * damping * own * omega],
    ])  # fmt: skip
    through = own**2 + 2j * damping * own * omega
    found = []
    for moment in ([1.0, -1j], [1.0, 1j]):
        theta = np.linalg.solve(D, np.array(moment))
        found.append(abs(through * theta[0]))
    return found[0], found[1]


def test_rocking_splits_into_whirls(tmp_path: Path) -> None:
    inner = read_inner_modes(
        table(tmp_path, "mode,frequency [Hz],damping [-],polar ratio [-]\nrocking,40,0.01,1.8\nradial,200,0.02,\n")
    )
    speed = 300.0
    for omega in (100.0, 250.0, 700.0):
        w = np.array([0, 0, 0, 0, 1, -1j]), np.array([0, 0, 0, 0, 1, 1j])
        passed = [abs(inner.transmit(each, np.array(omega), np.array(speed))[4]) for each in w]
        assert passed == pytest.approx(rotor(inner, omega, speed), rel=1e-9)
