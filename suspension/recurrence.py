"""Linear systems with constant matrices, many steps at a time.

A Python loop over ``x_{n+1} = A x_n + B u_n``, ``y_n = C x_n + D u_n`` pays a microsecond a step
for a few dozen multiplications. Here the outputs of a whole block of steps are one product: the
block's inputs and its first state, times a matrix of powers of A. The first states of the blocks
obey a recurrence of the same kind, with A to the power of the block's length.
"""

from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

__all__ = ["Discrete", "Recurrence", "abscissae"]

BLOCK = 16  # steps in one product: longer ones multiply more zeros, shorter ones run no faster
FEW = 64  # blocks: so few are sooner joined by doubling


class Recurrence:
    """A linear recurrence with constant matrices; leading axes hold independent cases.

    Parameters
    ----------
    A : ndarray, shape (..., n, n)
    B : ndarray, shape (..., n, p)
    C : ndarray, shape (..., o, n)
    D : ndarray, shape (..., o, p)
    block : int
        Steps in one product, a power of 2.
    """

    def __init__(self, A, B, C, D, block=BLOCK):
        *cases, n, p = B.shape
        self.block, o = block, C.shape[-2]
        with np.errstate(over="ignore", invalid="ignore"):  # see __call__
            # I, A, A^2, ... side by side, so that a few products of large matrices make them.
            powers, power = np.broadcast_to(np.eye(n), A.shape), A
            while powers.shape[-1] < block * n:
                powers = np.concatenate([powers, power @ powers], axis=-1)
                power = power @ power
            entered = (powers.reshape(*cases, n * block, n) @ B).reshape(*cases, n, block, p)
            free = (C @ powers).reshape(*cases, o, block, n)
            response = (C @ entered.reshape(*cases, n, block * p)).reshape(*cases, o, block, p)
        causal = np.zeros((*cases, o, block - 1, p))
        response = np.concatenate([causal, D[..., None, :], response[..., :-1, :]], axis=-2)
        # Rows are a block's inputs, one after the other; columns are its steps.
        kernel = sliding_window_view(response, block, axis=-2)[..., ::-1, :, :].swapaxes(-2, -3)
        self.kernel = kernel.reshape(*cases, o, p * block, block)
        self.free = free.swapaxes(-1, -2)
        self.last = entered[..., ::-1, :].swapaxes(-1, -3).reshape(*cases, p * block, n)
        self.power = power

    @cached_property
    def starts(self):
        """What the first states of the blocks obey; its inputs are the blocks' own last states."""
        unit = np.broadcast_to(np.eye(self.power.shape[-1]), self.power.shape)
        return Recurrence(self.power, unit, unit, 0 * unit, BLOCK // 2)

    def __call__(self, x, u):
        """Run m steps.

        Parameters
        ----------
        x : ndarray, shape (..., n)
            First state.
        u : ndarray, shape (..., p, m)
            Inputs; without the leading axes, all cases have the same.

        Returns
        -------
        y : ndarray, shape (..., o, m)
            Outputs. Powers of an unstable A may overflow before the states do; then they are not
            all finite.
        x : ndarray, shape (..., n)
            The state after the last step, if m is a multiple of BLOCK.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            return self._run(x, u)

    def _run(self, x, u):
        *cases, p, m = u.shape
        blocks = -(-m // self.block)
        if m % self.block:
            u = np.concatenate([u, np.zeros((*cases, p, -m % self.block))], axis=-1)
        u = u.reshape(*cases, p, blocks, self.block).swapaxes(-2, -3)
        u = u.reshape(*cases, blocks, p * self.block)
        ends = u @ self.last
        starts = np.empty_like(ends)
        if blocks > FEW:
            starts[...] = self.starts._run(x, ends.swapaxes(-1, -2))[0].swapaxes(-1, -2)
        else:
            starts[..., 0, :], starts[..., 1:, :] = x, ends[..., :-1, :]
            power, step = self.power.swapaxes(-1, -2), 1
            while step < blocks:
                starts[..., step:, :] += starts[..., :-step, :] @ power
                power, step = power @ power, 2 * step
        x = (self.power @ starts[..., -1, :, None])[..., 0] + ends[..., -1, :]
        y = u[..., None, :, :] @ self.kernel
        y += starts[..., None, :, :] @ self.free
        return y.reshape(*y.shape[:-2], blocks * self.block)[..., :m], x


class Discrete:
    """A one-step method for ``z' = A z + B f(t)``, ``y = C z + D f(t)``.

    A step is ``z_{n+1} = R z_n + sum_c H_c f(t_n + c dt)``. What its end gets from f belongs to the
    next step as well, so that ``x_n = z_n - H_1 f(t_n)`` needs f at ``c < 1`` only.

    Parameters
    ----------
    scheme : Scheme
    A, B, C, D : ndarray, shapes (..., n, n), (..., n, p), (..., o, n) and (..., o, p)
        Leading axes hold independent cases.
    dt : float
        Time step, s.

    Attributes
    ----------
    abscissae : ndarray, shape (s,)
        The c at which f is asked for.
    """

    def __init__(self, scheme, A, B, C, D, dt):
        self.R, G = scheme.one_step(A, dt)
        self.abscissae = abscissae(scheme)
        *H, self.H1 = (G[scheme.c == c].sum(axis=0) @ B for c in [*self.abscissae, 1.0])
        self.H, self.C, self.D = np.concatenate(H, axis=-1), C, D
        entering = np.concatenate([H[0] + self.R @ self.H1, *H[1:]], axis=-1)
        direct = np.concatenate([D + C @ self.H1, *(0 * D for _ in H[1:])], axis=-1)
        self.recurrence = Recurrence(self.R, entering, C, direct)
        np.empty(2**21)  # having freed so much once, glibc keeps it at hand: no page faults later

    def start(self, z, f):
        """The x that belongs to the state z, for f from the same time on."""
        return z - (self.H1 @ f[..., : self.H1.shape[-1], :1])[..., 0]

    def __call__(self, x, f):
        """Run m steps.

        Parameters
        ----------
        x : ndarray, shape (..., n)
            Where to start.
        f : ndarray, shape (..., s p, m)
            The f at ``t_n``, all components, then at the next of the abscissae.

        Returns
        -------
        y : ndarray, shape (..., o, m)
            Outputs at the m times ``t_n``, finite wherever a plain loop's are.
        x : ndarray, shape (..., n)
            Where to go on, if m is a multiple of `recurrence.BLOCK`.
        """
        y, end = self.recurrence(x, f)
        return (y, end) if np.isfinite(y).all() else self._by_steps(x, f)

    def _by_steps(self, x, f):
        with np.errstate(over="ignore", invalid="ignore"):
            now = f[..., : self.H1.shape[-1], :]
            added, z = self.H @ f, self.H1 @ now
            for n in range(f.shape[-1]):
                z[..., n] += x
                x = (self.R @ z[..., n, None])[..., 0] + added[..., n]
            return self.C @ z + self.D @ now, x


def abscissae(scheme):
    """Where in a step a scheme asks for the forcing, as fractions: 0, then all but 0 and 1.

    The end of a step is the next one's beginning.
    """
    return np.array([0.0, *sorted({*scheme.c} - {0.0, 1.0})])
