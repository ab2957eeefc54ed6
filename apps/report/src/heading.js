// What was rendered, on what, and the result in two sentences.
import { element } from './elements.js';
import { integer, milliseconds, percent } from './format.js';
import { standings } from './ranking.js';

export function buildHeading(report) {
    const { machine, view } = report;
    document.title = `${report.title}: techniques compared`;
    document.getElementById('title').textContent = report.title;
    document.getElementById('summary').textContent = summary(report.techniques);
    document.getElementById('origin').textContent = ['Written by Luciole', machine?.version, machine?.commit && `(${machine.commit})`].filter(Boolean).join(' ');
    const facts = [
        ['Size', `${view.width} × ${view.height}`],
        ['Lights', integer(report.lights)],
        ['Triangles', integer(report.triangles)],
        ['Device', machine?.device],
        ['Driver', machine?.driver],
        ['Processor', machine?.cpu],
        ['Threads', integer(machine?.threads)],
        ['System', machine?.system],
        ['Version', machine?.version],
        ['Commit', machine?.commit],
    ];
    document.getElementById('facts').append(...facts.filter(([, value]) => value).map(([name, value]) =>
        element('div', {}, element('dt', { text: name }), element('dd', { text: value }))));
}

export function summary(techniques) {
    if (!techniques.length) return 'No technique was rendered.';
    const places = standings(techniques);
    const first = techniques.reduce((best, technique) => (technique.wallMs.median < best.wallMs.median ? technique : best));
    const { alike } = places[techniques.indexOf(first)];
    const time = `${milliseconds(first.wallMs.median)} ms`;
    const fastest = alike.length
        ? `The shortest median is that of ${first.name}, ${time}, within the noise of ${alike.length === 1 ? alike[0] : `${alike.length} others`}.`
        : techniques.length > 1 ? `${first.name} is the fastest, with ${time} a frame.` : `${first.name} takes ${time} a frame.`;
    const farthest = techniques.reduce((worst, technique) => (technique.metrics.p999Error > worst.metrics.p999Error ? technique : worst));
    return `${fastest} Furthest from the reference is ${farthest.name}: 99.9 % of its pixels are within ${percent(farthest.metrics.p999Error)}.`;
}
