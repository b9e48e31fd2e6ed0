// Validates glTF files with Khronos' gltf-validator: node gltf_validator.mjs FILE..., exit code 1 where one has an error.
// SPDX-License-Identifier: MIT
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { dirname, join, basename } from "node:path";

const require = createRequire(import.meta.url);
const { validateBytes } = require("gltf-validator");

let failed = false;
for (const path of process.argv.slice(2)) {
    const report = await validateBytes(new Uint8Array(readFileSync(path)), {
        uri: basename(path),
        maxIssues: 0,
        externalResourceFunction: (uri) =>
            Promise.resolve(new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri))))),
    });
    const { numErrors, numWarnings, numInfos } = report.issues;
    console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
    const seen = new Set();
    for (const issue of report.issues.messages) {
        if (issue.severity > 1 && process.env.VERBOSE === undefined) continue;
        if (seen.has(issue.code)) continue;
        seen.add(issue.code);
        console.log(`  ${["error", "warning", "info", "hint"][issue.severity]} ${issue.code} at ${issue.pointer}: ${issue.message}`);
    }
    failed ||= numErrors > 0;
}
process.exit(failed ? 1 : 0);
