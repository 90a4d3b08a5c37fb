#!/usr/bin/env python3
"""Compares sequences of tests/random bare and under the layer, and reduces the ones that differ to few calls.

    tests/random/reduce.py [--api egl|glx|osmesa] [--without CLASSES] [--atlas layers] [--reduce] [--mesa] FIRST COUNT

Prints the seeds that differ; with --reduce, for each of them, the steps that can be left out (--drop), the calls that remain and
the first answers that differ. Sequences that are nondeterministic in Mesa alone are left out, unless --mesa is
given. Needs `make build` and one run of the test, which builds the programs.
"""
import argparse
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TARGET = os.path.join(ROOT, "target")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--api", default="egl")
    parser.add_argument("--without", default="")
    parser.add_argument("--atlas", default="side-by-side")
    parser.add_argument("--views", default="3")
    parser.add_argument("--reduce", action="store_true")
    parser.add_argument("--mesa", action="store_true")
    parser.add_argument("first", type=int)
    parser.add_argument("count", type=int, nargs="?", default=1)
    return parser.parse_args()


class Side:
    def __init__(self, options, layer):
        self.options = options
        name = "random-osmesa" if options.api == "osmesa" else "random"
        self.program = os.path.join(TARGET, "test-programs", name)
        self.environment = {**os.environ, "LP_NUM_THREADS": "0", "GALLIVM_PERF": "nopt"}
        if layer:
            self.environment |= {
                "LD_PRELOAD": os.path.join(TARGET, "release", "libmanyview.so"),
                "MANYVIEW_VIEWS": options.views,
                "MANYVIEW_STRATEGY": "replay",
                "MANYVIEW_ATLAS": options.atlas,
            }

    def lines(self, first, count=1, drop=(), more=(), variables=None):
        command = [self.program, "--api", self.options.api, "--seed", str(first), "--count", str(count)]
        command += ["--without", self.options.without, *more]
        if drop:
            command += ["--drop", ",".join(drop)]
        try:
            done = subprocess.run(command, env=self.environment | (variables or {}), capture_output=True, text=True, errors="replace", timeout=300)
        except subprocess.TimeoutExpired:
            return ["it does not end"]
        told = re.sub(r" calls \d+", "", done.stdout)  # with --apart there are others
        return told.splitlines() + (["it ends with %d" % done.returncode] if done.returncode else [])


def both(sides, *of):
    with ThreadPoolExecutor() as pool:
        return pool.map(lambda side: side.lines(*of), sides)


def differs(sides, seed, drop):
    bare, layer = both(sides, seed, 1, drop)
    # A crash of the driver alone is no difference, nor is what a glFlush, a culled triangle and the contents of new memory change.
    if bare == layer or bare[-1].startswith("it "):
        return False
    other = [sides[0].lines(seed, 1, drop, (how,)) for how in ("--disturb", "--apart")]
    other += [sides[0].lines(seed, 1, drop, (), {"MALLOC_PERTURB_": byte}) for byte in ("85", "170")]
    return sides[0].options.mesa or all(lines == bare for lines in other)


def differing(sides, first, count, batch=50):
    """Seeds that differ; a batch is looked at seed by seed where it crashes."""
    for at in range(first, first + count, batch):
        n = min(batch, first + count - at)
        bare, layer = both(sides, at, n)
        if any(lines and lines[-1].startswith("it ") for lines in (bare, layer)):
            yield from (seed for seed in range(at, at + n) if differs(sides, seed, ()))
            continue
        seeds = sorted({int(a.split()[1]) for a, b in zip(bare, layer) if a != b})
        # What a sequence leaves in the process may matter: alone it may be the same.
        yield from (seed for seed in seeds if differs(sides, seed, ()))


def parts(side, seed):
    """Steps, and parts of steps, that the sequence has."""
    trace = "\n".join(side.lines(seed, 1, (), ("--trace",)))
    found = {(int(a), int(b)) for a, b in re.findall(r"^(\d+)\.(\d+) ", trace, re.M)}
    return sorted({str(step) for step, _ in found}, key=int), sorted(found)


def smaller(test, items, dropped):
    """Leaves out halves, quarters … of the items while the test still fails."""
    size = max(1, len(items) // 2)
    while True:
        at = 0
        while at < len(items):
            chunk = items[at : at + size]
            if test(dropped + chunk):
                dropped, items = dropped + chunk, items[:at] + items[at + size :]
            else:
                at += size
        if size == 1:
            return items, dropped
        size = max(1, size // 2)


def reduce(sides, seed):
    def test(drop):
        return differs(sides, seed, drop)

    if not test([]):
        return print(f"seed {seed}: alone it is the same")
    steps, every = parts(sides[0], seed)
    kept, dropped = smaller(test, steps, [])
    inner = [f"{step}.{part}" for step, part in every if str(step) in kept and part]
    _, dropped = smaller(test, inner, dropped)
    print(f"--- seed {seed} --drop {','.join(dropped)}")
    trace = sides[0].lines(seed, 1, dropped, ("--trace",))
    print("\n".join(line for line in trace if not line.startswith("seed ")))
    bare, layer = (side.lines(seed, 1, dropped, ("--rows",)) for side in sides)
    other = [(a, b) for a, b in zip(bare, layer) if a != b and not a.startswith("seed ")]
    for a, b in other[:6]:
        print(f"  bare:  {a[:200]}\n  layer: {b[:200]}")
    if len(bare) != len(layer):
        print(f"  {len(bare)} and {len(layer)} lines: {layer[-1]}")
    print(f"  {len(other)} lines differ", flush=True)


def main():
    options = arguments()
    sides = Side(options, False), Side(options, True)
    seeds = []
    for seed in differing(sides, options.first, options.count):
        seeds.append(seed)
        if options.reduce:
            reduce(sides, seed)
    print(f"{len(seeds)} of {options.count} differ: {' '.join(map(str, seeds))}")
    return bool(seeds)


if __name__ == "__main__":
    sys.exit(main())
