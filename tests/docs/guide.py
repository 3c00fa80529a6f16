#!/usr/bin/env python3
"""docs/guide.md does what it says: its files are written and its commands run, in the order in which they stand there.

usage: guide.py PROGRAM SOURCE_DIR

A fence ```console holds commands, lines that begin with "$ ", run by a shell in a scratch folder where the program is `snug`. "# exit N" at the end of a
command is the exit status that it must have, else 0. The lines below a command must occur in its output: runs of blanks count as one, "…" stands for
anything in a line, numbers may be others; but two decimals in a line that says mmHg are a pressure and agree within a twentieth, and classes ("CCL 1") are words.
A fence ```LANGUAGE FILE is written to FILE, ```LANGUAGE append=FILE is put at its end. Other fences are left alone.
"""
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NUMBER = re.compile(r"(?<!CCL )(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w])")
PRESSURE = re.compile(r"(?<![\w.])\d+\.\d\d(?!\d)")
PRESSURE_WITHIN = 0.05


def blocks(text):
    """(number of the first line, words of the fence, lines) of every fenced block."""
    found, words, body = [], None, []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("```"):
            body.append(line)
        elif words is None:
            words, body, start = line[3:].split(), [], number + 1
        else:
            found.append((start, words, body))
            words, body = None, []
    if words is not None:
        raise SystemExit(f"docs/guide.md:{start - 1}: the fence does not end")
    return found


def commands(start, lines):
    """(number of the line, command, exit status, expected lines) of a console block."""
    found = []
    for number, line in enumerate(lines, start):
        if line.startswith("$ "):
            command, _, status = line[2:].partition("# exit ")
            found.append((number, command.strip(), int(status or 0), []))
        elif line.strip() and not found:
            raise SystemExit(f"docs/guide.md:{number}: output without a command before it")
        elif line.strip() and not line.startswith("…"):
            found[-1][3].append((number, line))
    return found


def masked(line):
    return " ".join(NUMBER.sub("#", line).split())


def says(line, expected):
    """Whether a line of output is the expected one."""
    pattern = ".*".join(re.escape(masked(part)) for part in expected.split("…"))
    if not re.search(pattern, masked(line)):
        return False
    if "mmHg" not in expected:
        return True
    pairs = zip(PRESSURE.findall(expected), PRESSURE.findall(line))
    return all(abs(float(printed) - float(new)) <= PRESSURE_WITHIN * float(printed) for printed, new in pairs)


def run(command, folder, environment):
    return subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL)


def fail(number, command, why, output=""):
    print(f"docs/guide.md:{number}: $ {command}\n  {why}\n{output}", file=sys.stderr)
    return 1


def main():
    program, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    ran = 0
    with tempfile.TemporaryDirectory(prefix="snug-guide-") as scratch:
        folder, aside = Path(scratch) / "work", Path(scratch) / "aside"
        (aside / "bin").mkdir(parents=True)
        folder.mkdir()
        wrapper = aside / "bin" / "snug"  # not a link: the program finds its cases by its own place
        wrapper.write_text(f'#!/bin/sh\nexec "{program}" "$@"\n')
        wrapper.chmod(0o755)
        environment = dict(os.environ, PATH=f"{aside / 'bin'}:{os.environ['PATH']}", SNUG_RECORD="off", SNUG_LIBRARY=str(aside / "library.db"), COLUMNS="400")
        for start, words, lines in blocks((source / "docs" / "guide.md").read_text(encoding="utf-8")):
            if words[:1] == ["console"]:
                for number, command, status, expected in commands(start, lines):
                    began = time.monotonic()
                    done = run(command, folder, environment)
                    print(f"{time.monotonic() - began:6.1f} s  {command}", flush=True)
                    ran += 1
                    if done.returncode != status:
                        return fail(number, command, f"exit status {done.returncode}, where the guide has {status}", done.stdout)
                    for place, line in expected:
                        if not any(says(output, line) for output in done.stdout.splitlines()):
                            return fail(place, command, f"does not print: {line}", done.stdout)
            elif len(words) == 2:
                append = words[1].startswith("append=")
                file = folder / words[1].removeprefix("append=")
                if folder.resolve() not in file.resolve().parents or (append and not file.is_file()):
                    return fail(start - 1, " ".join(words), "no file of the scratch folder, or none to add to")
                file.parent.mkdir(parents=True, exist_ok=True)
                with file.open("a" if append else "w", encoding="utf-8") as out:
                    out.write("\n".join(lines) + "\n")
    if not ran:
        return fail(1, "", "the guide has no command")
    return 0


sys.exit(main())
