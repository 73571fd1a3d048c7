#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes broken copies of models: cut short, and with bytes changed, always the same ones.

    break_models.py FOLDER OUT [--copies 4] [--most-bytes 2000000] [--formats step,fbx,…]

Of every file of FOLDER (subfolders too) with one of the endings, one copy is cut at a share of its length and the others
have runs of bytes overwritten, numbers replaced by extreme ones, or a piece doubled. For scripts/check_hostile.py.
"""
import argparse
import hashlib
import pathlib
import random
import re

FORMATS = ("step,stp,iges,igs,brep,fbx,dae,3ds,x,blend,lwo,lxo,ac,ms3d,md2,md3,md5mesh,mdc,mdl,hmp,iqm,b3d,ase,cob,scn,nff,smd,"
           "xgl,zgl,irrmesh,q3o,q3s,dxf,ifc,x3d,amf,ogex,sib,pmx")
EXTREMES = (b"nan", b"-1", b"4294967295", b"1e999", b"99999999999999999999", b"0", b"")
NUMBER = re.compile(rb"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def cut(content, chance):
    return content[:chance.randrange(1, len(content))]


def overwrite(content, chance):
    changed = bytearray(content)
    for _ in range(chance.choice((1, 8, 64))):
        start = chance.randrange(len(changed))
        value = chance.choice((b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", chance.randbytes(4)))
        changed[start:start + 4] = value[:len(changed) - start]
    return bytes(changed)


def renumber(content, chance):
    places = [found.span() for found in NUMBER.finditer(content)]
    if not places:
        return overwrite(content, chance)
    for start, end in sorted(chance.sample(places, min(len(places), chance.choice((1, 5)))), reverse=True):
        content = content[:start] + chance.choice(EXTREMES) + content[end:]
    return content


def double(content, chance):
    start = chance.randrange(len(content))
    end = min(len(content), start + chance.choice((10, 1000, 100000)))
    return content[:end] + content[start:end] + content[end:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--copies", type=int, default=4)
    parser.add_argument("--most-bytes", type=int, default=2_000_000)
    parser.add_argument("--formats", default=FORMATS)
    options = parser.parse_args()
    endings = {"." + ending for ending in options.formats.split(",")}
    options.out.mkdir(parents=True, exist_ok=True)
    count = 0
    for file in sorted(options.folder.rglob("*")):
        if file.suffix.lower() not in endings or not file.is_file() or not 1 < file.stat().st_size <= options.most_bytes:
            continue
        content = file.read_bytes()
        name = str(file.relative_to(options.folder)).replace("/", "_")
        for number in range(options.copies):
            chance = random.Random(hashlib.sha256(f"{name} {number}".encode()).digest())
            way = (cut, overwrite, renumber, double)[number % 4]
            (options.out / f"{pathlib.Path(name).stem}.{number}{file.suffix}").write_bytes(way(content, chance))
            count += 1
    print(f"{count} files in {options.out}")


if __name__ == "__main__":
    main()
