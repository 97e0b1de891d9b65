// Runs Khronos' glTF validator: node validate.js MODULES FILE…
// MODULES is the folder that holds gltf-validator (a node_modules). Prints every error and warning, and ends with 1 if
// there is one.
'use strict';
const fs = require('fs');
const path = require('path');

const kSeverity = ['error', 'warning'];

async function complaintsAbout(validator, file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: path.basename(file) });
  return report.issues.messages
      .filter((message) => message.severity < kSeverity.length)
      .map((message) => `${file}: ${kSeverity[message.severity]} ${message.code} at ${message.pointer || message.offset}: ` +
                        message.message);
}

async function main([modules, ...files]) {
  if (!files.length) throw new Error('usage: node validate.js MODULES FILE…');
  const validator = require(path.resolve(modules, 'gltf-validator'));
  let found = 0;
  for (const file of files) {
    const complaints = await complaintsAbout(validator, file);
    complaints.forEach((complaint) => console.log(complaint));
    found += complaints.length;
  }
  console.log(`${files.length} file(s), ${found} error(s) and warning(s)`);
  return found ? 1 : 0;
}

main(process.argv.slice(2)).then((status) => process.exit(status), (error) => {
  console.error(error.message);
  process.exit(2);
});
