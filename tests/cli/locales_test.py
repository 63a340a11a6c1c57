"""Runs the tests of the program in locales where numbers have commas (German), and where I is not the
capital of i (Turkish). Texts, numbers and files must be the same."""

import locale
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOCALES = ("de_DE", "tr_TR")
# Tests that are fast enough for a run of all tests.
FAST = {"de_DE": ("meaning", "usage"), "tr_TR": ("usage",)}


def made(folder):
    """Makes the locales in a folder, because the system may not have them."""
    for name in LOCALES:
        subprocess.run(["localedef", "-i", name, "-f", "UTF-8", str(folder / f"{name}.UTF-8")],
                       check=True, capture_output=True)
    os.environ["LOCPATH"] = str(folder)
    # A library loaded by HDF5 (p11-kit) keeps a locale until the end. In the C locale these tests do search
    # for leaks.
    if "ASAN_OPTIONS" in os.environ:
        os.environ["ASAN_OPTIONS"] += ":detect_leaks=0"
    # Checks that the locale is in effect.
    locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
    if locale.localeconv()["decimal_point"] != ",":
        raise OSError("the locale de_DE.UTF-8 does not come into force")


def main():
    scripts, cases = sys.argv[1:], ["--every"] if sys.argv[1:] else []
    folder = Path(tempfile.mkdtemp(prefix="rholm-locales-"))
    try:
        try:
            made(folder)
        except (OSError, subprocess.CalledProcessError, locale.Error) as error:
            print(f"SKIPPED: no German and Turkish locale ({error}); 'scripts/setup test' installs "
                  "what they are made of")
            return 77  # CTest reports the test as skipped
        failed = 0
        for name in LOCALES:
            for script in scripts or FAST[name]:
                print(f"{name}: {script}", flush=True)
                failed += subprocess.run([sys.executable, "-B", HERE / f"{script}_test.py", *cases],
                                         env={**os.environ, "LC_ALL": f"{name}.UTF-8"}).returncode != 0
        return 1 if failed else 0
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
