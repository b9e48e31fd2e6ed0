"""Tests of the ledger of sizes: what it complains of, what a renewal keeps, that no renewal goes without a reason."""
# SPDX-License-Identifier: MIT
import contextlib
import io
import json
import os
import subprocess
import tempfile
import unittest

import ledger
import plan

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../build"))
KEY = ("cow", "reel")
PLAN = """measure = "size"
common = {threads = 1, bases = 4, step = 0.01}
coding = [{name = "reel", codec = "reel"}]
sequence = {"made cloth" = {made = {shape = "cloth", vertices = 100, frames = 10}}, nowhere = {}}
"""


def known(made="here"):
    return ledger.Ledger(made, {KEY: (1000, "first"), ("dance", "reel"): (2000, "first")})


class Sizes(unittest.TestCase):
    def test_any_other_size_is_told_where_the_same_machine_made_it(self):
        for size in (999, 1001):
            self.assertEqual(len(ledger.complaints(known(), {KEY: size}, "here")), 1)
        self.assertEqual(ledger.complaints(known(), {KEY: 1000}, "here"), [])

    def test_elsewhere_a_little_may_differ_but_not_more(self):
        self.assertEqual(ledger.complaints(known(), {KEY: 1004}, "there"), [])
        self.assertEqual(ledger.complaints(known(), {KEY: 1006}, "there"), ["cow reel: 1006 bytes, 1000 in the ledger (+0.60 %)"])

    def test_a_codec_that_is_not_in_the_ledger_is_told(self):
        self.assertIn("not in the ledger", ledger.complaints(known(), {("cow", "new"): 7}, "here")[0])

    def test_a_renewal_gives_the_reason_to_what_changed_and_keeps_the_rest(self):
        self.assertEqual(ledger.renewed(known(), {KEY: 900, ("cow", "na"): 5}, "here", "better").sizes,
                         {KEY: (900, "better"), ("cow", "na"): (5, "better"), ("dance", "reel"): (2000, "first")})
        self.assertEqual(ledger.renewed(known(), {KEY: 1000}, "here", "better").sizes, known().sizes)

    def test_a_ledger_made_elsewhere_is_not_renewed_in_part(self):
        with self.assertRaises(ledger.LedgerError):
            ledger.renewed(known("there"), {KEY: 900}, "here", "better")

    def test_without_a_reason_nothing_is_renewed(self):
        for words in (["--renew"], ["--renew", "--reason", " "]):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
                ledger.arguments(words)
            self.assertIn("why do the sizes change?", said.getvalue())


class Runs(unittest.TestCase):
    def run_ledger(self, folder, *words):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            code = ledger.main(["--build", BUILD, "--data", folder, "--plan", f"{folder}/plan.toml", "--ledger", f"{folder}/ledger.csv", *words])
        return code, said.getvalue()

    def test_a_changed_size_fails_until_it_is_renewed(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "plan.toml"), "w", encoding="utf-8") as file:
                file.write(PLAN)
            self.assertEqual(self.run_ledger(folder)[0], 1)
            self.assertEqual(self.run_ledger(folder, "--renew", "--reason", "first, of all")[0], 0)
            code, said = self.run_ledger(folder)
            self.assertEqual((code, said), (0, "nowhere: skipped, its data are not here\n1 sizes are the ledger's, exactly\n"))
            with open(os.path.join(folder, "plan.toml"), "w", encoding="utf-8") as file:
                file.write(PLAN.replace("0.01", "0.02"))
            self.assertEqual(self.run_ledger(folder)[0], 1)
            self.assertEqual(self.run_ledger(folder, "--sequences", "real")[0], ledger.NOTHING_HERE)


class OfTheHouse(unittest.TestCase):
    def test_every_size_of_the_plan_is_in_the_ledger_and_no_other(self):
        rows = {(row.sequence, row.name) for row in plan.load(ledger.PLAN)}
        self.assertEqual(rows, set(ledger.read(ledger.LEDGER).sizes))

    def test_the_plan_has_every_codec(self):
        about = json.loads(subprocess.check_output([os.path.join(BUILD, "meshreel-lab"), "about"], text=True))
        self.assertEqual(set(about["codecs"]), {row.name for row in plan.load(ledger.PLAN)})


if __name__ == "__main__":
    unittest.main()
