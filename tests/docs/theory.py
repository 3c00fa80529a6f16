#!/usr/bin/env python3
"""What docs/theory.md names is there: every source file, and every test as `Suite.Name`.

usage: theory.py SOURCE_DIR
"""
import re
import sys
from pathlib import Path

FILE = re.compile(r"[\w./-]+\.(?:hpp|cpp|in|py|toml|csv|fll|fis|txt|md)")
TEST = re.compile(r"[A-Z]\w*\.[A-Z]\w*")
DEFINED = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\s*\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
# A row of a table that names a file computes something: it has to name a test, too, and the other way round.
ROW = re.compile(r"^\|(?! *---)(?! *equation)(.*)\|$")


def in_backticks(text):
    return re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))


def main():
    source = Path(sys.argv[1])
    page = source / "docs" / "theory.md"
    text = page.read_text(encoding="utf-8")
    words = in_backticks(text)
    files = sorted({word for word in words if FILE.fullmatch(word)})
    tests = sorted({word for word in words if TEST.fullmatch(word) and not FILE.fullmatch(word)})
    defined = {f"{suite}.{name}" for path in sorted((source / "tests").rglob("*.cpp"))
               for suite, name in DEFINED.findall(path.read_text(encoding="utf-8", errors="replace"))}
    wrong = [f"no file {name}" for name in files if not (source / name).is_file()]
    wrong += [f"no test {name}" for name in tests if name not in defined]
    for number, line in enumerate(text.splitlines(), 1):
        if row := ROW.match(line):
            named = in_backticks(row.group(1))
            if not any(FILE.fullmatch(word) for word in named) or not any(TEST.fullmatch(word) for word in named):
                wrong.append(f"line {number}: the row has no file or no test")
    if not files or not tests:
        wrong.append("it names no file or no test at all")
    for one in wrong:
        print(f"{page.relative_to(source)}: {one}")
    print(f"{len(files)} files and {len(tests)} tests named, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
