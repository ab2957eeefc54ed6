// Makes an element. Attributes with the value undefined, null or false are left out; `text` goes in as text, so that
// nothing from a report is ever read as HTML.
export function element(tag, attributes = {}, ...children) {
    return fill(document.createElement(tag), attributes, ...children);
}

export function svg(tag, attributes = {}, ...children) {
    return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, ...children);
}

function fill(node, { text, ...attributes }, ...children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (value === undefined || value === null || value === false) continue;
        node.setAttribute(name, value === true ? '' : value);
    }
    if (text !== undefined) node.textContent = text;
    node.append(...children.filter((child) => child !== null));
    return node;
}

/// A table of numbers below a chart, folded until it is wanted. `rows` hold a name and then cells of text.
export function numbersTable(caption, heads, rows) {
    return element('details', { class: 'numbers' },
        element('summary', { text: 'The numbers' }),
        element('section', { class: 'scroller', tabindex: 0, 'aria-label': caption }, plainTable(caption, heads, rows)));
}

export function plainTable(caption, heads, rows) {
    return element('table', {},
        element('caption', { class: 'visually-hidden', text: caption }),
        element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', { scope: 'col', text: head })))),
        element('tbody', {}, ...rows.map(([name, ...cells]) =>
            element('tr', {}, element('th', { scope: 'row', text: name }), ...cells.map((cell) => element('td', { text: cell }))))));
}
