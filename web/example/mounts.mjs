// What the example's page needs, by its address.
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = fileURLToPath(new URL('../', import.meta.url));

/** packageFolder: the built package; weights: folder of shipped weights. */
export function exampleMounts(packageFolder = join(web, 'dist'), weights = join(web, '../weights')) {
  return {
    '/': join(web, 'example'), '/daumier/': packageFolder, '/weights/': weights,
    '/ort/': join(web, 'node_modules/onnxruntime-web/dist'), '/three/': join(web, 'node_modules/three/build'),
  };
}
