// Numbers as text. Always in English notation, as the rest of the page is.
const none = '–';
const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

/// Three significant digits, thousands separated; small and large ones as powers of ten.
export function number(value, digits = 3) {
    if (!isNumber(value)) return none;
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(digits - 1).replace('e+', 'e');
    const decimals = size === 0 ? 0 : Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    return value.toLocaleString('en', { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
}

export const integer = (value) => (isNumber(value) ? Math.round(value).toLocaleString('en') : none);
export const milliseconds = (value) => number(value);
export const percent = (value) => (isNumber(value) ? `${number(value)} %` : none);
export const fixed = (value, decimals) => (isNumber(value) ? value.toFixed(decimals) : none);

export function bytes(value) {
    if (!isNumber(value)) return none;
    if (value < 1024) return `${value} B`;
    return value < 1 << 20 ? `${number(value / 1024)} KiB` : `${number(value / (1 << 20))} MiB`;
}

/// Radiance: as many digits as a half float has, and the values that are no numbers by their names.
export function radiance(value) {
    if (Number.isNaN(value)) return 'NaN';
    if (!Number.isFinite(value)) return value > 0 ? '∞' : '-∞';
    return value === 0 ? '0' : number(value, 4);
}

/// With its sign, two digits.
export function signed(value) {
    if (!isNumber(value)) return none;
    return value === 0 ? '0' : `${value > 0 ? '+' : '−'}${number(Math.abs(value), 2)}`;
}
