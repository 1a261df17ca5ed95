"""The half-robot on two springs and two dampers, as matrices.

The state is ``w = [Y, Y', theta, theta']`` and the road reaches the robot as
``u = [h1, h2, h1', h2']``, the ground's height and its rate of change under the rear (1) and
the front (2) wheel. Two physical statements are written down, the forces ``N = C w + D u`` and
the accelerations they cause, ``w' = S w + P N + e``; everything else follows from them.
"""

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, fields, replace
from functools import cached_property, wraps
from typing import Any

import numpy as np

from suspension import _checks

__all__ = ["Robot"]


def _constant(method: Callable[[Any], np.ndarray]) -> "cached_property[np.ndarray]":
    # Computed once per robot; read-only, because every later reader gets the same array.
    @wraps(method)
    def compute(self):
        value = np.asarray(method(self))
        value.setflags(write=False)
        return value

    return cached_property(compute)


@dataclass(frozen=True)
class Robot:
    """A rigid body on two massless wheels, each with a spring and a damper (Figure 1b).

    The defaults are Table 1 of the problem set; the stiffnesses come from Part I.

    Parameters
    ----------
    k1, k2 : float
        Spring stiffness at the rear and the front wheel pair, N/m, > 0.
    g : float
        Gravitational acceleration, m/s^2, >= 0.
    m : float
        Mass, kg, > 0.
    Izz : float
        Moment of inertia about the centre of mass, kg m^2, > 0.
    L1, L2 : float
        Distance from the centre of mass back to the rear and forward to the front wheel, m, > 0.
    c1, c2 : float
        Damping coefficient at the rear and the front wheel pair, N s/m, >= 0.

    Raises
    ------
    ValueError
        If a parameter is not a finite number in its range.

    Examples
    --------
    >>> robot = Robot(800, 800)
    >>> robot.equilibrium.round(6)
    array([-0.008927,  0.      ,  0.      ,  0.      ])
    """

    k1: float
    k2: float
    _: KW_ONLY
    g: float = 9.81
    m: float = 1.456
    Izz: float = 0.012
    L1: float = 0.107
    L2: float = 0.107
    c1: float = 1.5
    c2: float = 1.5

    def __post_init__(self):
        for field in fields(self):
            check = _checks.nonnegative if field.name in ("g", "c1", "c2") else _checks.positive
            object.__setattr__(self, field.name, check(field.name, getattr(self, field.name)))

    def __getstate__(self):
        # Copies and pickles carry the parameters only, never arrays that somebody could write to.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @_constant
    def k(self) -> np.ndarray:
        """Stiffnesses, rear and front, N/m, shape (2,)."""
        return np.array([self.k1, self.k2])

    @_constant
    def c(self) -> np.ndarray:
        """Damping coefficients, rear and front, N s/m, shape (2,)."""
        return np.array([self.c1, self.c2])

    @_constant
    def arms(self) -> np.ndarray:
        """Where the wheels are, ahead of the centre of mass, ``[-L1, L2]``, m, shape (2,)."""
        return np.array([-self.L1, self.L2])

    @_constant
    def C(self) -> np.ndarray:
        """State to normal forces, Eqs. 2 and 5, shape (2, 4)."""
        k, c, arms = self.k, self.c, self.arms
        return -np.column_stack([k, c, k * arms, c * arms])

    @_constant
    def D(self) -> np.ndarray:
        """Road input to normal forces, Eq. 5, shape (2, 4)."""
        return np.array([[self.k1, 0, self.c1, 0], [0, self.k2, 0, self.c2]])

    @_constant
    def S(self) -> np.ndarray:
        """The shift: Y' and theta' are themselves states, shape (4, 4)."""
        S = np.zeros((4, 4))
        S[0, 1] = S[2, 3] = 1.0
        return S

    @_constant
    def P(self) -> np.ndarray:
        """Normal forces to accelerations, Eq. 6, shape (4, 2)."""
        P = np.zeros((4, 2))
        P[1] = 1 / self.m
        P[3] = self.arms / self.Izz
        return P

    @_constant
    def e(self) -> np.ndarray:
        """Weight, Eq. 6, shape (4,)."""
        return np.array([0.0, -self.g, 0.0, 0.0])

    @_constant
    def A(self) -> np.ndarray:
        """State matrix of ``w' = A w + B u + e``, shape (4, 4)."""
        return self.S + _product(self.P, self.C)

    @_constant
    def B(self) -> np.ndarray:
        """Input matrix of ``w' = A w + B u + e``, shape (4, 4)."""
        return _product(self.P, self.D)

    @_constant
    def equilibrium(self) -> np.ndarray:
        """The state at rest on flat ground, ``A w + e = 0`` (Eq. 8 when symmetric), shape (4,).

        Solved for Y and theta alone, so that the two velocities are exactly zero.
        """
        w = np.zeros(4)
        w[::2] = np.linalg.solve(self.A[1::2, ::2], -self.e[1::2])
        return w + 0.0  # no -0.0

    @property
    def twin(self) -> "Robot":
        """The symmetric robot with the means of k1 and k2, c1 and c2, L1 and L2.

        A symmetric robot is its own twin.

        Examples
        --------
        >>> Robot(700, 900).twin == Robot(800, 800)
        True
        """
        rear, front = (self.k1, self.c1, self.L1), (self.k2, self.c2, self.L2)
        if rear == front:
            return self
        k, c, L = ((a + b) / 2 for a, b in zip(rear, front))
        return replace(self, k1=k, k2=k, c1=c, c2=c, L1=L, L2=L)

    @property
    def eigenvalues(self) -> np.ndarray:
        """Eigenvalues of A in 1/s, shape (4,), complex: slowest first, conjugates together."""
        return self._eigen[0]

    @property
    def eigenvectors(self) -> np.ndarray:
        """Eigenvectors of A as columns in the order of `eigenvalues`, shape (4, 4), complex."""
        return self._eigen[1:]

    @_constant
    def heave_share(self) -> np.ndarray:
        """How much of each mode is heave, 0 to 1, shape (4,).

        Heave and pitch are compared at the wheel that is further from the centre of mass.
        """
        heave, _, pitch, _ = np.abs(self.eigenvectors)
        return heave / (heave + np.abs(self.arms).max() * pitch)

    @_constant
    def _eigen(self):
        values, vectors = np.linalg.eig(self.A.astype(complex))
        order = np.lexsort((values.imag, np.abs(values).round(9)))
        return np.vstack([values, vectors])[:, order]


def _product(P, M):
    # Without the fused multiply-add of P @ M, which would leave couplings of 1e-13 between heave
    # and pitch of a symmetric robot, where the two wheels cancel exactly.
    return np.einsum("ij,jk->ik", P, M)
