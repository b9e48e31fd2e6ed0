"""Bits into numbers: varints, the range coder, Huffman tables and mixtures of models, as docs/coding.md says.

SPDX-License-Identifier: MIT
"""

import math
from functools import lru_cache
from math import floor

TOP = 1 << 24


class Damaged(ValueError):
    """Bytes that are no valid file: says which byte and which field."""

    def __init__(self, at, field, sentence):
        super().__init__(f"byte {at}: {field}: {sentence}")


def unfold(number):
    """The signed number that a zigzag stands for."""
    return number >> 1 if number % 2 == 0 else -(number + 1 >> 1)


class Model:
    """One adaptive decision: a fast and a slow estimate of how likely a one is."""

    __slots__ = ("fast", "slow", "count")

    def __init__(self):
        self.fast = self.slow = 1 << 23
        self.count = 0

    def chance(self):
        return min(max((self.fast + 3 * self.slow) >> 11, 8), 32760)

    def learn(self, bit):
        rate = 327680 // (10 * self.count + 16)
        fast = max(rate, 1170)
        if bit:
            self.fast += ((TOP - self.fast) * fast) >> 15
            self.slow += ((TOP - self.slow) * rate) >> 15
        else:
            self.fast -= (self.fast * fast) >> 15
            self.slow -= (self.slow * rate) >> 15
        self.count = min(self.count + 1, 249)


class Models(dict):
    """Models by any key, made where one is first asked for."""

    def __missing__(self, key):
        self[key] = model = Model()
        return model


class RangeDecoder:
    """Decisions, numbers, symbols, levels and raw bits of one range coded stream."""

    def __init__(self, data, at=0, field="bits"):
        self.data, self.at, self.field, self.place = data, at, field, 0
        self.range, self.code = (1 << 32) - 1, 0
        for _ in range(4):
            self.code = self.code << 8 | self.byte()

    def byte(self):
        place = self.place
        self.place = place + 1
        if place < len(self.data):
            return self.data[place]
        if place >= len(self.data) + 4:
            raise Damaged(self.at + len(self.data), self.field, "the range coder ran out of bytes")
        return 0

    def refill(self):
        while self.range < TOP:
            self.code = (self.code << 8 | self.byte()) & 0xFFFFFFFF
            self.range = self.range << 8

    def bit(self, chance):
        bound = (self.range >> 15) * chance
        bit = int(self.code < bound)
        if bit:
            self.range = bound
        else:
            self.code -= bound
            self.range -= bound
        if self.range < TOP:
            self.refill()
        return bit

    def decide(self, model):
        bit = self.bit(model.chance())
        model.learn(bit)
        return bit

    def raw(self, count):
        value = 0
        while count > 0:
            bits = min(count, 16)
            self.range >>= bits
            part = min(self.code // self.range, (1 << bits) - 1)
            self.code -= part * self.range
            self.refill()
            value, count = value << bits | part, count - bits
        return value

    def number(self, models, key):
        """A number from 0; its models are models[key, ...]."""
        e = 0
        while e < 32 and self.decide(models[key, "exponent", e]):
            e += 1
        s = node = 1
        for _ in range(min(e, 3)):
            b = self.decide(models[key, e, node])
            s, node = 2 * s + b, 2 * node + b
        rest = max(e - 3, 0)
        return (s << rest | self.raw(rest)) - 1

    def jump(self, models, key):
        """A number, unfolded."""
        return unfold(self.number(models, key))

    def symbol(self, models, key, alphabet):
        depth, node = (alphabet - 1).bit_length(), 1
        for below in range(depth - 1, -1, -1):
            right = (2 * node + 1 << below) - (1 << depth)
            b = 0 if right >= alphabet else self.decide(models[key, node])
            node = 2 * node + b
        return node - (1 << depth)

    def level(self, models, key):
        if not self.decide(models[key, "nonzero"]):
            return 0
        negative, m = self.decide(models[key, "negative"]), 1
        while m <= 14 and self.decide(models[key, "more", m]):
            m += 1
        if m > 14:
            m += self.number(models, key)
        return max(-m, -1 << 31) if negative else min(m, (1 << 31) - 1)


class RangeSymbols:
    """Levels and symbols of numbered contexts, by the range coder."""

    def __init__(self, data, alphabets, at, field):
        self.decoder, self.alphabets = RangeDecoder(data, at, field), alphabets
        self.models = Models()

    def level(self, context):
        return self.decoder.level(self.models, context)

    def symbol(self, context):
        return self.decoder.symbol(self.models, ("symbol", context), self.alphabets[context])

    def raw(self, count):
        return self.decoder.raw(count)


class HuffmanSymbols:
    """Levels and symbols of numbered contexts, by canonical Huffman codes."""

    def __init__(self, data, level_contexts, alphabets, at, field):
        self.data, self.at, self.field = data, at, field
        size, start = varint(data, 0, at, field)
        if size > len(data) - start:
            self.fail("the tables are longer than the stream")
        tables, models = RangeDecoder(data[start:start + size], at + start, field), Models()
        self.place = 8 * (start + size)
        self.codes = [self.table(tables, models, None) for _ in range(level_contexts)]
        self.symbols = [self.table(tables, models, n) for n in alphabets]

    def fail(self, sentence):
        raise Damaged(self.at, self.field, sentence)

    def table(self, decoder, models, alphabet):
        """{(length, code): symbol}; a table of one symbol has it at length 0."""
        many = decoder.symbol(models, "how many", 3)
        if many == 0:
            return {}
        largest = decoder.number(models, "largest")
        if largest >= (alphabet or 512 + 23):
            self.fail("a symbol beyond its alphabet")
        if many == 1:
            return {(0, 0): largest}
        lengths = []
        for i in range(largest + 1):
            forecast = lengths[i - 2] if i >= 2 else 0
            if forecast == 0 and i > 0:
                forecast = lengths[i - 1]
            context = 0 if forecast == 0 else 2 if lengths[i - 1] else 1
            lengths.append(min(max(forecast + decoder.level(models, context), 0), 32))
        return self.canonical(lengths)

    def canonical(self, lengths):
        codes, code, before = {}, 0, 0
        for length, symbol in sorted((n, i) for i, n in enumerate(lengths) if n):
            code <<= length - before
            codes[length, code], code, before = symbol, code + 1, length
        if code != 1 << before:
            self.fail("code lengths do not fill the code space")
        return codes

    def raw(self, count):
        value = 0
        for _ in range(count):
            if self.place >= 8 * len(self.data):
                self.fail("the codes ran out of bits")
            value = value << 1 | self.data[self.place >> 3] >> (7 - self.place % 8) & 1
            self.place += 1
        return value

    def code(self, table):
        if not table:
            self.fail("a symbol of an empty table")
        length = code = 0
        while (length, code) not in table:
            code, length = code << 1 | self.raw(1), length + 1
        return table[length, code]

    def level(self, context):
        folded = self.code(self.codes[context])
        if folded >= 512:
            bits = folded - 512 + 9
            folded = 1 << bits | self.raw(bits)
        return unfold(folded)

    def symbol(self, context):
        return self.code(self.symbols[context])


@lru_cache(1)
def mixing_tables():
    """Probability by summed log odds, and log odds by probability in eighths."""
    p, power = [0] * 4095, 1.0
    for i in range(2048):
        p[2047 + i] = min(floor(32768 * power / (1 + power)), 32760)
        p[2047 - i] = 32768 - p[2047 + i]
        power *= 1.00391388933834757
    odds, place = [], 0
    for q in range(4096):
        while place < 4094 and p[place] < 8 * q + 4:
            place += 1
        odds.append(place - 2047)
    return p, odds


class Mixers(dict):
    """Weights of n models by any key."""

    def __init__(self, models):
        super().__init__()
        self.first = 98304 // models, models

    def __missing__(self, key):
        self[key] = weights = [self.first[0]] * self.first[1]
        return weights


def mixed(decoder, models, weights):
    """A decision that several models estimate."""
    p, odds = mixing_tables()
    o = [odds[model.chance() >> 3] for model in models]
    total = sum(w * x for w, x in zip(weights, o)) >> 16
    chance = p[2047 + min(max(total, -2047), 2047)]
    bit = decoder.bit(chance)
    for i, x in enumerate(o):
        moved = weights[i] + ((x * (32768 * bit - chance)) >> 14)
        weights[i] = min(max(moved, -1 << 19), 1 << 19)
    for model in models:
        model.learn(bit)
    return bit


def varint(data, place, at, field):
    """(value, place after it)"""
    value = shift = 0
    for i in range(place, min(place + 10, len(data))):
        value |= (data[i] & 127) << shift
        shift += 7
        if data[i] < 128:
            if value >= 1 << 64 or (data[i] == 0 and i > place):
                break
            return value, i + 1
    raise Damaged(at + place, field, "no varint, cut off, too long or too large")


def octave_column(fineness, quantity, columns):
    if not quantity >= 2.0**-6:
        return 0
    if quantity == math.inf:
        return columns - 1
    mantissa, exponent = math.frexp(quantity)
    y = (exponent - 1 + 6) * 2**fineness + floor((2 * mantissa - 1) * 2**fineness)
    return min(columns - 1, 1 + y)


class MixedLevels:
    """Levels under several contexts at once."""

    def __init__(self, decoder, contexts):
        self.decoder, self.contexts = decoder, contexts
        self.models, self.mixers = Models(), Mixers(contexts)

    def mixed(self, places, judge, *decision):
        models = [self.models[(i, place) + decision] for i, place in enumerate(places[:self.contexts])]
        if self.contexts == 1:
            return self.decoder.decide(models[0])
        mixer = (min(decision[1], 8),) if decision[0] == "longer" else ()
        return mixed(self.decoder, models, self.mixers[(judge, decision[0]) + mixer])

    def level(self, places, judge):
        if not self.mixed(places, judge, "not zero"):
            return 0
        negative, n, m = self.decoder.decide(self.models["negative"]), 1, 1
        while n < 31 and self.mixed(places, judge, "longer", min(n, 16)):
            n += 1
        if n > 1:
            m = 2 * m + self.mixed(places, judge, "first", min(n, 16))
        if n > 2:
            m = 2 * m + self.mixed(places, judge, "second", min(n, 16), m & 1)
        if n > 3:
            m = m << n - 3 | self.decoder.raw(n - 3)
        m = min(m, (1 << 31) - 1)
        return -m if negative else m
