#!/usr/bin/python3
"""Reads a snapshot with VTK's own reader and with h5py, prints what it holds, and fails where the two differ.

Usage: /usr/bin/python3 read_snapshot.py FILE
Exit codes: 0 the readers agree, 1 they do not, 2 the file cannot be read.
"""
import sys

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOHDF import vtkHDFReader

VTK_VERTEX = 1


def read_with_vtk(path):
    """Points, point fields, field data, cell types and point numbers, by name; raises OSError on any complaint."""
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)
    reader = vtkHDFReader()
    if not reader.CanReadFile(path):
        raise OSError("vtkHDFReader does not take this file for its own")
    reader.SetFileName(path)
    reader.Update()
    if messages.GetOutput():
        raise OSError(messages.GetOutput().strip())
    grid = reader.GetOutput()
    points = grid.GetPoints()
    cells = grid.GetCells()
    types = grid.GetCellTypesArray()
    read = {
        "points": vtk_to_numpy(points.GetData()) if points else np.empty((0, 3)),
        "fields": arrays(grid.GetPointData()),
        "field data": arrays(grid.GetFieldData()),
        "types": vtk_to_numpy(types) if types else np.empty(0),
        "connectivity": vtk_to_numpy(cells.GetConnectivityArray()) if cells else np.empty(0),
    }
    return {key: value.copy() if isinstance(value, np.ndarray) else value for key, value in read.items()}


def arrays(attributes):
    return {
        attributes.GetArrayName(k): vtk_to_numpy(attributes.GetArray(k)).copy()
        for k in range(attributes.GetNumberOfArrays())
    }


def read_with_h5py(path):
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        return {
            "points": root["Points"][()],
            "fields": {name: data[()] for name, data in root["PointData"].items()},
            "field data": {name: data[()] for name, data in root["FieldData"].items()},
            "types": root["Types"][()],
            "connectivity": root["Connectivity"][()],
            "units": {name: text(data.attrs.get("unit", b"")) for name, data in root["PointData"].items()},
            "attributes": {name: value for name, value in root.attrs.items()},
        }


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def same(a, b):
    return a.shape == b.shape and a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def mismatches(vtk, raw):
    found = []
    count = len(raw["points"])
    if count > 0 and not same(vtk["points"], raw["points"]):
        found.append("points differ")
    for group in ("fields", "field data") if count > 0 else ("field data",):  # VTK drops the arrays of no points
        if set(vtk[group]) != set(raw[group]):
            found.append(f"{group}: VTK names {sorted(vtk[group])}, h5py {sorted(raw[group])}")
        found += [f"{name} differs" for name in set(vtk[group]) & set(raw[group])
                  if not same(vtk[group][name], raw[group][name])]
    for reader, data in (("VTK", vtk), ("h5py", raw)):
        if not np.array_equal(data["types"], np.full(count, VTK_VERTEX)):
            found.append(f"{reader}: not one vertex per particle")
        if not np.array_equal(data["connectivity"], np.arange(count)):
            found.append(f"{reader}: the vertices do not count the particles")
    if raw["field data"]["TimeValue"][0] != raw["attributes"]["time"]:
        found.append("the time in FieldData is not the time of the attribute")
    return found


def describe(raw):
    attributes = raw["attributes"]
    count = len(raw["points"])
    print(f"program    {text(attributes['program'])} {text(attributes['program_version'])}")
    print(f"time       {attributes['time']} s, step {attributes['step']}")
    print(f"particles  {count} in {attributes['dimensions']} dimensions")
    if count == 0:
        return
    bounds = [f"[{low:g}, {high:g}]" for low, high in zip(raw["points"].min(axis=0), raw["points"].max(axis=0))]
    print(f"bounds     {' x '.join(bounds)}")
    for name, values in raw["fields"].items():
        unit = raw["units"][name]
        print(f"field      {name}{f' [{unit}]' if unit else ''} {values.dtype} x {values[0].size}: "
              f"{np.nanmin(values):g} to {np.nanmax(values):g}")


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        vtk = read_with_vtk(sys.argv[1])
        raw = read_with_h5py(sys.argv[1])
        describe(raw)
        found = mismatches(vtk, raw)
    except (OSError, KeyError) as error:
        print(f"{sys.argv[1]}: {error}", file=sys.stderr)
        return 2
    for line in found:
        print(f"{sys.argv[1]}: {line}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
