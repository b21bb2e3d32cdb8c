# SPDX-License-Identifier: MIT
"""index.html of gnomonchart in a real browser, without network: sorted, filtered, a point opened.

report_page_test.py SYNTHETIC_REPORT FOLDER: the program that makes the report, and where the report and screenshots go.
What is expected comes from results.json, read here.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
P95 = "boundary error, 95th percentile"
ADDED = "added, still light"


def needed(*names):
    """The path of the first program that is there."""
    for name in names:
        if shutil.which(name):
            return shutil.which(name)
    raise RuntimeError(f"{names[0]} is missing: scripts/install-packages test installs it.")


def browser(profile):
    options = webdriver.ChromeOptions()
    options.binary_location = needed("chromium", "google-chrome")
    for argument in ("headless=new", "no-sandbox", "disable-gpu", "disable-dev-shm-usage", "hide-scrollbars",
                     "window-size=1500,1000", f"user-data-dir={profile}", "host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument("--" + argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(needed("chromedriver")), options=options)


def p95(point):
    errors = point["errors"]
    return errors["boundaryPixels"]["p95"] if errors and errors["boundaryPixels"] else None


def added(point):
    return point["cost"]["steadyWallMs"]["median"] if point["cost"] else None


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        subprocess.run([PROGRAM, str(FOLDER)], check=True)
        cls.results = json.loads((FOLDER / "results.json").read_text(encoding="utf-8"))
        cls.points = cls.results["points"]
        cls.alone = tempfile.TemporaryDirectory()  # the page without the files that were beside it
        shutil.copy(FOLDER / "index.html", cls.alone.name)
        cls.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.driver = browser(cls.profile.name)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.profile.cleanup()
        cls.alone.cleanup()

    def setUp(self):
        self.driver.get(pathlib.Path(self.alone.name, "index.html").as_uri())

    # What the page shows ---------------------------------------------------------------------------------------------

    def script(self, text, *arguments):
        return self.driver.execute_script("return " + text, *arguments)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def rows(self):
        """Numbers of the points that the table shows, from its top."""
        return self.script("[...document.querySelectorAll('#table tbody tr[data-number]')]"
                           ".map(row => Number(row.dataset.number))")

    def column(self, title):
        """The heading of that title, and the texts below it."""
        headings = self.driver.find_elements(By.CSS_SELECTOR, "#table thead th")
        place = [heading.text.replace("\n", " ").rsplit(" ", 1)[0] for heading in headings].index(title)
        texts = self.script("[...document.querySelectorAll('#table tbody tr')].map(row => row.cells[arguments[0]].innerText)",
                            place)
        return headings[place], texts

    def open(self, number):
        self.one(f"#table tr[data-number='{number}']").click()

    def number(self, **wanted):
        """The number of the first point that is as told."""
        return next(i for i, point in enumerate(self.points) if all(point[k] == v for k, v in wanted.items()))

    def shown_scenes(self):
        return self.script("[...new Set([...document.querySelectorAll('#figures figure')].filter(f => !f.hidden)"
                           ".map(f => f.dataset.scene))]")

    # Tests -----------------------------------------------------------------------------------------------------------

    def test_it_is_one_file_that_asks_nothing_of_the_network(self):
        self.assertEqual(self.script("performance.getEntriesByType('resource').map(e => e.name)"
                                     ".filter(name => !name.startsWith('data:'))"), [])
        self.assertEqual([entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"], [])
        self.driver.save_screenshot(str(FOLDER / "screenshot-top.png"))

    def test_the_table_holds_every_point(self):
        self.assertEqual(self.rows(), list(range(len(self.points))))
        self.assertEqual(self.one(".dataTables_info").text, f"{len(self.points)} points")

    def test_a_click_on_a_heading_sorts_and_what_does_not_exist_stays_last(self):
        for title, value in ((P95, p95), (ADDED, added)):
            missing = [i for i, point in enumerate(self.points) if value(point) is None]
            self.assertGreater(len(missing), 0)
            for way in (1, -1):
                self.column(title)[0].click()
                values = [value(self.points[i]) for i in self.rows()]
                there = [v for v in values if v is not None]
                self.assertEqual(there, sorted(there, reverse=way < 0), f"{title} {way}")
                self.assertEqual(values[len(there):], [None] * len(missing))
                self.assertEqual(self.column(title)[1][-1], "–")

    def test_the_stability_table_too_has_what_does_not_exist_last(self):
        self.driver.get((FOLDER / "stability.html").as_uri())
        for expected in (["2", "5", "–"], ["5", "2", "–"]):
            self.column("p95 where left")[0].click()
            self.assertEqual(self.column("p95 where left")[1], expected)
        self.assertEqual([entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"], [])

    def test_numbers_are_those_of_the_results(self):
        texts = self.column(P95)[1]
        for text, point in zip(texts, self.points):
            if p95(point) is not None:
                self.assertAlmostEqual(float(text), p95(point), delta=0.005 * p95(point))  # three digits

    def test_it_filters_by_scene_kit_and_catastrophe(self):
        Select(self.one("#filters [data-column=scene]")).select_by_value("tree")
        Select(self.one("#filters [data-column=kit]")).select_by_value("osgShadow")
        wanted = [i for i, p in enumerate(self.points) if p["scene"] == "tree" and p["kit"] == "osgShadow"]
        self.assertEqual(self.rows(), wanted)
        self.one("#sound").click()
        sound = [i for i in wanted if not self.points[i]["catastrophic"]]
        self.assertLess(len(sound), len(wanted))
        self.assertEqual(self.rows(), sound)
        self.script("document.getElementById('points').scrollIntoView()")
        self.driver.save_screenshot(str(FOLDER / "screenshot-table.png"))
        self.one("#reset").click()
        self.assertEqual(len(self.rows()), len(self.points))

    def test_it_searches_words(self):
        self.one(".dataTables_filter input").send_keys("bicubic 2048")
        self.assertEqual(self.rows(), [i for i, p in enumerate(self.points)
                                       if p["technique"] == "map bicubic" and p["setting"] == "size 2048"])

    def test_a_row_opens_picture_truth_and_errors_side_by_side(self):
        number = self.number(scene="town", technique="ShadowMap", setting="size 1024")
        self.open(number)
        self.assertEqual(self.one("#point-title").text, "osgShadow ShadowMap, size 1024: Flat town of 400 boxes")
        colours, places = [], []
        for name in ("picture", "truth", "overlay"):
            image = self.one(f"#point-{name} img")
            places.append(image.rect)
            colours.append(self.script(
                "(image => { const c = document.createElement('canvas').getContext('2d');"
                " c.drawImage(image, 0, 0); return [image.naturalWidth, ...c.getImageData(5, 5, 1, 1).data]; })"
                "(arguments[0])", image))
        self.assertEqual(colours, [[120, 200, 0, 0, 255], [120, 0, 200, 0, 255], [120, 0, 0, 200, 255]])
        self.assertEqual(len({place["y"] for place in places}), 1)
        for left, right in zip(places, places[1:]):
            self.assertGreaterEqual(right["x"], left["x"] + left["width"])
        numbers = self.one("#point-numbers").text
        self.assertIn(f"{P95} {float('%.3g' % p95(self.points[number])):g} px", numbers)
        self.assertIn(f"acne {self.points[number]['errors']['causes']['acne']} px", numbers)
        self.assertIn("size 1024", numbers)
        self.driver.save_screenshot(str(FOLDER / "screenshot-point.png"))
        self.one("#close").click()
        self.assertFalse(self.one("#point").is_displayed())

    def test_the_keyboard_opens_and_closes_a_point(self):
        self.one("#table tr[data-number='3']").send_keys(Keys.ENTER)
        self.assertTrue(self.one("#point").is_displayed())
        self.one("#close").send_keys(Keys.ESCAPE)
        self.assertFalse(self.one("#point").is_displayed())

    def test_a_failed_point_says_so_and_has_no_picture(self):
        number = self.number(scene="room", technique="ShadowTexture")
        self.open(number)
        self.assertEqual(self.one("#point-bad").text, "Catastrophic: " + self.points[number]["failure"])
        self.assertEqual(self.one("#point-picture").text, "no picture")
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "#point-truth img")), 1)

    def test_next_and_previous_follow_the_table_as_it_is_sorted(self):
        self.column(P95)[0].click()
        order = self.rows()
        self.open(order[4])
        for button, expected in (("next", order[5]), ("next", order[6]), ("previous", order[5])):
            self.one(f"#{button}").click()
            self.assertTrue(self.driver.current_url.endswith(f"#point-{expected}"))

    def test_an_address_with_a_point_opens_it(self):
        self.driver.get("about:blank")
        self.driver.get(pathlib.Path(self.alone.name, "index.html").as_uri() + "#point-7")
        point = self.points[7]
        self.assertIn(f"{point['technique']}, {point['setting']}", self.one("#point-title").text)

    def test_markup_in_names_stays_text(self):
        title = next(scene["title"] for scene in self.results["scenes"] if scene["name"] == "room")
        self.assertIn("<script>", title)
        self.assertIn(title, [option.get_attribute("text") for option in Select(self.one("#scene")).options])
        Select(self.one("#scene")).select_by_value("room")
        self.assertIn(title, self.one("#figure-room svg").get_attribute("textContent"))
        self.open(self.number(scene="room", technique="ShadowTexture"))
        self.assertIn(title, self.one("#point-title").text)
        self.open_details()
        self.assertIn(title, self.one("#findings").get_attribute("textContent"))
        self.assertEqual(self.driver.title, "gnomonchart: how fast and how wrong shadows are")
        self.assertEqual(len(self.driver.find_elements(By.TAG_NAME, "script")), 4)  # data, jQuery, DataTables, ours
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, "#point b, #table b, #findings b"), [])

    def open_details(self):
        self.script("document.querySelector('#findings details').open = true")

    def test_the_words_say_where_a_peer_wins(self):
        self.assertIn("In 1 of 10 cases", self.one("#findings .summary").text)
        self.open_details()
        marks = self.driver.find_elements(By.CSS_SELECTOR, "#findings .peer")
        self.assertEqual([mark.text for mark in marks], ["a peer wins"])
        self.assertIn("MinimalShadowMap, size 4096 (0.2 ms, 0.43 px)", self.one("#findings").text)

    def test_each_scene_has_its_figures(self):
        self.assertEqual(self.shown_scenes(), [""])
        Select(self.one("#scene")).select_by_value("hills")
        self.assertEqual(self.shown_scenes(), ["hills"])
        self.assertTrue(self.one("#figure-hills svg").is_displayed() and self.one("#causes-hills svg").is_displayed())

    def click_marker(self, figure, technique, setting):
        marker = self.one(f"#{figure} .point[data-technique='{technique}'][data-setting='{setting}']")
        self.script("arguments[0].dispatchEvent(new MouseEvent('click', {bubbles: true}))", marker)

    def test_a_marker_of_a_scene_opens_its_point(self):
        Select(self.one("#scene")).select_by_value("hills")
        self.click_marker("figure-hills", "map", "size 2048")
        self.assertEqual(self.one("#point-title").text, "Gnomon map, size 2048: Terrain of 200,000 triangles")

    def test_a_marker_of_all_scenes_shows_its_points_in_the_table(self):
        self.click_marker("figure", "map", "size 2048")
        self.assertEqual(self.rows(), [i for i, p in enumerate(self.points)
                                       if p["technique"] == "map" and p["setting"] == "size 2048"])

    def test_it_explains_the_metrics(self):
        text = self.one("#metrics").text
        for word in ("Boundary error", "peter-panning", "Flicker energy", "Catastrophes"):
            self.assertIn(word, text)
        self.assertGreater(len(self.driver.find_elements(By.CSS_SELECTOR, "#metrics td")), 10)
        for number in self.driver.find_elements(By.CSS_SELECTOR, "#metrics *"):
            self.assertNotIn("**", number.text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
