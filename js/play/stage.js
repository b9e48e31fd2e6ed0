/// The stage: one scene, seen in one pane or several by one camera; picking; paths of vertices; small pictures for the timeline.
// SPDX-License-Identifier: MIT
import {
  Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group, HemisphereLight, Line, LineBasicMaterial, Mesh,
  MeshNormalMaterial, MeshStandardMaterial, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Points, PointsMaterial, Raycaster, Scene, ShadowMaterial,
  Sphere, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { ReelMesh } from '../src/reel.js';

const turns = { y: [0, 0, 0], unknown: [0, 0, 0], z: [-Math.PI / 2, 0, 0], x: [0, 0, Math.PI / 2] };
const home = new Vector3(0.55, 0.28, 1).normalize();
const clay = [0xcdb99c, 0x8fa9c4, 0xb58b8b, 0x9cb58b, 0xb8a0c8, 0xc8b46a];

function light(scene) {
  const key = new DirectionalLight(0xffffff, 2.4);
  key.castShadow = true;
  key.shadow.mapSize.set(1024, 1024);
  key.shadow.bias = -0.0006;
  key.shadow.normalBias = 0.02;
  const fill = new DirectionalLight(0xdfe8ff, 0.5);
  fill.position.set(-1, 0.4, -0.6);
  scene.add(new HemisphereLight(0xffffff, 0x8a8f98, 1.5), key, key.target, fill);
  return key;
}

function sphereOf(box) {
  const sphere = box.getBoundingSphere(new Sphere());
  if (!(sphere.radius > 0)) sphere.radius = 1;
  return sphere;
}

/// As near as a box is seen whole.
function place(camera, { width, height }, box) {
  const { center, radius } = sphereOf(box), steep = 0.92 * Math.tan((camera.fov * Math.PI) / 360), corner = new Vector3();
  Object.assign(camera, { aspect: width / height, near: radius / 100, far: 40 * radius });
  camera.position.copy(home);
  camera.lookAt(0, 0, 0);
  const half = box.getSize(new Vector3()).multiplyScalar(0.5), turned = camera.quaternion.clone().invert();
  let distance = 0.1 * radius;
  for (let i = 0; i < 8; ++i) {
    corner.set(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).multiply(half).applyQuaternion(turned);
    distance = Math.max(distance, corner.z + Math.max(Math.abs(corner.x) / camera.aspect, Math.abs(corner.y)) / steep);
  }
  camera.position.copy(center).addScaledVector(home, distance);
  camera.updateProjectionMatrix();
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.info.autoReset = false;
    this.scene = new Scene();
    this.key = light(this.scene);
    this.root = new Group(); // turned so that up is y
    this.scene.add(this.root);
    this.floor = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), new ShadowMaterial({ opacity: 0.16 }));
    this.floor.receiveShadow = true;
    this.scene.add(this.floor);
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.addEventListener('change', () => (this.dirty = true));
    this.meshes = new Map(); // by pane
    this.panes = ['decoded'];
    this.marks = new Map();
    Object.assign(this, { box: new Box3(), center: new Vector3(), radius: 1 }); // of all poses
    this.dirty = true;
  }

  /// Materials of a pane.
  #material(clip, look) {
    if (look === 'normals') return new MeshNormalMaterial({ side: DoubleSide });
    const common = { side: DoubleSide, roughness: 0.8, wireframe: look === 'wire', vertexColors: 'color' in clip.geometry.attributes };
    const of = (_, i) => new MeshStandardMaterial({ ...common, color: common.vertexColors ? 0xffffff : clay[i % clay.length] });
    return clip.geometry.groups.length > 0 ? clip.head.materials.map(of) : of(0, 0);
  }

  /// Shows a clip in a pane, instead of what it showed. material: what it wears; default: by its look.
  put(pane, clip, material) {
    this.take(pane);
    const mesh = new ReelMesh(clip, material ?? this.#material(clip, this.look));
    mesh.castShadow = mesh.receiveShadow = true;
    this.meshes.set(pane, mesh);
    this.root.add(mesh);
    mesh.player.seek(this.time ?? 0);
    this.dirty = true;
  }
  take(pane) {
    const mesh = this.meshes.get(pane);
    this.meshes.delete(pane);
    mesh?.removeFromParent();
    mesh?.dispose();
    this.dirty = true;
  }
  wear(look) {
    this.look = look;
    for (const [pane, mesh] of this.meshes) if (pane !== 'error') mesh.wear(this.#material(mesh.clip, look));
    this.dirty = true;
  }
  seek(time) {
    this.time = time;
    for (const mesh of this.meshes.values()) mesh.player.seek(time);
    for (const { clip, path, dot } of this.marks.values()) {
      const at = along(clip, path, time);
      dot.geometry.attributes.position.array.set(at);
      dot.geometry.attributes.position.needsUpdate = true;
    }
    this.dirty = true;
  }

  turn(up) {
    this.root.rotation.set(...turns[up]);
    this.root.updateMatrixWorld();
  }

  /// Of the poses at some times, as the camera sees them.
  #boxOf(clip, times) {
    const box = new Box3(), point = new Vector3();
    for (const time of times) {
      const rows = clip.rowsAt(time);
      for (let r = 0; r < rows.length; r += 3) box.expandByPoint(point.fromArray(rows, r).applyMatrix4(this.root.matrixWorld));
    }
    return box;
  }

  /// Looks at all of a clip from the front, from a little above.
  frame(clip) {
    const box = this.#boxOf(clip, Array.from({ length: 9 }, (_, i) => (clip.timeline.duration * i) / 8)), { center, radius } = sphereOf(box);
    Object.assign(this, { box, center, radius });
    this.floor.position.set(center.x, box.min.y - 0.002 * radius, center.z);
    this.floor.scale.setScalar(12 * radius);
    this.key.position.copy(center).addScaledVector(new Vector3(0.45, 1.3, 0.75).normalize(), 4 * radius);
    this.key.target.position.copy(center);
    Object.assign(this.key.shadow.camera, { left: -1.6 * radius, right: 1.6 * radius, top: 1.6 * radius, bottom: -1.6 * radius, near: radius, far: 8 * radius });
    this.key.shadow.camera.updateProjectionMatrix();
    this.home();
  }
  home() {
    place(this.camera, this.places()[0], this.box);
    this.controls.target.copy(this.center);
    Object.assign(this.controls, { minDistance: 0.05 * this.radius, maxDistance: 20 * this.radius });
    this.controls.update();
    this.dirty = true;
  }
  /// Where the panes are, CSS pixels from the canvas' upper left corner.
  places() {
    const { clientWidth: W, clientHeight: H } = this.canvas, n = this.panes.length, aside = W >= H;
    return this.panes.map((pane, i) => aside ? { pane, x: (i * W) / n, y: 0, width: W / n, height: H }
      : { pane, x: 0, y: (i * H) / n, width: W, height: H / n });
  }

  #only(pane) {
    for (const [name, mesh] of this.meshes) mesh.visible = name === pane;
    for (const [name, { line, dot }] of this.marks) line.visible = dot.visible = name === pane || pane === 'error';
  }

  render() {
    const { renderer, camera, canvas } = this, ratio = Math.min(devicePixelRatio || 1, 2);
    renderer.setPixelRatio(ratio);
    const size = renderer.getSize(new Vector2());
    if (size.x !== canvas.clientWidth || size.y !== canvas.clientHeight) renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    renderer.info.reset();
    renderer.setScissorTest(true);
    for (const { pane, x, y, width, height } of this.places()) {
      this.#only(pane);
      renderer.setViewport(x, canvas.clientHeight - y - height, width, height);
      renderer.setScissor(x, canvas.clientHeight - y - height, width, height);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      renderer.render(this.scene, camera);
    }
    this.dirty = false;
  }

  /// A small picture of a pane at a time, drawn into a 2D context. The next render() mends what it does to the canvas.
  thumbnail(pane, time, context, { x, y, width, height }) {
    const { renderer, canvas } = this, ratio = renderer.getPixelRatio(), camera = new PerspectiveCamera(28, width / height);
    const was = this.time, w = Math.min(width, canvas.clientWidth), h = Math.min(height, canvas.clientHeight);
    place(camera, { width: w, height: h }, this.#boxOf(this.meshes.get(pane).clip, [time]));
    this.seek(time);
    this.#only(pane);
    for (const { line, dot } of this.marks.values()) line.visible = dot.visible = false;
    this.floor.visible = false;
    renderer.setViewport(0, 0, w, h);
    renderer.setScissor(0, 0, w, h);
    renderer.render(this.scene, camera);
    context.drawImage(canvas, 0, canvas.height - h * ratio, w * ratio, h * ratio, x, y, width, height);
    this.floor.visible = true;
    this.seek(was);
  }

  /// The vertex under a point: { pane, row, clip, point }, or null.
  pick(x, y) {
    const rect = this.places().find((r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height);
    const mesh = rect && this.meshes.get(rect.pane);
    if (!mesh) return null;
    const ray = new Raycaster();
    this.camera.aspect = rect.width / rect.height;
    this.camera.updateProjectionMatrix();
    ray.setFromCamera(new Vector2(((x - rect.x) / rect.width) * 2 - 1, 1 - ((y - rect.y) / rect.height) * 2), this.camera);
    const hit = ray.intersectObject(mesh)[0];
    if (!hit) return null;
    const rows = mesh.clip.rowsAt(this.time), local = mesh.worldToLocal(hit.point.clone()), { reelRow } = mesh.geometry.attributes;
    const near = [hit.face.a, hit.face.b, hit.face.c].map((i) => reelRow.getX(i))
      .map((row) => ({ row, far: new Vector3().fromArray(rows, 3 * row).distanceTo(local) })).sort((p, q) => p.far - q.far)[0];
    return { pane: rect.pane, row: near.row, clip: mesh.clip };
  }

  /// Draws the path of a row through all frames.
  mark(pane, clip, row, colour) {
    this.unmark(pane);
    const path = clip.pathOf(row), made = (positions) => new BufferGeometry().setAttribute('position', new BufferAttribute(positions, 3));
    const line = new Line(made(path), new LineBasicMaterial({ color: new Color(colour), depthTest: false, transparent: true }));
    const dot = new Points(made(new Float32Array(3)), new PointsMaterial({ color: new Color(colour), size: 9, sizeAttenuation: false, depthTest: false, transparent: true }));
    line.renderOrder = dot.renderOrder = 1;
    line.frustumCulled = dot.frustumCulled = false;
    this.root.add(line, dot);
    this.marks.set(pane, { clip, path, line, dot, row });
    this.seek(this.time ?? 0);
  }
  unmark(pane) {
    const { line, dot } = this.marks.get(pane) ?? {};
    for (const each of [line, dot]) (each?.removeFromParent(), each?.geometry.dispose(), each?.material.dispose());
    this.marks.delete(pane);
    this.dirty = true;
  }
}

/// A point of a path at a time: motion between frames is a mix of frames.
export function along(clip, path, time) {
  const frames = new Int32Array(4), weights = new Float64Array(4), at = [0, 0, 0];
  clip.timeline.mix(clip.timeline.start + time, frames, weights);
  for (let n = 0; n < 4; ++n) for (let c = 0; c < 3; ++c) at[c] += weights[n] * path[3 * frames[n] + c];
  return at;
}
