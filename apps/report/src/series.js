// How the curves of a chart are told apart: by colour, by dashes and by the shape of their points, each on its own.
import { element, svg } from './elements.js';
import { color } from './theme.js';

const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3]];
const shapes = [ // SVG paths round the origin, 5 units in radius
    'M4,0A4,4 0 1 1 -4,0A4,4 0 1 1 4,0Z',   // circle
    'M-4,-4H4V4H-4Z',                       // square
    'M0,-5L5,4H-5Z',                        // triangle
    'M0,-5L5,0L0,5L-5,0Z',                  // diamond
    'M0,5L5,-4H-5Z',                        // triangle, point down
];
const colors = 8;

export function styleOf(index) {
    return { color: `series-${(index % colors) + 1}`, dash: dashes[index % dashes.length], shape: shapes[index % shapes.length] };
}

export function drawMarkers(plot, seriesIndex) {
    if (seriesIndex === 0) return;
    const style = styleOf(seriesIndex - 1);
    const shape = new Path2D(style.shape);
    const { ctx } = plot;
    const density = window.devicePixelRatio || 1;
    plot.data[seriesIndex].forEach((value, row) => {
        if (value === null) return;
        ctx.save();
        ctx.translate(plot.valToPos(plot.data[0][row], 'x', true), plot.valToPos(value, 'y', true));
        ctx.scale(density, density);
        ctx.fillStyle = color(style.color);
        ctx.fill(shape);
        ctx.restore();
    });
}

/// Check boxes that show and hide curves, each beside a piece of its curve. Calls `toggle(index, shown)`.
export function seriesLegend(names, toggle) {
    return element('fieldset', { class: 'legend' }, element('legend', { class: 'visually-hidden', text: 'Curves that are shown' }), ...names.map((name, index) => {
        const style = styleOf(index);
        const box = element('input', { type: 'checkbox', checked: true });
        box.addEventListener('change', () => toggle(index, box.checked));
        const paint = `var(--${style.color})`;
        const sample = svg('svg', { viewBox: '-18 -7 36 14', width: 36, height: 14, 'aria-hidden': 'true' },
            svg('path', { d: 'M-18,0H18', fill: 'none', stroke: paint, 'stroke-width': 2, 'stroke-dasharray': style.dash.join(' ') || 'none' }),
            svg('path', { d: style.shape, fill: paint }));
        return element('label', {}, box, sample, element('span', { text: name }));
    }));
}
