// Checks .glb and .vrm files with Khronos' glTF-Validator: node validate_gltf.mjs FILE...
// Prints the numbers of findings of each file, and every error and warning. Exits 1 if there is an error or a warning.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';

const validator = createRequire(import.meta.url)('gltf-validator');
const severities = ['error', 'warning'];

let failed = false;
for (const file of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 0 });
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos, ${issues.numHints} hints`);
  for (const { code, message, severity, pointer } of issues.messages) {
    if (severity < severities.length) console.log(`  ${severities[severity]} ${code} ${pointer ?? ''}: ${message}`);
  }
  failed ||= issues.numErrors + issues.numWarnings > 0;
}
process.exit(failed ? 1 : 0);
