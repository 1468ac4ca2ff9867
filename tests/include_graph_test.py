#!/usr/bin/env python3
"""The include graph of kernels, host and bench has no circle, between files or between folders, and no arrow points up; and no
header of ours stands before a library's that somebody includes.

    python3 tests/include_graph_test.py           exit status 1 with each circle and each arrow that points up
    python3 tests/include_graph_test.py --dot     the graph of the folders, for graphviz
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# From the ground up: a folder, or a file of its own rank, includes itself and those before it.
LAYERS = ["kernels/vndf/config.h", "kernels/vndf/impl", "kernels/vndf", "kernels", "kernels/batch", "kernels/render", "host/reference", "host", "host/runtime",
          "host/conformance/inputs", "host/conformance/judge", "host/conformance/report", "host/conformance/runs", "host/emit", "host/energy", "host/python", "host/render", "host/gltf",
          "bench/effects", "bench/lean", "bench/published", "bench", "bench/peers", "host/cli", "host/examples"]
# The reference shares nothing with the kernels.
APART = [("host/reference", "kernels")]


def sources():
    found = (path for folder in ("kernels", "host", "bench") for path in (ROOT / folder).rglob("*"))
    return {str(path.relative_to(ROOT)) for path in found if path.suffix in (".h", ".cpp", ".cl", ".def")}


def graph():
    """For each file, the files that it includes."""
    files = sources()
    edges = {}
    for name in files:
        edges[name] = set()
        for target in re.findall(r'^\s*#\s*include\s*"([^"]+)"', (ROOT / name).read_text("utf-8"), re.M):
            beside = pathlib.Path(ROOT / name).parent / target
            for candidate in (beside, ROOT / "host" / target, ROOT / target, ROOT / "kernels" / target):
                path = candidate.resolve()
                if path.is_relative_to(ROOT) and path.relative_to(ROOT).as_posix() in files:
                    edges[name].add(path.relative_to(ROOT).as_posix())
                    break
    return edges


def hidden():
    """Each include of a library's header that finds one of host in its place, since that folder is searched first."""
    for name in sorted(sources()):
        for target in re.findall(r"^\s*#\s*include\s*<([^>]+)>", (ROOT / name).read_text("utf-8"), re.M):
            if (ROOT / "host" / target).exists():
                yield f"{name}: <{target}> is host/{target} there"


def circle(edges):
    """A circle, as a list of nodes, or None."""
    done, open_ = set(), []

    def visit(node):
        if node in open_:
            return open_[open_.index(node):] + [node]
        if node in done:
            return None
        open_.append(node)
        for target in sorted(edges.get(node, ())):
            if found := visit(target):
                return found
        open_.pop()
        done.add(node)
        return None

    for node in sorted(edges):
        if found := visit(node):
            return found
    return None


def layer(name):
    return name if name in LAYERS else name.rpartition("/")[0]


def main():
    files = graph()
    folders = {}
    for name, targets in files.items():
        folders.setdefault(layer(name), set()).update(layer(t) for t in targets if layer(t) != layer(name))
    if sys.argv[1:] == ["--dot"]:
        print("digraph {", *(f'  "{a}" -> "{b}"' for a in sorted(folders) for b in sorted(folders[a])), "}", sep="\n")
        return
    problems = list(hidden())
    if len(files) < 100 or sum(map(len, files.values())) < 200:
        problems.append("too few files or arrows to believe it")
    for what, edges in (("files", files), ("folders", folders)):
        if found := circle(edges):
            problems.append(f"a circle of {what}: {' -> '.join(found)}")
    for name, targets in sorted(files.items()):
        for target in sorted(targets):
            a, b = layer(name), layer(target)
            unknown = [f for f in (a, b) if f not in LAYERS]
            if unknown:
                problems.append(f"{name}: the folder {unknown[0]} has no layer")
            elif LAYERS.index(b) > LAYERS.index(a):
                problems.append(f"{name} includes {target}, which is above it")
            elif any(a.startswith(one) and b.startswith(other) for one, other in APART):
                problems.append(f"{name} includes {target}: they share nothing")
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
