/// ReelLoader: a .reel file as a mesh that plays.
// SPDX-License-Identifier: MIT
import { Loader } from 'three';

import { ReelClip } from './clip.js';
import { decodeClips, startClipWorker } from './clips.js';
import { ReelError, decoderModule, disposeDecoder } from './decode.js';
import { ReelMesh } from './reel.js';

export class ReelLoader extends Loader {
  static Mesh = ReelMesh;

  constructor(manager) {
    super(manager);
    this.all = false; ///< whether files of every codec are read
    this.decodeOptions = {};
  }

  /// Fetches and compiles the decoder and starts its worker, so that the first file need not wait for them.
  preload() {
    startClipWorker();
    return decoderModule(this.all);
  }

  /// The clip in a file: of an address, an ArrayBuffer, a Response, a stream, a Blob. @throws ReelError
  async loadClip(source, options) {
    let found = null;
    for await (const made of this.#made(source, options)) found = made;
    return new ReelClip(found.head, found.data);
  }

  /// Clips of a file on its way, each of more than the one before: of level `coarseLevel` of the first segment (2; 0: none), of
  /// the segments so far, of all. mesh.change() puts them on; whoever took one disposes of it. @throws ReelError, after a clip of
  /// what was whole
  async *loadClips(source, options) {
    for await (const { head, data } of this.#made(source, { steps: true, coarseLevel: 2, ...options })) yield new ReelClip(head, data);
  }

  async *#made(source, { onEvent, ...options } = {}) {
    let head = null;
    for await (const event of decodeClips(source, { all: this.all, ...this.decodeOptions, ...options })) {
      if (event.type === 'head') head = event.head;
      if (event.type === 'clip') yield { head, data: event.data };
      else onEvent?.(event);
    }
  }

  load(url, onLoad, onProgress, onError) {
    const address = this.manager.resolveURL((this.path ?? '') + url);
    this.manager.itemStart(address);
    const onEvent = ({ type, piece }) => type === 'segment' && onProgress?.({ frames: piece.firstFrame + piece.frameCount });
    this.#fetched(address)
      .then((response) => this.loadClip(response, { onEvent }))
      .then((clip) => onLoad?.(this.#mesh(clip)))
      .catch((error) => {
        if (onError) onError(error);
        else console.error(error);
        this.manager.itemError(address);
      })
      .finally(() => this.manager.itemEnd(address));
  }

  #mesh(clip) {
    return new this.constructor.Mesh(clip);
  }

  async #fetched(address) {
    const credentials = this.crossOrigin === 'use-credentials' || this.withCredentials ? 'include' : 'same-origin';
    const response = await fetch(address, { credentials, headers: this.requestHeader });
    if (!response.ok) throw new ReelError(`${address}: ${response.status} ${response.statusText}`.trim(), { code: 2 });
    return response;
  }

  /// The mesh in an ArrayBuffer; also by callback, as other loaders do.
  parse(buffer, onLoad, onError) {
    const mesh = this.loadClip(buffer).then((clip) => this.#mesh(clip));
    if (onLoad || onError) mesh.then(onLoad, onError ?? console.error);
    return mesh;
  }

  /// Ends the decoder's worker.
  dispose() {
    disposeDecoder();
    return this;
  }
}
