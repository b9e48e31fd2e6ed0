/// ReelLoader: a .reel file as a mesh that plays.
// SPDX-License-Identifier: MIT
import { Loader } from 'three';

import { ReelError, decodeReel, decoderModule, disposeDecoder } from './decode.js';
import { ReelClip, ReelMesh } from './reel.js';

export class ReelLoader extends Loader {
  constructor(manager) {
    super(manager);
    this.all = false; ///< whether files of every codec are read
    this.decodeOptions = {};
  }

  /// Fetches and compiles the decoder, so that the first file need not wait for it.
  preload() {
    return decoderModule(this.all);
  }

  /// The clip in a file: of an address, an ArrayBuffer, a Response, a stream, a Blob. @throws ReelError
  async loadClip(source, { onEvent, ...options } = {}) {
    let head = null;
    const pieces = [];
    for await (const event of decodeReel(source, { all: this.all, single: true, ...this.decodeOptions, ...options })) {
      if (event.type === 'head') head = event.head;
      if (event.type === 'segment') pieces.push(event.piece);
      onEvent?.(event);
    }
    return new ReelClip(head, pieces);
  }

  /// Clips of a file on its way, each of more than the one before: of level `coarseLevel` of the first segment (2; 0: none), of
  /// the segments so far, of all. mesh.change() puts them on; whoever took one disposes of it. @throws ReelError
  async *loadClips(source, { onEvent, coarseLevel = 2, ...options } = {}) {
    let head = null, told = 0;
    const pieces = [];
    for await (const event of decodeReel(source, { all: this.all, single: true, coarseLevel, ...this.decodeOptions, ...options })) {
      onEvent?.(event);
      if (event.type === 'head') head = event.head;
      if (event.type === 'level') yield new ReelClip(head, [event.piece]);
      if (event.type !== 'segment') continue;
      pieces.push(event.piece);
      const whole = event.piece.firstFrame + event.piece.frameCount === head.frameCount;
      if (!whole && pieces.length < 2 * told) continue; // tables are made anew each time
      told = pieces.length;
      yield new ReelClip(head, pieces);
    }
  }

  load(url, onLoad, onProgress, onError) {
    const address = this.manager.resolveURL((this.path ?? '') + url);
    this.manager.itemStart(address);
    const onEvent = ({ type, piece }) => type === 'segment' && onProgress?.({ frames: piece.firstFrame + piece.frameCount });
    this.#fetched(address)
      .then((response) => this.loadClip(response, { onEvent }))
      .then((clip) => onLoad?.(new ReelMesh(clip)))
      .catch((error) => {
        if (onError) onError(error);
        else console.error(error);
        this.manager.itemError(address);
      })
      .finally(() => this.manager.itemEnd(address));
  }

  async #fetched(address) {
    const credentials = this.crossOrigin === 'use-credentials' || this.withCredentials ? 'include' : 'same-origin';
    const response = await fetch(address, { credentials, headers: this.requestHeader });
    if (!response.ok) throw new ReelError(`${address}: ${response.status} ${response.statusText}`.trim(), { code: 2 });
    return response;
  }

  /// The mesh in an ArrayBuffer; also by callback, as other loaders do.
  parse(buffer, onLoad, onError) {
    const mesh = this.loadClip(buffer).then((clip) => new ReelMesh(clip));
    if (onLoad || onError) mesh.then(onLoad, onError ?? console.error);
    return mesh;
  }

  /// Ends the decoder's worker.
  dispose() {
    disposeDecoder();
    return this;
  }
}
