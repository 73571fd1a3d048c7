#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Software bill of materials of a built program, as SPDX 2.3 JSON on standard output.

    make_sbom.py build/release/apps/vantage/vantage [--epoch SECONDS] [--licences FOLDER] > vantage.spdx.json

Lists what the program loads (Debian packages of its shared libraries, by dpkg), what was compiled into it (header-only
libraries that cmake/dependencies.cmake names) and the npm packages bundled into report.html. Licences are those of
THIRD_PARTY.md; of what those libraries load in turn, the names that Debian's copyright file gives, as a comment. With
--licences, that file of each package goes into FOLDER. Same input, same bytes.
"""
import argparse
import datetime
import json
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
COMPILED_IN = ["libeigen3-dev", "libnanoflann-dev", "nlohmann-json3-dev", "libtinygltf-dev", "libcli11-dev"]
LICENCES = {"libeigen3-dev": "MPL-2.0", "libnanoflann-dev": "BSD-2-Clause", "nlohmann-json3-dev": "MIT",
            "libtinygltf-dev": "MIT", "libcli11-dev": "BSD-3-Clause", "libmetis5": "Apache-2.0", "libtbb12": "Apache-2.0",
            "libembree3-3": "Apache-2.0", "libmeshoptimizer2d": "MIT", "libdraco7": "Apache-2.0", "libexpat1": "MIT",
            "libpng16-16": "libpng-2.0", "libjpeg62-turbo": "IJG AND BSD-3-Clause", "zlib1g": "Zlib",
            "libwebp7": "BSD-3-Clause", "libwebpmux3": "BSD-3-Clause", "libsqlite3-0": "blessing",
            "libarchive13": "BSD-2-Clause", "libsodium23": "ISC", "libcpp-httplib0.11": "MIT", "libssl3": "Apache-2.0"}


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def loaded_packages(program):
    """Debian packages of every shared library that the loader finds for the program."""
    paths = sorted(set(re.findall(r"=> (/\S+)", output_of("ldd", program))))
    packages = set()
    for path in paths:
        for candidate in (path, str(pathlib.Path(path).resolve()), "/usr" + path):
            found = subprocess.run(["dpkg", "-S", candidate], capture_output=True, text=True, check=False)
            if found.returncode == 0:
                packages.add(found.stdout.split(": ")[0].split(",")[0])
                break
        else:
            raise SystemExit(f"make_sbom: {path} belongs to no package")
    return sorted(packages)


def copyright_of(package):
    return pathlib.Path("/usr/share/doc") / package / "copyright"


def names_in(copyright_file):
    """What a machine-readable copyright file of Debian's calls the licences in it."""
    text = copyright_file.read_text(encoding="utf-8", errors="replace") if copyright_file.exists() else ""
    return ", ".join(sorted(set(re.findall(r"^License: *(\S.*?) *$", text, re.MULTILINE))))


def debian_entry(package):
    name, version = output_of("dpkg-query", "-W", "-f=${Package} ${Version}", package).split()
    return {"SPDXID": "SPDXRef-deb-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": LICENCES.get(name, "NOASSERTION"),
            "licenseComments": f"Debian's copyright file names: {names_in(copyright_of(name)) or 'see its text'}",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": f"pkg:deb/debian/{name}@{version}?distro=bookworm"}]}


def bundled_npm():
    lock = json.loads((ROOT / "viewer/package-lock.json").read_text())
    for path, package in sorted(lock["packages"].items()):
        if path and not package.get("dev"):
            name = path.removeprefix("node_modules/")
            yield {"SPDXID": f"SPDXRef-npm-{name.replace('/', '-')}", "name": name, "versionInfo": package["version"],
                   "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
                   "licenseConcluded": package["license"], "licenseDeclared": package["license"],
                   "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                     "referenceLocator": f"pkg:npm/{name}@{package['version']}"}]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--epoch", type=int, default=0, help="seconds since 1970 to state as the time of creation")
    parser.add_argument("--licences", type=pathlib.Path, help="folder for the packages' copyright files")
    options = parser.parse_args()
    version = output_of(options.program, "--version").split()[1]
    packages = sorted({*loaded_packages(options.program), *COMPILED_IN})
    parts = [*map(debian_entry, packages), *bundled_npm()]
    if options.licences:
        options.licences.mkdir(parents=True, exist_ok=True)
        for package in packages:
            shutil.copyfile(copyright_of(package.split(":")[0]), options.licences / package.split(":")[0])
    created = datetime.datetime.fromtimestamp(options.epoch, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    own = {"SPDXID": "SPDXRef-vantage", "name": "vantage", "versionInfo": version, "downloadLocation": "NOASSERTION",
           "filesAnalyzed": False, "licenseConcluded": "MIT", "licenseDeclared": "MIT"}
    print(json.dumps({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"vantage-{version}", "documentNamespace": f"https://spdx.org/spdxdocs/vantage-{version}",
        "creationInfo": {"created": created, "creators": ["Tool: make_sbom.py"]},
        "documentDescribes": ["SPDXRef-vantage"],
        "packages": [own, *parts],
        "relationships": [{"spdxElementId": "SPDXRef-vantage", "relationshipType": "DEPENDS_ON",
                           "relatedSpdxElement": part["SPDXID"]} for part in parts]}, indent=1))


if __name__ == "__main__":
    main()
