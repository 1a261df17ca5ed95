"""Measure the package beside its peers; print the results, keep them and draw them.

``make bench`` runs this. With ``--book`` it also builds the book, runs the tests and moves the
explorer's sliders, which takes many minutes; without, the last such results are kept. With
``--draw`` it measures nothing and only writes the tables and figures anew.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # before NumPy: one thread for everybody

import argparse
import datetime
import importlib.metadata
import json
import platform
import subprocess
import sys
import tempfile
import time
import tracemalloc
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
ROOT = HERE.parent
RESULTS = HERE / "results.json"
ACCURACY = 1e-8  # N, of work (d)
SLOW = 0.2  # s: what takes longer is repeated less often


def clock(runs, rounds=7, each=0.05):
    """Shortest time of each run in s; the runs take turns, so that all meet the same machine."""
    first, best = {}, {}
    for name, run in runs.items():
        start = time.perf_counter()
        run()
        first[name] = time.perf_counter() - start
    for turn in range(rounds):
        for name, run in runs.items():
            usual = best.get(name, first[name])
            if usual > SLOW and turn >= 2:
                continue
            for _ in range(max(1, min(100, int(each / usual)))):
                start = time.perf_counter()
                run()
                best[name] = min(best.get(name, np.inf), time.perf_counter() - start)
    return first, best


def machine():
    """What the numbers were measured with."""
    model = platform.processor()
    if Path("/proc/cpuinfo").exists():
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        model = next((x.split(": ")[1] for x in lines if x.startswith("model name")), model)
    names = ["numpy", "scipy", "numba", "control", "diffrax", "jax"]
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "processor": model,
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
        "versions": {name: importlib.metadata.version(name) for name in names},
    }


def work_a(robot, bump, peers):
    """5,000 steps of 1 ms at 0.25 m/s: states and both forces."""
    v, T = 0.25, 1e-3 * np.arange(5001)
    truth = peers.closed_form(robot, bump, v, T)()
    makers = {
        "simulate": peers.package,
        "Numba, the recurrence": peers.numba_recurrence,
        "Numba, the textbook loop": peers.numba_stages,
        "closed form": peers.closed_form,
        "diffrax Tsit5": peers.tsit5(),
        "signal.lsim": peers.lsim,
        "signal.dlsim": peers.dlsim,
        "control.forced_response": peers.forced_response,
        "solve_ivp DOP853": peers.adaptive("DOP853"),
        "solve_ivp LSODA": peers.adaptive("LSODA"),
        "solve_ivp RK45": peers.adaptive("RK45"),
        "solve_ivp Radau": peers.adaptive("Radau"),
        "textbook Crank-Nicolson": peers.textbook_implicit,
        "textbook RK4": peers.textbook,
    }
    runs = {name: make(robot, bump, v, T) for name, make in makers.items()}
    first, best = clock(runs)
    return [
        {
            "name": name,
            "seconds": best[name],
            "first": first[name],
            "error": float(np.abs(run() - truth).max()),
        }
        for name, run in runs.items()
    ]


def work_b(robot, bump, peers):
    """Time against the number of steps, and the memory of 100,000."""
    v, tfinal = 0.25, 5.0
    most = {
        "simulate": 10**6,
        "Numba, the recurrence": 10**6,
        "signal.lsim": 10**5,
        "textbook RK4": 10**4,
    }
    makers = [peers.package, peers.numba_recurrence, peers.lsim, peers.textbook]
    seconds = {name: {} for name in most}
    for J in (10**2, 10**3, 10**4, 10**5, 10**6):
        T = tfinal / J * np.arange(J + 1)
        runs = {
            name: make(robot, bump, v, T)
            for (name, limit), make in zip(most.items(), makers)
            if limit >= J
        }
        for name, best in clock(runs)[1].items():
            seconds[name][J] = best
    from suspension.simulation import simulate

    simulate(robot, bump, v=v, dt=tfinal, tfinal=tfinal)
    tracemalloc.start()
    run = simulate(robot, bump, v=v, dt=1e-5 * tfinal, tfinal=tfinal)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return {"seconds": seconds, "memory": peak / (run.T.nbytes + run.W.nbytes + run.N.nbytes)}


def work_c(robot, bump, peers):
    """The smallest forces for 10,000 pairs (v, k), 2,000 steps each, in ns per step and case."""
    from dataclasses import replace

    from suspension.sweep import sweep

    steps, ks, vs = 2000, np.geomspace(200, 3000, 100), np.geomspace(0.1, 10, 100)
    robots = np.array([[replace(robot, k1=k, k2=k)] for k in ks])

    def one_by_one(make):
        for k, v in zip(ks, vs):
            T = 1.25 / v / steps * np.arange(steps + 1)
            make(replace(robot, k1=k, k2=k), bump, v, T)().min(axis=1)

    runs = {
        "sweep": lambda: sweep(robots, bump, vs, steps=steps),
        "Numba, one by one": lambda: one_by_one(peers.numba_recurrence),
        "simulate, one by one": lambda: one_by_one(peers.package),
    }
    cases = dict(zip(runs, (robots.size * vs.size, ks.size, ks.size)))
    _, best = clock(runs, rounds=5)
    return {name: 1e9 * best[name] / cases[name] / steps for name in runs}


def work_d(robot, bump, peers):
    """The cheapest way of each to forces within 1e-8 N at 101 times, at 1.2 m/s."""
    v, tfinal = 1.2, 1.25 / 1.2
    wanted = tfinal / 100 * np.arange(101)
    truth = peers.closed_form(robot, bump, v, wanted)()
    found, runs = {}, {"closed form": peers.closed_form(robot, bump, v, wanted)}
    fixed = {
        "simulate": peers.package,
        "Numba, the recurrence": peers.numba_recurrence,
        "Numba, the textbook loop": peers.numba_stages,
        "signal.lsim": peers.lsim,
        "textbook RK4": peers.textbook,
    }
    for name, make in fixed.items():
        for J in (100 * m for m in (10, 20, 30, 40, 50, 60, 80, 100, 1000, 4000)):
            run = make(robot, bump, v, tfinal / J * np.arange(J + 1))
            error = np.abs(run()[:, :: J // 100] - truth).max()
            found[name] = {"setting": f"{J:,} steps", "error": float(error)}
            if error <= ACCURACY:
                runs[name] = run
                break
    adaptive = {
        f"solve_ivp {m}": lambda rtol, m=m: peers.adaptive(m, rtol)
        for m in ("DOP853", "LSODA", "RK45", "Radau")
    }
    adaptive["diffrax Tsit5"] = peers.tsit5
    for name, make in adaptive.items():
        for digits in range(7, 14):
            run = make(10.0**-digits)(robot, bump, v, wanted)
            error = np.abs(run() - truth).max()
            found[name] = {"setting": f"rtol 1e-{digits}", "error": float(error)}
            if error <= ACCURACY:
                runs[name] = run
                break
    best = clock(runs, rounds=5)[1]
    rows = [{"name": "closed form", "setting": "101 times", "error": 0.0}]
    rows += [{"name": name, **row} for name, row in found.items()]
    return [{**row, "seconds": best.get(row["name"])} for row in rows]


def work_e(robot, bump, peers):
    """The largest accelerations of 5,184 runs with flights: s a run, and how far off they are."""
    from dataclasses import replace

    from suspension import fly
    from suspension.sweep import drive

    speeds, distance = np.array([0.25, 1.2, 5, 10]), 1.25
    ks, cs = np.geomspace(100, 3000, 36), np.geomspace(0.2, 12, 36)
    robots = np.array([[[replace(robot, k1=k, k2=k, c1=c, c2=c)] for c in cs] for k in ks])
    some = [(i, j, (i + j) % 4) for i in range(2, 36, 7) for j in range(3, 36, 7)]
    cases = [(robots[i, j, 0], speeds[n]) for i, j, n in some]

    def flown(one, v):
        flight = fly(one, bump, v=v, tfinal=distance / v)
        return np.abs(flight.N.sum(axis=0) / one.m - one.g).max()

    def solved(one, v):
        return peers.on_a_ground_that_pushes(one, bump, v, distance)

    runs = {
        "drive": lambda: drive(robots, bump, speeds).acceleration,
        "fly, one by one": lambda: np.array([flown(*case) for case in cases]),
        "solve_ivp RK45, one by one": lambda: np.array([solved(*case) for case in cases]),
    }
    found = {name: run() for name, run in runs.items()}
    count = {name: values.size for name, values in found.items()}
    found["drive"] = found["drive"][tuple(np.transpose(some))]
    best = clock(runs, rounds=3)[1]
    truth = found["fly, one by one"]
    return [
        {
            "name": name,
            "seconds": best[name] / count[name],
            "error": float(np.abs(found[name] / truth - 1).max()),
        }
        for name in runs
    ]


def parts(robot, bump):
    """Where the time of work (a) goes, in ns a step."""
    from scipy.linalg.lapack import dtbtrs

    from suspension.schemes import RK4
    from suspension.simulation import _band, simulate

    J, v, dt = 5000, 0.25, 1e-3
    rng = np.random.default_rng(0)
    x, y = rng.random(4 * J), rng.random((7, J))
    exponent, out, held = -x, np.empty(4 * J), np.empty_like(y)
    R, _ = RK4.one_step(robot.A, dt)
    band, b = _band(R, J), rng.random(4 * J)
    runs = {
        "whole": lambda: simulate(robot, bump, v=v, dt=dt, tfinal=J * dt),
        "exponential": lambda: np.exp(exponent, out=out),
        "road": lambda: bump(x),
        "solve": lambda: dtbtrs(band, b, uplo="L", diag="U"),
        "memory": lambda: np.copyto(held, y),
    }
    best = clock(runs, rounds=30, each=0.01)[1]
    return {name: 1e9 * seconds / J for name, seconds in best.items()}


def book():
    """Seconds to build the book cold and warm and to run the tests; the explorer's own report."""
    python = ROOT / ".venv/bin/python"

    def timed(*command):
        start = time.perf_counter()
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stdout + done.stderr)
        return time.perf_counter() - start, done.stdout

    with tempfile.TemporaryDirectory() as folder:
        build = [
            python.with_name("jupyter-book"),
            "build",
            ".",
            "-W",
            "-n",
            "--keep-going",
            "--all",
            "--path-output",
            folder,
        ]
        cold, warm = timed(*build)[0], timed(*build)[0]
        html = Path(folder, "_build/html")
        explorer = timed(python, HERE / "bench_explorer.py", html)[1]
    tests = timed("make", "test")[0]
    return {"cold": cold, "warm": warm, "tests": tests, "explorer": explorer.splitlines()}


def measure():
    """All but the book."""
    sys.path[:0] = [str(ROOT), str(HERE)]
    import peers

    from suspension.course import Hgauss, the_robot

    results, robot = {"machine": machine()}, the_robot()
    for name, work in (("a", work_a), ("b", work_b), ("c", work_c), ("d", work_d), ("e", work_e)):
        print(work.__doc__, flush=True)
        results[name] = work(robot, Hgauss, peers)
    return results | {"parts": parts(robot, Hgauss)}


def main():
    """Measure what is asked for, keep the rest."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--book", action="store_true", help="time the book and its tests too")
    parser.add_argument("--draw", action="store_true", help="measure nothing")
    options = parser.parse_args()
    results = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    if not options.draw:
        results |= measure()
    if options.book:
        results["book"] = book()
    RESULTS.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    results = json.loads(RESULTS.read_text(encoding="utf-8"))
    sys.path[:0] = [str(ROOT), str(HERE)]
    import show

    print(show.write(results))


if __name__ == "__main__":
    main()
