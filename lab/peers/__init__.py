"""What meshreel is compared with: one file a peer, all of them in registry.py."""
# SPDX-License-Identifier: MIT
