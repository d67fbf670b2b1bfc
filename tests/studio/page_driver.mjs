// A sitting at the studio's page: what hands and eyes do, for the tests that sit there.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';

export const kPatience_ms = 240_000;
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

export const startStudio = (repose, folder) => new Promise((resolve, reject) => {
  const studio = spawn(repose, ['studio', folder, '--no-browser']);
  let said = '';
  studio.stdout.on('data', (text) => {
    said += text;
    if (said.includes('\n')) resolve({studio, address: said.trim()});
  });
  studio.on('exit', (code) => reject(new Error(`repose studio ended with ${code}`)));
});

// Ends it as Ctrl-C does; its exit code.
export const endStudio = (studio) => {
  studio.removeAllListeners('exit');
  const ended = new Promise((resolve) => studio.on('exit', resolve));
  studio.kill('SIGINT');
  return ended;
};

// A page on which every error, and whatever it fetches from elsewhere, is kept.
export const open = async (browser, address) => {
  const page = await browser.newPage();
  page.setDefaultTimeout(kPatience_ms);
  const errors = [];
  page.on('console', (message) => { if (message.type() === 'error') errors.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => errors.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(new URL(address).origin) && !/^(data|blob):/.test(request.url())) errors.push(`request: ${request.url()}`);
  });
  await page.setViewport({width: 1280, height: 900});
  await page.goto(address);
  await page.waitForSelector('header');
  return {page, errors};
};

export const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);
export const button = (page, name) => page.waitForSelector(`::-p-xpath(//button[normalize-space()='${name}'])`);
export const click = async (page, name) => { await (await button(page, name)).click(); };
export const until = (page, test, ...values) => page.waitForFunction(test, {}, ...values);

const serious = async (page) => {
  await page.evaluate(axe);
  const {violations} = await page.evaluate(() => window.axe.run());
  return violations.filter(({impact}) => impact === 'serious' || impact === 'critical')
    .map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html.slice(0, 120)).join(' | ')}`);
};

// On a desk and on a telephone, light and dark; pictures of it where a folder for them is given.
export const lookAt = async (page, name, pictures) => {
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
    for (const width of [1280, 390]) {
      await page.setViewport({width, height: 900});
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false, `${name} is wider than ${width} px`);
      assert.deepEqual(await serious(page), [], `${name}, ${scheme}, ${width} px`);
      if (pictures) await page.screenshot({path: join(pictures, `${name}_${scheme}_${width}.png`), fullPage: true});
    }
  }
  await page.emulateMediaFeatures([]);
  await page.setViewport({width: 1280, height: 900});
};
