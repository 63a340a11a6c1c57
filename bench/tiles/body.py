"""Makes a rough body of genus 5, for clouds of any size: five tori in a chain, displaced by waves.

Usage: body.py OUT.ply [CELLS]
"""

import sys

import numpy as np
import pyvista as pv

cells = int(sys.argv[2]) if len(sys.argv) > 2 else 320
spacing = 8.0 / cells
half = (4.0, 1.25, 0.9)
counts = [2 * int(np.ceil(h / spacing)) + 1 for h in half]
x, y, z = np.meshgrid(*[spacing * (np.arange(n) - n // 2) for n in counts], indexing="ij")
# A smooth minimum of the distances to the tori blends them into each other.
total = np.zeros_like(x)
for k in range(5):
    ring = np.hypot(x - 1.25 * (k - 2), y) - 0.75
    total += np.exp(-12 * (np.hypot(ring, z) - 0.3))
distance = -np.log(total) / 12
rng = np.random.default_rng(5)
for octave in range(5):
    frequency = 4.0 * 2**octave
    for _ in range(6):
        direction = rng.normal(size=3)
        direction *= frequency / np.linalg.norm(direction)
        phase = rng.uniform(0, 2 * np.pi)
        distance += (
            0.012 / 1.8**octave * np.sin(direction[0] * x + direction[1] * y + direction[2] * z + phase)
        )
grid = pv.ImageData(dimensions=counts, spacing=(spacing,) * 3)
grid["distance"] = distance.ravel(order="F")
surface = grid.contour([0.0], scalars="distance").triangulate().clean()
surface.connectivity("largest").extract_surface().save(sys.argv[1])
