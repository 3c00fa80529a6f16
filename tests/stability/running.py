"""Runs a scene with the built program and reads what it said: summary.json, history.csv, listings, forecast, time."""
import csv
import hashlib
import json
import math
import os
import re
import resource
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from case_files import write_case

WARNING = re.compile(r"warning", re.IGNORECASE)


@dataclass
class Outcome:
    """What a run left. `status`: of summary.json, or "refused" (exit 2), "time out", "crashed"."""
    status: str
    exit: int
    seconds: float                 # of the processor, over all its threads
    summary: dict = field(default_factory=dict)
    history: list = field(default_factory=list)
    forecast: float = math.nan     # s, as printed by the plan
    message: str = ""
    warnings: list = field(default_factory=list)
    numbers: dict = field(default_factory=dict)

    @property
    def converged(self):
        return self.status == "converged"

    @property
    def returned(self):
        """A state that the program stands for: what it found and how far it is."""
        return self.status in ("converged", "partial", "failed") and self.exit in (0, 3)

    @property
    def iterations(self):
        return self.summary.get("iterations", 0)

    @property
    def named_warnings(self):
        """Of summary.json: what was measured on the answer and lies outside its limit."""
        return [w["name"] for w in self.summary.get("warnings", []) if isinstance(w, dict)]

    @property
    def unknowns(self):
        return self.summary.get("unknowns", {}).get("total", 0)


def folder_of(name, work):
    return work / re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-")


def run(scene, program, work, limit, command="run"):
    """Writes the case of the scene into `work` and runs it, at most `limit` seconds of processor time; "check": plans it."""
    folder = folder_of(scene.name, work)
    write_case(folder, scene.name, scene.case, scene.files, scene.system)
    stamp = stamp_of(program, folder, scene)
    if command == "run":
        if earlier := earlier_run(folder, stamp):
            return read(folder, earlier["exit"], (folder / "printed").read_text(), earlier["seconds"])
        shutil.rmtree(folder / "out", ignore_errors=True)
    words = [str(program), command, str(folder), *(["--no-report", "--out", str(folder / "out")] if command == "run" else [])]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                               env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "SNUG_RECORD": "off"},
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 5)))
    text = process.stdout.read()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = used.ru_utime + used.ru_stime
    if command == "run":
        (folder / "printed").write_text(text)
        (folder / "ran.json").write_text(json.dumps({"stamp": stamp, "exit": process.returncode, "seconds": seconds}))
    return read(folder, process.returncode, text, seconds)


def stamp_of(program, folder, scene):
    """Of the program and of all files of the case: a kept run is taken over only where both are the same."""
    digest = hashlib.sha256(Path(program).read_bytes())
    for name in ["case.toml", *sorted(scene.files)]:
        digest.update((folder / name).read_bytes())
    return digest.hexdigest()


def earlier_run(folder, stamp):
    """The kept run of the same stamp, unless it was ended before its end; None where there is none."""
    kept = folder / "ran.json"
    found = json.loads(kept.read_text()) if kept.is_file() else None
    return found if found and found["stamp"] == stamp and found["exit"] >= 0 else None


def read(folder, code, text, seconds):
    """The outcome of a finished run."""
    warnings = [line.strip() for line in text.splitlines() if WARNING.search(line)]
    errors = [line.strip() for line in text.splitlines() if "error" in line.lower() or "fault" in line.lower()]
    outcome = Outcome("crashed", code, seconds, forecast=forecast_in(text), warnings=warnings, message=errors[-1] if errors else "")
    if code < 0 or code > 128:
        outcome.status = "time out" if code in (-24, 152, -9, 137) else "crashed"
        outcome.message = last_step(text)
        return outcome
    if code == 2:
        outcome.status = "refused"
        return outcome
    summary = folder / "out" / "summary.json"
    if not summary.is_file():
        return outcome
    outcome.summary = json.loads(summary.read_text())
    outcome.status = outcome.summary["status"]
    outcome.message = outcome.summary.get("message", "")
    history = folder / "out" / "history.csv"
    outcome.history = list(csv.DictReader(history.read_text().splitlines())) if history.is_file() else []
    outcome.numbers = dict(outcome.summary.get("numbers", {}))
    stretch = stretch_along_z(folder / "out")
    if stretch:
        outcome.numbers["stretch_along_z"] = stretch
    return outcome


def last_step(text):
    """Where a run that was ended stood."""
    steps = [line for line in re.split(r"[\r\n]+", text) if "Newton" in line or "increment" in line]
    return " ".join(steps[-1].split()) if steps else ""


def forecast_in(text):
    """Seconds of "time expected 12 s", "1.5 min", "2 h 10 min" ..."""
    line = re.search(r"time expected (.*)", text)
    if not line:
        return math.nan
    unit = {"h": 3600.0, "min": 60.0, "s": 1.0, "ms": 1e-3}
    parts = re.findall(r"([0-9.]+) (h|min|ms|s)\b", line[1])
    return sum(float(number) * unit[u] for number, u in parts) if parts else math.nan


def listing(path):
    """Rows (node, x, y, z) of a nodal listing."""
    rows = {}
    for line in path.read_text().splitlines():
        parts = line.split()
        if len(parts) >= 4 and parts[0].isdigit():
            rows[int(parts[0])] = [float(p) for p in parts[1:4]]
    return rows


def stretch_along_z(out):
    """Extent of the deformed body over that of the undeformed one."""
    places, moves = out / "nodes.lis", out / "displacement.lis"
    if not (places.is_file() and moves.is_file()):
        return None
    places, moves = listing(places), listing(moves)
    undeformed = [p[2] for p in places.values()]
    deformed = [p[2] + moves[n][2] for n, p in places.items() if n in moves]
    height = max(undeformed) - min(undeformed) if undeformed else 0.0
    return (max(deformed) - min(deformed)) / height if height and deformed else None


def ladder(outcome):
    """What the solver did on the way: increments thrown away (a row of the history that begins an increment anew), events
    with their counts, and the stages."""
    begins = {}
    events = {}
    for row in outcome.history:
        if row.get("iteration") == "0":
            begins[row["increment"]] = begins.get(row["increment"], 0) + 1
        event = (row.get("event") or "").strip()
        if event and event != "lagged":
            events[event] = events.get(event, 0) + 1
    again = sum(count - 1 for count in begins.values())
    told = [f"{again} attempts failed"] if again else []
    told += [f"{count} x {event}" if count > 1 else event for event, count in events.items()]
    return "; ".join(told)


def stages(outcome):
    """Names of the phases that solved."""
    other = {"reading", "meshing", "law of Laplace", "set-up", "results"}
    return [phase["name"] for phase in outcome.summary.get("phases", []) if phase["name"] not in other]
