#!/usr/bin/env bash
# three.js 0.187.0 (npm), SVGLoader: `points` of <polyline> and <polygon>, written compactly.
#
# Expected: "0 0 5-5 10 0 15 5" is the polyline (0,0) (5,-5) (10,0) (15,5). In SVG 1.1 (9.7.1, coordinate-pair) a negative number
#   needs no separator before it. The loader reads the same numbers rightly in the data of a <path>.
# Behaviour: pairs are sought as two numbers with a comma or blank between them, wherever they begin. "5-5" is none, so the
#   next pair is "-5 10", and from there x and y are exchanged. Without any pair the polyline is empty. No message.
# Output seen:
#   points "0 0 5 -5 10 0 15 5" -> 0,0 5,-5 10,0 15,5
#   points "0 0 5-5 10 0 15 5"  -> 0,0 -5,10 0,15
#   points "1-1 2-2"            -> nothing
#   path "M0 0L5-5 10 0 15 5"   -> 0,0 5,-5 10,0 15,5
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent three@0.187.0 @xmldom/xmldom@0.9.12 >/dev/null 2>&1 ||
  { echo "npm cannot install three@0.187.0, @xmldom/xmldom@0.9.12"; exit 2; }

cat >main.mjs <<'JS'
import { DOMParser } from '@xmldom/xmldom';
import { SVGLoader } from 'three/examples/jsm/loaders/SVGLoader.js';

// The loader runs in browsers: XML comes from a package here, and the search for gradients finds none.
globalThis.DOMParser = class {
  parseFromString(text, type) {
    return Object.assign(new DOMParser().parseFromString(text, type), { querySelectorAll: () => [] });
  }
};

function Read(element) {
  const { paths } = new SVGLoader().parse(`<svg xmlns="http://www.w3.org/2000/svg">${element}</svg>`);
  const points = paths.flatMap((path) => path.subPaths).flatMap((part) => part.getPoints(1));
  return points.map((point) => `${point.x},${point.y}`).join(' ') || 'nothing';
}

const right = '0,0 5,-5 10,0 15,5';
const cases = [
  ['points', '0 0 5 -5 10 0 15 5', right],
  ['points', '0 0 5-5 10 0 15 5', '0,0 -5,10 0,15'],
  ['points', '1-1 2-2', 'nothing'],
  ['path', 'M0 0L5-5 10 0 15 5', right],
];
let as_described = true;
for (const [kind, text, described] of cases) {
  const read = Read(kind === 'path' ? `<path d="${text}"/>` : `<polyline points="${text}"/>`);
  console.log(`${`${kind} "${text}"`.padEnd(27)} -> ${read}`);
  as_described &&= read === described;
}
console.log(as_described ? 'as described' : 'CHANGED');
process.exit(as_described ? 0 : 1);
JS
node main.mjs
