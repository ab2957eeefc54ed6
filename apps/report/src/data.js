// From the page's JSON to a report that the rest may rely on.

/// What is wrong with the data, in words for the reader.
export class BrokenReport extends Error {}

function require(condition, message) {
    if (!condition) throw new BrokenReport(message);
}

export function parseReport(text) {
    let report;
    try {
        report = JSON.parse(text);
    } catch {
        throw new BrokenReport('The data in this file is not complete. Perhaps it was cut off while it was written or copied.');
    }
    require(report?.schema === 1, `This page reads data of schema 1, but the file holds ${JSON.stringify(report?.schema) ?? 'none'}.`);
    require(report.view?.width > 0 && report.view?.height > 0, 'The data does not say how large the pictures are.');
    require(Array.isArray(report.images) && report.images.length > 0, 'The data holds no pictures.');
    require(Array.isArray(report.techniques), 'The data holds no list of techniques.');
    require(report.mapScales, 'The data does not say what the colours of the maps stand for.');
    for (const technique of report.techniques) {
        require(report.images[technique.image] !== undefined, `The picture of ${technique.name} is missing.`);
        require(technique.wallMs && technique.metrics && Array.isArray(technique.passes), `The figures of ${technique.name} are missing.`);
    }
    return report;
}

const short = (value) => Number(value.toPrecision(2));

/// Everything that can be shown on one side of the viewer. `image` is the picture whose radiance is read out there: that
/// of the technique, for a map. `scale`, of a map: what its colours stand for.
export function layersOf(report) {
    const layers = report.images.map((image, index) => ({ group: 'Pictures', label: image.name, picture: image.picture, image: index }));
    for (const [key, group, label, scale] of [
        ['difference', 'Difference from the reference', 'difference', `dark 0, yellow ${short(report.mapScales.error)} % and more`],
        ['flip', 'FLIP maps', 'FLIP', 'dark 0, yellow 1'],
        ['overlap', 'Overlap maps', 'overlap', `dark 0, yellow ${report.mapScales.lights} lights, log`],
    ]) {
        for (const technique of report.techniques)
            if (technique[key]) layers.push({ group, label: `${technique.name}, ${label}`, scale, picture: technique[key], image: technique.image });
    }
    return layers;
}
