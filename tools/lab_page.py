"""The lab as one HTML page: tables and plots of all experiments, and strips of pictures per preset.

Run by tools/lab_report, which provides matplotlib. The page holds its pictures, so it can be copied anywhere.
"""
import argparse
import base64
import html
import io
import json
import math
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend is chosen first)

PRESETS = ["naive", "cosine", "nee", "mis", "roulette", "reference"]
STRIPS = [("cornell-box", 1.0), ("veach-mis", 4 / 3)]  # scene, width over height of its camera
REFERENCE_TIMES = 12  # the image that errors are taken against gets so many times the time of a strip's
COST_TITLES = {"efficiency": "efficiency (longer is better)", "variance": "variance of a sample",
               "ratio": "variance over that of the first row (shorter is better)"}
BLUE, ORANGE, GREY = "#2f6db3", "#d9822b", "#8a8f98"

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #1c2330; }
h1 { margin-bottom: 0; } h2 { margin-top: 3rem; border-bottom: 2px solid #d7dbe2; } h3 { margin-bottom: .3rem; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; display: block; overflow-x: auto; }
th, td { padding: .15rem .6rem; text-align: right; border-bottom: 1px solid #e5e8ee; white-space: nowrap; }
th { border-bottom: 2px solid #aab2c0; } th:first-child, td:first-child { text-align: left; }
img.plot { max-width: 100%; } li { margin: .2rem 0; } .quiet { color: #667085; }
.strip { display: flex; flex-wrap: wrap; gap: .6rem; } .strip figure { margin: 0; width: 16rem; }
.strip img { width: 100%; image-rendering: pixelated; display: block; } figcaption { font-size: .85rem; }
"""


class Lab:
    """The program, asked for results."""

    def __init__(self, binary, out):
        self.binary = str(Path(binary).resolve())
        self.out = out

    def run(self, *arguments):
        print("  lavalight " + " ".join(arguments), file=sys.stderr, flush=True)
        done = subprocess.run([self.binary, *arguments], cwd=self.out, text=True, capture_output=True, check=False)
        if done.returncode != 0:
            sys.exit(f"lab_page: lavalight {' '.join(arguments)} failed:\n{done.stderr}")
        return done.stdout

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json"))


def png_of(figure):
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=110)
    plt.close(figure)
    return data.getvalue()


def image(data, css_class, alt):
    encoded = base64.b64encode(data).decode("ascii")
    return f'<img class="{css_class}" alt="{html.escape(alt)}" src="data:image/png;base64,{encoded}">'


def number(value):
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:.5g}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def table_html(table):
    head = "".join(f"<th>{html.escape(c['heading'])}</th>" for c in table["columns"])
    rows = "".join("<tr>" + "".join(f"<td>{html.escape(number(row[c['key']]))}</td>" for c in table["columns"]) + "</tr>"
                   for row in table["rows"])
    return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def plot_estimators(table):
    """Estimates with two standard errors, and what a unit of accuracy costs beside the naive estimator."""
    rows = table["rows"][::-1]
    names = [row["estimator"] for row in rows]
    cost = next((key for key in ("efficiency", "ratio") if all(row.get(key) is not None for row in rows)), "variance")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 0.9 + 0.38 * len(rows)), sharey=True, layout="constrained")
    for exact in sorted({row["exact"] for row in rows if row["exact"] is not None}):
        left.axvline(exact, color=ORANGE, linewidth=1.5, label="exact")
    left.errorbar([row["estimate"] for row in rows], names, xerr=[2 * row["standardError"] for row in rows], fmt="o",
                  color=BLUE, markersize=4, capsize=3)
    left.set_title("estimate, ± 2 standard errors", fontsize=10)
    left.ticklabel_format(axis="x", useOffset=False)
    left.locator_params(axis="x", nbins=6)
    left.margins(y=0.15)
    values = [row[cost] or 0.0 for row in rows]
    bars = right.barh(names, values, color=BLUE, height=0.6)
    positive = [v for v in values if v > 0]
    if positive and max(positive) / min(positive) > 30:
        right.set_xscale("log")
    right.bar_label(bars, [f" {v:.3g}" for v in values], fontsize=8)
    right.margins(x=0.2)
    right.set_title(COST_TITLES[cost], fontsize=10)
    for axes in (left, right):
        axes.tick_params(labelsize=9)
        axes.spines[["top", "right"]].set_visible(False)
    return png_of(figure)


def plot_convergence(table):
    figure, axes = plt.subplots(figsize=(6, 3.6), layout="constrained")
    samples = [row["samples"] for row in table["rows"]]
    for key, name, colour in (("independentRmse", "independent", GREY), ("sobolRmse", "Sobol", BLUE)):
        axes.loglog(samples, [row[key] for row in table["rows"]], "o-", color=colour, label=name, base=2)
    start = table["rows"][0]["independentRmse"]
    for slope, style in ((-0.5, ":"), (-1.5, "--")):
        axes.loglog(samples, [start * (n / samples[0]) ** slope for n in samples], style, color=ORANGE, linewidth=1,
                    label=f"slope {slope}", base=2)
    axes.set_xlabel("samples")
    axes.set_ylabel("RMSE")
    axes.legend(fontsize=8, frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    return png_of(figure)


def experiment_html(result):
    parts = [f"<h2 id=\"{result['experiment']}\">{result['experiment']}</h2><p>{html.escape(result['question'])}</p>"]
    for table in result["tables"]:
        parts.append(f"<h3>{html.escape(table['title'])}</h3>")
        keys = {column["key"] for column in table["columns"]}
        if {"estimator", "estimate", "ratio"} <= keys:
            parts.append(image(plot_estimators(table), "plot", table["title"]))
        elif "sobolRmse" in keys:
            parts.append(image(plot_convergence(table), "plot", table["title"]))
        parts.append(table_html(table))
        parts.append("<ul>" + "".join(f"<li>{html.escape(note)}</li>" for note in table["notes"]) + "</ul>")
    return "\n".join(parts)


def make_reference(lab, scene, size, seconds):
    """Another seed than the strips': Sobol's samples of one seed would share their errors."""
    lab.run("render", scene, "--size", size, "--preset", "reference", "--seed", "1", "--time", str(seconds), "-o",
            f"{scene}-reference.exr", "--quiet")


def strip_picture(lab, scene, size, preset, stop):
    """One picture of a strip; `stop` is --spp N or --time S."""
    name = f"{scene}-{preset}{stop[0]}"
    lab.run("render", scene, "--size", size, "--preset", preset, *stop, "-o", f"{name}.exr", "--png", f"{name}.png",
            "--report", f"{name}.json", "--quiet")
    report = json.loads((lab.out / f"{name}.json").read_text())
    error = lab.json("compare", f"{name}.exr", f"{scene}-reference.exr", "--threshold", "inf")["rmse"]
    pixels = math.prod(int(side) for side in size.split("x"))
    return {"png": (lab.out / f"{name}.png").read_bytes(), "preset": preset, "rmse": error,
            "spp": report["samples"]["total"] / pixels, "seconds": report["seconds"]["render"]}


def strip_html(title, pictures):
    figures = "".join(
        f"<figure>{image(p['png'], 'picture', p['preset'])}<figcaption><b>{p['preset']}</b><br>"
        f"RMSE {p['rmse']:.4f}<br>{p['spp']:.0f} samples per pixel in {p['seconds']:.1f} s</figcaption></figure>"
        for p in pictures)
    steps = [f"{a['preset']} → {b['preset']}: error × {b['rmse'] / a['rmse']:.2f}" for a, b in zip(pictures, pictures[1:])]
    return f'<h3>{title}</h3><div class="strip">{figures}</div><p class="quiet">{"; ".join(steps)}</p>'


def strips_html(lab, arguments):
    parts = ["<h2 id=\"presets\">The steps of the lecture in pictures</h2>"]
    meanings = lab.run("presets").splitlines()[::2]
    parts.append("<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in meanings) + "</ul>")
    for scene, aspect in STRIPS:
        size = f"{round(aspect * arguments.height)}x{arguments.height}"
        make_reference(lab, scene, size, REFERENCE_TIMES * arguments.seconds)
        for title, stop in ((f"{scene}, {arguments.seconds:g} seconds each", ("--time", str(arguments.seconds))),
                            (f"{scene}, {arguments.spp} samples per pixel each", ("--spp", str(arguments.spp)))):
            pictures = [strip_picture(lab, scene, size, preset, stop) for preset in PRESETS]
            parts.append(strip_html(title, pictures))
    parts.append(f'<p class="quiet">RMSE against an image of the preset reference, of another seed, that took '
                 f"{REFERENCE_TIMES} times as long as the pictures of equal time.</p>")
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(prog="tools/lab_report", description=__doc__.splitlines()[0])
    parser.add_argument("--lavalight", required=True, help="the binary (tools/lab_report says which)")
    parser.add_argument("--out", type=Path, default=Path("out/lab"), help="folder; the page is index.html in it")
    parser.add_argument("--seconds", type=float, default=4.0, help="for each picture of equal time")
    parser.add_argument("--spp", type=int, default=16, help="for each picture of equal samples")
    parser.add_argument("--height", type=int, default=192, help="of the pictures, in pixels")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    lab = Lab(arguments.lavalight, arguments.out)

    results = []
    for entry in lab.json("lab"):
        results.append(lab.json("lab", entry["experiment"]))
        (arguments.out / f"{entry['experiment']}.json").write_text(json.dumps(results[-1], indent=2))
    device = results[0]["device"]
    links = " · ".join(f'<a href="#{r["experiment"]}">{r["experiment"]}</a>' for r in results)
    body = "\n".join([strips_html(lab, arguments)] + [experiment_html(result) for result in results])
    (arguments.out / "index.html").write_text(
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Lavalight: the lab</title><style>{STYLE}</style>'
        f"</head><body><h1>The lab</h1><p class=\"quiet\">Every estimator of the lectures, measured by kernels on "
        f"{html.escape(device['name'])}, {html.escape(device['driver'])}.</p>"
        f'<p><a href="#presets">pictures</a> · {links}</p>{body}</body></html>', encoding="utf-8")
    print(arguments.out / "index.html")


if __name__ == "__main__":
    main()
