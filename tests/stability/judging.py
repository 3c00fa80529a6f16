"""What is held against what: exact answers, twins, Laplace's estimate, ordinary scenes, and the counts of the whole."""
import math
import re
from dataclasses import dataclass

import laplace
import running

SAME_PRESSURE, SAME_ITERATIONS = 1e-6, 2   # of a scene in other units, turned, mirrored or shifted
LAPLACE_BAND = (0.85, 1.15)                # outside: to be looked at; no failure, because it is an estimate
NAMED = re.compile(r"equilibrium|friction|hold|held|slid|slip|gather|loose", re.IGNORECASE)  # the cause, in whatever words
HELD_BY = re.compile(r"held by a coefficient of ([0-9.]+)")
KEYS = ("mean_contact_pressure_Pa", "mean_skin_radial_displacement_m")


@dataclass
class Row:
    scene: object
    outcome: running.Outcome
    verdict: str = ""
    good: bool = False
    wrong: bool = False            # converged to what is not so
    error: float | None = None     # against the exact answer or the twin
    laplace: float | None = None
    over: float | None = None      # time over the ordinary scene, by unknown

    @property
    def expects_convergence(self):
        return self.scene.right == "converged"


def exact_error(exact, numbers):
    """Signed error; None where the run has no such number."""
    ours = numbers.get(exact.key)
    if ours is None or ours != ours:
        return None
    value = exact.value()
    return (ours - value) / exact.scale if exact.scale else ours / value - 1


def twin_error(outcome, twin):
    key = next((k for k in KEYS if twin.numbers.get(k)), None)
    return outcome.numbers.get(key, math.nan) / twin.numbers[key] - 1 if key else None


def judge(scene, outcome, outcomes, start, work):
    """`outcomes`: of all scenes by name; `start`: seconds of a run that solves nothing."""
    row = Row(scene, outcome)
    base = outcomes.get(scene.base)
    if base and base.unknowns and scene.base != scene.name:
        share = (outcome.unknowns or base.unknowns) / base.unknowns
        row.over = max(outcome.seconds - start, 0.05) / max(base.seconds - start, 0.05) / share
    if not outcome.returned:
        row.verdict = f"NO STATE: {outcome.status}"
    elif scene.right == "slides":
        judge_slide(row)
    elif not outcome.converged:
        row.verdict = "not converged"
    else:
        judge_converged(row, outcomes.get(scene.same_as), work)
    return row


def judge_slide(row):
    """There is no equilibrium (near the placed garment): the run fails and says why, or warns of what it found."""
    outcome = row.outcome
    told = NAMED.search(" ".join([outcome.message, *outcome.warnings, *map(str, outcome.summary.get("warnings", []))]))
    held = HELD_BY.search(outcome.message)
    if row.scene.least_friction:
        told = held and abs(float(held[1]) / row.scene.least_friction - 1) <= 0.1
    row.good = bool(told)
    row.wrong = outcome.converged and not told
    row.verdict = "said so" if told else "WRONG: converged where nothing holds the garment" if row.wrong else "failed without saying why"


def judge_converged(row, twin, work):
    scene, outcome = row.scene, row.outcome
    if scene.sleeve:
        row.laplace = laplace.ratio(running.folder_of(scene.name, work) / "out" / "skin.csv", scene.sleeve)
    row.good, row.verdict = True, "converged"
    if scene.exact:
        row.error = exact_error(scene.exact, outcome.numbers)
        off = row.error is None or abs(row.error) > scene.exact.tolerance
        told = off and "gathered cloth" in outcome.named_warnings  # the only warning that says: this is not the placed state
        row.wrong, row.good = off and not told, not off
        row.verdict = "off, and warned of gathered cloth" if told else f"WRONG: off by more than {scene.exact.tolerance:g}" if off else "exact"
    elif scene.same_as:
        judge_twin(row, twin)
    elif row.laplace is not None:
        low, high = LAPLACE_BAND
        row.verdict = "plausible" if low <= row.laplace <= high else "look at: far from Laplace"


def judge_twin(row, twin):
    if not twin or not twin.converged:
        row.verdict = "converged; its twin did not"
        return
    row.error = twin_error(row.outcome, twin)
    apart = abs(row.outcome.iterations - twin.iterations)
    same = row.error is not None and abs(row.error) <= SAME_PRESSURE
    row.good = same and apart <= SAME_ITERATIONS
    apart_by = ([] if same else ["other pressure"]) + ([f"{apart} iterations apart"] if apart > SAME_ITERATIONS else [])
    row.verdict = "same" if row.good else "DIFFERS: " + " and ".join(apart_by)


@dataclass
class Count:
    name: str
    value: str
    target: str
    met: bool


def counts(rows, start):
    """What the design promises of the whole catalogue."""
    solvable = [r for r in rows if r.expects_convergence]
    converged = [r for r in solvable if r.outcome.converged]
    returned = [r for r in rows if r.outcome.returned]
    wrong = [r for r in rows if r.wrong]
    failing = [r for r in solvable if not r.outcome.converged and r.over]
    slow = [r for r in failing if r.over > 5]
    ratios = [(r.outcome.seconds - start) / r.outcome.forecast for r in rows if r.outcome.forecast > 0]
    within = [x for x in ratios if 0.5 <= x <= 2]
    twins = [r for r in rows if r.scene.same_as]
    same = [r for r in twins if r.verdict == "same"]
    exact = [r for r in rows if r.scene.exact]
    met = [r for r in exact if r.verdict == "exact"]
    share = lambda part, whole: f"{len(part)} of {len(whole)}" + (f" ({100 * len(part) / len(whole):.1f} %)" if whole else "")
    return [
        Count("converged, of the scenes that have an equilibrium", share(converged, solvable), "95 %", len(converged) >= 0.95 * len(solvable)),
        Count("a state returned and named for what it is", share(returned, rows), "100 %", len(returned) == len(rows)),
        Count("converged to what is wrong", str(len(wrong)), "0", not wrong),
        Count("exact answers met", share(met, exact), "all", len(met) == len(exact)),
        Count("failing scenes over 5 times their ordinary scene's time", share(slow, failing), "0", not slow),
        Count("time within a factor of 2 of the forecast", share(within, ratios), "90 %", len(within) >= 0.9 * len(ratios)),
        Count("same in other units and places (pressure 1e-6, iterations 2)", share(same, twins), "all", len(same) == len(twins)),
    ]
