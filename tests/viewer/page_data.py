"""Reads what a report holds, or `undine view` sends, as the page does, without a browser."""

import base64
import json
import re
import zlib

import numpy

TYPES = {"f32": "<f4", "f64": "<f8", "i32": "<i4", "u16": "<u2"}


class Blocks:
    """JSON with its blocks of numbers."""

    def __init__(self, data, texts):
        self.data, self.texts = data, texts

    def block(self, number):
        """As decode() in viewer/src/data.ts; rows of components."""
        info = self.data["blocks"][number]
        shape = (info["count"], info["components"])
        if "constant" in info:
            row = [float("nan") if value is None else value for value in info["constant"]]
            return numpy.broadcast_to(numpy.array(row), shape)
        stored = numpy.dtype(TYPES[info["type"]])
        raw = numpy.frombuffer(zlib.decompress(base64.b64decode(self.texts[number])), numpy.uint8)
        values = raw.reshape(stored.itemsize, -1).T.copy().view(stored).reshape(shape)
        if info["type"] != "u16":
            return values
        low, high = numpy.array(info["low"]), numpy.array(info["high"])
        return numpy.where(values == 65535, numpy.nan, low + (high - low) * values / 65534)

    def particles(self, frame):
        """ids, and positions and fields by name, of the particles of a frame, groups one after the other."""
        join = lambda numbers: numpy.concatenate([self.block(number) for number in numbers])
        parts = frame["parts"]
        fields = {name: join([part["fields"][name] for part in parts]) for name in parts[0]["fields"]}
        fields["x"] = join([part["x"] for part in parts])
        return join([part["ids"] for part in parts])[:, 0], fields


class Report(Blocks):
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        data = re.search(r'<script type="application/json" id="undine-data">(.*?)</script>', self.text, re.S).group(1)
        texts = re.findall(r'<script type="text/plain" id="b(\d+)">([^<]*)</script>', self.text)
        super().__init__(json.loads(data), {int(number): text for number, text in texts})

    def frame(self, k):
        frame = self.data["particles"]["frames"][k]
        return frame["time"], *self.particles(frame)
