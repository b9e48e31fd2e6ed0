/// Reads back from the graphics card what a reel's materials make of its vertices: for tests, and whoever doubts.
// SPDX-License-Identifier: MIT
import { Camera, FloatType, NearestFilter, Points, Scene, ShaderMaterial, WebGLRenderTarget } from 'three';

const vertexShader = /* glsl */ `
varying vec4 shown;
uniform int width, what;
#include <common>
void main() {
  #include <beginnormal_vertex>
  #include <begin_vertex>
  shown = vec4( what == 0 ? transformed : objectNormal, 1.0 );
  gl_Position = vec4( ( vec2( gl_VertexID % width, gl_VertexID / width ) + 0.5 ) / float( width ) * 2.0 - 1.0, 0.0, 1.0 );
  gl_PointSize = 1.0;
}`;
const fragmentShader = 'varying vec4 shown; void main() { gl_FragColor = shown; }';

/// [3 x vertices shown]: positions (0) or normals (1), out of the very chunks that every material gets.
export function readBack(renderer, mesh, what) {
  const count = mesh.geometry.attributes.position.count, width = Math.ceil(Math.sqrt(count));
  const material = mesh.worn(new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { width: { value: width }, what: { value: what } } }));
  const geometry = mesh.geometry.clone().setIndex(null);
  geometry.clearGroups();
  const points = new Points(geometry, material), scene = new Scene().add(points);
  points.frustumCulled = false;
  const target = new WebGLRenderTarget(width, width, { type: FloatType, minFilter: NearestFilter, magFilter: NearestFilter });
  renderer.setRenderTarget(target);
  renderer.render(scene, new Camera());
  const pixels = new Float32Array(4 * width * width);
  renderer.readRenderTargetPixels(target, 0, 0, width, width, pixels);
  renderer.setRenderTarget(null);
  for (const each of [target, geometry, material]) each.dispose();
  return Float32Array.from({ length: 3 * count }, (_, i) => pixels[4 * ((i / 3) | 0) + (i % 3)]);
}
