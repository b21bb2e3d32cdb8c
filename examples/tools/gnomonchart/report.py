#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""report.py FOLDER : draws the figures and the page of a run of gnomonchart, from the results.json in FOLDER or, of
`gnomonchart --stability`, from its stability.json. gnomonchart runs it by itself.

Writes into FOLDER figure*.svg and .png, index.html and results.csv; or stability.svg and .png, stability.html and
stability.csv. Prints what the run has found. Needs matplotlib and jinja2.
"""
import csv
import json
import math
import os
import pathlib
import statistics
import sys

try:
    os.environ.setdefault("MPLCONFIGDIR", os.path.join(os.environ.get("TMPDIR", "/tmp"), f"gnomonchart-{os.getuid()}"))
    import matplotlib

    matplotlib.use("Agg")
    import jinja2
    import matplotlib.pyplot as plt
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    from matplotlib.patheffects import withStroke
except ImportError as missing:
    sys.exit(f"gnomonchart: the report needs {missing.name}. Install python3-matplotlib and python3-jinja2.")

OURS = "Gnomon"
LOOKS = {"auto": ("*", "#c1121f", 2.2), "map": ("s", "#b45309", 0.9), "volume": ("D", "#5e3c99", 0.85),
         "traced": ("P", "#111827", 1.25), "planar": ("v", "#0067a5", 1.1), "hull": ("^", "#00734d", 1.1),
         "box": ("p", "#9d3f78", 1.1)}  # marker, colour, and size by which all weigh alike; in the order of the key
GREY = "#858c99"
LIGHTS = {"steady": "The light stands still, the camera moves", "moving": "The light moves with every frame"}
LEAST_MS, LEAST_PX = 0.05, 0.02  # of the axes
plt.rcParams.update({"font.size": 10, "svg.hashsalt": "gnomon", "axes.spines.top": False, "axes.spines.right": False,
                     "hatch.linewidth": 0.6, "figure.dpi": 100, "savefig.dpi": 200})  # fmt: skip


def save(figure, folder, name):
    for ending in ("svg", "png"):
        figure.savefig(folder / f"{name}.{ending}", metadata={"Date": None} if ending == "svg" else None)
    plt.close(figure)


def short(number):
    """Three digits at most."""
    if number is None or math.isnan(number):
        return "–"
    return "∞" if math.isinf(number) else f"{number:.3g}"


# Of the chart: points ------------------------------------------------------------------------------------------------


def error_of(point):
    """px, 95th percentile; infinite where nothing was drawn that has a boundary."""
    boundary = (point["errors"] or {}).get("boundaryPixels")
    return round(boundary["p95"], 9) if boundary and not point["failure"] else math.inf  # lengths' sums are off by 1e-14


def time_of(point, light):
    """ms that shadows add to a frame, median; NaN where nothing was timed."""
    return point["cost"][f"{light}WallMs"]["median"] if point["cost"] else math.nan


def spec_of(point):
    return dict(point["settings"]).get("--shadow", "")


def name_of(point):
    return point["technique"] if point["kit"] == OURS else f"osgShadow {point['technique']}"


def curves_of(points, light):
    """{(kit, technique): settings}: each setting's median time and error over the scenes in which it was tried."""
    groups = {}
    for point in points:
        groups.setdefault((point["kit"], point["technique"]), {}).setdefault(point["setting"], []).append(point)
    curves = {}
    for key, settings in groups.items():
        curves[key] = []
        for setting, group in settings.items():
            times = [time for time in (time_of(point, light) for point in group) if not math.isnan(time)]
            curves[key].append({
                "kit": key[0], "technique": key[1], "setting": setting, "scenes": len(group),
                "name": name_of(group[0]), "spec": spec_of(group[0]),
                "ms": statistics.median(times) if times else math.nan,
                "px": statistics.median(map(error_of, group)),
                "sound": not any(point["catastrophic"] for point in group)})  # fmt: skip
    return curves


def shown(settings):
    return [one for one in settings if not math.isnan(one["ms"]) and not math.isinf(one["px"])]


def default_and_best(settings):
    """A technique at its defaults, and at its best: the least median error of those that are sound in every scene, and of
    those that are alike to a hundredth of a pixel the fastest."""
    settings = shown(settings)
    if not settings:
        return None, None
    plain = min(settings, key=lambda one: (one["setting"] != "defaults", len(one["spec"])))
    return plain, min(settings, key=lambda one: (not one["sound"], round(one["px"], 2), one["ms"]))


def front(settings):
    """Those that none matches which is at most as slow and at most as wrong, from the fastest to the most accurate."""
    best = []
    for one in sorted((one for one in shown(settings) if one["sound"]), key=lambda one: (one["ms"], one["px"])):
        if not best or one["px"] < best[-1]["px"]:
            best.append(one)
    return best


def is_matched(one, others, ms=0.0, share=0.0):
    """Whether one of the others costs no more and errs no more, but for so much."""
    return any(other["ms"] <= one["ms"] + max(ms, share * one["ms"]) and other["px"] <= (1 + share) * one["px"]
               for other in others)  # fmt: skip


# Of the chart: figures -----------------------------------------------------------------------------------------------


def place_labels(axes, labels, markers):
    """Puts each name beside its marker where it covers the least of what is there already."""
    figure = axes.figure
    figure.canvas.draw()
    taken = [(*axes.transData.transform(marker), 7, 7) for marker in markers]
    frame = axes.get_window_extent()
    for x, y, name, colour, weight in labels:
        px, py = axes.transData.transform((x, y))
        text = axes.annotate(name, (x, y), xytext=(0, 0), textcoords="offset points", color=colour, fontweight=weight,
                             ha="center", va="center", zorder=7, arrowprops={"arrowstyle": "-", "color": colour, "lw": 0.6, "shrinkB": 6},
                             path_effects=[withStroke(linewidth=2.5, foreground="white")])  # fmt: skip
        size = text.get_window_extent()
        w, h = size.width / 2 + 1, size.height / 2
        best = None
        for reach in (1.0, 1.6, 2.4, 3.4):
            for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)):
                cx, cy = px + dx * (w + 8 * reach), py + dy * (h + 8) * reach
                over = sum(max(0, w + tw - abs(cx - tx)) * max(0, h + th - abs(cy - ty)) for tx, ty, tw, th in taken)
                outside = max(0, frame.x0 - (cx - w)) + max(0, cx + w - frame.x1) + max(0, cy + h - frame.y1)
                cost = over + 40 * outside + 25 * reach
                if best is None or cost < best[0]:
                    best = (cost, cx, cy, reach)
        taken.append((best[1], best[2], w, h))
        points = 72 / figure.dpi
        text.xyann = ((best[1] - px) * points, (best[2] - py) * points)
        text.arrow_patch.set_visible(best[3] > 1)


def families(curves):
    """{(kit, technique): settings}, smooth and soft edges of a map among those of the map."""
    pooled = {}
    for (kit, technique), settings in curves.items():
        pooled.setdefault((kit, technique.split(",")[0] if kit == OURS else technique), []).extend(settings)
    return pooled


def named_peers(marks):
    """Of osgShadow three have a name: ShadowMap, which programs begin with, the fastest below 1 px, and the most accurate."""
    plain = [mark for mark in marks if mark[0]["technique"] == "ShadowMap"][:1]
    accurate = sorted((mark for mark in marks if mark[0]["px"] < 1), key=lambda mark: mark[0]["ms"])[:1]
    exact = sorted(marks, key=lambda mark: (mark[0]["px"], mark[0]["ms"]))[:1]
    return list({mark[0]["technique"]: mark for mark in exact + accurate + plain}.values())


def draw_mark(axes, one, at, filled, marker, colour, size, zorder):
    """Hollow at its defaults, filled at its best, crossed out if it fails in a scene."""
    axes.scatter(*at, s=size, marker=marker, color=colour if filled else "white", edgecolors=colour, linewidths=1.3, zorder=zorder)
    if not one["sound"]:
        axes.scatter(*at, s=0.3 * size, marker="x", color="white" if filled else colour, linewidths=1.1, zorder=zorder)


def draw_panel(axes, points, light):
    labels, peers, markers = [], [], []
    for (kit, technique), settings in families(curves_of(points, light)).items():
        marks = [(one, (max(one["ms"], LEAST_MS), max(one["px"], LEAST_PX)), filled)
                 for one, filled in zip(default_and_best(settings), (False, True)) if one]  # fmt: skip
        if not marks:
            continue
        if marks[0][0] is marks[1][0]:
            marks = marks[:1]
        markers += [at for _, at, _ in marks]
        if kit == OURS:
            marker, colour, weight = LOOKS.get(technique, ("h", "#374151", 1.0))
            if len(marks) == 2:
                axes.plot(*zip(marks[0][1], marks[1][1]), color=colour, lw=1.1, alpha=0.75, zorder=4)
            for one, at, filled in marks:
                draw_mark(axes, one, at, filled, marker, colour, 62 * weight, 6)
            labels.append((*marks[0][1], technique, colour, "bold"))
        else:
            for one, at, filled in marks:
                draw_mark(axes, one, at, filled, "o", GREY, 30, 3)
            peers += marks
    labels += [(*at, one["technique"], "#4b5563", "normal") for one, at, _ in named_peers(peers)]
    axes.set_title(LIGHTS[light], loc="left", fontsize=10.5, fontweight="bold")
    return labels, markers


def chart_figure(results, points, scenes, title):
    figure, panels = plt.subplots(2, 1, figsize=(6.4, 9.6), sharex=True, sharey=True)
    figure.subplots_adjust(left=0.115, right=0.985, top=0.915, bottom=0.135, hspace=0.14)
    names = [draw_panel(axes, points, light) for axes, light in zip(panels, LIGHTS)]
    floors = [scene["boundaryFloorPixels"] for scene in scenes if scene["boundaryFloorPixels"]]
    for axes, (labels, markers) in zip(panels, names):
        axes.set(xscale="log", yscale="log", ylabel="edge of the shadow is off by (px)")
        axes.margins(0.07)
        if floors:
            axes.axhline(statistics.median(floors), color="#111827", lw=0.9, ls=(0, (5, 4)), zorder=1)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5), numticks=12))
            axis.set_minor_locator(matplotlib.ticker.NullLocator())
            axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        axes.tick_params(labelbottom=True)
        axes.grid(color="#eef0f3", lw=0.8)
        axes.set_axisbelow(True)
    for axes, (labels, markers) in zip(panels, names):
        place_labels(axes, labels, markers)
    panels[1].set_xlabel("time that shadows add to a frame (ms): left is faster, down is more accurate")
    figure.suptitle(title, x=0.015, y=0.99, ha="left", va="top", fontsize=12, fontweight="bold")
    dark = "#374151"
    key = [Line2D([], [], color=dark, marker="o", ls="", ms=7, mfc="white", label="at its defaults"),
           Line2D([], [], color=dark, marker="o", ls="", ms=7, label="at its best: the least error"),
           Line2D([], [], color=dark, marker="x", ls="", ms=6, label="crossed: fails in a scene"),
           Line2D([], [], color=GREY, marker="o", ls="", ms=6, label="grey circles: osgShadow"),
           Line2D([], [], color="#111827", lw=0.9, ls="--", label="one exact ray a pixel")]  # fmt: skip
    figure.legend(handles=key, loc="lower left", ncols=2, fontsize=9.5, frameon=False, borderaxespad=0.3)
    made = dict(results["made"])
    facts = [made[name] for name in ("renderer", "processor") if name in made] + ([made["date"][:10]] if "date" in made else [])
    figure.text(0.015, 0.948, ", ".join(facts), fontsize=9.5, color="#4b5563")
    return figure


# Of the chart: findings ----------------------------------------------------------------------------------------------


def described(one, several):
    return f"{one['name']}{', ' + one['setting'] if several else ''} ({short(one['ms'])} ms, {short(one['px'])} px)"


def findings(results):
    """A list of (scene's title, light's title, peers win, sentences)."""
    found = []
    for scene in results["scenes"]:
        points = [point for point in results["points"] if point["scene"] == scene["name"]]
        for light in LIGHTS:
            every = [one for settings in curves_of(points, light).values() for one in settings]
            sound = [one for one in shown(every) if one["sound"]]
            ours = [one for one in sound if one["kit"] == OURS]
            peers = [one for one in sound if one["kit"] != OURS]
            if not ours or not any(one["kit"] != OURS for one in every):
                continue
            say = lambda those: "; ".join(described(one, True) for one in those)  # noqa: E731
            sentences = [f"The best for their time: {say(front(sound))}."]
            beaten = [one for one in front(sound) if one["kit"] != OURS and not is_matched(one, ours)]
            ahead = [one for one in peers if not is_matched(one, ours, 1.0, 0.1)]
            if beaten:
                sentences.append(f"osgShadow is better with {say(beaten)}"
                                 + ("." if ahead else ", within what runs differ by (1 ms or a tenth)."))  # fmt: skip
            failed = sorted({one["name"] for one in every if not one["sound"]})
            if failed:
                sentences.append(f"Fails: {', '.join(failed)}.")
            found.append((scene, light, bool(beaten), bool(ahead), sentences))
    return found


def findings_text(found):
    if not found:
        return "Nothing is compared, because that needs timings of a Gnomon technique and of one of osgShadow."
    beaten = [f"{scene['name']}, {light}" for scene, light, wins, _, _ in found if wins]
    ahead = [f"{scene['name']}, {light}" for scene, light, _, leads, _ in found if leads]
    text = f"In {len(beaten) or 'none'} of {len(found)} cases (a scene with a still or a moving light) osgShadow is better at some cost"
    text += f": {'; '.join(beaten)}." if beaten else "."
    return text + (f" By more than 1 ms or a tenth in {len(ahead)}: {'; '.join(ahead)}." if ahead else "")


def budgets(results):
    """What became of the budgets of auto: rows of the scene, setting, light, error, time, whether it was kept, and how
    much it costs beside the best fixed setting that keeps it. Processor time, which other work disturbs less."""
    rows = []
    time = lambda point, light: point["cost"][f"{light}ProcessorMs"]["median"]  # noqa: E731
    wrong = lambda point: (point["errors"]["awayFromEdges"]["misclassified"] or 0.0) if point["errors"] else math.inf  # noqa: E731
    options = lambda point: dict(part.split("=", 1) for part in spec_of(point).partition(":")[2].split(",") if part)  # noqa: E731
    for auto in results["points"]:
        if auto["technique"] != "auto" or not auto["cost"]:
            continue
        asked = options(auto)
        px = float(asked.get("error", "1").removesuffix("px"))
        for light in LIGHTS:
            keeps = lambda point: error_of(point) <= px and not point["catastrophic"]  # noqa: E731, B023
            rivals = [point for point in results["points"]
                      if point["scene"] == auto["scene"] and point["kit"] == OURS and point["technique"] != "auto"
                      and point["cost"] and keeps(point) and options(point).get("composite") == asked.get("composite")
                      and (point["technique"] not in ("planar", "box", "hull") or wrong(point) <= wrong(auto))]  # fmt: skip
            best = min(rivals, key=lambda point: time(point, light), default=None)  # noqa: B023
            rows.append({"scene": auto["scene"], "setting": auto["setting"], "light": light, "px": error_of(auto),
                         "ms": time(auto, light), "kept": error_of(auto) <= px,
                         "best": best and f"{best['technique']}, {best['setting']}",
                         "ratio": best and time(auto, light) / max(time(best, light), 1e-9)})  # fmt: skip
    return rows


def predictions_text(points):
    """How often what auto predicts is near to what was measured."""
    pairs = {"errors": [], "times": []}
    for point in points:
        predicted = point["prediction"]
        if not predicted or point["failure"]:
            continue
        if predicted["boundaryP95Pixels"] is not None and point["errors"]:
            pairs["errors"].append((predicted["boundaryP95Pixels"], error_of(point)))
        for light in LIGHTS if point["cost"] else ():
            pairs["times"].append((predicted[f"{light}Processor"]["ms"], value(point, ("cost", f"{light}ProcessorMs", "median"))))
    near = lambda one, other, factor, least: (max(one, least) <= factor * max(other, least)  # noqa: E731
                                              and max(other, least) <= factor * max(one, least))  # fmt: skip
    return " ".join(
        f"Of {len(all_of)} {what} that auto predicts {sum(near(*pair, factor, least) for pair in all_of)} are within a "
        f"factor of {factor}." for (what, all_of), factor, least in zip(pairs.items(), (1.5, 2), (0.02, 0.25)) if all_of)  # fmt: skip


def budgets_text(rows):
    possible = [row for row in rows if row["best"]]
    kept = [row for row in possible if row["kept"]]
    close = sum(row["ratio"] <= 1.25 for row in kept)
    return (f"auto keeps {len(kept)} of {len(possible)} budgets that a fixed setting keeps; in {close} of them it is "
            "within 1.25 times the best fixed setting.") if possible else ""  # fmt: skip


# Of the chart: table and page ----------------------------------------------------------------------------------------

COLUMNS = [  # name in results.csv, head in the page or None, where it stands
    ("added_steady_ms", "ms, still light", ("cost", "steadyWallMs", "median")),
    ("added_steady_alone_ms", "processor alone, still light", ("cost", "steadyAloneMs", "median")),
    ("added_moving_ms", "ms, moving light", ("cost", "movingWallMs", "median")),
    ("added_moving_alone_ms", "processor alone, moving light", ("cost", "movingAloneMs", "median")),
    ("added_steady_processor_ms", None, ("cost", "steadyProcessorMs", "median")),
    ("added_moving_processor_ms", None, ("cost", "movingProcessorMs", "median")),
    ("added_first_ms", "ms, first frame", ("cost", "firstMs")),
    ("memory_mib", "MiB", ("cost", "memoryMiB")),
    ("draws", None, ("cost", "draws")),
    ("triangles", None, ("cost", "triangles")),
    ("boundary_p95_px", "edge off, px", ("errors", "boundaryPixels", "p95")),
    ("boundary_max_px", None, ("errors", "boundaryPixels", "max")),
    ("misclassified", "wrong, share", ("errors", "awayFromEdges", "misclassified")),
    ("iou", "IoU", ("errors", "awayFromEdges", "iou")),
    ("turned_away_wrong_px", "turned away wrong, px", ("errors", "turnedAwayWrong")),
    ("teeth_px", "teeth, px", ("errors", "teeth")),
    ("lost_px", None, ("errors", "causes", "leak")),
    ("acne_px", None, ("errors", "causes", "acne")),
    ("shaded_rmse", "RMSE, shaded", ("shadedRmse",)),
    ("flicker_share", "flicker, share", ("flickerShare",)),
    ("crawl_px", "edge crawl, px", ("crawlPixels",)),
    ("predicted_px", None, ("prediction", "boundaryP95Pixels")),
]


def value(point, path):
    for part in path:
        point = (point or {}).get(part)
    return point


def alone_text(results, is_measured):
    """What the columns of the processor alone are, or why there are none; nothing of results that older programs made."""
    if is_measured:
        return ("Processor alone: ms that shadows add to a frame where pixels cost nothing, as on a graphics card. Mesa draws "
                "nothing there.")  # fmt: skip
    why = dict(results["made"]).get("processor alone")
    return f"Processor alone: {why}" if why else ""


def write_csv(file, head, rows):
    with open(file, "w", newline="", encoding="utf-8") as out:
        csv.writer(out).writerows([head, *rows])


STYLE = """
:root { font: 15px/1.5 system-ui, sans-serif; color: #111827 }
body { max-width: 70rem; margin: 1rem auto; padding: 0 1rem }
img { max-width: 100%; height: auto } figure { margin: 1rem 0 }
table { border-collapse: collapse; font-size: 13px } .wide { overflow-x: auto }
th, td { padding: 2px 8px; text-align: right; border-bottom: 1px solid #e5e7eb; white-space: nowrap }
th { cursor: pointer; text-align: right; position: sticky; top: 0; background: #fff }
td.text, th.text { text-align: left } tr.bad td { color: #b91c1c } tr.ours td.text { font-weight: 600 }
.note, figcaption { color: #4b5563; font-size: 13px } .warning { color: #b91c1c }
#heat td { width: 18px; height: 18px; padding: 0; text-align: center; border: 1px solid #fff; font-size: 11px }
#heat th { font-weight: 400 } #heat th.up { writing-mode: vertical-rl; padding: 4px 0; vertical-align: bottom }
#heat a { display: block; color: inherit; text-decoration: none }
"""

SCRIPT = """
for (const table of document.querySelectorAll("table.sortable")) {
  const body = table.tBodies[0];
  const key = (row, i) => { const text = row.cells[i].dataset.value ?? row.cells[i].textContent;
    return text === "" ? Infinity : isNaN(text) ? text : Number(text); };
  table.tHead.rows[0].querySelectorAll("th").forEach((head, i) => head.addEventListener("click", () => {
    const way = head.dataset.way = head.dataset.way === "1" ? "-1" : "1";
    body.append(...[...body.rows].sort((a, b) => { const x = key(a, i), y = key(b, i); return way * (x < y ? -1 : x > y ? 1 : 0); }));
  }));
}
for (const filter of document.querySelectorAll("input.filter"))
  filter.addEventListener("input", () => { for (const row of document.querySelectorAll("table.sortable tbody tr"))
    row.hidden = !row.textContent.toLowerCase().includes(filter.value.toLowerCase()); });
"""

HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ title }}</title><style>{{ style }}</style></head><body>
<h1>{{ title }}</h1>
{% if not results.complete %}<p class="warning">The run was interrupted: results are missing.</p>{% endif %}
"""

FOOT = """
<h2>How it was made</h2>
<table>{% for name, text in results.made %}<tr><td class="text">{{ name }}</td><td class="text">{{ text }}</td></tr>{% endfor %}</table>
<p class="note">{{ file }}.json has all values with all digits, {{ file }}.csv those of the table.</p>
<script>{{ script }}</script></body></html>
"""

CHART_PAGE = HEAD + """
<p>Every technique of Gnomon and of osgShadow, measured on the same scenes in the same run. Left is faster, down is more
accurate. The edge of a shadow is off by so many pixels that 95 % of it lie nearer to the edge by rays.</p>
<figure><img src="figure.svg" alt="error against time, all scenes"><figcaption>Medians over {{ results.scenes|length }}
scene{{ "s" if results.scenes|length != 1 }}. The table has all settings.</figcaption></figure>
<p>{{ summary }} {{ kept }}</p>
{% if rows %}<details><summary>The budgets of auto</summary><div class="wide"><table class="sortable"><thead><tr>
<th class="text">scene</th><th class="text">auto</th><th class="text">light</th><th>px</th><th>ms</th><th>kept</th>
<th class="text">best fixed setting</th><th>ratio to it</th></tr></thead><tbody>
{% for row in rows %}<tr><td class="text">{{ row.scene }}</td><td class="text">{{ row.setting }}</td><td class="text">{{ row.light }}</td>
<td>{{ short(row.px) }}</td><td>{{ short(row.ms) }}</td><td>{{ "yes" if row.kept else "no" }}</td>
<td class="text">{{ row.best or "" }}</td><td>{{ short(row.ratio) if row.ratio else "" }}</td></tr>{% endfor %}
</tbody></table></div></details>{% endif %}
<h2>Scene by scene</h2>
{% for scene in results.scenes %}<details><summary>{{ scene.title }}</summary>
<figure><img loading="lazy" src="figure-{{ scene.name }}.svg" alt="error against time"></figure>
<ul>{% for at, light, _, _, sentences in found if at is sameas scene %}<li>{{ lights[light] }}: {{ sentences|join(" ") }}</li>{% endfor %}</ul>
<figure><img loading="lazy" src="{{ scene.truthPicture }}" alt="the truth"><figcaption>The truth, by rays.
{% for name, text in scene.view %}{{ name }} {{ text }} {% endfor %}
{% if scene.frameMs %}A frame without shadows takes {{ short(scene.frameMs) }} ms{% if scene.frameAloneMs %}, of the processor alone {{ short(scene.frameAloneMs) }}{% endif %}.{% endif %}</figcaption></figure></details>{% endfor %}
<h2>All points</h2>
<p><label>Show rows that contain <input class="filter"></label> <span class="note">A click on a head sorts. Red: a
catastrophe. A setting leads to its picture, the error to where it is wrong (missed shadow red, false shadow blue).
{{ alone }}</span></p>
<div class="wide"><table class="sortable"><thead><tr><th class="text">scene</th><th class="text">technique</th>
<th class="text">setting</th>{% for head in heads %}<th>{{ head }}</th>{% endfor %}<th class="text">it says</th></tr></thead><tbody>
{% for point in results.points %}<tr class="{{ "bad" if point.catastrophic }} {{ "ours" if point.kit == "Gnomon" }}">
<td class="text">{{ point.scene }}</td><td class="text">{{ name_of(point) }}</td>
<td class="text" title="{% for name, text in point.settings %}{{ name }} {{ text }} {% endfor %}">{% if point.picture %}<a href="{{ point.picture }}">{{ point.setting }}</a>{% else %}{{ point.setting }}{% endif %}</td>
{% for head, path in columns %}{% set it = value(point, path) %}<td data-value="{{ "" if it is none else it }}">{% if path[1] == "boundaryPixels" and point.overlay %}<a href="{{ point.overlay }}">{% endif %}{{ "" if it is none else short(it) }}{% if path[1] == "boundaryPixels" and point.overlay %}</a>{% endif %}</td>{% endfor %}
<td class="text">{{ ([point.failure] + point.notes)|select|join(" ") }}</td></tr>{% endfor %}
</tbody></table></div>""" + FOOT


def render(page, **values):
    environment = jinja2.Environment(autoescape=True, trim_blocks=True)
    return environment.from_string(page).render(style=jinja2.utils.markupsafe.Markup(STYLE), short=short,
                                                script=jinja2.utils.markupsafe.Markup(SCRIPT), **values)  # fmt: skip


def report_chart(folder, results):
    scenes = results["scenes"]
    title = f"How fast shadows are, and how wrong: medians over {len(scenes)} scenes" if len(scenes) != 1 else scenes[0]["title"]
    save(chart_figure(results, results["points"], scenes, title), folder, "figure")
    for scene in scenes:
        points = [point for point in results["points"] if point["scene"] == scene["name"]]
        save(chart_figure(results, points, [scene], scene["title"]), folder, f"figure-{scene['name']}")
    found, rows = findings(results), budgets(results)
    summary = findings_text(found)
    kept = " ".join(text for text in (predictions_text(results["points"]), budgets_text(rows)) if text)
    is_alone = any(value(point, ("cost", "steadyAloneMs")) for point in results["points"])
    columns = [(head, path) for _, head, path in COLUMNS if head and (is_alone or "alone" not in head)]
    page = render(CHART_PAGE, title="How fast and how wrong shadows are", results=results, file="results", summary=summary,
                  kept=kept, rows=rows, found=found, lights=LIGHTS, heads=[head for head, _ in columns], columns=columns,
                  value=value, name_of=name_of, alone=alone_text(results, is_alone))  # fmt: skip
    (folder / "index.html").write_text(page, encoding="utf-8")
    texts = ("scene", "kit", "technique", "setting", "failure", "catastrophic", "picture", "overlay")
    write_csv(folder / "results.csv", [*texts, "notes", *(name for name, _, _ in COLUMNS)],
              ([*(point[name] for name in texts), " | ".join(point["notes"]), *(value(point, path) for _, _, path in COLUMNS)]
               for point in results["points"]))  # fmt: skip
    for point in results["points"]:
        if point["setting"] == "best":
            best = " ".join(f"{name}={text}" for name, text in point["settings"]) or "its defaults"
            print(f"{point['scene']}: {point['technique']} is best with {best}")
    print("\n".join(line for line in (summary, kept) if line))
    print(f"the chart is {folder}/index.html")


# Of the stability table ----------------------------------------------------------------------------------------------

OUTCOMES = ["held", "stated limit", "elsewhere", "left", "catastrophe"]
REACH = LinearSegmentedColormap.from_list("reach", ["#d03727", "#f4a55c", "#fde7a0"])
HELD, NOT_DRAWN = "#5b9bd0", "#e5e7eb"
SIGNS = {"stated limit": "/", "elsewhere": "·", "catastrophe": "×"}


def contender(row):
    name = row["technique"] if row["kit"] == OURS else f"osgShadow {row['technique']}"
    return name + ("" if row["setting"] in ("", "defaults") else f", {row['setting']}")


def reach_colour(row):
    return HELD if row["reach"] >= 1 else matplotlib.colors.to_hex(REACH(row["reach"]))


def value_text(scene, place):
    return f"{scene['values'][place]:.6g} {scene['unit']}".strip()


def left_at(row):
    return next((place for place, cell in enumerate(row["cells"]) if not cell["inBudget"]), None)


def stability_figure(table, contenders):
    scenes = table["scenes"]
    column = {scene["id"]: i for i, scene in enumerate(scenes)}
    figure, axes = plt.subplots(figsize=(2.3 + 0.19 * len(scenes), 1.7 + 0.17 * len(contenders)))
    width, height = figure.get_size_inches()
    figure.subplots_adjust(left=2.1 / width, right=1 - 0.1 / width, top=1 - 1.1 / height, bottom=0.4 / height)
    for row in table["rows"]:
        x, y = column[row["scene"]], contenders.index(contender(row))
        limit = row["outcome"] == "stated limit"
        hatch = "/////" if limit and row["kit"] == OURS else None
        colour = NOT_DRAWN if limit and not hatch else reach_colour(row)  # osgShadow states nothing: the chart cannot stage it
        axes.add_patch(plt.Rectangle((x - 0.46, y - 0.46), 0.92, 0.92, facecolor=colour, hatch=hatch,
                                     edgecolor="#111827" if hatch else "none", lw=0))  # fmt: skip
        if row["outcome"] in ("elsewhere", "catastrophe"):
            axes.text(x, y, SIGNS[row["outcome"]], ha="center", va="center", fontsize=8, fontweight="bold")
    axes.set(xlim=(-0.6, len(scenes) - 0.4), ylim=(len(contenders) - 0.4, -0.6))
    axes.set_xticks(range(len(scenes)), [scene["id"] for scene in scenes], rotation=90, fontsize=7)
    axes.set_yticks(range(len(contenders)), [name.removeprefix("osgShadow ") for name in contenders], fontsize=7.5)
    for label, name in zip(axes.get_yticklabels(), contenders):
        ours = not name.startswith("osgShadow")
        label.set(color="#0072b2" if ours else "#4b5563", fontweight="bold" if ours else "normal")
    axes.tick_params(length=0, labeltop=True, labelbottom=False)
    axes.spines[:].set_visible(False)
    for i, scene in enumerate(scenes):
        if i == 0 or scene["section"] != scenes[i - 1]["section"]:
            axes.text(i - 0.45, -2.6, scene["section"], fontsize=8, fontweight="bold", clip_on=False)
            axes.plot([i - 0.5] * 2, [-0.6, len(contenders) - 0.5], color="#374151", lw=0.7 if i else 0)
    figure.suptitle("How far each technique gets before its shadow breaks (grey: osgShadow)", x=0.01, ha="left", fontsize=11, fontweight="bold")
    figure.legend(handles=[Patch(color=HELD, label="right to the end"), Patch(color="#fde7a0", label="fails late"),
                           Patch(color="#d03727", label="fails at once"),
                           Patch(facecolor="white", edgecolor="#111827", hatch="/////", label="it states the limit"),
                           Patch(color=NOT_DRAWN, label="no receiver for it"),
                           Line2D([], [], ls="", marker="$·$", color="#111827", label="right on its receiver"),
                           Line2D([], [], ls="", marker="x", color="#111827", label="lost without a word")],
                  loc="lower left", ncols=7, fontsize=7.5, frameon=False)  # fmt: skip
    return figure


STABILITY_PAGE = HEAD + """
<p>Each scene has one parameter, swept from harmless to hostile. A technique is within its budget while 95 % of the shadow's
edge lies within 1 px of the true one, no pixel away from edges is wrong, and no convex body has teeth.</p>
<figure><img src="stability.svg" alt="technique by scene"></figure>
<h2>All cells</h2>
<p><label>Show rows that contain <input class="filter"></label> <span class="note">A click on a head sorts.</span></p>
<div class="wide"><table class="sortable"><thead><tr><th class="text">scene</th><th class="text">technique</th>
<th class="text">outcome</th><th class="text">at</th><th>wrong px</th><th>turned away wrong, px</th><th>teeth, px</th><th>edge off, px</th><th>IoU</th>
<th>flicker, share</th>
<th>edge crawl, px</th><th class="text">pictures</th><th class="text">it says</th></tr></thead><tbody>
{% for row in results.rows %}{% set scene = scenes[row.scene] %}{% set place = left_at(row) %}
{% set cell = row.cells[-1 if place is none else place] %}
<tr class="{{ "bad" if row.outcome == "catastrophe" }} {{ "ours" if row.kit == "Gnomon" }}">
<td class="text" title="{{ scene.about }}">{{ scene.id }} {{ scene.title }}</td><td class="text">{{ contender(row) }}</td>
<td class="text" style="background: {{ colour(row) }}" data-value="{{ row.reach }}">{{ row.outcome }}</td>
<td class="text">{{ "the end" if place is none else value_text(scene, place) }}</td>
<td>{{ cell.everywhere.wrong }}</td><td>{{ turned_away(row) }}</td>
<td>{{ "" if cell.everywhere.teeth is none else cell.everywhere.teeth }}</td>
<td>{{ short(cell.everywhere.p95Pixels) }}</td><td>{{ short(cell.everywhere.iou) }}</td>
<td>{{ short(row.flickerShare) }}</td><td>{{ short(row.crawlPixels) }}</td>
<td class="text">{% for one in row.cells if one.picture %}<a href="{{ one.picture }}">{{ value_text(scene, loop.index0) }}</a> {% endfor %}{% if row.flickerPicture %}<a href="{{ row.flickerPicture }}">film</a>{% endif %}</td>
<td class="text">{{ cell.message or cell.diagnosis|join(" ") }}</td></tr>{% endfor %}
</tbody></table></div>""" + FOOT


def turned_away(row):
    return max([row["flickerTurnedAwayWrong"]] + [(cell["onReceiver"] or cell["everywhere"])["turnedAwayWrong"] for cell in row["cells"]])


def report_stability(folder, table):
    contenders = list(dict.fromkeys(map(contender, table["rows"])))
    scenes = {scene["id"]: scene for scene in table["scenes"]}
    save(stability_figure(table, contenders), folder, "stability")
    page = render(STABILITY_PAGE, title="When shadows break", results=table, file="stability", scenes=scenes, left_at=left_at,
                  contender=contender, colour=reach_colour, value_text=value_text, turned_away=turned_away)  # fmt: skip
    (folder / "stability.html").write_text(page, encoding="utf-8")
    judged = ("p95Pixels", "wrong", "turnedAwayWrong", "shadow", "iou", "teeth")
    write_csv(folder / "stability.csv",
              ["scene", "parameter", "value", "unit", "kit", "technique", "setting", "outcome", "failure", *judged, "in_budget",
               "catastrophe", "it_says"],
              ([row["scene"], scenes[row["scene"]]["parameter"], scenes[row["scene"]]["values"][place],
                scenes[row["scene"]]["unit"], row["kit"], row["technique"], row["setting"], row["outcome"], cell["failure"],
                *(cell["everywhere"][key] for key in judged), cell["inBudget"], cell["catastrophe"],
                cell["message"] or " ".join(cell["diagnosis"])]
               for row in table["rows"] for place, cell in enumerate(row["cells"])))  # fmt: skip
    if len(scenes) <= 6:  # the text tells all
        for row in table["rows"]:
            place, scene = left_at(row), scenes[row["scene"]]
            end = "held to the end"
            if place is not None:
                cell = row["cells"][place]
                what = f"{cell['failure']}, {cell['message']}" if cell["failure"] else f"{cell['everywhere']['wrong']} wrong pixels"
                what += f", {cell['everywhere']['teeth']} teeth" if cell["everywhere"]["teeth"] else ""
                end = f"{row['outcome']} at {value_text(scene, place)}: {what}. {' '.join(cell['diagnosis'])}"
            print(f"{row['scene']:5} {contender(row):36} {end}. Turned away and wrong: {turned_away(row)} px")
    print(f"{'':36}" + "".join(f"{outcome:>14}" for outcome in OUTCOMES))
    for name in contenders:
        outcomes = [row["outcome"] for row in table["rows"] if contender(row) == name]
        print(f"{name:36}" + "".join(f"{outcomes.count(outcome):>14}" for outcome in OUTCOMES))
    print(f"the table is {folder}/stability.html")


def with_numbers(fields):
    """JSON has no infinity and no NaN: the results have these as text."""
    numbers = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
    return {name: numbers.get(value, value) if isinstance(value, str) else value for name, value in fields.items()}


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    for name, report in (("results", report_chart), ("stability", report_stability)):
        file = folder / f"{name}.json"
        if file.is_file():
            try:
                return report(folder, json.loads(file.read_text(encoding="utf-8"), object_hook=with_numbers))
            except (ValueError, KeyError, TypeError) as damage:
                sys.exit(f"gnomonchart: \"{file}\" is damaged: {damage!r}. Measure again without --again.")
    sys.exit(f"gnomonchart: \"{folder}\" holds neither results.json nor stability.json. Name the folder of a run of gnomonchart.")


if __name__ == "__main__":
    main()
