"""Point clouds from formulas: normals that contradict each other, and points that do not lie on a surface.

Every cloud must give the right surface, or exit code 3 or 4 with a message. Without options a few small
clouds are tested. Options test many:
  clouds_test.py --normals [N]   N clouds (40) with 0 to 50 % of turned normals
  clouds_test.py --shapes        points without a surface, of three sizes
  clouds_test.py --thresholds    measures of local_shape.cpp for both
  clouds_test.py --crossings     crossing_length of bodies and of intersecting sheets
  clouds_test.py --walls [SEED]  points_off_surface of noisy bodies and plates, of points without a surface, and
                                 of the real shapes in RHOLM_SHAPES (with trimesh)"""

import os
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, main, nightly
try:
    import numpy as np
    import clouds
except ImportError:  # NumPy is missing
    np = None

# Relative error allowed for volumes: caps on a thousand points are as accurate as this.
CLOSE = 0.06


def spoiled(body, way, share, n, noise=0.0):
    """Returns points, normals, and the number of turned normals."""
    rng = np.random.default_rng(zlib.crc32(f"{body} {way} {share} {n} {noise}".encode()))
    points, normals = clouds.BODIES[body][0](rng, n)
    turned = clouds.SPOILED[way](rng, points, share)
    points = points + noise * np.linalg.norm(np.ptp(points, axis=0)) * rng.normal(size=points.shape)
    return points, np.where(turned[:, None], -normals, normals), int(turned.sum())


def with_noise(rng, make, n, noise):
    """Returns points with noise, given in units of the diagonal."""
    points = make(rng, n)
    return points + noise * np.linalg.norm(np.ptp(points, axis=0)) * rng.normal(size=points.shape)


@unittest.skipIf(np is None, "no NumPy")
class Clouds(CliTest):
    def reconstruct(self, points, normals=None, *words):
        """Returns the finished run, and the report of info about the surface."""
        self.write("p.xyz", clouds.text(points, normals))
        done = self.run_rholm("reconstruct", "p.xyz", "-o", "s.ply", "--json", "--threads", "1", *words)
        self.check_decent(done)
        self.assertIn(done.code, (0, 3, 4), done)
        shape = None if done.code == 3 else self.rholm("info", "s.ply", "--json").json()
        return done, shape

    def fault(self, body, done, shape):
        """Returns the fault of a surface for which the program did not warn."""
        volume, genus = clouds.BODIES[body][1:]
        if done.code != 0:
            return ""
        if shape["genus"] != genus:
            return f"genus {shape['genus']}"
        if volume and abs(shape["volume"] / volume - 1) > CLOSE:
            return f"volume {shape['volume'] / volume:.3f} of what is right"
        return ""

    def test_turned_normals_are_mended_with_a_note(self):
        for body, way, share in (("sphere", "random", 0.5), ("torus", "patch", 0.1),
                                 ("box", "half", 0.4), ("two_balls", "random", 0.45),
                                 ("plate", "caps", 0.1)):
            points, normals, turned = spoiled(body, way, share, 1200)
            done, shape = self.reconstruct(points, normals)
            self.assertEqual((done.code, self.fault(body, done, shape)), (0, ""), done)
            self.assertIn("were reversed", done.err)
            if share < 0.45:
                self.assertAlmostEqual(done.json()["mended_normals"], turned, delta=0.01 * turned)

    def test_right_normals_stay(self):
        for body in ("sphere", "plate", "shell", "two_balls", "bowl"):
            points, normals, _ = spoiled(body, "random", 0, 1200)
            done, shape = self.reconstruct(points, normals)
            self.assertEqual((done.code, self.fault(body, done, shape)), (0, ""), done)
            found = done.json()
            self.assertEqual((found["mended_normals"], found["contradicting_normals"],
                              found["inward_normals"]), (0, 0, 0), body)
            self.assertNotIn("were reversed", done.err)

    def test_directions_at_random_are_computed_anew(self):
        rng = np.random.default_rng(1)
        points, _ = clouds.torus(rng, 1500)
        done, shape = self.reconstruct(points, clouds.directions(rng, 1500))
        self.assertEqual((done.code, self.fault("torus", done, shape)), (0, ""), done)
        self.assertIn("off the surface", done.err)
        self.assertTrue(done.json()["computed_normals"])

    def test_a_body_turned_inside_out_beside_another_is_turned(self):
        rng = np.random.default_rng(2)
        big = clouds.sphere(rng, 1000)
        points, normals = clouds.joined(big, clouds.turned(clouds.sphere(rng, 500, 0.6, (2, 0, 0))))
        done, shape = self.reconstruct(points, normals)
        self.assertEqual((done.code, self.fault("two_balls", done, shape)), (0, ""), done)
        self.assertEqual(done.json()["mended_normals"], 500)

    def test_points_of_no_surface_are_refused(self):
        for name in ("ball", "lattice", "circle", "line"):
            make, kind = clouds.NO_SURFACE[name]
            done, _ = self.reconstruct(make(np.random.default_rng(3), 500))
            self.assertEqual(done.code, 3, done)
            self.assertIn(kind, done.err)

    def test_points_that_fill_thin_bodies_are_refused_with_places(self):
        for name, n in (("thin_slab", 1500), ("layers", 768), ("tetrahedron", 1000),
                        ("wall_of_shell", 4000)):
            make = getattr(clouds, name)
            done, _ = self.reconstruct(make(np.random.default_rng(13), n))
            self.assertEqual(done.code, 4, done)
            self.assertRegex(done.err, r"are away from the surface.* first at( \(.*\);){2} \(.*\)\. They fill a volume")

    @nightly
    def test_tiles_refuse_points_that_fill_thin_bodies(self):
        for name in ("thin_slab", "wall_of_shell"):
            points = getattr(clouds, name)(np.random.default_rng(14), 4000)
            done, _ = self.reconstruct(points, None, "--tile-points", "1000")
            self.assertEqual(done.code, 4, done)
            self.assertIn("They fill a volume", done.err)

    @nightly
    def test_walls_nearer_than_noise_allows_are_refused(self):
        rng = np.random.default_rng(15)
        for noise, code in ((0.02, 0), (0.06, 4)):  # the plate is 0.2 thick
            points, normals = clouds.plate(rng, 3000)
            points = points + noise * rng.normal(size=points.shape)
            turned = clouds.in_patch(rng, points, 0.1)
            for given in (None, normals, np.where(turned[:, None], -normals, normals) if code else normals):
                done, shape = self.reconstruct(points, given)
                self.assertEqual((done.code, self.fault("plate", done, shape)), (code, ""), done)
                if code == 4:
                    self.assertIn("noise exceeds the thickness of the body", done.err)

    def test_sheets_that_cross_are_refused_with_places(self):
        for name, n, noise in (("crossing_planes", 1500, 0.005), ("crossing_spheres", 2000, 0)):
            points = with_noise(np.random.default_rng(11), clouds.NO_SURFACE[name][0], n, noise)
            done, _ = self.reconstruct(points)
            self.assertEqual(done.code, 4, done)
            self.assertRegex(done.err, r"sheets of the points cross each other, first near( \(.*\);){2} \(.*\),")
        tiles, _ = self.reconstruct(points, None, "--tile-points", "1000")
        self.assertEqual((tiles.code, tiles.err.splitlines()[-1]), (4, done.err.splitlines()[-1]))

    def test_sheets_that_bend_end_or_touch_do_not_cross(self):
        for make in (clouds.tee, clouds.touching, lambda rng, n: clouds.box(rng, n)[0]):
            done, _ = self.reconstruct(with_noise(np.random.default_rng(12), make, 1500, 0.005))
            self.assertNotIn("cross", done.err)
            if done.out:
                self.assertLess(done.json()["crossing_length"], 0.05)

    def test_noise_is_no_volume(self):
        rng = np.random.default_rng(4)
        points, normals = clouds.sphere(rng, 3000)
        points = points + 0.0866 * rng.normal(size=points.shape)  # 2.5 % of the diagonal
        for given in (None, normals):
            done, shape = self.reconstruct(points, given)
            self.assertEqual((done.code, self.fault("sphere", done, shape)), (0, ""), done)

    @nightly
    def test_tiles_mend_as_one_piece_does(self):
        for body, way, share in (("sphere", "random", 0.5), ("torus", "patch", 0.1), ("two_balls", "half", 0.3)):
            points, normals, turned = spoiled(body, way, share, 4000)
            done, shape = self.reconstruct(points, normals, "--tile-points", "1000")
            self.assertEqual((done.code, self.fault(body, done, shape)), (0, ""), done)
            self.assertIn("were reversed", done.err)
            self.assertGreater(done.json()["tiles"], 3)
            one = self.reconstruct(points, normals)[0].json()
            self.assertEqual((done.json()["mended_normals"], done.json()["contradicting_normals"]),
                             (one["mended_normals"], one["contradicting_normals"]), body)

    def test_tiles_name_what_they_cannot_mend(self):
        points, normals, _ = spoiled("bowl", "half", 0.45, 4000)
        done, _ = self.reconstruct(points, normals, "--tile-points", "1000")
        self.assertEqual(done.code, 4, done)
        self.assertRegex(done.err, r"contradict their neighbours, first at( \(.*\);){2} \(.*\):")

    @nightly
    def test_tiles_compute_directions_at_random_anew(self):
        rng = np.random.default_rng(1)
        points, _ = clouds.torus(rng, 4000)
        done, shape = self.reconstruct(points, clouds.directions(rng, 4000), "--tile-points", "1000")
        self.assertEqual((done.code, self.fault("torus", done, shape)), (0, ""), done)
        self.assertIn("off the surface", done.err)
        self.assertTrue(done.json()["computed_normals"])

    @nightly
    def test_tiles_cut_handles_beside_what_was_cut_before(self):
        points, normals = clouds.joined(clouds.sphere(np.random.default_rng(8), 2000),
                                        clouds.sphere(np.random.default_rng(9), 2000, 1, (0.8, 0, 0)))
        done, _ = self.reconstruct(points, normals, "--tile-points", "1000")
        self.assertEqual(done.code, 4, done)
        self.assertIn("sheets of the points cross each other", done.err)

    def test_normals_at_random_are_not_called_inward(self):
        points, normals, _ = spoiled("sphere", "random", 0.6, 1500)
        self.write("p.xyz", clouds.text(points, normals))
        done = self.rholm("reconstruct", "p.xyz", "-o", "s.ply")
        self.assertNotIn("inwards", done.out + done.err)
        self.assertRegex(done.err, r"\d+ of 1500 normals contradicted their neighbours and were reversed")

    def test_normals_that_are_all_zero_are_none(self):
        points, normals = clouds.sphere(np.random.default_rng(5), 100)
        self.write("zero.xyz", clouds.text(points, 0 * normals))
        self.assertFalse(self.rholm("info", "zero.xyz", "--json").json()["normals"])
        self.assertRegex(self.rholm("info", "zero.xyz").out, "normals +no")

    def test_a_point_however_far_is_an_outlier(self):
        for far in (1e20, 1e150, 1e308):
            points = np.concatenate([clouds.sphere(np.random.default_rng(6), 300)[0],
                                     [[0.1, 0.2, far]]])
            self.write("far.xyz", clouds.text(points))
            self.assertEqual(self.rholm("orient", "far.xyz", "-o", "o.ply", "--json").json()["outliers"], 1)


def many_normals(count):
    bodies, ways = list(clouds.BODIES), list(clouds.SPOILED)
    wrong = 0
    for k in range(count):
        body, way = bodies[k % len(bodies)], ways[(k // 3) % len(ways)]
        share, n = 0.5 * k / max(1, count - 1), (800, 2000, 6000)[k % 3]
        noise = (0, 0, 0.002, 0.005)[k % 4]
        points, normals, turned = spoiled(body, way, share, n, noise)
        test = Clouds("reconstruct")
        with tempfile.TemporaryDirectory() as folder:
            test.folder = Path(folder)
            done, shape = test.reconstruct(points, normals)
        fault = test.fault(body, done, shape)
        if done.code == 0 and turned > 0 and "turned" not in done.err:
            fault = fault or "nothing said"
        wrong += fault != ""
        mended = done.json()["mended_normals"] if done.out else "-"
        print(f"{body:10} {way:7} {share:.3f} of {n:5}, noise {noise:5}: {turned:5} turned, {mended:>5} "
              f"mended, exit {done.code} {fault}", flush=True)
    print(f"{wrong} of {count} are wrong")
    return wrong > 0


def many_shapes():
    wrong = 0
    for n in (400, 1500, 6000):
        for name, (make, kind) in clouds.NO_SURFACE.items():
            test = Clouds("reconstruct")
            with tempfile.TemporaryDirectory() as folder:
                test.folder = Path(folder)
                done, _ = test.reconstruct(make(np.random.default_rng(n), n))
            told = done.code and (not kind or any(one in done.err for one in kind.split("|")))
            fault = "" if told else "not told"
            wrong += fault != "" and kind is not None
            print(f"{name:16} {n:5}: exit {done.code} {fault}", flush=True)
    print(f"{wrong} are wrong")
    return wrong > 0


def crossings():
    """Prints crossing_length as `rholm reconstruct` computes it: kMostCrossing lies between bodies and
    intersecting sheets."""
    bodies = {name: lambda rng, n, make=make: make(rng, n)[0] for name, (make, _, _) in clouds.BODIES.items()}
    bodies |= {"thin": clouds.thin, "tee": clouds.tee, "touching": clouds.touching}
    crossing = {name: make for name, (make, _) in clouds.NO_SURFACE.items() if "crossing" in name}
    wrong = 0
    for kind, makes in (("body", bodies), ("crossing", crossing)):
        for name, make in makes.items():
            for n in (800, 4000, 12000):
                found = []
                for noise in (0, 0.002, 0.005, 0.01):
                    points = with_noise(np.random.default_rng(n), make, n, noise)
                    test = Clouds("reconstruct")
                    with tempfile.TemporaryDirectory() as folder:
                        test.folder = Path(folder)
                        done, _ = test.reconstruct(points)
                    length = done.json()["crossing_length"] if done.out else 0
                    wrong += (length > 0.12) != (kind == "crossing")
                    found.append(f"{length:.3f}")
                print(f"{kind:8} {name:16} {n:5}: {' '.join(found)}", flush=True)
    print(f"{wrong} are on the other side of kMostCrossing")
    return False


def real_shapes():
    """Returns the meshes in RHOLM_SHAPES by name."""
    folder = os.environ.get("RHOLM_SHAPES")
    try:
        import trimesh
    except ImportError:
        folder = None
    if not folder:
        print("no real shapes: RHOLM_SHAPES is not set, or there is no trimesh")
        return {}
    names = ("armadillo-43k.obj", "bunny-closed-cgal.off", "elephant-with-holes.off", "fandisk.obj", "igea.ply",
             "rocker-arm.obj", "stanford-dragon.ply", "asteroid-toutatis.ply", "max-planck-10k.obj")
    return {name: trimesh.load(Path(folder) / name) for name in names if (Path(folder) / name).exists()}


def walls(seed):
    """Prints points_off_surface as `rholm reconstruct` computes it: kMostOffSurface lies between bodies and
    points without a surface."""
    plates = {thin: lambda rng, n, thin=thin: clouds.box(rng, n, (2, 2, thin)) for thin in (0.6, 0.3)}
    bodies = {name: make for name, (make, _, _) in clouds.BODIES.items() if name != "plate"} | plates
    for name, mesh in real_shapes().items():
        def sampled(rng, n, mesh=mesh):
            triangles = np.asarray(mesh.triangles)
            twice = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
            area = np.linalg.norm(twice, axis=1)
            chosen = rng.choice(len(area), n, p=area / area.sum())
            weights = rng.exponential(size=(n, 3))
            at = np.einsum("nk,nkx->nx", weights / weights.sum(axis=1)[:, None], triangles[chosen])
            return at, twice[chosen] / area[chosen, None]
        bodies[name] = sampled
    filled = {name: make for name, (make, kind) in clouds.NO_SURFACE.items() if kind and "volume" in kind}
    filled |= {f"slab {thin}": lambda rng, n, thin=thin: clouds.slab(rng, n, thin) for thin in (0.1, 0.2, 0.25)}
    filled |= {f"plate {noise}": lambda rng, n, noise=noise: clouds.plate(rng, n)[0] + noise * rng.normal(size=(n, 3))
               for noise in (0.05, 0.06, 0.07)}
    wrong = 0

    def look(name, points, normals=None):
        test = Clouds("reconstruct")
        with tempfile.TemporaryDirectory() as folder:
            test.folder = Path(folder)
            done, _ = test.reconstruct(points, normals)
        return done.json()["points_off_surface"] if done.out else np.nan, done.code
    for n in (500, 1000, 4000, 16000):
        for name, make in bodies.items():
            found = []
            for noise in (0, 0.003, 0.01):
                rng = np.random.default_rng([seed, n])
                points, normals = make(rng, n)
                scatter = noise * np.linalg.norm(np.ptp(points, axis=0))
                points = points + scatter * rng.normal(size=points.shape)
                found += [look(name, points), look(name, points, normals)]
            wrong += sum(off > 0.5 for off, _ in found)
            print(f"surface {name!s:24} {n:5}:", *(f"{off:.3f} (exit {code})" for off, code in found), flush=True)
        for name, make in filled.items():
            off, code = look(name, make(np.random.default_rng([seed, n]), n))
            wrong += code == 0
            print(f"volume  {name:24} {n:5}: {off:.3f} (exit {code})", flush=True)
    print(f"{wrong} are on the other side of kMostOffSurface")
    return False


def thresholds():
    """Prints the median thickness and kurtosis of the flattest neighbourhoods, as local_shape.cpp computes
    them."""
    def look(points):
        best = (2.0, 3.0, 0)
        seeds = points[:: max(1, len(points) // 100)]
        ways = np.linalg.norm(points[None] - seeds[:, None], axis=2).argsort(axis=1)
        k = 12
        while k <= len(points) // 4:
            found = []
            for near in ways[:, :k + 1]:
                around = points[near] - points[near].mean(axis=0)
                values, vectors = np.linalg.eigh(around.T @ around)
                heights = around @ vectors[:, 0]
                found.append((np.sqrt(max(values[0], 0) / values[1]), np.sqrt(values[1] / values[2]),
                              (heights ** 4).mean() / max((heights ** 2).mean() ** 2, 1e-300)))
            thick, wide, kurtosis = np.median(found, axis=0)
            if wide >= 0.4 and thick < best[0]:
                best = (thick, kurtosis, k)
            k += k // 2
        return best
    for n in (400, 1500, 6000):
        rng = np.random.default_rng(n)
        rows = [(name, make(rng, n)) for name, (make, kind) in clouds.NO_SURFACE.items() if kind]
        for name, (make, _, _) in clouds.BODIES.items():
            for noise in (0, 0.005, 0.01, 0.025):
                points = make(rng, n)[0]
                scatter = noise * np.linalg.norm(np.ptp(points, axis=0))
                rows.append((f"{name} {noise}", points + scatter * rng.normal(size=points.shape)))
        for name, points in rows:
            thick, kurtosis, k = look(points)
            print(f"{name:16} {n:5}: thickness {thick:.3f}, kurtosis {kurtosis:.2f}, of {k} points", flush=True)
    return False


if __name__ == "__main__":
    if "--normals" in sys.argv:
        sys.exit(many_normals(int(sys.argv[2]) if len(sys.argv) > 2 else 40))
    if "--shapes" in sys.argv:
        sys.exit(many_shapes())
    if "--crossings" in sys.argv:
        sys.exit(crossings())
    if "--walls" in sys.argv:
        sys.exit(walls(int(sys.argv[2]) if len(sys.argv) > 2 else 1))
    if "--thresholds" in sys.argv:
        sys.exit(thresholds())
    main()
