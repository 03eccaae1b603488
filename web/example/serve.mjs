// npm run example: serves the example at http://127.0.0.1:8080/.
import { exampleMounts } from './mounts.mjs';
import { serve } from './server.mjs';

const { origin } = await serve(exampleMounts(), { port: 8080 });
console.log(`${origin}/`);
