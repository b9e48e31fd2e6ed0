/// Types of the decoder.
// SPDX-License-Identifier: MIT
export declare class ReelError extends Error {
  /** 3: the file is wrong; 5: it needs what this decoder lacks; 2: it could not be fetched; 1: misuse; 4: anything else. */
  code: number;
  /** Where in the file; -1: nowhere. */
  byte: number;
  field: string;
  constructor(message: string, about?: { code?: number; byte?: number; field?: string });
}

export interface ReelAttribute {
  name: string;
  domain: 'vertex' | 'corner' | 'triangle';
  components: number;
  normalized: boolean;
  values: Float32Array | Uint8Array | Uint16Array | Uint32Array | Int8Array | Int16Array;
  /** One an element, into values; 0xffffffff: none. null: element i has value i. */
  indices: Uint32Array | null;
}

export interface ReelSurface {
  /** Three vertices each. */
  triangles: Uint32Array;
  /** Row of the coefficients that each vertex has; null: its own. */
  rowOf: Uint32Array | null;
  attributes: ReelAttribute[];
}

export interface ReelHead {
  codec: string;
  encoder: string;
  order: 'keep' | 'free' | 'base';
  vertexCount: number;
  codedVertexCount: number;
  triangleCount: number;
  frameCount: number;
  name: string;
  loop: boolean;
  up: 'unknown' | 'x' | 'y' | 'z';
  metresPerUnit: number;
  fps: number;
  /** Seconds, strictly increasing. */
  times: Float64Array;
  surface: ReelSurface;
  materials: string[];
  groups: string[];
  assets: { name: string; mimeType: string; bytes: Uint8Array }[];
}

/** A run of frames: position of v in frame f = mean(f) + sum over k of coefficients[row of v, k] basis(k, f). */
export interface ReelPiece {
  firstFrame: number;
  frameCount: number;
  /** No coefficients, only frames. */
  exact: boolean;
  K: number;
  /** [3 frames]: all x, all y, all z. */
  mean: Float64Array;
  /** [K x 3 frames], likewise. */
  basis: Float64Array;
  /** [rows x K] */
  coefficients: Float64Array | Float32Array;
  /** Of a level of detail; null: the head's. */
  surface: ReelSurface | null;
  /** [frames x 3 vertices], where asked for. */
  frames?: Float32Array;
}

export type ReelEvent =
  | { type: 'head'; head: ReelHead }
  | { type: 'level' | 'segment'; piece: ReelPiece }
  | { type: 'done' };

export interface DecoderOptions {
  coarseLevel?: number;
  /** Of every segment that level, and nothing else. */
  levelAlone?: boolean;
  maxMemory?: number;
  base?: { vertexCount: number; triangles: Uint32Array } | null;
}

export declare class Decoder {
  static create(module: WebAssembly.Module, options?: DecoderOptions): Promise<Decoder>;
  push(bytes: Uint8Array): void;
  take(complete?: boolean): Generator<ReelEvent, void, void>;
  frames(): Float32Array;
  hash(bytes: ArrayBufferView): bigint;
  close(): void;
}
