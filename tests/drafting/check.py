#!/usr/bin/env python3
"""What scripts/draft-vest drafts has the girths that were asked for, and is refused where it cannot fit.

usage: check.py PROGRAM SOURCE_DIR
"""
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

PROGRAM, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
DRAFT = SOURCE / "scripts" / "draft-vest"

# A slim trunk of round numbers that no body of the tree has.
MEASURES = """armhole_depth = 150
front_length = 170
back_length = 160
neck_width = 120
shoulder_width = 240
shoulder_slope = 20
girths = [[150, 800, 0.55], [250, 640, 0.5], [350, 760, 0.45], [420, 840, 0.5]]
"""


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


class Drafting(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="snug-draft-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out, self.measures = self.folder / "vest.toml", self.folder / "measures.toml"
        self.measures.write_text(MEASURES)

    def draft(self, *options):
        return run(sys.executable, "-B", DRAFT, self.out, *options)

    def pieces(self, *options):
        done = self.draft(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        pattern = tomllib.loads(self.out.read_text())
        return {piece["name"]: {edge["name"]: edge for edge in piece["edges"]} for piece in pattern["piece"]}

    def widths(self, piece, side):
        """Height over the hem: width, at the points of a side that is drawn."""
        return {y: 2 * x for x, y in [piece[side]["from"], *piece[side]["through"], piece[f"armhole {side}"]["from"]]}

    def refusal(self, *options):
        done = self.draft(*options)
        self.assertNotEqual(done.returncode, 0)
        self.assertFalse(self.out.exists(), "a refused draft leaves no file")
        self.assertNotIn("Traceback", done.stderr)
        return done.stderr

    def test_the_girths_are_those_of_the_body_less_the_reduction(self):
        """At heights of the measured girths front and back together are as long as was asked, and the front has its share."""
        for asked in (0.0, 0.12, -0.05):
            pieces = self.pieces("--measures", self.measures, "--reduction", asked)
            front, back = self.widths(pieces["front"], "left"), self.widths(pieces["back"], "right")
            for below, girth, share in ((150, 800, 0.55), (420, 840, 0.5)):
                self.assertAlmostEqual(front[420 - below] + back[420 - below], girth * (1 - asked), delta=0.03)
                self.assertAlmostEqual(front[420 - below], share * girth * (1 - asked), delta=0.02)

    def test_a_reduction_by_height(self):
        """Between two heights the reduction changes evenly: nothing at the armhole, a fifth at the hem."""
        pieces = self.pieces("--measures", self.measures, "--reduction", "150:0,420:0.2")
        front, back = self.widths(pieces["front"], "left"), self.widths(pieces["back"], "right")
        self.assertAlmostEqual(front[270.0] + back[270.0], 800, delta=0.03)
        self.assertAlmostEqual(front[0.0] + back[0.0], 840 * 0.8, delta=0.03)

    def test_between_the_girths_the_sides_are_curved(self):
        """Half way between two rows the girth is that of a natural cubic spline, not of straight lines."""
        pieces = self.pieces("--measures", self.measures, "--reduction", 0, "--hem", 350)
        front, back = self.widths(pieces["front"], "left"), self.widths(pieces["back"], "right")
        girths = {round(y, 2): front[y] + back[y] for y in front}
        self.assertAlmostEqual(girths[100.0], 640, delta=0.05)  # measured
        # By hand: the spline through (150, 800), (250, 640), (350, 760), (420, 840) has the second derivatives 0, 0.0456054, -0.0144218, 0,
        # and lies 100^2 / 16 of their sum below the chord there.
        self.assertAlmostEqual(girths[50.0], 700 - 625 * (0.0456054 - 0.0144218), delta=0.05)

    def test_the_shoulders_are_as_long_as_measured(self):
        """Straps meet at the same length, their middles as far above the armhole as the skin is long; necks are cut to their depth."""
        pieces = self.pieces("--measures", self.measures, "--strap", 30, "--neck-front", 0.5)
        for name, side, length in (("front", "left", 170), ("back", "right", 160)):
            piece = pieces[name]
            outer, inner = piece[f"strap {side}"]["from"], piece[f"neck {side}"]["from"]
            under_arm = piece[f"armhole {side}"]["from"]
            self.assertAlmostEqual(0.5 * (outer[1] + inner[1]) - under_arm[1], length, delta=0.02)
            self.assertAlmostEqual(outer[0] - inner[0], 30, delta=0.02)
        self.assertAlmostEqual(pieces["front"]["neck left"]["from"][1] - pieces["front"]["neck right"]["from"][1], 85, delta=0.02)

    def test_what_is_measured_can_be_given_back(self):
        """A vest drafted from written measures is the one that was drafted from the body."""
        written = self.folder / "woman.toml"
        first = self.pieces("--body", "woman", "--write-measures", written)
        self.assertEqual(first.keys(), {"front", "back"})
        again = self.pieces("--measures", written)
        for name in first:
            for edge in first[name]:
                for a, b in zip(first[name][edge]["from"], again[name][edge]["from"]):
                    self.assertAlmostEqual(a, b, delta=0.15)

    def test_the_program_reads_it_and_places_it(self):
        """A vest of a body's own measures goes round trunk, neck and arms of that body: woman and man."""
        for body in ("woman", "man"):
            done = self.draft("--body", body, "--reduction", 0.08)
            self.assertEqual(done.returncode, 0, done.stderr)
            surface = SOURCE / "mesh" / "data" / "bodies" / f"{body}.obj"
            placed = run(PROGRAM, "pattern", self.out, "--on", surface, "--up", "z", "--cells", "20 mm", "--out", self.folder / body)
            self.assertEqual(placed.returncode, 0, placed.stdout + placed.stderr)
            for word in ("lower round trunk", "neck round neck", "armhole left round left arm", "armhole right round right arm"):
                self.assertIn(word, placed.stdout)

    def test_what_cannot_fit_is_refused_by_name(self):
        """Straps wider than the shoulder, hems off the body, files that are no measures: said with their figures."""
        self.assertIn("a strap of 90 mm", self.refusal("--measures", self.measures, "--strap", 90))
        self.assertIn("the hem, 500 mm below", self.refusal("--measures", self.measures, "--hem", 500))
        self.assertIn("crotch of this body", self.refusal("--body", "woman", "--hem", 800))
        self.assertIn("waist of this body", self.refusal("--body", "woman", "--hem", 200))
        self.assertIn("a reduction of 0.7", self.refusal("--measures", self.measures, "--reduction", 0.7))
        self.assertIn("tight", self.refusal("--measures", self.measures, "--reduction", "tight"))
        self.assertIn("there is no file nobody", self.refusal("--body", "nobody"))
        for text, said in ((MEASURES.replace("armhole_depth = 150\n", ""), "armhole_depth missing"),
                           (MEASURES + "bust = 1\n", "unknown bust"),
                           (MEASURES.replace("[250, 640, 0.5]", "[250, 640, 50]"), "is not [mm below"),
                           (MEASURES.replace("[250,", "[450,"), "do not go down"),
                           (MEASURES.replace("front_length = 170", "front_length = 120"), "front_length of 120 mm is shorter"),
                           (MEASURES.replace("= 240", "= 100"), "leaves no room"), ("girths = 1\n", "missing")):
            self.measures.write_text(text)
            self.assertIn(said, self.refusal("--measures", self.measures))


if __name__ == "__main__":
    sys.argv = sys.argv[:1]
    unittest.main()
