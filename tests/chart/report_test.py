#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The report of gnomonchart, from results made by hand: medians, winners, sentences, and what stands in its files."""
import csv
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "examples/tools/gnomonchart/report.py"
spec = importlib.util.spec_from_file_location("report", SCRIPT)
report = importlib.util.module_from_spec(spec)
sys.dont_write_bytecode = True
spec.loader.exec_module(report)


def point(kit, technique, setting, ms, px, scene="boxes", text="", bad=False):
    time = {"q1": ms, "median": ms, "q3": ms}
    return {"scene": scene, "kit": kit, "technique": technique, "setting": setting,
            "settings": [["--shadow", text]] if text else [], "failure": "", "catastrophic": bad,
            "cost": {"steadyWallMs": time, "movingWallMs": {**time, "median": 10 * ms}, "steadyProcessorMs": time,
                     "movingProcessorMs": time, "firstMs": "NaN", "memoryMiB": 1, "draws": 2, "passes": 1, "triangles": 3},
            "errors": {"boundaryPixels": {"p95": px, "max": px}, "awayFromEdges": {"misclassified": 0.0, "iou": 1.0},
                       "causes": {"leak": 0, "acne": 7}},
            "prediction": None, "shadedRmse": 0.1, "flickerShare": None, "crawlPixels": None,
            "picture": "a.png", "overlay": "b.png", "notes": []}  # fmt: skip


def results(*points):
    names = dict.fromkeys(each["scene"] for each in points)
    return {"complete": True, "made": [["command", "gnomonchart"], ["renderer", "llvmpipe"]], "points": list(points),
            "scenes": [{"name": name, "title": f"<script>{name}", "triangles": 9, "boundaryFloorPixels": 0.4, "frameMs": 1.0,
                        "misclassifiedFloor": 0.0, "truthPicture": "t.png", "view": [["--light", "1,2,3,0"]]}
                       for name in names]}  # fmt: skip


class Curves(unittest.TestCase):
    def test_pool_scenes_by_their_medians_and_count_a_failure_as_infinitely_far_off(self):
        lost = point("Gnomon", "map", "512", 4, 6, "c")
        lost["failure"] = "It crashed."
        lost["catastrophic"] = True
        points = [point("Gnomon", "map", "512", 2, 4, "a"), point("Gnomon", "map", "512", 4, 6, "b"), lost]
        (pooled,) = report.curves_of(points, "steady")["Gnomon", "map"]
        self.assertEqual((pooled["ms"], pooled["px"], pooled["sound"], pooled["scenes"]), (4, 6, False, 3))
        self.assertEqual(report.curves_of(points, "moving")["Gnomon", "map"][0]["ms"], 40)

    def test_tell_a_technique_as_it_comes_from_its_most_accurate_setting(self):
        points = [point("Gnomon", "map", "fine", 9, 1, text="map:filter=fine"), point("Gnomon", "map", "size 1024", 5, 2, text="map"),
                  point("Gnomon", "map", "wrong", 1, 0.1, text="map:size=1", bad=True)]  # fmt: skip
        plain, best = report.default_and_best(report.curves_of(points, "steady")["Gnomon", "map"])
        self.assertEqual((plain["setting"], best["setting"]), ("size 1024", "fine"))

    def test_take_the_fastest_of_settings_that_are_alike_to_a_hundredth_of_a_pixel_for_the_best(self):
        points = [point("Gnomon", "volume", "relight", 9, 0.401, text="volume"),
                  point("Gnomon", "volume", "blend", 5, 0.404, text="volume:composite=blend")]  # fmt: skip
        plain, best = report.default_and_best(report.curves_of(points, "steady")["Gnomon", "volume"])
        self.assertEqual((plain["setting"], best["setting"]), ("relight", "blend"))

    def test_of_smooth_and_soft_maps_are_settings_of_the_map_in_the_chart(self):
        points = [point("Gnomon", "map", "a", 5, 2, text="map"), point("Gnomon", "map, smooth", "b", 6, 1, text="map:edges=smooth")]
        (settings,) = report.families(report.curves_of(points, "steady")).values()
        self.assertEqual([one["setting"] for one in report.default_and_best(settings)], ["a", "b"])

    def test_find_those_that_none_is_as_fast_and_as_accurate_as(self):
        points = [point("Gnomon", "a", "", 1, 9), point("Gnomon", "b", "", 2, 9), point("Gnomon", "c", "", 3, 3),
                  point("Gnomon", "d", "", 1.5, 1, bad=True), point("Gnomon", "e", "", 4, 2)]  # fmt: skip
        every = [one for settings in report.curves_of(points, "steady").values() for one in settings]
        self.assertEqual([one["technique"] for one in report.front(every)], ["a", "c", "e"])


class Chart(unittest.TestCase):
    def test_names_ten_techniques_at_most_and_says_which_fail(self):
        points = [point("Gnomon", name, "defaults", 2 + i, 1 + i) for i, name in enumerate(report.LOOKS)]
        points += [point("osgShadow", f"Peer {i}", setting, 9 + i, 0.3 + 0.1 * i, bad=True) for i in range(14) for setting in ("defaults", "best")]
        points += [point("osgShadow", "ShadowMap", "defaults", 6, 42), point("osgShadow", "Exact", "best", 70, 0.1)]
        figure = report.chart_figure(results(*points), points, results(*points)["scenes"], "Title")
        for axes in figure.axes:
            names = [text.get_text() for text in axes.texts]
            self.assertEqual(sorted(names), sorted([*report.LOOKS, "ShadowMap", "Exact", "Peer 0"]))
            self.assertLessEqual(len(names), 10)
            self.assertGreaterEqual(min(text.get_fontsize() for text in axes.texts + axes.get_xticklabels()), 9)
        self.assertEqual(figure.axes[0].get_xlim(), figure.axes[1].get_xlim())


class Findings(unittest.TestCase):
    def of(self, *points):
        return report.findings(results(*points))[0]

    def test_say_plainly_where_a_peer_is_better(self):
        ours, peer = point("Gnomon", "map", "a", 5, 4), point("osgShadow", "ShadowMap", "best", 3, 2)
        _, _, wins, leads, sentences = self.of(ours, peer)
        self.assertTrue(wins and leads)
        self.assertIn("osgShadow is better with osgShadow ShadowMap, best (3 ms, 2 px).", sentences)
        self.assertFalse(self.of(ours, point("osgShadow", "ShadowMap", "best", 5, 4))[2])

    def test_tell_a_lead_from_what_runs_differ_by(self):
        for ours, theirs, px, ahead in ((3, 2.01, 2.01, False), (3, 1.99, 2.01, True), (3, 2.01, 1.99, True),
                                        (33, 30.01, 2.01, False), (33, 29.99, 2.01, True)):  # fmt: skip
            found = self.of(point("Gnomon", "map", "", ours, 2.2), point("osgShadow", "ShadowMap", "", theirs, px))
            self.assertEqual(found[2:4], (True, ahead), (theirs, px))

    def test_hold_no_catastrophe_for_a_winner(self):
        found = self.of(point("Gnomon", "map", "", 5, 4), point("osgShadow", "ShadowMap", "", 1, 1, bad=True))
        self.assertFalse(found[2])
        self.assertIn("Fails: osgShadow ShadowMap.", found[4])

    def test_compare_nothing_without_a_peer(self):
        self.assertEqual(report.findings(results(point("Gnomon", "map", "", 1, 1))), [])


class Budgets(unittest.TestCase):
    def test_of_auto_are_held_against_the_best_fixed_setting_that_keeps_them(self):
        rows = report.budgets(results(
            point("Gnomon", "auto", "error 1", 4, 0.9, text="auto"), point("Gnomon", "map", "a", 2, 0.8, text="map"),
            point("Gnomon", "map", "b", 1, 1.2, text="map:size=256"), point("Gnomon", "volume", "c", 3, 0.4, text="volume"),
            point("Gnomon", "map", "d", 0.5, 0.1, text="map:composite=blend")))  # fmt: skip
        self.assertEqual([(row["kept"], row["best"], row["ratio"]) for row in rows], [(True, "map, a", 2.0)] * 2)
        self.assertIn("auto keeps 2 of 2 budgets", report.budgets_text(rows))

    def test_of_an_error_bear_the_rounding_of_its_sum(self):
        (row, _) = report.budgets(results(
            point("Gnomon", "auto", "error 0.4", 4, 0.4 + 6e-15, text="auto:error=0.4"),
            point("Gnomon", "volume", "a", 4, 0.4 + 6e-15, text="volume")))  # fmt: skip
        self.assertEqual((row["kept"], row["best"]), (True, "volume, a"))


class Files(unittest.TestCase):
    def run_on(self, name, content):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        folder = pathlib.Path(kept.name)
        if name:
            (folder / name).write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return folder, subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True, check=False)

    def test_of_a_chart_hold_its_points_and_no_markup_of_a_name(self):
        folder, ended = self.run_on("results.json", results(
            point("Gnomon", "map", "size <1024>", 2, 0.5, text="map"), point("osgShadow", "ShadowMap", "best", 9, 3)))  # fmt: skip
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("boxes: ShadowMap is best with its defaults", ended.stdout)
        page = (folder / "index.html").read_text(encoding="utf-8")
        self.assertIn("&lt;script&gt;boxes", page)
        self.assertNotIn("<script>boxes", page)
        with open(folder / "results.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual((rows[0]["setting"], rows[0]["boundary_p95_px"], rows[0]["added_moving_ms"], rows[0]["acne_px"]),
                         ("size <1024>", "0.5", "20", "7"))  # fmt: skip
        self.assertEqual({path.name for path in folder.iterdir()}, {"results.json", "results.csv", "index.html", "figure.svg",
                         "figure.png", "figure-boxes.svg", "figure-boxes.png"})  # fmt: skip

    def alone(self, *points, made=()):
        """The heads of the columns of the processor alone, the cells below the first of them, and the sentence above."""
        file = results(*points)
        file["made"] += made
        folder, ended = self.run_on("results.json", file)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        page = (folder / "index.html").read_text(encoding="utf-8").split("<h2>All points</h2>")[1]
        heads = re.findall(r"<th[^>]*>(.*?)</th>", page)
        rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr class.*?</tr>", page, re.S)]
        found = [head for head in heads if head.startswith("processor alone")]
        with open(folder / "results.csv", newline="", encoding="utf-8") as csv_file:
            self.assertEqual(next(csv.DictReader(csv_file))["added_steady_alone_ms"], "0.25" if found else "")
        sentence = re.search(r"Processor alone: .*?(?=</span>)", page, re.S)
        return found, [row[heads.index(found[0])] for row in rows if found], sentence and sentence.group()

    def test_of_a_chart_show_the_processor_alone_beside_wall_time(self):
        timed, other = point("Gnomon", "map", "a", 2, 0.5), point("osgShadow", "ShadowMap", "best", 9, 3)
        timed["cost"].update(steadyAloneMs={"q1": 0.1, "median": 0.25, "q3": 9}, movingAloneMs={"q1": 1, "median": 3, "q3": 9})
        other["cost"].update(steadyAloneMs=None, movingAloneMs=None)  # its process ended too soon
        heads, cells, sentence = self.alone(timed, other)
        self.assertEqual(heads, ["processor alone, still light", "processor alone, moving light"])
        self.assertEqual(cells, ["0.25", ""])
        self.assertIn("where pixels cost nothing", sentence)

    def test_of_a_chart_say_once_why_the_processor_alone_was_not_measured(self):
        why = ["processor alone", "not measured: OpenGL is a card."]
        self.assertEqual(self.alone(point("Gnomon", "map", "a", 2, 0.5), made=[why]),
                         ([], [], "Processor alone: not measured: OpenGL is a card."))  # fmt: skip

    def test_of_an_older_chart_are_shown_without_the_processor_alone(self):
        self.assertEqual(self.alone(point("Gnomon", "map", "a", 2, 0.5)), ([], [], None))

    def test_of_a_stability_table_hold_where_each_budget_is_left(self):
        judged = {"p95Pixels": 0.5, "floorPixels": 0.4, "wrong": 0, "turnedAwayWrong": 0, "shadow": 9, "iou": 1.0, "lost": False, "teeth": None}
        good = {"failure": "", "message": "", "everywhere": judged, "onReceiver": None, "inBudget": True, "catastrophe": False, "diagnosis": [],
                "picture": ""}  # fmt: skip
        bad = {**good, "everywhere": {**judged, "wrong": 7, "turnedAwayWrong": 3, "teeth": 5}, "inBudget": False, "diagnosis": ["It cannot be done."]}
        row = {"scene": "T1", "kit": "Gnomon", "technique": "map", "setting": "defaults", "outcome": "stated limit", "reach": 0.5,
               "cells": [good, bad], "flickerShare": None, "crawlPixels": 0.01, "flickerTurnedAwayWrong": 2, "flickerPicture": ""}  # fmt: skip
        scene = {"id": "T1", "section": "tests", "title": "Box", "about": "About.", "parameter": "size", "unit": "m", "values": [1.0, 0.1]}
        folder, ended = self.run_on("stability.json", {"complete": False, "made": [], "scenes": [scene], "rows": [row]})
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("stated limit at 0.1 m: 7 wrong pixels, 5 teeth. It cannot be done.", ended.stdout)
        self.assertIn("Turned away and wrong: 3 px", ended.stdout)
        self.assertIn("The run was interrupted", (folder / "stability.html").read_text(encoding="utf-8"))
        lines = (folder / "stability.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[2], "T1,size,0.1,m,Gnomon,map,defaults,stated limit,,0.5,7,3,9,1.0,5,False,False,It cannot be done.")

    def test_that_are_missing_or_broken_are_refused_in_a_sentence(self):
        _, ended = self.run_on("", "")
        self.assertRegex(ended.stderr, r'^gnomonchart: ".*" holds neither results.json nor stability.json. Name .*\n$')
        _, ended = self.run_on("results.json", '{"points": ')
        self.assertRegex(ended.stderr, r'^gnomonchart: ".*" is damaged: .*\n$')
        self.assertEqual(ended.returncode, 1)


if __name__ == "__main__":
    unittest.main()
