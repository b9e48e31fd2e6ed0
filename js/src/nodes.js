/// What makes materials take their vertices from a clip, in TSL, for WebGPURenderer: what shader.js says in GLSL.
// SPDX-License-Identifier: MIT
import {
  Fn, If, Loop, attribute, cross, dot, float, int, instancedMesh, ivec2, ivec4, normalGeometry, normalLocal, positionLocal, select, tangentGeometry,
  tangentLocal, texture, textureLoad, uniform, vec3, vec4,
} from 'three/tsl';

import { Wardrobe } from './wardrobe.js';

const types = { reelRows: 'int', reelFrame: 'ivec4', reelWeight: 'vec4', reelBlended: 'ivec2', reelTime: 'float', reelPeriod: 'float',
  reelDuration: 'float', reelFrameCount: 'int' };

/// Names of shader.js: uniforms and functions of one object.
class Shader {
  constructor(uniforms, crowd) {
    Object.assign(this, uniforms, { crowd });
    this.reelRow = attribute('reelRow', 'vec2');
    if (crowd) this.reelPhase = attribute('reelPhase', 'float');
  }

  texel(table, i) {
    return textureLoad(table, ivec2(i.bitAnd(2047), i.shiftRight(11)));
  }
  mixed(i) {
    return textureLoad(this.reelBlend, ivec2(i, 0));
  }

  /// Adds four components to sums of rows that begin at texels.
  addFour(sums, at, [x, y, z]) {
    sums.forEach((sum, layer) => {
      const c = this.texel(this.reelCoefficients, at[layer]).toVar();
      sum.addAssign(vec3(dot(c, x), dot(c, y), dot(c, z)));
    });
  }

  /// [position], or [position, tangent, tangent].
  pose(tangents) {
    const first = this.reelRows.add(int(this.reelRow.y).mul(2)), rows = [int(this.reelRow.x), first, first.add(1)].slice(0, tangents ? 3 : 1);
    const sums = rows.map(() => vec3(0).toVar());
    if (this.crowd) this.addFrames(sums, rows, this.mixAt(this.phase()));
    else {
      If(this.reelBlended.y.greaterThan(0), () => { this.addBlend(sums, rows); })
        .Else(() => { this.addFrames(sums, rows, { frame: this.reelFrame, weight: this.reelWeight }); });
    }
    return sums;
  }

  addBlend(sums, rows) {
    const { x: begin, y: fours } = this.reelBlended;
    sums[0].assign(this.mixed(int(0)).xyz);
    Loop({ start: int(0), end: fours, type: 'int', condition: '<' }, ({ i: k }) => {
      const basis = [1, 2, 3].map((c) => this.mixed(k.mul(3).add(c)).toVar());
      this.addFour(sums, rows.map((row) => begin.add(row.mul(fours)).add(k)), basis);
    });
  }

  addFrames(sums, rows, { frame, weight }) {
    for (const n of ['x', 'y', 'z', 'w'])
      If(weight[n].notEqual(0), () => {
        const head = this.texel(this.reelFrames, frame[n].mul(2)).toVar(), fours = int(head.y), basis = int(head.z);
        const begin = int(head.x).add(int(head.w).shiftLeft(20)).toVar(), part = sums.map(() => vec3(0).toVar());
        part[0].assign(this.texel(this.reelFrames, frame[n].mul(2).add(1)).xyz);
        Loop({ start: int(0), end: fours, type: 'int', condition: '<' }, ({ i: k }) => {
          const four = [0, 1, 2].map((c) => this.texel(this.reelBasis, basis.add(k.mul(3)).add(c)).toVar());
          this.addFour(part, rows.map((row) => begin.add(row.mul(fours)).add(k)), four);
        });
        sums.forEach((sum, layer) => sum.addAssign(part[layer].mul(weight[n])));
      });
  }

  // Of a crowd: frames and weights at a time, as timeline.js finds them.

  phase() {
    const t = this.reelTime.add(this.reelPhase), length = this.reelDuration;
    return select(length.greaterThan(0), t.sub(t.div(length).floor().mul(length)), float(0)).toVar();
  }
  number(f) {
    return f.mod(this.reelFrameCount).add(this.reelFrameCount).mod(this.reelFrameCount);
  }
  has(f) {
    return this.reelPeriod.greaterThan(0).or(f.greaterThanEqual(0).and(f.lessThan(this.reelFrameCount)));
  }
  timeOf(f) {
    const number = this.number(f).toVar(), turns = f.sub(number).div(this.reelFrameCount);
    return this.texel(this.reelFrames, number.mul(2).add(1)).w.add(float(turns).mul(this.reelPeriod));
  }

  mixAt(t) {
    const low = int(-1).toVar(), high = int(this.reelFrameCount).toVar();
    Loop(high.sub(low).greaterThan(1), () => {
      const middle = low.add(high).div(2).toVar();
      If(this.timeOf(middle).lessThanEqual(t), () => { low.assign(middle); }).Else(() => { high.assign(middle); });
    });
    const frame = ivec4(low, low, low, low).toVar(), weight = vec4(1, 0, 0, 0).toVar();
    If(low.lessThan(0), () => { frame.assign(ivec4(0)); })
      .ElseIf(this.has(low.add(1)), () => {
        weight.assign(this.cubic(low, t));
        frame.assign(ivec4(this.number(low.sub(1)), this.number(low), this.number(low.add(1)), this.number(low.add(2))));
      });
    return { frame, weight };
  }

  cubic(low, t) {
    const time = (step) => this.timeOf(low.add(step)), h = time(1).sub(time(0)).toVar(), u = t.sub(time(0)).div(h).toVar(), v = u.oneMinus().toVar();
    const before = select(this.has(low.sub(1)), time(0).sub(time(-1)).div(h), float(0)).toVar();
    const after = select(this.has(low.add(2)), time(2).sub(time(1)).div(h), float(0)).toVar();
    const w = vec4(0, u.mul(2).add(1).mul(v).mul(v), u.mul(u).mul(u.mul(-2).add(3)), 0).toVar();
    addSpeed(w, ['x', 'y', 'z', 'w'], u.mul(v).mul(v), before, after);
    addSpeed(w, ['w', 'z', 'y', 'x'], u.mul(u).mul(v), after, before);
    const most = w.x.abs().max(w.y.abs()).max(w.z.abs()).max(w.w.abs());
    return select(most.greaterThan(16), vec4(0, v, u, 0), w);
  }
}

function addSpeed(w, [a, b, c, d], scale, r, s) {
  If(r.greaterThan(0), () => {
    w[a].subAssign(scale.div(r.mul(r.add(1))));
    w[b].addAssign(scale.mul(r.oneMinus()).div(r));
    w[c].addAssign(scale.mul(r).div(r.add(1)));
  }).ElseIf(s.greaterThan(0), () => {
    w[b].subAssign(scale.mul(s.add(2)).div(s.add(1)));
    w[c].addAssign(scale.mul(s.add(1)).div(s));
    w[d].subAssign(scale.div(s.mul(s.add(1))));
  }).Else(() => {
    w[b].subAssign(scale);
    w[c].addAssign(scale);
  });
}

/// Instances have been placed before their vertices were known.
function placed(object) {
  if (object.isInstancedMesh) instancedMesh(object);
  return positionLocal;
}

function posedVertex(shader) {
  return Fn(({ object, geometry }) => {
    const [place, along, side] = shader.pose(true), across = cross(along, side).toVar(), area = across.length().toVar();
    positionLocal.assign(place);
    normalLocal.assign(select(area.greaterThan(1e-12), across.div(area), normalGeometry));
    if (geometry.hasAttribute('tangent')) tangentLocal.assign(tangentGeometry.xyz.sub(normalLocal.mul(dot(tangentGeometry.xyz, normalLocal))));
    return placed(object);
  })();
}

function posedShadow(shader) {
  return Fn(({ object }) => {
    positionLocal.assign(shader.pose(false)[0]);
    return placed(object);
  })();
}

/// A wardrobe whose materials both renderers understand: WebGLRenderer leaves nodes alone, WebGPURenderer onBeforeCompile.
export class NodeWardrobe extends Wardrobe {
  constructor(clip, crowd) {
    super(clip, crowd);
    for (const [name, { value }] of Object.entries(this.uniforms)) this.uniforms[name] = value?.isTexture ? texture(value) : uniform(value, types[name]);
    const shader = new Shader(this.uniforms, crowd);
    this.nodes = { positionNode: posedVertex(shader), castShadowPositionNode: posedShadow(shader) };
  }

  /// The renderer tells materials apart by their keys alone, and these nodes are of one object.
  wear(material) {
    const worn = super.wear(material);
    if (Array.isArray(material)) return worn;
    const key = worn.customProgramCacheKey;
    worn.customProgramCacheKey = () => `${key()} ${this.nodes.positionNode.id}`;
    return Object.assign(worn, this.nodes);
  }
}
