// three.js in Node: what its loader takes from a browser is replaced.
import { load } from './head.mjs';

globalThis.self = globalThis;
globalThis.createImageBitmap = async () => ({ width: 1, height: 1, close() {} });

export const three = await load('three/build/three.module.js');
const { GLTFLoader } = await load('three/examples/jsm/loaders/GLTFLoader.js');
const { MeshoptDecoder } = await load('meshoptimizer/index.js');

export async function loadWithThree(bytes, ...plugins) {
  const loader = new GLTFLoader();
  await MeshoptDecoder.ready;
  loader.setMeshoptDecoder(MeshoptDecoder);
  for (const plugin of plugins) loader.register(plugin);
  return loader.parseAsync(bytes, '');
}

/// The largest distance in metres from vertices of `mesh` to the nearest one of `expected`, both with one target at weight
/// 1, in the frame of the parent of each: of every 37th vertex, as two files may order vertices differently.
export function nearestDifference(expected, mesh, target) {
  const displaced = (of) => {
    const { position } = of.geometry.attributes;
    const offset = of.geometry.morphAttributes.position[target];
    // The node that a compressed mesh hangs in has the scale of its integers; the node Head itself is left out.
    const frame = new three.Matrix4();
    for (let node = of; node.name !== 'Head'; node = node.parent) frame.premultiply(node.matrix);
    return Array.from({ length: position.count }, (_, n) => new three.Vector3().fromBufferAttribute(position, n)
      .add(new three.Vector3().fromBufferAttribute(offset, n)).applyMatrix4(frame));
  };
  const points = displaced(expected);
  let worst = 0;
  displaced(mesh).forEach((point, n) => {
    if (n % 37 === 0) worst = Math.max(worst, Math.min(...points.map((other) => other.distanceToSquared(point))));
  });
  return Math.sqrt(worst);
}
