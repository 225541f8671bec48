"""Jitter of a held carrier to first order, of a point or of the reaction, as `lines.Amplitudes` of a free one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter import LoadView, Makers, View
from mahovik.use.study.jitter.chain import Chain
from mahovik.use.study.jitter.held_plant import HeldPlant
from mahovik.use.study.jitter.quantity import LinearMotion
from mahovik.use.study.jitter.torus_motion import state_at
from mahovik.use.study.linear.model import places
from mahovik.use.study.quiet.options import QuietOptions
from mahovik.use.study.response.held import REACTION, HeldScene


@dataclass(frozen=True, eq=False)
class HeldAmplitudes:
    """Amplitudes of a held carrier; axes (directions, 3) of the point, or of E1 for the reaction."""

    scene: HeldScene
    chain: Chain
    axes: Array

    @staticmethod
    def of(stand: Stand, options: QuietOptions) -> HeldAmplitudes:
        """Amplitudes about the rest. Raises CheckError: no equilibrium; StateError."""
        scene = HeldScene.of(stand)
        seen: View | LoadView
        if options.point == REACTION:
            seen = LoadView.of(stand, REACTION, options.measure)
        else:
            seen = View.of(places(stand, [options.point])[0], options.measure)
        down = scene.chart.C.T @ np.array(stand.gravity)
        chain = Chain.of(HeldPlant.of(scene), seen, Makers(), np.zeros(len(stand.flywheels)), down)
        return HeldAmplitudes(scene, chain, np.array(options.axes))

    def at(self, speeds: Array) -> Complex:
        """Amplitudes (axes x N) at these speeds (N, rad/s), for phases zero; zero for a flywheel at rest."""
        a = self.chain.seen.linear(self._motion(speeds))[0, :, :, 0]
        return np.asarray(self.axes @ np.where(speeds[:, None] == 0.0, 0.0, a).T)

    def start(self, speeds: Array, phases: Array) -> State:
        """State at t = 0 on the steady motion, to first order; exactly where the hold allows."""
        motion = self._motion(speeds)
        pose = np.where(speeds[:, None] == 0.0, 0.0, motion.pose[0, :, :, 0])
        turned = np.exp(1j * np.sign(speeds) * phases)
        x, V = (turned @ each for each in (pose, 1j * motion.omega[0][:, None] * pose))
        own = np.concatenate([x.real, V.real]).reshape(2, 6) @ np.linalg.pinv(self.scene.S).T
        return state_at(self.scene, self.scene.whole(own.reshape(1, -1))[0], phases, speeds)

    def _motion(self, speeds: Array) -> LinearMotion:
        omega, wrench = self.chain.plant.unbalance(speeds[None], np.zeros(len(speeds)))
        return self.chain.by_unbalance(speeds[None], np.where(omega == 0.0, 1.0, omega), wrench)
