"""Tests of the lab: plans become rows, rows are measured once, sections say what the figures say."""
# SPDX-License-Identifier: MIT
import glob
import json
import os
import subprocess
import tempfile
import unittest

import clip
import plan
import runner
from section import Section, listed, write_csv

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../build"))


def sweep_row(codec="coddyac"):
    return plan.Row("sweep", "wave", {"codec": codec, "basis": "cobra", "entropy": "range", "bases": [2, 4], "bits": [6, 8]})


class Plans(unittest.TestCase):
    def test_each_sequence_meets_each_coding(self):
        rows = plan.rows_of({"measure": "encode", "common": {"kg": 0.3}, "sequence": {"a": {"kg": 0.1}, "b": {}},
                             "coding": [{"name": "x", "codec": "na"}, {"name": "y", "codec": "lsp"}]})
        self.assertEqual([(row.sequence, row.name, row.settings) for row in rows],
                         [("a", "x", {"kg": 0.1, "codec": "na"}), ("a", "y", {"kg": 0.1, "codec": "lsp"}),
                          ("b", "x", {"kg": 0.3, "codec": "na"}), ("b", "y", {"kg": 0.3, "codec": "lsp"})])

    def test_a_sequence_may_stand_several_times(self):
        rows = plan.rows_of({"measure": "predictors", "sequence": {"a": [{"bases": 25}, {"bases": 50}]}})
        self.assertEqual([row.settings["bases"] for row in rows], [25, 50])

    def test_what_the_thesis_prints_is_no_setting(self):
        row = plan.rows_of({"measure": "m", "sequence": {"a": {"printed": {"kg": 1}}}})[0]
        self.assertEqual((row.printed, row.settings), ({"kg": 1}, {}))

    def test_a_misspelt_key_is_an_error(self):
        with self.assertRaises(plan.PlanError):
            plan.rows_of({"measure": "m", "sequences": {"a": {}}})

    def test_every_plan_of_the_house_has_rows(self):
        for path in glob.glob(os.path.join(HERE, "plans/*.toml")):
            self.assertTrue(plan.load(path), path)


class Clips(unittest.TestCase):
    def clip(self, folder, *, points, mesh="v 0 0 0\n" * 4 + "f 1 2 3 4\n"):
        made = clip.Clip("square", os.path.join(folder, "mesh.obj"), os.path.join(folder, "motion.pc2"))
        with open(made.mesh, "w", encoding="utf-8") as file:
            file.write(mesh)
        with open(made.motion, "wb") as file:
            file.write(clip.PC2_HEADER.pack(clip.PC2_MAGIC, 1, 4, 0.0, 1.0, 3) + b"\0" * 12 * points)
        return made

    def test_a_clip_knows_its_counts(self):
        with tempfile.TemporaryDirectory() as folder:
            made = self.clip(folder, points=12)
            self.assertEqual((made.V, made.F, made.T, made.faces), (4, 3, 2, [(0, 1, 2), (0, 2, 3)]))

    def test_a_point_cache_cut_short_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(clip.ClipError):
            self.clip(folder, points=11).V


class Sections(unittest.TestCase):
    def test_a_list_is_told_as_people_tell_it(self):
        self.assertEqual(listed(["a", "b", "c"]), "a, b and c")
        self.assertEqual(listed(["a"]), "a")

    def test_a_csv_file_says_first_what_made_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.csv")
            write_csv(path, [{"a": 1}, {"a": 2, "b": 3}], ["commit 1234"])
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), "# commit 1234\na,b\n1,\n2,3\n")

    def test_a_direction_that_fails_is_kept(self):
        section = Section("t")
        section.direction("less", 2 < 1, "2 and 1")
        self.assertFalse(section.directions[0].holds)

    def test_the_sizes_of_fields_are_summed_over_segments(self):
        lines = ["  10   5  SEGM.payload.basis_bits  2 bytes: 00 01 ...", "  20   7  SEGM.payload.basis_bits  4 bytes"]
        self.assertEqual(runner.sizes_of_fields(lines), {"basis_bits": 12})

    def test_bits_of_one_field_are_told_apart_by_the_size_of_the_basis(self):
        lines = ["  10   2  SEGM.payload.basis_size  300", "  12   1000  SEGM.payload.bits  1000 bytes: 00 01 ..."] * 2
        self.assertEqual(runner.sizes_of_fields(lines), {"basis_size": 4, "basis_bits": 600, "residual_bits": 1400})


class Measurements(unittest.TestCase):
    """The programs on a generated animation."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        data = os.path.join(cls.folder.name, "data/wave")
        os.makedirs(data)
        cls.files = [os.path.join(data, name) for name in ("motion.pc2", "mesh.obj")]
        subprocess.run([os.path.join(BUILD, "meshreel"), "generate", "cloth", cls.files[0], "--mesh", cls.files[1], "--vertices", "200",
                        "--frames", "20", "-q"], check=True)
        cls.bench = cls.new_bench()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def new_bench(cls):
        return runner.Bench(os.path.join(HERE, ".."), BUILD, os.path.join(cls.folder.name, "data"),
                            os.path.join(cls.folder.name, "cache"))

    def measured(self, name, **settings):
        asked = json.dumps({"motion": self.files[0], "mesh": self.files[1], **settings})
        return json.loads(subprocess.check_output([os.path.join(BUILD, "meshreel-lab"), name, asked], text=True))

    def test_a_sweep_gives_the_size_and_the_error_of_the_commands_file(self):
        for point in self.bench.figures(sweep_row())["points"]:
            settings = {"codec": "coddyac", "basis": "cobra", "entropy": "range", "bases": point["bases"], "step": 2.0 ** -point["bits"]}
            file = self.bench.figures(plan.Row("encode", "wave", settings))
            self.assertLessEqual(abs(file["reel_bytes"] - point["bytes"]), 4)  # lengths in the file vary with the payload's
            self.assertAlmostEqual(file["kg"], point["kg"], 9)

    def test_a_row_is_measured_once(self):
        self.bench.figures(sweep_row())
        again = self.new_bench()
        self.assertEqual(again.figures(sweep_row()), self.bench.figures(sweep_row()))
        self.assertEqual(again.fresh, 0)

    def test_what_cannot_be_measured_is_skipped_by_name(self):
        self.assertIn("no such codec", self.bench.missing(sweep_row("nobody's")))
        self.assertIn("nowhere", self.bench.missing(plan.Row("sweep", "nowhere", {})))

    def test_eigenvalues_fall_and_sum_up(self):
        figures = self.measured("eigenvalues", count=60)
        self.assertEqual(figures["eigenvalues"], sorted(figures["eigenvalues"], reverse=True))
        self.assertAlmostEqual(sum(figures["eigenvalues"]) / figures["sum"], 1, 6)

    def test_the_predictors_are_measured_at_the_entropy_asked_for(self):
        figures = self.measured("predictors", bases=4, cob1=5.0)
        self.assertAlmostEqual(figures["cob1"]["entropy"], 5.0, 1)
        self.assertLess(figures["lpc2"]["squares"], figures["lpc1"]["squares"])

    def test_tripling_a_step_never_helps_and_starts_at_the_error_asked_for(self):
        figures = self.measured("tripled", bases=4, kg=60)
        for name in ("uniform", "non_uniform"):
            self.assertAlmostEqual(figures[name]["before"], 60, 1)
            self.assertGreater(min(figures[name]["after"]), 0.99 * figures[name]["before"])


class Report(unittest.TestCase):
    def test_without_data_a_report_says_what_it_skips(self):
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("python3-matplotlib is not installed")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["/usr/bin/python3", os.path.join(HERE, "figures.py"), "--build", BUILD, "--data", folder, "--out", folder,
                            "--cache", folder], check=True, stderr=subprocess.DEVNULL)
            with open(os.path.join(folder, "docs/thesis-figures.md"), encoding="utf-8") as file:
                page = file.read()
        self.assertEqual(page.count("chicken: its data are not here"), 6)


if __name__ == "__main__":
    unittest.main()
