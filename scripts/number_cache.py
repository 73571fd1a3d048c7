# SPDX-License-Identifier: MIT
"""Numbers that took long to measure, kept for as long as nothing that they were made from changes."""

import hashlib
import json
from pathlib import Path


def fingerprint(*files):
    """Of the bytes of all files."""
    digest = hashlib.sha256()
    for file in files:
        digest.update(hashlib.sha256(Path(file).read_bytes()).digest())
    return digest.hexdigest()


class Cache:
    """Numbers by name, kept in a file; each with the fingerprint of all that it was made from."""

    def __init__(self, file):
        self.file = file
        self.entries = json.loads(file.read_text()) if file.exists() else {}

    def find(self, name, made_from):
        entry = self.entries.get(name, {})
        return entry.get("numbers") if entry.get("made_from") == made_from else None

    def put(self, name, made_from, numbers):
        self.entries[name] = {"made_from": made_from, "numbers": numbers}
        self.file.parent.mkdir(parents=True, exist_ok=True)
        self.file.write_text(json.dumps(self.entries, indent=1))
