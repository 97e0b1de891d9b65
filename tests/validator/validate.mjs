// node validate.mjs FILE...: runs Khronos' glTF validator; prints each issue and exits 1 if a file has an error or a warning.
// `npm ci` in this folder (./bootstrap test does it) fetches the validator.
import { readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { validateBytes } from 'gltf-validator';

const severities = ['error', 'warning', 'info', 'hint'];
let refused = 0;

for (const file of process.argv.slice(2)) {
  const report = await validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    maxIssues: 20,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  for (const { severity, pointer, code, message } of messages) {
    console.log(`${file}: ${severities[severity]}: ${pointer ?? ''}: ${code}: ${message}`);
  }
  if (numErrors + numWarnings > 0) refused += 1;
}

if (process.argv.length < 3) {
  console.error('usage: node validate.mjs FILE...');
  process.exit(2);
}
process.exit(refused > 0 ? 1 : 0);
