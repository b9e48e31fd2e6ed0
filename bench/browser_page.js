/// In the page of bench/browser.mjs: the same animation posed in three ways, and files opened up to their first picture.
// SPDX-License-Identifier: MIT
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'meshoptimizer';

import { decodeReel, disposeDecoder } from '../js/src/decode.js';
import { ReelLoader, ReelMesh } from '../js/src/index.js';
import { areaNormals } from '../js/src/surface.js';

const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector('canvas') }), gl = renderer.getContext();
renderer.setSize(512, 512, false);
const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000), scene = new THREE.Scene().add(new THREE.HemisphereLight(0xffffff, 0x888888, 3));

function show(mesh) {
  scene.children.length = 1;
  scene.add(mesh);
}
/// Renders, and waits for the card.
function picture() {
  renderer.render(scene, camera);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
}
function lookAt({ center, radius }) {
  camera.position.copy(center).add(new THREE.Vector3(0, 0, 3.4 * radius));
  camera.lookAt(center);
}

async function decoded(file) {
  const frames = [];
  let head = null;
  for await (const event of decodeReel(file, { frames: true })) {
    head ??= event.head;
    if (event.type !== 'segment') continue;
    const { frames: all, frameCount: F } = event.piece;
    for (let f = 0; f < F; ++f) frames.push(all.subarray((f * all.length) / F, ((f + 1) * all.length) / F));
  }
  return { head, frames, normals: frames.map((each) => Float32Array.from(areaNormals(each, head.surface.triangles))) };
}

/// Every frame a morph target, with its normals; two of them weigh at a time.
function morphs({ head, frames, normals }) {
  const most = Math.min(frames.length, gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS)), geometry = still(head, frames[0], normals[0]);
  const targets = (all) => all.slice(0, most).map((each, i) => new THREE.BufferAttribute(each.map((x, n) => x - all[0][n]), 3));
  Object.assign(geometry, { morphTargetsRelative: true, morphAttributes: { position: targets(frames), normal: targets(normals) } });
  const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial());
  const seek = (share) => {
    const at = share * (most - 1), low = Math.min(Math.floor(at), most - 2);
    mesh.morphTargetInfluences.fill(0);
    mesh.morphTargetInfluences[low] = 1 - at + low;
    mesh.morphTargetInfluences[low + 1] = at - low;
  };
  return { mesh, seek, bytes: 2 * 16 * head.vertexCount * most, frames: most };
}

function still(head, positions, normals) {
  const geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(head.surface.triangles, 1));
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3)).setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  return geometry;
}

/// Positions and normals of every frame in textures; two frames mixed.
function vertexTexture({ head, frames, normals }) {
  const V = head.vertexCount, F = frames.length, width = 2048, height = Math.ceil((V * F) / width);
  const texture = (all) => {
    const values = new Float32Array(4 * width * height);
    all.forEach((each, f) => { for (let v = 0; v < V; ++v) for (let c = 0; c < 3; ++c) values[4 * (f * V + v) + c] = each[3 * v + c]; });
    return Object.assign(new THREE.DataTexture(values, width, height, THREE.RGBAFormat, THREE.FloatType), { needsUpdate: true });
  };
  const uniforms = { places: { value: texture(frames) }, sides: { value: texture(normals) }, low: { value: 0 }, share: { value: 0 } };
  const material = new THREE.MeshStandardMaterial();
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    const mix = (name) => `mix( texelFetch( ${name}, at( low ), 0 ).xyz, texelFetch( ${name}, at( low + 1 ), 0 ).xyz, share )`;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\nuniform highp sampler2D places, sides; uniform int low; uniform float share;
        ivec2 at( int f ) { int i = f * ${V} + gl_VertexID; return ivec2( i & 2047, i >> 11 ); }`)
      .replace('#include <beginnormal_vertex>', `vec3 objectNormal = ${mix('sides')};`)
      .replace('#include <begin_vertex>', `vec3 transformed = ${mix('places')};`);
  };
  const mesh = new THREE.Mesh(still(head, frames[0], normals[0]), material);
  const seek = (share) => {
    uniforms.low.value = Math.min(Math.floor(share * (F - 1)), F - 2);
    uniforms.share.value = share * (F - 1) - uniforms.low.value;
  };
  return { mesh, seek, bytes: 2 * 16 * width * height, frames: F };
}

/// Milliseconds a picture: { name: { ms: [], bytes, frames } }, the ways in turn.
export async function frameTimes(file, rounds, each) {
  const data = await decoded(file), clip = await new ReelLoader().loadClip(file), mesh = new ReelMesh(clip, new THREE.MeshStandardMaterial());
  const reel = { mesh, seek: (share) => mesh.player.seek(share * mesh.player.duration), bytes: clip.gpuBytes, frames: data.frames.length };
  const ways = { reel, 'morph targets': morphs(data), 'vertex animation texture': vertexTexture(data) }, found = {};
  lookAt(clip.geometry.boundingSphere);
  for (const [name, way] of Object.entries(ways)) {
    way.mesh.frustumCulled = false;
    found[name] = { ms: [], bytes: way.bytes, frames: way.frames };
    show(way.mesh);
    picture();
  }
  for (let r = 0; r < rounds; ++r)
    for (const [name, { mesh: shown, seek }] of Object.entries(ways)) {
      show(shown);
      for (let i = 0; i < each; ++i) {
        const start = performance.now();
        seek((0.37 * (r * each + i)) % 1);
        picture();
        found[name].ms.push(performance.now() - start);
      }
    }
  return found;
}

/// Drawn with nothing in it, while the worker decodes.
function waiting() {
  const mesh = new ReelMesh(null, new THREE.MeshStandardMaterial());
  show(mesh);
  renderer.render(scene, camera);
  return mesh;
}
function wear(mesh, clip) {
  mesh.change(clip);
  lookAt(clip.geometry.boundingSphere);
}
async function openReel(file) {
  const coming = new ReelLoader().loadClip(file), mesh = waiting();
  wear(mesh, await coming);
}
/// A coarse level, before all is there.
async function openCoarse(file) {
  const clips = new ReelLoader().loadClips(file), first = clips.next(), mesh = waiting();
  wear(mesh, (await first).value);
}
async function openGltf(file) {
  await MeshoptDecoder.ready;
  const { scene: found } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync(file);
  show(found);
}
/// One mesh with positions, and attributes of many frames each.
async function openDraco(file) {
  const bytes = new Int8Array(await (await fetch(file)).arrayBuffer());
  const draco = await DracoDecoderModule({ locateFile: (name) => `/js/node_modules/draco3d/${name}` });
  const decoder = new draco.Decoder(), mesh = new draco.Mesh();
  const status = decoder.DecodeArrayToMesh(bytes, bytes.length, mesh);
  if (!status.ok()) throw new Error(status.error_msg());
  const V = mesh.num_points(), frames = [];
  for (let i = 0; i < mesh.num_attributes(); ++i) {
    const attribute = decoder.GetAttribute(mesh, i), count = attribute.num_components() * V, at = draco._malloc(4 * count);
    decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, draco.DT_FLOAT32, 4 * count, at);
    frames.push(new Float32Array(draco.HEAPF32.buffer, at, count).slice());
    draco._free(at);
  }
  const size = 12 * mesh.num_faces(), at = draco._malloc(size);
  decoder.GetTrianglesUInt32Array(mesh, size, at);
  const triangles = new Uint32Array(draco.HEAPU8.buffer, at, size / 4).slice();
  const geometry = still({ surface: { triangles } }, frames[0], Float32Array.from(areaNormals(frames[0], triangles)));
  show(new THREE.Mesh(geometry, new THREE.MeshStandardMaterial()));
}

/// Milliseconds from the click to the first picture. The code is there, nothing of it compiled.
export async function firstPicture(name, file) {
  const ways = { reel: openReel, coarse: openCoarse, gltfpack: openGltf, draco: openDraco };
  picture();
  const start = performance.now();
  await ways[name](file);
  picture();
  const ms = performance.now() - start;
  disposeDecoder();
  return ms;
}
