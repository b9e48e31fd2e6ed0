/// In the page: WebGPURenderer, and what its shaders make of a reel's vertices.
// SPDX-License-Identifier: MIT
import * as THREE from 'three/webgpu';
import { float, int, normalLocal, positionLocal, varying, vec2, vec4, vertexIndex } from 'three/tsl';

export { THREE };
export * from '../src/webgpu.js';
export { decodedFrames, diagonalOf, difference } from './frames.js';
export { readBack as readBackWebGL } from './stage.js';

/// A renderer of its own canvas: by WebGPU, or by WebGL 2 instead.
export async function rendererOf(forceWebGL) {
  const renderer = new THREE.WebGPURenderer({ canvas: document.createElement('canvas'), forceWebGL });
  await renderer.init();
  if (!!renderer.backend.isWebGPUBackend === forceWebGL) throw new Error('another backend than asked for');
  return renderer;
}

/// Rows from the lower left: float32 RGBA of size x size pixels.
export async function pixelsOf(renderer, scene, camera, size) {
  const target = new THREE.RenderTarget(size, size, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const read = await renderer.readRenderTargetPixelsAsync(target, 0, 0, size, size), stride = read.length / size;
  renderer.setRenderTarget(null);
  target.dispose();
  const rows = Array.from({ length: size }, (_, y) => read.subarray(y * stride, y * stride + 4 * size)), pixels = new Float32Array(4 * size * size);
  if (renderer.backend.isWebGPUBackend) rows.reverse();
  rows.forEach((row, y) => pixels.set(row, 4 * size * y));
  return pixels;
}

/// [3 x vertices shown]: positions (0) or normals (1), by the very nodes that its materials have.
export async function readBack(renderer, mesh, what) {
  const count = mesh.geometry.attributes.position.count, size = Math.ceil(Math.sqrt(count));
  const material = mesh.worn(new THREE.NodeMaterial()), i = int(vertexIndex);
  const place = vec2(float(i.mod(size)), float(i.div(size))).add(0.5).div(size).mul(2).sub(1);
  material.vertexNode = vec4(place, 0, 1);
  material.fragmentNode = vec4(varying(what === 0 ? positionLocal : normalLocal), 1);
  const geometry = mesh.geometry.clone().setIndex(null);
  geometry.clearGroups();
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;
  const pixels = await pixelsOf(renderer, new THREE.Scene().add(points), new THREE.OrthographicCamera(), size);
  for (const each of [material, geometry]) each.dispose();
  return Float32Array.from({ length: 3 * count }, (_, at) => pixels[4 * ((at / 3) | 0) + (at % 3)]);
}

/// A lit scene that a mesh is in the middle of, above a floor on which shadows fall, and its camera.
export function sceneOf(meshes, { center, radius }) {
  const camera = new THREE.PerspectiveCamera(45, 1, 0.01 * radius, 100 * radius), light = new THREE.DirectionalLight(0xffffff, 3);
  camera.position.copy(center).add(new THREE.Vector3(0, 2 * radius, 4 * radius));
  camera.lookAt(center);
  light.position.copy(center).add(new THREE.Vector3(radius, 4 * radius, radius));
  light.target.position.copy(center);
  Object.assign(light.shadow.camera, { left: -3 * radius, right: 3 * radius, top: 3 * radius, bottom: -3 * radius, near: radius, far: 9 * radius });
  light.castShadow = true;
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(20 * radius, 20 * radius).rotateX(-Math.PI / 2), new THREE.MeshStandardMaterial());
  floor.position.y = center.y - 1.1 * radius;
  floor.receiveShadow = true;
  return { scene: new THREE.Scene().add(light, light.target, floor, ...meshes), camera };
}
