// The table of techniques, sortable by each column.
import { element } from './elements.js';
import { bytes, fixed, milliseconds, number, percent } from './format.js';
import { standings, standingText } from './ranking.js';

const infinite = (value) => (value === null ? Infinity : value);

// `value` sorts, `text` is shown, `small` stands below it. Sorting begins with what is best: `best` says which end that is.
const columns = [
    { title: 'Time', unit: 'ms', best: 'low', value: (t) => t.wallMs.median, text: (t) => milliseconds(t.wallMs.median), small: (t) => `${milliseconds(t.wallMs.low)} to ${milliseconds(t.wallMs.high)}` },
    { title: 'Place', best: 'low', value: (t) => t.wallMs.median, text: (t, standing) => standingText(standing), words: true },
    { title: 'Largest error', best: 'low', value: (t) => t.metrics.maxError, text: (t) => percent(t.metrics.maxError) },
    { title: '99.9 % of pixels below', best: 'low', value: (t) => t.metrics.p999Error, text: (t) => percent(t.metrics.p999Error) },
    { title: 'Mean error', best: 'low', value: (t) => t.metrics.meanError, text: (t) => percent(t.metrics.meanError) },
    { title: 'PSNR', unit: 'dB', best: 'high', value: (t) => infinite(t.metrics.psnr), text: (t) => (t.metrics.psnr === null ? '∞' : fixed(t.metrics.psnr, 1)) },
    { title: 'SSIM', best: 'high', value: (t) => t.metrics.ssim, text: (t) => fixed(t.metrics.ssim, 4) },
    { title: 'FLIP', best: 'low', value: (t) => t.metrics.flip, text: (t) => fixed(t.metrics.flip, 4) },
    { title: 'Lights evaluated', unit: 'a pixel', best: 'low', value: (t) => t.evaluations, text: (t) => number(t.evaluations), small: usefulText },
    { title: 'Memory', best: 'low', value: (t) => t.peakBytes, text: (t) => bytes(t.peakBytes) },
];

function usefulText(technique) {
    if (!(technique.evaluations > 0)) return null;
    return `${number(technique.useful)} of use, ${Math.round((100 * technique.useful) / technique.evaluations)} %`;
}

/// `show(technique)` is called for the button in a row.
export function buildTable(table, techniques, show) {
    const ranked = standings(techniques);
    const rows = techniques.map((technique, index) => ({ technique, row: rowOf(technique, ranked[index], show) }));
    const body = element('tbody');
    const heads = columns.map((column) => headOf(column, (head) => sortBy(column, head)));
    const nameHead = headOf({ title: 'Technique' }, (head) => sortBy({ value: (t) => t.name, best: 'low' }, head));
    const allHeads = [nameHead, ...heads];

    function sortBy(column, head) {
        const first = column.best === 'high' ? 'descending' : 'ascending';
        const second = first === 'ascending' ? 'descending' : 'ascending';
        const direction = head.getAttribute('aria-sort') === first ? second : first;
        for (const each of allHeads) each.removeAttribute('aria-sort');
        head.setAttribute('aria-sort', direction);
        const sorted = sortRows(rows, column.value, direction);
        body.replaceChildren(...sorted.map(({ row }) => row));
    }

    table.replaceChildren(
        element('caption', { class: 'visually-hidden', text: 'Techniques: time, error, evaluations and memory. The buttons in the head sort.' }),
        element('thead', {}, element('tr', {}, ...allHeads)),
        body);
    sortBy(columns[0], heads[0]);
}

/// What has no number comes last, whichever way it is sorted.
export function sortRows(rows, value, direction) {
    const sign = direction === 'ascending' ? 1 : -1;
    const missing = (key) => key === undefined || key === null;
    return [...rows].sort((a, b) => {
        const [left, right] = [value(a.technique), value(b.technique)];
        if (missing(left) || missing(right)) return missing(left) - missing(right);
        return sign * (left < right ? -1 : left > right ? 1 : 0);
    });
}

function headOf({ title, unit }, sort) {
    const button = element('button', { type: 'button' }, title, unit ? element('span', { class: 'unit', text: ` ${unit}` }) : null);
    const head = element('th', { scope: 'col' }, button);
    button.addEventListener('click', () => sort(head));
    return head;
}

function rowOf(technique, standing, show) {
    const button = element('button', { type: 'button', class: 'show', 'aria-label': `Show ${technique.name} beside the reference`, text: 'Show' });
    button.addEventListener('click', () => show(technique));
    return element('tr', {},
        element('th', { scope: 'row' }, element('span', { class: 'name' }, element('span', { text: technique.name }), button)),
        ...columns.map((column) => {
            const small = column.small?.(technique);
            return element('td', { class: column.words ? 'place' : null },
                column.text(technique, standing), small ? element('small', { text: small }) : null);
        }));
}

/// Below the table, since they are sentences: what each technique does and whose idea it is, and what was not rendered, and why.
export function buildWords(place, techniques, left) {
    place.append(element('details', {},
        element('summary', { text: 'What each technique does' }),
        definitions(techniques.map(({ name, help, source }) => [name, help, source && `Source: ${source}`]))));
    if (left?.length) place.append(element('h3', { text: 'Not rendered' }), definitions(left.map(({ name, why }) => [name, why])));
}

function definitions(rows) {
    return element('dl', { class: 'words' }, ...rows.flatMap(([term, ...lines]) =>
        [element('dt', { text: term }), ...lines.filter(Boolean).map((line) => element('dd', { text: line }))]));
}
