"""What the programs of the lab share: where the house is, and the options that say where the rest is."""
# SPDX-License-Identifier: MIT
import os

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
SHARED = {"build": ("build", "where the programs are (default: build)"),
          "data": ("../shared/data", "a folder a sequence (default: ../shared/data)"),
          "cache": (".cache/lab", "what was measured already (default: .cache/lab)")}


def declare(parser, *names):
    """Options of these names, folders below the house unless they are given."""
    for name in names:
        default, words = SHARED[name]
        parser.add_argument(f"--{name}", default=os.path.join(ROOT, default), help=words)
