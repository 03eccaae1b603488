#!/usr/bin/env bash
# three.js 0.187.0 and @loaders.gl/obj 4.4.5 (npm), OBJ readers: a group with faces and a polyline (`l`), as a face with a contour
# or a landmark curve drawn on it.
#
# Expected: two triangles and a polyline of three points. OBJ allows elements of every kind in one group, and both libraries read
#   faces alone and three.js polylines alone. A reader that has no use for lines would leave them out.
# Behaviour: the points of all elements become one list, of one kind. three.js makes it LineSegments: no surface is left, and the
#   corners of the triangles are joined in pairs (1-2, 3-1, 3-4). loaders.gl makes it triangles: the polyline is a third triangle,
#   which no face of the file describes, even where it has a group of its own. Neither warns.
# Output seen:
#   three.js    faces: Mesh 6
#   three.js    faces and polyline: LineSegments 10
#   three.js    polyline in a group of its own: Mesh 6, LineSegments 4
#   loaders.gl  faces: triangles 6, the last 0,0,0 1,1,1 0,1,0
#   loaders.gl  faces and polyline: triangles 9, the last 0,0,0 1,0,0 1,1,1
#   loaders.gl  polyline in a group of its own: triangles 9, the last 0,0,0 1,0,0 1,1,1
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent three@0.187.0 @loaders.gl/core@4.4.5 @loaders.gl/obj@4.4.5 \
  >/dev/null 2>&1 || { echo "npm cannot install three@0.187.0, @loaders.gl/core@4.4.5, @loaders.gl/obj@4.4.5"; exit 2; }

cat >main.mjs <<'JS'
import { parse } from '@loaders.gl/core';
import { OBJLoader as LoadersGl } from '@loaders.gl/obj';
import { OBJLoader as Three } from 'three/examples/jsm/loaders/OBJLoader.js';

const vertices = 'v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\n', faces = 'f 1 2 3\nf 1 3 4\n', polyline = 'l 1 2 3\n';
const files = {
  'faces': `${vertices}g face\n${faces}`,
  'faces and polyline': `${vertices}g face\n${faces}${polyline}`,
  'polyline in a group of its own': `${vertices}g face\n${faces}g contour\n${polyline}`,
};

const three = {}, loaders = {};
for (const [name, text] of Object.entries(files)) {
  const parts = new Three().parse(text).children;
  three[name] = parts.map((part) => `${part.type} ${part.geometry.attributes.position.count}`).join(', ');
  const mesh = await parse(new TextEncoder().encode(text).buffer, LoadersGl, { worker: false, core: { worker: false } });
  const points = Array.from(mesh.attributes.POSITION.value);
  const last = [points.slice(-9, -6), points.slice(-6, -3), points.slice(-3)].map((point) => point.join()).join(' ');
  loaders[name] = `${mesh.mode === 4 ? 'triangles' : `mode ${mesh.mode}`} ${points.length / 3}, the last ${last}`;
}
for (const name in files) console.log(`three.js    ${name}: ${three[name]}`);
for (const name in files) console.log(`loaders.gl  ${name}: ${loaders[name]}`);
const as_described = three['faces'] === 'Mesh 6' && three['faces and polyline'] === 'LineSegments 10' &&
  three['polyline in a group of its own'] === 'Mesh 6, LineSegments 4' &&
  loaders['faces'].startsWith('triangles 6,') && loaders['faces and polyline'] === 'triangles 9, the last 0,0,0 1,0,0 1,1,1';
console.log(as_described ? 'as described' : 'CHANGED');
process.exit(as_described ? 0 : 1);
JS
node main.mjs
