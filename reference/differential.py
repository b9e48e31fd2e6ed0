#!/usr/bin/python3
"""differential.py PROGRAM [COUNT [SEED]]: both decoders of COUNT damaged golden files, behind their checksums.
differential.py PROGRAM FOLDER [COUNT]: of COUNT files of a folder: what the fuzzer has found.

PROGRAM is the library's golden_files (tools/foreign): a line a file, its meaning or that it is refused. The decoders
must agree on which files they refuse, and to the bit on what the others mean.
SPDX-License-Identifier: MIT
"""

import json
import random
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import container
    import meaning
    from coding import Damaged
except ModuleNotFoundError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

GOLDEN = Path(__file__).resolve().parent.parent / "tests" / "golden"
LARGEST = 4000  # bytes of a file: the second decoder is slow


def varint(number):
    data = bytearray()
    while number > 127:
        data.append(number & 127 | 128)
        number >>= 7
    return bytes(data) + bytes([number])


def chunk(kind, payload):
    data = kind.encode() + varint(len(payload)) + payload
    return data + struct.pack("<I", container.hash_of(data) & 0xFFFFFFFF)


def assembled(preamble, parts):
    """A file whose checksums and index hold."""
    file, index = preamble, varint(len(parts))
    for kind, payload in parts:
        index += kind.encode() + varint(len(file)) + varint(len(payload))
        file += chunk(kind, payload)
    tail = struct.pack("<Q", len(file))
    file += chunk("INDX", index)
    return file + chunk("TAIL", tail + struct.pack("<Q", len(file) + 25))


def damaged(data, dice):
    """Some bits flipped, bytes lost or repeated in one payload."""
    parts = [(kind, payload) for kind, _, _, payload in container.chunks(data)[:-2]]
    place = dice.randrange(len(parts))
    payload = bytearray(parts[place][1])
    for _ in range(dice.choice((1, 1, 1, 2, 8))):
        at, how = dice.randrange(len(payload) + 1), dice.randrange(6)
        if how < 4 and at < len(payload):
            payload[at] ^= 1 << dice.randrange(8)
        elif how == 4:
            del payload[at:at + dice.randrange(1, 5)]
        else:
            payload[at:at] = payload[max(at - 2, 0):at + 2]
    parts[place] = parts[place][0], bytes(payload)
    return assembled(data[:16], parts)


def second(data):
    try:
        return meaning.of(data)
    except Damaged as error:
        return f"refused: {error}"


def compare(program, files, names):
    """How many files are read differently. names: what to call them."""
    end, tried, refused, different = time.monotonic() + 300, 0, 0, 0
    said = subprocess.run([program, *files], check=True, capture_output=True, text=True, errors="replace").stdout
    for path, name, line in zip(files, names, said.splitlines(), strict=True):
        if time.monotonic() > end:
            break
        found, expected = second(path.read_bytes()), line if line.startswith("refused") else json.loads(line)
        both = isinstance(found, str) and isinstance(expected, str)
        tried, refused = tried + 1, refused + both
        if not both and found != expected:
            different += 1
            print(f"{name}, {path.name}:\n  {str(expected)[:300]}\n  {str(found)[:300]}")
    print(f"{tried} damaged files, {refused} refused by both decoders, {different} read differently")
    return different


def of_damaged(program, count=200, seed=1):
    dice = random.Random(seed)
    sources = [path for path in sorted(GOLDEN.glob("*.reel")) if path.stat().st_size < LARGEST]
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{i}.reel" for i in range(count)]
        names = [dice.choice(sources) for _ in files]
        for path, source in zip(files, names):
            path.write_bytes(damaged(source.read_bytes(), dice))
        return compare(program, files, [name.stem for name in names])


def of_folder(program, folder, count=1000):
    files = [path for path in sorted(Path(folder).iterdir()) if path.stat().st_size < LARGEST]
    files = random.Random(1).sample(files, min(count, len(files)))
    return compare(program, files, [folder] * len(files))


if __name__ == "__main__":
    PROGRAM, WORDS = sys.argv[1], sys.argv[2:]
    IN_FOLDER = WORDS and not WORDS[0].isdecimal()
    sys.exit((of_folder(PROGRAM, WORDS[0], *map(int, WORDS[1:])) if IN_FOLDER else of_damaged(PROGRAM, *map(int, WORDS))) > 0)
