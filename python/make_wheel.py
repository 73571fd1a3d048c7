#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Packs the built package as a wheel: the same bytes for the same files. No network, no setuptools.

    make_wheel.py PACKAGE_FOLDER OUTPUT_FOLDER --version 1.2.3 …   prints the path of the wheel

With --carry the wheel holds every shared library that it loads, with its licence.
"""
import argparse
import base64
import hashlib
import pathlib
import sys
import sysconfig
import tempfile
import zipfile

import carried_libraries

EPOCH = (1980, 1, 1, 0, 0, 0)  # the first that a zip knows


def tag_of(platform):
    """cp311-cp311-linux_x86_64: of the interpreter that runs this."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{platform}"


def own_platform():
    """linux_x86_64: a wheel that wants the libraries of the machine that built it."""
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")


def metadata(version, summary, licences, tag):
    """METADATA and WHEEL."""
    listed = "".join(f"License-File: {name}\n" for name in licences)
    about = ("Metadata-Version: 2.1\nName: vantage\n"
             f"Version: {version}\nSummary: {summary}\nLicense: MIT\n{listed}"
             "Requires-Python: >=3.9\nRequires-Dist: numpy>=1.20\n"
             "Classifier: License :: OSI Approved :: MIT License\n"
             "Classifier: Operating System :: POSIX :: Linux\n"
             "Classifier: Typing :: Typed\n")
    wheel = ("Wheel-Version: 1.0\nGenerator: vantage make_wheel.py\n"
             f"Root-Is-Purelib: false\nTag: {tag}\n")
    return about.encode(), wheel.encode()


def record_line(name, content):
    """A line of RECORD."""
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def package_files(package):
    """Names and bytes of the package as it was built."""
    return {f"vantage/{path.name}": path.read_bytes() for path in package.iterdir()
            if path.suffix in (".py", ".pyi", ".so", ".typed")}


def contents(options):
    """Folder of metadata, tag, and names and bytes of everything in the wheel but RECORD, sorted."""
    info = f"vantage-{options.version}.dist-info"
    files = package_files(options.package)
    licences = {"LICENSE": options.licence.read_bytes(), "THIRD_PARTY.md": options.notices.read_bytes()}
    if options.compiled_in:
        licences["NOTICES"] = options.compiled_in.read_bytes()
    platform = own_platform()
    if options.carry:
        module = next(options.package.glob("_core*.so"))
        with tempfile.TemporaryDirectory() as scratch:
            carried, of_packages, platform = carried_libraries.carry(module, pathlib.Path(scratch))
        files.update(carried)
        licences.update({f"licences/{name}": text for name, text in of_packages.items()})
    about, wheel = metadata(options.version, options.summary, licences, tag_of(platform))
    files.update({f"{info}/{name}": text for name, text in licences.items()})
    files.update({f"{info}/METADATA": about, f"{info}/WHEEL": wheel,
                  f"{info}/top_level.txt": b"vantage\n"})
    return info, tag_of(platform), dict(sorted(files.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("package", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--version", required=True)
    parser.add_argument("--summary", required=True)
    parser.add_argument("--licence", type=pathlib.Path, required=True)
    parser.add_argument("--notices", type=pathlib.Path, required=True)
    parser.add_argument("--compiled-in", type=pathlib.Path, help="licences of what is compiled in")
    parser.add_argument("--carry", action="store_true", help="put the shared libraries into the wheel")
    options = parser.parse_args()
    info, tag, files = contents(options)
    lines = "".join(record_line(name, content) for name, content in files.items())
    files[f"{info}/RECORD"] = (lines + f"{info}/RECORD,,\n").encode()
    path = options.output / f"vantage-{options.version}-{tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = (0o755 if ".so" in name else 0o644) << 16
            wheel.writestr(entry, content, zipfile.ZIP_DEFLATED)
    print(path)


if __name__ == "__main__":
    main()
