#!/usr/bin/env bash
# three.js 0.187.0 (npm), PLYLoader: colours of vertices, `property uchar red, green, blue`.
#
# Expected: 256 greys in the file are 256 greys in the geometry. The loader converts sRGB to linear light, as three.js works in,
#   and so needs more than 8 bits a channel: 8 bits suffice for sRGB because its steps are fine where the eye sees them.
# Behaviour: the linear values are rounded to 8 bits again (a normalised Uint8 attribute). 73 of 256 levels are lost, all of them
#   in the darker half: 0 to 6 become 0, and 7 to 17 become 1, which is drawn as 13. Hair, pupils and nostrils of a scan show bands.
#   The same colours as floats are kept.
# Output seen:
#   attribute Uint8Array, normalised true
#   levels: 256 in the file, 183 in the geometry; below 128: 128 and 55
#   in the file 6, drawn as 0; 7 as 13; 17 as 13; 18 as 22; 25 as 22
#   the same levels as float: 256
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent three@0.187.0 >/dev/null 2>&1 ||
  { echo "npm cannot install three@0.187.0"; exit 2; }

cat >main.mjs <<'JS'
import { Color, SRGBColorSpace } from 'three';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';

/// A vertex for each of 256 greys, as PLY with colours of the given type.
function Load(type, text) {
  const header = ['ply', 'format ascii 1.0', 'element vertex 256'];
  for (const axis of ['x', 'y', 'z']) header.push(`property float ${axis}`);
  for (const channel of ['red', 'green', 'blue']) header.push(`property ${type} ${channel}`);
  const rows = Array.from({ length: 256 }, (_, grey) => `${grey} 0 0 ${Array(3).fill(text(grey)).join(' ')}`);
  return new PLYLoader().parse([...header, 'end_header', ...rows, ''].join('\n')).attributes.color;
}

const bytes = Load('uchar', (grey) => grey), floats = Load('float', (grey) => grey / 255);
const drawn = (grey) => {  // What an sRGB screen shows of the linear value.
  const color = new Color().setRGB(bytes.getX(grey), bytes.getX(grey), bytes.getX(grey));
  return Math.round(255 * color.getRGB({}, SRGBColorSpace).r);
};
const levels = (attribute, end) => new Set(Array.from({ length: end }, (_, grey) => attribute.getX(grey))).size;

console.log(`attribute ${bytes.array.constructor.name}, normalised ${bytes.normalized}`);
console.log(`levels: 256 in the file, ${levels(bytes, 256)} in the geometry; below 128: 128 and ${levels(bytes, 128)}`);
console.log(`in the file 6, drawn as ${drawn(6)}; 7 as ${drawn(7)}; 17 as ${drawn(17)}; 18 as ${drawn(18)}; 25 as ${drawn(25)}`);
console.log(`the same levels as float: ${levels(floats, 256)}`);
const as_described = levels(bytes, 256) === 183 && levels(floats, 256) === 256 && drawn(6) === 0 && drawn(7) === drawn(17);
console.log(as_described ? 'as described' : 'CHANGED');
process.exit(as_described ? 0 : 1);
JS
node main.mjs
