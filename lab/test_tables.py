"""Tests of the tables that come from lab/results: a column a release, pages that are what the results say."""
# SPDX-License-Identifier: MIT
import os
import tempfile
import unittest

import releases
import tables
import take


def rate(release, sequence, rates):
    return [{"release": release, "sequence": sequence, "measure": measure, "asked": asked, "bpfv": str(bpfv)}
            for (measure, asked, _), bpfv in zip(tables.TARGETS, rates)]


ROWS = [*rate("0.2.0", "cow", (0.4, 0.96, 0.5)), *rate("0.1.0", "cow", (0.5, 1.2, 0.6))]


class Releases(unittest.TestCase):
    def test_they_are_the_headings_of_the_changelog(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "CHANGELOG.md")
            with open(path, "w", encoding="utf-8") as file:
                file.write("# Changelog\n\n## Unreleased\n\n- x\n\n## 0.1.0 - 2026-11-23\n")
            self.assertEqual(releases.releases(path), ["Unreleased", "0.1.0"])

    def test_measuring_renews_the_newest_release_and_leaves_the_others(self):
        old = [{"release": "2", "sequence": "a", "bytes": "5"}, {"release": "2", "sequence": "b", "bytes": "6"}, {"release": "1", "sequence": "a", "bytes": "9"}]
        new = releases.renewed(old, [{"sequence": "a", "bytes": "4"}], ["2", "1"], ["sequence"])
        self.assertEqual([tuple(row.values()) for row in new], [("2", "a", "4"), ("2", "b", "6"), ("1", "a", "9")])

    def test_what_was_unreleased_gives_way_to_the_release_that_it_became(self):
        new = releases.renewed([{"release": "Unreleased", "sequence": "a"}], [{"sequence": "a"}], ["0.1.0"], ["sequence"])
        self.assertEqual(new, [{"release": "0.1.0", "sequence": "a"}])


class Tables(unittest.TestCase):
    def test_the_result_table_has_a_column_for_each_earlier_release(self):
        self.assertEqual(tables.result_table(ROWS, ["0.2.0", "0.1.0"]),
                         ["| sequence | KG 0.5 % | KG 0.1 % | STED 0.03 | at KG 0.1 % of float32 | 0.1.0, KG 0.1 % |", "|---|---|---|---|---|---|",
                          "| cow | 0.400 | 0.960 | 0.500 | 1 : 100 | 1.200 |"])

    def test_rates_by_release_stand_side_by_side(self):
        self.assertEqual(tables.release_table(ROWS, ["0.2.0", "0.1.0"])[3], "| cow | KG 0.5 % | 0.4000 | 0.5000 |")

    def test_speeds_by_release_stand_side_by_side(self):
        rows = [{"release": release, "sequence": "cow", "encode": e, "decode": d} for release, e, d in (("2", "4", "40"), ("1", "3", "30"))]
        self.assertEqual(tables.speed_releases(rows, ["2", "1"])[2], "| cow | 4 | 3 | 40 | 30 |")

    def test_what_is_not_measured_is_told_by_its_lesser_part(self):
        rows = [{"coding": coding, "sequence": sequence} for coding, sequence in ("aX", "aY", "bY", "cY", "aZ", "bZ")]
        self.assertEqual(tables.lacking(rows, "abcd", "WXYZ"), ["d", "W", "all but a on X", "c on Z"])

    def test_what_stands_between_the_comments_is_replaced_and_nothing_else(self):
        page = "before\n<!-- made by lab/tables.py: x -->\nold\n<!-- end -->\nafter\n"
        once = tables.filled(page, {"x": lambda: ["| new |"]})
        self.assertEqual(once, "before\n<!-- made by lab/tables.py: x -->\n\n| new |\n\n<!-- end -->\nafter\n")
        self.assertEqual(tables.filled(once, {"x": lambda: ["| new |"]}), once)

    def test_the_pages_of_the_house_are_what_the_results_say(self):
        for page, makers in tables.TABLES.items():
            with open(os.path.join(tables.ROOT, page), encoding="utf-8") as file:
                text = file.read()
            self.assertEqual(text, tables.filled(text, makers), f"{page} is stale: lab/tables.py")
            self.assertIn("made by lab/tables.py", text)


class Takes(unittest.TestCase):
    def test_what_the_benches_print_is_read(self):
        line = "dance            7061   201   45     4.65       82    196    184    186  0.2354   18.0   18.6   +8.0    9.3    9.8"
        found = take.player(["codec reel, 2 threads", line], "--kg 0.09")
        self.assertEqual([(row["sequence"], row["options"], row["fast_more"], row["one"]) for row in found], [("dance", "--kg 0.09", "8.0", "186")])
        self.assertEqual(take.measures(["walker: V 4, T 4, F 4", "  plain pass           1.25 ms     1.00 x   (0.5)"], ""),
                         [{"measure": "plain pass", "ms": "1.25", "passes": "1.0"}])
        self.assertEqual(take.scale(["| shape | V |", "|---|---|", "| cloth | 7 |"], ""), [{"shape": "cloth", "V": "7"}])

    def test_a_csv_file_of_speeds_is_read_and_rounded(self):
        head, row = ",".join(take.SPEEDS.values()), "cow,1,2,3," + ",".join(["4.567"] * 9)
        found = take.speeds([head, row], "")[0]
        self.assertEqual((found["sequence"], found["encode"], found["decode"], found["pca_s"]), ("cow", "4.6", "5", "4.57"))


if __name__ == "__main__":
    unittest.main()
