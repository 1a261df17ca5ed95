"""Sentences of Part XI, for rides of every kind."""

import numpy as np
import pytest
from cases import faults
from helpers import plain

from suspension.report import rough_road as part
from suspension.rides import Rides

SPEEDS, NAMES = (1.2, 5.0), ("as it is", "soft")
LINEAR = np.array([[3.1, 7.0], [0.5, 1.4]])


def ridden(flights, force=(3.0, 6.0)):
    """Rides on three roads; `flights` of the first suspension at both speeds, shape (3, 2)."""
    flights = np.array([flights, np.zeros((3, 2))]).swapaxes(0, 1).astype(int)
    forces = np.array([[force, [0.5, 1.4]]] * 3) * np.array([0.9, 1, 1.1])[:, None, None]
    both = np.array([flights, 0 * flights])
    return Rides(np.array([forces, forces]), forces / 2, both / 50, both)


SOME = ridden([[2, 9], [0, 7], [3, 8]])
NONE = ridden(np.zeros((3, 2)))


def test_who_flies_where():
    text = plain(part.flights(NAMES, SPEEDS, LINEAR, SOME, ridden([[0, 1], [0, 1], [0, 1]])))
    assert (
        "**As it is, the robot flies on every road at 5 m/s and on some roads at 1.2 m/s.**" in text
    )
    assert "scatters less than the linear robot's" in text
    assert "Without the short waves it flies only at 5 m/s." in text
    assert "**With the suspension “soft” it flew on none of 3 roads.** With 95 % confidence" in text
    assert "63 %" in text and not faults(text)


@pytest.mark.parametrize(
    ("found", "longer", "absent"),
    [
        (ridden([[1, 1], [0, 1], [0, 0]]), SOME, "on every road"),
        (ridden([[1, 1], [2, 1], [3, 4]]), SOME, "on some roads"),
        (SOME, SOME, "Without the short waves"),
        (ridden([[2, 9]] * 3, force=(3.2, 6)), SOME, "scatters less"),
    ],
)
def test_nothing_is_said_that_was_not_found(found, longer, absent):
    text = part.flights(NAMES, SPEEDS, LINEAR, found, longer)
    assert "flies on" in text and absent not in text and not faults(text)


def test_flights_that_need_short_waves_everywhere_are_told_so():
    text = part.flights(NAMES, SPEEDS, LINEAR, SOME, NONE)
    assert "Without the short waves it never flies." in text and "only" not in text


def test_the_table_has_means_and_scatter():
    short = np.array([[0.997, 0.01], [0.1, 0.05]])
    table = plain(part.rides_table(NAMES, SPEEDS, LINEAR, short, SOME, NONE))
    assert (
        "| as it is | 5 | 7.00 | 1.00 % | 6.00 ± 0.60 | 3.00 ± 0.30 | 16 % | 8.0 ± 1.0 | 0 |"
        in table
    )
    assert "99.7 %" in table and "| – | 0 | 0 |" in table
    assert not faults(table)
