// Where the time of a frame goes: a bar of passes for each technique, with its numbers folded below.
import { element, plainTable } from './elements.js';
import { bytes, integer, milliseconds } from './format.js';

// Phases of a frame, by the first word of a pass's name. The style sheet gives each a colour and a hatching.
const phases = ['geometry', 'bounce', 'lighting', 'post'];
const phaseOf = (pass) => {
    const first = pass.name.split('.')[0];
    return phases.includes(first) ? first : 'other';
};
const total = (technique) => technique.passes.reduce((sum, pass) => sum + (pass.ms ?? 0), 0);

export function buildTimeline(place, techniques) {
    const timed = techniques.filter((technique) => total(technique) > 0).sort((a, b) => a.wallMs.median - b.wallMs.median);
    if (!timed.length) {
        place.append(element('p', { class: 'note', text: 'No pass was timed on its own.' }));
        return;
    }
    const longest = Math.max(...timed.map(total));
    const rows = timed.map((technique) => rowOf(technique));
    const box = element('input', { type: 'checkbox' });
    const scale = () => rows.forEach(({ bar, sum }) => (bar.style.width = `${box.checked ? 100 : (100 * sum) / longest}%`));
    box.addEventListener('change', scale);
    scale();
    const used = new Set(timed.flatMap((technique) => technique.passes.map(phaseOf)));
    place.append(
        element('div', { class: 'timeline-head' },
            element('ul', { class: 'legend' }, ...[...phases, 'other'].filter((phase) => used.has(phase)).map((phase) =>
                element('li', {}, element('span', { class: `swatch phase-${phase}` }), element('span', { text: phase })))),
            element('label', { class: 'check' }, box, element('span', { text: 'Each bar at full width' }))),
        element('div', { class: 'timeline' }, ...rows.map(({ row }) => row)));
}

function rowOf(technique) {
    const sum = total(technique);
    const bar = element('span', { class: 'bar' });
    technique.passes.forEach((pass, index) => {
        if (!(pass.ms > 0)) return;
        const segment = element('span', { class: `segment phase-${phaseOf(pass)}`, title: `${pass.name}: ${milliseconds(pass.ms)} ms` },
            element('span', { class: 'ordinal', text: index + 1 }));
        segment.style.flexGrow = pass.ms / sum;
        bar.append(segment);
    });
    const row = element('details', { class: 'technique' },
        element('summary', {},
            element('span', { class: 'name', text: technique.name }),
            element('span', { class: 'sum', text: `${milliseconds(sum)} ms in ${technique.passes.length} passes` }),
            element('span', { class: 'track', 'aria-hidden': 'true' }, bar)),
        element('section', { class: 'scroller', tabindex: 0, 'aria-label': `Passes of ${technique.name}` },
            plainTable(`Passes of ${technique.name}`, ['Pass', 'ms', 'Share', 'Bytes', 'Draws'], technique.passes.map((pass, index) =>
                [`${index + 1}. ${pass.name}`, milliseconds(pass.ms), pass.ms > 0 ? `${((100 * pass.ms) / sum).toFixed(1)} %` : '–', bytes(pass.bytes), integer(pass.draws)]))));
    return { row, bar, sum };
}
