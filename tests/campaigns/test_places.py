"""Numbers of a stand file found by path: each of them, moved, moves that number of the stand and no other."""

import numpy as np
import pytest

import mahovik
from api.models import stand
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.distributions import Fixed
from mahovik.out.campaign.draw import Draw, Parameter
from mahovik.out.campaign.places import Place, Places

PATTERNS = {
    "sat4": ("rw*.unbalance.*", "rw*.position", "carrier.center_of_mass[1]", "carrier.inertia.J12", "rw2.axis[0]",
             "rw3.spin_inertia", "rw1.transverse_inertia", "acc1.position[2]", "carrier.mass"),
    "demo3": ("w1.unbalance.static_at", "w*.mass", "carrier.inertia.J33"),
    "remus6": ("carrier.added_mass[0][0]", "carrier.damping.terms[*].value", "carrier.buoyancy.center[2]"),
    "everything": ("leg[*].stiffness", "leg[0].ground[1]", "suspension.stiffness[0][0]", "gravity[2]"),
}  # fmt: skip


def moved(places: Places, place: Place, value: float) -> Stand:
    """The stand with one number changed."""
    draw = Draw((Parameter(place, Fixed(value), None),), (), None, places.matrices())
    changes = draw.changes({place.path: np.array([value])})
    return places.stand().replace({key: column[0] for key, column in changes.items()})


@pytest.mark.parametrize("name", PATTERNS)
def test_a_number_is_found_with_its_value(name: str) -> None:
    of = Stand.of(stand(name))
    places = Places(of)
    found = [place for pattern in PATTERNS[name] for place in places.find(pattern)]
    assert len({place.path for place in found}) == len(found)
    assert places.stand() == of  # lists in SI, with the same bits
    for place in found[:: 1 + len(found) // 8]:
        value = place.nominal * 1.001 + 1e-12
        after = Places(moved(places, place, value))
        there = {each.path: each for pattern in PATTERNS[name] for each in after.find(pattern)}
        for each in found:
            if each is place:
                assert there[each.path].nominal == pytest.approx(value, rel=1e-9), each.path
            elif "unbalance" not in place.path + each.path:  # a mass changes the unbalance of the same body
                assert there[each.path].nominal == each.nominal, (place.path, each.path)


def test_paths_lead_into_the_tables_of_a_model() -> None:
    for name in ("demo3", "sat4"):
        places = Places(Stand.of(stand(name)))
        found = [place for pattern in PATTERNS[name] for place in places.find(pattern)]
        draw = Draw(tuple(Parameter(each, Fixed(0.0), None) for each in found), (), None, places.matrices())
        n = 3
        columns = {each.path: np.array([each.nominal * (1 + 1e-6 * k) for k in range(n)]) for each in found}
        tables = mahovik.build(places.stand()).tables(draw.changes(columns))
        for each in found:
            if "unbalance" not in each.path:
                (there,) = Places(tables.stand(2)).find(each.path)
                assert there.nominal == columns[each.path][2], each.path


def test_dimensions_are_those_of_the_stand_file() -> None:
    units = {
        place.path: place.dimension.si
        for pattern in PATTERNS["sat4"]
        for place in Places(Stand.of(stand("sat4"))).find(pattern)
    }
    assert units["rw1.unbalance.static"] == "kg m"
    assert units["rw4.unbalance.dynamic_at"] == "rad"
    assert units["carrier.inertia.J12"] == "kg m^2"
    assert units["rw2.axis[0]"] == ""
    stiffness = Places(Stand.of(stand("everything")))
    assert stiffness.find("suspension.stiffness[0][4]")[0].dimension.si == "N/rad"
