// Modules of the built package for unit tests: $DAUMIER_WEB, else web/dist.
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { repository } from '../../tools/consumers/studio/client.mjs';

const folder = resolve(process.env.DAUMIER_WEB ?? join(repository, 'web/dist'));

export const load = (name) => import(pathToFileURL(join(folder, `${name}.js`)).href);
