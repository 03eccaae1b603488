// What the checks of rigged heads share: the file, and what it holds as it is written (glTF 2.0 read by hand, without
// compression), against which what a program loads is compared.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../../..');
const packages = new URL('../../npm-consumers/node_modules/', import.meta.url);

/// A module of an npm package by its file, and the version of a package.
export const load = (file) => import(new URL(file, packages));
export const versionOf = (name) => JSON.parse(readFileSync(new URL(`${name}/package.json`, packages))).version;

/// The file of a head: of the folder $DAUMIER_HEADS where it is set, else of build/consumers, where `daumier rig` makes it
/// once. `name`: head.glb, head_compressed.glb or head.vrm.
export function headFile(name) {
  const folder = process.env.DAUMIER_HEADS ?? join(root, 'build/consumers');
  const file = join(folder, name);
  if (existsSync(file)) return file;
  mkdirSync(folder, { recursive: true });
  execFileSync(join(dirname(fileURLToPath(import.meta.url)), 'make_heads'), [folder], { stdio: ['ignore', 2, 2] });
  if (!existsSync(file)) throw new Error(`${file} was not made`);
  return file;
}

/// An ArrayBuffer of a file's own.
export function bytesOf(file) {
  const bytes = readFileSync(file);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}

/// Of a .glb that is not compressed: names, displacements and keys.
export class Head {
  constructor(file) {
    this.bytes = bytesOf(file);
    const view = new DataView(this.bytes);
    const jsonLength = view.getUint32(12, true);
    this.json = JSON.parse(new TextDecoder().decode(new Uint8Array(this.bytes, 20, jsonLength)));
    this.binaryStart = 20 + jsonLength + 8;
    this.mesh = this.json.meshes.find((mesh) => mesh.name === 'Face');
    this.primitive = this.mesh.primitives[0];
    this.names = this.mesh.extras.targetNames;
    this.jaw = this.names.indexOf('jawOpen');
  }

  floats(accessor) {
    const { bufferView, count, type } = this.json.accessors[accessor];
    const size = type === 'SCALAR' ? 1 : Number(type.at(-1));
    return new Float32Array(this.bytes.slice(this.binaryStart + this.json.bufferViews[bufferView].byteOffset), 0, count * size);
  }

  positions() { return this.floats(this.primitive.attributes.POSITION); }
  target(index) { return this.floats(this.primitive.targets[index].POSITION); }
  node(name) { return this.json.nodes.findIndex((node) => node.name === name); }

  /// {times, values, size} of a channel of the animation.
  track(nodeName, path) {
    const { channels, samplers } = this.json.animations[0];
    const channel = channels.find(({ target }) => target.node === this.node(nodeName) && target.path === path);
    const sampler = samplers[channel.sampler];
    const times = this.floats(sampler.input);
    const values = this.floats(sampler.output);
    return { times, values, size: values.length / times.length };
  }

  get duration() { return this.track('Head', 'weights').times.at(-1); }

  /// The element of a track at a time, linear between keys; turns have unit length.
  sample(nodeName, path, time) {
    const { times, values, size } = this.track(nodeName, path);
    let k = times.findIndex((t) => t > time);
    if (k < 0) k = times.length - 1;
    const share = Math.min(1, (time - times[k - 1]) / (times[k] - times[k - 1]));
    const element = Array.from({ length: size }, (_, i) => values[(k - 1) * size + i] * (1 - share) + values[k * size + i] * share);
    const length = path === 'rotation' ? Math.hypot(...element) : 1;
    return element.map((value) => value / length);
  }
}

/// Times at which the demo clip moves different things, most of them between keys.
export const sampleTimes = [0, 0.042, 0.263, 0.805, 1.553, 2.463, 2.833, 3.258, 3.663, 4.237, 4.955];

let failures = 0;
/// A line for each thing that was checked.
export function check(condition, what) {
  console.log(`  ${condition ? 'ok  ' : 'FAIL'} ${what}`);
  if (!condition) failures += 1;
}
export function largestDifference(a, b) {
  if (a.length !== b.length) return Infinity;
  let largest = 0;
  for (let i = 0; i < a.length; ++i) largest = Math.max(largest, Math.abs(a[i] - b[i]));
  return Number.isNaN(largest) ? Infinity : largest;
}
/// q and -q are one turn.
export function turnDifference(a, b) {
  return Math.min(largestDifference(a, b), largestDifference(a, b.map((value) => -value)));
}
export function finish() { process.exit(failures ? 1 : 0); }

/// What a program found at sampleTimes: a function that sets the time, and readers of weights and of turns [x, y, z, w].
export function checkAnimation(head, setTime, weightsNow, turnNow) {
  const worst = { weights: 0, Head: 0, LeftEye: 0, RightEye: 0 };
  for (const time of sampleTimes.filter((t) => t <= head.duration)) {
    setTime(time);
    worst.weights = Math.max(worst.weights, largestDifference(weightsNow(), head.sample('Head', 'weights', time)));
    for (const node of ['Head', 'LeftEye', 'RightEye']) {
      worst[node] = Math.max(worst[node], turnDifference(turnNow(node), head.sample(node, 'rotation', time)));
    }
  }
  for (const [what, difference] of Object.entries(worst)) {
    check(difference < 2e-4, `animation of ${what}: at most ${difference.toExponential(1)} off at ${sampleTimes.length} times`);
  }
}
