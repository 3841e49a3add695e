#!/usr/bin/env python3
"""Pictures and movies of `undine picture`.

    picture_test.py UNDINE RUNS

RUNS is the folder that runs.py made.
"""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

UNDINE, RUNS = sys.argv[1:3] if len(sys.argv) > 2 else (None, None)


def picture(*words, **more):
    return subprocess.run([UNDINE, "picture", *words], capture_output=True, text=True, check=False, **more)


def contents(path):
    with open(path, "rb") as file:
        return file.read()


def size(path):
    data = contents(path)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


class Picture(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.flat, self.spatial = os.path.join(RUNS, "flat"), os.path.join(RUNS, "spatial")

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def draw(self, name, *words, **more):
        done = picture(*words, "-o", self.path(name), "--size", "480x270", **more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return contents(self.path(name))

    def test_same_words_same_bytes_for_any_threads(self):
        one = self.draw("a.png", self.spatial, env={**os.environ, "OMP_NUM_THREADS": "1"})
        three = self.draw("b.png", self.spatial, env={**os.environ, "OMP_NUM_THREADS": "3", "DISPLAY": ""})
        self.assertEqual(one, three)
        self.assertEqual(size(self.path("a.png")), (480, 270))

    def test_every_choice_shows(self):
        seen = {self.draw("a.png", self.spatial)}
        for k, words in enumerate((["--colour", "pressure"], ["--map", "inferno"], ["--time", "0"], ["--walls", "hidden"], ["--walls", "grey"], ["--walls", "coloured"],
                                   ["--cut", "y>0.4"], ["--range", "0", "9"], ["--inner"], ["--azimuth", "60"], ["--elevation", "70"], ["--zoom", "2"],
                                   ["--orthographic"], ["--title", "Other"])):
            seen.add(self.draw("b.png", self.spatial, *words))
            self.assertEqual(len(seen), k + 2, words)

    def test_nearest_time_is_drawn_and_said(self):
        done = picture(self.flat, "-o", self.path("a.png"), "--time", "0.104")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("t = 0.10", done.stdout)

    def test_movie(self):
        if not shutil.which("ffprobe"):
            self.skipTest("ffmpeg is missing")
        done = picture(self.flat, "--movie", self.path("a.mp4"), "--size", "320x180", "--rate", "4")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames", "-of", "csv=p=0", self.path("a.mp4")],
                              capture_output=True, text=True, check=True).stdout.strip()
        self.assertEqual(told, "320,180,7")

    def test_without_ffmpeg_numbered_pictures(self):
        done = picture(self.flat, "--movie", self.path("b.mp4"), "--size", "320x180", env={"PATH": self.folder.name})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no ffmpeg", done.stdout)
        names = sorted(os.listdir(self.path("b")))
        self.assertEqual(names, [f"{k:06}.png" for k in range(7)])
        self.assertEqual(size(os.path.join(self.path("b"), names[0])), (320, 180))

    def test_bad_words_are_refused(self):
        for words, text in ((["--colour", "presure"], "did you mean 'p"), (["--map", "jet"], "colour maps are viridis"), (["--cut", "w>1"], "'w>1' is no cut"),
                            (["--size", "481x270"], "two even numbers"), (["--range", "2", "1"], "the lower number first")):
            done = picture(self.flat, "-o", self.path("a.png"), *words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(text, done.stderr)
        self.assertEqual(picture(self.flat).returncode, 2)
        self.assertEqual(picture(self.folder.name, "-o", self.path("a.png")).returncode, 2)
        self.assertFalse(os.path.exists(self.path("a.png")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
