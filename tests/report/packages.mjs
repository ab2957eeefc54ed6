// The packages of apps/report, from here: Node looks for them only above the file that imports them.
import { createRequire } from 'node:module';

export const requirePackage = createRequire(new URL('../../apps/report/package.json', import.meta.url));
