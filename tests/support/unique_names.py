#!/usr/bin/env python3
"""Fails if two tests of a build have the same name: ctest sets labels by name, so that one test would get
the other's label.

Usage: unique_names.py CTEST BUILD
"""

import collections
import json
import subprocess
import sys


def main():
    ctest, build = sys.argv[1:]
    shown = subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], check=True, text=True,
                           capture_output=True).stdout
    names = collections.Counter(test["name"] for test in json.loads(shown)["tests"])
    twice = [name for name, count in names.items() if count > 1]
    if twice:
        sys.exit("several tests of the name " + ", ".join(twice))
    print(f"{len(names)} tests, each of its own name")


if __name__ == "__main__":
    main()
