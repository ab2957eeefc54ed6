// A PNG from a function of the pixel: 8 bits, RGB.
import { deflateSync } from 'node:zlib';

const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
    for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
    return n;
});

function chunk(type, data) {
    const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
    const crc = ~body.reduce((sum, byte) => crcTable[(sum ^ byte) & 0xff] ^ (sum >>> 8), ~0) >>> 0;
    const framed = Buffer.alloc(body.length + 8);
    framed.writeUInt32BE(data.length, 0);
    body.copy(framed, 4);
    framed.writeUInt32BE(crc, body.length + 4);
    return framed;
}

/// `color(x, y)` gives [r, g, b] from 0 to 255. \return a data: URI
export function png(width, height, color) {
    const rows = Buffer.alloc((3 * width + 1) * height); // each row begins with 0: no filter
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) rows.set(color(x, y), y * (3 * width + 1) + 1 + 3 * x);
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2], 8); // bits a channel; truecolour
    const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
    const file = Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
    return `data:image/png;base64,${file.toString('base64')}`;
}
