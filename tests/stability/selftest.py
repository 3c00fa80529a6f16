"""The catalogue's own arithmetic: exact answers against the reference book, Laplace's estimate on a circle, units, verdicts."""
import csv
import math
import tempfile
import unittest
from pathlib import Path

import catalogue
import judging
import laplace
import running
from case_files import Table, m, toml_text
from exact import Layer, bar_stretch, hydrostatic_stretch, solve_limb
from scene import Exact, Scene, Sleeve, spring_tension

THREE = [Layer(0.020, 0.045, 8e3, 0.499), Layer(0.045, 0.053, 3e3, 0.499), Layer(0.053, 0.055, 5e4, 0.499)]


def outcome(status, iterations=10, message="", **numbers):
    summary = {"iterations": iterations, "unknowns": {"total": 1000}}
    return running.Outcome(status, 0 if status == "converged" else 3, 1.0, summary, numbers=numbers, message=message)


def verdict(scene, found, others=None):
    return judging.judge(scene, found, others or {}, 0.4, Path("/nowhere"))


class ExactAnswers(unittest.TestCase):
    def test_sleeve_on_limbs_of_the_reference_book(self):
        """Reference book 1.6 C: T = 200 (l - 1) from 44 mm on one layer at nu = 0.49 and on three at 0.499."""
        line_load = lambda r: 200 * (r / 0.044 - 1) / r
        one = solve_limb([Layer(0.020, 0.055, 1e4, 0.49)], line_load)
        self.assertAlmostEqual(one.pressure / 906.23807730, 1, delta=1e-10)
        self.assertAlmostEqual(one.displacement / (54.95688474438e-3 - 0.055), 1, delta=1e-8)
        self.assertAlmostEqual(solve_limb(THREE, line_load).pressure / 908.57965935, 1, delta=1e-10)

    def test_limb_under_pressure_of_the_reference_book(self):
        """Reference book 1.5 A: V1, nu = 0.3, p = 20 kPa: 42.69971739943 mm."""
        found = solve_limb([Layer(0.020, 0.055, 1e4, 0.3)], lambda r: 2e4).displacement
        self.assertAlmostEqual(found, 42.69971739943e-3 - 0.055, delta=1e-11)

    def test_a_bar_of_nearly_incompressible_tissue_stretches_by_its_closed_form(self):
        """J = 1: mu (l^2 - 1/l) is the tension; at 2 mu: l = 1.6180339887 (l^2 - 1/l = 2 has the golden section)."""
        self.assertAlmostEqual(bar_stretch(1e6, 0.4999999, 2e6), (1 + math.sqrt(5)) / 2, delta=1e-6)

    def test_a_block_under_a_small_pressure_gives_way_by_its_bulk_modulus(self):
        kappa = 2 * 1e4 * 1.3 / (3 * 0.4)
        self.assertAlmostEqual(1 - hydrostatic_stretch(1e4, 0.3, 1.0), 1 / (3 * kappa), delta=1e-9)


class Files(unittest.TestCase):
    def test_a_length_is_the_same_in_every_system(self):
        case = {"garment": {"position": m(0.0254)}}
        self.assertIn('"1 inch"', toml_text(case, "inch"))
        self.assertIn('"25.399999999999999 mm"', toml_text(case, "mm"))
        self.assertEqual(Table({"height": ("m", [0.01])}).text("cgs"), "height [cm]\n1\n")

    def test_every_scene_is_named_once_and_its_base_exists(self):
        self.assertGreaterEqual(len(catalogue.all_scenes()), 60)


class Estimates(unittest.TestCase):
    def test_a_circle_under_its_tension_has_the_ratio_one(self):
        """Radius 50 mm in a sleeve of 40 mm, T = 200 x 0.25 N/m: 1 kPa."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "skin.csv"
            with path.open("w") as file:
                out = csv.writer(file)
                out.writerow(["node", "x [m]", "y [m]", "z [m]", "ux [m]", "uy [m]", "uz [m]", "pressure [Pa]"])
                for k in range(5):
                    for n in range(360):
                        a = math.radians(n)
                        out.writerow([1, 0.05 * math.cos(a), 0.05 * math.sin(a), 0.01 * k, 0, 0, 0, 1000.0])
            found = laplace.ratio(path, Sleeve(spring_tension(200.0), 2 * math.pi * 0.04, -0.001, 0.041))
        self.assertAlmostEqual(found, 1, delta=1e-3)


class Verdicts(unittest.TestCase):
    scene = Scene("s", "g", "", {}, base="b", exact=Exact("p", lambda: 100.0, 1e-2))

    def test_a_converged_run_off_its_exact_answer_is_wrong(self):
        self.assertTrue(verdict(self.scene, outcome("converged", p=102.0)).wrong)
        self.assertTrue(verdict(self.scene, outcome("converged")).wrong)
        self.assertTrue(verdict(self.scene, outcome("converged", p=100.5)).good)

    def test_an_answer_off_the_exact_one_that_warns_of_gathered_cloth_is_told_but_not_good(self):
        found = outcome("converged", p=102.0)
        found.summary["warnings"] = [{"name": "gathered cloth"}]
        row = verdict(self.scene, found)
        self.assertFalse(row.wrong or row.good)

    def test_a_run_that_did_not_converge_is_not_wrong_and_not_good(self):
        row = verdict(self.scene, outcome("partial", p=50.0))
        self.assertFalse(row.wrong or row.good)

    def test_a_scene_without_equilibrium_must_be_told_so(self):
        slides = Scene("s", "g", "", {}, right="slides")
        self.assertTrue(verdict(slides, outcome("converged")).wrong)
        self.assertFalse(verdict(slides, outcome("partial", message="too many iterations")).good)
        self.assertTrue(verdict(slides, outcome("failed", message="no equilibrium: nothing holds the garment")).good)

    def test_where_the_least_friction_is_known_it_must_be_told(self):
        slides = Scene("s", "g", "", {}, right="slides", least_friction=0.5)
        told = "letting go stopped; what is reported is held by a coefficient of {}"
        self.assertTrue(verdict(slides, outcome("partial", message=told.format("0.52"))).good)
        self.assertFalse(verdict(slides, outcome("partial", message=told.format("0.7"))).good)

    def test_twins_differ_by_pressure_and_by_iterations(self):
        twin = Scene("s", "g", "", {}, same_as="b")
        base = {"b": outcome("converged", mean_contact_pressure_Pa=100.0)}
        self.assertTrue(verdict(twin, outcome("converged", 12, mean_contact_pressure_Pa=100.0), base).good)
        self.assertFalse(verdict(twin, outcome("converged", 13, mean_contact_pressure_Pa=100.0), base).good)
        self.assertFalse(verdict(twin, outcome("converged", 10, mean_contact_pressure_Pa=100.001), base).good)

    def test_a_run_that_left_nothing_is_no_state(self):
        for status, code in (("time out", -24), ("crashed", -11), ("refused", 2)):
            self.assertIn("NO STATE", verdict(self.scene, running.Outcome(status, code, 1.0)).verdict)


if __name__ == "__main__":
    unittest.main()
