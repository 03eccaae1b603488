// A page that has the package and onnxruntime-web as modules, behind the policy of web/README.md.
import { createHash } from 'node:crypto';
import { launchBrowser, newPage } from '../studio/page/browser.mjs';
import { serve } from '../../web/example/server.mjs';

const importMap = JSON.stringify({ imports: { 'onnxruntime-web/wasm': '/ort/ort.wasm.min.mjs', 'daumier-web': '/daumier/index.js', 'three': '/three/three.module.js' } });
const importMapHash = createHash('sha256').update(importMap).digest('base64');
export const pageText = `<!doctype html><meta charset="utf-8"><title>daumier-web</title><link rel="icon" href="data:,"><script type="importmap">${importMap}</script>`;
/** What a page needs: the import map is inline, all else are files. */
export const policy = `default-src 'self'; script-src 'self' 'wasm-unsafe-eval' 'sha256-${importMapHash}'; worker-src 'self'; img-src 'self' data:`;

/** Numbers that the page sent by `packed`. */
export function unpacked(text) {
  return new Float32Array(new Uint8Array(Buffer.from(text, 'base64')).buffer);
}

/** mounts: path -> folder. Returns {page, origin, faults, close}; faults: errors and refusals of the page, in sentences. */
export async function openPage(mounts, { isolated = true, threads = 1 } = {}) {
  const server = await serve({ '/page': pageText, ...mounts }, { isolated, policy });
  const browser = await launchBrowser();
  const page = await newPage(browser), faults = [];
  page.setDefaultTimeout(60000);
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  await page.goto(`${server.origin}/page`);
  await page.evaluate(async (numThreads) => {
    const ort = await import('onnxruntime-web/wasm');
    ort.env.wasm.wasmPaths = '/ort/';
    ort.env.wasm.numThreads = numThreads;
    window.ort = ort;
    window.daumier = await import('daumier-web');
    window.packed = ({ buffer, byteOffset, byteLength }) => {
      let text = '';
      for (let at = 0; at < byteLength; at += 8192) text += String.fromCharCode(...new Uint8Array(buffer, byteOffset + at, Math.min(8192, byteLength - at)));
      return btoa(text);
    };
  }, threads);
  return { page, origin: server.origin, faults, close: async () => {
    await browser.close();
    server.close();
  } };
}
