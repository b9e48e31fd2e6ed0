/// ReelLoader in a browser: what the GPU shows is what the decoder gives; control, crowds, shadows, errors, memory.
// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

import { missing, stagedPage } from './page.mjs';

const walker = '/tests/golden/reel_v1_fast_walker.reel', cloth = '/tests/golden/reel_v1_range.reel';
const skip = missing || false;
let page, complaints;
stagedPage('/js/test/stage.js', (...made) => ([page, complaints] = made));

test('posed on the GPU, every stored frame is the decoder\'s to 1e-5 of the diagonal, to the end and back', { skip }, async () => {
  for (const address of [walker, cloth]) {
    const worst = await page.evaluate(async (file) => {
      const { ReelLoader, readBack, decodedFrames, difference, diagonalOf } = stage;
      const mesh = await new ReelLoader().loadAsync(file);
      const { head, frames } = await decodedFrames(file);
      const diagonal = diagonalOf(frames[0]), order = frames.map((_, f) => f);
      let most = 0;
      for (const f of [...order, ...order.reverse()]) {
        mesh.player.seek(head.times[f] - head.times[0]);
        most = Math.max(most, difference(readBack(mesh, 0), frames[f], diagonal));
      }
      mesh.dispose();
      mesh.clip.dispose();
      return most;
    }, address);
    assert.ok(worst < 1e-5, `${address}: ${worst}`);
  }
});

test('between stored frames it shows the cubic through them', { skip }, async () => {
  const worst = await page.evaluate(async (file) => {
    const { ReelLoader, readBack, decodedFrames, difference, diagonalOf } = stage;
    const mesh = await new ReelLoader().loadAsync(file);
    const { head: { times }, frames } = await decodedFrames(file);
    const F = times.length, f = F >> 1, u = 0.3;
    mesh.player.seek(times[f] + u * (times[f + 1] - times[f]) - times[0]);
    const h = (p, q, r, s) => { // Catmull and Rom, times being uniform
      const m = (r - p) / 2, n = (s - q) / 2, v = 1 - u;
      return (1 + 2 * u) * v * v * q + u * v * v * m + u * u * (3 - 2 * u) * r - u * u * v * n;
    };
    const expected = frames[f].map((_, i) => h(frames[f - 1][i], frames[f][i], frames[f + 1][i], frames[f + 2][i]));
    return difference(readBack(mesh, 0), expected, diagonalOf(frames[0]));
  }, walker);
  assert.ok(worst < 1e-5, `${worst}`);
});

// The cloth has 150 vertices, lies flat at first and folds sharply: a vertex' normal there is a matter of taste.
test('normals follow the deformation', { skip }, async () => {
  for (const [address, median, p95] of [[walker, 0.5, 5], [cloth, 3, 25]]) {
    const found = await page.evaluate(async (file) => {
      const { ReelLoader, decodedFrames, normalAngles } = stage;
      const mesh = await new ReelLoader().loadAsync(file);
      const { head, frames } = await decodedFrames(file);
      const all = [];
      for (let f = 0; f < frames.length; ++f) {
        mesh.player.seek(head.times[f] - head.times[0]);
        all.push(normalAngles(mesh, frames[f], head.surface));
      }
      const sorted = all.flat().sort((a, b) => a - b), at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
      return { first: Math.max(...all[0]), median: at(0.5), p95: at(0.95) };
    }, address);
    assert.ok(found.first < 3, `${address}: at rest ${found.first} degrees`);
    assert.ok(found.median < median && found.p95 < p95, `${address}: ${JSON.stringify(found)}`);
  }
});

test('it plays, loops, turns, pauses and ends as it is told', { skip }, async () => {
  const seen = await page.evaluate(async (file) => {
    const { ReelLoader, THREE } = stage;
    const { player } = await new ReelLoader().loadAsync(file), { duration } = player, told = [];
    const at = () => +(player.time / duration).toFixed(3);
    for (const type of ['loop', 'finished']) player.addEventListener(type, (event) => told.push(`${type} ${event.direction}`));
    const times = [];
    const step = (share) => (player.update(share * duration), times.push(at()));
    player.play();
    step(0.5), step(0.75);
    player.reverse(), step(0.5);
    player.pause(), step(0.5);
    player.seek(0.9 * duration).play().reverse(), (player.loop = THREE.LoopPingPong), step(0.2), step(0.2);
    (player.loop = THREE.LoopOnce), (player.speed = 2), step(0.4);
    return { times, told, playing: player.playing };
  }, walker);
  assert.deepEqual(seen, { times: [0.5, 0.25, 0.75, 0.75, 0.9, 0.7, 1], told: ['loop 1', 'loop -1', 'loop 1', 'finished 1'], playing: false });
});

test('in a crowd each instance shows its own phase', { skip }, async () => {
  const worst = await page.evaluate(async (file) => {
    const { ReelLoader, ReelCrowd, THREE, readBack, difference, diagonalOf } = stage;
    const mesh = await new ReelLoader().loadAsync(file), { clip } = mesh, length = clip.timeline.duration;
    let most = 0;
    for (const [phase, time] of [[0, 0], [0.31, 0.2], [0.77, 0.6]]) {
      const crowd = new ReelCrowd(clip, new THREE.MeshBasicMaterial(), 1);
      crowd.geometry.attributes.reelPhase.array[0] = phase * length;
      crowd.player.seek(time * length);
      const shown = readBack(crowd, 0);
      mesh.player.seek(((phase + time) % 1) * length);
      const expected = readBack(mesh, 0);
      most = Math.max(most, difference(shown, expected, diagonalOf(expected)));
      crowd.dispose();
    }
    return most;
  }, walker);
  assert.ok(worst < 1e-4, `${worst}`);
});

test('to show a time nothing is uploaded but the basis mixed for it: 3 K + 4 numbers; where segments meet and in crowds not even that', { skip }, async () => {
  const { within, meeting, crowd, K } = await page.evaluate(async (file) => {
    const { ReelLoader, ReelCrowd, THREE, uploads } = stage, mesh = await new ReelLoader().loadAsync(file), { timeline, tables } = mesh.clip;
    const crowd = new ReelCrowd(mesh.clip, new THREE.MeshStandardMaterial(), 9), at = (frame) => ((frame / 11) * timeline.duration);
    for (const each of [mesh, crowd]) uploads(each, 0);
    const found = { within: uploads(mesh, at(1.5)), meeting: uploads(mesh, at(3.5)), crowd: uploads(crowd, at(5.5)) };
    for (const each of [mesh, crowd, mesh.clip]) each.dispose();
    return { ...found, K: 4 * Math.max(...tables.frames.filter((_, i) => i % 8 === 1)) };
  }, '/tests/golden/reel_v1_segments_walker.reel');
  assert.deepEqual([within, meeting, crowd], [[3 * K + 4], [], []]);
});

test('standard materials, several of them, lights and shadows: pixels change as it moves, shaders compile', { skip }, async () => {
  complaints.length = 0;
  const seen = await page.evaluate(async ([walk, dressed]) => {
    const { ReelLoader, ReelCrowd, THREE, renderer } = stage;
    renderer.shadowMap.enabled = true;
    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(45, 1, 0.01, 1000);
    for (const light of [new THREE.DirectionalLight(0xffffff, 2), new THREE.PointLight(0xffffff, 20)]) {
      light.castShadow = true;
      light.position.set(2, 4, 3);
      scene.add(light);
    }
    const mesh = await new ReelLoader().loadAsync(walk), other = await new ReelLoader().loadAsync(dressed);
    const crowd = new ReelCrowd(mesh.clip, new THREE.MeshPhysicalMaterial({ color: 0x3366cc }), 3);
    for (let i = 0; i < 3; ++i) {
      crowd.setMatrixAt(i, new THREE.Matrix4().makeTranslation(i - 1, 0, -1));
      crowd.setPhaseAt(i, 0.3 * i);
    }
    for (const each of [mesh, other, crowd]) {
      each.castShadow = each.receiveShadow = true;
      scene.add(each);
    }
    const { center, radius } = mesh.geometry.boundingSphere;
    camera.position.copy(center).add(new THREE.Vector3(0, 0, 4 * radius));
    camera.lookAt(center);
    const pixels = () => {
      renderer.render(scene, camera);
      const { drawingBufferWidth: w, drawingBufferHeight: h } = renderer.getContext();
      const all = new Uint8Array(4 * w * h);
      renderer.getContext().readPixels(0, 0, w, h, renderer.getContext().RGBA, renderer.getContext().UNSIGNED_BYTE, all);
      return all;
    };
    const first = pixels();
    mesh.player.seek(0.4 * mesh.player.duration);
    crowd.player.seek(0.4 * mesh.player.duration);
    const second = pixels();
    return { lit: first.filter((x, i) => i % 4 < 3 && x > 20).length, changed: first.filter((x, i) => Math.abs(x - second[i]) > 20).length,
      materials: [other.material].flat().map((each) => each.name), uv: 'uv' in other.geometry.attributes, groups: other.geometry.groups.length };
  }, [walker, '/tests/golden/reel_v1_dressed.reel']);
  assert.ok(seen.lit > 500 && seen.changed > 200, JSON.stringify(seen));
  assert.deepEqual(seen.materials, ['silk', 'wool']);
  assert.ok(seen.uv && seen.groups > 0);
  assert.deepEqual(complaints.filter((text) => /shader|program|GL_INVALID|THREE/i.test(text)), []);
});

test('a broken, a truncated and a missing file come to onError with a sentence', { skip }, async () => {
  const bytes = [...readFileSync(new URL('../../tests/golden/reel_v1_range.reel', import.meta.url))];
  const messages = await page.evaluate(async (values) => {
    const { ReelLoader } = stage, loader = new ReelLoader();
    loader.all = true;
    const whole = Uint8Array.from(values), broken = whole.slice();
    broken[broken.length >> 1] ^= 4;
    const told = (run) => run.then(() => 'nothing', (error) => error.message);
    return Promise.all([told(loader.parse(broken.buffer)), told(loader.parse(whole.slice(0, 900).buffer)),
      told(loader.loadAsync('/no/such.reel'))]);
  }, bytes);
  assert.match(messages[0], /byte \d+: SEGM.checksum: .*damaged/);
  assert.match(messages[1], /byte \d+: /);
  assert.match(messages[2], /404/);
});

test('a lossless file is posed float by float', { skip }, async () => {
  const worst = await page.evaluate(async (file) => {
    const { ReelLoader, readBack, decodeReel } = stage, loader = Object.assign(new ReelLoader(), { all: true });
    const mesh = await loader.loadAsync(file), frames = [];
    for await (const { piece } of decodeReel(file, { all: true })) if (piece) frames.push(...piece.frames);
    let most = 0;
    for (const [f, time] of mesh.clip.timeline.times.entries()) {
      mesh.player.seek(time - mesh.clip.timeline.start);
      readBack(mesh, 0).forEach((x, i, all) => (most = Math.max(most, Math.abs(x - frames[f * all.length + i]))));
    }
    return most;
  }, '/tests/golden/lossless_v1_floats.reel');
  assert.equal(worst, 0);
});

test('clips of a file on its way: a level, the segments so far, all; a mesh changes from one to the next', { skip }, async () => {
  const seen = await page.evaluate(async (file) => {
    const { ReelLoader, ReelMesh, THREE, renderer } = stage, loader = new ReelLoader(), told = [];
    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera();
    let mesh = null;
    for await (const clip of loader.loadClips(file)) {
      if (mesh) {
        const before = mesh.clip;
        mesh.change(clip);
        before.dispose();
      } else scene.add((mesh = new ReelMesh(clip)));
      renderer.render(scene, camera);
      told.push({ V: clip.geometry.attributes.position.count, F: clip.head.frameCount });
    }
    return { told, V: mesh.clip.head.vertexCount, F: mesh.clip.head.frameCount };
  }, '/tests/golden/reel_v1_range.reel');
  assert.ok(seen.told.length > 1 && seen.told[0].V < seen.V, JSON.stringify(seen));
  assert.deepEqual(seen.told.at(-1), { V: seen.V, F: seen.F });
});

test('a ray meets the pose that is shown', { skip }, async () => {
  const worst = await page.evaluate(async (file) => {
    const { ReelLoader, THREE, readBack } = stage, mesh = await new ReelLoader().loadAsync(file);
    mesh.player.seek(0.37 * mesh.player.duration);
    const shown = readBack(mesh, 0), [a, b, c] = [0, 1, 2].map((i) => new THREE.Vector3().fromArray(shown, 3 * mesh.geometry.index.array[i]));
    const middle = a.clone().add(b).add(c).divideScalar(3), normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    const ray = new THREE.Raycaster(middle.clone().addScaledVector(normal, 1e-3), normal.negate());
    const hit = ray.intersectObject(mesh)[0];
    return { far: hit.point.distanceTo(middle), face: hit.faceIndex, own: hit.object === mesh };
  }, walker);
  assert.ok(worst.far < 1e-4 && worst.face === 0 && worst.own, JSON.stringify(worst));
});

test('200 times loaded and disposed of, memory has not grown', { skip }, async () => {
  const grown = await page.evaluate(async (file) => {
    const { ReelLoader, THREE, renderer } = stage, loader = new ReelLoader();
    const bytes = await (await fetch(file)).arrayBuffer(), scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera();
    const cycle = async () => {
      const mesh = await loader.parse(bytes.slice(0));
      scene.add(mesh);
      renderer.render(scene, camera);
      scene.remove(mesh);
      mesh.dispose();
      mesh.clip.dispose();
    };
    const used = async () => {
      for (let i = 0; i < 4; ++i) (gc(), await new Promise((next) => setTimeout(next, 50)));
      return { heap: performance.memory.usedJSHeapSize, textures: renderer.info.memory.textures, geometries: renderer.info.memory.geometries };
    };
    for (let i = 0; i < 20; ++i) await cycle();
    const before = await used();
    for (let i = 0; i < 200; ++i) await cycle();
    const after = await used();
    return Object.fromEntries(Object.keys(before).map((key) => [key, after[key] - before[key]]));
  }, walker);
  assert.ok(grown.textures === 0 && grown.geometries === 0, JSON.stringify(grown));
  assert.ok(grown.heap < 2e6, JSON.stringify(grown));
});

const dance = new URL('../../build-wasm/dance.reel', import.meta.url);
test('dance, where it is: positions and normals', { skip: skip || (existsSync(dance) ? false : 'build-wasm/dance.reel is not there') }, async () => {
  const found = await page.evaluate(async (file) => {
    const { ReelLoader, readBack, decodedFrames, difference, diagonalOf, normalAngles } = stage;
    const mesh = await new ReelLoader().loadAsync(file), { head, frames } = await decodedFrames(file);
    let most = 0;
    const angles = [];
    for (let f = 0; f < frames.length; f += 20) {
      mesh.player.seek(head.times[f] - head.times[0]);
      most = Math.max(most, difference(readBack(mesh, 0), frames[f], diagonalOf(frames[0])));
      angles.push(normalAngles(mesh, frames[f], head.surface));
    }
    const sorted = angles.flat().sort((a, b) => a - b), at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
    return { most, median: at(0.5), p95: at(0.95), p99: at(0.99), gpuBytes: mesh.clip.gpuBytes };
  }, '/build-wasm/dance.reel');
  assert.ok(found.most < 1e-4 && found.median < 0.3 && found.p95 < 2, JSON.stringify(found));
});
