/// meshreel/webgpu in a browser: by WebGPU where Chromium has an adapter, and by WebGL 2 behind the same renderer.
// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { missing, stagedPage } from './page.mjs';

const golden = (name) => `/tests/golden/reel_v1_${name}.reel`, walker = golden('fast_walker');
const backends = [['WebGPU', false], ['WebGL 2 behind WebGPURenderer', true]];
const skip = missing || false;
let page, complaints, adapter = false;
stagedPage('/js/test/nodes_stage.js', async (...made) => {
  [page, complaints] = made;
  adapter = await page.evaluate(async () => !!(await navigator.gpu?.requestAdapter()));
});

/// The same test of both; without an adapter that of WebGPU is skipped by name.
function testBoth(name, run) {
  for (const [backend, forced] of backends)
    test(`${backend}: ${name}`, { skip }, async (context) => {
      if (!forced && !adapter) return context.skip('this Chromium has no WebGPU adapter');
      complaints.length = 0;
      await page.evaluate(async (force) => (window.renderer = await stage.rendererOf(force)), forced);
      await run();
      await page.evaluate(() => renderer.dispose());
      assert.deepEqual(complaints, []);
    });
}

testBoth('the decoder\'s positions to 1e-5 of the diagonal, within segments and where they meet; between frames, and its normals, those of WebGLRenderer', async () => {
  const worst = await page.evaluate(async (files) => {
    const { ReelLoader, readBack, readBackWebGL, decodedFrames, difference, diagonalOf } = stage, found = { places: 0, between: 0, normals: 0 };
    const take = (what, far) => (found[what] = Math.max(found[what], far));
    for (const file of files) {
      const mesh = await new ReelLoader().loadAsync(file), { head: { times }, frames } = await decodedFrames(file), diagonal = diagonalOf(frames[0]);
      for (const f of [0, frames.length >> 1, frames.length - 1]) {
        mesh.player.seek(times[f] - times[0]);
        take('places', difference(await readBack(renderer, mesh, 0), frames[f], diagonal));
      }
      for (const f of [1, 3]) { // where segments meet
        mesh.player.seek(0.7 * times[f] + 0.3 * times[f + 1] - times[0]);
        take('between', difference(await readBack(renderer, mesh, 0), readBackWebGL(mesh, 0), diagonal));
        take('normals', difference(await readBack(renderer, mesh, 1), readBackWebGL(mesh, 1), 1));
      }
      mesh.dispose();
      mesh.clip.dispose();
    }
    return found;
  }, ['range', 'segments_walker'].map(golden));
  assert.ok(worst.places < 1e-5 && worst.between < 1e-5 && worst.normals < 1e-3, JSON.stringify(worst));
});

testBoth('in a crowd each instance has its own phase, place and shadow: it looks as single meshes do', async () => {
  const share = await page.evaluate(async (file) => {
    const { ReelLoader, ReelCrowd, ReelMesh, THREE, pixelsOf, sceneOf } = stage, clip = await new ReelLoader().loadClip(file), { duration } = clip.timeline;
    const { boundingSphere: sphere } = clip.geometry, material = new THREE.MeshStandardMaterial({ color: 0x88aaff }), crowd = new ReelCrowd(clip, material, 3);
    const singles = [0, 1, 2].map((i) => {
      const mesh = new ReelMesh(clip, material), phase = 0.31 * i * duration;
      mesh.position.x = (i - 1) * sphere.radius;
      mesh.rotation.y = i;
      mesh.updateMatrix();
      crowd.setMatrixAt(i, mesh.matrix);
      crowd.setPhaseAt(i, phase);
      mesh.player.seek((phase + 0.2 * duration) % duration);
      return mesh;
    });
    crowd.player.seek(0.2 * duration);
    renderer.shadowMap.enabled = true;
    const shots = [];
    for (const meshes of [[crowd], singles]) {
      for (const mesh of meshes) mesh.castShadow = mesh.receiveShadow = true;
      const { scene, camera } = sceneOf(meshes, sphere);
      shots.push(await pixelsOf(renderer, scene, camera, 128));
    }
    return { differ: shots[0].filter((x, i) => Math.abs(x - shots[1][i]) > 0.02).length / shots[0].length, seen: new Set(shots[0].map((x) => Math.round(20 * x))).size };
  }, walker);
  assert.ok(share.differ < 0.001 && share.seen > 5, JSON.stringify(share));
});

testBoth('several standard materials, lights, shadows that move with it, clips of a file on its way', async () => {
  const seen = await page.evaluate(async (file) => {
    const { ReelLoader, ReelMesh, THREE, pixelsOf, sceneOf } = stage, mesh = new ReelMesh();
    renderer.shadowMap.enabled = true;
    mesh.castShadow = mesh.receiveShadow = true;
    const { scene, camera } = sceneOf([mesh], new THREE.Sphere(new THREE.Vector3(), 1)), told = [];
    await pixelsOf(renderer, scene, camera, 8); // before anything is there
    for await (const clip of new ReelLoader().loadClips(file)) {
      const before = mesh.clip;
      mesh.change(clip);
      if (told.push(clip.geometry.attributes.position.count) > 1) before.dispose();
    }
    const { scene: whole, camera: eye } = sceneOf([mesh], mesh.geometry.boundingSphere), pixels = async (time, casts) => {
      mesh.castShadow = casts;
      mesh.player.seek(time * mesh.player.duration);
      return pixelsOf(renderer, whole, eye, 128);
    };
    const shadow = async (time) => {
      const [without, with_] = [await pixels(time, false), await pixels(time, true)];
      return with_.map((x, i) => (without[i] - x > 0.05 ? 1 : 0));
    };
    const first = await shadow(0.1), second = await shadow(0.6), count = (values) => values.reduce((a, b) => a + b, 0);
    return { told, shadow: count(first), moved: count(first.map((x, i) => Math.abs(x - second[i]))), materials: [mesh.material].flat().map(({ name }) => name) };
  }, golden('dressed'));
  assert.ok(seen.shadow > 100 && seen.moved > 30, JSON.stringify(seen));
  assert.deepEqual(seen.materials, ['silk', 'wool']);
});

testBoth('loaded and disposed of again and again, nothing stays', async () => {
  const grown = await page.evaluate(async (file) => {
    const { ReelLoader, pixelsOf, sceneOf } = stage, loader = new ReelLoader(), bytes = await (await fetch(file)).arrayBuffer();
    const cycles = async (n) => {
      for (let i = 0; i < n; ++i) {
        const mesh = await loader.parse(bytes.slice(0)), { scene, camera } = sceneOf([], mesh.geometry.boundingSphere);
        scene.children = [mesh];
        await pixelsOf(renderer, scene, camera, 8);
        mesh.dispose();
        mesh.clip.dispose();
      }
      const { textures, geometries, attributes, programs } = renderer.info.memory;
      return { textures, geometries, attributes, programs };
    };
    const before = await cycles(2), later = await cycles(5);
    return Object.fromEntries(Object.entries(later).map(([key, value]) => [key, value - before[key]]));
  }, walker);
  assert.ok(Object.values(grown).every((n) => !(n > 0)), JSON.stringify(grown));
});
