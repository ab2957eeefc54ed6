// The numbers of one pixel: radiance left and right, and how far right is off left.
import { element } from './elements.js';
import { radiance, signed } from './format.js';
import { canInflate, relativeDifference } from './radiance.js';

const channels = ['R', 'G', 'B'];
const floorShare = 0.01; // of the reference's mean

export class Readout {
    #store;
    #floor = null;
    #sides = [null, null];
    #labels = ['', ''];
    #body = document.querySelector('#readout tbody');
    #caption = document.querySelector('#readout-caption');
    #note = document.querySelector('#readout-note');

    constructor(store) {
        this.#store = store;
    }

    /// Unpacks what these two layers need. Picture and map go on without it if it can't be had.
    async choose([left, right]) {
        this.#labels = [left.label, right.label];
        this.#sides = [null, null];
        if (!canInflate()) {
            this.#note.textContent = 'This browser is too old to unpack the radiance of a pixel (it lacks DecompressionStream). The pictures can be compared all the same.';
            return;
        }
        const labels = this.#labels;
        try {
            const sides = await Promise.all([this.#store.get(left.image), this.#store.get(right.image)]);
            this.#floor ??= floorShare * (await this.#store.get(0)).mean() + 1e-9;
            if (labels !== this.#labels) return; // others were chosen meanwhile
            this.#sides = sides;
            this.#note.textContent = `Difference: right − left, over left plus 1 % of the reference's mean (${radiance(this.#floor)}).`;
        } catch (error) {
            this.#note.textContent = `The radiance in this file can't be read (${error.message || error}). The pictures can be compared all the same.`;
        }
    }

    /// \param pixel null as long as none was pointed at \return what it says, as a sentence
    show(pixel) {
        this.#caption.textContent = pixel ? `x ${pixel.x}, y ${pixel.y}` : 'Point at a pixel';
        const values = this.#sides.map((side) => pixel && side?.at(pixel.x, pixel.y));
        const known = values[0] && values[1];
        const difference = known && relativeDifference(values[0], values[1], this.#floor);
        const rows = [
            ['left', this.#labels[0], values[0], radiance],
            ['right', this.#labels[1], values[1], radiance],
            ['difference', 'difference, %', difference, signed],
        ];
        this.#body.replaceChildren(...rows.map(([key, label, numbers, format]) =>
            element('tr', { 'data-row': key },
                element('th', { scope: 'row', text: label }),
                ...channels.map((_, channel) => element('td', { text: numbers ? format(numbers[channel]) : '–' })))));
        if (!known) return this.#caption.textContent;
        const list = (numbers, format) => numbers.map((value, channel) => `${channels[channel]} ${format(value)}`).join(', ');
        return `${this.#caption.textContent}. ${this.#labels[0]}: ${list(values[0], radiance)}. ` +
            `${this.#labels[1]}: ${list(values[1], radiance)}. Difference: ${list(difference, (value) => `${signed(value)} %`)}.`;
    }
}
