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
