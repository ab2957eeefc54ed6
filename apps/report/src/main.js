// Puts the page together from the data that was written into it.
import { costChart, sweepChart } from './charts.js';
import { layersOf, parseReport } from './data.js';
import { element } from './elements.js';
import { buildHeading } from './heading.js';
import { buildTable, buildWords } from './table.js';
import { onColorsChange } from './theme.js';
import { buildTimeline } from './timeline.js';
import { Viewer } from './viewer.js';

const byId = (id) => document.getElementById(id);

function build(report) {
    buildHeading(report);
    byId('report').hidden = false; // before the viewer and the charts, which measure the room they have
    const layers = layersOf(report);
    const viewer = new Viewer(report, layers);
    const { techniques } = report;
    buildTable(byId('technique-table'), techniques, (technique) => {
        viewer.choose(0, technique.image);
        byId('viewer').scrollIntoView();
        viewer.canvas.focus({ preventScroll: true });
    });
    buildWords(byId('words'), techniques, report.left);
    buildTimeline(byId('timeline'), techniques);
    const charts = [];
    if (techniques.length) charts.push(costChart(byId('cost-chart'), techniques));
    if (report.sweep) charts.push(sweepChart(byId('sweep-chart'), report.sweep));
    onColorsChange(() => charts.forEach((draw) => draw()));
    unfoldForPrint();
}

// Paper can't be clicked: what is folded is printed, and folded again afterwards.
function unfoldForPrint() {
    let folded = [];
    window.addEventListener('beforeprint', () => {
        folded = [...document.querySelectorAll('details:not([open])')];
        folded.forEach((details) => (details.open = true));
    });
    window.addEventListener('afterprint', () => folded.forEach((details) => (details.open = false)));
}

try {
    build(parseReport(byId('report-data').textContent));
} catch (error) {
    byId('report').hidden = true;
    byId('notices').append(element('p', { class: 'notice', text: `This report can't be shown. ${error.message}` }));
}
