// Pictures of a report for docs/gallery: node gallery.mjs REPORT FOLDER. Run by scripts/gallery.
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { boxAtRest, drawn, openBrowser, ready } from './browser.mjs';

const [report, folder] = process.argv.slice(2);
const technique = 'clustered';

const browser = await openBrowser();
const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, offline: true });
const page = await context.newPage();
await page.goto(pathToFileURL(resolve(report)).href);
const shoot = (selector, name) => page.locator(selector).screenshot({ path: join(folder, `${name}.png`) });

await shoot('#techniques', 'report-techniques');
await page.selectOption('#left-layer', { label: technique });
await page.selectOption('#right-layer', { label: `${technique}, overlap` });
await ready(page, technique, `${technique}, overlap`);
await shoot('#viewer', 'report-overlap');
await page.selectOption('#left-layer', { label: 'reference' });
await page.selectOption('#right-layer', { label: technique });
await ready(page, 'reference', technique);
const box = await boxAtRest(page, '#canvas');
await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.55 * box.height);
for (let i = 0; i < 3; ++i) await page.click('#zoom-in');
await drawn(page);
await shoot('#viewer', 'report-pixels');
await shoot('#cost', 'report-cost');
await shoot('#passes', 'report-passes');
await browser.close();
