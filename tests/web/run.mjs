// node tests/web/run.mjs PROGRAM BUILD [--quick]: builds web/ into BUILD, runs its unit tests, compares it in Chromium with the C++ runtime
// (not with --quick), and uses its example there.
// Exit code 0: all is well; 1: sentences say what is not; 77: something that it needs is not installed.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { kSkipped, Missing } from '../studio/page/browser.mjs';
import { useExample } from './example.mjs';
import { compareWithProgram } from './parity.mjs';
import { Program } from './program.mjs';

const [programPath, build, option] = process.argv.slice(2), here = dirname(fileURLToPath(import.meta.url)), web = join(repository, 'web');

function must(what, ...args) {
  const { status } = spawnSync(process.execPath, args, { stdio: 'inherit', env: { ...process.env, DAUMIER_WEB: resolve(build) } });
  if (status !== 0) throw new Error(`${what} failed`);
}

const scratch = mkdtempSync(join(tmpdir(), 'daumier-web-'));
try {
  if (!existsSync(join(web, 'node_modules/typescript'))) throw new Missing('the npm packages of web/ are not installed (./dev setup installs them)');
  must('the compiler', join(web, 'node_modules/typescript/bin/tsc'), '-p', web, '--outDir', resolve(build));
  must('a unit test', '--test', ...readdirSync(here).filter((name) => name.endsWith('.test.mjs')).map((name) => join(here, name)));
  const failures = option === '--quick' ? [] : await compareWithProgram(new Program(resolve(programPath), scratch), resolve(build));
  failures.push(...(await useExample(resolve(build))));
  for (const failure of failures) console.error(failure);
  process.exitCode = failures.length > 0 ? 1 : 0;
} catch (error) {
  if (error instanceof Missing) console.log(`skipped web_package: ${error.message}`);
  else console.error(error);
  process.exitCode = error instanceof Missing ? kSkipped : 1;
} finally {
  rmSync(scratch, { recursive: true, force: true });
}
