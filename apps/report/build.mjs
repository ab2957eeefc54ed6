// Makes the page in one file: node build.mjs OUTPUT [DEPFILE]. Style sheet and scripts are written into it, and nothing
// is fetched by whoever opens it. The text @LUCIOLE_REPORT@ stays, for `luciole compare` to put the data there.
import { build } from 'esbuild';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [output, depfile] = process.argv.slice(2);
if (!output) {
    console.error('usage: node build.mjs OUTPUT [DEPFILE]');
    process.exit(2);
}

const inputs = new Set(['src/report.html', 'build.mjs', 'package-lock.json'].map((name) => resolve(here, name)));

async function bundle(entry) {
    const { outputFiles, metafile } = await build({
        absWorkingDir: here, entryPoints: [entry], bundle: true, write: false, minify: true, metafile: true,
        format: 'iife', target: ['chrome100', 'firefox100', 'safari15.4'], legalComments: 'none', logLevel: 'warning',
    });
    for (const name of Object.keys(metafile.inputs)) inputs.add(resolve(here, name));
    return outputFiles[0].text.trim();
}

const license = (await readFile(resolve(here, 'node_modules/uplot/LICENSE'), 'utf8')).trim();
const parts = {
    '@LUCIOLE_STYLE@': await bundle('src/report.css'),
    '@LUCIOLE_SCRIPT@': `/* Contains uPlot.\n${license}\n*/\n${await bundle('src/main.js')}`,
};
let page = await readFile(resolve(here, 'src/report.html'), 'utf8');
for (const [marker, text] of Object.entries(parts)) {
    if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`${marker}: its text would end the element that it stands in`);
    page = page.replace(marker, () => text);
}
if (page.split('@LUCIOLE_REPORT@').length !== 2) throw new Error('expected the marker of the data exactly once');

await mkdir(dirname(resolve(output)), { recursive: true });
await writeFile(output, page);
if (depfile) {
    const names = [...inputs].map((name) => name.replaceAll(' ', '\\ '));
    await writeFile(depfile, `${output}: ${names.join(' ')}\n`);
}
