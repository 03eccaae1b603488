// The package in Chromium next to the C++ runtime, on the same strokes and pixels. Called by run.mjs.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { drawnFace, scribbledFace, titledFace, twoFaces } from './drawings.mjs';
import { writeInkWeights } from './ink_model.mjs';
import { openPage, unpacked } from './page.mjs';
import { pngOf } from './png.mjs';
import { difference, strokesOfSvg, svgOf, verticesOfObj } from './program.mjs';
import { meanFaceOf, trainSmallModels } from './small_models.mjs';

/** Largest difference of any output, as a share of its largest value. */
const kTolerance = 1e-4;
/** Of faces framed by the parser: a last digit of the frame moves greys of the picture by 1/255. */
const kFramedTolerance = 5e-4;
const kReports = join(process.env.DAUMIER_SHARED_DATA ?? join(repository, '../shared/data'), 'reports');
/** Of reports: a photograph, two faces, shading. */
const reported = ['20-sheet-on-desk/wide_border.jpg', '27-two-faces/two.png', '28-soft-shading/shaded.png'];

const weights = join(repository, 'weights'), webFolder = join(repository, 'web');

/** Strokes of a file as the C++ runtime reads them, on its canvas. */
function strokesOfFile(program, file) {
  const { folder, manifest } = program.predict([file], '--weights', 'sketch-ict', '--keep-frame', '--no-refine');
  const [name] = Object.keys(manifest.details.drawings);
  return { width: 256, height: 256, strokes: strokesOfSvg(join(folder, `${name}.svg`)) };
}

function testDrawings(program) {
  const examples = join(repository, 'docs/examples/drawings');
  const files = ['man.svg', 'girl.svg'].map((name) => join(examples, name));
  if (existsSync(kReports)) files.push(...reported.map((name) => join(kReports, name)));
  else console.log(`drawings of reports are left out: ${kReports} is not there`);
  const generated = [['generated', drawnFace(1)], ['generated, titled', titledFace(2)], ['two generated', twoFaces(1)], ['generated, scribbled', scribbledFace(1)]];
  return [...generated, ...files.map((file) => [basename(file), strokesOfFile(program, file)])];
}

export async function compareWithProgram(program, packageFolder) {
  const failures = [];
  const report = (name, share, bound = kTolerance, unit = ' of the largest value') => {
    console.log(`${name}: ${typeof share === 'number' && !Number.isInteger(share) ? share.toExponential(1) : share}${unit}, at most ${bound}`);
    if (!(share <= bound)) failures.push(`${name}: ${share}${unit} (expected at most ${bound})`);
  };
  const small = trainSmallModels(program, weights), mean = meanFaceOf(weights);
  const ink = writeInkWeights(weights, join(program.scratch, 'ink'), mean);
  const drawings = testDrawings(program);
  const { page, faults, close } = await openPage({ '/ort/': join(webFolder, 'node_modules/onnxruntime-web/dist'), '/daumier/': packageFolder, '/weights/': weights,
    '/runs/': program.scratch, '/portraits/': join(repository, 'docs/examples/portraits') });
  try {
    await compareDrawings({ program, page, report, drawings, ink, numNumbers: mean.length });
    await compareRun({ program, page, report, run: small.sketch, drawing: drawings[0][1], numNumbers: mean.length });
    await compareSurfaces({ program, page, report, run: small.deform, numNumbers: mean.length });
    await comparePortraits({ program, page, report, run: small.portrait, numNumbers: mean.length });
    await readPicture({ page, report, drawing: drawings.find(([name]) => name.includes('man.svg'))[1] });
    if (faults.length > 0) failures.push(`the page reports: ${faults.join('; ')}`);
    await checkErrors({ page, failures });  // Last: the browser, too, reports what the server lacks.
  } finally {
    await close();
  }
  return failures;
}

async function compareDrawings({ program, page, report, drawings, ink, numNumbers }) {
  await page.evaluate(async () => {
    window.canvasModel = await daumier.openSketchModel(ort, '/weights/sketch-ict', { framing: 'canvas' });
    window.model = await daumier.openSketchModel(ort, '/weights/sketch-ict');
    window.inkModel = await daumier.openSketchModel(ort, '/runs/ink/sketch-ict', { framing: 'canvas' });
  });
  const found = [], folder = join(program.scratch, 'drawings');
  mkdirSync(folder);
  for (const [i, [, drawing]] of drawings.entries()) {
    writeFileSync(join(folder, `drawing${i}.svg`), svgOf(drawing));
    found.push(await page.evaluate(async (given) => {
      const canvas = await canvasModel.predict(given), framed = await model.predict(given), ofInk = await inkModel.predict(given);
      return { canvas: packed(canvas.vertices), framed: packed(framed.vertices), ink: packed(ofInk.vertices) };
    }, drawing));
  }
  const files = drawings.map((_, i) => join(folder, `drawing${i}.svg`));
  const kept = program.predict(files, '--weights', 'sketch-ict', '--keep-frame', '--no-refine'), framed = program.predict(files, '--weights', 'sketch-ict', '--no-fit');
  const inked = program.predict(files, '--weights', ink.weights, '--keep-frame', '--no-refine');
  drawings.forEach(([name], i) => {
    const vertices = ({ folder: of }) => verticesOfObj(join(of, `drawing${i}.obj`), numNumbers);
    const levels = ink.levelsOf(vertices(inked)), own = ink.levelsOf(unpacked(found[i].ink));
    report(`${name}, pixels of the picture that differ`, own.filter((level, at) => level !== levels[at]).length, 0, '');
    report(`${name}, face on the canvas`, difference(unpacked(found[i].canvas), vertices(kept)));
    report(`${name}, face framed by the parser`, difference(unpacked(found[i].framed), vertices(framed)), kFramedTolerance);
  });
}

/** The whole model.onnx of an exported run. */
async function compareRun({ program, page, report, run, drawing, numNumbers }) {
  const file = join(program.scratch, 'drawings/drawing0.svg');
  const { folder } = program.predict([run, file], '--keep-frame', '--no-refine');
  const found = await page.evaluate(async (given) => {
    const of = await daumier.openSketchModel(ort, '/runs/sketch_export', { framing: 'canvas' });
    return packed((await of.predict(given)).vertices);
  }, drawing);
  report('exported run, face on the canvas', difference(unpacked(found), verticesOfObj(join(folder, 'drawing0.obj'), numNumbers)));
}

/** SIREN: codes of `daumier edit`, whose vertices our own kernel computes. */
async function compareSurfaces({ program, page, report, run, numNumbers }) {
  const folder = join(program.scratch, 'edit');
  program.run('edit', run, '--random', '3', '--seed', '3', '--out', folder);
  const { faces } = JSON.parse(readFileSync(join(folder, 'edit.json'), 'utf8'));
  for (const { name, latent } of faces) {
    const found = await page.evaluate(async (code) => {
      window.surfaces ??= await daumier.openDeformModel(ort, '/runs/deform_export');
      return packed(await surfaces.decode(Float32Array.from(code)));
    }, latent);
    report(`SIREN, ${name}`, difference(unpacked(found), verticesOfObj(join(folder, `${name}.obj`), numNumbers)));
  }
}

/** The browser decodes the JPEG; the program reads the same pixels from a PNG. */
async function comparePortraits({ program, page, report, run, numNumbers }) {
  const { manifest } = program.predict([join(repository, 'docs/examples/portraits/woman.jpg')], '--weights', 'portrait', 'fine=false');
  const { landmarks } = manifest.details.drawings.woman, text = join(program.scratch, 'landmarks.txt');
  writeFileSync(text, landmarks.map((point) => point.join(' ')).join('\n'));
  for (const size of [1, 2.3]) {
    const found = await page.evaluate(async ([points, times]) => {
      window.portraits ??= [await daumier.openPortraitModel(ort, '/weights/portrait'), await daumier.openPortraitModel(ort, '/runs/portrait_export')];
      const picture = await createImageBitmap(await (await fetch('/portraits/woman.jpg')).blob(), { colorSpaceConversion: 'none' });
      const canvas = new OffscreenCanvas(Math.round(picture.width * times), Math.round(picture.height * times)), context = canvas.getContext('2d');
      context.drawImage(picture, 0, 0, canvas.width, canvas.height);
      const pixels = context.getImageData(0, 0, canvas.width, canvas.height), faces = [];
      for (const model of portraits) {
        const { vertices, coefficients } = await model.predict(pixels, points.flat().map((at) => at * times));
        faces.push({ vertices: packed(vertices), coefficients: Object.values(coefficients).flatMap((each) => [...each]) });
      }
      return { width: canvas.width, height: canvas.height, data: packed(pixels.data), faces };
    }, [landmarks, size]);
    const file = join(program.scratch, `woman${size}.png`);
    writeFileSync(file, pngOf({ ...found, data: Buffer.from(found.data, 'base64') }));
    writeFileSync(text, landmarks.map((point) => point.map((at) => at * size).join(' ')).join('\n'));
    for (const [i, model] of [['--weights', 'portrait'], [run]].entries()) {
      const own = program.predict(i === 0 ? [file] : [...model, file], ...(i === 0 ? model : []), 'fine=false', `landmarks=${text}`), [name] = Object.keys(own.manifest.details.drawings);
      const { coefficients } = own.manifest.details.drawings[name], kinds = ['identity', 'expression', 'albedo', 'light', 'pose'], title = `portrait of ${found.width} x ${found.height}, ${i === 0 ? 'shipped' : 'exported run'}`;
      report(`${title}, coefficients`, difference(found.faces[i].coefficients, kinds.flatMap((kind) => coefficients[kind])));
      report(`${title}, face`, difference(unpacked(found.faces[i].vertices), verticesOfObj(join(own.folder, `${name}.obj`), numNumbers)));
    }
  }
}

/** A canvas that holds a drawing gives nearly the face of its strokes. */
async function readPicture({ page, report, drawing }) {
  const found = await page.evaluate(async ({ width, height, strokes }) => {
    const canvas = new OffscreenCanvas(2 * width, 2 * height), context = canvas.getContext('2d');
    Object.assign(context, { lineWidth: 2.5, lineCap: 'round', lineJoin: 'round' });
    context.scale(2, 2);
    for (const stroke of strokes) {
      context.beginPath();
      stroke.forEach(([x, y]) => context.lineTo(x, y));
      context.stroke();
    }
    const ofPicture = await model.predict(context.getImageData(0, 0, canvas.width, canvas.height)), ofStrokes = await model.predict({ width, height, strokes });
    return Math.max(...ofPicture.vertices.map((value, i) => Math.abs(value - ofStrokes.vertices[i])));
  }, drawing);
  report('a canvas in the place of its strokes, largest distance in cm', found, 0.5, '');
}

/** Each error names the file or argument, the cause and the repair. */
async function checkErrors({ page, failures }) {
  const messages = await page.evaluate(async () => {
    const messageOf = async (action) => action().then(() => 'no error', (error) => `${error.name} ${error.message}`);
    const picture = new ImageData(4, 4);
    return [
      [await messageOf(() => daumier.openSketchModel(ort, '/weights/portrait')), "task 'portrait' (expected 'sketch')"],
      [await messageOf(() => daumier.openSketchModel(ort, '/nowhere')), 'status 404'],
      [await messageOf(() => daumier.openSketchModel(ort, '/weights/face-ict')), "expected 'sketch'"],
      [await messageOf(() => daumier.openSketchModel(ort, '/runs/sketch_export')), 'framing: "canvas"'],
      [await messageOf(() => daumier.openSketchModel(ort, 'http://127.0.0.1:9/')), 'could not be fetched'],
      [await messageOf(() => daumier.openSketchModel('/weights/sketch-ict', ort)), 'they are swapped'],
      [await messageOf(() => model.predict(document.createElement('canvas'))), 'it is a HTMLCanvasElement (expected its pixels). Give context.getImageData'],
      [await messageOf(() => model.predict(new Image())), 'it is a HTMLImageElement'],
      [await messageOf(() => model.predict(picture)), 'no lines'],
      [await messageOf(() => model.predict({ width: 3, height: 3, data: new Uint8Array(7) })), 'expected 36'],
      [await messageOf(() => model.predict({ width: 3, height: 3, strokes: [] })), 'no strokes'],
      [await messageOf(() => model.predict({ width: 3, height: 3, strokes: [[[NaN, 1]]] })), 'stroke 0'],
      [await messageOf(async () => {
        const running = inkModel.predict({ width: 9, height: 9, strokes: [[[1, 2], [5, 6]]] });
        await Promise.all([running, inkModel.release(), inkModel.release()]);
        return inkModel.predict({ width: 9, height: 9, strokes: [[[1, 2], [5, 6]]] });
      }), 'sketch-ict: the model was released. Open it again'],
      [await messageOf(() => canvasModel.faceOfInputs({ sketch: { data: new Float32Array(4), shape: [1, 1, 2, 2] } })), 'expected 1 x 1 x 128 x 128'],
    ];
  });
  for (const [message, expected] of messages)
    if (!message.startsWith('DaumierError') || !message.includes(expected)) failures.push(`an error is '${message}' (expected one with '${expected}')`);
}
