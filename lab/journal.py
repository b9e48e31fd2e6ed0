"""What was measured, a line of JSON each, written at once: a run that is interrupted goes on where it was."""
# SPDX-License-Identifier: MIT
import hashlib
import json
import os


def key_of(*parts):
    """One name for all that decides what a measurement gives."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:32]


class Journal:
    """Records by key, kept in a file. A line cut off in the middle, by a kill or a full disk, is forgotten."""

    def __init__(self, path):
        self.path, self.records = path, {}
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        with open(path, "a+b") as file:
            file.seek(0)
            text = file.read()
            whole = text[:text.rfind(b"\n") + 1]
            file.truncate(len(whole))
        for line in whole.splitlines():
            try:
                record = json.loads(line)
                self.records[record.pop("key")] = record
            except (json.JSONDecodeError, KeyError):
                continue  # measured again

    def get(self, key):
        """The newest record of this key; an empty one where there is none."""
        return self.records.get(key, {})

    def add(self, key, record):
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps({"key": key, **record}) + "\n")
            file.flush()
            os.fsync(file.fileno())
        self.records[key] = record
