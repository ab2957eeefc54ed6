// Colours for what is drawn on a canvas, from the style sheet, and word of when they change.

export function color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/// Calls `redraw` when the system turns dark or light, and round printing, for which the page takes its light colours.
export function onColorsChange(redraw) {
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    const printing = (on) => {
        document.documentElement.classList.toggle('printing', on);
        redraw();
    };
    window.addEventListener('beforeprint', () => printing(true));
    window.addEventListener('afterprint', () => printing(false));
}
