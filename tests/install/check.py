"""Installs a build to a folder of its own and uses it from there: the program, and the libraries by a program of ten lines.

usage: check.py BUILD SOURCE CMAKE COMPILER

Exit status: 0 everything holds, 1 something does not and is said.
"""
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

# Row "1layer 0.4900 44 SVK 1000" of the reference book 1.6 C, exact (cases/verification/tube-sleeve/expected.toml).
CASE, MEAN_PRESSURE, RELATIVE = "verification/tube-sleeve", 6202.61651745, 1e-3
ALIGNED = "Eigen is laid out otherwise here than in the libraries of snug"


def run(*words, status=0, **options):
    """What the program says; ends the test where its exit status is another one."""
    outcome = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if outcome.returncode != status:
        sys.exit(f"{' '.join(map(str, words))}\nended with {outcome.returncode}, not {status}:\n{outcome.stdout}")
    return outcome.stdout


def expect(holds, what):
    if not holds:
        sys.exit(f"does not hold: {what}")


def names_no_place(prefix, places):
    """No installed file names the source tree or the build."""
    files = [path for path in prefix.rglob("*") if path.is_file()]
    expect(any(b"snug predicts what a garment does" in path.read_bytes() for path in files), "text of the program is found in it")
    for path in files:
        found = [place for place in places if place.encode() in path.read_bytes()]
        expect(not found, f"{path.relative_to(prefix)} is free of {found}")


def program_finds_its_data(prefix, folder):
    """The installed program finds the cases that ship with it, wherever the whole is moved."""
    snug = prefix / "bin" / "snug"
    expect(f"  {CASE}\n" in run(snug, "list"), "snug list names the installed cases")
    run(snug, "new", folder / "mine", "--like", CASE)
    run(snug, "check", folder / "mine")
    run(snug, "check", prefix / "share/snug/cases/thigh-sleeve")
    expect("  woman: Standard woman" in run(snug, "list", "bodies"), "snug list bodies names the installed bodies")
    expect((prefix / "share/snug/scripts/picture.py").is_file(), "what draws pictures is installed")


def manual_is_installed(prefix):
    """The manual page and the completions of three shells are where these look for them, and are of this program."""
    for name, part in (("man/man1/snug.1", ".SH COMMANDS"), ("bash-completion/completions/snug", "complete -F _snug snug"),
                       ("zsh/vendor-completions/_snug", "#compdef snug"), ("fish/vendor_completions.d/snug.fish", "complete -c snug")):
        text = (prefix / "share" / name).read_text()
        expect(part in text and "sweep" in text, f"{name} has \"{part}\" and the options of snug run")


def library_solves(prefix, source, folder, cmake, compiler):
    """A program of others solves a case and reads a field: the exact mean pressure within a thousandth."""
    build = folder / "program"
    run(cmake, "-S", source / "tests/install/program", "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release")
    run(cmake, "--build", build)
    said = run(build / "program", prefix / "share/snug/cases" / CASE).split()
    expect(said[0] == "converged", f"the case converges ({said})")
    expect(math.isclose(float(said[1]), MEAN_PRESSURE, rel_tol=RELATIVE), f"mean pressure {said[1]} Pa is {MEAN_PRESSURE} Pa")
    expect(float(said[1]) <= float(said[2]) < 1.1 * MEAN_PRESSURE, f"the largest of the nodal pressures is {said[2]} Pa")


def other_alignment_is_refused(prefix, compiler):
    """Code that lays Eigen out otherwise than the libraries does not compile."""
    said = run(compiler, "-std=c++20", "-fsyntax-only", "-xc++", "-", "-isystem", prefix / "include", "-isystem", prefix / "include/snug",
               "-isystem", "/usr/include/eigen3", "-DEIGEN_MAX_ALIGN_BYTES=64", input="#include <snug/snug.hpp>\n", status=1)
    expect(ALIGNED in said, f"the compiler tells why:\n{said}")


def main(build, source, cmake, compiler):
    with tempfile.TemporaryDirectory(prefix="snug-install-") as name:
        folder = Path(name)
        run(cmake, "--install", build, "--prefix", folder / "first")
        prefix = (folder / "first").rename(folder / "moved")  # nothing depends on where it was installed
        names_no_place(prefix, [os.path.realpath(source), os.path.realpath(build)])
        program_finds_its_data(prefix, folder)
        manual_is_installed(prefix)
        other_alignment_is_refused(prefix, compiler)
        library_solves(prefix, source, folder, cmake, compiler)


main(Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:])
