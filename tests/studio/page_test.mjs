// A session on the studio's page, using only clicks, drags, drops and keys:
// node page_test.mjs REPOSE CHROMIUM PHOTOS [PICTURES]
//
//   REPOSE    the program
//   CHROMIUM  the browser
//   PHOTOS    a folder of photographs of heaps
//   PICTURES  a folder for screenshots of the page, for people to look at
//
// Photographs are dropped onto the page and measured; one is corrected by hand, undone, corrected again,
// saved and, with the keyboard alone, reset; the set is viewed, sorted and downloaded, and sets are
// compared, giving the same bytes as the command line. Nothing is fetched from elsewhere, no error is
// reported, axe finds nothing serious, nothing is wider than a phone. The page notices when the studio
// ends. Two windows do not overwrite each other's work, files that are too large and full disks are
// reported and leave nothing behind, and a folder has one studio at a time.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {closeSync, copyFileSync, existsSync, mkdirSync, openSync, readFileSync, readdirSync, rmSync, truncateSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {unzipped} from '../support/zip_file.mjs';
import {angle, button, choose, click, drag, drop, end, isOff, lookAt, onScreen, open, sitDown, startStudio, textOf, until, untilMeasured} from './hands.mjs';

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
  // A label that is not part of the heap.
  await click(page, 'Leave out');
  await drag(page, [size[0] * 0.02, size[1] * 0.02], [size[0] * 0.12, size[1] * 0.1]);
  await page.waitForSelector('.said .exclude');
  await until(page, () => document.querySelector('.command code').textContent.includes('--exclude'));
  await click(page, 'Save');
  await page.waitForSelector('.files .corrected');
  assert.equal(existsSync(join(folder, `${name}.repose.toml`)), true);
};

// Paints beside the heap and on it; undone, painted again, saved as a mask.
const paint = async (page, folder, name) => {
  await choose(page, name);
  const [width, height] = await page.$eval('.viewer image', (image) => [Number(image.getAttribute('width')), Number(image.getAttribute('height'))]);
  await click(page, 'Paint');
  await click(page, 'not heap');
  await drag(page, [width * .1, height * .15], [width * .8, height * .2]);
  await page.waitForSelector('.painted polyline.no_heap');
  await click(page, 'heap');
  await drag(page, [width * .45, height * .58], [width * .6, height * .58]);
  await page.waitForSelector('.painted polyline.heap');
  await until(page, () => document.querySelector('.command code').textContent.includes('--mask'));
  await click(page, 'Undo');
  await until(page, () => !document.querySelector('.painted polyline.heap') && document.querySelector('.painted polyline.no_heap'));
  await drag(page, [width * .45, height * .58], [width * .6, height * .58]);
  await page.waitForSelector('.painted polyline.heap');
  await lookAt(page, 'paint', pictures);
  await click(page, 'Save');
  await page.waitForSelector('.painted .mask');
  assert.ok(existsSync(join(folder, `${name}.repose.mask`)));
  assert.match(readFileSync(join(folder, `${name}.repose.toml`), 'utf8'), /mask = /);
  assert.match(await textOf(page, '.command code'), /--mask hazelnuts/);
  await lookAt(page, 'painted', pictures);
  await click(page, 'Start again');
  await until(page, () => !document.querySelector('.painted .mask'));
  assert.equal(existsSync(join(folder, `${name}.repose.mask`)), false);
};

const forgetByKeys = async (page, folder, name) => {
  await (await button(page, 'Start again')).focus();
  await page.keyboard.press('Enter');
  await until(page, () => !document.querySelector('.said .exclude'));
  assert.equal(existsSync(join(folder, `${name}.repose.toml`)), false);
  await page.focus('.fields summary');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await page.keyboard.type('10, 10, 90, 90', {delay: 250});  // the folder is polled meanwhile
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

// A drawn length gives sizes only once its value is typed.
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

// Returns the file that a click downloads.
const download = async (page, name, folder) => {
  const client = await page.createCDPSession();
  await client.send('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: folder});
  const before = new Set(readdirSync(folder));
  await (await page.$(`::-p-xpath(//*[@class='downloads']/*[normalize-space()='${name}'])`)).click();
  for (let look = 0; look < 200; ++look) {
    const there = readdirSync(folder).find((file) => !before.has(file) && !file.startsWith('.') && !file.endsWith('.crdownload'));
    if (there) return readFileSync(join(folder, there));
    await new Promise((wake) => { setTimeout(wake, 100); });
  }
  throw new Error(`${name} was not downloaded`);
};

const cellsOf = (sheet, strings) => [...sheet.matchAll(/<c r="([A-Z]+[0-9]+)"([^>]*)><v>([^<]*)<\/v>/g)]
  .map(([, place, kind, value]) => [place, kind.includes('t="s"') ? strings[Number(value)] : Number(value)]);

const takeFilesOfSet = async (page, folder, count) => {
  const downloads = join(folder, '..', 'downloads');
  mkdirSync(downloads);
  const table = (await download(page, 'Table as CSV', downloads)).toString('utf8').trim().split('\n');
  assert.equal(table.length, count + 1);
  const workbook = unzipped(await download(page, 'Table as XLSX', downloads));
  const strings = [...workbook.get('xl/sharedStrings.xml').matchAll(/<si><t[^>]*>([^<]*)<\/t><\/si>/g)].map(([, text]) => text);
  const heaps = new Map(cellsOf(workbook.get('xl/worksheets/sheet1.xml'), strings));
  const columns = table[0].split(',');
  assert.deepEqual([heaps.get('A1'), heaps.get('C1'), heaps.get('C2'), heaps.get('A3')], ['file', 'angle_deg', '°', table[1].split(',')[0]]);
  assert.equal(heaps.get('C3'), Number(table[1].split(',')[2]));
  const meanings = new Map(cellsOf(workbook.get('xl/worksheets/sheet3.xml'), strings));
  columns.forEach((name, k) => {
    assert.equal(meanings.get(`A${k + 2}`), name);
    assert.ok(meanings.get(`C${k + 2}`).length > 5, name);
  });
  const drawing = (await download(page, 'Plot as SVG', downloads)).toString('utf8');
  assert.match(drawing, /^<svg [^>]*width="169mm"/);
  assert.equal(drawing.match(/<circle/g).length, count);
  const picture = await download(page, 'Plot as PNG', downloads);
  assert.equal(picture.readUInt32BE(16), 2000);
  const darkest = await page.evaluate(async (data) => {
    const shown = new Image();
    shown.src = `data:image/png;base64,${data}`;
    await shown.decode();
    const canvas = new OffscreenCanvas(shown.width, shown.height), paper = canvas.getContext('2d');
    paper.drawImage(shown, 0, 0);
    return paper.getImageData(0, 0, shown.width, shown.height).data.reduce((least, value) => Math.min(least, value), 255);
  }, picture.toString('base64'));
  assert.ok(darkest < 60, 'nothing is drawn on the PNG');
};

const lookAtSet = async (page, folder, count) => {
  await click(page, 'All as a set');
  await page.waitForSelector('.dots');
  assert.match(await textOf(page, '.set'), new RegExp(`n = ${count}, 95 % interval of the mean`));
  const column = (place) => page.$$eval(`.set tbody td:nth-child(${place})`, (cells) => cells.map(({textContent}) => textContent));
  await (await page.$(`::-p-xpath(//th//button[starts-with(., 'angle')])`)).click();
  const angles = (await column(4)).map(parseFloat);
  assert.deepEqual(angles, [...angles].sort((a, b) => a - b));
  await takeFilesOfSet(page, folder, count);
};

// Ticked pictures against others, and against a folder: the same comparison as by the command shown.
const compareSets = async (page, folder, files) => {
  const above = join(folder, '..');
  const dense = join(folder, 'dense');
  mkdirSync(dense);
  for (const name of files.slice(6)) copyFileSync(resolve(photos, name), join(dense, name));
  await page.reload();
  await untilMeasured(page, files.length);
  await click(page, 'All as a set');
  await page.waitForSelector('.sides');
  await click(page, 'Compare');
  await page.waitForSelector('.compare [role=alert]');
  assert.match(await textOf(page, '.compare [role=alert]'), /the first set: nothing is in it.*tick/);
  const tick = (name, side) => page.click(`input[aria-label="${name} in the ${side} set"]`);
  for (const name of files.slice(0, 3)) await tick(name, 'first');
  for (const name of files.slice(3, 6)) await tick(name, 'second');
  for (const [second, pattern] of [['', /cp .*first.*cp .*second/], ['dense', /cp .*first.* hazelnuts\/dense/]]) {
    await page.select('.sides label:nth-child(2) select', second);
    const before = await page.$$eval('.compare .figure', (figures) => figures[0]?.src);
    await click(page, 'Compare');
    await until(page, (was) => { const figure = document.querySelector('.compare .figure'); return figure && figure.src !== was && figure.complete; }, before);
    const command = await textOf(page, '.compare .command code');
    assert.match(command, pattern);
    for (const made of ['first', 'second']) rmSync(join(above, made), {recursive: true, force: true});
    execFileSync('sh', ['-c', command.replace('repose compare', `"$0" compare --json sets.json`), resolve(repose)], {cwd: above});
    const fetched = (name) => page.evaluate(async (address) => {
      const bytes = new Uint8Array(await (await fetch(address)).arrayBuffer());
      return [...bytes].map((byte) => String.fromCharCode(byte)).join('');
    }, name);
    const shown = await page.$eval('.compare .figure', ({src}) => src);
    assert.equal(await fetched(shown), readFileSync(join(above, 'sets.png')).toString('latin1'), 'another figure than the command draws');
    const [ours, theirs] = [JSON.parse(await fetched(shown.replace('.png', '.json'))), JSON.parse(readFileSync(join(above, 'sets.json')))];
    for (const json of [ours, theirs]) for (const set of json.sets) for (const heap of set.heaps) { delete heap.file; delete heap.files; }
    assert.deepEqual(ours, theirs);
    assert.ok((await textOf(page, '.compare .verdict')) === ours.verdict);
  }
  await lookAt(page, 'comparison', pictures);
  rmSync(dense, {recursive: true});
};

// Two windows on one picture: the second does not overwrite what the first has saved without asking.
const fightForAPicture = async (browser, address, page, folder, name) => {
  const {page: other, errors} = await open(browser, address);
  await untilMeasured(other, (await page.$$('.files li')).length);
  for (const [window, x] of [[page, 10], [other, 200]]) {
    await window.bringToFront();  // a page behind another draws nothing
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
  // The first window shows the current state.
  await page.bringToFront();
  await until(page, () => (document.querySelector('.command code').textContent.match(/--exclude/g) ?? []).length === 1
    && document.querySelector('.said .exclude rect').getAttribute('x') >= 150);
  await click(page, 'Start again');
  await until(page, () => !document.querySelector('.said .exclude'));
  // The only errors are the studio's refusals (409).
  assert.deepEqual(errors.filter((error) => !error.includes('409')), []);
  await other.close();
  await page.bringToFront();
};

// A file too large for the page: reported, and nothing left behind.
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
  // A second studio may not start there meanwhile, and a killed one leaves no lock.
  await assert.rejects(startStudio(repose, folder), /process \d+ is using it.*Fix: open the address/s);
  await end(studio, 'SIGKILL');
  await until(page, () => /has ended/.test(document.querySelector('[role=alert]').textContent));
  const {studio: next} = await startStudio(repose, folder);
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
  await paint(page, folder, files[4]);
  await lookAtSet(page, folder, files.length);
  await lookAt(page, 'set', pictures);
  await compareSets(page, folder, files);
  await click(page, 'Pictures');
  await fightForAPicture(browser, address, page, folder, files[2]);
  await attackByFiles(page, folder);
  // Without its access key the page shows nothing.
  const stranger = await (await browser.createBrowserContext()).newPage();
  assert.equal((await stranger.goto(new URL('/', address).href)).status(), 403);
  // Except the one that compareSets() provokes.
  assert.deepEqual(errors.filter((error) => !error.includes('status of 400')), []);
  assert.equal(await end(studio, 'SIGINT'), 0);
  await until(page, () => /has ended/.test(document.querySelector('[role=alert]').textContent));
};

await sitDown(chromium, 'hazelnuts', pictures, async (browser, folder) => {
  await sit(browser, folder);
  const full = join(dirname(folder), 'full');
  mkdirSync(full);
  await sitWithAFullDisk(browser, full);
});
