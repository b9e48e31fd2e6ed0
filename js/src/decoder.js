/// The decoder: bytes of a .reel file in, what they hold out, as soon as it is there.
// SPDX-License-Identifier: MIT

/// What is wrong with a file: a code as the command's exit code, the byte and the field where it was found.
export class ReelError extends Error {
  constructor(message, { code = 4, byte = -1, field = '' } = {}) {
    super((byte >= 0 ? `byte ${byte}: ` : '') + (field ? `${field}: ` : '') + message);
    this.name = 'ReelError';
    this.code = code;
    this.byte = byte;
    this.field = field;
  }
}

const events = ['none', 'head', 'level', 'segment', 'done'];
const orders = ['keep', 'free', 'base'];
const axes = ['unknown', 'x', 'y', 'z'];
const domains = ['vertex', 'corner', 'triangle'];
const scalars = [Float32Array, Uint8Array, Uint16Array, Uint32Array, Int8Array, Int16Array];

// Places in the lists of wasm/api.cpp.
const array = {
  codec: 0, encoder: 1, name: 2, times: 3, triangles: 4, surfaceOf: 5, attributeName: 6, attributeValues: 7,
  attributeIndices: 8, material: 9, group: 10, assetName: 11, assetType: 12, assetBytes: 13,
  mean: 20, basis: 21, coefficients: 22, frames: 23,
};
const number = {
  vertices: 0, codedVertices: 1, triangles: 2, frames: 3, order: 4, loop: 5, up: 6, metresPerUnit: 7, fps: 8,
  attributes: 9, domain: 10, type: 11, components: 12, normalized: 13, materials: 14, groups: 15, assets: 16,
  firstFrame: 20, frameCount: 21, K: 22,
};

/// One file's decoder. After an error, or when the file is done, close() it: its memory goes with it.
export class Decoder {
  #wasm;
  #handle;

  /// module: a compiled WebAssembly.Module. coarseLevel: the level of detail to show before the first segment is whole, 0:
  /// none; levelAlone: of every segment that level and nothing else. maxMemory: bytes that a file may ask for.
  /// base: { vertexCount, triangles } of a file made against a base mesh.
  static async create(module, { coarseLevel = 0, levelAlone = false, maxMemory = 2 ** 30, base = null } = {}) {
    const decoder = new Decoder();
    const text = (view) => { // of a std::string_view
      const { buffer } = decoder.#wasm.memory;
      const [at, size] = new Uint32Array(buffer, view, 2);
      return new TextDecoder().decode(new Uint8Array(buffer, at, size));
    };
    const instance = await WebAssembly.instantiate(module, {
      host: {
        raise(code, byte, message, field) {
          throw new ReelError(text(message).trim(), { code, byte, field: text(field) });
        },
      },
      wasi_snapshot_preview1: {
        proc_exit() {
          throw new ReelError('the file needs more memory than there is');
        },
      },
    });
    decoder.#wasm = instance.exports;
    decoder.#wasm._initialize();
    decoder.#handle = decoder.#wasm.open(coarseLevel, levelAlone ? 1 : 0, Math.min(maxMemory, 2 ** 31));
    if (base) {
      const at = decoder.#call('base', base.vertexCount, base.triangles.length / 3);
      new Uint32Array(decoder.#wasm.memory.buffer, at, base.triangles.length).set(base.triangles);
    }
    return decoder;
  }

  /// The next bytes of the file.
  push(bytes) {
    const at = this.#call('room', bytes.length);
    new Uint8Array(this.#wasm.memory.buffer, at, bytes.length).set(bytes);
    this.#call('receive', bytes.length);
  }

  /// What the bytes so far allow: { type: 'head', head }, { type: 'level', piece }, { type: 'segment', piece },
  /// { type: 'done' }. complete: no more bytes come. @throws ReelError
  *take(complete = false) {
    for (;;) {
      const type = events[this.#call('step', complete ? 1 : 0)];
      if (type === 'none') return;
      if (type === 'head') yield { type, head: this.#head() };
      else if (type === 'done') return yield { type };
      else yield { type, piece: this.#piece(type === 'level') };
    }
  }

  /// The exact positions of the piece taken last, [frames x 3 vertices], as `meshreel decode` gives them.
  frames() {
    this.#call('frames');
    return this.#array(Float32Array, array.frames);
  }

  /// XXH3-64 of bytes, for tests.
  hash(bytes) {
    const at = this.#call('allocate', bytes.byteLength);
    new Uint8Array(this.#wasm.memory.buffer, at, bytes.byteLength)
      .set(new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength));
    return BigInt.asUintN(64, this.#call('hash', at, bytes.byteLength));
  }

  close() {
    this.#wasm = null;
  }

  /// A trap of the machine, as out of memory, becomes an error of ours.
  #call(name, ...values) {
    if (!this.#wasm) throw new ReelError('the decoder is closed', { code: 1 });
    const call = this.#wasm[name];
    try {
      return name === 'frames' || name === 'step' || name === 'room' || name === 'receive' || name === 'base'
        ? call(this.#handle, ...values) >>> 0 : call(...values);
    } catch (error) {
      this.close();
      if (error instanceof WebAssembly.RuntimeError) throw new ReelError(`the decoder stopped: ${error.message}`);
      throw error;
    }
  }

  #array(Type, what, i = 0) {
    const at = this.#wasm.at(this.#handle, what, i) >>> 0;
    const size = this.#wasm.size(this.#handle, what, i) >>> 0;
    return new Type(this.#wasm.memory.buffer.slice(at, at + size));
  }
  #text(what, i = 0) {
    return new TextDecoder().decode(this.#array(Uint8Array, what, i));
  }
  #number(what, i = 0) {
    return this.#wasm.number(this.#handle, what, i);
  }
  #list(count, item) {
    return Array.from({ length: this.#number(count) }, (_, i) => item(i));
  }

  #head() {
    return {
      codec: this.#text(array.codec),
      encoder: this.#text(array.encoder),
      order: orders[this.#number(number.order)],
      vertexCount: this.#number(number.vertices),
      codedVertexCount: this.#number(number.codedVertices),
      triangleCount: this.#number(number.triangles),
      frameCount: this.#number(number.frames),
      name: this.#text(array.name),
      loop: this.#number(number.loop) !== 0,
      up: axes[this.#number(number.up)],
      metresPerUnit: this.#number(number.metresPerUnit),
      fps: this.#number(number.fps),
      times: this.#array(Float64Array, array.times),
      surface: this.#surface(this.#array(Uint32Array, array.surfaceOf)),
      materials: this.#list(number.materials, (i) => this.#text(array.material, i)),
      groups: this.#list(number.groups, (i) => this.#text(array.group, i)),
      assets: this.#list(number.assets, (i) => ({
        name: this.#text(array.assetName, i),
        mimeType: this.#text(array.assetType, i),
        bytes: this.#array(Uint8Array, array.assetBytes, i),
      })),
    };
  }

  /// Triangles and attributes; rowOf: the row of the coefficients that each vertex has, null: its own.
  #surface(rowOf) {
    const triangles = this.#array(Uint32Array, array.triangles);
    return { triangles, rowOf, attributes: this.#list(number.attributes, (i) => this.#attribute(i)) };
  }

  #attribute(i) {
    const indices = this.#array(Uint32Array, array.attributeIndices, i);
    return {
      name: this.#text(array.attributeName, i),
      domain: domains[this.#number(number.domain, i)],
      components: this.#number(number.components, i),
      normalized: this.#number(number.normalized, i) !== 0,
      values: this.#array(scalars[this.#number(number.type, i)], array.attributeValues, i),
      indices: indices.length > 0 ? indices : null,
    };
  }

  #piece(coarse) {
    const K = this.#number(number.K);
    return {
      firstFrame: this.#number(number.firstFrame),
      frameCount: this.#number(number.frameCount),
      /// t(v, f) = mean(f) + sum_k coefficients[row of v, k] basis(k, f); an exact codec has none of these, only frames.
      exact: K < 0,
      K: Math.max(K, 0),
      mean: this.#array(Float64Array, array.mean), // [3 frames], all x, then all y, all z
      basis: this.#array(Float64Array, array.basis), // [K x 3 frames], likewise
      coefficients: this.#array(Float64Array, array.coefficients), // [rows x K]
      surface: coarse ? this.#surface(null) : null, // of a level; null: the head's
    };
  }
}
