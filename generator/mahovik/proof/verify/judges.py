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
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.contract import laws
from mahovik.contract.limits import DOUBLE
from mahovik.core.stand.definite import least_eigenvalue
from mahovik.core.stand.frames import pose
from mahovik.core.stand.hold import is_closed, twists
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.physical import LEAST_EIGENVALUE
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof import reference
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, report
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Request

Array = NDArray[np.float64]
Values = dict[str, Any]
States = Sequence[tuple[str, State]]

LIMIT, NEAR = DOUBLE.value, 10.0
"""Accepted difference, a share of its scale; coordinate of the carrier in E0, m, beyond which it is put there, since
the programs add its position to that of every body."""

SEQUENCES = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""Attitude sequences as SciPy names them; capitals: about moving axes."""

POINT = ("position", "C", "twist", "specific_force", "angular_acceleration")
"""What `points` of `eval` says of a point."""


def missing(stand: Stand) -> list[str]:
    """Features of the stand that the programs do not know."""
    names = [f"{body.name}: added_mass" for body in stand.bodies if getattr(body, "added_mass", None) is not None]
    for law in laws.parts("text", laws.BODY_LAWS):
        names += [f"{name}: {law.NAME}" for name in law.bearers(stand)]
    names += ["stream"] * (stand.stream is not None)
    return names + [law.NAME for law in laws.parts("text") if law.short(stand)]


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
    return Rotation.from_euler(SEQUENCES[stand.angles], state.angles or (0.0, 0.0, 0.0))


def places(stand: Stand) -> dict[str, tuple[Array, Array]]:
    """Where instruments and points are on the carrier: position (3) and axes (3x3) in E1."""
    found = {body.name: pose(stand, body) for body in stand.instruments}
    for point in stand.points:
        origin, axes = found.get(point.mount, (np.zeros(3), np.eye(3)))
        own = Rotation.from_euler("ZYX", point.angles).as_matrix()
        found[point.name] = origin + axes @ np.array(point.position), axes @ own
    return found


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
        self.chain = [] if stand.hold is None else chain(stand.hold)
        self.rates = np.ones(6) if self.free else np.array([rate for *_, rate in self.chain])
        self.S = np.eye(6) if stand.hold is None else twists(stand.hold)
        self.along = np.linalg.pinv(self.S)  # u_dot of V_dot = S u_dot

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
        """Values by want of `eval`; of `matrices` also the `bias` M V + J phi' - F."""
        u, u_dot = (state.V, state.V_dot) if self.free else (state.u, state.u_dot)
        m, phi_ddot = len(self.rates), np.array(state.phi_ddot)
        full, coupled = self.solve(state, np.array([*(self.rates * u), *state.phi_dot]))
        idle = self.motion(np.zeros(m + self.N))
        K, I, twists_of_joints = full[:m, :m], full[:m, m:], self.S / self.rates
        forward = np.linalg.solve(K, -twists_of_joints.T @ idle["wrench"] - I @ phi_ddot)

        def motion(u_dot: Any, phi_ddot: Array) -> Values:
            joints = self.rates * (u_dot - self.along @ idle["V_dot"])  # twists of a chain change while it moves
            return self.motion(np.concatenate([joints, phi_ddot]))

        def response(accelerations: Array) -> Values:
            found, key = self.motion(accelerations), "V_dot" if self.free else "u_dot"
            return {key: self.along @ found["V_dot"], "phi_ddot": accelerations[m:], "reaction": found["wrench"]}

        given = motion(np.array(u_dot), phi_ddot)
        matrices = {"bias": motion(np.zeros(m), np.zeros(self.N))["wrench"]} | ({"K": K, "I": I} if self.free else {})
        return {
            "matrices": matrices,
            "forward": response(np.concatenate([forward, phi_ddot])),
            "coupled": response(coupled),
            "torque": {"tau": given["mount_wrench"][:, 3]},
            "mounts": {"mount_wrench": given["mount_wrench"]},
            "points": {"points": {name: dict(zip(POINT, own, strict=True)) for name, own in given["points"].items()}},
        }


class Pinocchio(Program):
    """Free-flyer, or a composite of prismatic and helical joints, whose accelerations are V_dot; CRBA, ABA, RNEA."""

    name = "pinocchio"

    def __init__(self, stand: Stand) -> None:
        super().__init__(stand)
        self.pin = pin = importlib.import_module("pinocchio")
        if not (self.free or self.chain):
            raise UsageError("Pinocchio has no joint without freedoms")
        self.version, self.model = pin.__version__, pin.Model()
        self.model.gravity.linear = np.array(stand.gravity)
        joint = pin.JointModelFreeFlyer() if self.free else pin.JointModelComposite()
        self.E1 = pin.SE3.Identity()  # in the frame of the joint
        for axis, point, advance, _ in self.chain:
            slide, helix = pin.JointModelPrismaticUnaligned, pin.JointModelHelicalUnaligned
            own = slide(axis) if advance is None else helix(axis, advance)
            joint.addJoint(own, self.E1 * pin.SE3(np.eye(3), point))
            self.E1 = pin.SE3(np.eye(3), -point)
        self.model.addJoint(0, joint, pin.SE3.Identity(), "joint of the carrier")
        self.fixed = {}
        for body in stand.bodies:
            place = self.E1 * pin.SE3(*pose(stand, body)[::-1])
            inertia = pin.Inertia(body.mass, np.array(body.center_of_mass), inertia_about_center(body))
            if body in stand.flywheels:
                number = self.model.addJoint(1, pin.JointModelRX(), place, body.name)
                self.model.appendBodyToJoint(number, inertia, pin.SE3.Identity())
            else:
                self.fixed[body.name] = place
                self.model.appendBodyToJoint(1, inertia, place)
        self.data = self.model.createData()

    def solve(self, state: State, velocities: Array) -> tuple[Array, Array]:
        pin, model, data, turn = self.pin, self.model, self.data, attitude(self.stand, state)
        model.jointPlacements[1] = pin.SE3(turn.as_matrix(), np.array(state.position))
        self.q, self.v, self.outside = pin.neutral(model), velocities, pin.StdVec_Force()
        self.q[model.nq - self.N :] = state.phi
        forces = [pin.Force.Zero() for _ in range(model.njoints)]
        for name, wrench in state.wrench.items():
            number = 1 if name in self.fixed else model.getJointId(name)
            forces[number] += self.fixed.get(name, pin.SE3.Identity()).act(pin.Force(np.array(wrench)))
        self.outside.extend(forces)
        full = np.triu(pin.crba(model, data, self.q))  # the part that it fills
        tau = np.array([*np.zeros(len(self.rates)), *state.tau])
        return full + np.triu(full, 1).T, pin.aba(model, data, self.q, self.v, tau, self.outside).copy()

    def motion(self, accelerations: Array) -> Values:
        pin, model, data, own = self.pin, self.model, self.data, self.pin.ReferenceFrame.LOCAL
        pin.rnea(model, data, self.q, self.v, accelerations, self.outside)
        turns = [pin.SE3(pin.rpy.rpyToMatrix(phi, 0.0, 0.0), np.zeros(3)) for phi in self.q[model.nq - self.N :]]
        mounts = [turn.act(data.f[2 + k]).vector.copy() for k, turn in enumerate(turns)]  # in axes that do not turn
        points, wrench = {}, self.E1.actInv(data.f[1]).vector.copy()
        pin.forwardKinematics(model, data, self.q, self.v, accelerations)
        for name, (position, axes) in places(self.stand).items():
            place = self.E1 * pin.SE3(axes, position)
            twist = pin.getFrameVelocity(model, data, 1, place, own).vector
            moved, pose_in_E0 = pin.getFrameClassicalAcceleration(model, data, 1, place, own), data.oMi[1] * place
            felt = moved.linear - pose_in_E0.rotation.T @ np.array(self.stand.gravity)
            points[name] = pose_in_E0.translation, pose_in_E0.rotation, twist.copy(), felt, moved.angular.copy()
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
        (position, axes), own = pose(stand, body), carrier
        if body is not stand.carrier:
            own = carrier.add_body(
                name=body.name, pos=position, quat=Rotation.from_matrix(axes).as_quat(scalar_first=True)
            )
        if body in stand.flywheels:
            own.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=(1.0, 0.0, 0.0))
        moments, axes = np.linalg.eigh(inertia_about_center(body))
        if body.mass > 0.0 or np.any(moments):
            own.mass, own.ipos, own.inertia = body.mass, body.center_of_mass, moments
            own.iquat = Rotation.from_matrix(axes * np.linalg.det(axes)).as_quat(scalar_first=True)
            own.explicitinertial = True
    for name, (position, axes) in places(stand).items():
        carrier.add_site(name=name, pos=position, quat=Rotation.from_matrix(axes).as_quat(scalar_first=True))
    return spec


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
        data.qpos[model.nq - self.N :] = state.phi
        data.qvel[:], data.qfrc_applied[len(self.rates) :] = velocities, state.tau
        data.xfrc_applied[:] = 0.0
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
            found = np.zeros(6)
            function(model, data, kind, number, found, 1)  # in the object's axes, angular part first
            return np.roll(found, 3)

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
            position, axes = data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy()
            points[name] = position, axes, twist, felt, turning
        reshaped = np.reshape(mounts, (-1, 6))
        return {"V_dot": V_dot, "wrench": wrench(1, C), "mount_wrench": reshaped, "points": points}


PROGRAMS: dict[str, type[Program]] = {"pinocchio": Pinocchio, "mujoco": Mujoco}


def verify_judges(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    names: Sequence[str] = tuple(PROGRAMS),
    make: Callable[[Stand], Backend] = CBackend,
    judged: str = "generated C",
    progress: Progress | None = None,
) -> Report:
    """Checks of a backend, which `make` makes, against the programs, on the stand without what they do not know.

    A program that does not take the stand has one check, which says why; if none does, nothing was compared and the
    report does not pass. UsageError: a program is not installed.
    """
    left_out, bare = missing(stand), bare_stand(stand)
    checks, programs = [], []
    for name in names:
        try:
            if left_out and least_eigenvalue(bare)[0] < LEAST_EIGENVALUE:
                raise UsageError(f"the stand without {', '.join(left_out)} has no positive definite mass matrix")
            programs.append(PROGRAMS[name](bare))
        except ImportError as error:
            raise UsageError(f"--judges: {name} is not installed ({error.name}): pip install pin mujoco") from None
        except (UsageError, ValueError) as error:  # MuJoCo's of a stand that it does not compile
            checks.append(Check(name, "all quantities", words=str(error)))
    found = judge(bare, make(bare), programs, draw(bare, seed, count), progress) if programs else []
    who = ", ".join([f"{program.name} {program.version}" for program in programs] or names)
    whole = report(bare, f"{judged} against {who}", seed, count, LIMIT, [*found, *checks])
    return replace(whole, left_out=tuple(left_out))


def judge(
    stand: Stand, backend: Backend, programs: Sequence[Program], states: States, progress: Progress | None = None
) -> list[Check]:
    """A check for each program and quantity."""
    checks: dict[tuple[str, str], Check] = {}
    scales = Scales(stand)
    for done, (name, drawn) in enumerate(states):
        state = replace(drawn, position=tuple(np.clip(drawn.position, -NEAR, NEAR).tolist()))
        natural = _scales(scales, state)
        for program in programs:
            for want, values in program.answers(state).items():
                ours = backend.evaluate(state, (want,))
                if want == "matrices":
                    M, J = (np.reshape(ours[key], (6, -1)) for key in "MJ")
                    ours["bias"] = M @ np.array(state.V) + J @ np.array(state.phi_dot) - np.array(ours["F"])
                for quantity, value in values.items():
                    # flywheels, points, freedoms: not of every stand
                    if quantity in ours and len(value) and np.size(value):
                        check = Check(program.name, f"{want} {quantity}", LIMIT)
                        check = checks.setdefault((program.name, check.quantity), check)
                        off, words = difference(ours[quantity], value, natural[want][quantity])
                        check.note(off, name, words, Request(name, state, (want,)))
        if progress is not None:
            progress(done + 1, len(states))
    return [check for program in programs for check in checks.values() if check.judged == program.name]


def _scales(scales: Scales, state: State) -> dict[str, Any]:
    """The measured scale of every quantity."""
    found: dict[str, Any] = {}
    for want in ("forward", "coupled", "torque", "mounts", "points"):
        measured = scales.want(state, want)
        found[want] = {} if measured is None else measured.scales

    def matrices(_: Stand, __: State, at: reference.Pieces) -> Values:
        return {"K": at.K, "I": at.I, "bias": at.M @ at.V_r + at.J @ at.phi_dot - at.F}

    return found | {"matrices": scales.measure(state, matrices).scales}
