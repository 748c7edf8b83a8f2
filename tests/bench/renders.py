"""What the experiments on the gather share: scenes by name, renders that are kept and resumed, references, the peers' ruler."""
import dataclasses
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/scenes"))
import make_gather_scenes  # noqa: E402

SHARED = pathlib.Path(os.environ.get("RADFARM_SHARED", ROOT.parent / "shared")).resolve()
PEERS = SHARED / "peers"
RULER = PEERS / "error.py"
# Against references that are not ours the ruler leaves out pixels that see an emitter: above so much in any channel (docs/benchmarks.md).
EMITTER = {"cornell": 3, "office": 9}
REFERENCE_SEEDS = (1001, 1002)


def note(*words):
    print(*words, file=sys.stderr, flush=True)


@dataclasses.dataclass(frozen=True)
class BenchScene:
    name: str
    path: pathlib.Path
    request: dict  # what every render of it asks for: size, camera, which way is up
    references: tuple = ()  # two independent halves that are not ours; empty: path traced when asked for


def peer(name, size):
    folder = PEERS / name
    width, height = {"cornell": (256, 256), "office": (320, 180)}[name]
    # The references have one size, so that is the size, unless a smaller one is only to show that a script works.
    has_size = size is None
    references = tuple(folder / f"{name}_ref{half}.exr" for half in "AB") if has_size else ()
    return BenchScene(name, folder / f"{name}.gltf", sized(size or (width, height)), references)


def sized(size):
    return {"width": size[0], "height": size[1]}


def placed(name, size):
    """A scene of tests/scenes/cameras.json."""
    camera = json.loads((ROOT / "tests/scenes/cameras.json").read_text())["cameras"][name]
    request = sized(size or (320, round(320 * camera["size"][1] / camera["size"][0])))
    if "up" in camera:
        request["up"] = camera["up"]
    if "eye" in camera:
        request["camera"] = {key: camera[key] for key in ("eye", "look_at", "up_vector", "vertical_fov_degrees")}
    return BenchScene(name, (ROOT / camera["scene"] if not camera["scene"].startswith("../shared/")
                             else SHARED / camera["scene"].removeprefix("../shared/")), request)


def scene_named(name, work, size=None):
    """None, and a note, where its file is missing. plant=N, hall=N and shadow are made in `work`."""
    if name.split("=")[0] in make_gather_scenes.MAKERS:
        path = make_gather_scenes.make(name, work)
        return BenchScene(path.stem, path, sized(size or (320, 180)))
    scene = peer(name, size) if name in ("cornell", "office") else placed(name, size)
    if scene.path.exists():
        return scene
    note(f"{name}: {scene.path} is not there, skipped")
    return None


def ruler(image, scene, references):
    """Relative RMSE of reflected light, its 95 % interval and the ratio of means by the peers' error.py; None without references."""
    if not references:
        return None
    command = ["/usr/bin/python3", ROOT / "tests/bench/reflected_error.py", PEERS, image, *references]
    run = subprocess.run(command + ([str(EMITTER[scene.name])] if scene.references else []), capture_output=True, text=True)
    if run.returncode == 0:
        return json.loads(run.stdout)
    note(f"ruler: {(run.stderr.strip().splitlines() or ['no answer'])[-1]}")
    return None


def run_child(command, limit, env=None, cwd=None):
    """CPU seconds of a child and of its children, user and system; None, and a note, when it fails or takes longer than `limit`."""
    with tempfile.TemporaryFile("w+") as log:
        child = subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT, env=env, cwd=cwd)
        timer = threading.Timer(limit, child.kill)
        timer.start()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        timer.cancel()
        if child.returncode == 0:
            return usage.ru_utime + usage.ru_stime
        log.seek(0)
        note(f"{pathlib.Path(command[0]).name}: exit code {child.returncode}: {(log.read().strip().splitlines() or ['no output'])[-1]}")
        return None


class Renders:
    """Renders in one process, each of which becomes a row. Finished rows stand in WORK/rows.jsonl and are not rendered again by the
    same program."""

    def __init__(self, build, work, threads=2, limit=7200, reference_samples=0, references=None):
        self.program, self.work = pathlib.Path(build).resolve() / "bin/render_in_process", pathlib.Path(work)
        self.threads, self.limit, self.reference_samples = threads, limit, reference_samples
        self.references = pathlib.Path(references or self.work / "references")
        self.work.mkdir(parents=True, exist_ok=True)
        self.file = self.work / "rows.jsonl"
        self.build = hashlib.sha256(self.program.read_bytes()).hexdigest()[:12]
        text = self.file.read_text() if self.file.exists() else ""
        self.is_cut = bool(text) and not text.endswith("\n")  # a run was killed while it wrote
        lines = [line for line in text.splitlines() if line.endswith("}}")]
        self.rows = {json.dumps(line["key"], sort_keys=True): line["row"] for line in map(json.loads, lines)}

    def kept(self, key, make):
        """The row of `key`, made by `make()` unless it is known. A failure (None) is not kept."""
        text = json.dumps(key, sort_keys=True)
        if text not in self.rows:
            note("...", key["scene"], json.dumps(key["request"]))
            row = make()
            if row is None:
                return None
            with self.file.open("a") as file:
                file.write("\n" * self.is_cut + json.dumps({"key": key, "row": row}) + "\n")
            self.is_cut = False
            self.rows[text] = row
        return self.rows[text]

    def run(self, scene, request, image):
        """The report, with `cpu`: seconds a stage and in all, the audit left out."""
        env = os.environ | {"RADFARM_THREADS": str(self.threads)}
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder, "report.json")
            command = [self.program, scene.path, image, json.dumps(scene.request | request), report]
            used = run_child(command, self.limit, env)
            if used is None:
                return None
            result = json.loads(report.read_text())
        stages = {stage["name"]: stage["cpu_s"] for stage in result["stages"]}
        result["cpu"] = stages | {"all": used - stages.get("audit", 0)}
        return result

    def references_of(self, scene):
        """Two images that are independent of each other and of every render: the scene's own, or path traced once and kept."""
        if scene.references:
            return scene.references
        if not self.reference_samples or not RULER.exists():
            return ()
        self.references.mkdir(parents=True, exist_ok=True)
        size = f"{scene.request['width']}x{scene.request['height']}"
        paths = [self.references / f"{scene.name}-{size}-{self.reference_samples}-{half}.exr" for half in "AB"]
        for path, seed in zip(paths, REFERENCE_SEEDS):
            if path.exists():
                continue
            note("... reference", path.name)
            unfinished = path.with_suffix(".unfinished.exr")
            request = {"integrator": "path-trace", "samples": self.reference_samples, "seed": seed, "audit": False}
            if self.run(scene, request, unfinished) is None:
                return ()
            unfinished.rename(path)
        return tuple(paths)

    def row(self, scene, request):
        """Counts, CPU seconds, audited error and the error by the ruler of one render; None where it fails."""
        references = self.references_of(scene)

        def make():
            with tempfile.TemporaryDirectory() as folder:
                image = pathlib.Path(folder, "image.exr")
                report = self.run(scene, request, image)
                if report is None:
                    return None
                accuracy = report["accuracy"]
                return {"cpu": report["cpu"], "counts": report["counts"], "triangles": report["scene"]["triangles"],
                        "memory": report["peak_memory_bytes"], "ruler": ruler(image, scene, references),
                        "audited": {"error": accuracy["relative_rmse"], "ci95": accuracy["relative_rmse_ci95"]}}

        names = [path.name for path in references]
        return self.kept({"scene": scene.name, "request": scene.request | request, "references": names, "build": self.build}, make)


def percent(measured):
    """'2.7 % (2.5..2.9)' of an error with its interval; '< 2.9 %' where only the upper end is known."""
    if not measured or not measured["ci95"]:
        return "-"
    low, high = (f"{100 * x:.3g}" for x in measured["ci95"])
    return f"< {high} %" if measured["error"] is None else f"{100 * measured['error']:.3g} % ({low}..{high})"


def add_arguments(parser, work):
    """The flags that all of these scripts have."""
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build" / work, help="made scenes and finished rows are kept there")
    parser.add_argument("--references", type=pathlib.Path, help="folder of path traced references; default: WORK/references")
    parser.add_argument("--reference-samples", type=int, default=512, help="of each half; 0: no references, audited error only")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), help="WxH, instead of each scene's own")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--limit", type=float, default=7200, help="seconds after which a render is given up")


def renders_of(arguments):
    return Renders(arguments.build, arguments.work, arguments.threads, arguments.limit, arguments.reference_samples,
                   arguments.references)
