"""Fuzz the readers for long, each in a process of its own.

Where atheris is installed (it has builds for Linux on x86-64 and Python 3.11 to 3.13), it leads the mutations to
lines of ours that no input has reached yet; elsewhere, or with --plain, they are blind. What it has found worth keeping
stays in .fuzz/<target>, where the next run goes on; an input that does harm is written beside it.
"""

import argparse
import hashlib
import importlib.util
import os
import subprocess
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

from tests.fuzz import NAMES

FOLDER = Path(".fuzz")
_MEMORY = Path("/dev/shm")  # noqa: S108 - where archives are unpacked, if it is there: a disk would be what is timed
_COMPILED = ("gelenk.robot.poses", "gelenk.kinematics.simd.kernels", "gelenk.kinematics.simd.lanes")
"""Modules of functions that numba compiles: with traces in them it cannot."""
_TELL_EVERY = 50_000


def main() -> None:
    """Parse the arguments; fuzz one target after the other."""
    parser = argparse.ArgumentParser(prog="./dev fuzz", description=__doc__)
    parser.add_argument("targets", nargs="*", metavar="target", help=f"of {', '.join(NAMES)} (default: all)")
    parser.add_argument("--runs", type=int, default=0, help="inputs for each target (default: as time allows)")
    parser.add_argument("--seconds", type=int, default=60, help="for each target, where no runs are given")
    parser.add_argument("--seed", type=int, default=1, help="of the mutations")
    parser.add_argument("--plain", action="store_true", help="blind mutations, also where atheris is installed")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if unknown := sorted(set(arguments.targets) - set(NAMES)):
        parser.error(f"there is no target {', '.join(unknown)}; there are {', '.join(NAMES)}")
    led = not arguments.plain and importlib.util.find_spec("atheris") is not None
    if arguments.here:
        warnings.simplefilter("error")
        (fuzz_led if led else fuzz_blindly)(arguments.targets[0], arguments.runs, arguments.seconds, arguments.seed)
        return
    options = [argument for argument in sys.argv[1:] if argument not in NAMES]
    environment = {**os.environ, "TMPDIR": str(_MEMORY)} if _MEMORY.is_dir() else None
    failed = []
    for name in arguments.targets or NAMES:
        print(f"{name}: {'led by atheris' if led else 'blind'}", flush=True)
        command = [sys.executable, "-m", "tests.fuzz", name, *options, "--here"]
        if subprocess.run(command, env=environment, check=False).returncode != 0:
            failed.append(name)
    if failed:
        sys.exit(f"harm was done to: {', '.join(failed)}; the inputs are in {FOLDER}/")


def fuzz_led(name: str, runs: int, seconds: int, seed: int) -> None:
    """Let libFuzzer choose the inputs by what they reach; it ends the process."""
    import atheris

    with atheris.instrument_imports(include=["gelenk"], exclude=_COMPILED):
        from tests.fuzz.targets import TARGETS
    target = TARGETS[name]
    target.warm()
    corpus = FOLDER / name
    corpus.mkdir(parents=True, exist_ok=True)
    for data in (*target.seeds.good, *target.seeds.bad):
        (corpus / hashlib.sha1(data, usedforsecurity=False).hexdigest()).write_bytes(data)

    def mutated(data: bytes, max_size: int, number: int) -> bytes:
        mutator = target.mutations(number)
        match number % 4:
            case 0:
                return mutator.mutated(data)[:max_size]
            case 1:  # from a seed: of what has been reached already, most is refused
                return next(mutator.inputs())[:max_size]
            case _:
                return bytes(atheris.Mutate(data, max_size))

    taken: Counter[bool] = Counter()

    def judge(data: bytes) -> None:
        taken[target.judge(data)] += 1
        if taken.total() % _TELL_EVERY == 0:
            print(f"{name}: {taken.total()} inputs, {taken[True]} of them taken", flush=True)

    limit = [f"-runs={runs}"] if runs else [f"-max_total_time={seconds}"]
    options = [f"-seed={seed}", "-timeout=20", "-rss_limit_mb=3000", "-max_len=20000", "-print_final_stats=1"]
    command = [sys.argv[0], *limit, *options, f"-artifact_prefix={FOLDER}/{name}-", str(corpus)]
    atheris.Setup(command, judge, custom_mutator=mutated)
    atheris.Fuzz()


def fuzz_blindly(name: str, runs: int, seconds: int, seed: int) -> None:
    """Mutations of the seeds, whatever they reach."""
    from tests.fuzz.targets import TARGETS

    target = TARGETS[name]
    target.warm()
    began = time.monotonic()
    count, taken = 0, 0
    for data in target.mutations(seed).inputs():
        if count >= runs if runs else time.monotonic() > began + seconds:
            break
        try:
            taken += target.judge(data)
        except Exception:
            FOLDER.mkdir(exist_ok=True)
            found = FOLDER / f"{name}-crash-{hashlib.sha1(data, usedforsecurity=False).hexdigest()}"
            found.write_bytes(data)
            print(f"input {count} does harm; it is in {found}", flush=True)
            raise
        count += 1
        if count % _TELL_EVERY == 0:
            print(f"{name}: {count} inputs, {taken} of them taken", flush=True)
    rate = count / (time.monotonic() - began)
    print(f"{name}: {count} inputs without harm, {taken} of them taken, {rate:.0f} a second")


if __name__ == "__main__":
    main()
