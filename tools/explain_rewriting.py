"""Programs with a known fault for tools/explain_campaign.py: the second derivation with a line of its text replaced."""

from __future__ import annotations

import importlib
import shutil
import sys
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from unittest.mock import patch

from explain_planting import Plant, answers_of

import mahovik.contract.laws
import mahovik.proof.second
from mahovik.core.stand.model import Stand

TURNED = 'self.inputs["C"].T @ ca.DM(stand.gravity)'
STREAM = 'self.inputs["C"].T @ stream_at(stand, self.inputs["position"])'

SECOND: dict[str, tuple[str, str, str]] = {
    "gravity not turned into E1": ("system", TURNED, "ca.DM(stand.gravity)"),
    "gravity turned by C": ("system", TURNED, TURNED.replace(".T", "")),
    "stream not turned into E1": ("system", STREAM, 'stream_at(stand, self.inputs["position"])'),
    "stream, sign": ("system", STREAM, f"-({STREAM})"),
    "stream ignored": ("system", STREAM, f"0 * ({STREAM})"),
    "added mass missing before V*": ("system", "Z + fluid_Z, K + self.Lambda", "Z + fluid_Z, K"),
    "added mass missing in Phi K": ("system", "carrier += lagrange", "carrier += 0 * lagrange"),
    "run-time wrench, sign": ("system", 'ca.horzsplit(self.inputs["wrench"])', 'ca.horzsplit(-self.inputs["wrench"])'),
    "buoyancy, sign": ("buoyancy/second", "return displaced_mass *", "return -displaced_mass *"),
    "buoyancy missing": ("buoyancy/second", "return displaced_mass", "return 0"),
    "buoyancy at O1": ("buoyancy/second", "body.place(center)", "body.place(ca.SX.zeros(3))"),
    "stream ignored in damping": ("force", "ca.SX.zeros(3))) - stream", "ca.SX.zeros(3)))"),
    "leg damping missing": ("leg/second", " - ca.gradient(rayleigh, chart.q_dot)", ""),
    "leg damping, sign": ("leg/second", " - ca.gradient(rayleigh", " + ca.gradient(rayleigh"),
    "unstretched length ignored": ("leg/second", "(distance - unstretched)", "distance"),
    "linear damping missing": ("damping/second", "P -= ca.DM(damping.linear)", "P -= 0 * ca.DM(damping.linear)"),
    "quadratic damping without |V|": ("damping/second", "(V_r * ca.fabs(V_r))", "(V_r * V_r)"),
    "damping terms, sign": ("damping/second", "P += _unit", "P -= _unit"),
    "fading damping, sign": ("fading/second", "power = -across", "power = across"),
    "fading damping does not fade": ("fading/second", "/ ca.exp(law.rate * ca.norm_2(V[:3]))", ""),
    "friction, sign": ("friction/second", "[-ca.gradient(R, V)]", "[ca.gradient(R, V)]"),
    "Stribeck rise missing": ("friction/second", "R += (friction", "R += 0 * (friction"),
    "stop damping missing": ("stop/second", "- ca.gradient(R, u)", ""),
    "suspension rotation, sign": ("suspension/second", "(equilibrium.T @ C)", "(C.T @ equilibrium)"),
    "suspension displacement in E0": ("suspension/second", "C.T @ away", "away"),
    "suspension damping missing": ("suspension/second", ' + ca.DM(law.damping) @ inputs["V"])', ")"),
    "equilibrium position ignored": ("suspension/second", " - np.array(law.position)", ""),
    "mount ignored": ("bodies", "found[s.mount]", "found['carrier']"),
    "flywheel position, sign": ("bodies", "(np.array(s.position), mounting", "(-np.array(s.position), mounting"),
    "inertia about the wrong point": ("bodies", '== "center_of_mass"', '!= ""'),
    "parallel axis theorem missing": ("bodies", '== "center_of_mass"', '== ""'),
    "phi0 ignored": ("rotation", "given.theta, given.zero", "given.theta, 0.0"),
    "specific force, sign of gravity": ("points", "(acceleration - gravity)", "(acceleration + gravity)"),
    "specific force without gravity": ("points", "(acceleration - gravity)", "(acceleration)"),
    "torque without P_s": ("problems", "inertial - applied}", "inertial}"),
    "P_s of torque, sign": ("problems", "inertial - applied}", "inertial + applied}"),
    "torque, sign": ("problems", "applied + drive - still", "applied - drive - still"),
    "Z0 about O1": ("problems", "motion[:3] + ca.cross(motion[3:], r)", "motion[:3]"),
}


def rewritten(stand: Stand, names: Iterable[str] = tuple(SECOND)) -> Iterator[Plant]:
    """The second derivation and its part of the laws, copied with one place of their text replaced."""
    source, listed = (Path(str(module.__file__)) for module in (mahovik.proof.second, mahovik.contract.laws))
    for name in names:
        module, there, instead = SECOND[name]
        package = f"mutated_second_{list(SECOND).index(name)}"
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder) / package
            for original, copy in ((source.parent, root), (listed.parents[1] / "laws", root / "of_laws")):
                shutil.copytree(original, copy, ignore=shutil.ignore_patterns("__pycache__"))
            shutil.copy(listed, root / "of_laws" / "__init__.py")
            changed = root / ("of_laws" if "/" in module else "") / f"{module}.py"
            for path in root.rglob("*.py"):
                text = path.read_text(encoding="utf-8").replace("mahovik.proof.second", package)
                text = text.replace("from mahovik.contract import laws", f"from {package} import of_laws as laws")
                text = text.replace('f"mahovik.laws.', f'f"{package}.of_laws.')
                if path == changed:
                    if text.count(there) != 1:
                        raise SystemExit(f"{name}: {there!r} is not once in {module}.py")
                    text = text.replace(there, instead)
                path.write_text(text, encoding="utf-8")
            with patch.object(sys, "path", [folder, *sys.path]):
                importlib.invalidate_caches()
                found = importlib.import_module(package)
                of_laws = importlib.import_module(f"{package}.of_laws")
                of_laws.parts("second"), of_laws.parts("second", of_laws.BODY_LAWS)  # loaded while the folder exists
        yield Plant(name, "second derivation rewritten", answers_of(found.Second(stand)))
