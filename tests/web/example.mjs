// The example's page, used by a pen. node tests/web/example.mjs BUILD [SHOT.png]; also called by run.mjs.
import { fileURLToPath } from 'node:url';
import { exampleMounts } from '../../web/example/mounts.mjs';
import { serve } from '../../web/example/server.mjs';
import { launchBrowser, newPage } from '../studio/page/browser.mjs';
import { drawnFace } from './drawings.mjs';
import { readmePage } from './readme_page.mjs';

/** The page of web/README.md: a tap as first line, then a line. */
async function useReadmePage(page, origin) {
  await page.goto(`${origin}/readme`);
  const status = page.locator('p');
  await page.locator('p', { hasText: 'Draw a face' }).waitFor();
  const { x, y } = await page.locator('canvas').boundingBox();
  await page.mouse.click(x + 50, y + 50);
  await page.waitForFunction(() => !document.querySelector('p').textContent.startsWith('Draw a face'));
  const said = await status.textContent(), failures = said.startsWith('drawing: it has no') ? [] : [`the page of the README says '${said}' of a tap`];
  await page.mouse.move(x + 100, y + 100);
  await page.mouse.down();
  await page.mouse.move(x + 200, y + 250, { steps: 8 });  // The page takes points of moves alone: one would have no extent.
  await page.mouse.up();
  await page.locator('p', { hasText: /A face of|hardly a face|it shows a face from the side/ }).waitFor();
  return failures;
}

/** Sentences of what is not well. shot: a file for a picture of the page. */
export async function useExample(packageFolder, shot) {
  const failures = [], { origin, close } = await serve({ ...exampleMounts(packageFolder), '/readme': readmePage }), browser = await launchBrowser();
  try {
    const page = await newPage(browser);
    page.setDefaultTimeout(60000);
    page.on('pageerror', (error) => failures.push(`the example reports: ${error.message}`));
    await page.goto(`${origin}/`);
    await page.locator('#status', { hasText: 'Draw a face' }).waitFor();
    const paper = page.locator('#paper'), view = page.locator('#view'), { x, y } = await paper.boundingBox(), before = await view.screenshot();
    const { width, strokes } = drawnFace(1), scale = 400 / width;
    for (const stroke of strokes) {
      const [first, ...rest] = stroke.map(([px, py]) => [x + 1 + scale * px, y + 40 + scale * py]);
      await page.mouse.move(...first);
      await page.mouse.down();
      for (const point of rest) await page.mouse.move(...point);
      await page.mouse.up();
    }
    await page.locator('#status', { hasText: /face of your lines|hardly a face/ }).waitFor();
    await page.waitForTimeout(500);
    if ((await view.screenshot()).equals(before)) failures.push('the example shows the same face after a drawing');
    failures.push(...(await useReadmePage(page, origin)));
    if (shot !== undefined) await page.screenshot({ path: shot });
  } finally {
    await browser.close();
    close();
  }
  return failures;
}

if (fileURLToPath(import.meta.url) === process.argv[1]) console.log(await useExample(process.argv[2], process.argv[3]));
