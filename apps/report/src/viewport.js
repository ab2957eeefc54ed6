// Which part of the picture shows, and where. Lengths are CSS pixels, the origin is the top left of the stage.

const mostZoom = 64; // CSS pixels a pixel: a dozen pixels across the stage of a telephone

export class Viewport {
    scale = 1;
    x = 0; // of the picture's left edge
    y = 0;
    #fitted = true;

    constructor(imageWidth, imageHeight) {
        this.imageWidth = imageWidth;
        this.imageHeight = imageHeight;
        this.resize(imageWidth, imageHeight);
    }

    get fitScale() {
        return Math.min(this.width / this.imageWidth, this.height / this.imageHeight);
    }

    get fitted() {
        return this.#fitted;
    }

    resize(width, height) {
        const before = { x: this.width / 2, y: this.height / 2 };
        this.width = width;
        this.height = height;
        if (this.#fitted) return this.fit();
        this.pan(width / 2 - before.x, height / 2 - before.y);
    }

    fit() {
        this.#fitted = true;
        this.scale = this.fitScale;
        this.#clamp();
    }

    /// Keeps the point of the picture that is at (x, y) there.
    zoom(factor, x = this.width / 2, y = this.height / 2) {
        const scale = Math.min(Math.max(this.scale * factor, this.fitScale), Math.max(mostZoom, this.fitScale));
        this.x = x - ((x - this.x) * scale) / this.scale;
        this.y = y - ((y - this.y) * scale) / this.scale;
        this.scale = scale;
        this.#fitted = scale <= this.fitScale * 1.0001;
        this.#clamp();
    }

    pan(dx, dy) {
        this.x += dx;
        this.y += dy;
        this.#clamp();
    }

    /// Moves no further than it takes to show the pixel.
    reveal(pixel) {
        const left = this.x + pixel.x * this.scale;
        const top = this.y + pixel.y * this.scale;
        this.pan(
            Math.max(0, -left) + Math.min(0, this.width - left - this.scale),
            Math.max(0, -top) + Math.min(0, this.height - top - this.scale));
    }

    /// The pixel at a point, or null beside the picture.
    pixelAt(x, y) {
        const pixel = { x: Math.floor((x - this.x) / this.scale), y: Math.floor((y - this.y) / this.scale) };
        const inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < this.imageWidth && pixel.y < this.imageHeight;
        return inside ? pixel : null;
    }

    /// The edges stay outside of the stage, or the picture in its middle.
    #clamp() {
        const place = (at, length, room) => (length <= room ? (room - length) / 2 : Math.min(0, Math.max(room - length, at)));
        this.x = place(this.x, this.imageWidth * this.scale, this.width);
        this.y = place(this.y, this.imageHeight * this.scale, this.height);
    }
}
