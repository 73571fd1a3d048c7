"""Reads the pictures that the program writes, and makes pictures of one colour for it."""

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
    above = bytes(4 * width)
    for y in range(height):
        line = bytearray(raw[y * step + 1:(y + 1) * step])
        kind = raw[y * step]
        assert kind in (0, 1, 2), "written with the filters None, Sub (goldens) and Up"
        for i in range(4 if kind == 1 else 0, len(line) if kind else 0):
            line[i] = (line[i] + (line[i - 4] if kind == 1 else above[i])) & 255
        above = bytes(line)
        rows.append(above)
    return width, height, rows


def borders(picture, above=0):
    """Columns left and right and rows above and below what a picture (of read_png) shows."""
    width, height, rows = picture
    alphas = [row[3::4] for row in rows]
    ys = [y for y, row in enumerate(alphas) if max(row) > above]
    xs = [x for x, column in enumerate(zip(*alphas)) if max(column) > above]
    return xs[0], width - 1 - xs[-1], ys[0], height - 1 - ys[-1]


def png(rgba, width=2, height=2):
    """A PNG of one colour."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(rgba) * width for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
