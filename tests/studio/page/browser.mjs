// Debian's chromium by playwright-core, for the smoke test and the measurement of the page.
import { accessSync, constants } from 'node:fs';
import { createRequire } from 'node:module';
import { delimiter, join } from 'node:path';
import { repository } from '../../../tools/consumers/studio/client.mjs';

/** Exit code of a test that this machine cannot run. */
export const kSkipped = 77;

const names = ['chromium', 'chromium-browser', 'google-chrome'];
// The processor draws: 3-D by SwiftShader, the page itself without it, which takes a third of the time.
const flags = ['--disable-gpu', '--enable-unsafe-swiftshader'];

/** Thrown where something that the test needs is not installed. */
export class Missing extends Error {}

/** A package of tools/npm. @throws Missing */
export function npmPackage(name) {
  try {
    return createRequire(join(repository, 'tools/npm/package.json'))(name);
  } catch (error) {
    if (error.code !== 'MODULE_NOT_FOUND') throw error;
    throw new Missing(`the npm package ${name} is not installed (./dev setup installs it)`);
  }
}

function findChromium() {
  for (const folder of (process.env.PATH ?? '').split(delimiter)) {
    for (const name of names) {
      const path = join(folder, name);
      try {
        accessSync(path, constants.X_OK);
        return path;
      } catch {
        continue;
      }
    }
  }
  throw new Missing('chromium is not installed (./dev setup installs it)');
}

/** A browser without a window. @throws Missing */
export async function launchBrowser() {
  const { chromium } = npmPackage('playwright-core');
  return chromium.launch({ executablePath: findChromium(), args: flags });
}

/** A page of its own cookies and stores, 1280 x 800, without motion. */
export async function newPage(browser) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'light', reducedMotion: 'reduce', acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(20000);
  return page;
}
