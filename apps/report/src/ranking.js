// Who is faster than whom, as far as the measurement can tell.

const overlap = (a, b) => a.low <= b.high && b.low <= a.high;

/// For each technique its place by median time, or, where intervals overlap and a place would be a guess, null and the
/// names of those it can't be told from.
export function standings(techniques) {
    return techniques.map((technique) => {
        const others = techniques.filter((other) => other !== technique);
        const alike = others.filter((other) => overlap(technique.wallMs, other.wallMs));
        const faster = others.filter((other) => other.wallMs.median < technique.wallMs.median);
        return { place: alike.length ? null : faster.length + 1, alike: alike.map((other) => other.name) };
    });
}

export function standingText({ place, alike }) {
    if (place !== null) return `${place}.`;
    const named = alike.slice(0, 2).join(' and ');
    if (alike.length <= 2) return `within the noise of ${named}`;
    return `within the noise of ${alike[0]} and ${alike.length - 1} more`;
}
