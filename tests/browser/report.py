"""Opens report.html and compare.html in a real browser: maps and lines are drawn, picking reads the pressures of skin.csv, nothing is requested.

usage: report.py SNUG SOURCE FOLDER      the program, the repository, a folder for results and screenshots
Exit status 77: Chromium or its driver is not installed (scripts/setup --browser).
"""
import csv
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from webdriver import Browser, missing  # noqa: E402

COARSE = ["--set", "body.cells_around=16", "--set", "body.cells_along=7", "--set", "garment.cell_size=\"20 mm\""]

# Distinct colours among the pixels of the canvas, and the share of the most frequent one.
PIXELS = """
  const from = document.getElementById("canvas"), to = document.createElement("canvas");
  to.width = from.width; to.height = from.height;
  const context = to.getContext("2d");
  context.drawImage(from, 0, 0);
  const data = new Uint32Array(context.getImageData(0, 0, to.width, to.height).data.buffer), counts = new Map();
  data.forEach((c) => counts.set(c, (counts.get(c) || 0) + 1));
  return [counts.size, Math.max(...counts.values()) / data.length];
"""
READOUT = "return {...document.getElementById('readout').dataset}"


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out = FOLDER / "thigh"
        shutil.rmtree(cls.out, ignore_errors=True)
        os.environ["SNUG_RECORD"] = "off"
        subprocess.run([SNUG, "run", SOURCE / "cases/thigh-sleeve", "--quiet", "--out", cls.out, *COARSE], check=True)
        with open(cls.out / "skin.csv", newline="") as table:
            cls.pressure = {int(row["node"]): float(row["pressure [Pa]"]) for row in csv.DictReader(table)}
        cls.browser = cls.enterClassContext(Browser())
        cls.browser.open("about:blank")
        cls.browser.log("performance")  # the browser's own first page
        cls.browser.open(f"file://{cls.out}/report.html")

    def check_readout(self):
        """The node that the view reads, after comparing its pressure with skin.csv (the page holds 32-bit numbers)."""
        read = self.browser.run(READOUT)
        self.assertIn("node", read)
        expected = self.pressure[int(read["node"])]
        self.assertAlmostEqual(float(read["pressure"]), expected, delta=1e-6 * max(abs(expected), 1.0))
        return int(read["node"])

    def test_1_nothing_leaves_the_page(self):
        """The only request is the file itself, and the console has nothing to say."""
        addresses = [a for a in self.browser.requests() if not a.startswith(("data:", "blob:"))]
        self.assertEqual(addresses, [f"file://{self.out}/report.html"])
        self.assertEqual([entry["message"] for entry in self.browser.log("browser") if entry["level"] == "SEVERE"], [])

    def test_2_the_unrolled_map_is_drawn(self):
        """The map has several bands of colour that cover a good part of it, the four locations and a colour bar."""
        bands = self.browser.run("return [...document.querySelectorAll('svg.map g[clip-path] path[fill]')].map((path) => {"
                                 "const box = path.getBBox(); return [path.getAttribute('fill'), box.width, box.height]; })")
        self.assertGreaterEqual(len({colour for colour, _, _ in bands}), 4)
        self.assertGreater(bands[0][1], 700)
        self.assertGreater(bands[0][2], 200)
        self.assertEqual(self.browser.run("return document.querySelectorAll('svg.map .patch').length"), 4)
        self.browser.screenshot(FOLDER / "map.png", "svg.map")

    def test_3_the_view_is_drawn(self):
        """Pressure and tension fill the canvas with many colours; no one of them takes it all."""
        for show in ("skin", "garment"):
            self.browser.click(f"[name=show][value={show}]")
            colours, share = self.browser.run(PIXELS)
            self.browser.screenshot(FOLDER / f"view-{show}.png", "#view")
            self.assertGreater(colours, 500, show)
            self.assertLess(share, 0.9, show)
        self.browser.click("[name=show][value=skin]")

    def test_4_a_click_reads_a_node_with_its_pressure(self):
        """Clicks on the body read nodes whose pressures are those of skin.csv; seen from the back these are others."""
        seen = []
        for side in ("front", "back"):
            self.browser.click(f"[data-side={side}]")
            for y in (-60, 0, 60):
                self.browser.click_at("#canvas", 20, y)
                seen.append(self.check_readout())
        self.assertEqual(len(set(seen)), 6)
        self.assertGreater(sum(self.pressure[node] > 0 for node in seen), 3)

    def test_5_a_node_is_found_by_its_number(self):
        """The node with the largest pressure, by its number as in skin.csv."""
        node = max(self.pressure, key=self.pressure.get)
        self.browser.write("#node", f"{node}\ue007")
        self.assertEqual(self.check_readout(), node)

    def test_6_the_page_fits_a_small_screen(self):
        """No part of the page is wider than the window, so that nothing is cut on paper or on a tablet."""
        self.browser.screenshot(FOLDER / "page.png")
        width, inner = self.browser.run("return [document.documentElement.scrollWidth, window.innerWidth]")
        self.assertLessEqual(width, inner)


class Sweep(unittest.TestCase):
    """compare.html of three circumferences by the law of Laplace, beside results of an earlier run."""

    @classmethod
    def setUpClass(cls):
        cls.out = FOLDER / "sweep"
        shutil.rmtree(cls.out, ignore_errors=True)
        subprocess.run([SNUG, "run", SOURCE / "cases/thigh-sleeve", "--quiet", "--no-report", "--tier", "L0", "--out", cls.out], check=True)
        subprocess.run([SNUG, "run", SOURCE / "cases/thigh-sleeve", "--quiet", "--tier", "L0", "--out", cls.out,
                        "--sweep", "garment.pattern.flat_circumference=400 mm:430 mm:3", *COARSE], check=True)

    def test_the_page_fits_every_screen_and_draws_its_lines(self):
        """At 1400, 800 and 400 px nothing is wider than the window and nothing leaves the page; a line a location has a dot a value."""
        for width in (1400, 800, 400):
            with Browser(width, 1200) as browser:
                browser.open("about:blank")
                browser.log("performance")
                browser.open(f"file://{self.out}/compare.html")
                self.assertEqual([a for a in browser.requests() if not a.startswith(("data:", "blob:"))], [f"file://{self.out}/compare.html"])
                page, inner = browser.run("return [document.documentElement.scrollWidth, window.innerWidth]")
                self.assertLessEqual(page, inner, width)
                lines, dots = browser.run("return [document.querySelectorAll('#sweep polyline').length, document.querySelectorAll('#sweep circle').length]")
                self.assertEqual((lines, dots), (5, 15))  # four locations and the whole cover
                browser.screenshot(FOLDER / f"compare-{width}.png")


if __name__ == "__main__":
    if missing():
        print(f"skipped: {' and '.join(missing())} not installed; scripts/setup --browser installs them")
        sys.exit(77)
    SNUG, SOURCE, FOLDER = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]).absolute()
    FOLDER.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
