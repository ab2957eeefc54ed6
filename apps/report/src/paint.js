// Draws the stage: two pictures, the line between them, the cursor.

/// `pictures` are [left, right], either null while it loads. `cursor` is a pixel or null; `split` is from 0 to 1 of the stage.
export function paint(canvas, viewport, pictures, split, cursor) {
    const density = window.devicePixelRatio || 1;
    const context = canvas.getContext('2d');
    const edge = Math.round(split * viewport.width * density);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    paintPicture(context, viewport, density, pictures[0], 0, edge);
    paintPicture(context, viewport, density, pictures[1], edge, canvas.width - edge);
    context.setTransform(density, 0, 0, density, 0, 0);
    paintSplit(context, viewport, edge / density);
    if (cursor) paintCursor(context, viewport, cursor);
}

function paintPicture(context, viewport, density, picture, from, width) {
    if (!picture || width <= 0) return;
    context.save();
    context.beginPath();
    context.rect(from, 0, width, context.canvas.height);
    context.clip();
    context.imageSmoothingEnabled = viewport.scale * density < 1; // pixels stay pixels; only what shrinks is averaged
    context.imageSmoothingQuality = 'high';
    context.setTransform(viewport.scale * density, 0, 0, viewport.scale * density, viewport.x * density, viewport.y * density);
    context.drawImage(picture, 0, 0);
    context.restore();
}

// White between black, so that it shows on any picture.
function outlined(context, width, draw) {
    for (const [color, extra] of [['#000', 2], ['#fff', 0]]) {
        context.strokeStyle = color;
        context.lineWidth = width + extra;
        context.beginPath();
        draw();
        context.stroke();
    }
}

function paintSplit(context, viewport, x) {
    const middle = viewport.height / 2;
    outlined(context, 2, () => {
        context.moveTo(x, 0);
        context.lineTo(x, viewport.height);
    });
    context.fillStyle = '#fff';
    context.strokeStyle = '#000';
    context.lineWidth = 1;
    context.beginPath();
    context.arc(x, middle, 13, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    context.lineWidth = 2;
    context.beginPath();
    for (const side of [-1, 1]) {
        context.moveTo(x + 4 * side, middle - 5);
        context.lineTo(x + 9 * side, middle);
        context.lineTo(x + 4 * side, middle + 5);
    }
    context.stroke();
}

function paintCursor(context, viewport, cursor) {
    const size = Math.max(viewport.scale, 1);
    const left = viewport.x + cursor.x * viewport.scale;
    const top = viewport.y + cursor.y * viewport.scale;
    const [x, y] = [left + viewport.scale / 2, top + viewport.scale / 2];
    outlined(context, 1.5, () => {
        if (size >= 4) return context.rect(left - 1, top - 1, size + 2, size + 2);
        for (const [dx, dy] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
            context.moveTo(x + 4 * dx, y + 4 * dy);
            context.lineTo(x + 11 * dx, y + 11 * dy);
        }
    });
}
