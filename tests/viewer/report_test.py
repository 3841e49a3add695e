#!/usr/bin/env python3
"""What reports hold is what the run's files hold.

    report_test.py UNDINE RUNS           reads the reports themselves
    report_test.py UNDINE RUNS CHROMIUM  opens them in a browser (browser_test.mjs) and compares what it shows

RUNS is the folder that runs.py made.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

import synthetic_run
from page_data import Report

UNDINE, RUNS, CHROMIUM = (sys.argv + [None])[1:4] if len(sys.argv) > 2 else (None, None, None)
HERE = os.path.dirname(os.path.abspath(__file__))
FLAT, SPATIAL, STUDY = (os.path.join(RUNS or "", name) for name in ("flat", "spatial", "study"))


def snapshots(folder):
    with open(os.path.join(folder, "particles.vtkhdf.series"), encoding="utf-8") as file:
        return [(os.path.join(folder, entry["name"]), entry["time"]) for entry in json.load(file)["files"]]


def stored(path):
    """Arrays of a snapshot by name, in order of id."""
    with h5py.File(path) as file:
        data = {name: values[()] for name, values in file["VTKHDF/PointData"].items()}
        data["x"] = file["VTKHDF/Points"][()]
    order = numpy.argsort(data["id"])
    return {name: values[order] for name, values in data.items()}


def report(*words):
    return subprocess.run([UNDINE, "report", *words], capture_output=True, text=True, check=False)


def table(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return rows[0], numpy.array([[float(cell or "nan") for cell in row] for row in rows[1:]])


class Data(unittest.TestCase):
    def test_particles_are_those_of_the_snapshots(self):
        for folder, dimensions in ((FLAT, 2), (SPATIAL, 3)):
            page = Report(os.path.join(folder, "report.html"))
            files = snapshots(folder)
            self.assertEqual(len(page.data["particles"]["frames"]), len(files))
            self.assertFalse(page.data["particles"]["rounded"])
            for k, (path, time) in enumerate(files):
                at, ids, fields = page.frame(k)
                want = stored(path)
                order = numpy.argsort(ids)
                self.assertEqual(at, time)
                numpy.testing.assert_array_equal(ids[order], want["id"])
                numpy.testing.assert_array_equal(fields["x"][order], want["x"][:, :dimensions].astype("f4"))
                numpy.testing.assert_array_equal(fields["v"][order], want["v"][:, :dimensions])
                for name in ("p", "rho", "m"):
                    numpy.testing.assert_array_equal(fields[name][order][:, 0], want[name])

    def test_ranges_are_those_of_the_fluid(self):
        page = Report(os.path.join(FLAT, "report.html"))
        for frame, (path, _) in zip(page.data["particles"]["frames"], snapshots(FLAT)):
            want = stored(path)
            fluid = want["group"] == 0
            pressure, speed = want["p"][fluid], numpy.linalg.norm(want["v"][fluid].astype(float), axis=1)
            for shown, values in ((frame["ranges"]["p"][0], pressure), (frame["ranges"]["v"][0], speed), (frame["ranges"]["v"][2], want["v"][fluid, 1])):
                values, inner = numpy.sort(values.astype(float)), (len(values) - 1) // 100
                numpy.testing.assert_allclose(shown, [values[0], values[-1], values[inner], values[-1 - inner]], rtol=1e-7, atol=1e-12)

    def test_series_are_those_of_the_tables(self):
        page = Report(os.path.join(FLAT, "report.html"))
        gauges = {gauge["name"]: gauge["columns"] for gauge in page.data["gauges"]}
        self.assertIn("front", gauges)
        for columns, path in [(page.data["energies"], "energies.csv"), (page.data["steps"], "steps.csv")] + [
                (columns, f"gauges/{name}.csv") for name, columns in gauges.items()]:
            head, rows = table(os.path.join(FLAT, path))
            self.assertEqual([c["name"] + (f" [{c['unit']}]" if c["unit"] else "") for c in columns], head)
            for column, want in zip(columns, rows.T):
                numpy.testing.assert_array_equal(page.block(column["block"])[:, 0], want)

    def test_steps_name_their_limit_and_count_particles(self):
        head, rows = table(os.path.join(FLAT, "steps.csv"))
        column = {name.split(" ")[0]: rows[:, k] for k, name in enumerate(head)}
        names = Report(os.path.join(FLAT, "report.html")).data["limiters"]
        self.assertEqual(names[int(column["limiter"][-1])], "courant")
        want = stored(snapshots(FLAT)[0][0])
        self.assertTrue((column["fluid"] == numpy.count_nonzero(want["group"] == 0)).all())
        self.assertTrue((column["wall"] == numpy.count_nonzero(want["group"] == 1)).all())

    def test_gauge_is_compared_with_its_reference(self):
        page = Report(os.path.join(FLAT, "report.html"))
        gauge = next(each for each in page.data["gauges"] if each["name"] == "front")
        reference = gauge["reference"]
        times, values = (page.block(reference[key])[:, 0] for key in ("times", "values"))
        numpy.testing.assert_array_equal(times, [0, 0.1, 0.2, 0.3])
        _, rows = table(os.path.join(FLAT, "gauges/front.csv"))
        inside = times <= rows[-1, 0]
        error = numpy.interp(times[inside], rows[:, 0], rows[:, 1]) - values[inside]
        self.assertEqual(reference["points"], inside.sum())
        self.assertAlmostEqual(reference["rms"], numpy.sqrt(numpy.mean(error**2)), 12)

    def test_small_pages_hold_a_sample_and_say_so(self):
        with tempfile.TemporaryDirectory() as folder:
            out, run = os.path.join(folder, "small.html"), os.path.join(folder, "run")
            synthetic_run.write(run, 60_000, times=3)
            done = report(run, "-o", out, "--max-mb", "1")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLessEqual(os.path.getsize(out), 1e6)
            page = Report(out)
            particles = page.data["particles"]
            self.assertTrue(particles["rounded"])
            self.assertTrue(page.data["notes"])
            self.assertLess(particles["shown"], particles["stored"])
            self.assertGreater(os.path.getsize(out), 0.75e6, "the room is used")
            for k, (path, _) in enumerate(snapshots(run)):
                _, ids, fields = page.frame(k)
                if k > 0:
                    numpy.testing.assert_array_equal(ids, same, "the same particles at all times")
                same = ids
                want = stored(path)
                place = numpy.searchsorted(want["id"], ids)
                numpy.testing.assert_array_equal(want["id"][place], ids)
                span = want["p"].max() - want["p"].min()
                numpy.testing.assert_allclose(fields["p"][:, 0], want["p"][place], atol=span / 65534)
            self.assertIn(f"{particles['shown']} of {particles['stored']} particles", "".join(page.data["notes"]))

    def test_study_writes_what_its_members_lack_and_texts_stay_texts(self):
        done = report(STUDY)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = Report(os.path.join(STUDY, "report.html"))
        self.assertNotIn("<script>alert", page.text)
        members = page.data["study"]["members"]
        self.assertEqual([member["report"] for member in members], ["spacing_0.1/report.html", "spacing_0.05/report.html", None])
        self.assertTrue(os.path.exists(os.path.join(STUDY, "spacing_0.05/report.html")))

    def test_page_asks_the_network_for_nothing(self):
        with open(os.path.join(HERE, "..", "..", "viewer", "dist", "page.html"), encoding="utf-8") as file:
            text = file.read()
        for attribute in ("src=\"http", "href=\"http", "@import", "url(http", "src=\"/", "href=\"/"):
            self.assertNotIn(attribute, text)

    def test_what_is_no_run_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for word, text in ((folder, "no run.json"), (os.path.join(folder, "none"), "no such folder")):
                done = report(word)
                self.assertEqual(done.returncode, 2)
                self.assertIn(text, done.stderr)
            for contents, text in (("[1]", "not the record of a study"), ("{", "not JSON"), ('{"members": 3}', "'members' is not a list")):
                with open(os.path.join(folder, "study.json"), "w", encoding="utf-8") as file:
                    file.write(contents)
                done = report(folder)
                self.assertEqual(done.returncode, 2, contents)
                self.assertIn(text, done.stderr)

    def test_failing_report_leaves_the_run_good(self):
        with tempfile.TemporaryDirectory() as folder:
            case = os.path.join(HERE, "..", "..", "cases", "dam_break_2d.toml")
            out = os.path.join(folder, "run")
            os.makedirs(out)
            with open(os.path.join(out, ".undine"), "w", encoding="utf-8"):
                pass
            os.makedirs(os.path.join(out, "report.html"))  # so that no file can take its place
            done = subprocess.run([UNDINE, "run", case, "--out", out, "--overwrite", "--threads", "1", "--set", "spacing=0.1", "--set", "time.end=0.01"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("no report was written", done.stderr)


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        report(STUDY)
        cls.out = os.path.join(RUNS, "browser")
        os.makedirs(cls.out, exist_ok=True)
        files = snapshots(FLAT)
        cls.last = stored(files[-1][0])
        cls.all = [stored(path) for path, _ in files]
        cls.id = int(cls.last["id"][cls.last["group"] == 0][17])
        plan = {"flat": os.path.join(FLAT, "report.html"), "spatial": os.path.join(SPATIAL, "report.html"),
                "study": os.path.join(STUDY, "report.html"), "id": cls.id, "times": [time for _, time in files]}
        path = os.path.join(cls.out, "plan.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(plan, file)
        done = subprocess.run(["node", os.path.join(HERE, "browser_test.mjs"), CHROMIUM, path, cls.out], capture_output=True, text=True, timeout=800, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        with open(os.path.join(cls.out, "readings.json"), encoding="utf-8") as file:
            cls.readings = json.load(file)

    def range_of(self, values):
        return [min(values(frame).min() for frame in self.all), max(values(frame).max() for frame in self.all)]

    def check_legend(self, name, want):
        legend = self.readings[name]
        numpy.testing.assert_allclose([legend["low"], legend["high"]], want, rtol=1e-6, atol=1e-12)

    def test_legend_shows_the_range_that_is_stored(self):
        fluid = lambda frame: frame["group"] == 0
        self.check_legend("first", self.range_of(lambda frame: numpy.linalg.norm(frame["v"][fluid(frame)].astype(float), axis=1)))
        self.check_legend("pressure", self.range_of(lambda frame: frame["p"][fluid(frame)]))
        pressure = self.last["p"][self.last["group"] == 0]
        self.check_legend("pressureNow", [pressure.min(), pressure.max()])
        hundredth = lambda frame: numpy.sort(frame["p"][fluid(frame)])[[(fluid(frame).sum() - 1) // 100, -1 - (fluid(frame).sum() - 1) // 100]]
        self.check_legend("pressureInner", self.range_of(hundredth))
        self.assertIn("pressure p [Pa]", self.readings["pressure"]["text"])
        self.assertIn(f"{pressure.max():.4g}", self.readings["pressureNow"]["text"])

    def test_signed_colours_have_zero_in_their_middle(self):
        low, high = self.range_of(lambda frame: frame["v"][frame["group"] == 0, 0])
        most = max(-low, high)
        self.check_legend("signed", [-most, most])
        self.check_legend("typed", [-1, 2])

    def test_values_of_a_particle_are_those_stored(self):
        row = int(numpy.flatnonzero(self.last["id"] == self.id)[0])
        shown = self.readings["particle"]
        for name, want in (("p", [self.last["p"][row]]), ("rho", [self.last["rho"][row]]), ("v", self.last["v"][row, :2]), ("x", self.last["x"][row, :2].astype("f4"))):
            numpy.testing.assert_array_equal(numpy.array(shown[name]["values"], "f4"), numpy.array(want, "f4"))
        self.assertIn(f"{self.last['rho'][row]:.6g}", shown["rho"]["text"])

    def test_charts_and_title(self):
        for title in ("Energies", "Residual of the energy audit", "Step size", "What limits the step", "Particles", "front: front"):
            self.assertIn(title, self.readings["charts"])
        self.assertEqual(self.readings["title"], "Dam break, 2-D · Undine")

    def test_study_shows_members_verdicts_links_and_orders(self):
        self.assertEqual(self.readings["rows"], 3)
        self.assertEqual(self.readings["links"], ["spacing_0.1/report.html", "spacing_0.05/report.html"])
        self.assertEqual(self.readings["verdicts"], 6)  # of two members: a verdict, and two comparisons with what was published
        self.assertEqual(self.readings["studyCharts"], ["rms against spacing", "rms against cost"])
        self.assertEqual(self.readings["orderLines"], ["order 2"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Browser" if CHROMIUM else "Data"], verbosity=2)
