"""What the explorer's page iterates: the matrices of every step, the road, the stability regions.

For the deviation ``d = w - w_eq`` from equilibrium, where the weight cancels because
``A w_eq + e = 0``, the page computes ``d_{n+1} = R d_n + sum_c (G_c P) D u(t_n + c dt)`` and
``N = C (w_eq + d) + D u``. Half as many numbers as ``G_c B = (G_c P) D`` say the same.
"""

import warnings
from dataclasses import replace

import numpy as np

from suspension.road import profile

__all__ = [
    "ROBOT_FIELDS",
    "region",
    "road_table",
    "robot_table",
    "step_fields",
    "step_table",
    "vary_stiffness",
]

ROBOT_FIELDS = [("CD", 16), ("equilibrium", 4), ("re", 4), ("im", 4)]

NODES = -np.cos(np.pi * np.arange(5) / 4)  # where a cell, -1 to 1, meets the road
POWERS = np.arange(2 * len(NODES))
GOAL = (1e-13, 1e-12)  # error of a height, m, and of a slope
LIMIT = (1e-12, 1e-10)  # what a reader should be told of
NOTHING = 1e-25  # m


def vary_stiffness(robot):
    """The robot with 13 stiffnesses k1, its own among them, and the ratio k2 / k1 unchanged.

    They go from 300 to 1500 N/m, or as far below and above the robot's own if that is outside.

    Returns
    -------
    robots : list of Robot, by stiffness
    own : int
        The place of `robot` itself.
    """
    k1 = np.linspace(300, 1500, 13)
    if not k1[0] <= robot.k1 <= k1[-1]:
        k1 *= robot.k1 / 800
    own = int(np.abs(k1 - robot.k1).argmin())
    robots = [replace(robot, k1=k, k2=k * (robot.k2 / robot.k1)) for k in k1]
    robots[own] = robot
    return robots, own


def step_fields(scheme):
    """What a row of a scheme's `step_table` holds: pairs of a name and a length, in order."""
    stages = len(np.unique(scheme.c))  # those of equal c added up
    return [("M", 4 * (4 + 2 * stages)), ("growth", 4), ("stable", 1)]


def step_table(scheme, robots, dts):
    """Everything about one step, for every robot and dt.

    Parameters
    ----------
    scheme : Scheme
    robots : sequence of Robot
    dts : sequence of float
        Time steps, s.

    Returns
    -------
    table : ndarray, shape (len(robots), len(dts), 16 + 8 q + 5)
        By `step_fields`: the columns of ``[R, G_c P, ..]``, shape (4, 4 + 2 q), with q different
        abscissae c, stages of equal c added up; ``|R(lambda dt)|`` of the four modes; 1 if the
        step is stable, else 0.
    """
    A, P = np.stack([robot.A for robot in robots]), np.stack([robot.P for robot in robots])
    table = []
    for dt in dts:
        R, G = scheme.one_step(A, dt)
        GP = [(G[scheme.c == c] @ P).sum(axis=0) for c in np.unique(scheme.c)]
        columns = np.concatenate([R, *GP], axis=2).swapaxes(1, 2).reshape(len(robots), -1)
        growth = [np.abs(scheme.stability_function(robot.eigenvalues * dt)) for robot in robots]
        stable = [[scheme.is_stable(robot.eigenvalues, dt)] for robot in robots]
        table.append(np.hstack([columns, growth, stable]))
    return np.stack(table, axis=1)


def robot_table(robots):
    """The columns of ``[C, D]``, the equilibrium, the eigenvalues' real and imaginary parts.

    Returns
    -------
    table : ndarray, shape (len(robots), 28)
        By `ROBOT_FIELDS`.
    """
    rows = []
    for robot in robots:
        lam = robot.eigenvalues
        parts = [robot.C.T.ravel(), robot.D.T.ravel(), robot.equilibrium, lam.real, lam.imag]
        rows.append(np.concatenate(parts))
    return np.stack(rows)


def road_table(road, start, stop, max_cells=4096):
    """The road as a polynomial of degree 9 in each of many equal cells.

    It has the road's height and slope at five points of the cell. A cubic between two points would
    need a hundred times as many numbers to be as exact in the slope, which the dampers feel.

    Parameters
    ----------
    road : callable
        ``road(x) -> (H, dHdx)``.
    start, stop : float
        Where the table begins and ends, m.
    max_cells : int
        Where refining ends.

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
    cells = 2048
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


def region(scheme, far=1e3):
    """Corners (Re z, Im z) of the region of absolute stability.

    A neutral curve from one end of the imaginary axis to the other bounds the half-plane on its
    left, which is closed at a distance `far`.
    """
    curve = scheme.boundary(361)
    if abs(scheme.stability_function(-far)) < 1:
        curve = np.vstack([[-far, -far], [0, -far], curve, [0, far], [-far, far]])
    return curve.round(4).tolist()
