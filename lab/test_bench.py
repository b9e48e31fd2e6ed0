"""Tests of plans of curves: what is run in which turn, what is remembered, what the deltas are, what the report shows."""
# SPDX-License-Identifier: MIT
import glob
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest

import bdrate
import bench
import codings
import plan
import race
import report
import verdicts
from journal import Journal, key_of
from peers.peer import Stopwatch

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../build"))
SMALL = """
measure = "curve"
anchor = "Coddyac"
runs = 2
[common]
threads = 1
bases = 4
ladder.step = [0.02, 0.005, 0.001]
[[coding]]
name = "Coddyac"
codec = "coddyac"
[[coding]]
name = "reel"
codec = "reel"
[sequence."made cloth"]
made = {shape = "cloth", vertices = 200, frames = 20}
[sequence.nowhere]
"""


def curve(**more):
    return {"measure": "curve", "sequence": {"a": {}}, "coding": [{"name": "x", "codec": "na", "ladder": {"kg": [1, 0.5]}}], **more}


def peer(name="zip", title="Zip"):
    return types.SimpleNamespace(name=name, title=title, ladder=({"bits": 8}, {"bits": 12}))


class PlansOfCurves(unittest.TestCase):
    def test_a_ladder_gives_a_point_each_with_the_other_settings(self):
        self.assertEqual(plan.curves_of(curve(common={"order": "free"}), "p").codings[0].points,
                         ({"order": "free", "codec": "na", "kg": 1}, {"order": "free", "codec": "na", "kg": 0.5}))

    def test_knobs_of_a_ladder_go_side_by_side(self):
        self.assertEqual(plan.points_of({"ladder": {"step": [1, 2], "bases": [3, 4]}}, "x"), ({"step": 1, "bases": 3}, {"step": 2, "bases": 4}))
        with self.assertRaises(plan.PlanError):
            plan.points_of({"ladder": {"step": [1, 2], "bases": [3]}}, "x")

    def test_peers_bring_their_own_ladders(self):
        found = plan.curves_of(curve(peers=["all"]), "p", [peer()]).codings[1]
        self.assertEqual((found.name, found.peer, found.points), ("Zip", "zip", ({"bits": 8}, {"bits": 12})))

    def test_what_is_not_there_is_an_error(self):
        for wrong in ({"peers": ["zap"]}, {"anchor": "y"}, {"coding": []}, {"runz": 3}, {"measure": "encode"}):
            with self.subTest(wrong), self.assertRaises(plan.PlanError):
                plan.curves_of(curve(**wrong), "p", [peer()])

    @unittest.skipUnless(codings.peers_here(), "numpy is missing")
    def test_every_plan_of_curves_of_the_house_can_be_run(self):
        for path in glob.glob(os.path.join(HERE, "plans/*.toml")):
            if (read := plan.read(path))["measure"] == "curve":
                self.assertTrue(plan.curves_of(read, "p", codings.peers_here()).codings, path)

    def test_a_coding_may_be_of_another_build(self):
        other = plan.curves_of(curve(coding=[{"name": "old", "codec": "na", "kg": 1, "build": "../old"}]), "p").codings[0]
        self.assertEqual((other.build, other.points), ("../old", ({"codec": "na", "kg": 1},)))

    def test_a_first_look_takes_the_ends_of_a_curve(self):
        self.assertEqual(bench.some((1, 2, 3, 4, 5), 3), (1, 3, 5))
        self.assertEqual(bench.some((1, 2), 3), (1, 2))


class Journals(unittest.TestCase):
    def test_a_line_cut_off_in_the_middle_is_forgotten_and_the_next_is_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "journal.jsonl")
            Journal(path).add("one", {"bytes": 1})
            with open(path, "a", encoding="utf-8") as file:
                file.write('{"key": "two", "byt')
            Journal(path).add("three", {"bytes": 3})
            self.assertEqual(Journal(path).records, {"one": {"bytes": 1}, "three": {"bytes": 3}})

    def test_a_key_tells_settings_apart_but_not_their_order(self):
        self.assertEqual(key_of({"a": 1, "b": 2}), key_of({"b": 2, "a": 1}))
        self.assertNotEqual(key_of({"a": 1}), key_of({"a": 1.5}))


class DeltaRates(unittest.TestCase):
    LINE = [(2.0 ** i, 10 * 0.6 ** i) for i in range(6)]  # log rate is linear in dB

    def test_a_curve_against_itself_is_zero(self):
        self.assertAlmostEqual(bdrate.bd_rate(self.LINE, self.LINE)[0], 0, 9)

    def test_so_many_percent_everywhere_are_so_many_percent(self):
        wavy = [(rate * (1 + 0.3 * math.sin(rate)), error) for rate, error in self.LINE]
        delta, share = bdrate.bd_rate(wavy, [(1.3 * rate, error) for rate, error in wavy])
        self.assertAlmostEqual(delta, 30, 9)
        self.assertAlmostEqual(share, 1, 9)

    def test_lines_of_two_slopes_give_the_mean_of_their_distance(self):
        # log10 R = a Q: over 0 .. 60 dB the mean difference of 0.02 Q and 0.01 Q is 0.3.
        line = lambda a: [(10 ** (a * q), 10 ** (-q / 20)) for q in (0, 10, 25, 60)]
        self.assertAlmostEqual(bdrate.bd_rate(line(0.01), line(0.02))[0], 100 * (10 ** 0.3 - 1), 6)

    def test_the_cubics_have_the_slopes_and_the_integral_of_a_parabola(self):
        points = [(0.0, 0.0), (1.0, 1.0), (2.0, 4.0)]
        self.assertEqual(bdrate.slopes_of(*zip(*points)), [0.0, 1.5, 4.0])  # Fritsch and Carlson: 2 * 1 * 3 / (1 + 3) in the middle
        self.assertAlmostEqual(bdrate.integral(points, 0, 2), 8 / 3, 12)
        self.assertAlmostEqual(bdrate.integral(points, 0.3, 1.2) + bdrate.integral(points, 1.2, 1.9), bdrate.integral(points, 0.3, 1.9), 12)

    def test_the_cubics_do_not_overshoot_a_step(self):
        self.assertEqual(bdrate.slopes_of((0, 1, 2, 3), (0, 0, 1, 1)), [0, 0, 0, 0])

    def test_only_the_overlap_counts_and_its_share_is_told(self):
        delta, share = bdrate.bd_rate(self.LINE, [(2 * rate, error) for rate, error in self.LINE[:4]])
        self.assertAlmostEqual(delta, 100, 6)
        self.assertAlmostEqual(share, 3 / 5, 9)

    def test_curves_that_do_not_overlap_are_refused_with_their_ranges(self):
        with self.assertRaisesRegex(bdrate.NoDelta, r"do not overlap: the anchor's errors are 0.778 .. 10, its own 0.00778 .. 0.1"):
            bdrate.bd_rate(self.LINE, [(rate, error / 100) for rate, error in self.LINE])

    def test_too_few_points_are_refused(self):
        with self.assertRaisesRegex(bdrate.NoDelta, "2 usable points on its own curve"):
            bdrate.bd_rate(self.LINE, self.LINE[:2])

    def test_points_that_another_beats_and_lossless_ones_are_left_out(self):
        worse = [*self.LINE, (8.1, 9.9), (1e6, 0.0)]
        self.assertAlmostEqual(bdrate.bd_rate(self.LINE, worse)[0], 0, 9)

    def test_the_mean_over_sequences_is_that_of_the_logarithms(self):
        self.assertAlmostEqual(verdicts.mean_delta([verdicts.Delta(100.0), verdicts.Delta(-50.0), verdicts.Delta(None)]), 0, 9)

    def test_between_two_points_logarithms_are_interpolated(self):
        rows = [{"sequence": "a", "coding": "x", "kg": kg, "bpfv": rate, "encode_mvs": 1.0, "decode_mvs": 9.0} for kg, rate in ((0.01, 4.0), (1, 1.0))]
        self.assertAlmostEqual(verdicts.at_error(rows, "kg", 0.1)["a", "x"][0], 2)


class Scribe:
    """A codec that writes down when it is asked."""
    identity, counts, lossless = "scribe", "nothing", False

    def __init__(self, name, book):
        self.name, self.book, self.decoded = name, book, 0

    def missing(self):
        return ""

    def encode(self, _clip, point, folder):
        if point["bits"] == 13:
            raise codings.CodingError("13 bits bring bad luck")
        self.book.append((self.name, point["bits"]))
        path = os.path.join(folder, "x")
        with open(path, "wb") as file:
            file.write(b"\0" * point["bits"])
        return codings.Files([path], 0.1 * len(self.book))

    def decode(self, files, _point, _folder):
        self.decoded += 1
        return files[0], 3.0 / self.decoded


class Races(unittest.TestCase):
    def run_race(self, folder, book, bits=(8, 9), decodes=1, measures=("kg",)):
        both = tuple(plan.Coding(name, tuple({"bits": n, "of": name} for n in bits)) for name in "ab")
        curves = plan.Curves("p", "p", "a", 3, measures, {"s": {}, "t": {}}, both, decodes)
        about = {"value": 0.5, "title": "an error", "unit": "%", "better": "less"}
        command = types.SimpleNamespace(measuring="c", compare=lambda _clip, _back, names, _order: {name: about for name in names})
        clip = types.SimpleNamespace(name="s", V=2, F=4)
        sequences = types.SimpleNamespace(find=lambda name, _: clip if name == "s" else None, checksums={"s": "1"})
        return race.Race(curves, command, sequences, Journal(os.path.join(folder, "j"))).run({name: Scribe(name, book) for name in "ab"})

    def test_codings_take_turns_and_times_are_the_median(self):
        with tempfile.TemporaryDirectory() as folder:
            book = []
            outcome = self.run_race(folder, book)
            self.assertEqual(book, 3 * [("a", 8), ("a", 9), ("b", 8), ("b", 9)])
            first = outcome.rows[0]
            self.assertEqual((first["bytes"], first["bpfv"], first["runs"], first["encode_s"]), (8, 8.0, 3, 0.5))  # of 0.1, 0.5 and 0.9
            self.assertEqual(outcome.skipped, ["t: its data are not here"])

    def test_the_fastest_of_a_turns_decodings_counts(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual([row["decode_s"] for row in self.run_race(folder, [], bits=(8,), decodes=3).rows], [1 / 2, 1 / 2])  # of 1, 1/2 and 1/3

    def test_what_is_known_is_not_measured_again(self):
        with tempfile.TemporaryDirectory() as folder:
            book = []
            first, again = self.run_race(folder, book), self.run_race(folder, book)
            self.assertEqual(len(book), 12)
            self.assertEqual(first.rows, again.rows)

    def test_another_plans_turns_count_where_they_have_all_that_is_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            book = []
            self.run_race(folder, book)
            more = self.run_race(folder, book, measures=("sted", "kg"))  # the first turn anew
            less = self.run_race(folder, book, measures=("sted",))
            again = self.run_race(folder, book)
            self.assertEqual(len(book), 12 + 4)
            self.assertEqual([(row["sted"], row["kg"]) for row in more.rows], 4 * [(0.5, 0.5)])
            self.assertEqual([["kg" in row, "sted" in row] for row in (less.rows[0], again.rows[0])], [[False, True], [True, False]])
            self.assertEqual(list(less.about), ["sted"])

    def test_a_turn_of_fewer_decodings_does_not_count(self):
        with tempfile.TemporaryDirectory() as folder:
            book = []
            self.run_race(folder, book)
            self.run_race(folder, book, decodes=3)
            self.assertEqual(len(book), 24)

    def test_a_stopwatch_counts_work_not_waiting(self):
        watch = Stopwatch()
        with watch.running():
            time.sleep(0.2)
        self.assertLess(watch.seconds, 0.1)

    def test_a_coding_that_fails_is_told_and_the_others_go_on(self):
        with tempfile.TemporaryDirectory() as folder:
            outcome = self.run_race(folder, [], bits=(8, 13))
            self.assertEqual(len(outcome.rows), 2)
            self.assertIn("s: a, bits 13, of a: 13 bits bring bad luck", outcome.skipped)


class Curves(unittest.TestCase):
    def test_no_two_of_many_curves_look_alike(self):
        try:
            from plots import styles
        except ImportError:
            self.skipTest("matplotlib is not installed")
        looks = [tuple(look.values()) for look in styles([plan.Coding(str(n), (), "a peer") for n in range(100)]).values()]
        self.assertEqual(len(set(looks)), 100)


class WholeRuns(unittest.TestCase):
    """lab/bench.py on a generated animation."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.plan = os.path.join(cls.folder.name, "small.toml")
        with open(cls.plan, "w", encoding="utf-8") as file:
            file.write(SMALL)
        cls.words = [sys.executable, os.path.join(HERE, "bench.py"), cls.plan, "--build", BUILD, "--data", cls.folder.name]
        cls.done = subprocess.run(cls.where("whole"), stderr=subprocess.PIPE, text=True, check=True)
        cls.page = os.path.join(cls.folder.name, "whole/small.html")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def where(cls, name):
        return [*cls.words, "--cache", os.path.join(cls.folder.name, name, "cache"), "--out", os.path.join(cls.folder.name, name)]

    def lines(self, name):
        path = os.path.join(self.folder.name, name, "cache/journal.jsonl")
        if not os.path.exists(path):
            return []
        with open(path, encoding="utf-8") as file:
            return file.readlines()

    def test_a_run_that_was_killed_goes_on_where_it_was(self):
        running = subprocess.Popen(self.where("killed"), stderr=subprocess.DEVNULL)
        while len(self.lines("killed")) < 4 and running.poll() is None:
            time.sleep(0.01)
        running.send_signal(signal.SIGKILL)
        running.wait()
        before = [line for line in self.lines("killed") if line.endswith("\n")]
        self.assertLess(len(before), 12)
        subprocess.run(self.where("killed"), stderr=subprocess.DEVNULL, check=True)
        after = self.lines("killed")
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after), 12)  # 2 codings, 3 points, 2 turns

    def test_sizes_and_errors_are_those_of_the_file_and_of_compare(self):
        command = codings.Command(os.path.join(BUILD, "meshreel"))
        cache = os.path.join(self.folder.name, "whole/cache/made/made_cloth")
        clip = types.SimpleNamespace(motion=f"{cache}/motion.pc2", mesh=f"{cache}/mesh.obj")
        reel, back = (os.path.join(self.folder.name, name) for name in ("a.reel", "a.pc2"))
        command("encode", clip.motion, "--mesh", clip.mesh, reel, "--codec", "reel", "--bases", 4, "--step", 0.005)
        command("decode", reel, back)
        row = next(row for row in self.facts()["rows"] if row["coding"] == "reel" and "0.005" in row["setting"])
        self.assertEqual(row["bytes"], os.path.getsize(reel))
        self.assertEqual(f"{row['sted']:.6g}", f"{command.compare(clip, back, ['sted'], 'keep')['sted']['value']:.6g}")

    def test_another_build_counts_as_the_same_where_it_makes_the_same_files(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = shutil.copy(os.path.join(BUILD, "meshreel"), folder)
            with open(copy, "ab") as file:
                file.write(b"another build")
            one, other, fresh = (codings.Codec(codings.Command(path), [{"codec": codec, "bases": 3}], fresh) for path, codec, fresh in
                                 ((os.path.join(BUILD, "meshreel"), "na", False), (copy, "na", False), (copy, "na", True)))
            self.assertEqual(one.identity, other.identity)
            self.assertNotEqual(one.identity, fresh.identity)
            self.assertNotEqual(one.identity, codings.Codec(one.command, [{"codec": "lsp", "bases": 3}]).identity)

    def test_the_measures_of_one_build_are_told_by_one_name(self):
        one, other = (codings.Command(os.path.join(BUILD, "meshreel")).measuring for _ in range(2))
        self.assertEqual(one, other)

    def facts(self):
        with open(self.page, encoding="utf-8") as file:
            text = file.read()
        return json.loads(text.split('id="facts">')[1].split("</script>")[0])

    def test_the_report_needs_nothing_from_anywhere(self):
        with open(self.page, encoding="utf-8") as file:
            text = file.read()
        for outside in ("src=", "href=", "@import", "url(", "fetch(", "{{"):
            self.assertNotIn(outside, text)
        self.assertIn("nowhere: its data are not here", text)
        self.assertEqual(len(self.facts()["rows"]), 6)

    def test_the_csv_says_what_made_it(self):
        with open(os.path.join(self.folder.name, "whole/small.csv"), encoding="utf-8") as file:
            head = [line for line in file if line.startswith("#")]
        for word in ("plan small", "commit", "compiler", "machine", "meshreel sha256", "made cloth sha256"):
            self.assertTrue(any(line.startswith(f"# {word}") for line in head), word)

    def shown(self, script, place=""):
        """The page in a browser after the script; what it leaves as title."""
        if not shutil.which("chromium"):
            self.skipTest("chromium is not installed")
        copy = os.path.join(self.folder.name, "copy.html")
        with open(self.page, encoding="utf-8") as file, open(copy, "w", encoding="utf-8") as to:
            to.write(file.read().replace("</body>", f"<script>document.title = 'failed'; {script}</script></body>"))
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", f"--user-data-dir={self.folder.name}/browser"]
        done = subprocess.run(["chromium", *options, "--dump-dom", f"file://{copy}{place}"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True, timeout=120)
        return done.stdout.split("<title>")[1].split("</title>")[0]

    def test_the_chart_shows_what_the_address_asks_for(self):
        count = "document.title = document.querySelectorAll('#chart .curve').length + ' ' + document.getElementById('y').value"
        self.assertEqual(self.shown(count), "2 kg")
        self.assertEqual(self.shown(count, "#y=sted&hidden=reel"), "1 sted")

    def test_the_arrow_keys_go_along_a_curve_and_to_the_next(self):
        script = """const press = (key) => chart.dispatchEvent(new KeyboardEvent('keydown', { key }));
            for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown']) press(key);
            document.title = told.textContent.split(':')[0];"""
        self.assertEqual(self.shown(script), "reel, bases 4, step 0.005")

    def test_pointing_at_a_point_shows_its_values(self):
        script = """const frame = chart.getBoundingClientRect(), on = shown[1].points[0];
            chart.dispatchEvent(new PointerEvent('pointermove', { clientX: frame.left + on.x + 3, clientY: frame.top + on.y }));
            document.title = chart.querySelector('.tip b').textContent;"""
        self.assertEqual(self.shown(script), "reel: bases 4, step 0.02")

    def test_the_legend_hides_a_curve_by_a_click(self):
        self.assertEqual(self.shown("legend.children[0].click(); document.title = shown.map((curve) => curve.coding.name).join()"), "reel")


if __name__ == "__main__":
    unittest.main()
