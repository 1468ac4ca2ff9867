#!/usr/bin/env python3
"""Renders every glTF scene of a folder with `clvndf render` and writes one page that shows them: image, effects that each calls
for, times, samples a second, error, memory, warnings.

    python3 bench/gallery.py FOLDER [--out DIR] [--only WORD ...] [-- OPTION ...]

The page is DIR/index.html and needs no other file. What stands behind -- goes to `clvndf render` (--env FILE, --time S, ...).
Exit status: 0 every scene is shown, 1 some are not (the page says why), 2 nothing could be done.
"""
import argparse
import base64
import html
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = (".gltf", ".glb")

STYLE = """
body { font: 10pt/1.35 system-ui, sans-serif; max-width: 62rem; margin: 1.5rem auto; padding: 0 1rem; color: #222 }
h1 { font-size: 16pt; margin-bottom: .3rem } h2 { font-size: 11.5pt; margin: 0 0 .4rem; overflow-wrap: anywhere }
table { border-collapse: collapse; font-size: 8.5pt; width: 100%; margin: .3rem 0 }
th, td { text-align: left; vertical-align: top; padding: .12rem .6rem .12rem 0; border-bottom: 1px solid #ddd }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums }
article { display: grid; grid-template-columns: 20rem 1fr; gap: 0 1.2rem; border-top: 2px solid #222;
          padding: .6rem 0 1rem; break-inside: avoid }
article h2, article .wrong { grid-column: 1 / 3 }
img { width: 100%; display: block } p { margin: .35rem 0 } a { color: inherit }
.small { font-size: 8.5pt; color: #444 } .wrong { color: #a00 } code { overflow-wrap: anywhere }
@media print { body { margin: 0; max-width: none; padding: 0 } thead { display: table-header-group }
               tr { break-inside: avoid } article { grid-template-columns: 7cm 1fr } a { text-decoration: none } }
@media (max-width: 40rem) { article { display: block } }
"""


def fail(why):
    print(f"gallery.py: {why}", file=sys.stderr)
    sys.exit(2)


class Shot:
    """A scene, its image, and what the run said of itself."""
    def __init__(self, scene, arguments):
        self.name = scene.relative_to(arguments.folder).as_posix()
        with tempfile.TemporaryDirectory() as folder:
            image, report = pathlib.Path(folder) / "image.png", pathlib.Path(folder) / "report.json"
            process = subprocess.Popen([arguments.clvndf, "--quiet", "render", scene, "-o", image, "--report", report,
                                        *arguments.options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                       encoding="utf-8", errors="replace")
            self.said = process.stderr.read().strip()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = self.status = os.waitstatus_to_exitcode(status)
            self.peak = usage.ru_maxrss * 1024
            self.image = image.read_bytes() if image.exists() else None
            self.report = json.loads(report.read_text("utf-8")) if report.exists() else None

    def shown(self):
        return self.image is not None and self.report is not None


# ---- pieces of the page; a cell in a tuple is a number ----

def row(cells, cell="td"):
    def one(content):
        number, content = (" class=number", content[0]) if isinstance(content, tuple) else ("", content)
        return f"<{cell}{number}>{content if isinstance(content, Raw) else html.escape(str(content))}</{cell}>"
    return "<tr>" + "".join(map(one, cells)) + "</tr>"


class Raw(str):
    """HTML already."""


def table(head, rows):
    return f"<table><thead>{row(head, 'th')}</thead><tbody>{''.join(map(row, rows))}</tbody></table>"


def paragraph(content, kind="small"):
    return f"<p class={kind}>{html.escape(content)}</p>"


def mebibytes(size):
    return f"{size / 2 ** 20:.0f}" if size >= 10 * 2 ** 20 else f"{size / 2 ** 20:.1f}"


def summary(shots):
    def line(i, shot):
        name = Raw(f"<a href='#scene{i}'>{html.escape(shot.name)}</a>")
        if not shot.shown():
            return (name, *[("–",)] * 8, ("not shown",))
        r = shot.report
        on = [effect["name"] for effect in r["effects"] if effect["on"]]
        return (name, (f"{r['triangles']:,}",), (f"{r['seconds_to_first_sample']:.2f}",), (f"{r['seconds']:.1f}",),
                (f"{r['samples_per_second'] / 1e6:.2f}",), (f"{100 * r['error']:.1f}",),
                (mebibytes(r["memory"]["scene"] + r["memory"]["tree"]),), (mebibytes(shot.peak),), (len(on),),
                (sum(warning["count"] for warning in r["warnings"]) or "",))
    return table(["scene", ("triangles",), ("first sample, s",), ("in all, s",), ("Msamples/s",), ("error, %",),
                  ("scene and tree, MiB",), ("process, MiB",), ("effects",), ("warnings",)],
                 [line(i, shot) for i, shot in enumerate(shots)])


def facts(shot):
    r, memory = shot.report, shot.report["memory"]
    counts = [f"{r[name]:,} {name if r[name] != 1 else name[:-1]}"
              for name in ("triangles", "materials", "textures", "lamps", "lights") if r[name]]
    return (f"{r['width']} × {r['height']}, {r['samples_per_pixel']:g} samples a pixel; exposed by {round(r['stops'], 1) + 0.0:+.1f} stops. "
            f"{', '.join(counts)}. On the device: "
            f"{memory['triangle']:.0f} bytes a triangle, {mebibytes(4 * r['texels'])} MiB of texels, "
            f"{memory['path']:.0f} bytes a path in flight, {mebibytes(memory['paths'])} MiB of them.")


def article(i, shot):
    title = f"<article id=scene{i}><h2>{html.escape(shot.name)}</h2>"
    if not shot.shown():
        return f"{title}{paragraph(f'exit status {shot.status}: {shot.said}', 'wrong')}</article>"
    effects = shot.report["effects"]
    off = [effect["name"] for effect in effects if not effect["on"]]
    warnings = [(warning["text"], (warning["count"],)) for warning in shot.report["warnings"]]
    picture = base64.b64encode(shot.image).decode()
    return "".join([
        title, f"<div><img alt='{html.escape(shot.name, True)}' src='data:image/png;base64,{picture}'>",
        paragraph(facts(shot)), "</div><div>",
        table(["effect", "called for by", "switch"],
              [(effect["name"], effect["called_by"] or "asked for", f"{effect['switch']}=1")
               for effect in effects if effect["on"]]),
        paragraph(f"Off, and not in the program: {', '.join(off) or 'none'}."),
        table(["warning", ("times",)], warnings) if warnings else "",
        paragraph(shot.said, "wrong") if shot.said else "", "</div></article>"])


def page(shots, arguments):
    first = next((shot.report for shot in shots if shot.shown()), None)
    command = " ".join(["clvndf render SCENE", *arguments.options])
    context = f"{first['software']}; {first['device']}; " if first else ""
    return "\n".join([
        f"<!doctype html><html lang=en><meta charset=utf-8><title>clvndf: gallery</title><style>{STYLE}</style>",
        "<h1>Scenes, each by a program with only the effects that it calls for</h1>",
        f"<p class=small>{html.escape(context)}{time.strftime('%Y-%m-%d')}; <code>{html.escape(command)}</code>. First "
        "sample: seconds from the command until every pixel has one, kernels compiled (or found in the driver's cache) within. "
        "Error: estimated, root mean square over the mean. Process: the most memory that it held.</p>",
        summary(shots), *[article(i, shot) for i, shot in enumerate(shots)], "</html>\n"])


def parsed():
    own, options = sys.argv[1:], []
    if "--" in own:
        own, options = own[:own.index("--")], own[own.index("--") + 1:]
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("gallery"), help="folder of the page")
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD", help="scenes with any of these in their names")
    parser.add_argument("--clvndf", default=str(ROOT / "build/release/clvndf"), help="the command")
    arguments = parser.parse_args(own)
    arguments.options = ["--size", "480x360", *options] if "--size" not in options else options
    return arguments


def main():
    arguments = parsed()
    if not os.access(arguments.clvndf, os.X_OK):
        fail(f"no command {arguments.clvndf}: build it, or name it by --clvndf")
    scenes = sorted(path for path in arguments.folder.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file()
                    and any(word in path.name for word in arguments.only))
    if not scenes:
        fail(f"{arguments.folder}: no scene (.gltf, .glb) to show")
    arguments.out.mkdir(parents=True, exist_ok=True)
    shots = []
    for scene in scenes:
        shots.append(Shot(scene, arguments))
        print(f"{len(shots)}/{len(scenes)} {shots[-1].name}" + ("" if shots[-1].shown() else f": {shots[-1].said}"),
              file=sys.stderr)
    (arguments.out / "index.html").write_text(page(shots, arguments), "utf-8")
    print(arguments.out / "index.html")
    sys.exit(0 if all(shot.shown() for shot in shots) else 1)


if __name__ == "__main__":
    main()
