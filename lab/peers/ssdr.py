"""A skinning decomposition: bones that move rigidly and at most four weights a vertex, after Le and Deng, Smooth Skinning
Decomposition with Rigid Bones (2012), with the rest pose fitted too. Letters: D [3F x V] positions, P [4 x V] rest pose with a
row of ones, M [B x 3F x 4] transforms, bones and weights [V x 4]."""
# SPDX-License-Identifier: MIT
from dataclasses import dataclass

import numpy

INFLUENCES, CANDIDATES = 4, 10


@dataclass
class Skin:
    rest: numpy.ndarray        # [V x 3]
    transforms: numpy.ndarray  # [B x F x 3 x 4]
    bones: numpy.ndarray       # [V x 4]
    weights: numpy.ndarray     # [V x 4], at least 0, their sum 1


def rigid(points, cloud, weights):
    """The motions [F x 3 x 4] that bring points [n x 3] nearest to cloud [F x 3 x n], where the part w of a point was to go to
    cloud: sum w^2 |R p + t - cloud / w|^2 is least."""
    total = numpy.square(weights).sum()
    middle = (numpy.square(weights) @ points) / total
    goal = cloud @ weights / total
    turned, _, other = numpy.linalg.svd(cloud @ (weights[:, None] * (points - middle)))  # [F x 3 x 3]
    flip = numpy.linalg.det(turned @ other)
    turned[:, :, 2] *= numpy.where(flip < 0, -1.0, 1.0)[:, None]
    turn = turned @ other
    return numpy.concatenate([turn, (goal - turn @ middle)[:, :, None]], axis=2)


def homogeneous(rest):
    return numpy.concatenate([rest, numpy.ones((len(rest), 1))], axis=1).T


def errors_of(transform, P, D):
    """Squared error of each vertex, would one bone move it."""
    return numpy.square(transform.reshape(-1, 4) @ P - D).sum(axis=0)


def clusters(rest, D, count):
    """Bones one by one: where the error is largest, from the vertices around; then a few rounds of assigning and fitting."""
    P, F = homogeneous(rest), len(D) // 3
    frames = D.reshape(F, 3, -1)
    transforms = [rigid(rest, frames, numpy.ones(len(rest)))]
    errors = [errors_of(transforms[0], P, D)]
    near = min(len(rest), max(6, len(rest) // (4 * count)))
    while len(transforms) < count:
        worst = int(numpy.argmax(numpy.min(errors, axis=0)))
        around = numpy.argsort(numpy.square(rest - rest[worst]).sum(axis=1))[:near]
        transforms.append(rigid(rest[around], frames[:, :, around], numpy.ones(near)))
        errors.append(errors_of(transforms[-1], P, D))
    for _ in range(3):
        nearest = numpy.argmin(errors, axis=0)
        for bone in range(count):
            members = numpy.flatnonzero(nearest == bone)
            if len(members) >= 3:
                transforms[bone] = rigid(rest[members], frames[:, :, members], numpy.ones(len(members)))
                errors[bone] = errors_of(transforms[bone], P, D)
    return numpy.array(transforms)


def products(transforms, D):
    """M M^T [B x 4 x B x 4] and M D [B x 4 x V]: all that weights and rest pose need to know of the frames."""
    B = len(transforms)
    M = transforms.reshape(B, -1, 4).transpose(0, 2, 1).reshape(4 * B, -1)
    return (M @ M.T).reshape(B, 4, B, 4), (M @ D).reshape(B, 4, -1)


def gram(MM, MD, P, squares):
    """[V x B x B]: products of the errors that each bone alone would make."""
    V, B = P.shape[1], len(MM)
    own = numpy.einsum("bkv,kv->vb", MD, P)
    pairs = (P[:, None, :] * P[None, :, :]).reshape(16, V).T @ MM.transpose(1, 3, 0, 2).reshape(16, B * B)
    return pairs.reshape(V, B, B) - own[:, :, None] - own[:, None, :] + squares[:, None, None]


def best_weights(H):
    """Weights of sum 1 that make w^T H w least, and that least; infinite where a weight would be negative. H [n x m x m]."""
    m = H.shape[1]
    H = H + numpy.eye(m) * (1e-9 * numpy.trace(H, axis1=1, axis2=2) + 1e-30)[:, None, None]
    weights = numpy.linalg.solve(H, numpy.ones((len(H), m, 1)))[:, :, 0]
    total = weights.sum(axis=1)
    bad = (weights < 0).any(axis=1) | (total <= 0)
    return weights / numpy.where(bad, 1, total)[:, None], numpy.where(bad, numpy.inf, 1 / numpy.where(bad, 1, total))


def chosen(H):
    """Bones and weights [V x 4] of each vertex: one more bone at a time, whichever helps most."""
    V, B = H.shape[:2]
    every = numpy.arange(V)
    candidates = numpy.argsort(numpy.diagonal(H, axis1=1, axis2=2), axis=1)[:, :CANDIDATES]
    bones, weights = candidates[:, :1], numpy.ones((V, 1))
    error = H[every, bones[:, 0], bones[:, 0]]
    while bones.shape[1] < min(INFLUENCES, B):
        grown = numpy.zeros((V, bones.shape[1] + 1))
        grown[:, :-1], added = weights, bones[:, 0].copy()  # none: the first bone again, with no weight
        for candidate in candidates.T:
            trial = numpy.concatenate([bones, candidate[:, None]], axis=1)
            new, least = best_weights(H[every[:, None, None], trial[:, :, None], trial[:, None, :]])
            better = (least < error * (1 - 1e-6)) & ~(bones == candidate[:, None]).any(axis=1)
            grown[better], added[better], error = new[better], candidate[better], numpy.where(better, least, error)
        bones, weights = numpy.concatenate([bones, added[:, None]], axis=1), grown
    room = INFLUENCES - bones.shape[1]
    return numpy.pad(bones, ((0, 0), (0, room))), numpy.pad(weights, ((0, 0), (0, room)))


def weights_of(transforms, rest, D):
    MM, MD = products(transforms, D)
    P, squares = homogeneous(rest), numpy.square(D).sum(axis=0)
    parts = [chosen(gram(MM, MD[:, :, at:at + 1024], P[:, at:at + 1024], squares[at:at + 1024])) for at in range(0, len(rest), 1024)]
    return tuple(numpy.concatenate(part) for part in zip(*parts))


def members_of(skin, bone):
    """Vertices that a bone moves, and how much."""
    weights = (skin.weights * (skin.bones == bone)).sum(axis=1)
    members = numpy.flatnonzero(weights > 0)
    return members, weights[members]


def moved(skin, bone, members, weights):
    return (skin.transforms[bone].reshape(-1, 4) @ homogeneous(skin.rest[members])) * weights


def posed(skin):
    """[3F x V]"""
    out = numpy.zeros((3 * skin.transforms.shape[1], len(skin.rest)))
    for bone in range(len(skin.transforms)):
        members, weights = members_of(skin, bone)
        out[:, members] += moved(skin, bone, members, weights)
    return out


def refit_bones(skin, D):
    """One bone after the other, to what the others leave."""
    left = D - posed(skin)
    for bone in range(len(skin.transforms)):
        members, weights = members_of(skin, bone)
        if len(members) < 3:
            continue
        goal = left[:, members] + moved(skin, bone, members, weights)
        skin.transforms[bone] = rigid(skin.rest[members], goal.reshape(-1, 3, len(members)), weights)
        left[:, members] = goal - moved(skin, bone, members, weights)


def refit_rest(skin, D):
    """Each vertex' place in the rest pose: three equations."""
    MM, MD = products(skin.transforms, D)
    V = len(skin.rest)
    normal, right = numpy.zeros((V, 3, 3)), numpy.zeros((V, 3))
    for j in range(INFLUENCES):
        b, w = skin.bones[:, j], skin.weights[:, j]
        right += w[:, None] * MD[b, :3, numpy.arange(V)]
        for k in range(INFLUENCES):
            both = (w * skin.weights[:, k])[:, None, None] * MM[b, :, skin.bones[:, k], :]
            normal += both[:, :3, :3]
            right -= both[:, :3, 3]
    normal += numpy.eye(3) * (1e-9 * numpy.trace(normal, axis1=1, axis2=2))[:, None, None]
    skin.rest = numpy.linalg.solve(normal, right[:, :, None])[:, :, 0]


def decompose(positions, bones, rounds=6):
    """A skin of so many bones for positions [F x V x 3]."""
    D = numpy.asarray(positions, dtype=numpy.float64).transpose(0, 2, 1).reshape(-1, positions.shape[1])
    rest = numpy.array(positions[0], dtype=numpy.float64)
    transforms = clusters(rest, D, min(bones, len(rest) // 4))
    skin = Skin(rest, transforms, *weights_of(transforms, rest, D))
    for _ in range(rounds):
        refit_bones(skin, D)
        refit_rest(skin, D)
        skin.bones, skin.weights = weights_of(skin.transforms, skin.rest, D)
    return skin
