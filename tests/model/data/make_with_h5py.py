#!/usr/bin/env python3
"""Makes the model files of this folder that rholm does not write itself, with h5py 3.

Files in accepted/ mean C_00 = 1, C_10 = 2, C_11 = 3, S_11 = 4. Each file in refused/ has the one fault that
its name states. degree4-*.h5 have C_lm = 1/(1 + l + m), S_lm = m/(l + 1).
"""

import os
import shutil
import zlib

import h5py
import numpy as np

FOLDER = os.path.dirname(os.path.abspath(__file__))
SMALL = np.zeros((2, 2, 2))
SMALL[0, 0, 0], SMALL[0, 1, 0], SMALL[0, 1, 1], SMALL[1, 1, 1] = 1, 2, 3, 4


def write_golden(name, **options):
    coefficients = np.zeros((2, 5, 5))
    for l in range(5):
        for m in range(l + 1):
            coefficients[0, l, m] = 1 / (1 + l + m)
            coefficients[1, l, m] = m / (l + 1)
    with h5py.File(f"{FOLDER}/{name}", "w", **options) as file:
        file.attrs.update(format="rholm-model", version_major=1, version_minor=0)
        creation = h5py.h5p.create(h5py.h5p.GROUP_CREATE)
        if options.get("libver") == "latest":
            creation.set_attr_phase_change(32, 0)  # more than 8 attributes in the header
        group = h5py.Group(h5py.h5g.create(file.id, b"expansion", gcpl=creation))
        group["coefficients"] = coefficients
        group.attrs.update(degree=4, normalization="orthonormal", csphase=1, function="gauge",
                           center=[1.0, -2.0, 0.5], unit="µm", method="gauge", norm_squared=12.5,
                           tail_strength=0.125)


def write(name, data=SMALL, change=lambda file, group: None, file_options={}, **dataset_options):
    """Makes a model of degree 1 with one change."""
    with h5py.File(f"{FOLDER}/{name}.h5", "w", **file_options) as file:
        file.attrs.update(format="rholm-model", version_major=1)
        group = file.create_group("expansion")
        if data is not None:
            group.create_dataset("coefficients", data=data, **dataset_options)
        group.attrs.update(degree=1, normalization="orthonormal", csphase=1, function="radius",
                           center=np.zeros(3))
        change(file, group)


def root(**values):
    return lambda file, group: file.attrs.update(values)


def attributes(**values):
    return lambda file, group: group.attrs.update(values)


def without(name):
    def change(file, group):
        del group.attrs[name]
    return change


def many_attributes(file, group):
    group.attrs.update({f"x{i}": i for i in range(20)})


def many_members(file, group):
    for i in range(20):
        group.create_group(f"x{i}")


def spoiled(plane, l, m, value):
    data = SMALL.copy()
    data[plane, l, m] = value
    return data


def no_expansion(file, group):
    del file["expansion"]


def dataset_as_expansion(file, group):
    del file["expansion"]
    file["expansion"] = SMALL


def soft_link(file, group):
    file["other"] = SMALL
    group["coefficients"] = h5py.SoftLink("/other")


def external_link(file, group):
    group["coefficients"] = h5py.ExternalLink("x.h5", "/other")


def external_file(file, group):
    creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    creation.set_external(b"values.bin", 0, SMALL.nbytes)
    space = h5py.h5s.create_simple(SMALL.shape)
    h5py.h5d.create(group.id, b"coefficients", h5py.h5t.IEEE_F64LE, space, creation)


def committed_type(file, group):
    file["type"] = np.dtype("f8")
    group.create_dataset("coefficients", data=SMALL, dtype=file["type"])


def compact(file, group):
    creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    creation.set_layout(h5py.h5d.COMPACT)
    space = h5py.h5s.create_simple(SMALL.shape)
    dataset = h5py.h5d.create(group.id, b"coefficients", h5py.h5t.IEEE_F64LE, space, creation)
    h5py.Dataset(dataset)[...] = SMALL


def write_refused():
    os.makedirs(f"{FOLDER}/refused", exist_ok=True)
    with h5py.File(f"{FOLDER}/refused/empty.h5", "w"):
        pass
    latest = {"libver": "latest"}
    write("refused/other-format", change=root(format="other"))
    write("refused/version-2", change=root(version_major=2))
    write("refused/version-text", change=root(version_major="1"))
    write("refused/no-expansion", change=no_expansion)
    write("refused/no-coefficients", data=None)
    write("refused/group-as-coefficients", data=None,
          change=lambda file, group: group.create_group("coefficients"))
    write("refused/dataset-as-expansion", change=dataset_as_expansion)
    write("refused/soft-link", data=None, change=soft_link)
    write("refused/external-link", data=None, change=external_link)
    write("refused/external-file", data=None, change=external_file)
    write("refused/chunked", compression="gzip")
    write("refused/chunked-plain", chunks=(1, 2, 2))
    write("refused/int64", data=SMALL.astype("i8"))
    write("refused/float16", data=SMALL.astype("f2"))
    write("refused/complex", data=SMALL.astype("c16"))
    write("refused/rank-2", data=SMALL[0])
    write("refused/not-square", data=np.zeros((2, 2, 3)))
    write("refused/empty-array", data=np.zeros((2, 0, 0)))
    write("refused/no-degree", change=without("degree"))
    write("refused/wrong-degree", change=attributes(degree=3))
    write("refused/nan", data=spoiled(0, 1, 1, np.nan))
    write("refused/above-diagonal", data=spoiled(0, 0, 1, 1))
    write("refused/schmidt", change=attributes(normalization="schmidt"))
    write("refused/csphase", change=attributes(csphase=-1))
    write("refused/function", change=attributes(function="log"))
    write("refused/center-2", change=attributes(center=np.zeros(2)))
    write("refused/center-text", change=attributes(center="0 0 0"))
    write("refused/crc32", change=attributes(crc32=np.uint32(1)))
    write("refused/unit-bytes", change=attributes(unit=np.bytes_(b"\xff")))
    write("refused/dense-attributes", change=many_attributes, file_options=latest)
    write("refused/dense-links", change=many_members, file_options=latest)
    write("refused/committed-type", data=None, change=committed_type)
    write("refused/user-block", file_options={"userblock_size": 512})


def write_accepted():
    os.makedirs(f"{FOLDER}/accepted", exist_ok=True)

    def busy(file, group):
        many_attributes(file, group)
        for i in range(300):  # a tree of two levels
            group[f"x{i}"] = file

    write("accepted/many-members", change=busy)
    write("accepted/big-endian", data=SMALL.astype(">f8"),
          change=attributes(degree=np.array(1, ">i2"), center=np.zeros(3, ">f4")))
    write("accepted/float32", data=SMALL.astype("f4"), change=attributes(unit=np.bytes_(b"km")))
    write("accepted/unsigned", change=attributes(degree=np.uint8(1)))
    write("accepted/compact", data=None, change=compact)
    checksum = zlib.crc32(SMALL.tobytes())
    write("accepted/track-order", change=attributes(crc32=np.uint32(checksum)),
          file_options={"libver": "latest", "track_order": True})
    checksum = zlib.crc32(SMALL.tobytes() + b"km" + b"edge")
    write("accepted/crc32", change=attributes(unit="km", method="edge", crc32=np.uint32(checksum)))


for folder in ("accepted", "refused"):
    shutil.rmtree(f"{FOLDER}/{folder}", ignore_errors=True)
write_golden("degree4-h5py-default.h5")
write_golden("degree4-h5py-latest.h5", libver="latest")
write_refused()
write_accepted()
