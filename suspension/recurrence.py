"""The recurrence ``x_n = R x_{n-1} + sum_c H_c u_{c,n}``, many steps per product of matrices.

A Python loop pays a microsecond a step for 32 multiplications. Here a block of steps from a zero
state is one product with a matrix of powers of R, so that the time goes into multiplying.
"""

from functools import cached_property

import numpy as np

__all__ = ["Recurrence"]

BLOCK = 8  # steps in one product: half of its entries are zero, so longer blocks waste more


class Recurrence:
    """An affine recurrence with constant matrices; leading axes hold independent cases.

    Parameters
    ----------
    R : ndarray, shape (..., n, n)
    H : sequence of ndarray, each of shape (..., n, p)
        What each of the inputs adds to a step.
    """

    def __init__(self, R, H):
        self.R, self.H = R, H
        powers = [np.broadcast_to(np.eye(R.shape[-1]), R.shape)]
        with np.errstate(over="ignore", invalid="ignore"):  # see __call__
            for _ in range(BLOCK):
                powers.append(R @ powers[-1])
            # Rows act on the block's inputs or its start, columns are the block's states.
            self.kernels = [_toeplitz([P @ h for P in powers[:BLOCK]]) for h in H]
        self.carry = np.concatenate([P.swapaxes(-1, -2) for P in powers[1:]], axis=-1)
        self.power = powers[BLOCK]

    @cached_property
    def ends(self):
        """The recurrence that the last states of the blocks obey, with R^BLOCK."""
        return Recurrence(self.power, [np.eye(self.R.shape[-1])])

    def __call__(self, x, *u):
        """All states after the initial one.

        Parameters
        ----------
        x : ndarray, shape (..., n)
            Initial state.
        *u : ndarray, each of shape (..., m, p)
            The inputs of the m steps.

        Returns
        -------
        x : ndarray, shape (..., m, n)
            Finite wherever the recurrence, done step by step, is.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            result = self._by_blocks(x, u)
            # Powers of an unstable R may overflow before the states do.
            return result if np.isfinite(result).all() else self._by_steps(x, u)

    def _by_steps(self, x, u):
        added = sum(v @ h.swapaxes(-1, -2) for v, h in zip(u, self.H))
        result = np.empty((*np.broadcast_shapes(added.shape[:-2], x.shape[:-1]), *added.shape[-2:]))
        for n in range(added.shape[-2]):
            result[..., n, :] = x = (self.R @ x[..., None])[..., 0] + added[..., n, :]
        return result

    def _by_blocks(self, x, u):
        m = u[0].shape[-2]
        blocks = m // BLOCK
        if blocks < 2:
            return self._by_steps(x, u)
        whole = [v[..., : blocks * BLOCK, :] for v in u]
        rows = [v.reshape(*v.shape[:-2], blocks, -1) for v in whole]
        local = sum(v @ kernel for v, kernel in zip(rows, self.kernels))
        n = self.R.shape[-1]
        ends = self.ends._by_blocks(x, [local[..., -n:]])
        start = np.concatenate([np.broadcast_to(x, ends[..., 0, :].shape)[..., None, :], ends[..., :-1, :]], axis=-2)  # fmt: skip
        local += start @ self.carry
        result = local.reshape(*local.shape[:-2], blocks * BLOCK, n)
        rest = [v[..., blocks * BLOCK :, :] for v in u]
        if rest[0].shape[-2]:
            result = np.concatenate([result, self._by_steps(result[..., -1, :], rest)], axis=-2)
        return result


def _toeplitz(responses):
    """Block Toeplitz matrix that takes BLOCK inputs to BLOCK states, as rows times matrix."""
    *lead, n, p = responses[0].shape
    T = np.zeros((*lead, BLOCK, p, BLOCK, n))
    for lag, response in enumerate(responses):
        for i in range(BLOCK - lag):
            T[..., i, :, i + lag, :] = response.swapaxes(-1, -2)
    return T.reshape(*lead, BLOCK * p, BLOCK * n)
