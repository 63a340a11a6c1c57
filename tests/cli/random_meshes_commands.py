"""Every command of the program for a mesh, and for the results of commands.

trial.do(name, words, out=..., codes=...) runs a command, checks it, and returns true if it succeeded."""

import json

from harness import RHOLM
from limits import Run

DONE = {0}
REFUSED = {3}  # the command cannot use this shape
DONE_OR_REFUSED = DONE | REFUSED
ANY = DONE | REFUSED | {4}  # also: a tolerance is not kept, or normal orientations are unsure

# Cheap commands that read, write or refuse each in a different way.
CHEAP = {"info --json", "center", "compare", "render error", "convert .off", "convert .ply",
         "make sample", "orient MESH", "reconstruct MESH", "smooth", "transfer", "analyze edge",
         "analyze --signed", "analyze --norm max", "synthesize", "spectrum", "filter", "rotate",
         "align", "compare model", "convert model .json"}


def everything(trial):
    all_but_caps(trial)
    caps(trial)


def all_but_caps(trial):
    looked_at(trial)
    converted(trial)
    points(trial)
    edited(trial)
    if star(trial):
        star_model(trial)
    patches(trial)


def cheap(trial):
    trial.names = CHEAP
    all_but_caps(trial)


def looked_at(trial):
    m = trial.mesh
    trial.do("info", m, codes=DONE)
    trial.do("info --json", "info", m, "--json", codes=DONE)
    (trial.folder / "all.csv").write_text(f"path\n{m}\nnone.ply\n")
    trial.do("batch", "all.csv", "--command", "info", out="all-info.csv", codes=DONE)
    trial.do("center", m, "--json")
    trial.do("center --center", "center", m, "--rays", "200", "--center",
             trial.one_of("cosine", "volume", "centroid", "none"))
    trial.do("compare", m, m, "--samples", "300", "--json", codes=DONE)
    trial.do("render", m, m, "--size", "96x48",
             *trial.one_of((), ("--perspective",), ("--view", "0,1,0")), out="mesh.png", codes=DONE)
    trial.do("render error", "render", m, "--color", "error", "--against", m, "--size", "64x48",
             out="error.png", codes=DONE)
    trial.do("report", m, "--degree", "6", "--size", "32", out="mesh.html",
             codes=ANY)


def converted(trial):
    """Converts through all formats, each file made from the one before; formats of full precision keep
    every bit."""
    before = trial.mesh
    for kind in ("off", "ply", "obj", "stl"):
        after = f"converted.{kind}"
        # The range of single precision ends at 3e38 and at 1e-38.
        codes = DONE_OR_REFUSED if kind == "stl" else DONE
        if trial.do(f"convert .{kind}", "convert", before, after, made=after, codes=codes):
            before = after
    if trial.has("converted.obj"):
        trial.do("convert back", "convert", "converted.obj", "back.off", made="back.off", codes=DONE)
        trial.same("converted.off", "back.off")
    # The format cannot store triangles.
    trial.do("convert .xyz", "convert", trial.mesh, "corners.xyz", codes=REFUSED)


def points(trial):
    m, quick = trial.mesh, ("--resolution", "24")
    trial.do("make sample", "make", "sample", m, "--points", "400", out="points.ply", codes=DONE)
    trial.do("make sample (hard)", "make", "sample", m, "--points", "400", "--noise", "0.01",
             "--outliers", "0.1", "--holes", "2,0.05", "--no-normals", out="hard.xyz", codes=DONE)
    trial.do("orient MESH", "orient", m, out="oriented.ply", codes=ANY)
    if trial.has("hard.xyz"):
        trial.do("orient", "hard.xyz", "--json", *trial.one_of(
            (), ("--neighbors", "6"), ("--center", "0,0,0"), ("--sensor", "9,9,9"), ("--confidence",)),
            out="signed.off", codes=ANY)
        trial.do("reconstruct (hard)", "reconstruct", "hard.xyz", *quick, *trial.one_of(
            (), ("--holes", "keep"), ("--tolerance", "0.01"), ("--blend", "spline"),
            ("--noise", "0.01"), ("--min-component", "0", "--keep-outliers"), ("--confidence",),
            ("--sensor", "9,9,9")), out="hard.off", codes=ANY)
    trial.do("reconstruct MESH", "reconstruct", m, *quick, out="vertices.ply", codes=ANY)
    if trial.has("points.ply"):
        words = ("reconstruct", "points.ply", "--simplify", "50%", "--model", "points.h5", "--json")
        if trial.do("reconstruct", *words, *quick, out="surface.off"):
            trial.do("synthesize (reconstruct)", "synthesize", "points.h5", out="again.off",
                     codes=DONE)


def edited(trial):
    m, d = trial.mesh, trial.diagonal
    near, far = f"vertex:0,{d / 4!r}", f"vertex:{trial.vertices // 2},{d / 4!r}"
    # Wavelengths below two edges are refused.
    wavelength = ("--wavelength", repr(max(d / 8, 4 * trial.edge)))
    trial.do("smooth", m, "--region", near, *wavelength, out="smooth.off")
    trial.do("smooth --repair", "smooth", m, "--region", near, *wavelength, "--repair", "--json",
             out="repaired.ply")
    all_of_it = f"ball:0,0,0,{2 * trial.farthest!r}"
    trial.do("smooth all", "smooth", m, "--region", all_of_it, *wavelength, "--fitting", "mean",
             "--strength", trial.one_of("0.5", "-1"), out="all.off")
    trial.do("smooth around", "smooth", m, "--region", far, *wavelength, "--fitting", "around",
             out="around.off")
    regions = ("--from", m, "--from-region", near, "--to", m, "--to-region", far,
               "--from-degree", "3")
    trial.do("transfer", *regions, out="detail.off")
    trial.do("transfer --refine", "transfer", *regions, "--refine", "--repeat", "--scale", "0.5",
             "--json", out="refined.off")
    if trial.do("repair", "repair", m, *trial.one_of((), ("--max-hole", "0"), ("--weld", repr(d * 1e-9))),
                "--json", out="mended.off"):
        trial.do("repair again", "repair", "mended.off", out="twice.off", codes=DONE)
    trial.do("simplify", "simplify", m, "--faces", trial.one_of("50%", "auto", "100"), "--json",
             out="fewer.off")
    trial.do("transfer coefficients", "transfer", *regions, "--mode", "coefficients", out="swap.off")


def star(trial):
    m = trial.mesh
    for method in ("edge", "gauge", "curl", "area"):
        trial.do(f"analyze {method}", "analyze", m, "--degree", "6", "--method", method, "--json",
                 out=f"{method}.h5", codes=ANY)
    trial.do("analyze direct", "analyze", m, "--degree", "4", "--engine", "direct", out="direct.sh",
             codes=ANY)
    for kind in ("edge", "triangle"):
        trial.do(f"analyze monte-carlo-{kind}", "analyze", m, "--degree", "4", "--method",
                 f"monte-carlo-{kind}", "--samples", "4", "--json", out=f"{kind}.json")
    trial.do("analyze --signed", "analyze", m, "--degree", "4", "--signed", "--json",
             out="alternating.h5", codes=ANY)
    tolerance = ("--max-degree", "24", "--json")
    trial.do("analyze --tolerance radius", "analyze", m, "--tolerance", "0.02", "--unit", "radius",
             *tolerance, *trial.one_of((), ("--center", "none"), ("--center", "volume")),
             out="radius.h5", codes=ANY)
    trial.do("analyze --tolerance distance", "analyze", m, "--tolerance", "0.02", "--unit",
             "diagonal", *tolerance, out="distance.h5", codes=ANY)
    trial.do("analyze --norm max", "analyze", m, "--tolerance", "0.05", "--unit", "radius", "--norm",
             "max", *tolerance, out="max.h5", codes=ANY)
    return trial.has("edge.h5")


def star_model(trial):
    s, m = "edge.h5", trial.mesh
    for kind in ("sh", "gfc", "json", "npy"):
        trial.do(f"convert model .{kind}", "convert", s, f"model.{kind}", made=f"model.{kind}",
                 codes=DONE)
    if trial.has("model.npy"):
        trial.do("convert model back", "convert", "model.npy", "model.h5", made="model.h5",
                 codes=DONE)
    trial.do("synthesize", s, "--degree", "2,6", "--subdivisions", "3", out="star.off", codes=DONE,
             made="star-L6.off")
    trial.do("synthesize --grid", "synthesize", s, "--grid", "8x16", out="grid.obj", codes=DONE)
    trial.do("synthesize --like", "synthesize", s, "--like", m, out="like.off", codes=DONE)
    trial.do("spectrum", s, "--json", codes=DONE)
    trial.do("spectrum .svg", "spectrum", s, out="spectrum.svg", codes=DONE)
    trial.do("spectrum .csv", "spectrum", s, out="spectrum.csv", codes=DONE)
    trial.do("compare model", "compare", m, s, "--samples", "300", "--json", codes=DONE)
    trial.do("render model", "render", s, m, "--degree", "2,6", "--size", "96x48", out="star.png",
             codes=DONE)
    trial.do("report model", "report", s, "--shape", m, "--size", "32", out="star.html", codes=DONE)
    trial.do("filter", s, "--low-pass", "4", "--json", out="filtered.h5", codes=DONE)
    trial.do("recenter", "recenter", s, "--center", trial.one_of("volume", "auto"), "--json",
             out="recentered.h5")
    trial.do("filter heat", "filter", s, "--low-pass", "3", "--window", "heat", out="heat.json",
             codes=DONE)
    trial.do("rotate --about", "rotate", s, *trial.one_of(
        ("--mirror", "y"), ("--euler", "10,20,30")), "--about", trial.one_of("center", "1,2,3"),
        out="mirrored.h5", codes=DONE)
    trial.do("rotate --principal-axes", "rotate", s, "--principal-axes", "--json", out="laid.h5",
             codes=DONE)
    if trial.do("rotate", s, "--axis", "1,2,3", "--angle", "50", out="turned.h5", codes=DONE):
        trial.do("align", s, "turned.h5", "--json", out="aligned.h5", codes=DONE)
        trial.do("align axes", "align", "turned.h5", s, "--start", "principal-axes", "--mirror", "--json",
                 codes=DONE)


def patches(trial):
    """Makes models and pictures of the paper's patches."""
    m = trial.mesh
    for view in ("patches", "triangles", "spheres"):
        trial.do(f"partition {view}", "partition", m, "--show", view, out=f"{view}.ply")
    for beyond in ("zero", "sphere"):
        name = f"integral-{beyond}"
        if trial.do(f"analyze --atlas integral {beyond}", "analyze", m, "--atlas", "--json", "--fit",
                    "integral", "--degree", "6", "--extension", beyond, out=f"{name}.h5"):
            atlas_model(trial, name)


def caps(trial):
    """Makes models of caps fitted at two tolerances."""
    m = trial.mesh
    trial.do("partition", m, "--tolerance", "2e-2", "--json", out="caps.ply")
    for tolerance in ("2e-2", "5e-3"):
        name = f"atlas-{tolerance}"
        trial.do(f"analyze --atlas {tolerance}", "analyze", m, "--atlas", "--json", "--tolerance",
                 tolerance, "--unit", "diagonal", out=f"{name}.h5", codes=ANY)
        if trial.has(f"{name}.h5"):
            reported = trial.last
            if atlas_model(trial, name):
                check_handles(trial, name, reported)


def check_handles(trial, name, reported):
    """Checks that the reported topology is the one of the file, and that wrong handles cause a warning."""
    found = json.loads(reported.out)
    surface = json.loads(Run([RHOLM, "info", f"{name}.off", "--json"], trial.folder).out)
    if (found["components"], found["genus"]) != (surface["components"], surface["genus"]):
        trial.faults.append((f"synthesize {name}.h5", "other handles than was reported"))
    if (b"parts and" in reported.err) == found["topology_kept"]:
        trial.faults.append((f"analyze --atlas {name}", "a wrong word on its handles"))


def atlas_model(trial, name):
    a, words = name + ".h5", ("synthesize", name + ".h5")
    if not trial.do("synthesize atlas", *words, out=f"{name}.off", codes=DONE):
        return False
    trial.do("synthesize --degree-limit", *words, "--degree-limit", "2", out=f"{name}-2.off",
             codes=DONE_OR_REFUSED)
    trial.do("synthesize --simplify", *words, "--simplify", "50%", out=f"{name}-half.off",
             codes=DONE)
    trial.do("synthesize --resolution", *words, "--resolution", repr(trial.diagonal / 30),
             out=f"{name}-30.off", codes=DONE_OR_REFUSED)
    if name != "atlas-2e-2":
        return True
    trial.do("report atlas", "report", a, "--shape", trial.mesh, "--size", "32", out="atlas.html",
             codes=DONE)
    # These commands take coefficients of a single function only.
    trial.do("compare atlas", "compare", trial.mesh, a, "--samples", "300", codes=REFUSED)
    trial.do("render atlas", "render", a, "--size", "64x48", out="r.png", codes=REFUSED)
    trial.do("spectrum atlas", "spectrum", a, codes=REFUSED)
    trial.do("rotate atlas", "rotate", a, "--mirror", "x", out="r.h5", codes=REFUSED)
    trial.do("filter atlas", "filter", a, "--low-pass", "2", out="f.h5", codes=REFUSED)
    return True
