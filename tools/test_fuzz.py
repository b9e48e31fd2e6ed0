"""Tests of tools/fuzz.py: what a run's log says, how the ledger adds up, that the page shows the ledger, that a run ends by the processor's clock."""
# SPDX-License-Identifier: MIT
import os
import subprocess
import sys
import tempfile
import unittest

import fuzz

LOG = """INFO: Loaded 1 modules   (95204 inline 8-bit counters): 95204 [0x5565b784e2c0, 0x5565b78656a4),
#2\tINITED cov: 5 ft: 6 corp: 1/1b exec/s: 0 rss: 31Mb
#900\tNEW    cov: 2262 ft: 30 corp: 41/99Kb lim: 4 exec/s: 0 rss: 35Mb L: 2/4 MS: 1 CrossOver-
stat::number_of_executed_units: 1000
"""


class Log(unittest.TestCase):
    def test_runs_edges_and_corpus_are_the_last_that_the_log_says(self):
        row = fuzz.row_of("reel", LOG, 7.46)
        self.assertEqual((row.cpu_seconds, row.runs, row.edges, row.of, row.corpus), (7.5, 1000, 2262, 95204, 41))

    def test_a_log_that_says_nothing_counts_nothing(self):
        self.assertEqual(fuzz.row_of("reel", "", 0).runs, 0)


class Ledger(unittest.TestCase):
    def test_seconds_runs_and_findings_add_up_and_coverage_is_the_newest(self):
        both = fuzz.Row("reel", 10.0, 5, 90, 100, 7, 1, "2026-01-01").plus(fuzz.Row("reel", 2.5, 3, 95, 101, 8, 0, "2026-01-02"))
        self.assertEqual(both, fuzz.Row("reel", 12.5, 8, 95, 101, 8, 1, "2026-01-02"))

    def test_a_run_cut_off_while_it_read_its_corpus_leaves_the_coverage_as_it_was(self):
        run = fuzz.row_of("reel", LOG.replace("INITED", "pulse "), 2.5)
        both = fuzz.Row("reel", 10.0, 5, 90, 100, 7, 0).plus(run)
        self.assertEqual((both.cpu_seconds, both.runs, both.edges, both.of, both.corpus), (12.5, 1005, 90, 100, 7))

    def test_what_is_written_is_read_again(self):
        rows = {"reel": fuzz.Row("reel", 12.5, 8, 95, 101, 8, 1, "2026-01-02"), "coding": fuzz.Row("coding")}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ledger.csv")
            fuzz.write_ledger(rows, path)
            self.assertEqual(fuzz.read_ledger(path), rows)
            self.assertEqual(fuzz.read_ledger(os.path.join(folder, "none")), {})

    def test_every_target_has_its_row_and_no_other_is_there(self):
        self.assertEqual(sorted(fuzz.read_ledger()), fuzz.all_targets())

    def test_the_page_shows_the_ledger(self):
        with open(fuzz.PAGE, encoding="utf-8") as file:
            self.assertIn(fuzz.BEGIN + fuzz.markdown(fuzz.read_ledger()) + fuzz.END, file.read())


class Seconds(unittest.TestCase):
    def test_a_process_is_asked_to_end_when_it_has_used_its_seconds_of_the_processor(self):
        busy = "import signal, sys\nsignal.signal(signal.SIGUSR1, lambda *_: sys.exit(3))\nwhile True: pass"
        process = subprocess.Popen([sys.executable, "-c", busy])
        self.assertGreaterEqual(fuzz.wait(process, 0.3), 0.3)
        self.assertEqual(process.returncode, 3)


if __name__ == "__main__":
    unittest.main()
