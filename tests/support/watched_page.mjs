// A browser page that records forbidden events: errors, and requests to elsewhere.
export const openWatched = async (browser, address, {width, patience_ms, isOwn}) => {
  const page = await browser.newPage();
  page.setDefaultTimeout(patience_ms);
  const errors = [];
  page.on('console', (message) => { if (message.type() === 'error') errors.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => errors.push(`error: ${error.message}`));
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith('data:') && !isOwn(url)) errors.push(`request: ${url.slice(0, 200)}`);
  });
  await page.setViewport({width, height: 900});
  await page.goto(address);
  return {page, errors};
};
