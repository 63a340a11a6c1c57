"""Wrong calls that type checkers must find: mypy reports each line that ends with "error", and no other."""

from pathlib import Path

import numpy as np
import rholm

body = rholm.bumpy_sphere(3)
s = rholm.expand(body, degree=8)
rholm.expand(3)  # error
rholm.expand(None)  # error
rholm.expand(s)  # error
rholm.expand(body, "8")  # error
rholm.expand(body, degre=8)  # error
rholm.expand(body, method="egde")  # error
rholm.expand(body, tolerance="small")  # error
rholm.expand(body.vertices)  # error
rholm.expand((body.vertices, body.faces), 8)
rholm.expand(Path("body.ply"), 8)
rholm.expand(rholm.repair(body), 8)
rholm.reconstruct(3)  # error
rholm.reconstruct(body.vertices, holes="close")  # error
rholm.reconstruct(body.vertices.tolist())
rholm.orient(None)  # error
rholm.compress(body)  # error
rholm.compress(body, 0.1, tolerence=0.1)  # error
rholm.smooth(body, 3, 0.5)  # error
rholm.smooth(body, np.zeros(642, bool), 0.5)
print(rholm.smooth(body, [1, 2, 3], 0.5).face)  # error
rholm.low_pass(2, 4, "lanczoz")  # error
rholm.harmonics.power_spectrum(3)  # error
rholm.harmonics.power_spectrum(s.coeffs)
s.rotate(0.3)  # error
s.rotate(np.eye(3))
s.degree = 3  # error
rholm.weld(body)  # error
rholm.meshes.weld(body)
rholm.icosphere("3")  # error
rholm.render(body, 64)  # error
