// node tests/web/measure_pictures.mjs PROGRAM BUILD: how far faces of pictures of drawings are from those of their strokes, here and by the
// C++ runtime, which traces with more care (docs/web.md).
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { drawnFace } from './drawings.mjs';
import { openPage, unpacked } from './page.mjs';
import { pngOf } from './png.mjs';
import { Program, strokesOfSvg, verticesOfObj } from './program.mjs';

const [program, build] = process.argv.slice(2), web = join(repository, 'web'), scratch = mkdtempSync(join(tmpdir(), 'daumier-pictures-')), cpp = new Program(resolve(program), scratch);

function distances(a, b) {
  const found = Array.from({ length: a.length / 3 }, (_, v) => 10 * Math.hypot(...[0, 1, 2].map((axis) => a[3 * v + axis] - b[3 * v + axis])));
  return `mean ${(found.reduce((sum, each) => sum + each, 0) / found.length).toFixed(2)} mm, greatest ${Math.max(...found).toFixed(2)} mm`;
}

function example(name) {
  const { folder } = cpp.predict([join(repository, `docs/examples/drawings/${name}.svg`)], '--weights', 'sketch-ict', '--keep-frame', '--no-refine');
  return [name, { width: 256, height: 256, strokes: strokesOfSvg(join(folder, `${name}.svg`)) }];
}

const { page, close } = await openPage({ '/ort/': join(web, 'node_modules/onnxruntime-web/dist'), '/daumier/': resolve(build), '/weights/': join(repository, 'weights') });
try {
  await page.evaluate(async () => {
    window.model = await daumier.openSketchModel(ort, '/weights/sketch-ict');
  });
  for (const [name, drawing] of [example('man'), example('girl'), ['generated1', drawnFace(1)], ['generated2', drawnFace(2)]]) {
    const found = await page.evaluate(async ({ width, height, strokes }) => {
      const canvas = new OffscreenCanvas(2 * width, 2 * height), context = canvas.getContext('2d');
      Object.assign(context, { lineWidth: 2.5, lineCap: 'round', lineJoin: 'round', fillStyle: 'white' });
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.scale(2, 2);
      for (const stroke of strokes) {
        context.beginPath();
        stroke.forEach(([x, y]) => context.lineTo(x, y));
        context.stroke();
      }
      const pixels = context.getImageData(0, 0, canvas.width, canvas.height), begin = performance.now();
      daumier.drawingOfPicture(pixels);
      const milliseconds = performance.now() - begin, ofPicture = await model.predict(pixels), ofStrokes = await model.predict({ width, height, strokes });
      return { width: canvas.width, height: canvas.height, data: packed(pixels.data), milliseconds, ofPicture: packed(ofPicture.vertices), ofStrokes: packed(ofStrokes.vertices) };
    }, drawing);
    const file = join(scratch, `${name}.png`), ofPicture = unpacked(found.ofPicture), ofStrokes = unpacked(found.ofStrokes);
    writeFileSync(file, pngOf({ ...found, data: Buffer.from(found.data, 'base64') }));
    const { folder } = cpp.predict([file], '--weights', 'sketch-ict', '--no-fit'), traced = verticesOfObj(join(folder, `${name}.obj`), ofStrokes.length);
    console.log(`${name}, ${found.width} x ${found.height}, from its strokes' face: here ${distances(ofPicture, ofStrokes)}; C++ ${distances(traced, ofStrokes)}; one from the other ${distances(ofPicture, traced)}; ${found.milliseconds.toFixed(0)} ms`);
  }
} finally {
  await close();
  rmSync(scratch, { recursive: true, force: true });
}
