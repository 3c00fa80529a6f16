"""Opens the pages of the library and of a project in a real browser: search, filter, sort, curves, two side by side, and nothing is requested.

usage: library.py SNUG SOURCE FOLDER      the program, the repository, a folder for the library, results and screenshots
Exit status 77: Chromium or its driver is not installed (scripts/setup --browser).
"""
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from webdriver import Browser, missing  # noqa: E402

NAMES = "return [...document.querySelectorAll('#table tbody tr')].map((row) => row.dataset.id)"
HOSTILE = "<script>document.title='taken'</script> & </script>"
COARSE = ["--tier", "L1", "--quiet", "--no-report", "--set", "body.cells_around=12", "--set", "body.cells_along=4", "--set", "garment.cell_size=\"25 mm\""]


def snug(*words):
    return subprocess.run([SNUG, *words], check=True, cwd=FOLDER, env={**os.environ, "SNUG_LIBRARY": str(FOLDER / "library.db"), "SNUG_RECORD": "on"}, capture_output=True, text=True).stdout


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        snug("materials", "add", "fabric", "my knit", "weight=0.1 kg/m2", "LT=0.95", f"hand={HOSTILE}")
        snug("library", "page")
        cls.browser = cls.enterClassContext(Browser())
        cls.browser.open("about:blank")
        cls.browser.log("performance")  # the browser's own first page

    def setUp(self):
        self.browser.open(f"file://{FOLDER}/library.html")

    def names(self):
        return self.browser.run(NAMES)

    def set(self, field, value):
        self.browser.run("const field = document.getElementById(arguments[0]); field.value = arguments[1];"
                         "for (const kind of ['input', 'change']) field.dispatchEvent(new Event(kind));", field, value)

    def test_1_nothing_leaves_the_page(self):
        """The only request is the file itself, the console has nothing to say, and what a user wrote is text."""
        addresses = {a for a in self.browser.requests() if not a.startswith(("data:", "blob:"))}
        self.assertEqual(addresses, {f"file://{FOLDER}/library.html"})
        self.assertEqual([entry["message"] for entry in self.browser.log("browser") if entry["level"] == "SEVERE"], [])
        self.assertNotEqual(self.browser.run("return document.title"), "taken")
        self.browser.run("[...document.querySelectorAll('#table tbody tr')].find((row) => row.dataset.id === 'my knit').querySelector('a').click()")
        self.assertIn(HOSTILE, self.browser.run("return document.getElementById('values').textContent"))

    def test_2_search_filter_and_sort(self):
        """The answers are those of `snug materials find`, in whatever unit a number was printed; sorted up and down."""
        every = self.names()
        self.assertEqual(len(every), 20)
        self.set("text", "spandex wear 85%")
        self.assertEqual(self.names(), ["N85L15"])
        self.set("text", "")
        self.set("item", "weight")
        self.set("to", 249.999)
        self.assertEqual(sorted(self.names()), sorted(snug("materials", "find", "weight < 250 g/m2", "--kind", "fabric").splitlines()))
        self.assertEqual(self.browser.run("return document.getElementById('unit').textContent"), "g/m2")
        self.set("to", "")
        self.set("item", "LT")
        self.set("from", 1.0001)
        self.assertEqual(sorted(self.names()), sorted(snug("materials", "find", "LT > 1", "--kind", "fabric").splitlines()))
        self.set("from", "")
        self.browser.click("[data-sort=weight]")
        up = self.names()
        self.browser.click("[data-sort=weight]")
        down = self.names()
        self.assertEqual(up[0], "my knit")  # 100 g/m2, printed in kg/m2
        numbers = [name for name in up if name in down[:down.index("my knit") + 1]]
        self.assertEqual(numbers, down[:len(numbers)][::-1])
        self.browser.screenshot(FOLDER / "table.png", "#table")

    def test_3_a_fabric_is_shown_with_its_curves(self):
        """Every datum with its source; the tensile curve ends at (EMT, Fm) of the table, 43.26 %, 45.4 N/m, and is dashed beyond."""
        self.browser.run("[...document.querySelectorAll('#table tbody tr')].find((row) => row.dataset.id === 'N85L15').querySelector('a').click()")
        self.assertIn("43.26", self.browser.run("return document.getElementById('values').textContent"))
        self.assertIn("7.1", self.browser.run("return document.getElementById('values').textContent"))
        curves = self.browser.run("return [...document.querySelectorAll('#detail figure')].map((figure) => [figure.querySelector('figcaption').textContent.trim().split(' ')[0],"
                                  "figure.querySelectorAll('.curve:not(.beyond)').length, figure.querySelectorAll('.beyond').length, figure.querySelector('path').getBBox().width])")
        self.assertEqual([name for name, *_ in curves], ["tensile", "shear"])
        for _, inside, beyond, width in curves:
            self.assertEqual(inside, 2)  # loading, unloading
            self.assertGreaterEqual(beyond, 1)
            self.assertGreater(width, 200)
        self.browser.screenshot(FOLDER / "fabric.png", "#detail")

    def test_4_two_fabrics_are_compared(self):
        """Both in one table and in one picture, in two colours; a third tick takes the place of the first."""
        for name in ("N88P", "E95C"):
            self.browser.run("[...document.querySelectorAll('#table tbody tr')].find((row) => row.dataset.id === arguments[0]).querySelector('input').click()", name)
        self.assertEqual(self.browser.run("return document.querySelector('#detail h2').textContent"), "N88P and E95C")
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('#values thead th')].map((cell) => cell.textContent)"), ["item", "N88P", "source", "E95C", "source"])
        colours = self.browser.run("return [...new Set([...document.querySelectorAll('#detail .curve')].map((path) => getComputedStyle(path).stroke))].length")
        self.assertEqual(colours, 2)
        self.browser.screenshot(FOLDER / "two.png", "#detail")
        self.browser.run("[...document.querySelectorAll('#table tbody tr')].find((row) => row.dataset.id === 'P98L2').querySelector('input').click()")
        self.assertEqual(self.browser.run("return document.querySelector('#detail h2').textContent"), "E95C and P98L2")

    def test_5_other_kinds(self):
        """Tissues have curves, too; an empty search says so."""
        self.set("kind", "tissue")
        self.assertIn("relaxed thigh", self.names())
        self.browser.run("[...document.querySelectorAll('#table tbody tr')].find((row) => row.dataset.id === 'relaxed thigh').querySelector('a').click()")
        self.assertEqual(self.browser.run("return document.querySelectorAll('#detail .curve').length"), 1)
        self.set("text", "no such tissue")
        self.assertEqual(self.names(), [])
        self.assertTrue(self.browser.run("return document.getElementById('count').textContent").startswith("0 of "))

    def test_6_a_project_shows_its_variants(self):
        """Specification, a row a run, the map of each, the chosen one marked with its reason; nothing is requested."""
        snug("materials", "add", "project", "sleeve", "designer=Anna & Co", "purpose=a sleeve for walking")
        snug("new", "mine", "--like", "thigh-sleeve")
        for number, fabric in enumerate(("N85L15", "P98L2")):
            snug("run", "mine", "--project", "sleeve", "--out", f"out-{number}", "--set", f"garment.fabric={fabric}", *COARSE)
        snug("project", "decide", "sleeve", "2", "softer")
        snug("project", "page", "sleeve")
        self.browser.requests()
        self.browser.open(f"file://{FOLDER}/sleeve.html")
        self.assertEqual([a for a in self.browser.requests() if not a.startswith(("data:", "blob:"))], [f"file://{FOLDER}/sleeve.html"])
        self.assertEqual(self.browser.run("return document.querySelectorAll('#variants tbody tr').length"), 2)
        self.assertEqual(self.browser.run("return document.querySelectorAll('svg.map').length"), 2)
        self.assertIn("Anna & Co", self.browser.run("return document.getElementById('specification').textContent"))
        self.assertEqual(self.browser.run("return document.querySelector('tr.chosen td').textContent"), "2")
        self.assertIn("softer", self.browser.run("return document.getElementById('decision').textContent"))
        self.assertIn("garment.fabric.name", self.browser.run("return document.getElementById('settings').textContent"))
        self.browser.screenshot(FOLDER / "project.png")


if __name__ == "__main__":
    if missing():
        print(f"skipped: {' and '.join(missing())} not installed; scripts/setup --browser installs them")
        sys.exit(77)
    SNUG, SOURCE, FOLDER = Path(sys.argv[1]).absolute(), Path(sys.argv[2]), Path(sys.argv[3]).absolute()
    unittest.main(argv=sys.argv[:1], verbosity=2)
