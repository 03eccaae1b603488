// A person at the page of `daumier studio`: pointer, tabs and buttons, and what the page shows.
import { setTimeout as delay } from 'node:timers/promises';

const kPaperMargin = 14;  // CSS pixels around a sheet that is shown whole: studio/page/src/draw/paper_view.ts.

export class StudioDriver {
  /** Faults of the page while it is used: console errors, exceptions, requests to other hosts. */
  faults = [];
  /** The last response with the face of the tab Shape. */
  lastShape = null;

  constructor(page, { address, api }) {
    this.page = page;
    this.address = address;
    this.api = api;
    page.on('console', (message) => message.type() === 'error' && this.faults.push(`console: ${message.text()} ${message.location().url}`));
    page.on('pageerror', (error) => this.faults.push(`exception: ${error.stack ?? error.message}`));
    page.on('request', (request) => {
      const { protocol, origin } = new URL(request.url());
      if (!['blob:', 'data:'].includes(protocol) && origin !== api.origin) this.faults.push(`request to another host: ${request.url()}`);
    });
    page.on('response', (response) => {
      if (response.request().method() === 'POST' && new URL(response.url()).pathname === '/api/shape') this.lastShape = response;
    });
  }

  async open() {
    await this.page.goto(this.address);
    await this.page.locator('.start h2').waitFor();
  }
  async openTab(title) {
    await this.page.getByRole('tab', { name: title, exact: true }).click();
  }
  async press(name) {
    await this.page.getByRole('button', { name, exact: true }).click();
  }

  /** Waits until a check holds, and returns its value. */
  async until(what, check, seconds = 20) {
    const end = performance.now() + 1000 * seconds;
    for (;;) {
      const value = await check();
      if (value) return value;
      if (performance.now() > end) throw new Error(`${what}: not within ${seconds} s.`);
      await delay(40);
    }
  }

  // The drawing, as the server has it.
  async sessionId() {
    return this.page.evaluate(() => JSON.parse(localStorage.getItem('daumier-studio') ?? '{}').session ?? '');
  }
  async session() {
    const id = await this.sessionId();
    return id === '' ? null : this.api.must('GET', `/api/sessions/${id}`);
  }
  /** The state of the drawing as soon as a check of it holds. */
  async sessionWhere(what, check) {
    return this.until(what, async () => {
      const state = await this.session();
      return state && check(state) ? state : null;
    });
  }
  async sessionVertices() {
    const { id, revision } = await this.session();
    return this.api.must('GET', `/api/sessions/${id}/vertices?revision=${revision}`);
  }

  // The paper.
  /** Pixels of the window of points of the sheet, which is shown whole. */
  async onScreen(points, sheet) {
    const { x, y, width, height } = await this.page.locator('.paper').evaluate((paper) => {
      const box = paper.getBoundingClientRect();
      return { x: box.x + paper.clientLeft, y: box.y + paper.clientTop, width: paper.clientWidth, height: paper.clientHeight };
    });
    const zoom = Math.min((width - 2 * kPaperMargin) / sheet[0], (height - 2 * kPaperMargin) / sheet[1]);
    const left = x + (width - zoom * sheet[0]) / 2, top = y + (height - zoom * sheet[1]) / 2;
    return points.map((point) => [left + zoom * point[0], top + zoom * point[1]]);
  }
  /** Moves the pressed pointer along points of the sheet. */
  async stroke(points, sheet) {
    await this.drag(await this.onScreen(points, sheet));
  }
  async drag([first, ...rest]) {
    await this.page.mouse.move(...first);
    await this.page.mouse.down();
    // A pointer does not wait for the page: the browser hands over the moves of one frame together.
    await Promise.all(rest.map((point) => this.page.mouse.move(...point)));
    await this.page.mouse.up();
  }
  /** A stroke of a pen whose pressure, 0 to 1, is given for each point. */
  async penStroke(points, pressures, sheet) {
    const places = await this.onScreen(points, sheet);
    const devtools = await this.page.context().newCDPSession(this.page);
    const pen = (type, [x, y], force) =>
      devtools.send('Input.dispatchMouseEvent', { type, x, y, force, pointerType: 'pen', button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1 });
    await pen('mousePressed', places[0], pressures[0]);
    for (const [i, place] of places.entries()) await pen('mouseMoved', place, pressures[i]);
    await pen('mouseReleased', places.at(-1), 0);
    await devtools.detach();
  }
  /** The share of points of the sheet that have ink within 3 pixels of the screen. */
  async inkedShare(points, sheet) {
    await this.nextFrame();
    const places = await this.onScreen(points, sheet);
    const isInked = await this.page.locator('.paper').evaluate((paper, at) => {
      const canvas = [...paper.querySelectorAll('canvas')].at(-1);
      const box = canvas.getBoundingClientRect();
      const scale = canvas.width / box.width;
      const context = canvas.getContext('2d');
      const side = Math.ceil(7 * scale);
      return at.map(([x, y]) => {
        const square = context.getImageData((x - box.x - 3) * scale, (y - box.y - 3) * scale, side, side).data;
        return square.some((value, i) => i % 4 === 3 && value > 0);
      });
    }, places);
    return isInked.filter(Boolean).length / points.length;
  }

  // The 3-D view.
  async nextFrame() {
    await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }
  /** The picture of the 3-D view, PNG. */
  async viewPicture() {
    await this.nextFrame();
    return this.page.locator('.view-stage').screenshot();
  }
  /** The middle of the 3-D view, in pixels of the window. */
  async viewMiddle() {
    const box = await this.page.locator('.view-stage').boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  }
  /** The vertices of the tab Shape once no request waits. */
  async shapeVertices() {
    await this.page.locator('.p-shape[aria-busy="false"]').waitFor();
    return this.lastShape.body();
  }
}
