// A server of folders on this machine, for the example and the tests: with the headers that threads need.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.json': 'application/json' };

/**
 * mounts: path that ends with / -> folder, another path -> text of a page. isolated: with COOP and COEP, without which there is one thread.
 * policy: Content-Security-Policy. Returns {origin, close}.
 */
export async function serve(mounts, { isolated = true, policy, port = 0 } = {}) {
  const headers = {
    ...(policy === undefined ? {} : { 'Content-Security-Policy': policy }),
    ...(isolated ? { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' } : {}),
  };
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    if (mounts[path] !== undefined && !path.endsWith('/')) return response.writeHead(200, { ...headers, 'Content-Type': 'text/html' }).end(mounts[path]);
    const mount = Object.keys(mounts).filter((each) => each.endsWith('/') && path.startsWith(each)).sort((a, b) => b.length - a.length)[0];
    try {
      const inside = normalize(`/${path.slice(mount.length)}`), file = join(mounts[mount], inside.endsWith('/') ? `${inside}index.html` : inside);
      const { size } = statSync(file);
      response.writeHead(200, { ...headers, 'Content-Type': kTypes[extname(file)] ?? 'application/octet-stream', 'Content-Length': size });
      createReadStream(file).pipe(response);
    } catch {
      response.writeHead(404, headers).end();
    }
  });
  await new Promise((resolve, reject) => server.once('error', reject).listen(port, '127.0.0.1', resolve));
  return {
    origin: `http://127.0.0.1:${server.address().port}`,
    close: () => {
      server.close();
      server.closeAllConnections();
    },
  };
}
