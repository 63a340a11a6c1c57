#!/usr/bin/env python3
"""Makes the pictures of the guides from the examples of the guides.

Usage: docs/guides/pictures.py [GUIDE...]      for example: planetary cells; all guides by default

Runs the examples of a guide in their order, in a temporary folder. A picture
docs/images/guide-GUIDE-NAME.png (or .svg) that a guide shows is the file NAME.png (or .svg) that its
examples write. PNG files get a palette of 256 colours where this changes no pixel by more than 12 of 255
levels, so that they are smaller.

Needs the package rholm (PYTHONPATH=BUILD/python), the program in RHOLM_PROGRAM, and the packages of
scripts/requirements-python.txt. It takes about a minute.
"""

import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageChops

GUIDES = Path(__file__).resolve().parent
IMAGES = GUIDES.parent / "images"
sys.path.insert(0, str(GUIDES.parents[1] / "python" / "tests"))
os.environ["MPLBACKEND"] = "agg"

import test_guides  # noqa: E402


def keep(source, target):
    """Copies a picture, with a palette if it is a PNG file and the palette changes little."""
    if source.suffix != ".png":
        shutil.copyfile(source, target)
        return
    picture = Image.open(source).convert("RGB")
    fewer = picture.quantize(
        256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE
    )
    changes = ImageChops.difference(picture, fewer.convert("RGB")).getextrema()
    largest = max(high for _, high in changes)
    (fewer if largest <= 12 else picture).save(target, optimize=True)


def main():
    """Runs the guides that the command line names."""
    names = sys.argv[1:] or ["planetary", "cells", "particles", "graphics"]
    for name in names:
        text = (GUIDES / f"{name}.md").read_text()
        shown = re.findall(rf"\]\(\.\./images/(guide-{name}-([\w-]+\.\w+))\)", text)
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            left_out = test_guides.run_page(text, f"{name}.md", Path(folder))
            if left_out:
                sys.exit(f"pictures: left out: {', '.join(left_out)}")
            for target, source in shown:
                keep(Path(folder) / source, IMAGES / target)
            os.chdir(GUIDES)
        print(f"pictures: {name}: {', '.join(target for target, _ in shown)}")


if __name__ == "__main__":
    main()
