// Mouse, finger and keyboard, turned into calls of the viewer.

const grip = 16;         // CSS pixels on either side of the line that count as the line
const wheelPause = 300;  // ms: a page that was scrolled a moment ago goes on scrolling when the picture comes under the wheel

export function listenToHands(viewer, flipButton) {
    const { canvas } = viewer;
    const place = (event) => {
        const box = canvas.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    const onLine = ({ x }) => Math.abs(x - viewer.split * viewer.viewport.width) <= grip;
    let drag = null; // 'split' or 'pan'
    let last = null;

    canvas.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        last = place(event);
        drag = viewer.viewport.fitted || onLine(last) ? 'split' : 'pan';
        canvas.setPointerCapture(event.pointerId);
        viewer.point(last.x, last.y);
    });
    canvas.addEventListener('pointermove', (event) => {
        const at = place(event);
        if (drag === 'split') viewer.setSplit(at.x / viewer.viewport.width);
        if (drag === 'pan') viewer.pan(at.x - last.x, at.y - last.y);
        if (drag !== 'pan') viewer.point(at.x, at.y);
        canvas.classList.toggle('on-line', drag === 'split' || (!drag && onLine(at)));
        last = at;
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, () => (drag = null));

    let scrolled = -Infinity;
    document.addEventListener('scroll', () => (scrolled = performance.now()), { passive: true });
    canvas.addEventListener('wheel', (event) => {
        const scrollsPage = performance.now() - scrolled < wheelPause;
        const nothingToShrink = event.deltaY > 0 && viewer.viewport.fitted;
        if (!event.ctrlKey && (scrollsPage || nothingToShrink)) return;
        event.preventDefault();
        const { x, y } = place(event);
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 40 : 1;
        viewer.zoom(2 ** (-(event.deltaY * lines) / 200), x, y);
        viewer.point(x, y);
    }, { passive: false });

    flipButton.addEventListener('pointerdown', () => viewer.setFlipped(true));
    flipButton.addEventListener('keydown', (event) => {
        if (event.key === ' ' || event.key === 'Enter') viewer.setFlipped(true);
    });
    flipButton.addEventListener('contextmenu', (event) => event.preventDefault()); // a long press on a telephone
    for (const name of ['pointerup', 'pointercancel', 'keyup', 'blur']) window.addEventListener(name, () => viewer.setFlipped(false));
}

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const panStep = 48;  // CSS pixels
const longStep = 16; // pixels of the picture

/// Arrow keys belong to the picture that has the focus, the others to the whole section; F works anywhere.
export function listenToKeys(viewer, section) {
    document.addEventListener('keydown', (event) => {
        const types = event.target.matches?.('select, textarea, input:not([type=range], [type=checkbox])');
        if (types || event.altKey || event.metaKey) return;
        if (event.key.toLowerCase() === 'f' && !event.ctrlKey) viewer.setFlipped(true);
        else if (section.contains(event.target) && handle(viewer, event)) event.preventDefault();
    });
}

/// \return whether the key was one of ours
function handle(viewer, event) {
    const arrow = event.target === viewer.canvas && arrows[event.key];
    if (arrow && event.shiftKey) {
        const step = event.ctrlKey ? longStep : 1;
        viewer.step(arrow[0] * step, arrow[1] * step);
        return true;
    }
    if (event.ctrlKey) return false; // the browser's own zoom
    if (arrow) {
        if (viewer.viewport.fitted) return false; // nothing to pan: the page scrolls
        viewer.pan(-arrow[0] * panStep, -arrow[1] * panStep);
        return true;
    }
    const keys = { '+': () => viewer.zoom(2), '=': () => viewer.zoom(2), '-': () => viewer.zoom(0.5), 0: () => viewer.fit() };
    keys[event.key]?.();
    return event.key in keys;
}
