// axe-core on what the page shows, in light and dark.
import { npmPackage } from './browser.mjs';

/** Sentences about violations, one an element; empty if there are none. The page is light again afterwards. */
export async function accessibilityFaults(page) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.evaluate(npmPackage('axe-core').source);
  const faults = [];
  for (const colorScheme of ['dark', 'light']) {
    await page.emulateMedia({ colorScheme });
    const violations = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ['violations'] })).violations);
    for (const { id, help, nodes } of violations) {
      for (const node of nodes) faults.push(`${colorScheme}: ${id}, ${help}: ${node.target.join(' ')} (${node.failureSummary.split('\n')[1]?.trim()})`);
    }
  }
  return faults;
}
