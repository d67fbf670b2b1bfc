// Films of a drop, a roll and a tilt on the studio's page, using only clicks, drags, drops and keys:
// node film_page_test.mjs REPOSE CHROMIUM FILMS [PICTURES]
//
//   REPOSE    the program
//   CHROMIUM  the browser
//   FILMS     a folder with drop_1.mp4, roll_1.mp4 and tilt_1.mp4
//   PICTURES  a folder for screenshots of the page, for people to look at
//
// Films are dropped onto the page and tracked, and stepped through with the arrow keys; a bounce is struck
// out and accepted again with the keyboard; a length is drawn and its value typed; readings go into a
// study's sheet, or the page says why not. Nothing is fetched from elsewhere, no error is reported, axe
// finds nothing serious, nothing is wider than a phone.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {angle, button, click, drag, drop, end, isOff, lookAt, open, sitDown, startStudio, textOf, until} from './hands.mjs';

const [repose, chromium, films, pictures] = process.argv.slice(2);

const choose = async (page, name) => {
  await (await page.$(`::-p-xpath(//nav//button[contains(., '${name}')])`)).click();
  await until(page, (wanted) => document.querySelector('.picture h2').textContent === wanted, name);
};

// Types into the field with this label and presses Enter.
const say = async (page, label, text) => {
  const field = await page.waitForSelector(`::-p-xpath(//label[starts-with(normalize-space(), '${label}')]/input)`);
  await field.click({count: 3});
  await page.keyboard.type(text);
  await page.keyboard.press('Enter');
};

const startStudy = async (page) => {
  await click(page, 'Study');
  await page.waitForSelector('.new-study');
  await page.type('input[name=study]', 'peas');
  await page.select('select[name=grains]', 'pea');
  await page.select('select[name=plate]', 'wood');
  for (const name of ['roll', 'heap']) await page.click(`input[name=${name}]`);
  await click(page, 'Start the study');
  await page.waitForSelector('.sheet');
  await click(page, 'Pictures');
};

// A drop, tracked on arrival; frames stepped with the arrow keys.
const lookThrough = async (page) => {
  await choose(page, 'drop_1.mp4');
  await until(page, () => /^0\.6\d\d\s±\s/.test(document.querySelector('.result .angle')?.textContent ?? ''));
  assert.equal(await textOf(page, '.result .badge'), 'ok');
  assert.match(await textOf(page, '.command code'), /^repose track drop .*drop_1\.mp4$/);
  await page.waitForSelector('.strobe img');
  const at = () => textOf(page, '.slider');
  await page.focus('.slider input');
  const first = await at();
  for (let step = 0; step < 5; ++step) await page.keyboard.press('ArrowRight');
  assert.notEqual(await at(), first);
  await until(page, () => document.querySelector('.frames image').href.baseVal.includes('number=5'));
  // Go to the first bounce, where the grain was seen.
  await (await page.$('.bounces .link')).click();
  await page.waitForSelector('.frames .grain');
  assert.match(await at(), /Frame at 0\.[56]\d\d s/);
};

// Into the sheet of a study, which first states a different drop height.
const giveReadings = async (page, folder) => {
  const sheet = join(folder, 'peas/drops.csv');
  await page.focus("[aria-label='Bounce 1 counts']");
  await page.keyboard.press('Space');
  await page.waitForSelector('.bounces .struck:first-child');
  assert.equal(await isOff(page, 'Put into its sheet'), true);
  await page.keyboard.press('Space');
  await click(page, 'Put into its sheet');
  await page.waitForSelector('.to-sheet .trouble');
  assert.match(await textOf(page, '.to-sheet .trouble'), /drop_mm.*500/);
  await lookAt(page, 'film_other_height', pictures);
  assert.equal(readFileSync(sheet, 'utf8').trim(), 'drop_mm,rebound_mm');
  await click(page, 'Study');
  await (await page.waitForSelector("[aria-label='drop'] .protocol summary")).click();
  const height = "input[aria-label='height_mm of drop']";
  await page.click(height, {count: 3});
  await page.keyboard.type('200');
  await (await page.waitForSelector("::-p-xpath(//section[@aria-label='drop']//button[normalize-space()='Save in the study' and not(@disabled)])")).click();
  await until(page, () => document.querySelector("[aria-label='drop'] .protocol [role=status]").textContent.includes('saved in'));
  await click(page, 'Pictures');
  await choose(page, 'drop_1.mp4');
  await (await button(page, 'Put into its sheet')).evaluate((element) => element.focus());
  await until(page, () => [...document.querySelectorAll('.to-sheet button')].some(({disabled}) => !disabled));
  await (await button(page, 'Put into its sheet')).focus();
  await page.keyboard.press('Enter');
  await until(page, () => document.querySelector('.to-sheet [role=status]').textContent.includes('One reading put into peas/drops.csv'));
  assert.match(readFileSync(sheet, 'utf8'), /^drop_mm,rebound_mm,sample,in_air,drop_uncertainty_mm\n20\d\.\d+,7\d\.\d+,drop_1,0,\d\.\d+\n$/);
  await lookAt(page, 'film_drop', pictures);
  // The study's page shows it.
  await click(page, 'Study');
  await until(page, () => [...document.querySelectorAll("[aria-label='drop'] td input")].some(({value}) => value === 'drop_1'));
  await click(page, 'Pictures');
};

const sayALength = async (page) => {
  await choose(page, 'roll_1.mp4');
  await until(page, () => document.querySelector('.result .reason')?.textContent.includes('there is no scale yet'));
  await lookAt(page, 'film_without_scale', pictures);
  await say(page, 'Released', '100');
  await until(page, () => /\d mm/.test(document.querySelector('.result .angle')?.textContent ?? ''));
  assert.match(await textOf(page, '.command code'), /--released 100$/);
  const released = await angle(page);
  await say(page, 'Released', ' ');
  await until(page, () => document.querySelector('.result .reason'));
  await page.waitForSelector('.frames svg image');
  await page.$eval('.frames', (element) => element.scrollIntoView());
  const [width, height] = await page.$eval('.frames svg', ({viewBox}) => [viewBox.baseVal.width, viewBox.baseVal.height]);
  await drag(page, [width * .1, height * .1], [width * .9, height * .1], '.frames svg');
  await page.waitForSelector('.frames line.length');
  await say(page, 'Its length', '500');
  await until(page, () => /--scale [0-9,]+,500$/.test(document.querySelector('.command code')?.textContent ?? ''));
  assert.notEqual(await angle(page), released);
  await lookAt(page, 'film_roll', pictures);
};

const seeARefusal = async (page) => {
  await choose(page, 'tilt_1.mp4');
  await until(page, () => /^19\.\d\d\s±\s0\.\d\d°/.test(document.querySelector('.result .angle')?.textContent ?? ''));
  await lookAt(page, 'film_tilt', pictures);
  await click(page, 'Drop');
  await until(page, () => document.querySelector('.result .badge')?.textContent === 'refused');
  assert.match(await textOf(page, '.result .reason'), /Fix: /);
  assert.equal(await isOff(page, 'Put into its sheet'), true);
  await click(page, 'Heap');
  await until(page, () => document.querySelector('.command code')?.textContent.startsWith('repose measure'));
};

const sit = async (browser, folder) => {
  const {studio, address} = await startStudio(repose, folder);
  const {page, errors} = await open(browser, address);
  await startStudy(page);
  await drop(page, ['drop_1.mp4', 'roll_1.mp4', 'tilt_1.mp4'].map((name) => join(resolve(films), name)));
  await until(page, () => document.querySelectorAll('.files li').length === 3);
  await lookThrough(page);
  await giveReadings(page, folder);
  await sayALength(page);
  await seeARefusal(page);
  assert.deepEqual(errors.filter((text) => !text.includes('400 (Bad Request)')), []);
  assert.equal(await end(studio, 'SIGINT'), 0);
};

await sitDown(chromium, 'peas_on_wood', pictures, sit);
