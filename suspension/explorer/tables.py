"""What the explorer's page iterates: tableaux, stability regions, the road as polynomials."""

import warnings
from functools import cache

import numpy as np

from suspension.road import GaussianBump, profile

__all__ = ["region", "road_table", "scheme_facts", "shape_of", "unit_bump"]

NODES = -np.cos(np.pi * np.arange(5) / 4)  # where a cell, -1 to 1, meets the road
POWERS = np.arange(2 * len(NODES))
GOAL = (1e-13, 1e-12)  # error of a height, m, and of a slope
LIMIT = (1e-12, 1e-10)  # what a reader should be told of
NOTHING = 1e-25  # m
FAR = 11.0  # widths from its centre, where a bump of any height is nothing


def shape_of(road, start, stop):
    """The road as ``H(x) = height shape((x - centre) / sigma)``, with a table of the shape.

    Parameters
    ----------
    road : callable
        ``road(x) -> (H, dHdx)``.
    start, stop : float
        What the wheels can meet, m.

    Returns
    -------
    frame : dict
        ``centre``; where the shape's table begins, and how long one of its cells is.
    table : ndarray, shape (cells, 10)
    """
    if isinstance(road, GaussianBump):
        centre, start, stop = road.centre, -FAR, FAR
        table = road_table(GaussianBump(height=1.0, sigma=1.0, centre=0.0), start, stop, cells=256)
    else:
        centre = 0.0
        table = road_table(road, start, stop)
    frame = {"centre": centre, "start": start, "cell": (stop - start) / len(table)}
    return frame, table


def unit_bump(bump):
    """The frame of a bump, as `shape_of` has it, with the number of its cells.

    The page computes the table itself: it is the same for all bumps.
    """
    frame, table = shape_of(bump, 0, 0)
    return frame | {"cells": len(table)}


def road_table(road, start, stop, cells=1024, max_cells=4096):
    """The road as a polynomial of degree 9 in each of many equal cells.

    It has the road's height and slope at five points of the cell. A cubic between two points would
    need a hundred times as many numbers to be as exact in the slope, which the dampers feel.

    Parameters
    ----------
    road : callable
        ``road(x) -> (H, dHdx)``.
    start, stop : float
        Where the table begins and ends, m.
    cells, max_cells : int
        Where refining begins, fine enough to miss no bump, and where it ends.

    Returns
    -------
    table : ndarray, shape (cells, 10)
        ``H = sum_j table[i, j] s^j``, with s from -1 to 1 across cell i.

    Raises
    ------
    ValueError
        If the road returns another shape than it was given, or a value that is not finite.

    Warns
    -----
    UserWarning
        If the road is too rough, for example has a kink; the page then differs from `simulate`.
    """
    between = (NODES[:-1] + NODES[1:]) / 2
    while True:
        half = (stop - start) / cells / 2
        middle = start + half * (2 * np.arange(cells) + 1)
        table = np.linalg.solve(_powers(NODES), _sample(road, middle, half, NODES).T).T
        error = np.abs(table @ _powers(between).T - _sample(road, middle, half, between))
        error = error.reshape(cells, 2, -1).max(axis=(0, 2)) / [1, half]
        if (error <= GOAL).all() or 2 * cells > max_cells:
            break
        cells *= 2
    table[np.abs(table).max(axis=1) < NOTHING] = 0  # where the page need not look closer
    if (error > LIMIT).any():
        warnings.warn(
            f"road is rough: the page knows its height to {error[0]:.1g} m "
            f"and its slope to {error[1]:.1g}",
            stacklevel=2,
        )
    return table


def _powers(s):
    """Rows that give height, then slope times the half-width, at points s of a cell."""
    return np.vstack([s[:, None] ** POWERS, POWERS * s[:, None] ** np.maximum(POWERS - 1, 0)])


def _sample(road, middle, half, s):
    x = middle[:, None] + half * s
    H, dHdx = profile(road, x)
    return np.hstack([H, half * dHdx])


def scheme_facts(scheme):
    """A scheme as the page is handed it: its tableau, R(z) = P(z) / Q(z), its region."""
    P, Q = scheme.polynomials
    return {
        "name": scheme.name,
        "order": scheme.order,
        "a": scheme.a.tolist(),
        "b": scheme.b.tolist(),
        "c": scheme.c.tolist(),
        "P": P.coef.tolist(),
        "Q": Q.coef.tolist(),
        "region": region(scheme),
    }


@cache  # every explorer asks for those of the same few schemes, and following a curve takes a while
def region(scheme, far=1e3):
    """The region of absolute stability as polygons that are filled by the even-odd rule.

    Where the method is stable far out on the left, the half-plane is closed at a distance `far`;
    where it is stable far out on the right too (backward Euler), the region lies outside the
    curve, and a square around everything says so.

    Returns
    -------
    polygons : list of lists of corners (Re z, Im z)
    """
    curve = scheme.boundary(361)
    left, right = (abs(scheme.stability_function(far * way)) < 1 for way in (-1, 1))
    if left and right:
        square = np.array([[-far, -far], [far, -far], [far, far], [-far, far]])
        return [square.tolist(), curve.round(4).tolist()]
    if left:
        curve = np.vstack([[-far, -far], [0, -far], curve, [0, far], [-far, far]])
    return [curve.round(4).tolist()]
