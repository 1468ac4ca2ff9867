"""The JSON of clvndf bench keeps its schema, and the report draws every figure from it. Nothing here depends on time.

    bench_report_test.py SOURCE_FOLDER [CLVNDF]     CLVNDF: the command, to look at what it writes as well
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
    import matplotlib  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing} (python3-jsonschema, python3-matplotlib)")
    sys.exit(77)

source = pathlib.Path(sys.argv[1])
schema = json.loads((source / "bench/report/schema.json").read_text())
sample = source / "bench/results/pocl-3.1.json"


def valid(data):
    try:
        jsonschema.validate(data, schema)
        return True
    except jsonschema.ValidationError:
        return False


def figures(page):
    return re.findall(r"<svg.*?</svg>", page, re.S)


def check_schema():
    data = json.loads(sample.read_text())
    jsonschema.validate(data, schema)
    check_lobes(data)
    # The schema can fail.
    for spoil in (lambda d: d["context"].pop("device"),
                  lambda d: d["benchmarks"].clear(),
                  lambda d: d["benchmarks"][0].update(run_name="vndf_x/fast/float/stream"),
                  lambda d: [b.pop("err_p99", None) for b in d["benchmarks"]],
                  lambda d: [b.pop("angle_p9999", None) for b in d["benchmarks"]],
                  lambda d: [b.update(price=None) for b in d["benchmarks"]],
                  lambda d: [b.pop("price", None) for b in d["benchmarks"]],
                  lambda d: d.pop("spread"),
                  lambda d: d["builds"].pop(),
                  lambda d: [b.pop("fraction_of_copy", None) for b in d["benchmarks"]],
                  lambda d: d["lobes"][0].update(rejected=1.5),
                  lambda d: d["caps"]["rows"][0].pop("both")):
        spoilt = copy.deepcopy(data)
        spoil(spoilt)
        assert not valid(spoilt), "a spoilt file passes"


def check_lobes(data):
    """The samplers of a lobe estimate the same integral; what is not lost is not noise."""
    samples, cap, bounded, conic = 2 ** 16, "vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wi_eto2023", \
        "vndf_ggx_sample_wi_conic2026"
    lobes = {}
    for lobe in data["lobes"]:
        lobes.setdefault((lobe["alpha_x"], lobe["alpha_y"], lobe["cos_theta"]), {})[lobe["sampler"]] = lobe
    stratified = []
    for key, samplers in lobes.items():
        assert len(samplers) == 7, key
        lost = samplers[bounded]["rejected"]
        assert samplers[conic]["rejected"] == 0, key
        assert samplers[bounded + "_polygon"]["rejected"] <= lost <= samplers[cap]["rejected"], key
        for tries in (2, 4):
            w = lost ** tries
            assert abs(samplers[f"{bounded}/tries{tries}"]["rejected"] - w) <= 12 * (w / samples) ** 0.5 + 2e-4, key
        for name, lobe in samplers.items():
            # Six standard errors of both, and the rounding of the committed figures. A fat tail hides from a plain
            # NDF's samples at grazing angles.
            if name == "vndf_ggx_sample_wm_walter2007" and key[2] < 0.4:
                continue
            for light in ("", "smooth_"):
                mean, variance = f"{light}mean", f"{light}variance"
                tolerance = 6 * ((lobe[variance] + samplers[cap][variance]) / samples) ** 0.5 + 1e-4
                assert abs(lobe[mean] - samplers[cap][mean]) <= tolerance, (key, name, light, lobe, samplers[cap])
            # Among visible normals the second moment times the part kept is that of the conic, whose weights are <= 1.
            if "walter" not in name:
                square = lobe["variance"] + lobe["mean"] ** 2
                wanted = samplers[conic]["variance"] + samplers[conic]["mean"] ** 2
                assert abs(square * (1 - lobe["rejected"]) - wanted) <= 8 * (2 * square / samples) ** 0.5 + 1e-3, (key, name)
        for light in ("", "smooth_"):
            stratified.append(samplers[conic][f"{light}sobol_rmse"] / (samplers[conic][f"{light}variance"] / 1024) ** 0.5)
    # Sobol's points: better than random ones on every lobe for the sampler without hit and miss, and far better on most.
    assert max(stratified) < 0.9 and sorted(stratified)[len(stratified) // 2] < 0.2, stratified


def check_report():
    with tempfile.TemporaryDirectory() as folder:
        for inputs in ([sample], [sample, sample]):
            page = pathlib.Path(folder) / "index.html"
            subprocess.run([sys.executable, source / "bench/report/report.py", page, *inputs], check=True)
            text = page.read_text()
            drawn = figures(text)
            plots = len(re.findall(r"^    \(\"", (source / "bench/report/report.py").read_text(), re.M))
            assert plots >= 5 and len(drawn) == plots, f"{len(drawn)} figures of {plots}"
            for i, figure in enumerate(drawn):
                marks = len(re.findall(r'<g id="patch_|<g id="line2d_', figure))
                assert marks > 10 and "nan" not in figure, f"figure {i} is empty"
            assert not re.search(r'(src|href)="(https?:)?//', text), "the page loads something"
            assert "not measured" not in text


def check_command(clvndf):
    run = subprocess.run([clvndf, "--quiet", "bench", "--only", "sample_wi_eto2023/strict/float", "--repetitions", "3",
                          "--json", "-"], check=True, stdout=subprocess.PIPE)
    data = json.loads(run.stdout)
    jsonschema.validate(data, schema)
    check_lobes(data)
    names = {b["run_name"] for b in data["benchmarks"]}
    for mode in ("stream", "compute", "cached"):
        assert f"vndf_ggx_sample_wi_eto2023/strict/float/{mode}" in names, names


def check_committed():
    """The committed run has every rung; ratios are those of its times; what it says of itself holds."""
    data = json.loads(sample.read_text())
    best = {b["run_name"]: b for b in data["benchmarks"] if b["aggregate_name"] == "best"}
    cap = "vndf_ggx_sample_wm_dupuy2023"
    for rung in ("strict", "lean", "factored", "published", "builtin", "native"):
        for mode in ("stream", "compute", "cached", "cached_front"):
            assert f"{cap}/{rung}/float/{mode}" in best, (rung, mode)
    for rung in ("aos_vload3", "aos_float4", "aos_struct", "aos_stride", "aos_one"):
        assert len([n for n in best if f"/{rung}/float/cached" in n]) == 3, rung
    for rung in ("luxcore", "fluctus", "cycles", "hydracore"):
        assert len([n for n in best if f"/{rung}/float/cached" in n]) >= 14, rung
    assert f"{cap}/readme/float/stream" in best
    for rung in ("strict", "evenly", "both"):
        assert f"vndf_ggx_sample_wi_cone2026_with_pdf/{rung}/float/compute" in best, rung
    assert data["caps"] == json.loads((source / "bench/results/caps.json").read_text())
    lean = [n for n in best if "/lean/" in n and n.endswith("/cached")]
    assert len(lean) == 7, lean
    pairs = {}
    for name, entry in best.items():
        function, rung, real, mode = name.split("/") if name.count("/") == 3 else (None,) * 4
        if function and f"{function}/lean/float/{mode}" in best:
            wanted = entry["ns_per_sample"] / best[f"{function}/lean/float/{mode}"]["ns_per_sample"]
            assert abs(entry["price"] / wanted - 1) < 2e-3, name
        elif function:
            assert entry["price"] is None, name
        if function and rung.startswith("strict_again"):
            ratio = entry["ns_per_sample"] / best[f"{function}/strict/{real}/{mode}"]["ns_per_sample"]
            pairs[mode] = max(pairs.get(mode, 0), ratio - 1, 1 / ratio - 1)
    assert pairs and all(abs(data["spread"][mode] - pairs[mode]) < 2e-3 for mode in pairs), (pairs, data["spread"])


check_schema()
check_committed()
check_report()
if len(sys.argv) > 2:
    check_command(sys.argv[2])
