"""Reads the pictures that the program writes."""

import struct
import zlib


def read_png(data):
    """Width, height and rows of RGBA bytes of a PNG of ours (8 bit RGBA, not interlaced)."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    stream, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        stream += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    raw, rows, step = zlib.decompress(stream), [], 4 * width + 1
    for y in range(height):
        line = bytearray(raw[y * step + 1:(y + 1) * step])
        assert raw[y * step] == 1, "written with the filter Sub"
        for i in range(4, len(line)):
            line[i] = (line[i] + line[i - 4]) & 255
        rows.append(bytes(line))
    return width, height, rows
