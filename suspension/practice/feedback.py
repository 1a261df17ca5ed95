"""How a check asks and answers: a student's function, called with care, and words about it.

A check compares on random instances. An answer that is right passes, however it was written. One
that is not is compared with what typical mistakes would give on the same instances, so that only
a mistake that fits all of them is named; if none does, the property that fails is.
"""

import functools
import inspect
import linecache
import warnings
from copy import deepcopy

import numpy as np

__all__ = ["Feedback"]

SEED = 2086
CLOSE = 1e-7  # relative to the largest element: roundoff is less, and no mistake is
PATIENCE = 20_000  # evaluations after which a loop is said not to end


class Feedback(str):
    """What a check says, true where the answer is right: ``if check_fit(fit): ...``.

    Attributes
    ----------
    right : bool
        Whether the answer has every property that was tried.
    """

    right: bool

    def __new__(cls, text, right):
        """The words, and the judgement."""
        made = super().__new__(cls, text)
        made.right = right
        return made

    def __bool__(self):
        """Whether the answer is right."""
        return self.right

    def __repr__(self):
        """The words as they are."""
        return str(self)


class Wrong(Exception):
    """The first thing that is not right, in words."""


def check(signature, praise):
    """Decorate a check that raises `Wrong`; what it gets is callable as `signature` says."""

    def decorate(function):
        @functools.wraps(function)
        def asked(answer, /):
            rng = np.random.default_rng(SEED)
            try:
                with np.errstate(all="ignore"):
                    function(Yours(answer, signature), rng)
            except Wrong as wrong:
                return Feedback(str(wrong), False)
            return Feedback(f"Right: {praise}", True)

        first = next(iter(inspect.signature(function).parameters.values()))
        asked.__signature__ = inspect.Signature(
            [first.replace(kind=inspect.Parameter.POSITIONAL_ONLY)]
        )
        return asked

    return decorate


def fill(name):
    """A blank is no error."""
    return Wrong(
        f"Fill in the blank of `{name}`: there is still a `...` in it, or in what it uses."
    )


class Yours:
    """A student's function, called with copies; what goes wrong in it is said in words."""

    def __init__(self, function, signature):
        self.function, self.signature = function, signature
        self.name = signature.partition("(")[0]
        if function is Ellipsis:
            raise fill(self.name)
        if not callable(function):
            raise Wrong(
                f"Hand over the function itself, `{self.name}` without brackets; this is "
                f"{_kind(function)}."
            )
        try:
            inspect.signature(function).bind(*signature.partition("(")[2].split(","))
        except TypeError as error:
            raise Wrong(f"`{self.name}` is called as `{signature}`; yours says: {error}.") from None
        except ValueError:  # some of NumPy's functions have no signature
            pass

    def __call__(self, *arguments):
        """What it returns; an exception within it is told with its line."""
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")
                result = self.function(*map(_copy, arguments))
        except Wrong:
            raise
        except Exception as error:
            if "ellipsis" in str(error).lower():
                raise fill(self.name) from None
            raise Wrong(self._stopped(error)) from None
        if _has_blank(result) or (result is None and self._is_empty()):
            raise fill(self.name)
        return result

    def _stopped(self, error):
        """Where and why it stopped."""
        kind, text = type(error).__name__, str(error).strip().rstrip(".")
        said = f"`{self.signature}` stopped with {kind}" + (f": {text}" if text else "")
        code = getattr(self.function, "__code__", None)
        place, trace = None, error.__traceback__
        while trace is not None:
            if code and trace.tb_frame.f_code.co_filename == code.co_filename:
                place = code.co_filename, trace.tb_lineno
            trace = trace.tb_next
        line = linecache.getline(*place).strip() if place else ""
        return f"{said}, in the line `{line}`." if line else f"{said}."

    def _is_empty(self):
        """Whether there is no more in it than a docstring and ``...`` or ``pass``."""
        code = getattr(self.function, "__code__", None)
        return bool(code) and not code.co_names and code.co_nlocals == code.co_argcount


def _copy(argument):
    """What a function may change without harm."""
    return argument if callable(argument) else deepcopy(argument)


def _kind(value):
    kind = type(value).__name__
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _has_blank(value):
    if isinstance(value, tuple | list):
        return any(map(_has_blank, value))
    if isinstance(value, np.ndarray) and value.dtype == object:
        return any(map(_has_blank, value.ravel()))
    return value is Ellipsis


def numbers(value, name, real=True):
    """A result as an array: lists, tuples and numbers will do."""
    if value is None:
        raise Wrong(f"`{name}` returns nothing: is a `return` missing?")
    try:
        x = np.asarray(value)
    except ValueError:
        raise Wrong(f"`{name}` returns rows of different lengths, which make no array.") from None
    if x.dtype.kind not in "biufc":
        raise Wrong(f"`{name}` returns {_kind(value)}, where numbers are needed.")
    if x.dtype.kind == "c" and np.abs(x.imag).max(initial=0) <= 1e-9 * np.abs(x).max(initial=1):
        x = x.real
    if real and x.dtype.kind == "c":
        raise Wrong(f"`{name}` returns complex numbers, where real ones are needed.")
    return x if x.dtype.kind == "c" else x.astype(float)


def several(value, names, function, ndim=None):
    """The parts of a result that has several, such as ``W, T``, each as an array.

    One array holds them all if it has the dimension `ndim`, and is a part itself otherwise.
    """
    try:
        parts = [value] if isinstance(value, np.ndarray) and value.ndim != ndim else list(value)
    except TypeError:
        parts = [value]
    if len(parts) != len(names):
        count = f"{len(parts)} things" if len(parts) != 1 else "one thing"
        raise Wrong(f"`{function}` returns {count}, where `{', '.join(names)}` are needed.")
    return [numbers(part, function) for part in parts]


def near(x, y, close=CLOSE):
    """Whether two arrays have one shape and one content, to roundoff of the largest element."""
    x, y = np.asarray(x), np.asarray(y)
    if x.shape != y.shape or not (np.isfinite(x).all() and np.isfinite(y).all()):
        return False
    return not off(x, y, close).any()


def off(x, y, close=CLOSE):
    """Which elements of two arrays differ by more than roundoff of the largest element."""
    return np.abs(x - y) > close * np.abs(y).max(initial=0)


def fits(answers, cases, formula, close=CLOSE):
    """Whether a formula gives all the answers."""
    return all(near(answer, formula(*case), close) for answer, case in zip(answers, cases))


def must_have_shape(x, shape, name, means):
    """Refuse a shape by words."""
    if x.shape != tuple(shape):
        raise Wrong(
            f"`{name}` returns an array of shape {x.shape}; needed is {tuple(shape)}, {means}."
        )
    if not np.isfinite(x).all():
        raise Wrong(
            f"`{name}` returns nan or inf for numbers that are moderate: is it divided by zero?"
        )


def name_mistake(answers, cases, mistakes, close=CLOSE):
    """Raise `Wrong` with the words for the first mistake that explains every answer."""
    for words, formulas in mistakes.items():
        formulas = formulas if isinstance(formulas, tuple) else (formulas,)
        if any(fits(answers, cases, formula, close) for formula in formulas):
            raise Wrong(words)


def compare(yours, cases, right, mistakes, means, fails, close=CLOSE):
    """Raise `Wrong` unless the answers to all cases are right.

    Parameters
    ----------
    yours : Yours
    cases : list of tuple
        Arguments.
    right : callable
        What should come of them.
    mistakes : dict of str to callable, or to several
        What comes of them by a typical mistake, by what is to be said then.
    means : str
        What the elements of the result are.
    fails : callable
        ``fails(answer, *case)``: words for the property that does not hold.
    """
    answers = [numbers(yours(*case), yours.name) for case in cases]
    if np.ndim(right(*cases[0])) == 0:  # one number may come in brackets
        answers = [answer.squeeze() for answer in answers]
    if fits(answers, cases, right, close):
        return
    name_mistake(answers, cases, mistakes, close)
    for answer, case in zip(answers, cases):
        wanted = np.asarray(right(*case))
        must_have_shape(answer, wanted.shape, yours.name, means)
        if not near(answer, wanted, close):
            raise Wrong(fails(answer, *case))


def told(found, wanted):
    """``x, and should be y``, in as many digits as tell them apart."""
    for digits in range(4, 17):
        texts = [f"{value:.{digits}g}" for value in (found, wanted)]
        if texts[0] != texts[1]:
            break
    return f"{texts[0]}, and should be {texts[1]}"


def listed(words):
    """``a, b and c``."""
    words = list(words)
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
