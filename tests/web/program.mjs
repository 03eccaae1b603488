// What the test of web/ takes from the C++ program: predictions, meshes, strokes.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

export class Program {
  constructor(path, scratch) {
    this.path = path;
    this.scratch = scratch;
    this.count = 0;
  }

  /** Throws with the program's own message if it fails. */
  run(...args) {
    try {
      return execFileSync(this.path, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
    } catch (error) {
      throw new Error(`daumier ${args.join(' ')}: ${error.stderr ?? error.message}`);
    }
  }

  /** `daumier predict INPUTS` into a new folder; returns {folder, manifest}. */
  predict(inputs, ...options) {
    const folder = join(this.scratch, `predicted${this.count++}`);
    this.run('predict', ...inputs, ...options, '--out', folder);
    return { folder, manifest: JSON.parse(readFileSync(join(folder, 'manifest.json'), 'utf8')) };
  }
}

/** The first vertices of an OBJ: x, y, z each. */
export function verticesOfObj(file, numNumbers) {
  const numbers = new Float32Array(numNumbers);
  let at = 0;
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    if (at === numNumbers) break;
    if (line.startsWith('v ')) for (const word of line.slice(2).split(' ')) numbers[at++] = Number(word);
  }
  if (at !== numNumbers) throw new Error(`${file} has ${at / 3} vertices (expected at least ${numNumbers / 3})`);
  return numbers;
}

/** Paths of straight lines of an SVG that Daumier wrote. */
export function strokesOfSvg(file) {
  return [...readFileSync(file, 'utf8').matchAll(/ d="M([^"]*)"/g)].map(([, path]) => path.split('L').map((point) => point.split(' ').map(Number)));
}

export function svgOf({ width, height, strokes }) {
  const paths = strokes.map((stroke) => `<path d="M${stroke.map((point) => point.join(' ')).join('L')}"/>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" fill="none" stroke="black">${paths.join('')}</svg>\n`;
}

/** Largest difference as a share of the largest value. */
export function difference(found, expected) {
  if (found.length !== expected.length) throw new Error(`${found.length} numbers, expected ${expected.length}`);
  let largest = 0, greatest = 0;
  for (let i = 0; i < expected.length; ++i) {
    greatest = Math.max(greatest, Math.abs(expected[i]));
    if (!(Math.abs(found[i] - expected[i]) <= largest)) largest = Math.abs(found[i] - expected[i]);  // NaN stays.
  }
  return greatest > 0 ? largest / greatest : largest;
}
