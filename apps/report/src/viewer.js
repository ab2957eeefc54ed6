// Two pictures in one frame. State lives here; what it looks like, in paint.js; what the hands do, in gestures.js.
import { listenToHands, listenToKeys } from './gestures.js';
import { element } from './elements.js';
import { paint } from './paint.js';
import { RadianceStore } from './radiance.js';
import { Readout } from './readout.js';
import { Viewport } from './viewport.js';

const byId = (id) => document.getElementById(id);

export class Viewer {
    canvas = byId('canvas');
    viewport;
    split = 0.5;
    flipped = false;
    cursor = null;
    #layers;
    #chosen = [0, 1];
    #pictures = [null, null];
    #readout;
    #selects = [byId('left-layer'), byId('right-layer')];
    #frame = 0;

    constructor(report, layers) {
        const { width, height } = report.view;
        this.viewport = new Viewport(width, height);
        this.#layers = layers;
        this.#readout = new Readout(new RadianceStore(report.images, report.view));
        byId('stage').style.setProperty('--aspect', `${width} / ${height}`);
        this.#connect();
        this.choose(0, Math.min(1, layers.length - 1));
    }

    /// Layers by their place in the list.
    async choose(left, right) {
        this.#chosen = [left, right];
        this.#selects.forEach((select, side) => (select.value = this.#chosen[side]));
        const layers = this.#sides();
        const chosen = this.#chosen;
        const values = this.#readout.choose(layers).then(() => this.#read());
        const pictures = await Promise.all(layers.map(loadPicture));
        if (chosen !== this.#chosen) return;
        this.#pictures = pictures;
        this.refresh();
        await values;
        this.canvas.dataset.ready = layers.map((layer) => layer.label).join(' | ');
    }

    setSplit(share) {
        this.split = Math.min(Math.max(share, 0), 1);
        byId('split').value = this.split * 100;
        this.refresh();
    }

    setFlipped(flipped) {
        if (flipped === this.flipped) return;
        this.flipped = flipped;
        byId('flip').setAttribute('aria-pressed', flipped);
        this.refresh();
    }

    zoom(factor, x, y) {
        this.viewport.zoom(factor, x, y);
        this.refresh();
    }

    fit() {
        this.viewport.fit();
        this.refresh();
    }

    pan(dx, dy) {
        this.viewport.pan(dx, dy);
        this.refresh();
    }

    /// The pixel under the pointer; beside the picture the last one stays.
    point(x, y) {
        this.cursor = this.viewport.pixelAt(x, y) ?? this.cursor;
        this.#read();
        this.refresh();
    }

    /// By keyboard: moves the cursor, brings it into view, says what is there. The first time it is in the middle.
    step(dx, dy) {
        const { imageWidth, imageHeight, width, height } = this.viewport;
        const from = this.cursor ?? this.viewport.pixelAt(width / 2, height / 2);
        const inside = (value, length) => Math.min(Math.max(value, 0), length - 1);
        this.cursor = { x: inside(from.x + dx, imageWidth), y: inside(from.y + dy, imageHeight) };
        this.viewport.reveal(this.cursor);
        byId('announcement').textContent = this.#read();
        this.refresh();
    }

    /// Draws with the next frame of the screen, however much has changed until then.
    refresh() {
        this.#frame ||= requestAnimationFrame(() => {
            this.#frame = 0;
            this.#draw();
        });
    }

    #sides() {
        return this.#chosen.map((index) => this.#layers[index]);
    }

    #read() {
        return this.#readout.show(this.cursor);
    }

    #draw() {
        const turn = (pair) => (this.flipped ? [pair[1], pair[0]] : pair);
        paint(this.canvas, this.viewport, turn(this.#pictures), this.split, this.cursor);
        turn(this.#sides()).forEach((layer, side) => {
            const tag = byId(side ? 'tag-right' : 'tag-left');
            tag.textContent = layer.scale ? `${layer.label} (${layer.scale})` : layer.label;
            tag.hidden = side ? this.split > 0.98 : this.split < 0.02;
        });
        byId('zoom').textContent = `${Math.round(this.viewport.scale * 100)} %`;
        byId('split').setAttribute('aria-valuetext', `${Math.round(this.split * 100)} % left`);
        this.canvas.classList.toggle('pannable', !this.viewport.fitted);
    }

    #connect() {
        for (const select of this.#selects) {
            select.append(...optionGroups(this.#layers));
            select.addEventListener('change', () => this.choose(...this.#selects.map((each) => Number(each.value))));
            this.#leaveAfterMouse(select);
        }
        byId('split').addEventListener('input', (event) => this.setSplit(event.target.value / 100));
        byId('zoom-in').addEventListener('click', () => this.zoom(2));
        byId('zoom-out').addEventListener('click', () => this.zoom(0.5));
        byId('zoom-fit').addEventListener('click', () => this.fit());
        listenToHands(this, byId('flip'));
        listenToKeys(this, byId('viewer'));
        new ResizeObserver(() => this.#resize()).observe(this.canvas);
    }

    // A list keeps the focus and takes an F as the name of its next entry. Who chose by mouse wants the picture's keys next;
    // who is going through the list by keyboard stays in it.
    #leaveAfterMouse(select) {
        let byMouse = false;
        select.addEventListener('pointerdown', () => (byMouse = true));
        select.addEventListener('keydown', () => (byMouse = false));
        select.addEventListener('change', () => byMouse && this.canvas.focus({ preventScroll: true }));
    }

    #resize() {
        const { width, height } = this.canvas.getBoundingClientRect();
        if (!width || !height) return;
        const density = window.devicePixelRatio || 1;
        this.canvas.width = Math.round(width * density);
        this.canvas.height = Math.round(height * density);
        this.viewport.resize(width, height);
        this.#draw(); // at once: changing its size has cleared the canvas
    }
}

function optionGroups(layers) {
    const groups = new Map();
    layers.forEach(({ group, label }, index) => {
        if (!groups.has(group)) groups.set(group, element('optgroup', { label: group }));
        groups.get(group).append(element('option', { value: index, text: label }));
    });
    return groups.values();
}

async function loadPicture({ picture }) {
    const image = new Image();
    image.src = picture;
    try {
        await image.decode();
        return image;
    } catch {
        return null; // the other side still shows
    }
}
