// A study on the studio's page, using only clicks, keys and the clipboard:
// node study_page_test.mjs REPOSE CHROMIUM [PICTURES]
//
//   REPOSE    the program
//   CHROMIUM  the browser
//   PICTURES  a folder for screenshots of the page, for people to look at
//
// A study of peas is created from the form; its sheets are filled by typing and pasting, errors are shown
// at the cell; a number of the protocol is changed. A one-minute plan is made, the time estimated; a
// calibration is started, stopped, resumed and followed to its end although the page is closed meanwhile;
// its report is opened, its result saved, its coefficients exported. Nothing is fetched from elsewhere, no
// error is reported, axe finds nothing serious, nothing is wider than a phone.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {button, click, end, kPatience_ms, lookAt, open, sitDown, startStudio, textOf, until} from './hands.mjs';

const [repose, chromium, pictures] = process.argv.slice(2);

const fill = async (page, selector, text) => {
  await page.click(selector, {count: 3});
  await page.type(selector, text);
};

const cell = (experiment, row, column) => `[aria-label='${experiment}'] input[data-cell='${row},${column}']`;

const startStudy = async (page, folder) => {
  await click(page, 'Study');
  await page.waitForSelector('.new-study');
  // The study has no name yet.
  await click(page, 'Start the study');
  await page.waitForSelector('.new-study .fault');
  assert.match(await textOf(page, '.new-study .fault'), /has no name/);
  await fill(page, 'input[name=study]', 'peas');
  await page.select('select[name=grains]', 'pea');
  await page.select('select[name=plate]', 'wood');
  await fill(page, 'input[name=length]', '7.6');
  await until(page, () => document.querySelector('.new-study').textContent.includes('has 1 of its 3 numbers'));
  await fill(page, 'input[name=width]', '7,2');
  await fill(page, 'input[name=thickness]', '6.9');
  // Only drop and tilt, which take seconds.
  for (const name of ['roll', 'heap']) await page.click(`input[name=${name}]`);
  await until(page, () => document.querySelector('.command code').textContent.endsWith('--grain-mm 7.6,7.2,6.9 --plate wood --experiments drop,tilt'));
  await lookAt(page, 'study_new', pictures);
  await click(page, 'Start the study');
  await page.waitForSelector('.sheet');
  assert.match(readFileSync(join(folder, 'peas.toml'), 'utf8'), /size_mm = \[7.6, 7.2, 6.9\]/);
};

const fillSheets = async (page, folder) => {
  // Typed, with a wrong cell, row by row with Enter.
  await page.click(cell('drop', 0, 1));
  for (const text of ['180', '600', '176', '187', '172', '191']) {
    await page.keyboard.type(text);
    await page.keyboard.press('Enter');
  }
  // The drop height is the study's.
  assert.equal(await page.$eval(cell('drop', 5, 0), (input) => input.value), '500');
  await page.waitForSelector(`${cell('drop', 1, 1)}[aria-invalid=true]`);
  assert.match(await textOf(page, "[aria-label='drop'] .faults"), /rebound_mm = 600 is more than drop_mm = 500/);
  await lookAt(page, 'study_readings', pictures);
  await fill(page, cell('drop', 1, 1), '184');
  await until(page, () => !document.querySelector("[aria-label='drop'] .faults"));
  const save = async (experiment) => {
    await (await page.waitForSelector(`::-p-xpath(//section[@aria-label='${experiment}']//button[normalize-space()='Save the readings' and not(@disabled)])`)).click();
    await until(page, (name) => document.querySelector(`[aria-label='${name}'] .sheet [role=status]`).textContent.includes('saved in'), experiment);
  };
  await save('drop');
  assert.equal(readFileSync(join(folder, 'peas/drops.csv'), 'utf8'), 'drop_mm,rebound_mm\n500,180\n500,184\n500,176\n500,187\n500,172\n500,191\n');
  // Pasted as from a spreadsheet.
  await page.focus(cell('tilt', 0, 0));
  await page.evaluate(() => navigator.clipboard.writeText('19,8\n20,6\n21,1\n19,5\n20,2\n'));
  await page.keyboard.down('Control');
  await page.keyboard.press('v');
  await page.keyboard.up('Control');
  await until(page, (selector) => document.querySelector(selector).value === '20,2', cell('tilt', 4, 0));
  await save('tilt');
  await until(page, () => !document.querySelector('.todo'));
};

const changeProtocol = async (page, folder) => {
  await (await page.$("[aria-label='tilt'] .protocol summary")).click();
  const rate = "input[aria-label='rate_deg_s of tilt']";
  await fill(page, rate, '-1');
  await page.waitForSelector(`${rate}[aria-invalid=true]`);
  await fill(page, rate, '3');
  await until(page, (selector) => document.querySelector(selector).getAttribute('aria-invalid') === 'false', rate);
  await (await page.$("[aria-label='tilt'] .protocol button")).click();
  await until(page, () => document.querySelector("[aria-label='tilt'] .protocol [role=status]").textContent.includes('saved in'));
  assert.match(readFileSync(join(folder, 'peas.toml'), 'utf8'), /\nrate_deg_s = 3\n/);
};

const changeBounds = async (page, folder) => {
  await (await page.$("[aria-label='bounds'] summary")).click();
  const max = "input[aria-label='restitution, particle–wall: max of bounds']";
  await fill(page, max, '0.01');
  await page.waitForSelector("[aria-label='bounds'] .fault");
  await fill(page, max, '0.85');
  await until(page, () => !document.querySelector("[aria-label='bounds'] .fault"));
  await (await page.$("[aria-label='bounds'] button")).click();
  await until(page, () => document.querySelector("[aria-label='bounds'] [role=status]").textContent.includes('saved in'));
  assert.match(readFileSync(join(folder, 'peas.toml'), 'utf8'), /\nrestitution = \{ value = [0-9.]+, min = [0-9.]+, max = 0.85 \}/);
  await lookAt(page, 'study_bounds', pictures);
};

const calibrate = async (browser, page, address) => {
  await click(page, '3. Calibration');
  await click(page, 'How long would it take?');
  await until(page, () => /at most \d+ (s|min) on \d+ core/.test(document.querySelector('.budgets')?.textContent ?? ''));
  await lookAt(page, 'study_start', pictures);
  await click(page, 'Start the calibration');
  await page.waitForSelector('.at-work progress');
  await click(page, 'Stop');
  await until(page, () => /Stopped|Open the report/.test(document.querySelector('.calibration').textContent));
  if (!await page.$('.found')) await click(page, 'Resume');
  await until(page, () => document.querySelector('.narrowing figure') || document.querySelector('.found'));
  await lookAt(page, 'study_at_work', pictures);
  // It continues without the page.
  await page.close();
  const {page: again, errors} = await open(browser, address);
  await click(again, 'Study');
  await click(again, '3. Calibration');
  await again.waitForSelector('.found');
  assert.match(await textOf(again, '.found'), /restitution, particle–wall.*determined/);
  return {again, errors};
};

const takeAway = async (browser, page) => {
  const href = await page.$eval('.files-list a', (link) => link.href);
  const result = await page.evaluate(async (address) => (await fetch(address)).json(), href);
  assert.equal(result.parameters.length, 3);
  await page.click('.found .check input');
  await page.select('.found select', 'yade');
  await click(page, 'Export');
  await page.waitForSelector('.found .done');
  assert.match(await textOf(page, '.found .done'), /repose export peas_calibration --to yade --approximate/);
  await lookAt(page, 'study_found', pictures);
  const opened = new Promise((resolve) => browser.once('targetcreated', resolve));
  await page.click('a.button');
  const report = await (await opened).page();
  await report.waitForSelector('.chart .main-svg', {timeout: kPatience_ms});
  assert.match(await textOf(report, 'h1'), /Peas on wood/);
  // The report's scripts have no access to the studio.
  assert.equal(await report.evaluate(() => fetch('/api/folder').then(() => 'answered', () => 'refused')), 'refused');
  await report.close();
};

const plan = async (page) => {
  await click(page, '2. Which experiments');
  await page.waitForSelector('.plan select');
  await page.select('.plan select', '1');
  await click(page, 'Find out');
  await page.waitForSelector('.effects');
  assert.match(await textOf(page, '.effects'), /drop.*measured.*roll/);
  // The roll is not measured, and would determine rolling friction.
  assert.match(await textOf(page, '.outlook'), /what is measured.*open.*\+ roll/);
  await lookAt(page, 'study_plan', pictures);
};

const sit = async (browser, folder) => {
  const {studio, address} = await startStudio(repose, folder);
  await browser.defaultBrowserContext().overridePermissions(new URL(address).origin, ['clipboard-read', 'clipboard-write', 'clipboard-sanitized-write']);
  const {page, errors} = await open(browser, address);
  await startStudy(page, folder);
  await fillSheets(page, folder);
  await changeProtocol(page, folder);
  await changeBounds(page, folder);
  await plan(page);
  const {again, errors: later} = await calibrate(browser, page, address);
  await takeAway(browser, again);
  assert.deepEqual([...errors, ...later].filter((text) => !text.includes('400 (Bad Request)')), []);
  assert.equal(await end(studio, 'SIGINT'), 0);
};

await sitDown(chromium, 'peas_on_wood', pictures, sit);
