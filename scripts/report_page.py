# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""The page of a comparison: one HTML file that needs no network, no script and no other file.

Plots are inline SVG that takes its colours from the page's style, so that they follow light and dark.
"""

import base64
import html
import math

STYLE = """
:root { color-scheme: light dark; --back: #fdfdfc; --text: #1c1e21; --faint: #62676e; --line: #d9dcdf; --card: #f3f4f4;
  --s0: #1261a6; --s1: #c2410c; --s2: #15803d; --s3: #9333ea; --s4: #a16207; --s5: #be185d; --s6: #0f766e; --s7: #4b5563; }
@media (prefers-color-scheme: dark) { :root { --back: #15171a; --text: #e8e9eb; --faint: #a0a6ae; --line: #363b41;
  --card: #1e2125; --s0: #6cb4f5; --s1: #fb923c; --s2: #5fd38a; --s3: #c99bfb; --s4: #e5c04c; --s5: #f48bbb;
  --s6: #4fd1c1; --s7: #b3bac2; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 1.2rem 1rem 3rem; background: var(--back); color: var(--text);
  font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: .2rem 0; } h2 { font-size: 1.15rem; margin: 2rem 0 .6rem; }
p { margin: .4rem 0; } .faint { color: var(--faint); font-size: .9rem; }
.verdict { border-left: 4px solid var(--s0); padding: .5rem .9rem; background: var(--card); margin: 1rem 0; }
img { width: 100%; height: auto; border-radius: 6px; display: block; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .5rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; } th { font-weight: 600; font-size: .85rem; color: var(--faint); }
.plots { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); }
figure { margin: 0; padding: .7rem; background: var(--card); border-radius: 6px; min-width: 0; }
td:first-child { overflow-wrap: anywhere; white-space: normal; min-width: 7rem; }
figcaption { font-weight: 600; font-size: .95rem; margin-bottom: .3rem; }
svg { width: 100%; height: auto; display: block; } svg text { fill: var(--faint); font: 12px system-ui, sans-serif; }
.grid { stroke: var(--line); stroke-width: 1; fill: none; } .front { stroke: var(--faint); stroke-dasharray: 3 3; fill: none; } .series { fill: none; stroke-width: 1.7; stroke-linejoin: round; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .6rem 0; font-size: .92rem; }
.legend svg { width: 1.8rem; height: .7rem; display: inline-block; margin-right: .4rem; }
pre { background: var(--card); padding: .7rem; white-space: pre-wrap; overflow-wrap: anywhere; border-radius: 6px; font-size: .85rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1rem; margin: 0; } dt { color: var(--faint); } dd { margin: 0; }
"""

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 420, 250, 56, 10, 10, 40
MOST_LINES = 12  # of a plot that can be read
DASHES = ("", "6 3", "2 3")


def text_of(value):
    return html.escape(str(value))


def short(value):
    """A number as an axis or a table shows it."""
    size = abs(value)
    if size >= 1e6:
        return f"{value / 1e6:.3g} M"
    if size >= 1e4:
        return f"{value / 1e3:.3g} k"
    return f"{value:.4g}" if size >= 1 or size == 0 else f"{value:.2g}"


def style_of(number):
    dash = DASHES[number // 8 % len(DASHES)]
    return f"stroke:var(--s{number % 8})" + (f";stroke-dasharray:{dash}" if dash else "")


class Axis:
    """Values to positions between two ends of the picture, linear from 0 or logarithmic."""

    def __init__(self, values, start, end, logarithmic):
        finite = [v for v in values if v is not None and (v > 0 or not logarithmic)] or [1.0]
        self.logarithmic, self.start, self.end = logarithmic, start, end
        if logarithmic:
            self.low, self.high = math.log10(min(finite)), math.log10(max(finite))
            margin = max(0.05 * (self.high - self.low), 0.02)
            self.low, self.high = self.low - margin, self.high + margin
        else:
            self.low, self.high = min(0.0, min(finite)), max(finite) * 1.05 or 1.0

    def at(self, value):
        value = math.log10(max(value, 1e-300)) if self.logarithmic else value
        share = (value - self.low) / (self.high - self.low)
        return self.start + min(max(share, 0.0), 1.0) * (self.end - self.start)

    def ticks(self):
        if self.logarithmic:
            decades = range(math.floor(self.low), math.ceil(self.high) + 1)
            steps = (1,) if self.high - self.low > 2.5 else (1, 2, 5)
            found = [m * 10.0 ** d for d in decades for m in steps]
            found = [t for t in found if self.low <= math.log10(t) <= self.high]
            return found if len(found) > 1 else [10.0 ** self.low, 10.0 ** self.high]
        rough = (self.high - self.low) / 5
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(power * m for m in (1, 2, 5, 10) if power * m >= rough)
        return [step * i for i in range(math.ceil(self.low / step), math.floor(self.high / step) + 1)]


def frame_of(x, y, x_label, y_label):
    """Grid lines, ticks and labels."""
    parts = []
    for tick in y.ticks():
        at = y.at(tick)
        parts.append(f'<path class="grid" d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}"/>'
                     f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{short(tick)}</text>')
    for tick in x.ticks():
        parts.append(f'<text x="{x.at(tick):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{short(tick)}</text>')
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 5}" text-anchor="middle">{text_of(x_label)}</text>')
    parts.append(f'<text transform="translate(13 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">'
                 f'{text_of(y_label)}</text>')
    return "".join(parts)


def figure_of(name, caption, body):
    return (f'<figure id="plot-{name}"><figcaption>{text_of(caption)}</figcaption><svg viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'role="img" aria-label="{text_of(caption)}">{body}</svg></figure>')


def is_wide(values):
    """Whether a logarithmic axis shows them better."""
    positive = [v for v in values if v and v > 0]
    return bool(positive) and min(values) > 0 and max(positive) > 12 * min(positive)


def plot_along_path(name, caption, unit, runs, field):
    series = [(run["label"], [frame[field] for frame in run["per_frame"]]) for run in runs]
    values = [v for _, ys in series for v in ys if v is not None]
    if not values:
        return ""
    longest = max(len(ys) for _, ys in series)
    x = Axis([0, max(1, longest - 1)], LEFT, WIDTH - RIGHT, False)
    x.high = max(1, longest - 1)
    y = Axis(values, HEIGHT - BOTTOM, TOP, is_wide(values))
    body = frame_of(x, y, "frame", unit)
    for number, (label, ys) in enumerate(series):
        points = " ".join(f"{x.at(i):.1f},{y.at(v):.1f}" for i, v in enumerate(ys) if v is not None)
        if points:
            body += (f'<polyline class="series" style="{style_of(number)}" points="{points}">'
                     f'<title>{text_of(label)}</title></polyline>')
    return figure_of(name, caption, body)


def scatter(name, caption, x_label, y_label, points, diagonal=False, logarithmic=True):
    """`points`: (number of the run, its label, x, y)."""
    xs, ys = [p[2] for p in points], [p[3] for p in points]
    both = xs + ys if diagonal else None
    x = Axis(both or xs, LEFT, WIDTH - RIGHT, logarithmic)
    y = Axis(both or ys, HEIGHT - BOTTOM, TOP, logarithmic)
    body = frame_of(x, y, x_label, y_label)
    if diagonal:
        body += f'<path class="grid" style="stroke:var(--faint)" d="M{LEFT} {HEIGHT - BOTTOM}L{WIDTH - RIGHT} {TOP}"/>'
    for number, label, a, b in points:
        body += (f'<circle cx="{x.at(a):.1f}" cy="{y.at(b):.1f}" r="2.6" fill-opacity=".75" '
                 f'style="fill:var(--s{number % 8})"><title>{text_of(label)}</title></circle>')
    return figure_of(name, caption, body)


class ErrorAxis(Axis):
    """Errors, logarithmic, with a place of its own for none at the left."""

    NONE = 1e-9  # below: rounding of an SSIM of 1

    def __init__(self, values):
        super().__init__([v for v in values if v > self.NONE], LEFT + 45, WIDTH - RIGHT, True)
        widen = max(0.0, 0.4 - 0.5 * (self.high - self.low))  # a factor of 6 at least, else no tick falls in
        self.low, self.high = self.low - widen, self.high + widen

    def at(self, value):
        return super().at(value) if value > self.NONE else LEFT + 16

    def ticks(self):
        return [0.0] + super().ticks()


def ssim_loss(run):
    """1 - SSIM over the frames in which it was measured, else None."""
    error = run["summary"].get("image_error")
    return None if not error or error.get("ssim") is None else max(0.0, 1.0 - error["ssim"])


FRONTS = (("frame_ms", "frame time, ms"), ("draw_calls", "draw calls"), ("indices", "indices"))


def front_points(page, field):
    """(number of the run, its label, error, cost) of all runs, and of those on the front by ascending error."""
    points = [(number, run["label"], ssim_loss(run), run["summary"][field]["median"])
              for number, run in enumerate(page["runs"]) if ssim_loss(run) is not None]
    on_front = set(page["pareto"][field])
    return points, sorted((p for p in points if p[1] in on_front), key=lambda p: (p[2], p[3]))


def front_plot(page, field, unit):
    points, front = front_points(page, field)
    if not points:
        return ""
    costs = [p[3] for p in points]
    x, y = ErrorAxis([p[2] for p in points]), Axis(costs, HEIGHT - BOTTOM, TOP, is_wide(costs))
    body = frame_of(x, y, "1 - SSIM, against everything at full detail", unit)
    line = " ".join(f"{x.at(p[2]):.1f},{y.at(p[3]):.1f}" for p in front)
    body += f'<polyline class="front" points="{line}"/>'
    for number, label, error, cost in points:
        body += (f'<circle cx="{x.at(error):.1f}" cy="{y.at(cost):.1f}" r="4" fill-opacity=".8" '
                 f'style="fill:var(--s{number % 8})"><title>{text_of(label)}: {short(cost)}, {short(error)}</title></circle>')
    return figure_of(f"front_{field}", f"The front: {unit} against error", body)


def errors_of(page):
    """What was given up, for what: the table and the plots of the front, where the picture's error was measured."""
    if not page.get("pareto"):
        return ""
    heads = ["method", *(f"{unit} (median)" for _, unit in FRONTS), "SSIM", "least SSIM", "PSNR, dB", "depth error, %",
             "missing px a frame"]
    rows = []
    for run in page["runs"]:
        error = run["summary"].get("image_error")
        if not error:
            continue
        star = lambda field: "*" if run["label"] in page["pareto"][field] else ""
        ssim = lambda field: "–" if error[field] is None else f"{error[field]:.5f}"
        cells = [run["label"], *(short(run["summary"][field]["median"]) + star(field) for field, _ in FRONTS),
                 ssim("ssim"), ssim("ssim_min"), "equal" if error["psnr_db"] is None else f'{error["psnr_db"]:.1f}',
                 f'{100 * error["depth_mean"]:.4f}', short(error["missing_pixels"] / error["frames"])]
        rows.append("<tr>" + "".join(f"<td>{text_of(c)}</td>" for c in cells) + "</tr>")
    head = "".join(f"<th>{text_of(h)}</th>" for h in heads)
    plots = "".join(front_plot(page, field, unit) for field, unit in FRONTS)
    return (f'<h2>Speed against error</h2><div class="scroll"><table id="errors"><thead><tr>{head}</tr></thead><tbody>'
            f'{"".join(rows)}</tbody></table></div><p class="faint">* on the front: no other has as little of this and of '
            "1 - SSIM, and less of one. Errors are against everything at full detail: colours by PSNR and SSIM (Wang et al. "
            "2004), depths as parts of the distance, missing where the depth differs in any bit.</p>"
            f'{legend_of(page["runs"])}<div class="plots">{plots}</div>')


def prediction_plot(runs):
    points = [(number, run["label"], frame["frame_ms"], frame["predicted_ms"])
              for number, run in enumerate(runs) for frame in run["per_frame"]
              if frame.get("predicted_ms") and frame["frame_ms"] > 0]
    return scatter("prediction", "Predicted and measured frame time (line: equal)", "measured, ms", "predicted, ms",
                   points, diagonal=True) if points else ""


def error_plot(runs):
    points = []
    for number, run in enumerate(runs):
        error = run["summary"].get("lod_error_px")
        if isinstance(error, dict) and error.get("max") is not None:
            points.append((number, run["label"], error["max"], run["summary"]["frame_ms"]["median"]))
    return scatter("error", "What an error of the picture buys", "level-of-detail error, px (largest)", "frame time, ms",
                   points, logarithmic=False) if points else ""


def interval_text(interval, digits=3):
    return "–" if interval is None else f'{interval["low"]:.{digits}f} – {interval["high"]:.{digits}f}'


def table_of(page):
    reference = page["reference"]
    heads = ["method", "frame ms", "95 % interval", f"× {reference}", "95 % interval", "cull ms", "draw calls", "indices",
             "V + 8000 N", "queries", "predicted ms", "missing px"]
    rows = []
    for run, compared in zip(page["runs"], page["comparison"]):
        summary = run["summary"]
        missing, ratio = summary["missing_pixels"], compared["frame_ms_ratio"]
        median = lambda field: short(summary[field]["median"]) if summary.get(field) else "–"
        cells = [run["label"], f'{summary["frame_ms"]["median"]:.3f}', interval_text(compared["frame_ms"]),
                 f'{ratio["median"]:.3f}' if ratio else "–",
                 "–" if run["label"] == reference else interval_text(ratio), f'{summary["cull_ms"]["median"]:.3f}',
                 median("draw_calls"), median("indices"), median("modelled_indices"), median("queries"), median("predicted_ms"),
                 "not checked" if missing is None else str(missing["total"])]
        rows.append("<tr>" + "".join(f"<td>{text_of(c)}</td>" for c in cells) + "</tr>")
    head = "".join(f"<th>{text_of(h)}</th>" for h in heads)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table></div>'


def verdict_of(page):
    if page["winner"]:
        return (f'<strong>{text_of(page["winner"])}</strong> is fastest: paired frame by frame, its time is below that of '
                "each other method, with the whole 95 % interval of the median.")
    return "No method is told to be the fastest: the intervals of the best ones overlap, or there are too few frames."


def legend_of(runs):
    return '<div class="legend">' + "".join(
        f'<span><svg viewBox="0 0 28 10" aria-hidden="true"><path class="series" style="{style_of(n)};stroke-width:3" '
        f'd="M0 5H28"/></svg>{text_of(run["label"])}</span>' for n, run in enumerate(runs)) + "</div>"


def picture_of(folder):
    """The picture in the middle of the walk, if there is one."""
    pictures = sorted((folder / "scene").glob("frame_*.png"))
    if not pictures:
        return ""
    data = base64.b64encode(pictures[len(pictures) // 2].read_bytes()).decode("ascii")
    return f'<img id="scene" alt="The scene along its path" src="data:image/png;base64,{data}">'


def machine_of(page):
    run = page["runs"][0]
    device, profile = run["device"], run["profile"]
    constant = lambda name: "none" if profile.get(name) is None else f"{profile[name]:.4g} ns"
    items = [("renderer", device["renderer"]), ("OpenGL", device["version"]), ("processor threads", page.get("threads", "–")),
             ("clock", "GPU and wall" if device["timer"] == "gpu" else "wall"),
             ("constants", f'c1 {constant("c1_ns")}, c3 {constant("c3_ns")} ({profile.get("source") or "none"})')]
    return "<dl>" + "".join(f"<dt>{text_of(k)}</dt><dd>{text_of(v)}</dd>" for k, v in items) + "</dl>"


def page_of(page, folder):
    """The HTML of a `rhview.compare/1`; `folder` may hold the picture."""
    runs = page["runs"]
    scene, first = runs[0]["scene"], runs[0]
    turns = "methods take turns frame by frame" if page["order"] == "frame" else "one walk after the other"
    about = (f'{short(scene["triangles"])} triangles, {scene["dynamic_objects"]} dynamic objects; {first["frames"]} frames of '
             f'{first["size"][0]} × {first["size"][1]}; {turns}')
    plots = [plot_along_path("frame_ms", "Frame time", "ms", runs, "frame_ms"),
             plot_along_path("cull_ms", "Planning on the processor, part of it", "ms", runs, "cull_ms"),
             plot_along_path("draw_calls", "Draw calls", "calls", runs, "draw_calls"),
             plot_along_path("indices", "Indices submitted", "indices", runs, "indices"),
             plot_along_path("queries", "Occlusion queries", "queries", runs, "queries"),
             prediction_plot(runs), error_plot(runs)]
    along = "" if len(runs) > MOST_LINES else (
        f'<h2>Along the path</h2>{legend_of(runs)}<div class="plots">{"".join(plots)}</div>')
    name = text_of(scene["name"])
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>rhview compare {name}</title><style>{STYLE}</style></head><body>
<h1>{name}: {len(runs)} culling methods</h1><p class="faint">{text_of(about)}</p>
<p class="verdict">{verdict_of(page)}</p>
{table_of(page)}
<p class="faint">Medians over the frames; intervals of the median from order statistics, frames taken as independent. The
interval of the frame time holds the path's ups and downs too; that of the ratio pairs frames of the same camera.</p>
{picture_of(folder)}
{errors_of(page)}
{along}
<h2>Machine</h2>{machine_of(page)}
<h2>Make it again</h2><pre>{text_of(page["command"])}</pre>
</body></html>
"""
