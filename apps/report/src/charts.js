// The two charts, by uPlot: what each technique costs, and how that grows.
import uPlot from 'uplot';
import { element, numbersTable } from './elements.js';
import { integer, milliseconds } from './format.js';
import { drawMarkers, seriesLegend, styleOf } from './series.js';
import { color } from './theme.js';

const rowHeight = 30;
const font = (size = 12) => `${size}px system-ui, sans-serif`;

function figure(place, title, numbers) {
    const chart = element('div', { class: 'chart', 'aria-hidden': 'true' });
    place.hidden = false;
    place.append(element('figcaption', { text: title }), chart, numbers);
    return chart;
}

function axis(more) {
    return {
        stroke: color('ink-2'), font: font(), labelFont: font(),
        grid: { stroke: color('line'), width: 1 }, ticks: { show: false }, ...more,
    };
}

/// One bar a technique, the fastest on top, with its confidence interval. \return a function that draws it anew
export function costChart(place, techniques) {
    const sorted = [...techniques].sort((a, b) => a.wallMs.median - b.wallMs.median);
    const names = sorted.map((technique) => technique.name);
    const chart = figure(place, 'Milliseconds a frame: median and confidence interval',
        numbersTable('Milliseconds a frame', ['Technique', 'Median', 'Low', 'High'], sorted.map(({ name, wallMs }) =>
            [name, milliseconds(wallMs.median), milliseconds(wallMs.low), milliseconds(wallMs.high)])));
    const indices = names.map((_, index) => index);
    const most = Math.max(...sorted.map(({ wallMs }) => Math.max(wallMs.high, wallMs.median)), 1e-6);
    const longest = Math.max(...names.map((name) => name.length));

    const options = () => {
        const width = chart.clientWidth;
        const narrow = width < 520;
        return {
            width, height: names.length * rowHeight + 56,
            legend: { show: false }, cursor: { show: false }, padding: [4, 64, 0, 0],
            scales: {
                x: { time: false, ori: 1, dir: -1, range: [-0.6, names.length - 0.4] },
                y: { ori: 0, dir: 1, range: [0, most * 1.02] },
            },
            axes: [
                axis({ side: 3, size: Math.min(longest * (narrow ? 5.6 : 6.6) + 18, width * 0.5), font: font(narrow ? 10 : 12), stroke: color('ink'), grid: { show: false }, splits: () => indices, values: () => names }),
                axis({ side: 2, size: 32, space: 70, label: 'ms', labelSize: 18 }),
            ],
            series: [{}, { paths: uPlot.paths.bars({ size: [0.62, 40] }), fill: color('bar'), width: 0, points: { show: false } }],
            hooks: { draw: [(plot) => drawIntervals(plot, sorted)] },
        };
    };
    return redrawn(chart, options, [indices, sorted.map(({ wallMs }) => wallMs.median)]);
}

// A line from low to high on each bar, and the median as text beside it.
function drawIntervals(plot, techniques) {
    const { ctx } = plot;
    const density = window.devicePixelRatio || 1;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = color('ink');
    ctx.lineWidth = 1.5 * density;
    ctx.font = font(12 * density);
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    techniques.forEach(({ wallMs }, index) => {
        const y = plot.valToPos(index, 'x', true);
        const [low, high] = [wallMs.low, wallMs.high].map((value) => plot.valToPos(value, 'y', true));
        const cap = 4 * density;
        ctx.beginPath();
        ctx.moveTo(low, y);
        ctx.lineTo(high, y);
        for (const x of [low, high]) {
            ctx.moveTo(x, y - cap);
            ctx.lineTo(x, y + cap);
        }
        ctx.stroke();
        ctx.fillText(milliseconds(wallMs.median), high + 8 * density, y);
    });
    ctx.restore();
}

/// Milliseconds against the parameter, both logarithmic; what has no logarithm stands side by side. \return a function that draws it anew
export function sweepChart(place, sweep) {
    const { parameter } = sweep;
    const measured = sweep.values.every((value) => typeof value === 'number');
    const { values, series } = measured ? ascending(sweep) : sweep;
    const names = measured ? values.map(integer) : values;
    const places = measured ? values : values.map((_, index) => index);
    const chart = figure(place, `Milliseconds a frame against ${parameter}, ${measured ? 'both axes logarithmic' : 'logarithmic'}`,
        numbersTable(`Milliseconds a frame by ${parameter}`, ['Technique', ...names.map((name) => (measured ? `${name} ${parameter}` : name))],
            series.map(({ name, ms }) => [name, ...ms.map(milliseconds)])));
    const shown = series.map(() => true);
    const options = () => ({
        width: chart.clientWidth, height: chart.clientWidth < 520 ? 320 : 420,
        legend: { show: false }, cursor: { show: false }, padding: [12, 24, 0, 0],
        scales: { x: { time: false, ...(measured ? { distr: 3, range: (_, low, high) => [low / 1.15, high * 1.15] } : { range: [-0.3, values.length - 0.7] }) }, y: { distr: 3, range: niceRange } },
        axes: [
            axis({ label: parameter, size: 32, labelSize: 20, splits: () => places, filter: (_, splits) => splits, values: () => names }),
            axis({ label: 'ms', labelSize: 22, size: 54, values: (_, splits) => splits.map((split) => (split === null ? '' : milliseconds(split).replace(/\.0+$/, ''))) }),
        ],
        series: [{}, ...series.map((_, index) => {
            const style = styleOf(index);
            return { stroke: color(style.color), dash: style.dash, width: 2, show: shown[index], points: { show: false } };
        })],
        hooks: { drawSeries: [(plot, index) => drawMarkers(plot, index)] },
    });
    const draw = redrawn(chart, options, [places, ...series.map(({ ms }) => ms)]);
    chart.after(seriesLegend(series.map(({ name }) => name), (index, on) => {
        shown[index] = on;
        draw();
    }));
    return draw;
}

// uPlot takes places along an axis only in their order.
function ascending({ values, series }) {
    const order = values.map((_, index) => index).sort((a, b) => values[a] - values[b]);
    const ordered = (list) => order.map((index) => list[index]);
    return { values: ordered(values), series: series.map(({ name, ms }) => ({ name, ms: ordered(ms) })) };
}

// Whole steps of 1, 2, 5 round the data, so that the curves use the height there is.
function niceRange(_, low, high) {
    if (!(low > 0)) return [0.1, 10];
    const power = (value) => 10 ** Math.floor(Math.log10(value));
    const down = [5, 2, 1].map((step) => step * power(low)).find((step) => step <= low);
    const up = [1, 2, 5, 10].map((step) => step * power(high)).find((step) => step >= high);
    return [down === up ? down / 2 : down, up];
}

// A plot is made anew for each change: its colours and its layout depend on style sheet and width.
function redrawn(chart, options, data) {
    let plot = null;
    const draw = () => {
        if (chart.clientWidth === 0) return;
        plot?.destroy();
        plot = new uPlot(options(), data, chart);
    };
    let width = 0;
    new ResizeObserver(() => {
        if (chart.clientWidth === width) return;
        width = chart.clientWidth;
        draw();
    }).observe(chart);
    return draw;
}
