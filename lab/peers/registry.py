"""Every peer, one row each: what the lab's plans and tests run through."""
# SPDX-License-Identifier: MIT
from . import arrays, draco, gltf, meshopt, pca, plain, skinning
from .peer import Peer, PeerError, Run  # noqa: F401, whoever runs peers needs these too

PEERS = (*plain.PEERS, *arrays.PEERS, *draco.PEERS, *meshopt.PEERS, *gltf.PEERS, *skinning.PEERS, *pca.PEERS)


def find(name):
    """The peer of a name."""
    for peer in PEERS:
        if peer.name == name:
            return peer
    raise PeerError(f"{name}: no such peer; there are {', '.join(peer.name for peer in PEERS)}")
