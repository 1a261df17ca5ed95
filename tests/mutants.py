"""Do the tests notice? Changes the core in one place at a time and runs its unit tests.

    python tests/mutants.py [MODULE ...] [--sample N] [--jobs N]

A mutant is a module with one operator, comparison, number or condition changed. It is killed if a
test of that module, or of bad input, fails or takes far too long: quick tests come first, and only
who survives them meets the slow ones. The survivors are printed, each with its line.
The files are left alone: the mutant is compiled from a changed syntax tree, in a process of its
own, and handed to whoever imports the module. (Libraries do not fit: mutmut skips decorated
functions, which all matrices of a robot are; cosmic-ray writes into the tree and starts Python for
every mutant.)

Survivors that change nothing are listed in `EQUIVALENT` with the reason.
"""

import argparse
import ast
import contextlib
import copy
import importlib.abc
import importlib.util
import os
import random
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import islice
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
MODULES = "robot road schemes forces simulation exact least_force critical contact flight".split()
MODULES += "spring_law motion extremes sweep rides choice uncertainty small_angle measured".split()
# Files of tests of those that have others than their own.
TESTS = {"sweep": ["sweep", "drive"], "extremes": ["drive"], "motion": ["motion", "drive", "rides"]}
NO_TESTS = 5  # what pytest answers where it finds none
SLOWEST = 5  # times as long as without a change, then a mutant is stopped, and killed
OPERATORS = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
    ast.MatMult: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.And: ast.Or,
    ast.Or: ast.And,
}
GUARD = "the size of a guard is a choice: any near it guards as well"
DENSITY = "more samples than are needed change nothing"
EDGE = "no number meets the bound exactly"
# Module, a part of the line, what stood there ("" for anything), and why no test can see a change.
EQUIVALENT = [
    ("robot", "round(9)", "9", "modes as slow as each other agree in more digits than they have"),
    ("road", "eq=False", "False", "equality is written out"),
    ("road", "around = [", "", "a level piece of any length has the same slope, none"),
    ("road", "MAX_WAVES = ", "", GUARD),
    ("road", "STEEPEST = ", "", GUARD),
    ("road", "LONGEST = ", "", GUARD),
    ("schemes", "MAX_POINTS =", "", GUARD),
    ("schemes", "FINE =", "", DENSITY),
    ("schemes", "pieces = 1 +", "1", DENSITY),
    ("schemes", "n=400", "400", "as many points as a caller likes"),
    ("schemes", "< 1e-9", "1e-09", "a second region of stability, which no scheme here has"),
    ("schemes", "s, n = len(self.b), A.shape[-1]", "1", "the matrix is square by then"),
    ("schemes", "<= 1 + TOLERANCE", "np.abs(self.stability_function(z)) <= 1 + TOLERANCE", EDGE),
    ("schemes", "terms = (", "2", GUARD),
    ("schemes", "roots.real > 0", "roots.real > 0", "roots at zero have been trimmed"),
    ("schemes", "slack(inside) < 0", "slack(inside) < 0", "it is not zero between its roots"),
    ("simulation", "lru_cache", "8", "the size of a cache"),
    ("simulation", "CHUNK = ", "8192", "the size of a piece"),
    ("simulation", "columns[:, 0] = 1", "1", "the unit diagonal that LAPACK does not read"),
    ("simulation", "1e-12 * J", "abs(J - round(J)) <= 1e-12 * J", EDGE),
    ("least_force", "MAX_SAMPLES =", "", GUARD),
    ("least_force", "CHUNK =", "", "the size of a piece"),
    ("least_force", "DIGITS_LOST =", "", GUARD),
    ("least_force", "units = 8", "8", "an estimate of roundoff, safe by a factor or two"),
    ("least_force", "4 * EPS", "4", "the same"),
    ("least_force", "passing = passing[(", "", "an estimate: more moments can make it only safer"),
    ("least_force", "return 400", "400", "about how many samples"),
    ("least_force", "2 + int(swings)", "2", DENSITY),
    ("least_force", "2 + int(7 *", "2", DENSITY),
    ("least_force", "np.arange(-66, 133)", "30", DENSITY),
    ("flight", "MAX_STEPS", "", GUARD),
    ("flight", "stops[0] * np.array([0.25", "", "a road that answers in arrays does so anywhere"),
    ("flight", "(t < tfinal - SHORTEST)", "", "a leg that lasts nothing changes nothing"),
    ("flight", "np.diff(t, prepend=0.0) > SHORTEST", "np.diff(t, prepend=0.0) > SHORTEST", EDGE),
    ("flight", "times.min() + SHORTEST", "times < times.min() + SHORTEST", EDGE),
    ("flight", "<= 1e-10 *", "1e-10", "halved once more or once less, it has converged as well"),
    ("uncertainty", "WIDEST = ", "", GUARD),
    ("uncertainty", "EXACT = ", "", GUARD),
    ("uncertainty", "EXACT * first", "kmax - kmin <= EXACT * first", EDGE),
    ("uncertainty", "EXACT * stiff", "stiffness.error <= EXACT * stiffness.value", EDGE),
    ("uncertainty", "branch.first.k > low", "branch.first.k > low", EDGE),
    ("uncertainty", "branch.last.k < high", "branch.last.k < high", EDGE),
    ("sweep", "DECAY = ", "", DENSITY),
    ("sweep", "many = self.bases.shape[1] > 1", "", "a choice among one gives that one"),
    ("sweep", "> MAX_WORK", "v.size * steps > MAX_WORK", EDGE),
    ("choice", "MAX_", "", GUARD),
    ("choice", "lambda x: 2 * (x - start)", "2", "a steeper slope leads to the same point"),
    ("choice", "cost > most", "cost > most", GUARD),
    ("contact", "(critical < vmax)", "", EDGE),
    ("contact", "xtol=1e-15", "1e-15", "finer than a time is told from the next"),
    ("contact", "ends = {t[j - 1]", "1", "the force is positive at every earlier sample as well"),
    ("contact", "return ends[s] if", "", "only the sign of a roundoff may be another one"),
    ("critical", "ripples = 1 +", "1", DENSITY),
    ("critical", "count = (20 +", "", "where samples are few, a bound of the slope asks for more"),
]


class Mutant(NamedTuple):
    """A change of a module: its line, what stood there, and what stands there now."""

    module: str
    line: int
    text: str
    before: str
    after: str
    tree: ast.Module


def mutants(module, sample=None):
    """Every mutant of a module, or so many of them, always the same."""
    path = ROOT / "suspension" / f"{module}.py"
    source = path.read_text(encoding="utf-8")
    tree, lines = ast.parse(source), source.splitlines()
    found = [
        (place, which)
        for place, node in enumerate(ast.walk(tree))
        for which, _ in enumerate(changes(node))
    ]
    if sample and sample < len(found):
        found = sorted(random.Random(2086).sample(found, sample))
    for place, which in found:
        changed = copy.deepcopy(tree)
        node = next(islice(ast.walk(changed), place, None))
        before, line = ast.unparse(node), node.lineno
        next(islice(changes(node), which, None))(node)
        yield Mutant(module, line, lines[line - 1], before, ast.unparse(node), changed)


def changes(node):
    """Functions that change a node in place, each in one way."""
    if isinstance(node, ast.BinOp | ast.AugAssign | ast.BoolOp):
        if type(node.op) in OPERATORS:
            yield lambda node: setattr(node, "op", OPERATORS[type(node.op)]())
    elif isinstance(node, ast.Compare):
        if type(node.ops[0]) in OPERATORS:
            yield lambda node: node.ops.__setitem__(0, OPERATORS[type(node.ops[0])]())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield lambda node: setattr(node, "op", ast.UAdd())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield lambda node: setattr(node, "operand", ast.UnaryOp(ast.Not(), node.operand))
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield lambda node: setattr(node, "value", node.value + 1)
        if node.value:
            yield lambda node: setattr(node, "value", node.value * 1.5)
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield lambda node: setattr(node, "value", not node.value)
    elif isinstance(node, ast.If | ast.While | ast.IfExp):
        yield lambda node: setattr(node, "test", ast.Constant(False))


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the mutant instead of the module's file."""

    def __init__(self, mutant):
        self.name = f"suspension.{mutant.module}"
        self.path = ROOT / "suspension" / f"{mutant.module}.py"
        self.code = compile(ast.fix_missing_locations(mutant.tree), self.path, "exec")

    def pytest_sessionstart(self):
        """Stand before pytest's own importer, which takes modules with examples for tests."""
        sys.meta_path.insert(0, self)

    def find_spec(self, name, path=None, target=None):
        """A spec for the mutant's module alone."""
        if name != self.name:
            return None
        return importlib.util.spec_from_file_location(name, self.path, loader=self)

    def exec_module(self, module):
        """Run the changed code."""
        exec(self.code, module.__dict__)


def survives(mutant, tests, seconds):
    """Whether tests pass in a child process, within that time; so they do where there are none."""
    child = os.fork()
    if not child:
        with contextlib.suppress(BaseException):
            os.setsid()  # so that it can be stopped with all that it started
            silence = os.open(os.devnull, os.O_WRONLY)
            os.dup2(silence, 1)
            os.dup2(silence, 2)
            os._exit(run_tests(mutant, tests))
        os._exit(1)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status) in (0, NO_TESTS)
        time.sleep(0.02)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return False


def run_tests(mutant, tests):
    """pytest's exit code."""
    import pytest

    plugins = [Changed(mutant)] if mutant.tree else []
    plain = ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:nbval", "-p", "no:randomly"]
    return pytest.main(
        [*plain, "-o", "addopts=--doctest-modules --import-mode=importlib", *tests], plugins
    )


def stages(module):
    """What is run, one after the other, of those that survive: most fall at once."""
    names = TESTS.get(module, [module])
    own = [f"suspension/{module}.py", *(f"tests/unit/test_{name}.py" for name in names)]
    yield ["-m", "not slow", *own]
    yield ["tests/unit/test_bad_input.py"]
    yield ["-m", "slow", *own]


def examine(module, sample, jobs):
    """Run a module's mutants, print the survivors; return how many there were of each."""
    begin = time.monotonic()
    found = alive = sorted(mutants(module, sample), key=lambda mutant: mutant.line)
    for tests in stages(module):
        start = time.monotonic()
        if not survives(Mutant(module, 0, "", "", "", None), tests, 600):
            sys.exit(f"{module}: its tests fail as it is")
        usual = time.monotonic() - start
        print(f"{module}: {len(alive)} mutants, tests take {usual:.1f} s", flush=True)
        check = partial(survives, tests=tests, seconds=5 + SLOWEST * jobs * usual)
        with ThreadPoolExecutor(jobs) as pool:
            lives = list(pool.map(check, alive))
        alive = [mutant for mutant, lives in zip(alive, lives, strict=True) if lives]
        if all(map(reason, alive)):
            break
    unexplained = [mutant for mutant in alive if not reason(mutant)]
    for mutant in unexplained:
        print(f"  line {mutant.line}: {mutant.before}  ->  {mutant.after}")
    minutes = (time.monotonic() - begin) / 60
    print(
        f"  killed {len(found) - len(alive)} of {len(found)}, {len(alive) - len(unexplained)} "
        f"change nothing, {len(unexplained)} survive ({minutes:.1f} min)",
        flush=True,
    )
    return len(found), len(unexplained)


def reason(mutant):
    """Why a mutant changes nothing, or None."""
    for module, part, before, why in EQUIVALENT:
        if module == mutant.module and part in mutant.text and before in ("", mutant.before):
            return why
    return None


def main():
    """Examine the modules that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("modules", nargs="*", metavar="MODULE", help=", ".join(MODULES))
    parser.add_argument("--sample", type=int, help="so many mutants of each, always the same")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at the same time")
    options = parser.parse_args()
    # What is loaded here need not be loaded again for every mutant; nothing of the package is.
    os.chdir(ROOT)
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    scipy = [f"scipy.{part}" for part in ("integrate", "interpolate", "optimize", "stats")]
    for library in ("hypothesis", "numpy", "pytest", *scipy, "pandas", "statsmodels.api"):
        importlib.import_module(library)
    counts = [
        examine(module, options.sample, options.jobs) for module in options.modules or MODULES
    ]
    total, left = map(sum, zip(*counts, strict=True))
    print(f"{total} mutants, {left} survive unexplained")


if __name__ == "__main__":
    main()
