// What the page computes, without a browser.
import assert from 'node:assert/strict';
import test from 'node:test';
import { parseReport } from '../../apps/report/src/data.js';
import * as format from '../../apps/report/src/format.js';
import { halfToNumber, RadianceStore, relativeDifference } from '../../apps/report/src/radiance.js';
import { standings, standingText } from '../../apps/report/src/ranking.js';
import { Viewport } from '../../apps/report/src/viewport.js';
import { moreRed, radianceAt, syntheticReport } from './synthetic.mjs';

test('half floats: normal, subnormal, signed, infinite and not a number', () => {
    const known = [[0x0000, 0], [0x3c00, 1], [0xc000, -2], [0x3555, 0.333251953125], [0x7bff, 65504], [0x0001, 2 ** -24], [0x03ff, 1023 * 2 ** -24], [0x0400, 2 ** -14], [0x7c00, Infinity], [0xfc00, -Infinity], [0x7e00, NaN]];
    for (const [bits, value] of known) assert.equal(halfToNumber(bits), value);
});

test('radiance: pictures that are stored as differences from the reference come out whole', async () => {
    const { images, view } = syntheticReport();
    const store = new RadianceStore(images, view);
    assert.deepEqual((await store.get(0)).at(32, 96), radianceAt(32, 96));
    assert.deepEqual((await store.get(2)).at(32, 96), [moreRed * 1, 3, 2]);
    assert.deepEqual((await store.get(2)).at(200, 10), radianceAt(200, 10));
});

test('radiance: data of the wrong size is refused, with both sizes', async () => {
    const { images } = syntheticReport();
    await assert.rejects(new RadianceStore(images, { width: 10, height: 10 }).get(0), /expected 600 bytes of radiance, got 230400/);
});

test('radiance: a difference is relative to the left side, over a floor', () => {
    assert.deepEqual(relativeDifference([1, 0, -3], [1.5, 0.01, -3], 1), [25, 1, 0]);
});

test('ranking: no place where intervals overlap', () => {
    const technique = (name, low, median, high) => ({ name, wallMs: { low, median, high } });
    const ranked = standings([technique('a', 1, 2, 3), technique('b', 2.5, 3, 4), technique('c', 5, 6, 7)]);
    assert.deepEqual(ranked, [{ place: null, alike: ['b'] }, { place: null, alike: ['a'] }, { place: 3, alike: [] }]);
    assert.deepEqual(ranked.map(standingText), ['within the noise of b', 'within the noise of a', '3.']);
});

test('viewport: zooming keeps the point under the pointer, and ends at the whole picture', () => {
    const viewport = new Viewport(240, 160);
    viewport.resize(480, 320);
    assert.deepEqual(viewport.pixelAt(100, 50), { x: 50, y: 25 });
    viewport.zoom(8, 100, 50);
    assert.equal(viewport.scale, 16);
    assert.deepEqual(viewport.pixelAt(100, 50), { x: 50, y: 25 });
    viewport.zoom(1e6, 100, 50);
    assert.equal(viewport.scale, 64);
    viewport.zoom(1e-6);
    assert.ok(viewport.fitted);
    assert.deepEqual([viewport.scale, viewport.x, viewport.y], [2, 0, 0]);
});

test('viewport: panning stops at the edges, and beside the picture there is no pixel', () => {
    const viewport = new Viewport(240, 160);
    viewport.resize(600, 320);
    assert.equal(viewport.pixelAt(10, 10), null);
    viewport.zoom(4);
    viewport.pan(1e6, -1e6);
    assert.deepEqual(viewport.pixelAt(0, 319), { x: 0, y: 159 });
    viewport.reveal({ x: 239, y: 0 });
    assert.deepEqual(viewport.pixelAt(599, 0), { x: 239, y: 0 });
});

test('numbers: three digits, and no digits that are not there', () => {
    assert.deepEqual([0, 0.01234, 5.1, 88, 1234.5, 1e-5].map((value) => format.number(value)), ['0', '0.0123', '5.10', '88.0', '1,235', '1.00e-5']);
    assert.equal(format.number(null), '–');
    assert.equal(format.bytes(3 << 20), '3.00 MiB');
    assert.equal(format.signed(-2), '−2.0');
});

test('data: what is missing is named', () => {
    assert.throws(() => parseReport('{"schema": 1'), /not complete/);
    assert.throws(() => parseReport('{"schema": 2}'), /schema 1, but the file holds 2/);
    const report = syntheticReport();
    report.techniques[1].image = 99;
    assert.throws(() => parseReport(JSON.stringify(report)), /The picture of tiled is missing/);
});
