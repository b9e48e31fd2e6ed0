/// Types of meshreel and meshreel/webgpu for three.js.
// SPDX-License-Identifier: MIT
import type {
  AnimationActionLoopStyles, BufferGeometry, EventDispatcher, InstancedMesh, Loader, LoadingManager, Material, Mesh, MeshStandardMaterial,
} from 'three';
import type { DecodeOptions, ReelHead, ReelPiece, ReelSource } from './decode.js';

export { ReelError, decodeReel } from './decode.js';
export type * from './decode.js';

/** One decoded file on the GPU, which meshes and crowds share. */
export declare class ReelClip {
  constructor(head: ReelHead, pieces: ReelPiece[]);
  readonly head: ReelHead;
  readonly geometry: BufferGeometry;
  readonly gpuBytes: number;
  readonly timeline: { readonly times: Float64Array; readonly period: number; readonly start: number; readonly duration: number };
  /** Positions of the rows, [3 rows], at seconds from the first frame, as the GPU shows them. */
  rowsAt(time: number, out?: Float32Array): Float32Array;
  /** Where a row is in every stored frame, [3 F]. */
  pathOf(row: number): Float32Array;
  materials(): MeshStandardMaterial | MeshStandardMaterial[];
  dispose(): void;
}

export declare class ReelPlayer extends EventDispatcher<{ loop: { direction: number }; finished: { direction: number } }> {
  readonly duration: number;
  /** Seconds from the first frame; seek() changes it. */
  readonly time: number;
  /** Below 0: backwards. */
  speed: number;
  loop: AnimationActionLoopStyles;
  readonly playing: boolean;
  play(): this;
  pause(): this;
  reverse(): this;
  seek(time: number): this;
  update(seconds: number): void;
}

interface Worn {
  readonly clip: ReelClip;
  readonly player: ReelPlayer;
  /** Puts on clones of other materials, and disposes of those it wore. */
  wear(material: Material | Material[]): this;
  /** A clone that this object could wear. */
  worn<M extends Material>(material: M): M;
}

export declare class ReelMesh extends Mesh<BufferGeometry, Material | Material[]> implements Worn {
  /** Without a clip nothing is to be seen until change(). */
  constructor(clip?: ReelClip | null, material?: Material | Material[]);
  readonly isReelMesh: true;
  readonly clip: ReelClip;
  readonly player: ReelPlayer;
  wear(material: Material | Material[]): this;
  worn<M extends Material>(material: M): M;
  /** Shows another clip from now on, of a surface with as many materials. */
  change(clip: ReelClip): this;
  dispose(): void;
}

export declare class ReelCrowd extends InstancedMesh<BufferGeometry, Material | Material[]> implements Worn {
  constructor(clip: ReelClip, material: Material | Material[] | undefined, count: number);
  readonly isReelCrowd: true;
  readonly clip: ReelClip;
  readonly player: ReelPlayer;
  setPhaseAt(i: number, seconds: number): void;
  wear(material: Material | Material[]): this;
  worn<M extends Material>(material: M): M;
  dispose(): this;
}

/** What a file told of itself. The numbers of its pieces stay in the worker. */
export type ReelNews =
  | { type: 'head'; head: ReelHead }
  | { type: 'level' | 'segment'; piece: Omit<ReelPiece, 'mean' | 'basis' | 'coefficients'> }
  | { type: 'done' };
export type ClipOptions = DecodeOptions & { onEvent?: (event: ReelNews) => void };

export declare class ReelLoader extends Loader<ReelMesh> {
  constructor(manager?: LoadingManager);
  /** Whether files of every codec are read. */
  all: boolean;
  decodeOptions: DecodeOptions;
  preload(): Promise<WebAssembly.Module>;
  load(url: string, onLoad?: (mesh: ReelMesh) => void, onProgress?: (progress: any) => void, onError?: (error: unknown) => void): void;
  loadClip(source: ReelSource, options?: ClipOptions): Promise<ReelClip>;
  /** Clips of a file on its way, each of more than the one before: a coarse level, the segments so far, all. */
  loadClips(source: ReelSource, options?: ClipOptions): AsyncGenerator<ReelClip, void, void>;
  parse(buffer: ArrayBuffer, onLoad?: (mesh: ReelMesh) => void, onError?: (error: unknown) => void): Promise<ReelMesh>;
  dispose(): this;
}
