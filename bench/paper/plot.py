"""The convergence plot of docs/paper.md: one small log-log diagram for each shape, as SVG."""

import math

COLUMNS = 4
WIDTH, HEIGHT = 300, 260            # size of one diagram
LEFT, RIGHT, TOP, BOTTOM = 50, 12, 44, 40
INK, GRID = "#222", "#e6e6e6"
# Key, colour, dashes and label of each series.
SERIES = [("random_triangles", "#c0532a", "", "random points on triangles"),
          ("random_edges", "#1f5fa8", "", "random points on edges"),
          ("nodes_triangles", "#c0532a", "5 3", "Gauss nodes on triangles"),
          ("nodes_edges", "#1f5fa8", "5 3", "Gauss nodes on edges")]


def logs(series):
    return [(math.log10(p["samples"]), math.log10(max(p["error"], 1e-16))) for p in series]


def slope(series):
    """Returns the slope of log error over log samples, by least squares."""
    points = logs(series)
    if len(points) < 2:
        return float("nan")
    mx, my = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    return (sum((x - mx) * (y - my) for x, y in points)
            / sum((x - mx) ** 2 for x, _ in points))


def until_floor(points, floor):
    """Returns the points above the floor, and the point where the line reaches it."""
    shown = []
    for x, y in points:
        if y < floor:
            if shown:
                (x0, y0) = shown[-1]
                shown.append((x0 + (x - x0) * (floor - y0) / (y - y0), floor))
            break
        shown.append((x, y))
    return shown


def ratio(above, below):
    """Returns the ratio of both points' errors at the same number of samples. Edges have slightly more
    samples, because faces that contain a pole are cut there."""
    return above["error"] / below["error"] * math.sqrt(above["samples"] / below["samples"])


def mean_ratio(above, below):
    """Returns the geometric mean of the ratios of pairs of points."""
    logarithms = [math.log(ratio(a, b)) for a, b in zip(above, below)]
    return math.exp(sum(logarithms) / len(logarithms))


def samples_for(series, error):
    """Returns the number of samples at which the line through the points reaches that error, or None."""
    points = until_floor(logs(series), math.log10(error))
    return 10 ** points[-1][0] if points and points[-1][1] <= math.log10(error) else None


def text(x, y, anchor, size, content, color=INK):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" '
            f'fill="{color}">{content}</text>\n')


def line(x0, y0, x1, y1, color, width=1, dashes=""):
    dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{color}" '
            f'stroke-width="{width}"{dashed}/>\n')


def superscript(n):
    digits = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return "10" + str(n).translate(digits)


def diagram(case, x, y):
    points = [p for key, *_ in SERIES for p in logs(case[key])]
    x0, x1 = math.floor(min(p[0] for p in points)), math.ceil(max(p[0] for p in points))
    y0, y1 = math.floor(min(p[1] for p in points)), math.ceil(max(p[1] for p in points))
    y0 = max(y0, -8)  # nodes converge down to rounding
    left, right, top, bottom = x + LEFT, x + WIDTH - RIGHT, y + TOP, y + HEIGHT - BOTTOM

    def at(point):
        return (left + (point[0] - x0) / (x1 - x0) * (right - left),
                bottom - (point[1] - y0) / (y1 - y0) * (bottom - top))

    out = text(left, top - 22, "start", 13, case["name"])
    slopes = " and ".join(f"{slope(case[key]):.2f}".replace("-", "−")
                          for key in ("random_triangles", "random_edges"))
    out += text(left, top - 8, "start", 10.5,
                f"{case['faces']} faces, L = {case['degree']}; slopes {slopes}", "#666")
    for exponent in range(x0, x1 + 1):
        px = at((exponent, y0))[0]
        out += line(px, top, px, bottom, GRID) + text(px, bottom + 14, "middle", 10.5,
                                                      superscript(exponent))
    step = 1 if y1 - y0 <= 6 else 2
    for exponent in range(y0, y1 + 1, step):
        py = at((x0, exponent))[1]
        out += line(left, py, right, py, GRID) + text(left - 5, py + 4, "end", 10.5,
                                                      superscript(exponent))
    for key, color, dashes, _ in SERIES:
        shown = until_floor(logs(case[key]), y0)
        path = " ".join(f"{px:.1f},{py:.1f}" for px, py in map(at, shown))
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        out += (f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.6"'
                f'{dashed}/>\n')
        for px, py in map(at, (p for p in shown if p[1] > y0)):
            hollow = "#fff" if dashes else color
            out += (f'<circle cx="{px:.1f}" cy="{py:.1f}" r="2.4" fill="{hollow}" '
                    f'stroke="{color}"/>\n')
    return out


def convergence(cases):
    rows = math.ceil(len(cases) / COLUMNS)
    columns = min(COLUMNS, len(cases))
    width, height = columns * WIDTH + 10, rows * HEIGHT + 44
    out = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           f'viewBox="0 0 {width} {height}" font-family="sans-serif">\n'
           f'<rect width="{width}" height="{height}" fill="#fff"/>\n')
    for i, case in enumerate(cases):
        out += diagram(case, i % columns * WIDTH, i // columns * HEIGHT)
    # Key of the lines, and titles of the axes.
    bottom = rows * HEIGHT + 4
    out += text(width / 2, bottom, "middle", 11.5,
                "error of the radius / mean radius, over the number of points in all", "#444")
    x = width / 2 - 2 * 215
    for _, color, dashes, label in SERIES:
        out += line(x, bottom + 20, x + 28, bottom + 20, color, 1.8, dashes)
        out += text(x + 34, bottom + 24, "start", 11.5, label)
        x += 215
    return out + "</svg>\n"
