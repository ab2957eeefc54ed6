// The page as somebody uses it, in a browser without a network.
import assert from 'node:assert/strict';
import { mkdir, readFile } from 'node:fs/promises';
import test, { after, before } from 'node:test';
import { boxAtRest, drawn, ready, startBrowser, stopBrowser, withPage } from './browser.mjs';
import { requirePackage } from './packages.mjs';
import { syntheticReport, view } from './synthetic.mjs';

const report = syntheticReport();
const screenshots = process.env.LUCIOLE_SCREENSHOTS; // a folder that gets what the page looks like, or unset

before(startBrowser);
after(stopBrowser);

/// Colours of the viewer's canvas: `count` pixels rightwards from a place given as shares of width and height.
const colorsFrom = (page, x, y, count) => page.evaluate(([shareX, shareY, width]) => {
    const canvas = document.getElementById('canvas');
    const copy = Object.assign(document.createElement('canvas'), { width, height: 1 }); // reading slows a canvas down
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, -Math.floor(shareX * canvas.width), -Math.floor(shareY * canvas.height));
    const { data } = context.getImageData(0, 0, width, 1);
    return Array.from({ length: width }, (_, index) => [...data.slice(4 * index, 4 * index + 3)]);
}, [x, y, count]);
const colorAt = async (page, x, y) => (await colorsFrom(page, x, y, 1))[0];

/// Numbers of the readout, row by row.
const readout = (page) => page.$$eval('#readout tbody tr', (rows) => Object.fromEntries(rows.map((row) =>
    [row.dataset.row, [...row.querySelectorAll('td')].map((cell) => cell.textContent)])));

/// How much of a chart's width something was drawn in.
const drawnShare = (page, place) => page.$eval(`${place} canvas`, (canvas) => {
    const { width, height } = canvas;
    const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    let columns = 0;
    for (let x = 0; x < width; ++x) {
        let y = 0;
        while (y < height && data[4 * (y * width + x) + 3] === 0) ++y;
        columns += y < height;
    }
    return columns / canvas.closest('.chart').clientWidth / window.devicePixelRatio;
});

const names = (page) => page.$$eval('#technique-table tbody th .name span', (cells) => cells.map((cell) => cell.textContent));

// Blue says which picture a pixel of the canvas comes from (synthetic.mjs); near, since a shrunk picture is resampled.
const assertBlue = (color, blue) => assert.ok(Math.abs(color[2] - blue) <= 1, `expected blue ${blue}, got ${color}`);
const blueOf = { reference: 0, 'brute-force': 60, tiled: 90, clustered: 120 };

test('the table has a row for each technique, sorts by each column, and claims no place within the noise', () => withPage(report, {}, async (page) => {
    await ready(page, 'reference', 'brute-force');
    assert.deepEqual(await names(page), ['tiled', 'clustered', 'light-indexed', 'volume-stencil-reference', 'forward-multipass', 'brute-force']);
    const places = await page.$$eval('#technique-table tbody .place', (cells) => cells.map((cell) => cell.textContent));
    assert.deepEqual(places, ['within the noise of clustered', 'within the noise of tiled', '3.', '4.', '5.', '6.']);
    await page.click('#technique-table thead button:has-text("PSNR")'); // infinite is best
    assert.equal((await names(page))[0], 'brute-force');
    await page.click('#technique-table thead button:has-text("PSNR")');
    assert.equal((await names(page)).at(-1), 'brute-force');
    assert.equal(await page.getAttribute('#technique-table th:has-text("PSNR")', 'aria-sort'), 'ascending');
    assert.match(await page.textContent('#words'), /fullscreen.*a draw <b>a light<\/b>/);
    assert.match(await page.textContent('#facts'), /240 × 160.*255.*llvmpipe.*Mesa 22\.3\.6.*4b67b8d/);
}));

test('the split follows the slider, the keyboard and the hand, and a row brings its technique', () => withPage(report, {}, async (page) => {
    await page.click('[aria-label="Show clustered beside the reference"]');
    await ready(page, 'reference', 'clustered');
    assertBlue(await colorAt(page, 0.4, 0.3), blueOf.reference);
    assertBlue(await colorAt(page, 0.6, 0.3), blueOf.clustered);
    await page.fill('#split', '70');
    await drawn(page);
    assertBlue(await colorAt(page, 0.6, 0.3), blueOf.reference);
    assertBlue(await colorAt(page, 0.8, 0.3), blueOf.clustered);
    await page.focus('#split');
    await page.keyboard.press('Home');
    await drawn(page);
    assertBlue(await colorAt(page, 0.1, 0.3), blueOf.clustered);
    const box = await boxAtRest(page, '#canvas');
    await page.mouse.move(box.x + 0.2 * box.width, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.9 * box.width, box.y + 30, { steps: 3 });
    await page.mouse.up();
    await page.waitForFunction(() => document.getElementById('split').value === '90');
    await drawn(page);
    assertBlue(await colorAt(page, 0.8, 0.3), blueOf.reference);
}));

test('holding the button or F swaps the sides, for as long as it is held', () => withPage(report, {}, async (page) => {
    await ready(page, 'reference', 'brute-force');
    const left = async () => {
        await drawn(page);
        return colorAt(page, 0.2, 0.3);
    };
    await page.keyboard.down('f');
    assertBlue(await left(), blueOf['brute-force']);
    assert.equal(await page.textContent('#tag-left'), 'brute-force');
    await page.keyboard.up('f');
    assertBlue(await left(), blueOf.reference);
    await page.hover('#flip');
    await page.mouse.down();
    assertBlue(await left(), blueOf['brute-force']);
    await page.mouse.up();
    assertBlue(await left(), blueOf.reference);
    await page.focus('#flip');
    await page.keyboard.down('Space');
    assertBlue(await left(), blueOf['brute-force']);
    await page.keyboard.up('Space');
    assertBlue(await left(), blueOf.reference);
}));

test('the wheel zooms to single pixels, and the pointer reads their radiance', () => withPage(report, {}, async (page) => {
    await page.selectOption('#right-layer', { label: 'tiled' });
    await ready(page, 'reference', 'tiled');
    const box = await boxAtRest(page, '#canvas');
    await page.waitForTimeout(400); // the wheel goes on scrolling the page for a moment
    const scale = box.width / view.width;
    await page.mouse.move(box.x + 64.5 * scale, box.y + 96.5 * scale);
    await page.mouse.wheel(0, -1500);
    await page.waitForFunction(() => document.getElementById('zoom').textContent === '6400 %');
    assert.equal(await page.textContent('#readout-caption'), 'x 64, y 96');
    const values = await readout(page); // 1 % of the reference's mean: (119.5 / 32 + 79.5 / 32 + 2) / 3 / 100
    assert.deepEqual(values.left, ['2.000', '3.000', '2.000']);
    assert.deepEqual(values.right, ['2.500', '3.000', '2.000']);
    assert.deepEqual(values.difference, ['+25', '0', '0']);
    await page.mouse.move(box.x + 64.5 * scale + 128, box.y + 96.5 * scale);
    await drawn(page);
    assert.equal(await page.textContent('#readout-caption'), 'x 66, y 96');
    const reds = new Set((await colorsFrom(page, 0.2, 0.05, 200)).map(([red]) => red));
    assert.ok(reds.size <= 5, `200 CSS pixels of 64 a pixel hold 4 or 5 colours if nothing is smoothed, got ${reds.size}`);
    await page.mouse.down();
    await page.mouse.move(box.x + 64.5 * scale + 256, box.y + 96.5 * scale, { steps: 3 });
    await page.mouse.up();
    await page.mouse.move(box.x + 64.5 * scale + 128, box.y + 96.5 * scale);
    assert.equal(await page.textContent('#readout-caption'), 'x 64, y 96'); // dragged by two pixels
}));

test('maps can be chosen on either side, and read the radiance of their technique', () => withPage(report, {}, async (page) => {
    await page.selectOption('#left-layer', { label: 'tiled, difference' });
    await page.selectOption('#right-layer', { label: 'tiled, overlap' });
    await ready(page, 'tiled, difference', 'tiled, overlap');
    assert.equal(await page.textContent('#tag-left'), 'tiled, difference (dark 0, yellow 0.023 % and more)');
    assert.equal(await page.textContent('#tag-right'), 'tiled, overlap (dark 0, yellow 255 lights, log)');
    assert.equal(await page.locator('#left-layer option').count(), 7 + 6 + 6 + 5);
    assertBlue(await colorAt(page, 0.2, 0.3), 40);
}));

test('all of it works by keyboard', () => withPage(report, {}, async (page) => {
    await ready(page, 'reference', 'brute-force');
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
    await page.keyboard.press('Enter');
    const reach = async (condition) => {
        for (let step = 0; step < 60; ++step) {
            await page.keyboard.press('Tab');
            if (await page.evaluate(condition)) return;
        }
        assert.fail(`Tab does not reach ${condition}`);
    };
    await reach(() => document.activeElement.id === 'right-layer');
    await page.keyboard.press('ArrowDown');
    await ready(page, 'reference', 'tiled');
    await reach(() => document.activeElement.id === 'canvas');
    assert.notEqual(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), 'none');
    await page.keyboard.press('Shift+ArrowLeft');
    assert.equal(await page.textContent('#readout-caption'), 'x 119, y 80');
    await page.keyboard.press('Control+Shift+ArrowUp');
    assert.match(await page.textContent('#announcement'), /^x 119, y 64\. reference: R 3\.719, G 2\.000, B 2\.000\. tiled: R 4\.648/);
    for (let step = 0; step < 5; ++step) await page.keyboard.press('+');
    await drawn(page);
    const zoomed = await page.textContent('#zoom');
    assert.ok(parseInt(zoomed) > 3000, zoomed);
    const middle = () => colorAt(page, 0.25, 0.25);
    const still = await middle();
    for (let step = 0; step < 8; ++step) await page.keyboard.press('ArrowRight');
    await drawn(page);
    assert.notDeepEqual(await middle(), still);
    for (let step = 0; step < 30; ++step) await page.keyboard.press('Shift+ArrowRight');
    await drawn(page);
    assert.equal(await page.textContent('#readout-caption'), 'x 149, y 64');
    await page.keyboard.press('0');
    await drawn(page);
    assert.ok(parseInt(await page.textContent('#zoom')) < 1000);
    await reach(() => document.activeElement.matches('#sweep-chart input'));
    await page.keyboard.press('Space');
    await reach(() => document.activeElement.matches('.technique summary'));
    await page.keyboard.press('Enter');
    assert.ok(await page.isVisible('.technique[open] table'));
}));

test('the charts draw, and stand beside their numbers', () => withPage(report, {}, async (page) => {
    await ready(page, 'reference', 'brute-force');
    assert.equal(await page.locator('.chart canvas').count(), 2);
    assert.ok(await drawnShare(page, '#cost-chart') > 0.8);
    assert.ok(await drawnShare(page, '#sweep-chart') > 0.8);
    assert.equal(await page.locator('#cost-chart tbody tr').count(), 6);
    assert.equal(await page.locator('#sweep-chart tbody tr').count(), 6);
    assert.equal(await page.locator('#sweep-chart tbody tr').first().locator('td').last().textContent(), '–');
    assert.equal(await page.locator('#timeline details').count(), 6);
}));

test('a sweep is drawn in the order of its numbers, whatever the order it was measured in', async () => {
    const turn = (list) => [...list].reverse();
    const { values, series } = report.sweep;
    const turned = { ...report.sweep, values: turn(values), series: series.map(({ name, ms }) => ({ name, ms: turn(ms) })) };
    const seen = [];
    for (const sweep of [report.sweep, turned])
        await withPage({ ...report, sweep }, {}, async (page) => {
            await ready(page, 'reference', 'brute-force');
            seen.push([await page.$$eval('#sweep-chart tr', (rows) => rows.map((row) => row.textContent)),
                await page.$eval('#sweep-chart canvas', (canvas) => canvas.toDataURL())]);
        });
    assert.deepEqual(seen[1], seen[0]);
});

test('a sweep of what has no logarithm has its values side by side', () => {
    const series = report.sweep.series.map(({ name, ms }) => ({ name, ms: ms.slice(0, 2) }));
    return withPage({ ...report, sweep: { parameter: 'gbuffer', values: ['float', 'compact'], series } }, {}, async (page) => {
        await ready(page, 'reference', 'brute-force');
        assert.ok(await drawnShare(page, '#sweep-chart') > 0.8);
        assert.deepEqual(await page.locator('#sweep-chart thead th').allTextContents(), ['Technique', 'float', 'compact']);
    });
});

test('on paper nothing is folded and the colours are light; afterwards all is as it was', () => withPage(report, { colorScheme: 'dark' }, async (page) => {
    await ready(page, 'reference', 'brute-force');
    const state = () => page.evaluate(() => ({
        folded: document.querySelectorAll('details:not([open])').length,
        ink: getComputedStyle(document.body).color,
    }));
    const before = await state();
    await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
    assert.deepEqual(await state(), { folded: 0, ink: 'rgb(28, 29, 34)' });
    await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
    assert.deepEqual(await state(), before);
}));

test('what is broken or too old is said in words', async () => {
    await withPage('{"schema": 1, "ima', {}, async (page) => {
        assert.match(await page.textContent('.notice'), /can't be shown. The data in this file is not complete/);
        assert.ok(!(await page.isVisible('#report')));
    });
    await withPage(report, { before: () => delete window.DecompressionStream }, async (page) => {
        await ready(page, 'reference', 'brute-force');
        assert.match(await page.textContent('#readout-note'), /lacks DecompressionStream/);
        assertBlue(await colorAt(page, 0.8, 0.3), blueOf['brute-force']);
    });
    const torn = { ...report, images: report.images.map((image, index) => (index === 1 ? { ...image, radiance: 'AAAA' } : image)) };
    await withPage(torn, {}, async (page) => {
        await ready(page, 'reference', 'brute-force');
        assert.match(await page.textContent('#readout-note'), /can't be read/);
    });
    await withPage({ ...report, techniques: [], images: report.images.slice(0, 1), sweep: null, left: [] }, {}, async (page) => {
        await ready(page, 'reference', 'reference');
    });
});

const looks = [
    ['light-wide', { colorScheme: 'light' }],
    ['dark-wide', { colorScheme: 'dark' }],
    ['light-narrow', { colorScheme: 'light', viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 }],
    ['dark-narrow', { colorScheme: 'dark', viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 }],
];
for (const [name, options] of looks)
    test(`no violation of accessibility rules, nothing wider than the window: ${name}`, () => withPage(report, options, async (page) => {
        await page.selectOption('#right-layer', { label: 'tiled' });
        await ready(page, 'reference', 'tiled');
        if (screenshots) {
            await mkdir(screenshots, { recursive: true });
            await page.screenshot({ path: `${screenshots}/${name}.png`, fullPage: true });
        }
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
        const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
        assert.equal(background[0] < 128, options.colorScheme === 'dark');
        await page.evaluate(() => document.querySelectorAll('details').forEach((details) => (details.open = true)));
        await page.evaluate(requirePackage('axe-core').source);
        const { violations } = await page.evaluate(() => window.axe.run());
        assert.deepEqual(violations.map(({ id, nodes }) => [id, ...nodes.map((node) => node.html.slice(0, 200))]), []);
    }));

test('valid HTML, as it is written and as it stands in the browser', async () => {
    const { HtmlValidate } = requirePackage('html-validate');
    const assertValid = async (html, rules) => {
        const checked = await new HtmlValidate({ extends: ['html-validate:recommended'], rules }).validateString(html);
        assert.deepEqual(checked.results.flatMap(({ messages }) => messages.map(({ line, ruleId, message }) => `${line}: ${ruleId}: ${message}`)), []);
    };
    await assertValid(await readFile(process.env.LUCIOLE_REPORT_TEMPLATE, 'utf8'), {});
    await withPage(report, {}, async (page) => {
        await ready(page, 'reference', 'brute-force');
        // Lengths that follow from data are set by scripts as styles of elements; how a browser writes its tree down is its own.
        await assertValid(await page.content(), { 'no-inline-style': 'off', 'doctype-style': 'off', 'attribute-boolean-style': 'off', 'attribute-empty-style': 'off', 'no-trailing-whitespace': 'off' });
    });
});
