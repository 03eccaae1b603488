#!/usr/bin/env bash
# three.js 0.187.0 (npm), PLYLoader and WebGLRenderer: a mesh whose positions are `property double`, as scanning tools write it.
#
# Expected: what a loader of three.js returns, a renderer of three.js draws. float and double hold the same mesh here, every
#   coordinate exact in both.
# Behaviour: the loader gives the attribute the type of the file, a Float64Array. WebGL has no such attributes (for that reason
#   three.js dropped its class Float64BufferAttribute), so the renderer throws when it uploads the geometry: after loading, in the
#   first frame, without naming file or attribute. Bounds and other computations on the geometry work.
# Output seen:
#   float  -> Float32Array, radius 0.7071, upload: ok
#   double -> Float64Array, radius 0.7071, upload: THREE.WebGLAttributes: Unsupported buffer data format: 0,0,0,1,0,0,0,1,0
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent three@0.187.0 >/dev/null 2>&1 ||
  { echo "npm cannot install three@0.187.0"; exit 2; }

cat >main.mjs <<'JS'
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { WebGLAttributes } from 'three/src/renderers/webgl/WebGLAttributes.js';

const Ply = (type) => `ply
format ascii 1.0
element vertex 3
property ${type} x
property ${type} y
property ${type} z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
`;

/// What WebGLRenderer does with an attribute before it draws; no function of WebGL is reached but these.
function Upload(attribute) {
  const gl = { createBuffer: () => ({}), bindBuffer() {}, bufferData() {}, FLOAT: 0x1406, ARRAY_BUFFER: 0x8892 };
  try {
    WebGLAttributes(gl).update(attribute, gl.ARRAY_BUFFER);
    return 'ok';
  } catch (error) {
    return error.message;
  }
}

const results = ['float', 'double'].map((type) => {
  const { attributes: { position }, boundingSphere } = new PLYLoader().parse(Ply(type));
  const result = { array: position.array.constructor.name, upload: Upload(position) };
  const radius = boundingSphere.radius.toFixed(4);
  console.log(`${type.padEnd(6)} -> ${result.array}, radius ${radius}, upload: ${result.upload}`);
  return result;
});
const as_described = results[0].upload === 'ok' && results[1].array === 'Float64Array' && /Unsupported/.test(results[1].upload);
console.log(as_described ? 'as described' : 'CHANGED');
process.exit(as_described ? 0 : 1);
JS
node main.mjs
