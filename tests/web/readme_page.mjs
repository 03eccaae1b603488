// The page that web/README.md gives, as it is there.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { repository } from '../../tools/consumers/studio/client.mjs';

export const readmePage = /```html\n(.*?)```/s.exec(readFileSync(join(repository, 'web/README.md'), 'utf8'))[1];
