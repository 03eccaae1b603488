// What both kinds of pictures need: random numbers that are the same everywhere, SVG to pixels, files of landmarks.
import { Resvg } from '@resvg/resvg-js';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

/// Numbers in 0..1 (mulberry32).
export function seededRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/// {width, height, pixels (RGBA), asPng()} of an SVG whose root has a size.
export function render(svg, background) {
  return new Resvg(svg, background ? { background } : {}).render();
}

/// NAME.png and NAME.txt: 68 rows "x y", "nan nan" where a landmark is not known. landmarks: {number: [x, y]}.
export function writePortrait(folder, name, png, landmarks) {
  const rows = [];
  for (let i = 0; i < 68; ++i) rows.push(landmarks[i] ? landmarks[i].map((value) => value.toFixed(2)).join(' ') : 'nan nan');
  writeFileSync(join(folder, `${name}.png`), png);
  writeFileSync(join(folder, `${name}.txt`), `${rows.join('\n')}\n`);
}
