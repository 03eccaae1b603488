// A started studio and its API, for tools/consumers/studio_load and the smoke test of the page.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

export const repository = fileURLToPath(new URL('../../../', import.meta.url));

/** Starts the program on a folder and waits for its address. */
export function startStudio(program, folder) {
  return startServer(program, ['--folder', folder]);
}

/** The same with any options. */
export async function startServer(program, options) {
  const child = spawn(program, ['studio', '--no-browser', ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
  let printed = '';
  const address = await new Promise((resolve, reject) => {
    child.stdout.on('data', (bytes) => {
      printed += bytes;
      const found = printed.match(/studio: (http:\S+)/);
      if (found) resolve(found[1]);
    });
    child.stderr.on('data', (bytes) => (printed += bytes));
    child.on('error', reject);
    child.on('exit', (code) => reject(new Error(`the studio ended with ${code}: ${printed}`)));
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const { origin, hash } = new URL(address);
  return { child, ended, address, api: new StudioApi(origin, hash.replace('#token=', '')) };
}

/** Resident memory of a process, MB. */
export function residentMegabytes(pid) {
  return Number(readFileSync(`/proc/${pid}/status`, 'utf8').match(/VmRSS:\s+(\d+)/)[1]) / 1024;
}

export class StudioApi {
  constructor(origin, token) {
    this.origin = origin;
    this.token = token;
  }

  /** {status, json or bytes}. Throws where the server is gone. */
  async call(method, path, body) {
    const response = await fetch(this.origin + path, {
      method,
      headers: { Authorization: `Bearer ${this.token}`, 'Content-Type': 'application/json' },
      body: body === undefined ? undefined : JSON.stringify(body),
    });
    const type = response.headers.get('content-type') ?? '';
    if (type.startsWith('application/json')) return { status: response.status, json: await response.json() };
    return { status: response.status, bytes: Buffer.from(await response.arrayBuffer()) };
  }

  /** The JSON or bytes of a call that has to succeed. */
  async must(method, path, body) {
    const reply = await this.call(method, path, body);
    if (reply.status >= 300) throw new Error(`${method} ${path}: ${reply.status} ${JSON.stringify(reply.json)}`);
    return reply.json ?? reply.bytes;
  }
}
