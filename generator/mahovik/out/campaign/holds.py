"""Holds of many samples that hold the carrier at other places: states of one hold as those of another.

A state is carried over by the coordinates and speeds of its freedoms: the carrier is moved from the home pose of its
own hold as it is from that of the stand of the file. About the pivot p, from the home pose (O0, C0), this is the turn
R = C0^T C and the way of the pivot d = C0^T (O1 - O0) + R p - p.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.out.api.tables import PLACE_OF_HOLD, Tables
from mahovik.out.campaign.pose import Array, compose, conjugate, product, rotation, turn, turn_back
from mahovik.use.simulate.held import home


def is_place_of_hold(path: str) -> bool:
    """Whether a path of a stand file is of a number that says where the carrier is held."""
    first, _, rest = path.replace("[", ".").partition(".")
    return first == "hold" and rest.partition(".")[0] in PLACE_OF_HOLD


@dataclass(frozen=True, eq=False)
class Place:
    """Where n samples are held, or one (n = 1), which stands for all.

    position, attitude   (3, n; m), (4, n): home pose
    pivot                (3, n): in E1, m
    S                    (6, m, n): twists of the freedoms
    """

    position: Array
    attitude: Array
    pivot: Array
    S: Array

    def part(self, own: slice) -> Place:
        """The place of some samples."""
        return Place(self.position[:, own], self.attitude[:, own], self.pivot[:, own], self.S[..., own])


@dataclass(frozen=True, eq=False)
class Holds:
    """The place of the stand of the file, and those of the samples."""

    nominal: Place
    samples: Place

    @staticmethod
    def of(stand: Stand, tables: Tables) -> Holds | None:
        """The holds of tables; None where all samples are held as the stand of the file."""
        hold = stand.hold
        if hold is None or not _varies(tables.samples.given):
            return None
        at_home = home(stand)
        own = Place(*(np.array(x)[..., None] for x in (at_home.position, at_home.quaternion, hold.pivot, twists(hold))))
        laws, n = tables.laws(), len(tables)
        names = {"home_position": own.position, "home_attitude": own.attitude, "pivot": own.pivot, "S": own.S}
        found = [laws.get(name, np.broadcast_to(x, (*x.shape[:-1], n))) for name, x in names.items()]
        return Holds(own, Place(*found))

    def part(self, own: slice) -> Holds:
        """The holds of some samples."""
        return Holds(self.nominal, self.samples.part(own))

    def states(self, x: Array) -> Array:
        """Position, attitude and twist (13, n) of the samples, from those of the stand of the file."""
        position, attitude = _carry(x[:3], x[3:7], self.nominal, self.samples)
        return np.concatenate([position, attitude, self.twists(x[7:13])])

    def twists(self, V: Array) -> Array:
        """S u (6, n) of the samples, of V = S u (6, n) of the stand of the file."""
        u = np.linalg.pinv(self.nominal.S[..., 0]) @ V
        return np.asarray(np.einsum("imn,mn->in", self.samples.S, u))

    def nominal_twists(self, V: Array) -> Array:
        """S u (6, n) of the stand of the file, of V = S u (6, n) of the samples."""
        inverse = np.linalg.pinv(np.moveaxis(self.samples.S, -1, 0))
        u = (inverse @ V.T[:, :, None])[:, :, 0].T
        return product(np.broadcast_to(self.nominal.S, (*self.nominal.S.shape[:2], V.shape[1])), u)

    def nominal_poses(self, position: Array, attitude: Array) -> tuple[Array, Array]:
        """Position (..., 3, n) and attitude (..., 4, n) with the hold of the file, from those of the samples."""
        return _carry(position, attitude, self.samples, self.nominal)


def _varies(paths: Iterable[str]) -> bool:
    return any(map(is_place_of_hold, paths))


def _carry(position: Array, attitude: Array, a: Place, b: Place) -> tuple[Array, Array]:
    """Position and attitude with the hold b of a carrier that is as far from its home pose as with the hold a."""
    turned = compose(conjugate(a.attitude), attitude)
    R = rotation(turned)
    way = turn_back(rotation(a.attitude), position - a.position) + turn(R, a.pivot) - a.pivot
    place = b.position + turn(rotation(b.attitude), way + b.pivot - turn(R, b.pivot))
    return np.asarray(place), compose(b.attitude, turned)
