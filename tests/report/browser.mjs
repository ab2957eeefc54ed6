// Headless Chromium with the network off, and pages in it that hold a report.
import assert from 'node:assert/strict';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { requirePackage } from './packages.mjs';
import { pageOf } from './synthetic.mjs';

const { chromium } = requirePackage('playwright-core');
let browser;
let folder;
let template;

export const openBrowser = () => chromium.launch({ executablePath: process.env.LUCIOLE_CHROMIUM, args: ['--no-sandbox', '--disable-gpu'] });

export async function startBrowser() {
    folder = await mkdtemp(join(tmpdir(), 'luciole-report-'));
    template = await readFile(process.env.LUCIOLE_REPORT_TEMPLATE, 'utf8');
    browser = await openBrowser();
}

export async function stopBrowser() {
    await browser?.close();
    if (folder) await rm(folder, { recursive: true });
}

/// Opens the report in a page of its own and hands the page to `use`. Fails if the page asks for anything but itself, or
/// says anything on the console. `before` runs in the page ahead of its own scripts.
export async function withPage(report, options, use) {
    const { before, ...contextOptions } = options;
    const file = join(folder, 'report.html');
    await writeFile(file, pageOf(template, report));
    const address = pathToFileURL(file).href;
    const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...contextOptions });
    const complaints = [];
    try {
        await context.setOffline(true);
        await context.route('**/*', (route) => {
            const url = route.request().url();
            if (url === address || url.startsWith('data:')) return route.continue();
            complaints.push(`request: ${url}`);
            return route.abort();
        });
        const page = await context.newPage();
        page.setDefaultTimeout(15_000);
        page.on('console', (message) => complaints.push(`console: ${message.text()}`));
        page.on('pageerror', (error) => complaints.push(`error: ${error.stack}`));
        if (before) await page.addInitScript(before);
        await page.goto(address);
        await use(page);
        assert.deepEqual(complaints, []);
    } finally {
        await context.close();
    }
}

/// Waits until both pictures and their radiance are there and drawn.
export async function ready(page, left, right) {
    await page.waitForSelector(`#canvas[data-ready="${left} | ${right}"]`);
    await drawn(page);
}

/// Waits until what was asked for is on the screen.
export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/// Where an element lies once the page, which may have been scrolled by what the test did before, has come to rest.
export async function boxAtRest(page, selector) {
    const element = page.locator(selector);
    await element.scrollIntoViewIfNeeded();
    for (let last, same = 0; ; ) {
        await drawn(page);
        const box = await element.boundingBox();
        same = last && box.x === last.x && box.y === last.y && box.width === last.width ? same + 1 : 0;
        if (same === 10) return box;
        last = box;
    }
}
