"""Tests of the ablation: its patches apply and stand in its plan; what an idea is worth."""
# SPDX-License-Identifier: MIT
import math
import os
import subprocess
import unittest

import ideas
import plan
import releases

PLAN = os.path.join(releases.ROOT, "lab/plans/ablation.toml")


def file(coding, setting, kg, bpfv, seconds=1.0):
    return {"sequence": "cow", "coding": coding, "setting": setting, "kg": kg, "bpfv": bpfv, "encode_s": seconds, "commit": "c"}


WHOLE = [file("reel", "kg 0.5", 0.5, 1.0), file("reel", "kg 0.1", 0.1, 4.0)]


class Patches(unittest.TestCase):
    def test_each_still_takes_its_idea_out_of_the_sources(self):
        for name, idea in ideas.read().items():
            with self.subTest(name):
                done = subprocess.run(["git", "apply", "--check", idea.path], cwd=releases.ROOT, stderr=subprocess.PIPE, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_each_stands_in_the_plan_with_a_build_of_its_name(self):
        codings = plan.curves_of(plan.read(PLAN), "ablation").codings
        self.assertEqual({coding.name: coding.build for coding in codings if coding.name != ideas.WHOLE},
                         {name: f"build/ablation/{name}" for name in ideas.read()})

    def test_each_changes_the_library_alone(self):
        for name, idea in ideas.read().items():
            self.assertTrue(ideas.touched(idea) and all(path.startswith("src/meshreel/") for path in ideas.touched(idea)), name)


class Worth(unittest.TestCase):
    def test_the_same_file_is_worth_nothing(self):
        self.assertAlmostEqual(ideas.worth([*WHOLE, {**WHOLE[0], "coding": "x"}], "kg")["cow", "x"], 0, 12)

    def test_a_file_is_held_against_the_whole_codec_at_its_own_error(self):
        for kg in (0.05, 0.1, 0.3, 0.6):  # beyond the curve's ends too
            larger = file("x", "kg 0.2", kg, 1.1 * (kg / 0.5) ** (math.log(4) / math.log(0.2)))
            self.assertAlmostEqual(ideas.worth([*WHOLE, larger], "kg")["cow", "x"], 10, 9)

    def test_times_are_of_files_of_the_same_setting(self):
        self.assertAlmostEqual(ideas.times([*WHOLE, file("x", "kg 0.5", 0.5, 1.0, 3.0)], "encode_s")["cow", "x"], 200)

    def test_a_file_is_held_against_the_whole_codec_of_its_own_commit(self):
        later = [{**row, "commit": "d", "bpfv": 0.5 * row["bpfv"]} for row in WHOLE]
        self.assertAlmostEqual(ideas.worth([*WHOLE, *later, {**later[0], "coding": "x"}], "kg")["cow", "x"], 0, 12)

    def test_what_is_measured_now_takes_the_place_of_what_was_and_nothing_else_does(self):
        old = [*WHOLE, file("x", "kg 0.2", 0.2, 2.0), file("y", "kg 0.2", 0.2, 3.0)]
        again = [{**row, "commit": "d"} for row in [*WHOLE, old[2]]]
        self.assertEqual(ideas.renewed(old, again), [*again, old[3], *WHOLE])
        self.assertEqual(ideas.renewed(old, [*again, {**old[3], "commit": "d"}]), [*again, {**old[3], "commit": "d"}])
        self.assertEqual(ideas.renewed(old, old[:3]), [*old[:3], old[3]])  # of the same commit

    def test_what_is_worth_little_is_told_with_where_it_is_worth_most(self):
        rows = [{**row, "coding": coding, "sequence": sequence, "bpfv": row["bpfv"] * factor} for row in WHOLE for coding, sequence, factor in
                (("reel", "a", 1), ("reel", "b", 1), ("x", "a", 1.004), ("x", "b", 0.9), ("y", "a", 1.1), ("y", "b", 0.9), ("z", "a", 1.1), ("z", "b", 1))]
        self.assertEqual([(name, round(most, 6), sequence) for name, most, sequence in ideas.worth_little(rows)], [("y", 10, "a"), ("x", 0.4, "a")])

    def test_every_result_is_of_an_idea_that_there_is(self):
        rows = releases.numbers("ablation")
        self.assertLessEqual({row["coding"] for row in rows}, {ideas.WHOLE, *ideas.read()})


if __name__ == "__main__":
    unittest.main()
