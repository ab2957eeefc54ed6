// The linear radiance of each picture, unpacked when it is first looked at.

export const canInflate = () => typeof DecompressionStream === 'function';

const inHand = 4; // pictures unpacked at a time besides the reference: 12 MB each at 1920 x 1080

export function halfToNumber(half) {
    const sign = half & 0x8000 ? -1 : 1;
    const exponent = (half >> 10) & 0x1f;
    const fraction = half & 0x3ff;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    if (exponent === 0x1f) return fraction ? NaN : sign * Infinity;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

function bytesOfBase64(text) {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

async function inflate(text) {
    const stream = new Blob([bytesOfBase64(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(stream).arrayBuffer();
}

class Radiance {
    constructor(halves, { width, height }) {
        this.halves = halves; // planes R, G, B
        this.width = width;
        this.pixels = width * height;
    }

    at(x, y) {
        const index = y * this.width + x;
        return [0, 1, 2].map((plane) => halfToNumber(this.halves[plane * this.pixels + index]));
    }

    /// Over all pixels and channels that are finite.
    mean() {
        let sum = 0;
        for (const half of this.halves) {
            const value = halfToNumber(half);
            if (Number.isFinite(value)) sum += value;
        }
        return sum / this.halves.length;
    }
}

export class RadianceStore {
    #images;
    #view;
    #unpacked = new Map(); // index -> promise, oldest first

    constructor(images, view) {
        this.#images = images;
        this.#view = view;
    }

    get(index) {
        const known = this.#unpacked.get(index);
        if (known) return known;
        const made = this.#unpack(index);
        this.#unpacked.set(index, made);
        const oldest = [...this.#unpacked.keys()].find((key) => key !== 0);
        if (this.#unpacked.size > inHand + 1) this.#unpacked.delete(oldest);
        return made;
    }

    // All but the reference are stored as what differs from its bits.
    async #unpack(index) {
        const buffer = await inflate(this.#images[index].radiance);
        const { width, height } = this.#view;
        if (buffer.byteLength !== width * height * 6)
            throw new Error(`${this.#images[index].name}: expected ${width * height * 6} bytes of radiance, got ${buffer.byteLength}`);
        const halves = new Uint16Array(buffer); // every machine that runs a browser today is little-endian
        if (index !== 0) {
            const reference = (await this.get(0)).halves;
            for (let i = 0; i < halves.length; ++i) halves[i] ^= reference[i];
        }
        return new Radiance(halves, this.#view);
    }
}

/// Per channel, in percent: how far `value` is off `base`. `floor`, a hundredth of the reference's mean, keeps dark pixels
/// from counting by more than an eye would see.
export function relativeDifference(base, value, floor) {
    return base.map((expected, channel) => (100 * (value[channel] - expected)) / (Math.abs(expected) + floor));
}
