"""The tables of docs/paper.md, made from the figures of paper_experiments."""

import math

from plot import mean_ratio, ratio, samples_for, slope


# Shapes that are replaced by a body made here.
STANDS_IN = {"Bennu", "Vase"}


def number(value, digits=2):
    """Formats a number with two digits, and with powers of ten where there are many zeros."""
    if value == 0:
        return "0"
    if value < 1e-3 or value >= 1e6:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    places = max(0, digits - 1 - math.floor(math.log10(value)))
    return f"{round(value, digits - 1 - math.floor(math.log10(value))):,.{places}f}".replace(
        ",", " ")


def span(seconds):
    """Formats a time in a suitable unit."""
    for unit, length in (("years", 365.25 * 86400), ("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * length:
            return f"{number(seconds / length)} {unit}"
    return f"{number(seconds)} s" if seconds >= 1 else f"{number(1e3 * seconds)} ms"


def thousands(value):
    return f"{value / 1000:.0f}k" if value >= 10_000 else str(value)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def against_paper(rows):
    head = ["object", "L", "paper: points", "s", "error", "[16]: s", "error",
            "here: faces", "s", "error", "s", "error", "cut off"]
    body = []
    for row in rows:
        paper, coarse, fine = row["paper"], row["coarse"], row["fine"]
        name = row["name"] if row["real"] else f"{row['name']} \\*"
        body.append([name, str(row["degree"]), thousands(row["points"]),
                     *(f"{paper[key]:g}" for key in ("cpu_seconds", "error",
                                                     "triangle_cpu_seconds", "triangle_error")),
                     thousands(row["faces"]), number(coarse["cpu_seconds"]),
                     number(coarse["error"]), number(fine["cpu_seconds"]),
                     number(fine["error"]), number(row["vertex_error"])])
    notes = [f"{row['name']}: {row['source']}, {row['faces']} faces" +
             ("" if row["star_shaped"] else ", not star-shaped: the alternating sum of its radii")
             for row in rows if row["real"]]
    made = [row["name"] for row in rows if not row["real"]]
    text = table(head, body)
    if notes:
        text += "\n\nReal meshes: " + "; ".join(notes) + "."
    if made:
        text += ("\n\n\\* Stand-ins of as many faces, made by the program, for "
                 + ", ".join(made) + ".")
    return text


def at_error(run, error):
    """Returns the time of points on triangles at another error, which falls with the root of their
    number."""
    return run["cpu_seconds"] * (run["expected_error"] / error) ** 2


def equal_error(rows):
    head = ["object", "us per point: triangles, edges", "2 points a triangle: time", "error",
            "expected", "triangles at 0.001", "here at 0.001 or better: time", "error", "ratio",
            "ratio at the error of [16]"]
    body = []
    for row in rows:
        run, coarse, paper = row["triangles"], row["coarse"], row["paper"]
        measured = "measured_error" in run
        at_their_error = at_error(run, paper["triangle_error"]) / coarse["cpu_seconds"]
        body.append([row["name"], f"{number(1e6 * row['triangle_cpu_per_point'])}, "
                     f"{number(1e6 * row['edge_cpu_per_point'])}",
                     ("" if measured else "(") + span(run["cpu_seconds"]) +
                     ("" if measured else ")"),
                     number(run["measured_error"]) if measured else "-",
                     number(run["expected_error"]),
                     span(at_error(run, paper["error"])), span(coarse["cpu_seconds"]),
                     number(coarse["error"]),
                     number(at_error(run, paper["error"]) / coarse["cpu_seconds"]),
                     number(at_their_error)])
    return table(head, body)


def edges_against_triangles(cases):
    head = ["shape", "faces", "L", "random points: error of triangles / of edges",
            "slope, triangles", "slope, edges", "nodes for 1e-6: triangles", "edges"]
    body = []
    for case in cases:
        nodes = [samples_for(case[key], 1e-6) for key in ("nodes_triangles", "nodes_edges")]
        body.append([case["name"] + (" (stand-in)" if case["name"] in STANDS_IN and not case["real"] else ""),
                     str(case["faces"]), str(case["degree"]),
                     number(mean_ratio(case["random_triangles"], case["random_edges"])),
                     f"{slope(case['random_triangles']):.2f}", f"{slope(case['random_edges']):.2f}",
                     *(number(n) if n else "more than were tried" for n in nodes)])
    return table(head, body)


def ratios_by_degree(ratios):
    head = ["error of triangles / of edges", *(f"L = {degree}" for degree in ratios["degrees"])]
    body = []
    for shape in ratios["bodies"]:
        found = [number(ratio(pair["triangles"], pair["edges"])) for pair in shape["ratios"]]
        missing = ["-"] * (len(ratios["degrees"]) - len(found))
        body.append([f"{shape['name']}, {shape['faces']} faces", *found, *missing])
    return table(head, body)


def levels(figure, number_of):
    head = ["degree", "coefficients", "rms distance / diagonal", "largest"]
    body = [[str(level["degree"]), str(level["coefficients"]), f"{100 * level['rms']:.2g} %",
             f"{100 * level['max']:.2g} %"] for level in figure["levels"]]
    what = figure["source"] if figure["real"] else "a body made here"
    star = ("" if figure["star_shaped"] else
            f"; {100 * (1 - figure['once_share']):.2g} % of the directions do not meet it exactly once")
    return (f"![Figure {number_of}: degrees "
            + ", ".join(str(level["degree"]) for level in figure["levels"])
            + f", and the mesh](images/{figure['file']})\n\n"
            + f"*{what}, {figure['faces']} faces{star}.*\n\n" + table(head, body))


def vase(figure):
    errors = figure["errors"]
    return (f"![A vase by points on triangles and by points on edges](images/{figure['file']})\n\n"
            f"*L = {figure['degree']}, {errors['samples']} random points each: error "
            f"{number(errors['monte-carlo-triangle'])} by triangles, "
            f"{number(errors['monte-carlo-edge'])} by edges.*")


def all_tables(results, machine):
    """Returns the parts of the document by the names of their marks."""
    rows = results["table_one"]
    return {"machine": f"Measured on one machine: {machine}; processor time of one thread.",
            "table-1": against_paper(rows),
            "equal-error": equal_error(rows),
            "figure-4": edges_against_triangles(results["figure_four"]["shapes"]),
            "by-degree": ratios_by_degree(results["figure_four"]["by_degree"]),
            "vase": vase(results["levels"]["four"]),
            "figure-1": levels(results["levels"]["one"], 1),
            "figure-5": levels(results["levels"]["five"], 5)}
