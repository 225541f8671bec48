"""Pinocchio and MuJoCo as judges: multibody programs of others, given the same bodies, against the generated C.

They get each body's mass, centre of mass, tensor about it and place on the carrier, and know nothing of docs/model.md,
into whose terms their answers are converted here. A free carrier has a joint of six freedoms, a held one a chain of
joints, one a freedom; either stands at the pose of the state, with all coordinates zero. Flywheels are on hinges. Of
forces the programs know gravity and run-time wrenches: a stand is judged without its laws, fluid and stream, and the
report says without which. Neither program is a dependency: `pip install pin mujoco`, the extra `judges`.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.contract.limits import DOUBLE
from mahovik.core.stand.hold import is_closed, twists
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.masses import inertia_about_center, pose
from mahovik.core.stand.model import Hold, Stand, State
from mahovik.core.stand.physical import LEAST_EIGENVALUE, least_eigenvalue
from mahovik.errors import UsageError
from mahovik.proof.verify.backends import with_all_inputs
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, Report, difference, report
from mahovik.proof.verify.draw import draw, turns_of
from mahovik.proof.verify.harness import Progress
from mahovik.proof.verify.scales import ROUNDINGS, Scales
from mahovik.proof.verify.states import Backend, Request

Array = NDArray[np.float64]
Values = dict[str, Any]
States = Sequence[tuple[str, State]]

NEAR = 10.0
"""m: a coordinate of the carrier in E0 is at most this, since the programs add its position to that of every body."""

LAST_PLACES, NEIGHBOURS = 2.0**-51, 3
"""Relative distance of states by which rounding is measured, and how many there are."""

POINT = ("position", "C", "twist", "specific_force", "angular_acceleration")
"""What `points` of `eval` says of a point."""


def missing(stand: Stand) -> list[str]:
    """Features of the stand that the programs do not know."""
    names = [f"{body.name}: added_mass" for body in stand.bodies if getattr(body, "added_mass", None) is not None]
    for law in body_laws():
        names += [f"{name}: {law.name}" for name in law.bearers(stand)]
    names += ["stream"] * (stand.stream is not None)
    return names + [law.name for law in carrier_laws() if law.short(stand)]


def bare_stand(stand: Stand) -> Stand:
    """The stand without what `missing` names."""

    def bare(body: Any) -> Any:
        return replace(body, laws=(), **({"added_mass": None} if hasattr(body, "added_mass") else {}))

    instruments, flywheels = (tuple(map(bare, bodies)) for bodies in (stand.instruments, stand.flywheels))
    without = replace(stand, stream=None, profile=None, laws=(), carrier=bare(stand.carrier))
    return replace(without, instruments=instruments, flywheels=flywheels)


def attitude(stand: Stand, state: State) -> Rotation:
    """C of the carrier."""
    if state.quaternion is not None:
        return Rotation.from_quat(state.quaternion, scalar_first=True)
    return Rotation.from_euler(turns_of(stand.angles), state.angles or (0.0, 0.0, 0.0))


def places(stand: Stand) -> dict[str, tuple[Array, Array]]:
    """Where instruments and points are on the carrier: position (3) and axes (3x3) in E1."""
    poses = {body.name: pose(stand, body) for body in stand.instruments}
    for point in stand.points:
        origin, axes = poses.get(point.mount, (np.zeros(3), np.eye(3)))
        turn = Rotation.from_euler("ZYX", point.angles).as_matrix()
        poses[point.name] = origin + axes @ np.array(point.position), axes @ turn
    return poses


def chain(hold: Hold) -> list[tuple[Array, Array, float | None, float]]:
    """A joint for each freedom, which bears the next: axis (unit vector) and a point on it in E1, advance along it in
    m/rad (0: a hinge; None: it only slides), its velocity at u = 1. UsageError: no chain of joints moves as V = S u.

    A twist (v, omega) turns about the axis along omega through c = omega x v / omega^2, with the advance
    h = omega . v / omega^2: v = h omega + c x omega.
    """
    if hold.freedoms and not is_closed(hold):
        raise UsageError("no chain of joints has these freedoms, expected a closed set of freedoms")
    joints: list[tuple[Array, Array, float | None, float]] = []
    for freedom in hold.freedoms:
        if freedom.kind != "twist":
            axis = np.array(freedom.direction) / np.linalg.norm(freedom.direction)
            joints.append((axis, np.array(hold.pivot), 0.0 if freedom.kind == "turn" else None, 1.0))
            continue
        v, omega = np.split(np.array(freedom.twist), 2)
        along = omega if omega.any() else v
        rate, advance = float(np.linalg.norm(along)), float(omega @ v) / float(along @ along)
        advance = 0.0 if abs(advance) < 1e-15 else advance  # of a hinge, but for rounding
        joints.append((along / rate, np.cross(omega, v) / rate**2, advance if omega.any() else None, rate))
    return joints


class Program:
    """A program of others with the model of one stand, whose carrier has m freedoms, and u = V where it is free."""

    name: str
    version: str

    def __init__(self, stand: Stand) -> None:
        self.stand, self.free, self.N = stand, stand.hold is None, len(stand.flywheels)
        self.chain, self.S = ([], np.eye(6)) if stand.hold is None else (chain(stand.hold), twists(stand.hold))
        self.rates = np.ones(6) if self.free else np.array([rate for *_, rate in self.chain])
        self.along = np.linalg.pinv(self.S)  # u_dot of V_dot = S u_dot
        self._neighbours: list[Self] = []

    def neighbours(self, scales: Scales) -> list[Self]:
        """The program with stands some last places away: what their answers differ by is its rounding."""
        stands = [scales.change(self.stand, LAST_PLACES) for _ in range(NEIGHBOURS - len(self._neighbours))]
        self._neighbours += [type(self)(replace(stand, hold=self.stand.hold)) for stand in stands]
        return self._neighbours

    def solve(self, state: State, velocities: Array) -> tuple[Array, Array]:
        """Set the state and velocities of the joints (m + N, the carrier's first); returns their mass matrix, and their
        accelerations under the drive torques.
        """
        raise NotImplementedError

    def motion(self, accelerations: Array) -> Values:
        """The state with these accelerations of the joints: V_dot and the `wrench` of its joint on the carrier, in E1
        about O1; mount_wrench (N x 6) as in `eval`; what POINT names by the name of each point.
        """
        raise NotImplementedError

    def answers(self, state: State) -> dict[str, Values]:
        """Values by want of `eval`; of `matrices` also the `bias` M V + J phi' - F. Not every stand has all of them."""
        m, phi_ddot = len(self.rates), np.array(state.phi_ddot)
        u, u_dot = (state.V, state.V_dot) if self.free else (state.u, state.u_dot)
        full, coupled = self.solve(state, np.array([*(self.rates * u), *state.phi_dot]))
        idle = self.motion(np.zeros(m + self.N))
        K, I = full[:m, :m], full[:m, m:]
        forward = np.linalg.solve(K, -(self.S / self.rates).T @ idle["wrench"] - I @ phi_ddot)

        def motion(u_dot: Any, phi_ddot: Array) -> Values:
            joints = self.rates * (u_dot - self.along @ idle["V_dot"])  # twists of a chain change while it moves
            return self.motion(np.concatenate([joints, phi_ddot]))

        def response(accelerations: Array) -> Values:
            moved, key = self.motion(accelerations), "V_dot" if self.free else "u_dot"
            return {key: self.along @ moved["V_dot"], "phi_ddot": accelerations[m:], "reaction": moved["wrench"]}

        demanded = motion(np.array(u_dot), phi_ddot)
        matrices = {"bias": motion(np.zeros(m), np.zeros(self.N))["wrench"]} | ({"K": K, "I": I} if self.free else {})
        return {
            "matrices": matrices,
            "forward": response(np.concatenate([forward, phi_ddot])),
            "coupled": response(coupled),
            "torque": {"tau": demanded["mount_wrench"][:, 3]},
            "mounts": {"mount_wrench": demanded["mount_wrench"]},
            "points": {"points": {name: dict(zip(POINT, at, strict=True)) for name, at in demanded["points"].items()}},
        }


class Pinocchio(Program):
    """Free-flyer, or a composite of prismatic and helical joints, whose accelerations are V_dot; CRBA, ABA, RNEA."""

    name = "pinocchio"

    def __init__(self, stand: Stand) -> None:
        super().__init__(stand)
        self.pin = pin = importlib.import_module("pinocchio")
        if not len(self.rates):
            raise UsageError("Pinocchio has no joint without freedoms")
        self.version, self.model = pin.__version__, pin.Model()
        self.model.gravity.linear = np.array(stand.gravity)
        joints = pin.JointModelFreeFlyer() if self.free else pin.JointModelComposite()
        self.E1 = pin.SE3.Identity()  # in the frame of the last joint
        for axis, point, advance, _ in self.chain:
            slide, helix = pin.JointModelPrismaticUnaligned, pin.JointModelHelicalUnaligned
            joint = slide(axis) if advance is None else helix(axis, advance)
            joints.addJoint(joint, self.E1 * pin.SE3(np.eye(3), point))
            self.E1 = pin.SE3(np.eye(3), -point)
        self.model.addJoint(0, joints, pin.SE3.Identity(), "joint of the carrier")
        self.bodies = {}  # number of the joint, and place in its frame
        for body in stand.bodies:
            number, place = 1, self.E1 * pin.SE3(*pose(stand, body)[::-1])
            inertia = pin.Inertia(body.mass, np.array(body.center_of_mass), inertia_about_center(body))
            if body in stand.flywheels:
                number, place = self.model.addJoint(1, pin.JointModelRX(), place, body.name), pin.SE3.Identity()
            self.model.appendBodyToJoint(number, inertia, place)
            self.bodies[body.name] = number, place
        self.data = self.model.createData()

    def solve(self, state: State, velocities: Array) -> tuple[Array, Array]:
        pin, model, data, turn = self.pin, self.model, self.data, attitude(self.stand, state)
        model.jointPlacements[1] = pin.SE3(turn.as_matrix(), np.array(state.position))
        self.q, self.v = pin.neutral(model), velocities
        self.q[model.nq - self.N :] = state.phi
        self.outside = [pin.Force.Zero() for _ in range(model.njoints)]
        for name, wrench in state.wrench.items():
            number, place = self.bodies[name]
            self.outside[number] += place.act(pin.Force(np.array(wrench)))
        full = np.triu(pin.crba(model, data, self.q))  # the part that it fills
        tau = np.array([*np.zeros(len(self.rates)), *state.tau])
        return full + np.triu(full, 1).T, pin.aba(model, data, self.q, self.v, tau, self.outside).copy()

    def motion(self, accelerations: Array) -> Values:
        pin, model, data, local = self.pin, self.model, self.data, self.pin.ReferenceFrame.LOCAL
        pin.rnea(model, data, self.q, self.v, accelerations, self.outside)
        turns = {k: model.jointPlacements[k].actInv(data.liMi[k]) for k in range(2, model.njoints)}
        mounts = [turn.act(data.f[k]).vector for k, turn in turns.items()]  # in axes that do not turn
        points, wrench = {}, self.E1.actInv(data.f[1]).vector.copy()
        pin.forwardKinematics(model, data, self.q, self.v, accelerations)
        for name, (position, axes) in places(self.stand).items():
            place = self.E1 * pin.SE3(axes, position)
            twist = pin.getFrameVelocity(model, data, 1, place, local).vector
            moved, at = pin.getFrameClassicalAcceleration(model, data, 1, place, local), data.oMi[1] * place
            felt = moved.linear - at.rotation.T @ np.array(self.stand.gravity)
            points[name] = at.translation, at.rotation, twist.copy(), felt, moved.angular.copy()
        V_dot = self.E1.actInv(data.a[1]).vector.copy()
        return {"V_dot": V_dot, "wrench": wrench, "mount_wrench": np.reshape(mounts, (-1, 6)), "points": points}


def mujoco_spec(stand: Stand) -> Any:
    """The stand as MjSpec, its body 1, the carrier, without a joint.

    Principal axes are found here: those of MuJoCo's compiler are good to 1e-12 only.
    """
    mujoco = importlib.import_module("mujoco")
    spec = mujoco.MjSpec()
    spec.modelname, spec.option.gravity = stand.name, stand.gravity
    spec.option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    carrier = spec.worldbody.add_body(name=stand.carrier.name)
    for body in stand.bodies:
        (position, axes), part = pose(stand, body), carrier
        if body is not stand.carrier:
            part = carrier.add_body(name=body.name, pos=position, quat=_quaternion(axes))
        if body in stand.flywheels:
            part.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=(1.0, 0.0, 0.0))
        moments, axes = np.linalg.eigh(inertia_about_center(body))
        if body.mass > 0.0 or np.any(moments):
            part.mass, part.ipos, part.inertia = body.mass, body.center_of_mass, moments
            part.iquat, part.explicitinertial = _quaternion(axes * np.linalg.det(axes)), True
    for name, (position, axes) in places(stand).items():
        carrier.add_site(name=name, pos=position, quat=_quaternion(axes))
    return spec


def _quaternion(axes: Array) -> Any:
    """Unit quaternion, w first, of a rotation (3x3)."""
    return Rotation.from_matrix(axes).as_quat(scalar_first=True)


class Mujoco(Program):
    """Slides and a ball, or slides and hinges; mj_forward, mj_fullM, mj_rnePostConstraint.

    Its wrenches are in E0, about centres of mass; its accelerations have minus gravity in them, as of accelerometers.
    """

    name = "mujoco"

    def __init__(self, stand: Stand) -> None:
        super().__init__(stand)
        self.mujoco = importlib.import_module("mujoco")
        self.version = self.mujoco.__version__
        spec, kinds = mujoco_spec(stand), self.mujoco.mjtJoint
        carrier = spec.worldbody.first_body()
        for axis in np.eye(3) if self.free else ():
            carrier.add_joint(type=kinds.mjJNT_SLIDE, axis=axis)
        if self.free:
            carrier.add_joint(type=kinds.mjJNT_BALL)
        for axis, point, advance, _ in self.chain:
            if advance:
                raise UsageError("MuJoCo has no screw, expected freedoms that turn or slide")
            kind = kinds.mjJNT_SLIDE if advance is None else kinds.mjJNT_HINGE
            carrier.add_joint(type=kind, axis=axis, pos=point)
        self.model = spec.compile()
        self.data = self.mujoco.MjData(self.model)

    def solve(self, state: State, velocities: Array) -> tuple[Array, Array]:
        mujoco, model, data, turn = self.mujoco, self.model, self.data, attitude(self.stand, state)
        model.body_pos[1], model.body_quat[1] = state.position, turn.as_quat(scalar_first=True)
        data.qpos[model.nq - self.N :], data.qvel[:], data.xfrc_applied[:] = state.phi, velocities, 0.0
        data.qfrc_applied[len(self.rates) :] = state.tau
        mujoco.mj_kinematics(model, data)
        for name, wrench in state.wrench.items():
            number, force = model.body(name).id, np.array(wrench[:3])
            axes, moment = data.xmat[number].reshape(3, 3), wrench[3:] - np.cross(model.body_ipos[number], force)
            data.xfrc_applied[number] = [*(axes @ force), *(axes @ moment)]
        mujoco.mj_forward(model, data)
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        return full, data.qacc.copy()

    def motion(self, accelerations: Array) -> Values:
        mujoco, model, data, kinds = self.mujoco, self.model, self.data, self.mujoco.mjtObj
        data.qacc[:] = accelerations
        mujoco.mj_rnePostConstraint(model, data)

        def read(function: Callable[..., None], kind: Any, number: int) -> Array:
            twist = np.zeros(6)
            function(model, data, kind, number, twist, 1)  # in the object's axes, angular part first
            return np.roll(twist, 3)

        def wrench(number: int, axes: Array) -> Array:
            moment, force = np.split(data.cfrc_int[number], 2)  # about the centre of mass of all bodies
            moment = moment + np.cross(data.subtree_com[1] - data.xpos[number], force)
            return np.concatenate([axes.T @ force, axes.T @ moment])

        C, points = data.xmat[1].reshape(3, 3), {}
        v, omega = np.split(read(mujoco.mj_objectVelocity, kinds.mjOBJ_XBODY, 1), 2)
        V_dot = read(mujoco.mj_objectAcceleration, kinds.mjOBJ_XBODY, 1)
        V_dot[:3] += C.T @ np.array(self.stand.gravity) - np.cross(omega, v)
        mounts = [wrench(model.body(s.name).id, C @ pose(self.stand, s)[1]) for s in self.stand.flywheels]
        for name in places(self.stand):
            site = model.site(name).id
            twist = read(mujoco.mj_objectVelocity, kinds.mjOBJ_SITE, site)
            felt, turning = np.split(read(mujoco.mj_objectAcceleration, kinds.mjOBJ_SITE, site), 2)
            points[name] = data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy(), twist, felt, turning
        return {"V_dot": V_dot, "wrench": wrench(1, C), "mount_wrench": np.reshape(mounts, (-1, 6)), "points": points}


PROGRAMS: dict[str, type[Program]] = {"pinocchio": Pinocchio, "mujoco": Mujoco}


def verify_judges(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    names: Sequence[str] = tuple(PROGRAMS),
    progress: Progress | None = None,
) -> Report:
    """Checks of the generated C against the programs, on the stand without what they do not know.

    A program that does not take the stand has one check, which says why; if none does, nothing was compared and the
    report does not pass. UsageError: a program is not installed.
    """
    left_out, bare = missing(stand), with_all_inputs(bare_stand(stand))
    checks, programs = [], []
    for name in names:
        try:
            if left_out and least_eigenvalue(bare)[0] < LEAST_EIGENVALUE:
                raise UsageError(f"the stand without {', '.join(left_out)} has no positive definite mass matrix")
            programs.append(PROGRAMS[name](bare))
        except ImportError as error:
            raise UsageError(f"judges: {name} is not installed ({error.name}): pip install pin mujoco") from None
        except (UsageError, ValueError) as error:  # MuJoCo's of a stand that it does not compile
            checks.append(Check(name, "all quantities", words=str(error)))
    if programs:
        checks += judge(bare, CBackend(bare), programs, draw(bare, seed, count), progress)
    judged = f"generated C against {', '.join([f'{program.name} {program.version}' for program in programs] or names)}"
    return replace(report(bare, judged, seed, count, DOUBLE.value, checks), left_out=tuple(left_out))


def judge(
    stand: Stand, backend: Backend, programs: Sequence[Program], states: States, progress: Progress | None = None
) -> list[Check]:
    """A check for each program and quantity."""
    checks: dict[tuple[str, str], Check] = {}
    scales = Scales(stand)
    for done, (name, drawn) in enumerate(states):
        state = replace(drawn, position=tuple(np.clip(drawn.position, -NEAR, NEAR).tolist()))
        answers = [(program, program.answers(state)) for program in programs]
        for want in answers[0][1]:
            ours, measured = backend.evaluate(state, (want,)), scales.want(state, want)
            scale = dict(measured.scales) if measured is not None else {}
            if want == "matrices":
                M, J = (np.reshape(ours[key], (6, -1)) for key in "MJ")
                ours["bias"] = M @ np.array(state.V) + J @ np.array(state.phi_dot) - np.array(ours["F"])
                terms = scales.measure(state, lambda _, __, at: {"bias": at.M @ at.V_r + at.J @ at.phi_dot - at.F})
                scale["bias"] = terms.scales["bias"]
            for program, answer in answers:
                for quantity, value in answer[want].items():
                    if quantity not in ours or not len(value) or not np.size(value):  # no points, freedoms, flywheels
                        continue
                    check = Check(program.name, f"{want} {quantity}", DOUBLE.value)
                    check = checks.setdefault((program.name, check.quantity), check)
                    off, words = difference(ours[quantity], value, scale[quantity])
                    if off > check.limit:  # MuJoCo adds up about points that are far from one another
                        again = (p.answers(scales.moved(state, LAST_PLACES))[want] for p in program.neighbours(scales))
                        noise = max(difference(near[quantity], value, scale[quantity])[0] for near in again)
                        off /= max(1.0, ROUNDINGS * noise / check.limit)
                    check.note(off, name, words, Request(name, state, (want,)))
        if progress is not None:
            progress(done + 1, len(states))
    return [check for program in programs for check in checks.values() if check.judged == program.name]
