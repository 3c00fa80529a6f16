"""docs/stability.md from the rows."""
import running

HEAD = ("| scene | stresses | status | inc. | it. | on the way | s | over ordinary | error or Laplace | verdict |\n"
        "| --- | --- | --- | ---: | ---: | --- | ---: | ---: | ---: | --- |")


def figure(row):
    if row.error is not None:
        return f"{row.error:+.1e}"
    return f"L {row.laplace:.3f}" if row.laplace is not None else ""


def line(row):
    outcome = row.outcome
    way = [w for w in (running.ladder(outcome), ", ".join(f"warns: {name}" for name in outcome.named_warnings)) if w]
    cells = [row.scene.name, row.scene.stresses, outcome.status, outcome.summary.get("increments", ""), outcome.iterations or "",
             "; ".join(way), f"{outcome.seconds:.1f}", f"{row.over:.1f}" if row.over else "", figure(row), row.verdict]
    return "| " + " | ".join(str(c).replace("|", "/") for c in cells) + " |"


def trouble(row):
    """A line on a scene that is not right: where it stood and what was said."""
    outcome = row.outcome
    return (f"- **{row.scene.name}** ({row.scene.stresses}): {row.verdict}; {outcome.iterations} iterations, {outcome.seconds:.1f} s"
            + (f", {figure(row)}" if figure(row) else "") + (f". {outcome.message}" if outcome.message else ""))


def page(rows, counts, stamp):
    """`stamp`: when, of what source and where it was written."""
    text = ["# Stability catalogue", "", f"Written by `scripts/stability` {stamp}.", "",
            f"{len(rows)} scenes, stiff and extreme ones among them, each solved as it stands: no scene has a tuned number.",
            "`tests/stability` holds them as data; `scripts/stability --only NAME` runs one again.", "",
            "| of the whole | found | target | |", "| --- | ---: | ---: | --- |"]
    text += [f"| {c.name} | {c.value} | {c.target} | {'met' if c.met else '**missed**'} |" for c in counts]
    wrong = [r for r in rows if r.wrong]
    bad = [r for r in rows if not r.good and not r.wrong]
    if wrong:
        text += ["", "## FAIL: converged to what is wrong", "", *map(trouble, wrong)]
    if bad:
        text += ["", "## Not right", "", *map(trouble, bad)]
    text += ["", "## All scenes", "",
             "*s*: seconds of the processor, starting included. *over ordinary*: time over that of the ordinary scene of the same kind, by",
             "unknown. *error*: against the exact answer, or against the twin in other units or places. *L*: pressure over Laplace's",
             "estimate (tension over radius, by the girths of the deformed skin), an estimate and no bound. *on the way*: increments",
             "begun anew, events of `history.csv`, and what the run warns of. *said so*: no equilibrium exists, and the run names what is missing."]
    for group in dict.fromkeys(r.scene.group for r in rows):
        text += ["", f"### {group}", "", HEAD, *(line(r) for r in rows if r.scene.group == group)]
    return "\n".join(text) + "\n"
