// Opens reports in Chromium as a reader would:
// node browser_test.mjs REPOSE CHROMIUM PHOTOGRAPH HEAP MADE_UP_RESULT
//
//   REPOSE      the program
//   CHROMIUM    the browser
//   PHOTOGRAPH  a picture of a heap
//   HEAP        a study file whose heap is quickly simulated
//   MADE_UP_RESULT  the program that writes a result
//
// Requirements: nothing is fetched, no error is reported, no name becomes markup, every chart is drawn
// with its titles inside it, on a desktop, a phone and paper, anything that scrolls sideways shows it,
// anything clickable reacts, a photograph shows pixel positions and its command, and on a phone verdicts
// are visible without scrolling sideways. Before the appendix there are at most eight printed pages. Load
// times are only printed.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {copyFileSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import puppeteer from 'puppeteer-core';
import {openWatched} from '../support/watched_page.mjs';
import {writeStudyFolder} from './study_folder.mjs';

const [repose, chromium, photograph, heapStudy, madeUpResult] = process.argv.slice(2);
const kMegabyte = 1e6, kPatience_ms = 240_000;

const runProgram = (program, ...words) => {
  const {status, stderr} = spawnSync(program, words, {encoding: 'utf8'});
  assert.equal(status, 0, `${program} ${words.join(' ')}: ${stderr}`);
};
const run = (...words) => runProgram(repose, ...words);

const makeReports = (folder) => {
  const study = join(folder, 'study'), heaps = join(folder, 'heaps');
  run('simulate', 'heap', heapStudy, '--views', '0', '--out', heaps);
  writeStudyFolder(study, {pictures: [
    {file: photograph, status: 'ok', angle_deg: null, reason: ''},
    {file: '/nowhere/<b>gone.jpg', status: 'ok', angle_deg: 20, reason: ''}]});
  runProgram(madeUpResult, join(study, 'result.json'));
  copyFileSync(join(heaps, 'heap_seed_1.vtp'), join(study, 'heap.vtp'));
  run('report', study);
  const half = join(folder, 'half');
  writeStudyFolder(half);
  runProgram(madeUpResult, join(folder, 'ignored.json'), join(half, 'runs', 'a.json'));
  run('report', half, '--tables', 'none');
  const measured = join(folder, 'measured.html');
  run('measure', photograph, '--report', measured);
  return [join(study, 'report.html'), join(half, 'report.html'), measured];
};

const open = async (browser, file, width) => {
  const start = Date.now(), address = pathToFileURL(file).href;
  const {page, errors} = await openWatched(browser, address,
    {width, patience_ms: kPatience_ms, isOwn: (url) => url.startsWith('blob:') || url === address});
  console.log(`${file} at ${width} px: loaded in ${Date.now() - start} ms`);
  await page.waitForFunction(() => [...document.querySelectorAll('.chart')].every(({dataset}) => dataset.state === 'drawn'));
  return {page, errors};
};

// Errors in the charts of a page, one line each.
const chartErrors = (page) => page.evaluate(() => {
  const errors = [];
  for (const figure of document.querySelectorAll('.chart')) {
    const name = figure.dataset.chart ?? figure.id, plot = figure.querySelector('.plot');
    const canvas = plot.querySelector('canvas');
    const marks = plot.querySelectorAll('.scatterlayer path, .contourlayer path').length;
    if (!canvas && marks === 0) errors.push(`${name}: nothing is drawn`);
    if (canvas && !(canvas.width > 0 && canvas.height > 0)) errors.push(`${name}: its canvas is empty`);
    if (!plot.getAttribute('aria-label')) errors.push(`${name}: no label`);
    const frame = plot.getBoundingClientRect();
    for (const text of plot.querySelectorAll('.xtitle, .ytitle, .legendtext, .xtick text, .ytick text')) {
      const box = text.getBoundingClientRect();
      const slack = 2;
      if (box.width > 0 && (box.left < frame.left - slack || box.right > frame.right + slack || box.top < frame.top - slack || box.bottom > frame.bottom + slack)) {
        errors.push(`${name}: “${text.textContent}” leaves the chart`);
      }
    }
    const below = [...plot.querySelectorAll('.xtitle')].map((text) => text.getBoundingClientRect().bottom);
    const legend = plot.querySelector('.legend')?.getBoundingClientRect();
    if (legend && below.some((bottom) => bottom > legend.top + 3)) errors.push(`${name}: the legend hides the axis title`);
  }
  return errors;
});

const checkPage = async (page, errors) => {
  assert.deepEqual(await chartErrors(page), []);
  assert.equal(await page.evaluate(() => window.hacked), undefined, 'a name became a script');
  assert.equal(await page.evaluate(() => document.querySelectorAll('main script, main img[src=x], main b b').length), 0);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false, 'the page is wider than the screen');
  assert.deepEqual(await page.evaluate(() => [...document.images].filter((image) => !image.alt || (image.getAttribute('src') && !image.naturalWidth)).length), 0, 'a picture lacks its text or does not open');
  assert.deepEqual(errors, []);
};

// Names of boxes with hidden content to their right and no sign of it.
const hiddenWithoutSign = (page) => page.evaluate(() => [...document.querySelectorAll('main *')]
  .filter((box) => box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).overflowX !== 'visible' && getComputedStyle(box).display !== 'inline')
  .filter((box) => !box.closest('.plot') && !box.matches('.scrolls'))
  .map((box) => `${box.tagName}.${box.className}`));

// Verdicts hidden to the right, in the tables of coefficients and of agreement.
const verdictsOutOfSight = (page) => page.evaluate(() => [...document.querySelectorAll('#answer table, #agreement table')]
  .filter((table) => table.querySelector('th:last-child').textContent === 'verdict')
  .filter((table) => table.querySelector('td:last-child').getBoundingClientRect().right > innerWidth)
  .map((table) => table.caption.textContent));

// Fraction of the page's width that its text covers.
const widthOfText = (page) => page.evaluate(() => {
  const body = getComputedStyle(document.body);
  const room = document.body.clientWidth - parseFloat(body.paddingLeft) - parseFloat(body.paddingRight);
  const boxes = [...document.querySelectorAll('main section > *')].map((box) => box.getBoundingClientRect());
  return (Math.max(...boxes.map(({right}) => right)) - Math.min(...boxes.map(({left}) => left))) / room;
});

// Charts that are wider than their column on paper.
const cutOnPaper = async (page) => {
  const kPaper_px = 680;
  await page.setViewport({width: kPaper_px, height: 980});
  await page.emulateMediaType('print');
  const cut = await page.evaluate(() => [...document.querySelectorAll('[data-kind="plane"] .main-svg, [data-kind="contour"] .main-svg')].filter((drawing) => {
    const figure = drawing.closest('.chart').getBoundingClientRect(), box = drawing.getBoundingClientRect();
    return box.right > figure.right + 1 || figure.right > innerWidth + 1 || !drawing.getAttribute('viewBox');
  }).map((drawing) => drawing.closest('.chart').id));
  await page.emulateMediaType('screen');
  return cut;
};

// Number of printed pages.
const printedPages = async (page) => {
  const pdf = await page.pdf({preferCSSPageSize: true, printBackground: true, timeout: kPatience_ms});
  return [...Buffer.from(pdf).toString('latin1').matchAll(/\/Type\s*\/Page\b(?!s)/g)].length;
};

const checkPaper = async (browser, page, file) => {
  const html = readFileSync(file, 'utf8');
  const before = html.replace(/<p class="part" id="appendix">[\s\S]*<\/main>/, '</main>');
  assert.notEqual(before, html, 'there is no appendix');
  const withoutAppendix = file.replace('.html', '_without_appendix.html');
  writeFileSync(withoutAppendix, before);
  const {page: shorter} = await open(browser, withoutAppendix, 1280);
  const pages = await printedPages(shorter), all = await printedPages(page);
  await shorter.close();
  console.log(`${pages} pages of ${all} before the appendix`);
  assert.ok(pages >= 1 && pages <= 8 && all > pages, `${pages} pages of ${all} before the appendix`);
};

const click = (page, figure, text) => page.evaluate((id, wanted) => {
  const button = [...document.querySelectorAll(`${id} button`)].find(({textContent}) => textContent === wanted);
  button.click();
}, figure, text);

// Waits until a mark can be clicked: in sight, and still for half a second with every chart drawn, since
// charts redrawn above it move it.
const inPlace = async (page, mark) => {
  await mark.evaluate((element) => element.scrollIntoView({block: 'center', behavior: 'instant'}));
  const place = () => mark.evaluate((element) => {
    const drawn = [...document.querySelectorAll('.chart')].every(({dataset}) => dataset.state === 'drawn');
    const {left, top} = element.getBoundingClientRect();
    return drawn ? `${left} ${top}` : '';
  });
  const kLooks = 5, kBetween_ms = 100;
  for (let last = '', looks = 0, start = Date.now(); looks < kLooks; ) {
    assert.ok(Date.now() - start < kPatience_ms, 'the page does not come to rest');
    const now = await place();
    looks = now && now === last ? looks + 1 : 0;
    last = now;
    await new Promise((resolve) => { setTimeout(resolve, kBetween_ms); });
  }
};

const checkInteraction = async (page) => {
  const camera = () => page.evaluate(() => JSON.stringify(document.querySelector('#chart-heap .plot').layout.scene.camera));
  const before = await camera();
  await click(page, '#chart-heap', 'from above');
  await page.waitForFunction((old) => JSON.stringify(document.querySelector('#chart-heap .plot').layout.scene.camera) !== old, {}, before);

  const first = '#chart-response_drop_particle_wall_restitution';
  await click(page, first, 'data');
  assert.ok(await page.evaluate((id) => document.querySelector(`${id} .data`).innerText.includes('simulated runs'), first));

  const surface = () => page.evaluate(() => JSON.stringify(document.querySelector('#surface-viewer .plot').data[0].z));
  const old = await surface();
  await page.evaluate(() => {
    const choice = document.querySelector('#surface-viewer select');
    choice.selectedIndex = choice.options.length - 1;
    choice.dispatchEvent(new Event('change'));
  });
  await page.waitForFunction((z) => JSON.stringify(document.querySelector('#surface-viewer .plot').data[0].z) !== z, {}, old);

  const toggle = await page.$(`${first} .legendtoggle`);
  await inPlace(page, toggle);
  await toggle.click();
  await page.waitForFunction((id) => document.querySelector(`${id} .plot`).data.some(({visible}) => visible === 'legendonly'), {}, first);
};

// In the photo report the pointer's position is shown in the picture's pixels, and the command can be copied.
const checkMarks = async (page, size) => {
  const picture = await page.$('[data-pixels] img');
  await picture.evaluate((image) => image.scrollIntoView({block: 'start', behavior: 'instant'}));
  const {x, y, width, height} = await picture.boundingBox();
  const [left, wide, high] = await page.$eval('[data-pixels]', ({dataset}) => dataset.pixels.split(' ').slice(2).map(Number));
  const said = () => page.$eval('.pixel', ({textContent}) => textContent);
  await page.mouse.move(x + (left + wide / 4) * width, y + high / 4 * height);
  const [, across, down] = /at (\d+), (\d+) px/.exec(await said());
  assert.ok(Math.abs(across - size[0] / 4) < 6 && Math.abs(down - size[1] / 4) < 6, `${across}, ${down} of ${size}`);
  await page.mouse.move(x + width / 2, y + (1 + high) / 2 * height);
  assert.equal(await said(), '');
  const copy = await page.$('.pictures .copy');
  assert.match(await page.$eval('.pictures pre', ({textContent}) => textContent), /^repose measure .*heap_01.jpg/);
  await copy.click();
  await page.waitForFunction((button) => button.textContent === 'copied', {}, copy);
};

const folder = mkdtempSync(join(tmpdir(), 'repose-report-'));
const browser = await puppeteer.launch({executablePath: chromium, headless: true, protocolTimeout: kPatience_ms,
  args: ['--no-sandbox', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist']});
try {
  const reports = makeReports(folder);
  for (const file of reports) {
    assert.ok(statSync(file).size <= 3 * kMegabyte, `${file}: ${statSync(file).size} bytes`);
    for (const width of [1280, 390]) {
      const {page, errors} = await open(browser, file, width);
      await checkPage(page, errors);
      assert.deepEqual(await hiddenWithoutSign(page), []);
      assert.deepEqual(await verdictsOutOfSight(page), []);
      assert.ok((await page.$$('header nav a')).length <= 8, 'the menu is long');
      if (width === 1280) assert.ok(await widthOfText(page) > .95, 'text leaves a part of the page empty');
      if (file === reports[0] && width === 1280) {
        await checkInteraction(page);
        await checkPaper(browser, page, file);
        assert.deepEqual(await cutOnPaper(page), []);
        assert.deepEqual(errors, []);
      }
      if (file === reports[2] && width === 1280) await checkMarks(page, [1600, 1066]);
      await page.close();
    }
  }
  console.log('every report is as it should be');
} finally {
  await browser.close();
  rmSync(folder, {recursive: true});
}
