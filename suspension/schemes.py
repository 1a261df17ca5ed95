"""One-step methods as data: a Butcher tableau, and all that follows from it.

Stability function, stability region, largest stable step and the matrices of one step are
computed from the tableau and from nothing else, so a new method is one line of numbers.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from suspension import _checks

__all__ = ["BACKWARD_EULER", "CRANK_NICOLSON", "EULER", "RK4", "Scheme"]

ROUNDOFF = 64 * np.finfo(float).eps
MAX_POINTS = 10**5  # of a boundary, some ten seconds
FINE = np.pi / 50  # rad, a step along a boundary that mistakes no other root for the next one
TOLERANCE = 1e-12  # what eigenvalue solvers and printed tableaux leave


@dataclass(frozen=True, eq=False)
class Scheme:
    """A Runge-Kutta method with s stages, explicit or implicit.

    Parameters
    ----------
    name : str
        What figures and tables call it.
    order : int
        Order of convergence, >= 1.
    a : array_like, shape (s, s)
        Weights of the stages in each other.
    b : array_like, shape (s,)
        Weights of the stages in the step; they sum to 1.
    c : array_like, shape (s,)
        Abscissae of the stages, the row sums of `a`.

    Raises
    ------
    ValueError
        If the shapes do not fit each other, or the method is not consistent.

    Examples
    --------
    >>> heun = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[1 / 2, 1 / 2], c=[0, 1])
    >>> round(heun.max_stable_dt([-4]), 12)
    0.5
    """

    name: str
    order: int
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray

    if TYPE_CHECKING:  # what one may give is more than what one gets

        def __init__(
            self, name: str, order: int, a: ArrayLike, b: ArrayLike, c: ArrayLike
        ) -> None: ...

    def __post_init__(self):
        _checks.instance("name", self.name, str)
        b = _checks.array("b", self.b, (None,))
        a = _checks.array("a", self.a, (len(b), len(b)))
        c = _checks.array("c", self.c, (len(b),))
        if abs(b.sum() - 1) > TOLERANCE:
            raise ValueError(f"b must sum to 1, got {b.sum()}")
        if np.abs(a.sum(axis=1) - c).max() > TOLERANCE:
            raise ValueError(f"c must be the row sums of a, {a.sum(axis=1)}, got {c}")
        object.__setattr__(self, "order", _checks.whole("order", self.order, 1))
        for name, value in (("a", a), ("b", b), ("c", c)):
            value = value.copy()
            value.setflags(write=False)
            object.__setattr__(self, name, value)

    @property
    def _content(self):
        return self.name, self.order, *(tuple(x.ravel().tolist()) for x in (self.a, self.b, self.c))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scheme) and self._content == other._content

    def __hash__(self) -> int:
        return hash(self._content)

    def __reduce__(self):  # a copy is checked and read-only again
        return Scheme, (self.name, self.order, self.a, self.b, self.c)

    def stability_function(self, z: ArrayLike) -> np.ndarray:
        """Growth per step of ``w' = lambda w``: ``R(z) = 1 + z b^T (I - z a)^-1 1``.

        Parameters
        ----------
        z : array_like of complex
            ``lambda dt``, any shape.

        Returns
        -------
        R : ndarray of complex, the shape of `z`
            Infinite at a pole, and where the powers of z overflow.

        Raises
        ------
        ValueError
            If `z` does not hold numbers.
        """
        P, Q = self.polynomials
        z = _checks.array("z", z, dtype=complex, finite=False)
        with np.errstate(all="ignore"):
            R = P(z) / Q(z)
        return np.where(np.isfinite(R), R, np.inf)

    @property
    def polynomials(self) -> tuple[Polynomial, Polynomial]:
        """Numerator and denominator of R, ``det(I - z (a - 1 b^T))`` and ``det(I - z a)``.

        Two `numpy.polynomial.Polynomial`; the denominator of an explicit method is 1.
        """
        return _determinant(self.a - self.b), _determinant(self.a)

    def one_step(self, A: ArrayLike, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Matrices of one step, ``w_{n+1} = R w_n + sum_i G_i F(t_n + c_i dt)``.

        Parameters
        ----------
        A : array_like, shape (..., n, n)
            State matrix of ``w' = A w + F(t)``, 1/s; leading axes are independent systems.
        dt : float
            Time step, s, > 0.

        Returns
        -------
        R : ndarray, shape (..., n, n)
        G : ndarray, shape (s, ..., n, n)
            In s.

        Raises
        ------
        ValueError
            If `A` is not finite or not square, `dt` is not > 0, or the equations of the stages have
            no solution.
        """
        A, dt = _checks.array("A", A), _checks.positive("dt", dt)
        if A.ndim < 2 or A.shape[-1] != A.shape[-2]:
            raise ValueError(f"A must be square, got shape {A.shape}")
        s, n = len(self.b), A.shape[-1]
        # All stages at once: (I - dt a kron A)^T G^T = dt (b^T kron I)^T.
        stages = np.eye(s * n) - dt * np.kron(self.a, A)
        try:
            G = np.linalg.solve(stages.swapaxes(-1, -2), dt * np.kron(self.b, np.eye(n)).T)
        except np.linalg.LinAlgError:
            raise ValueError(f"dt must not make {self.name}'s step unsolvable, got {dt}") from None
        G = np.moveaxis(G.reshape(*A.shape[:-2], s, n, n), -3, 0).swapaxes(-1, -2)
        return np.eye(n) + G.sum(axis=0) @ A, G

    def is_stable(self, eigenvalues: ArrayLike, dt: float) -> bool:
        """Whether no mode grows: ``|R(lambda dt)| <= 1`` for every eigenvalue (to 1e-12).

        Parameters
        ----------
        eigenvalues : array_like of complex
            1/s, any shape.
        dt : float
            Time step, s, > 0.

        Returns
        -------
        stable : bool

        Raises
        ------
        ValueError
            If an eigenvalue is not finite, or `dt` is not > 0.
        """
        z = _checks.array("eigenvalues", eigenvalues, dtype=complex) * _checks.positive("dt", dt)
        return bool((np.abs(self.stability_function(z)) <= 1 + TOLERANCE).all())

    def max_stable_dt(self, eigenvalues: ArrayLike) -> float:
        """The largest step up to which every smaller one is stable too, in s; inf if all are.

        Along a ray ``z = lambda dt`` the method is stable where ``|Q|^2 - |P|^2 >= 0``, a real
        polynomial in dt: its first root with a change of sign is the limit. Eigenvalues with a
        positive real part give 0.

        Parameters
        ----------
        eigenvalues : array_like of complex
            1/s, any shape.

        Returns
        -------
        dt : float

        Raises
        ------
        ValueError
            If an eigenvalue is not finite.
        """
        eigenvalues = _checks.array("eigenvalues", eigenvalues, dtype=complex)
        return float(min((self._limit(z) for z in eigenvalues.ravel()), default=np.inf))

    def _limit(self, eigenvalue):
        modulus = abs(eigenvalue)
        if modulus == 0:
            return np.inf
        direction = eigenvalue / modulus
        P, Q = (_along(direction, polynomial) for polynomial in self.polynomials)
        slack = (Q * _conjugate(Q) - P * _conjugate(P)).coef.real  # >= 0 where stable
        # Undamped modes cancel, up to the eigenvalue solver's error in their real parts.
        terms = (_moduli(Q) ** 2 + _moduli(P) ** 2).coef[: len(slack)]
        slack[np.abs(slack) < TOLERANCE * terms] = 0.0
        slack = np.trim_zeros(slack, "f")  # the multiple root at dt = 0 says nothing
        if not slack.size:
            return np.inf
        slack = Polynomial(slack)
        roots = slack.roots()
        real = np.abs(roots.imag) < 1e-9 * np.abs(roots)
        edges = np.concatenate([[0.0], np.sort(roots.real[real & (roots.real > 0)])])
        inside = np.append((edges[:-1] + edges[1:]) / 2, edges[-1] + 1)
        unstable = slack(inside) < 0
        return edges[unstable.argmax()] / modulus if unstable.any() else np.inf

    def boundary(self, n: int = 400) -> np.ndarray:
        """The neutral curve ``|R(z)| = 1`` through z = 0, like the course's ``rk4sb``.

        Traced in the upper half-plane by following the root of ``R(z) = exp(i phi)`` from z = 0
        as phi grows, then mirrored. An A-stable method whose curve runs to infinity (the whole
        imaginary axis for Crank-Nicolson) is sampled up to a finite height.

        Parameters
        ----------
        n : int
            Number of points, 4 to 100,000.

        Returns
        -------
        points : ndarray, shape (n, 2)
            Real and imaginary part of z, in order along the curve.

        Raises
        ------
        ValueError
            If `n` is out of its range.
        """
        n = _checks.whole("n", n, 4)
        if n > MAX_POINTS:
            raise ValueError(f"n must be at most {MAX_POINTS}, got {n}")
        half = (n + 1) // 2
        degree = max(p.degree() for p in self.polynomials)
        # The half curve takes pi for every root of R that it goes around: all of them, unless R
        # has another region of stability and this curve is back on the real axis before.
        ends = self._follow(np.pi * np.arange(1, degree + 1))
        turns = 1 + np.append(np.abs(ends.imag[:-1]) < 1e-9, True).argmax()
        z = self._follow(turns * np.pi * (np.arange(half) + 0.5 * (n % 2 == 0)) / half)
        z = np.concatenate([z[::-1].conj(), z[n % 2 :]])
        return np.column_stack([z.real, z.imag])

    def _follow(self, phases):
        """The root of ``R(z) = exp(i phi)`` that starts at z = 0, for growing phases phi."""
        P, Q = self.polynomials
        z, at, before = [], 0j, 0.0
        for phi in phases:
            # So short that no other root is mistaken for the next one.
            pieces = 1 + int((phi - before) / FINE)
            for angle in np.linspace(before, phi, pieces + 1)[1:]:
                slope = 1j * P(at) * Q(at) / (P.deriv()(at) * Q(at) - P(at) * Q.deriv()(at))
                roots = (P - np.exp(1j * angle) * Q).roots()
                at = roots[np.abs(roots - (at + (phi - before) / pieces * slope)).argmin()]
            before = phi
            z.append(at)
        return np.array(z)


def _along(direction, polynomial):
    """The polynomial in r that another is at ``z = direction r``."""
    return Polynomial(polynomial.coef * direction ** np.arange(len(polynomial.coef)))


def _conjugate(polynomial):
    return Polynomial(polynomial.coef.conj())


def _moduli(polynomial):
    return Polynomial(np.abs(polynomial.coef))


def _determinant(M):
    """The polynomial ``det(I - z M)``, by the Faddeev-LeVerrier recursion (no eigenvalues)."""
    coef, X = [1.0], np.eye(len(M))
    for j in range(1, len(M) + 1):
        X = M @ X
        coef.append(-np.trace(X) / j)
        X = X + coef[-1] * np.eye(len(M))
    coef = np.array(coef)
    coef[np.abs(coef) < ROUNDOFF] = 0.0
    return Polynomial(coef).trim()


EULER = Scheme("Euler", 1, a=[[0]], b=[1], c=[0])
BACKWARD_EULER = Scheme("Backward Euler", 1, a=[[1]], b=[1], c=[1])
CRANK_NICOLSON = Scheme("Crank-Nicolson", 2, a=[[0, 0], [1 / 2, 1 / 2]], b=[1 / 2, 1 / 2], c=[0, 1])
RK4 = Scheme(
    "RK4",
    4,
    a=[[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 1 / 2, 0, 0], [0, 0, 1, 0]],
    b=[1 / 6, 1 / 3, 1 / 3, 1 / 6],
    c=[0, 1 / 2, 1 / 2, 1],
)
