#!/usr/bin/env python3
"""Runs `dsc reconstruct` with its defaults on the clouds of shapes.json and judges components, cavities and genus.

    run.py --dsc PATH [--only PATTERN] [--jobs N] [--work FOLDER] [--require SHARE]

Prints a row per cloud and the rates. Exits 0 whatever the results, 1 below --require.
"""

import argparse
import re
import sys

import packages  # noqa: F401
from clouds import Truths, cloud_file, table
from reconstruction import HEADER, Outcome, add_options, each, finish, line, reconstruct


def main():
    parser = argparse.ArgumentParser()
    add_options(parser)
    parser.add_argument("--only", default="", help="a regular expression on names, as ^torus or -noise$")
    options = parser.parse_args()
    truths = Truths(options.work / "truth")
    chosen = [cloud for cloud in table() if re.search(options.only, cloud.name)]
    files = {cloud.name: cloud_file(cloud, options.work / "clouds", truths) for cloud in chosen}

    def judge(cloud):
        found = reconstruct(options.dsc, files[cloud.name], options.work / "results" / cloud.name, options.threads, options.option)
        return Outcome(cloud.name, cloud.shape, cloud.kind, cloud.truth, **found)

    print(HEADER)
    outcomes = []
    for outcome in each(options.jobs, judge, chosen):
        outcomes.append(outcome)
        print(line(outcome, options.flag), flush=True)
    return finish(outcomes, options)


if __name__ == "__main__":
    sys.exit(main())
