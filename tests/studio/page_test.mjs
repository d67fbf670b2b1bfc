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
// A studio that ends is noticed. Two windows do not write over each other, files that are too large and
// disks that are full are told and leave nothing behind, and a folder has one studio at a time.
import assert from 'node:assert/strict';
import {closeSync, existsSync, mkdirSync, mkdtempSync, openSync, readFileSync, readdirSync, rmSync, truncateSync} from 'node:fs';
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

// Two windows on one picture: what the first has saved is not written over by the second unasked.
const fightForAPicture = async (browser, address, page, folder, name) => {
  const {page: other, errors} = await open(browser, address);
  await untilMeasured(other, (await page.$$('.files li')).length);
  for (const [window, x] of [[page, 10], [other, 200]]) {
    await window.bringToFront();  // a page behind others draws nothing
    await choose(window, name);
    await click(window, 'Leave out');
    await drag(window, [x, 10], [x + 90, 60]);
    await until(window, () => document.querySelector('.command code').textContent.includes('--exclude'));
  }
  const kept = () => /exclude.*/.exec(readFileSync(join(folder, `${name}.repose.toml`), 'utf8'))[0];
  await page.bringToFront();
  await click(page, 'Save');
  await page.waitForSelector('.files .corrected');
  const first = kept();
  await other.bringToFront();
  await click(other, 'Save');
  await other.waitForSelector('::-p-xpath(//*[@role="alert"]//button[.="Keep mine"])');
  assert.equal(kept(), first);
  await click(other, 'Keep mine');
  await click(other, 'Save');
  await until(other, () => document.querySelector('.actions .hint').textContent.includes('are saved'));
  const second = kept();
  assert.notEqual(second, first);
  // The first window shows what holds now.
  await page.bringToFront();
  await until(page, () => (document.querySelector('.command code').textContent.match(/--exclude/g) ?? []).length === 1
    && document.querySelector('.said .exclude rect').getAttribute('x') >= 150);
  await click(page, 'Start again');
  await until(page, () => !document.querySelector('.said .exclude'));
  // One that only looks is refused by the studio's answer alone.
  assert.deepEqual(errors.filter((error) => !error.includes('409')), []);
  await other.close();
  await page.bringToFront();
};

// A file too large for the page, and a disk without room for one: told, and nothing half there.
const attackByFiles = async (page, folder) => {
  const before = readdirSync(folder).sort();
  const large = join(folder, '..', 'large.jpg');
  closeSync(openSync(large, 'w'));
  truncateSync(large, 200 * 2 ** 20);
  await (await page.$('.add input')).uploadFile(large);
  await page.waitForSelector('[role=alert]');
  assert.match(await textOf(page, '[role=alert]'), /larger than 128 MB.*Fix/);
  assert.deepEqual(readdirSync(folder).sort(), before);
};

const sitWithAFullDisk = async (browser, folder) => {
  const {studio, address} = await startStudio(repose, folder, {room_kb: 64});
  const {page} = await open(browser, address);
  await drop(page, [resolve(photos, 'heap_01.jpg')]);
  await page.waitForSelector('[role=alert]');
  assert.match(await textOf(page, '[role=alert]'), /heap_01.jpg: cannot be written .*Fix/);
  assert.deepEqual(readdirSync(folder), ['.repose-studio.lock']);
  // Another may not start there meanwhile, and a killed one leaves no lock.
  await assert.rejects(startStudio(repose, folder), /process \d+ is using it.*Fix: open the address/s);
  studio.removeAllListeners('exit');
  await end(studio, 'SIGKILL');
  await until(page, () => /has ended/.test(document.querySelector('[role=alert]').textContent));
  const {studio: next} = await startStudio(repose, folder);
  next.removeAllListeners('exit');
  assert.equal(await end(next, 'SIGINT'), 0);
  await page.close();
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
  await click(page, 'Pictures');
  await fightForAPicture(browser, address, page, folder, files[2]);
  await attackByFiles(page, folder);
  // Without its key the page shows nothing.
  const stranger = await (await browser.createBrowserContext()).newPage();
  assert.equal((await stranger.goto(new URL('/', address).href)).status(), 403);
  assert.deepEqual(errors, []);
  studio.removeAllListeners('exit');
  assert.equal(await end(studio, 'SIGINT'), 0);
  await until(page, () => /has ended/.test(document.querySelector('[role=alert]').textContent));
};

const folder = mkdtempSync(join(tmpdir(), 'repose-studio-'));
const heaps = join(folder, 'hazelnuts');
mkdirSync(heaps);
if (pictures) mkdirSync(pictures, {recursive: true});
const browser = await puppeteer.launch({executablePath: chromium, args: ['--no-sandbox'], protocolTimeout: kPatience_ms});
try {
  await sit(browser, heaps);
  const full = join(folder, 'full');
  mkdirSync(full);
  await sitWithAFullDisk(browser, full);
} finally {
  await endAll();
  await browser.close();
  rmSync(folder, {recursive: true});
}
