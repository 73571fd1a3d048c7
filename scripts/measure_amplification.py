#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What small files that repeat what they hold cost: for each format those that show as many faces or points as are
read, their size, what `info` and `view --no-images` say, processor seconds and peak memory, also for each face (or
point, where there are none). Markdown on stdout.

    scripts/measure_amplification.py build/release/apps/vantage/vantage [--view] [--only NAME]
"""

import argparse
import base64
import json
import os
import pathlib
import resource
import struct
import subprocess
import tempfile
import zipfile

MOST_SECONDS = 120  # of processor time
MOST_MEMORY = 8_000_000_000


def grid(side):
    """A bumpy sheet of 2 * side^2 faces."""
    points = [(x / side, y / side, 0.1 * ((x * 7 + y * 3) % 5) / side) for y in range(side + 1) for x in range(side + 1)]
    faces = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            faces += [(a, a + 1, a + side + 2), (a, a + side + 2, a + side + 1)]
    return points, faces


def gltf(side, nodes, primitives):
    points, faces = grid(side)
    data = b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<3H", *f) for f in faces)
    split = 12 * len(points)
    primitive = {"attributes": {"POSITION": 0}, "indices": 1}
    return json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(nodes))}], "scene": 0,
        "nodes": [{"mesh": 0, "translation": [2 * (i % 100), 2 * (i // 100), 0]} for i in range(nodes)],
        "meshes": [{"primitives": [primitive] * primitives}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * len(faces), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": split},
                        {"buffer": 0, "byteOffset": split, "byteLength": len(data) - split}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}]}).encode()


def glb(document, data):
    """A document without its buffers, and the bytes of the only one."""
    text = json.dumps(document | {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data)}]}).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    return (struct.pack("<4s2I", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


def glb_of_nodes(side, nodes):
    document = json.loads(gltf(side, nodes, 1))
    data = base64.b64decode(document.pop("buffers")[0]["uri"].split(",")[1])
    return glb(document, data)


def glb_of_indices(indices, mode, has_data, cycle=200):
    """Triangles, a strip or a fan over 200 places, an index a byte, the first `cycle` again and again, or as an accessor
    that has no bytes at all."""
    places = b"".join(struct.pack("<3f", i % 17, i // 17, i % 5) for i in range(200))
    names = bytes(i % cycle * 7 % 200 for i in range(indices)) if has_data else b""
    accessor = {"componentType": 5121, "count": indices, "type": "SCALAR"} | ({"bufferView": 1} if has_data else {})
    views = [{"buffer": 0, "byteLength": len(places)}, {"buffer": 0, "byteOffset": len(places), "byteLength": len(names)}]
    return glb({"nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": mode}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 200, "type": "VEC3"}, accessor],
                "bufferViews": views[:1 + has_data]}, places + names)


def glb_of_shared_indices(primitives, faces):
    """Primitives that all name the same indices."""
    places = b"".join(struct.pack("<3f", i % 17, i // 17, i % 5) for i in range(200))
    names = bytes((i * 7 + i // 200) % 200 for i in range(3 * faces))
    primitive = {"attributes": {"POSITION": 0}, "indices": 1}
    return glb({"nodes": [{"mesh": 0}], "meshes": [{"primitives": [primitive] * primitives}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 200, "type": "VEC3"},
                              {"bufferView": 1, "componentType": 5121, "count": 3 * faces, "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteLength": len(places)},
                                {"buffer": 0, "byteOffset": len(places), "byteLength": len(names)}]}, places + names)


def threemf(path, side, items, levels):
    points, faces = grid(side)
    mesh = "".join(f'<vertex x="{x:.4g}" y="{y:.4g}" z="{z:.4g}"/>' for x, y, z in points)
    mesh = f"<vertices>{mesh}</vertices><triangles>" + "".join(
        f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces) + "</triangles>"
    objects = f'<object id="1"><mesh>{mesh}</mesh></object>'
    for level in range(levels):
        objects += f'<object id="{level + 2}"><components>' + "".join(
            f'<component objectid="{level + 1}" transform="1 0 0 0 1 0 0 0 1 {2 ** level * i} 0 0"/>' for i in range(2)
        ) + "</components></object>"
    build = f'<item objectid="{levels + 1}"/>' * items
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", f"<model><resources>{objects}</resources><build>{build}</build></model>")


def lzf_of_zeros(size):
    """A first zero, then runs that copy the byte before them."""
    packed, left = bytearray(b"\0\0"), size - 1
    while left > 0:
        run = min(left, 264)
        if run < 3:
            packed += bytes([run - 1]) + bytes(run)
        elif run < 9:
            packed += bytes([(run - 2) << 5, 0])
        else:
            packed += bytes([7 << 5, run - 9, 0])
        left -= run
    return bytes(packed)


def files(folder):
    """Names and paths of the files, each made when it is asked for."""
    def written(name, content):
        path = folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    yield "glTF, nodes of one mesh", lambda: written("nodes.gltf", gltf(10, 1300, 1))
    yield "glTF, more nodes than allowed", lambda: written("many.gltf", gltf(30, 5000, 1))
    yield "glTF, primitives of one accessor", lambda: written("primitives.gltf", gltf(10, 1, 1300))

    yield "GLB, nodes of one mesh", lambda: written("nodes.glb", glb_of_nodes(10, 1300))
    yield "GLB, strip of indices of a byte", lambda: written("strip.glb", glb_of_indices(100_000, 5, True))
    yield "GLB, fan of indices of a byte", lambda: written("fan.glb", glb_of_indices(100_000, 6, True))
    yield "GLB, 200 faces of indices again and again", lambda: written("again.glb", glb_of_indices(300_000, 4, True))
    yield "GLB, indices of one face again and again", lambda: written("once.glb", glb_of_indices(300_000, 4, True, 3))
    yield "GLB, primitives of one accessor of indices", lambda: written("shared.glb", glb_of_shared_indices(300, 1000))
    yield "GLB, indices without bytes", lambda: written("absent.glb", glb_of_indices(900_000, 4, False))

    def made(name, *arguments):
        threemf(folder / name, *arguments)
        return folder / name
    yield "3MF, items of one object", lambda: made("items.3mf", 10, 1300, 0)
    yield "3MF, components that double", lambda: made("components.3mf", 10, 1, 10)
    yield "3MF, more components than allowed", lambda: made("doubling.3mf", 10, 1, 40)
    corners = "".join(f"v {i % 317} {i // 317} {i % 7}\n" for i in range(1000))
    names = " ".join(str(1 + i % 1000) for i in range(100_000))
    yield "OBJ, one face of 100 000 corners", lambda: written("polygon.obj", f"{corners}f {names}\n")
    yield "OBJ, 100 000 faces of 1 000 corners' places", lambda: written(
        "faces.obj", corners + "".join(f"f {1 + i % 1000} {1 + i * 7 % 1000} {1 + i * 13 % 1000}\n" for i in range(100_000)))
    yield "PLY, faces of 255 corners", lambda: written("polygons.ply", (
        b"ply\nformat binary_little_endian 1.0\nelement vertex 300\nproperty float x\nproperty float y\nproperty float z\n"
        b"element face 2000\nproperty list uchar ushort vertex_indices\nend_header\n"
        + b"".join(struct.pack("<3f", i % 17, i // 17, i % 5) for i in range(300))
        + b"".join(b"\xff" + struct.pack("<255H", *((j + i) % 300 for j in range(255))) for i in range(2000))))
    facet = struct.pack("<12fH", *range(12), 0)
    yield "STL, one facet 20 000 times", lambda: written("facets.stl", bytes(80) + struct.pack("<I", 20_000) + facet * 20_000)
    yield "STL, text, facets of a few places", lambda: written("text.stl", "solid\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {i * k % 9} {i * k % 7} {i * k % 5}\n" for k in (1, 2, 3))
        + "endloop\nendfacet\n" for i in range(10_000)) + "endsolid\n")
    yield "OFF, 100 000 faces of 9 places", lambda: written("faces.off", "OFF\n9 100000 0\n" + "".join(
        f"{i % 3} {i // 3} {i % 2}\n" for i in range(9)) + "".join(f"3 {i % 9} {i * 2 % 9} {i * 5 % 9}\n" for i in range(100_000)))
    yield "OFF, one face of 100 000 corners", lambda: written("polygon.off", "OFF\n9 1 0\n" + "".join(
        f"{i % 3} {i // 3} {i % 2}\n" for i in range(9)) + "100000" + "".join(f" {i % 9}" for i in range(100_000)) + "\n")
    for ending, head in (("xyz", ""), ("pts", "200000\n")):
        yield f"{ending.upper()}, 200 000 points in nine places", lambda ending=ending, head=head: written(
            f"points.{ending}", head + "".join(f"{i % 3} {i % 9 // 3} 0\n" for i in range(200_000)))
    packed = lzf_of_zeros(12 * 1_000_000)
    yield "PCD, packed zeros", lambda: written("zeros.pcd", (
        b"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1000000\nHEIGHT 1\n"
        b"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1000000\nDATA binary_compressed\n"
        + struct.pack("<2I", len(packed), 12_000_000) + packed))


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program, command, path, out):
    """Exit code, resources and output of one run."""
    flags = ["--no-images", "-o", str(out), "-q"] if command == "view" else ["--json"]
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen([program, command, str(path), *flags], stdout=said, stderr=subprocess.DEVNULL,
                                   preexec_fn=limit)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        return process.returncode, used, said.read()


def shown_in(info):
    """Faces, or points where there are none."""
    told = json.loads(info) if info else {}
    return told.get("faces") or told.get("vertices") or 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--view", action="store_true")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    print("| file | size, kB | faces | command | exit | processor, s | µs a face | peak, MB | kB a byte |\n"
          "| --- | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, make in files(folder):
            if arguments.only not in title:
                continue
            path = make()
            faces = 0
            for command in ("info", "view") if arguments.view else ("info",):
                code, used, said = run(arguments.program, command, path, folder / "out")
                faces = shown_in(said) if command == "info" else faces
                size = path.stat().st_size
                seconds = used.ru_utime + used.ru_stime
                each = f"{1e6 * seconds / faces:.1f}" if faces else "–"
                print(f"| {title} | {size / 1000:.1f} | {faces or '–'} | {command} | {code} | {seconds:.1f} | {each} | "
                      f"{used.ru_maxrss / 1000:.0f} | {used.ru_maxrss * 1.024 / size:.2f} |", flush=True)


if __name__ == "__main__":
    main()
