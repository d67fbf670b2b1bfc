// User actions on the studio's page: starting it, clicks, drags, drops, looking.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {mkdirSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {basename, dirname, join, resolve as absolute} from 'node:path';
import puppeteer from 'puppeteer-core';
import {openWatched} from '../support/watched_page.mjs';

export const kPatience_ms = 120_000;
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const studios = [];

// Started from the parent folder, as a user would, so that the page shows no path of this machine.
// With `room_kb`, no larger file can be written, as on a full disk.
export const startStudio = (repose, folder, {room_kb} = {}) => new Promise((resolve, reject) => {
  const limit = room_kb ? `trap '' XFSZ; ulimit -f ${room_kb * 1024 / 512};` : '';
  const studio = spawn('sh', ['-c', `${limit} exec "$0" studio "$1" --no-browser`, absolute(repose), basename(folder)], {cwd: dirname(folder)});
  studios.push(studio);
  let said = '', complaint = '';
  studio.stdout.on('data', (text) => {
    said += text;
    if (said.includes('\n')) resolve({studio, address: said.trim()});
  });
  studio.stderr.on('data', (text) => { complaint += text; });
  studio.on('exit', (code) => reject(new Error(`repose studio ended with ${code}: ${complaint}`)));
});

// Returns its exit code.
export const end = (studio, signal) => {
  studio.removeAllListeners('exit');
  const ended = new Promise((resolve) => studio.on('exit', (code) => resolve(code)));
  studio.kill(signal);
  return ended;
};

const endAll = async () => {
  for (const studio of studios) {
    if (studio.exitCode === null && studio.signalCode === null) await end(studio, 'SIGKILL');
  }
};

// One session, with a browser and an empty folder of that name. Nothing is left behind, however it ends.
export const sitDown = async (chromium, name, pictures, sit) => {
  const above = mkdtempSync(join(tmpdir(), 'repose-studio-'));
  const folder = join(above, name);
  mkdirSync(folder);
  if (pictures) mkdirSync(pictures, {recursive: true});
  const browser = await puppeteer.launch({executablePath: chromium, args: ['--no-sandbox'], protocolTimeout: kPatience_ms});
  try {
    await sit(browser, folder);
  } finally {
    await endAll();
    await browser.close();
    rmSync(above, {recursive: true});
  }
};

export const open = async (browser, address) => {
  const {page, errors} = await openWatched(browser, address,
    {width: 1280, patience_ms: kPatience_ms, isOwn: (url) => url.replace(/^blob:/, '').startsWith(new URL(address).origin)});
  await page.waitForSelector('header');
  return {page, errors};
};

export const drop = async (page, files) => {
  const client = await page.createCDPSession();
  const data = {items: [], files, dragOperationsMask: 1};
  for (const type of ['dragEnter', 'dragOver', 'drop']) await client.send('Input.dispatchDragEvent', {type, x: 500, y: 400, data});
};

export const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);
export const button = (page, name) => page.waitForSelector(`::-p-xpath(//button[normalize-space()='${name}'])`);
// Elements still move after the window is resized.
const atRest = (element) => element.evaluate(async (moved) => {
  for (let last = '', same = 0; same < 3; ) {
    await new Promise(requestAnimationFrame);
    const {x, y} = moved.getBoundingClientRect(), now = `${x} ${y}`;
    same = now === last ? same + 1 : 0;
    last = now;
  }
});
export const click = async (page, name) => {
  // Waits for a disabled button, as a user would.
  const found = await page.waitForSelector(`::-p-xpath(//button[normalize-space()='${name}'][not(@disabled)])`);
  await atRest(found);
  await found.click();
};
export const isOff = async (page, name) => (await button(page, name)).evaluate(({disabled}) => disabled);
export const until = async (page, test, ...values) => {
  try {
    return await page.waitForFunction(test, {}, ...values);
  } catch (error) {
    throw new Error(`${error.message}. Waited for ${test}. The page says:\n${await page.evaluate(() => document.body.innerText)}`);
  }
};
export const untilMeasured = (page, count) => until(page, (wanted) => document.querySelectorAll('.files .badge').length === wanted, count);
export const angle = (page) => textOf(page, '.result .angle');
export const choose = async (page, name) => {
  const found = await page.$(`::-p-xpath(//nav//button[contains(., '${name}')])`);
  await atRest(found);
  await found.click();
  await until(page, (wanted) => document.querySelector('.picture h2').textContent === wanted, name);
  await page.waitForSelector('.viewer svg .flank');
};

// Screen position of a point in the picture.
export const onScreen = (page, x, y, within = '.viewer svg') => page.$eval(within, (svg, px, py) => {
  const at = new DOMPoint(px, py).matrixTransform(svg.getScreenCTM());
  return [at.x, at.y];
}, x, y);

export const drag = async (page, from, to, within = '.viewer svg') => {
  await atRest(await page.$(within));
  await page.mouse.move(...await onScreen(page, ...from, within));
  await page.mouse.down();
  await page.mouse.move(...await onScreen(page, ...to, within), {steps: 6});
  await page.mouse.up();
};

const serious = async (page) => {
  await page.evaluate(axe);
  const {violations} = await page.evaluate(() => window.axe.run());
  return violations.filter(({impact}) => impact === 'serious' || impact === 'critical')
    .map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html.slice(0, 120)).join(' | ')}`);
};

// On a desktop and a phone, light and dark: screenshots of the whole page, and of the window alone as a
// figure for the documents.
export const lookAt = async (page, name, pictures) => {
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
    for (const width of [1280, 390]) {
      await page.setViewport({width, height: 900});
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false, `${name} is wider than ${width} px`);
      assert.deepEqual(await serious(page), [], `${name}, ${scheme}, ${width} px`);
      const path = join(pictures ?? '', `${name}_${scheme}_${width}`);
      if (pictures) await page.screenshot({path: `${path}.png`, fullPage: true});
      if (pictures) await page.screenshot({path: `${path}.jpg`, type: 'jpeg', quality: 85});
    }
  }
  await page.emulateMediaFeatures([]);
  await page.setViewport({width: 1280, height: 900});
};
