#!/usr/bin/env python3
"""What a plugin's door costs: the instructions of a step through it against those of the same code linked in.

    door.py --program dsc_door

Exits 1 above 1 %, 77 (skipped) without valgrind.
"""
import argparse
import shutil
import sys

import gate

ALLOWED = 0.01


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    program = parser.parse_args().program
    if not shutil.which("valgrind"):
        print("SKIPPED: valgrind is not installed")
        return gate.SKIPPED
    counted, said = zip(*(gate.count_instructions([program, way]) for way in ("plugin", "linked")))
    if said[0] != said[1]:
        print(f"the two ways come to different results: {said[0]} and {said[1]}")
        return 1
    cost = counted[0] / counted[1] - 1
    print(f"{said[0]}: {counted[0]:,} instructions through the door, {counted[1]:,} linked in, {100 * cost:+.3f} %")
    return 0 if cost < ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main())
