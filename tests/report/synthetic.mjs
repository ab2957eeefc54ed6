// A report as `luciole compare` would write it, of pictures that are formulas, so that every number on the page is known.
import { deflateSync } from 'node:zlib';
import { png } from './png.mjs';

export const view = { width: 240, height: 160 };
export const marker = '@LUCIOLE_REPORT@';

/// Radiance of the reference: multiples of 1/32 below 16, which half floats hold exactly.
export const radianceAt = (x, y) => [x / 32, y / 32, 2];

/// The first technique is the reference; the second has this much more red in the left half.
export const moreRed = 1.25;
const names = ['brute-force', 'tiled', 'clustered', 'light-indexed', 'forward-multipass', 'volume-stencil-reference'];
const redFactor = (technique, x) => (technique === 1 && x < view.width / 2 ? moreRed : 1);

export function halfOf(value) {
    if (value === 0) return 0;
    const exponent = Math.floor(Math.log2(value));
    return ((exponent + 15) << 10) | Math.round((value / 2 ** exponent - 1) * 1024);
}

function halves(red) {
    const pixels = view.width * view.height;
    const planes = new Uint16Array(3 * pixels);
    for (let y = 0; y < view.height; ++y)
        for (let x = 0; x < view.width; ++x)
            radianceAt(x, y).forEach((value, channel) => {
                planes[channel * pixels + y * view.width + x] = halfOf(channel === 0 ? value * red(x) : value);
            });
    return planes;
}

const packed = (planes) => deflateSync(Buffer.from(planes.buffer)).toString('base64');
const display = (value) => Math.round(255 * Math.min(value / 8, 1));

function image(name, technique) {
    const red = (x) => redFactor(technique, x);
    const planes = halves(red);
    if (technique !== null) {
        const reference = halves(() => 1);
        planes.forEach((half, index) => (planes[index] = half ^ reference[index]));
    }
    // Blue tells the pictures apart where the formulas do not: none in the reference, more from technique to technique.
    const blue = technique === null ? 0 : 60 + 30 * technique;
    return {
        name, radiance: packed(planes),
        picture: png(view.width, view.height, (x, y) => [display((x / 32) * red(x)), display(y / 32), blue]),
    };
}

// Times that overlap for the second and third technique only.
const times = [[88, 86, 91], [5.1, 4.9, 5.4], [5.3, 5.2, 5.5], [9.4, 9.3, 9.6], [41, 40, 42], [30.2, 30, 30.5]];

function technique(name, index) {
    const [median, low, high] = times[index];
    const heat = png(view.width, view.height, (x, y) => [(x * 7 * (index + 1)) % 256, (y * 5) % 256, 40]);
    return {
        name, help: `lights gathered the ${name} way`, source: index % 2 ? 'Trebilco 2009' : 'Calver 2003', image: index + 1,
        difference: heat, flip: heat, ...(index === 3 ? {} : { overlap: heat }),
        metrics: {
            maxError: index === 1 ? 25 : 0.01 * index, p999Error: index === 1 ? 24.8 : 0.004 * index, meanError: 0.0012 * index,
            psnr: index === 0 ? null : 80 - 4 * index, ssim: 1 - 0.0004 * index, flip: 0.0003 * index,
        },
        wallMs: { median, low, high },
        passes: [
            { name: 'geometry.depth', ms: 0.4, bytes: 153600, draws: 31 },
            { name: 'geometry.gbuffer', ms: 1.1, bytes: 3379200, draws: 31 },
            { name: 'lighting.initial', ms: 0.2, bytes: 614400, draws: 1 },
            { name: `lighting.${name}.lists`, ms: index === 0 ? null : 0.1 * median, bytes: 40960, draws: 0 },
            { name: `lighting.${name}.shade`, ms: 0.7 * median, bytes: 0, draws: 1 },
            { name: 'post.tone-map', ms: 0.3, bytes: 153600, draws: 1 },
            { name: 'output.display', ms: 0.1, bytes: 0, draws: 0 },
        ],
        peakBytes: 4_200_000 + 900_000 * index, evaluations: 255 / (index + 1) ** 2, useful: 4,
    };
}

export function syntheticReport() {
    return {
        schema: 1, mapScales: { error: 0.0234, lights: 255 }, title: 'builtin:hall?lights=255',
        machine: {
            cpu: 'A processor with a fairly long name @ 2.50 GHz', threads: 2, device: 'llvmpipe (LLVM 15.0.6, 256 bits)',
            driver: 'Mesa 22.3.6', system: 'Linux 6.1', version: '0.1.0', commit: '4b67b8d',
        },
        view, lights: 255, triangles: 18432,
        images: [image('reference', null), ...names.map(image)],
        techniques: names.map(technique),
        left: [{ name: 'light-prepass', why: 'one sample a pixel; the scene asks for 4' }, { name: 'fullscreen', why: 'a draw <b>a light</b>' }],
        sweep: {
            parameter: 'lights', values: [255, 1024, 4096, 16384],
            series: names.map((name, index) => ({ name, ms: [1, 4, 16, 64].map((step, row) => (index === 0 && row === 3 ? null : times[index][0] * step ** (0.95 - 0.12 * index))) })),
        },
    };
}

/// The page with this data in it, the way the program puts it there.
export function pageOf(template, report) {
    const data = typeof report === 'string' ? report : JSON.stringify(report);
    return template.replace(marker, () => data.replaceAll('<', '\\u003c'));
}
