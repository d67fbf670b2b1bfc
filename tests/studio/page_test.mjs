// A sitting at the studio's page, by clicks, drags, drops and keys alone:
// node page_test.mjs REPOSE CHROMIUM PHOTOS [PICTURES]
//
//   REPOSE    the program
//   CHROMIUM  the browser
//   PHOTOS    a folder of photographs of heaps
//   PICTURES  a folder for pictures of the page, for people to look at
//
// Photographs are dropped onto the page and measured; one is corrected by hand, undone, corrected again,
// saved and, by the keyboard alone, forgotten; the set is looked at, sorted and downloaded. Nothing is
// fetched from elsewhere, no error is told, axe finds nothing serious, nothing is wider than a telephone.
// A studio that ends is noticed.
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import puppeteer from 'puppeteer-core';
import {angle, button, choose, click, drag, drop, end, endAll, isOff, kPatience_ms, lookAt, onScreen, open, startStudio, textOf, until, untilMeasured} from './hands.mjs';

const [repose, chromium, photos, pictures] = process.argv.slice(2);

const correctByHand = async (page, folder, name) => {
  await choose(page, name);
  const before = await angle(page);
  const size = await page.$eval('.viewer image', (image) => [Number(image.getAttribute('width')), Number(image.getAttribute('height'))]);
  const ground = await page.$eval('.viewer .ground', (line) => ['x1', 'y1', 'x2', 'y2'].map((key) => Number(line.getAttribute(key))));
  // The ground's right end, by its handle.
  await click(page, 'Ground');
  const right = [ground[2], ground[3]];
  await drag(page, right, [right[0], right[1] - size[1] * 0.05]);
  await until(page, (was) => document.querySelector('.result .angle').textContent !== was, before);
  assert.match(await textOf(page, '.command code'), /--ground/);
  assert.equal(existsSync(join(folder, `${name}.repose.toml`)), false);
  await click(page, 'Undo');
  await until(page, (was) => document.querySelector('.result .angle').textContent === was, before);
  // A label that is no heap.
  await click(page, 'Leave out');
  await drag(page, [size[0] * 0.02, size[1] * 0.02], [size[0] * 0.12, size[1] * 0.1]);
  await page.waitForSelector('.said .exclude');
  await until(page, () => document.querySelector('.command code').textContent.includes('--exclude'));
  await click(page, 'Save');
  await page.waitForSelector('.files .corrected');
  assert.equal(existsSync(join(folder, `${name}.repose.toml`)), true);
};

const forgetByKeys = async (page, folder, name) => {
  await (await button(page, 'Start again')).focus();
  await page.keyboard.press('Enter');
  await until(page, () => !document.querySelector('.said .exclude'));
  assert.equal(existsSync(join(folder, `${name}.repose.toml`)), false);
  await page.focus('.fields summary');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await page.keyboard.type('10, 10, 90, 90', {delay: 250});  // the folder is looked at meanwhile
  await page.keyboard.press('Enter');
  await until(page, () => document.querySelector('.command code').textContent.includes('--heap 10,10,90,90'));
  assert.equal(await isOff(page, 'Save'), false);
  await click(page, 'Undo');
};

const zoom = async (page) => {
  const shown = () => page.$eval('.viewer svg', (svg) => svg.viewBox.baseVal.width);
  const whole = await shown();
  await page.mouse.move(...await onScreen(page, 100, 100));
  await page.mouse.wheel({deltaY: -300});
  await until(page, (was) => document.querySelector('.viewer svg').viewBox.baseVal.width < was * 0.8, whole);
  await click(page, 'Whole');
  await until(page, (was) => document.querySelector('.viewer svg').viewBox.baseVal.width === was, whole);
};

// A length gives sizes only once it is said.
const measureALength = async (page) => {
  await click(page, 'Length');
  await drag(page, [100, 100], [500, 100]);
  await page.waitForSelector('.length input');
  assert.equal(await isOff(page, 'Save'), true);
  await page.type('.length input', '200');
  await page.keyboard.press('Enter');
  await until(page, () => /--scale [0-9,]+,200\b/.test(document.querySelector('.command code').textContent));
  await until(page, () => /base/.test(document.querySelector('.result table').textContent));
  await click(page, 'Undo');
  await click(page, 'Undo');
  await until(page, () => !document.querySelector('.command code').textContent.includes('--scale'));
};

const lookAtSet = async (page, count) => {
  await click(page, 'All as a set');
  await page.waitForSelector('.dots');
  assert.match(await textOf(page, '.set'), new RegExp(`n = ${count}, 95 % interval of the mean`));
  const column = (place) => page.$$eval(`.set tbody td:nth-child(${place})`, (cells) => cells.map(({textContent}) => textContent));
  await (await page.$(`::-p-xpath(//th//button[starts-with(., 'angle')])`)).click();
  const angles = (await column(4)).map(parseFloat);
  assert.deepEqual(angles, [...angles].sort((a, b) => a - b));
  const table = await page.evaluate(async () => (await fetch(document.querySelector('.downloads a').href)).text());
  assert.equal(table.trim().split('\n').length, count + 1);
};

const sit = async (browser, folder) => {
  const {studio, address} = await startStudio(repose, folder);
  const {page, errors} = await open(browser, address);
  assert.match(await textOf(page, '.empty'), /no pictures/);
  const files = readdirSync(photos).filter((name) => name.endsWith('.jpg'));
  await drop(page, files.map((name) => resolve(photos, name)));
  await untilMeasured(page, files.length);
  await correctByHand(page, folder, files[1]);
  await lookAt(page, 'picture', pictures);
  await zoom(page);
  await measureALength(page);
  await forgetByKeys(page, folder, files[1]);
  await lookAtSet(page, files.length);
  await lookAt(page, 'set', pictures);
  // Without its key the page shows nothing.
  const stranger = await (await browser.createBrowserContext()).newPage();
  assert.equal((await stranger.goto(new URL('/', address).href)).status(), 403);
  assert.deepEqual(errors, []);
  studio.removeAllListeners('exit');
  assert.equal(await end(studio, 'SIGINT'), 0);
  await page.waitForSelector('[role=alert]');
  assert.match(await textOf(page, '[role=alert]'), /has ended/);
};

const folder = mkdtempSync(join(tmpdir(), 'repose-studio-'));
const heaps = join(folder, 'hazelnuts');
mkdirSync(heaps);
if (pictures) mkdirSync(pictures, {recursive: true});
const browser = await puppeteer.launch({executablePath: chromium, args: ['--no-sandbox'], protocolTimeout: kPatience_ms});
try {
  await sit(browser, heaps);
} finally {
  await endAll();
  await browser.close();
  rmSync(folder, {recursive: true});
}
